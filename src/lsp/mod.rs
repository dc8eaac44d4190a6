//! The language server: what an editor shows while a garment is being written.
//!
//! A text is cut into statements after every keystroke (`outline`), however broken it is; what
//! its names are and what they are worth comes from the evaluation, which runs beside
//! (`study`). An answer waits a moment for it and otherwise takes what was known before, its
//! places moved with the text. In a pause of writing the garments are cut (`cutting`). Each file here answers one kind of question.

mod across;
mod actions;
mod clause;
mod complete;
mod cutting;
mod definition;
mod describe;
mod document;
mod hints;
mod hover;
mod layout;
mod members;
mod names;
mod outline;
mod problems;
mod rename;
mod scan;
mod session;
mod signature;
mod study;
mod symbols;
mod text;
mod tokens;
mod uri;

pub use scan::{Sort, Token, tokens as scan};
pub use session::run;

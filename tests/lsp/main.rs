//! `darzi lsp` driven as an editor drives it.

mod across;
mod client;
mod complete;
mod damage;
mod session;
mod show;

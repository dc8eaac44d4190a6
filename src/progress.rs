//! How a long stage tells how far it is; the command line shows it, tests keep quiet.

/// Hears of the course of long work. It may not change the result.
pub trait Progress: Send {
    /// A stage begins: `sew`, `settle`, `render`.
    fn stage(&mut self, name: &str);

    /// The share of the stage that is done, 0 to 1, and a word on it (`gap 3.2 mm`).
    fn share(&mut self, done: f64, note: &str);
}

/// Says nothing.
#[derive(Clone, Copy, Debug, Default)]
pub struct Quiet;

impl Progress for Quiet {
    fn stage(&mut self, _name: &str) {}
    fn share(&mut self, _done: f64, _note: &str) {}
}

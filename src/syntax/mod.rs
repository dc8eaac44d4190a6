//! Text to tree. [`parse`] never fails: what it cannot read it tells and leaves out.

pub mod tree;

//! Panels: from the words of a panel to outlines with named edges.

pub mod edge;

use super::Evaluator;
use super::fields::Fields;
use super::item::{ItemId, State};
use super::scope::BindingId;
use super::value::Value;
use std::rc::Rc;

/// Number of an instance.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct InstanceId(pub(super) usize);

/// A panel's block opened with certain values of its fitted names.
pub(super) struct Instance<'t> {
    pub fields: Fields<'t>,
    pub draft: State<Option<Rc<Draft>>>,
}

/// How a panel stands to the wearer, which names the halves of an unfolded piece.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Standing {
    Before,
    Behind,
}

/// A panel drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct Draft {}

impl<'t> Evaluator<'t> {
    pub(super) fn draft(&mut self, _id: ItemId) -> Option<Draft> {
        None
    }
    pub(super) fn own_edge(&mut self, _instance: InstanceId, _binding: BindingId) -> Value {
        Value::Poison
    }
}

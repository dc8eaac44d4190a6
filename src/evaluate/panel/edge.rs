//! References to edges and to places on panels.

use super::super::Evaluator;
use super::super::fields::Arg;
use super::super::item::ItemId;
use super::super::scope::ScopeId;
use super::super::value::Value;
use crate::diagnostic::Span;
use crate::syntax::tree::{Expr, Name};

/// Which half or copy.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Which {}
/// An edge of a panel, or a part of it.
#[derive(Clone, Debug, PartialEq)]
pub struct EdgeRef {}
/// A place on a panel.
#[derive(Clone, Debug, PartialEq)]
pub struct Mark {
    /// place
    pub at: [f64; 2],
}

impl<'t> Evaluator<'t> {
    pub(in super::super) fn within(&mut self, _v: &Value, _e: &'t Expr, _s: Span) -> Value {
        Value::Poison
    }
    pub(in super::super) fn panel_member(
        &mut self,
        _id: ItemId,
        _w: Option<Which>,
        _n: &'t Name,
        _s: Span,
    ) -> Value {
        Value::Poison
    }
    pub(in super::super) fn members_of_panels(
        &mut self,
        _id: &[ItemId],
        _n: &'t Name,
        _s: Span,
    ) -> Value {
        Value::Poison
    }
    pub(in super::super) fn edge_member(
        &mut self,
        _e: Vec<EdgeRef>,
        _n: &'t Name,
        _s: Span,
    ) -> Value {
        Value::Poison
    }
    pub(in super::super) fn edge_part(
        &mut self,
        _e: Vec<EdgeRef>,
        _n: &'t Expr,
        _f: Option<&'t Name>,
        _sc: ScopeId,
        _s: Span,
    ) -> Value {
        Value::Poison
    }
    pub(in super::super) fn edge_at(&mut self, _e: &[EdgeRef], _a: Arg<'t>, _s: Span) -> Value {
        Value::Poison
    }
    pub(in super::super) fn measure(&mut self, _w: ItemId, _n: &'t Name) -> Value {
        Value::Poison
    }
    pub(in super::super) fn measure_member(&mut self, _w: ItemId, _m: &str, _n: &'t Name) -> Value {
        Value::Poison
    }
    pub(in super::super) fn measure_length(
        &mut self,
        _w: ItemId,
        _m: &str,
        _s: Span,
    ) -> Option<f64> {
        None
    }
    pub(in super::super) fn file(&mut self, _names: &[String]) -> Vec<crate::garment::Garment> {
        let (_s, _f) = self.open_files();
        self.make_all(self.root);
        self.check_parameters();
        Vec::new()
    }
}

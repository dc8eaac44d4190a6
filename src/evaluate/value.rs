//! What an expression can be worth.

use super::item::ItemId;
use super::panel::edge::{EdgeRef, Mark, Which};
use super::words::Kind;
use crate::textile::Colour;
use crate::units::{Dimension, Quantity};
use std::rc::Rc;

/// Single values that a value may be made of: parts of a list, edges of a row.
pub(super) const LARGEST: usize = 10_000;

/// Letters of a text that count as one value.
pub(super) const LETTERS: usize = 64;

/// A value.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// Something wrong that has been told already; whatever is made of it stays silent.
    Poison,
    /// A number with its dimension.
    Quantity(Quantity),
    /// Yes or no.
    Bool(bool),
    /// A text.
    Text(String),
    /// A colour.
    Colour(Colour),
    /// One of a parameter's options.
    Word(Rc<Chosen>),
    /// A point or vector of two or three parts of one dimension.
    Vector(Vector),
    /// From, to, both included.
    Range(Quantity, Quantity),
    /// `[a, b]`
    List(Rc<[Value]>),
    /// `{ a: 1cm, b: 2cm }`, in the order of the text.
    Record(Rc<[(String, Value)]>),
    /// A panel, fabric, wearer, …
    Item(ItemId),
    /// Several panels of one name, `gore[1..6]`.
    Items(Vec<ItemId>),
    /// A panel of which a half or a copy is meant: `sleeve.left`.
    Half(ItemId, Which),
    /// A measure or a place of a wearer: `lady.waist`.
    Measure {
        /// The wearer.
        wearer: ItemId,
        /// Its name as the body knows it: `waist`, `shoulder.left`.
        name: String,
    },
    /// Edges one after the other.
    Edges(Vec<EdgeRef>),
    /// A place on a panel.
    Mark(Mark),
}

/// What was chosen among the options of a parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct Chosen {
    /// The option.
    pub word: String,
    /// All that there are.
    pub options: Vec<String>,
    /// The parameter.
    pub name: String,
}

/// Two or three numbers of one dimension.
#[derive(Clone, Debug, PartialEq)]
pub struct Vector {
    /// Their dimension; a vector of zeros fits every one.
    pub dimension: Dimension,
    /// In SI units.
    pub parts: Vec<f64>,
}

impl Vector {
    /// Whether it can stand where `dimension` is wanted.
    pub fn fits(&self, dimension: Dimension) -> bool {
        self.dimension == dimension
            || (self.dimension.is_number() && self.parts.iter().all(|&part| part == 0.0))
    }
}

impl Value {
    /// A pure number.
    pub fn number(value: f64) -> Value {
        Value::Quantity(Quantity::number(value))
    }

    /// A length in metres.
    pub fn length(value: f64) -> Value {
        Value::Quantity(Quantity::length(value))
    }

    /// A point of the drawing, m.
    pub fn point(at: [f64; 2]) -> Value {
        Value::Vector(Vector { dimension: Dimension::LENGTH, parts: at.to_vec() })
    }

    /// How many single values it is made of, counted up to `most`; so many letters of a text
    /// count as one.
    pub(super) fn bulk(&self, most: usize) -> usize {
        let sum = |values: &mut dyn Iterator<Item = &Value>| {
            let mut sum = 1;
            for value in values {
                if sum >= most {
                    break;
                }
                sum += value.bulk(most - sum);
            }
            sum
        };
        match self {
            Value::List(values) => sum(&mut values.iter()),
            Value::Record(fields) => sum(&mut fields.iter().map(|(_, value)| value)),
            Value::Text(text) => 1 + text.len() / LETTERS,
            Value::Edges(edges) => edges.len(),
            Value::Items(items) => items.len(),
            _ => 1,
        }
    }

    /// What it is, for messages: `a length`, `a panel`. Items are told by their kind.
    pub fn describe(&self, kind_of: impl Fn(ItemId) -> Kind) -> String {
        match self {
            Value::Poison => "something wrong".to_owned(),
            Value::Quantity(quantity) => quantity.dimension.name().to_owned(),
            Value::Bool(_) => "a yes or no".to_owned(),
            Value::Text(_) => "a text".to_owned(),
            Value::Colour(_) => "a colour".to_owned(),
            Value::Word(_) => "a word".to_owned(),
            Value::Vector(vector) if vector.dimension == Dimension::LENGTH => "a point".to_owned(),
            Value::Vector(_) => "a vector".to_owned(),
            Value::Range(..) => "a range".to_owned(),
            Value::List(_) => "a list".to_owned(),
            Value::Record(_) => "a record".to_owned(),
            Value::Item(id) => kind_of(*id).title().to_owned(),
            Value::Items(_) => "several panels".to_owned(),
            Value::Half(..) => "a panel".to_owned(),
            Value::Measure { .. } => "a place on a body".to_owned(),
            Value::Edges(edges) if edges.len() == 1 => "an edge".to_owned(),
            Value::Edges(_) => "a row of edges".to_owned(),
            Value::Mark(_) => "a place on a panel".to_owned(),
        }
    }
}

//! Rows as they come: columns with names and units, one row after the other.

/// What stands in a column.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shape {
    /// One number a row, or none.
    Number,
    /// Several numbers a row.
    List,
    /// A word a row.
    Text,
}

/// One column.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Field {
    /// Its name, without blanks.
    pub name: String,
    /// Unit of its numbers; `1` for pure numbers, empty for words.
    pub unit: String,
    /// What stands in it.
    pub shape: Shape,
}

impl Field {
    /// A column of numbers.
    pub fn number(name: impl Into<String>, unit: impl Into<String>) -> Self {
        Self { name: name.into(), unit: unit.into(), shape: Shape::Number }
    }

    /// A column of lists.
    pub fn list(name: impl Into<String>, unit: impl Into<String>) -> Self {
        Self { shape: Shape::List, ..Self::number(name, unit) }
    }

    /// A column of words.
    pub fn text(name: impl Into<String>) -> Self {
        Self { shape: Shape::Text, ..Self::number(name, "") }
    }
}

/// What stands at one place.
#[derive(Debug, Clone, PartialEq)]
pub enum Cell {
    /// A number; none where there is nothing to say.
    Number(Option<f64>),
    /// Several numbers.
    List(Vec<f64>),
    /// A word.
    Text(String),
}

impl From<f64> for Cell {
    /// A number that is not finite is none.
    fn from(x: f64) -> Self {
        Self::Number(x.is_finite().then_some(x))
    }
}

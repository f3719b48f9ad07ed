//! Columns with names and units: what an experiment yields.

use eigenbody::{Family, Posture};
use std::ops::Deref;

/// The cells of a column.
#[derive(Debug, Clone, PartialEq)]
pub enum Values {
    /// Numbers; none where there is nothing to say.
    Number(Vec<Option<f64>>),
    /// Words: the name of a curve, of a panel, of a joint.
    Text(Vec<String>),
}

impl Values {
    /// Number of cells.
    pub fn len(&self) -> usize {
        match self {
            Self::Number(cells) => cells.len(),
            Self::Text(cells) => cells.len(),
        }
    }

    /// True without cells.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// One column.
#[derive(Debug, Clone, PartialEq)]
pub struct Column {
    /// Its name, without blanks.
    pub name: &'static str,
    /// Unit of its numbers; `1` for pure numbers, empty for words.
    pub unit: &'static str,
    /// Its cells.
    pub values: Values,
}

/// Rows under named columns.
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    columns: Vec<Column>,
    /// A row and the robot that it is about, rows ascending.
    subjects: Vec<(usize, Subject)>,
}

/// The robot that a row is about, and how it stands.
#[derive(Debug, Clone, PartialEq)]
pub struct Subject {
    /// Which.
    pub robot: Family,
    /// How.
    pub posture: Posture,
}

/// A [`Table`] to which rows of W words and N numbers are added.
///
/// ```
/// use eigenbody_study::Rows;
/// let mut table = Rows::new(&[("curve", "")], &[("N", "1"), ("kappa", "1")]);
/// table.push(["θ = 0".into()], [Some(2.0), Some(43.9)]);
/// assert_eq!(table.number("kappa"), [Some(43.9)]);
/// ```
/// A row of another width is none:
///
/// ```compile_fail
/// # use eigenbody_study::Rows;
/// # let mut table = Rows::new(&[("curve", "")], &[("N", "1"), ("kappa", "1")]);
/// table.push(["θ = 0".into()], [Some(2.0), Some(43.9), Some(0.1)]);
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Rows<const W: usize, const N: usize>(Table);

impl<const W: usize, const N: usize> Rows<W, N> {
    /// No rows yet; columns of words stand before columns of numbers. Each is a name and a unit.
    pub fn new(
        words: &[(&'static str, &'static str); W],
        numbers: &[(&'static str, &'static str); N],
    ) -> Self {
        let text = words.iter().map(|&(name, unit)| Column { name, unit, values: Values::Text(Vec::new()) });
        let number =
            numbers.iter().map(|&(name, unit)| Column { name, unit, values: Values::Number(Vec::new()) });
        Self(Table { columns: text.chain(number).collect(), subjects: Vec::new() })
    }

    /// Adds a row: first the words, then the numbers.
    pub fn push(&mut self, words: [String; W], numbers: [Option<f64>; N]) {
        let (mut words, mut numbers) = (words.into_iter(), numbers.into_iter());
        for column in &mut self.0.columns {
            match &mut column.values {
                Values::Text(cells) => cells.extend(words.next()),
                Values::Number(cells) => cells.extend(numbers.next()),
            }
        }
    }

    /// Says which robot the last row is about.
    pub fn about(&mut self, robot: Family, posture: Posture) {
        if let Some(last) = self.rows().checked_sub(1) {
            self.0.subjects.push((last, Subject { robot, posture }));
        }
    }
}

impl<const W: usize, const N: usize> Deref for Rows<W, N> {
    type Target = Table;

    fn deref(&self) -> &Table {
        &self.0
    }
}

impl<const W: usize, const N: usize> From<Rows<W, N>> for Table {
    fn from(rows: Rows<W, N>) -> Self {
        rows.0
    }
}

impl Table {
    /// The robot that a row is about, where rows are about one each.
    pub fn subject(&self, row: usize) -> Option<&Subject> {
        let k = self.subjects.binary_search_by_key(&row, |subject| subject.0).ok()?;
        Some(&self.subjects[k].1)
    }

    /// All columns, in order.
    pub fn columns(&self) -> &[Column] {
        &self.columns
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.columns.first().map_or(0, |column| column.values.len())
    }

    /// The numbers of a column; none at all if there is no such column of numbers.
    pub fn number(&self, name: &str) -> &[Option<f64>] {
        match self.columns.iter().find(|column| column.name == name).map(|column| &column.values) {
            Some(Values::Number(cells)) => cells,
            _ => &[],
        }
    }

    /// The words of a column; none at all if there is no such column of words.
    pub fn text(&self, name: &str) -> &[String] {
        match self.columns.iter().find(|column| column.name == name).map(|column| &column.values) {
            Some(Values::Text(cells)) => cells,
            _ => &[],
        }
    }

    /// (x, y) of the rows whose word in column `curve` is `name`, where both numbers are there.
    pub fn points(&self, curve: &str, name: &str, x: &str, y: &str) -> Vec<(f64, f64)> {
        let cells = self.number(x).iter().zip(self.number(y));
        let rows = self.text(curve).iter().zip(cells).filter(|(word, _)| *word == name);
        rows.filter_map(|(_, (&x, &y))| x.zip(y)).collect()
    }

    /// The different words of a column, in the order in which they first appear.
    pub fn distinct(&self, name: &str) -> Vec<&str> {
        let mut found: Vec<&str> = Vec::new();
        for word in self.text(name) {
            if !found.contains(&word.as_str()) {
                found.push(word);
            }
        }
        found
    }
}

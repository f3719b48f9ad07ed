//! What a sweep's file says.

use thiserror::Error;

use super::document;
use super::quantity::Quantity;

/// A place in a sweep's file, and what is wrong there.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{line}:{column}: {what}")]
pub struct SpecError {
    /// Line, from 1.
    pub line: usize,
    /// Column, from 1.
    pub column: usize,
    /// What is wrong, and what was expected.
    pub what: String,
}

/// A sweep: robots, configurations, and what is computed of each.
///
/// ```toml
/// seed = 7
/// quantities = ["kappa", "kappa_weighted", "eigenvalues"]
///
/// [[robots]]
/// family = "hydra"
/// n = { from = 10, to = 100, count = 10 }
/// branching = [1.0, 1.5, 2.0]
/// at = ["zag(0)", "curl(0.1)"]
///
/// [[robots]]
/// model = ["arm.urdf", "humanoid.xml"]
/// base = ["fixed", "floating"]
/// random = 1000
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Spec {
    /// Of everything random.
    pub seed: u64,
    /// B, as the command line writes it.
    pub metric: String,
    /// Columns to compute.
    pub quantities: Vec<Quantity>,
    /// Groups of robots, one after the other.
    pub groups: Vec<Group>,
}

/// Robots with the same configurations.
#[derive(Debug, Clone, PartialEq)]
pub struct Group {
    /// Which robots.
    pub robots: Robots,
    /// `fixed` or `floating`, one robot each.
    pub floating: Vec<bool>,
    /// Mimic joints follow; none for what the command line does.
    pub mimic: Option<bool>,
    /// The floating base is removed.
    pub reduced: bool,
    /// Configurations by their expressions.
    pub at: Vec<String>,
    /// Where they stand in the text: all that they are is their expressions.
    pub places: Places,
    /// So many random ones besides.
    pub random: u64,
}

/// Lines and columns of a group's configurations. They say nothing about the sweep: two specs that differ in them alone are the same.
#[derive(Debug, Clone, Default)]
pub struct Places(pub(super) Vec<(usize, usize)>);

impl Places {
    /// An error at configuration k.
    pub fn error(&self, k: usize, what: String) -> SpecError {
        let (line, column) = self.0.get(k).copied().unwrap_or((1, 1));
        SpecError { line, column, what }
    }
}

impl PartialEq for Places {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

/// Which robots a group has.
#[derive(Debug, Clone, PartialEq)]
pub enum Robots {
    /// Files, or anything else that names a model.
    Models(Vec<String>),
    /// A family, over a grid of parameters or a sample of them.
    Family {
        /// hydra, onion or auto_tree.
        name: String,
        /// n, branching, skew, taper.
        axes: [Axis; 4],
        /// So many random points instead of the grid.
        sample: Option<u64>,
    },
}

/// The values of a parameter.
#[derive(Debug, Clone, PartialEq)]
pub enum Axis {
    /// As they stand.
    Values(Vec<f64>),
    /// Between two ends.
    Range {
        /// First value.
        from: f64,
        /// Last value.
        to: f64,
        /// So many, evenly; for a sample, none.
        count: Option<u64>,
        /// Evenly in the logarithm.
        log: bool,
    },
}

impl Axis {
    /// Number of values on a grid.
    pub fn len(&self) -> u64 {
        match self {
            Self::Values(values) => values.len() as u64,
            Self::Range { count, .. } => count.unwrap_or(0),
        }
    }

    /// True if a grid has no value.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Value k of a grid.
    pub fn value(&self, k: u64) -> f64 {
        match self {
            Self::Values(values) => values[k as usize],
            Self::Range { count, .. } => {
                let last = count.unwrap_or(1).saturating_sub(1).max(1);
                self.between(k as f64 / last as f64)
            }
        }
    }

    /// The value at u of [0, 1).
    pub fn at(&self, u: f64) -> f64 {
        match self {
            Self::Values(values) => values[((u * values.len() as f64) as usize).min(values.len() - 1)],
            Self::Range { .. } => self.between(u),
        }
    }

    fn between(&self, u: f64) -> f64 {
        match *self {
            Self::Range { from, to, log: true, .. } if u < 1.0 => from * (to / from).powf(u),
            Self::Range { from, to, .. } if u < 1.0 => from + u * (to - from),
            Self::Range { to, .. } => to,
            Self::Values(_) => f64::NAN,
        }
    }
}

impl Spec {
    /// Reads a sweep's file. Errors: [`SpecError`], with its place.
    pub fn parse(text: &str) -> Result<Self, SpecError> {
        document::read(text)
    }
}

//! The columns of a sweep.

use eigenbody::Conditioning;
use serde::Deserialize;

use crate::{Cell, Field};

/// One column of a sweep.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Quantity {
    /// κ.
    Kappa,
    /// κ′.
    KappaWeighted,
    /// λmin.
    LambdaMin,
    /// λmax.
    LambdaMax,
    /// r.
    DiagonalRatio,
    /// r and r κ′.
    Bracket,
    /// Estimated relative error of λmin.
    ErrorEstimate,
    /// All eigenvalues, ascending.
    Eigenvalues,
    /// The mode of λmin.
    Softest,
    /// The mode of λmax.
    Stiffest,
    /// The configuration.
    Q,
}

impl Quantity {
    /// What a file that names none gets.
    pub const USUAL: [Self; 4] = [Self::Kappa, Self::KappaWeighted, Self::LambdaMin, Self::LambdaMax];

    /// Its column; `unit` is that of eigenvalues.
    pub fn field(self, unit: &str) -> Field {
        match self {
            Self::Kappa => Field::number("kappa", "1"),
            Self::KappaWeighted => Field::number("kappa_weighted", "1"),
            Self::LambdaMin => Field::number("lambda_min", unit),
            Self::LambdaMax => Field::number("lambda_max", unit),
            Self::DiagonalRatio => Field::number("diagonal_ratio", "1"),
            Self::Bracket => Field::list("bracket", "1"),
            Self::ErrorEstimate => Field::number("error_estimate", "1"),
            Self::Eigenvalues => Field::list("eigenvalues", unit),
            Self::Softest => Field::list("softest", "1"),
            Self::Stiffest => Field::list("stiffest", "1"),
            Self::Q => Field::list("q", "rad, m, 1"),
        }
    }

    /// Its value; a number that does not exist is none, a list empty.
    pub fn cell(self, answer: &Conditioning<f64>, q: &[f64]) -> Cell {
        let number = |x: Option<f64>| Cell::from(x.unwrap_or(f64::NAN));
        let list = |x: &Option<Vec<f64>>| Cell::List(x.clone().unwrap_or_default());
        match self {
            Self::Kappa => number(answer.kappa),
            Self::KappaWeighted => number(answer.kappa_weighted),
            Self::LambdaMin => number(answer.lambda_min),
            Self::LambdaMax => number(answer.lambda_max),
            Self::DiagonalRatio => number(answer.diagonal_ratio),
            Self::Bracket => Cell::List(answer.bracket.map_or_else(Vec::new, |(low, high)| vec![low, high])),
            Self::ErrorEstimate => number(answer.error_estimate[0]),
            Self::Eigenvalues => list(&answer.eigenvalues),
            Self::Softest => list(&answer.softest),
            Self::Stiffest => list(&answer.stiffest),
            Self::Q => Cell::List(q.to_vec()),
        }
    }
}

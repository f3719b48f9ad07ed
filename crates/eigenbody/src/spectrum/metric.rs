//! What counts as a unit of motion.
//!
//! The mass matrix maps velocities to momenta, two different spaces: its eigenvalues depend on a choice of metric B
//! (Featherstone 2004, §2). Every metric here is diagonal: a unit of length for each DoF.

use crate::error::InputError;
use crate::matrix::Matrix;
use crate::model::Model;
use crate::scalar::Real;
use std::fmt;

/// The metric B of H x = λ B x.
#[derive(Debug, Clone, PartialEq)]
pub enum Metric<T> {
    /// B = 1: a radian counts as much as a metre. κ is κ(H).
    Euclidean,
    /// B = diag(H): each DoF in units of its own inertia (Featherstone 2004, §4.7). κ is κ′.
    UnitDiagonal,
    /// B = 1 for rotations, 1/ℓ² for translations: ℓ metres count as much as a radian.
    Length(T),
    /// B as given, one positive number a DoF.
    Diagonal(Vec<T>),
}

impl<T: Real> Metric<T> {
    /// B_dd of every DoF of `model`, whose mass matrix is `H`.
    ///
    /// For the matrix of a part of the DoFs (mimic joints reduced, base removed) use [`weights_of`](Self::weights_of).
    ///
    /// Errors: [`InputError::NotPositive`] for a weight or a diagonal entry that is not positive; [`InputError::Length`].
    pub fn weights(&self, model: &Model<T>, H: &Matrix<T>) -> Result<Vec<T>, InputError> {
        self.weights_of(H, |d| model.is_translation(d))
    }

    /// B_dd of every row of `H`; `is_translation` tells metres from radians.
    ///
    /// Errors: as [`weights`](Self::weights).
    pub fn weights_of(
        &self,
        H: &Matrix<T>,
        is_translation: impl Fn(usize) -> bool,
    ) -> Result<Vec<T>, InputError> {
        let diagonal: Vec<T> = (0..H.rows()).map(|d| H[(d, d)]).collect();
        self.weights_for(&diagonal, is_translation)
    }

    /// B_dd of every DoF of a matrix with this diagonal.
    ///
    /// Errors: as [`weights`](Self::weights).
    pub fn weights_for(
        &self,
        diagonal: &[T],
        is_translation: impl Fn(usize) -> bool,
    ) -> Result<Vec<T>, InputError> {
        let n = diagonal.len();
        let (what, weights): (_, Vec<T>) = match self {
            Self::Euclidean => ("B", vec![T::ONE; n]),
            Self::UnitDiagonal => ("diagonal of H", diagonal.to_vec()),
            Self::Length(length) => {
                let translation = T::ONE / (*length * *length);
                ("B", (0..n).map(|d| if is_translation(d) { translation } else { T::ONE }).collect())
            }
            Self::Diagonal(weights) => ("B", weights.clone()),
        };
        if weights.len() != n {
            return Err(InputError::Length { what, expected: n, found: weights.len() });
        }
        match weights.iter().position(|&b| !(b > T::ZERO && b.is_finite())) {
            Some(index) => Err(InputError::NotPositive { what, index, value: weights[index].to_f64() }),
            None => Ok(weights),
        }
    }

    /// Unit of the eigenvalues over DoFs of which some are translations.
    pub fn unit(&self, is_translation: impl Iterator<Item = bool>) -> &'static str {
        let (mut rotations, mut translations) = (false, false);
        is_translation
            .for_each(|translation| *(if translation { &mut translations } else { &mut rotations }) = true);
        match self {
            Self::UnitDiagonal => "",
            Self::Length(_) => "kg m²",
            _ if rotations && translations => "(kg m² and kg mixed)",
            _ if translations => "kg",
            _ => "kg m²",
        }
    }
}

impl<T: Real> fmt::Display for Metric<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Euclidean => write!(f, "euclidean"),
            Self::UnitDiagonal => write!(f, "unit-diagonal"),
            Self::Length(length) => write!(f, "length={}", length.to_f64()),
            Self::Diagonal(_) => write!(f, "diagonal"),
        }
    }
}

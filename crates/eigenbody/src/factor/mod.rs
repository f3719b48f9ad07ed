//! Factorisations: of H along its tree, and of any symmetric matrix.
//!
//! Elimination of H runs from the tips inwards, so that no entry between different branches ever fills in (Featherstone 2008,
//! §6.5). Factorisations have the same doors: `new`, `factor`, `solve`, `inverse_into`, `reconstruct_into`.

mod cholesky;
mod coupled;
mod ltdl;
mod ltl;

pub use cholesky::Cholesky;
pub use coupled::{
    CoupledWorkspace, coupled_bias_force_into, coupled_forward_dynamics_into, coupled_inverse_dynamics_into,
};
pub use ltdl::Ltdl;
pub use ltl::Ltl;

use crate::error::{InputError, NotPositiveDefinite, check_length};
use crate::matrix::Matrix;
use crate::scalar::Real;

/// What a successful factorisation found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Info {
    /// DoF of the smallest pivot, and the pivot.
    pub smallest: (usize, f64),
    /// DoF of the largest pivot, and the pivot.
    pub largest: (usize, f64),
}

impl Info {
    const EMPTY: Self = Self { smallest: (0, f64::INFINITY), largest: (0, 0.0) };

    /// Largest over smallest pivot.
    pub fn pivot_ratio(&self) -> f64 {
        self.largest.1 / self.smallest.1
    }

    /// Takes note of a pivot, and refuses one that is not positive.
    fn accept<T: Real>(&mut self, dof: usize, pivot: T) -> Result<(), NotPositiveDefinite> {
        let value = pivot.to_f64();
        if !(pivot > T::ZERO && value.is_finite()) {
            return Err(NotPositiveDefinite { dof, pivot: value });
        }
        if value < self.smallest.1 {
            self.smallest = (dof, value);
        }
        if value > self.largest.1 {
            self.largest = (dof, value);
        }
        Ok(())
    }
}

fn check_square<T: Real>(what: &'static str, A: &Matrix<T>, n: usize) -> Result<(), InputError> {
    check_length(what, A.rows(), n)?;
    check_length(what, A.cols(), n)
}

/// The inverse column by column, both triangles, from any solver.
fn inverse_by_columns<T: Real>(inverse: &mut Matrix<T>, mut solve: impl FnMut(&mut [T])) {
    let n = inverse.rows();
    inverse.fill(T::ZERO);
    for d in 0..n {
        // H⁻¹ is symmetric: its columns are its rows.
        let row = inverse.row_mut(d);
        row[d] = T::ONE;
        solve(row);
    }
    for d in 0..n {
        for e in 0..d {
            let mean = (inverse[(d, e)] + inverse[(e, d)]) * T::from_f64(0.5);
            inverse[(d, e)] = mean;
            inverse[(e, d)] = mean;
        }
    }
}

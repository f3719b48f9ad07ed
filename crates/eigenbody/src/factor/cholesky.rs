//! A = L Lᵀ of any symmetric matrix that is positive definite.
//!
//! ```text
//! for k = 1..n:  for j = 1..k:   L_kj = (A_kj − Σ_{m<j} L_km L_jm) / L_jj
//!                                L_kk = √(A_kk − Σ_{m<k} L_km²)
//! ```
//! For matrices without a tree: H* of a free-floating base, GᵀHG of mimic joints, H shifted by stiffness and damping. Cost n³/3.

use super::{Info, check_square, inverse_by_columns};
use crate::error::{Error, check_length};
use crate::matrix::Matrix;
use crate::scalar::Real;

/// The factor L of A = L Lᵀ, with room for it.
///
/// ```
/// use eigenbody::{Matrix, factor::Cholesky};
/// let A = Matrix::from_fn(2, 2, |i, j| if i == j { 2.0 } else { 1.0 });
/// let mut factor = Cholesky::new(2);
/// factor.factor(&A)?;
/// let mut x = [3.0, 3.0];
/// factor.solve(&mut x)?;
/// assert!(x.iter().all(|x: &f64| (x - 1.0).abs() < 1e-15));
/// # Ok::<(), eigenbody::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Cholesky<T> {
    L: Matrix<T>,
}

impl<T: Real> Cholesky<T> {
    /// Room for the factor of an n × n matrix.
    pub fn new(n: usize) -> Self {
        Self { L: Matrix::zeros(n, n) }
    }

    /// The factor as it stands; nothing above the diagonal.
    pub fn l(&self) -> &Matrix<T> {
        &self.L
    }

    /// A = L Lᵀ, from the lower triangle. Allocates nothing.
    ///
    /// Errors: [`InputError::Length`](crate::InputError::Length); [`NotPositiveDefinite`](crate::NotPositiveDefinite) at the first pivot that is not positive,
    /// after which the factor must not be used.
    pub fn factor(&mut self, A: &Matrix<T>) -> Result<Info, Error> {
        check_square("A", A, self.L.rows())?;
        let L = &mut self.L;
        let mut info = Info::EMPTY;
        for k in 0..L.rows() {
            for j in 0..k {
                let (row_j, row_k) = L.row_pair(j, k);
                let sum = (0..j).fold(A[(k, j)], |sum, m| sum - row_k[m] * row_j[m]);
                row_k[j] = sum / row_j[j];
            }
            let row = L.row_mut(k);
            let pivot = (0..k).fold(A[(k, k)], |sum, m| sum - row[m] * row[m]);
            info.accept(k, pivot)?;
            row[k] = pivot.sqrt();
        }
        Ok(info)
    }

    /// x ← A⁻¹ x. Cost n²; allocates nothing. Errors: [`InputError::Length`](crate::InputError::Length).
    pub fn solve(&self, x: &mut [T]) -> Result<(), Error> {
        check_length("x", x.len(), self.L.rows())?;
        self.solve_in_place(x);
        Ok(())
    }

    fn solve_in_place(&self, x: &mut [T]) {
        let L = &self.L;
        let n = L.rows();
        for k in 0..n {
            x[k] = (0..k).fold(x[k], |sum, m| sum - L[(k, m)] * x[m]) / L[(k, k)];
        }
        for k in (0..n).rev() {
            x[k] = (k + 1..n).fold(x[k], |sum, m| sum - L[(m, k)] * x[m]) / L[(k, k)];
        }
    }

    /// A⁻¹, both triangles. Cost n³; allocates nothing. Errors: [`InputError::Length`](crate::InputError::Length).
    pub fn inverse_into(&self, inverse: &mut Matrix<T>) -> Result<(), Error> {
        check_square("inverse", inverse, self.L.rows())?;
        inverse_by_columns(inverse, |x| self.solve_in_place(x));
        Ok(())
    }

    /// L Lᵀ, both triangles: A again, for checking. Allocates nothing. Errors: [`InputError::Length`](crate::InputError::Length).
    pub fn reconstruct_into(&self, A: &mut Matrix<T>) -> Result<(), Error> {
        check_square("A", A, self.L.rows())?;
        let L = &self.L;
        for i in 0..L.rows() {
            for j in 0..L.rows() {
                A[(i, j)] = (0..=i.min(j)).fold(T::ZERO, |sum, m| sum + L[(i, m)] * L[(j, m)]);
            }
        }
        Ok(())
    }
}

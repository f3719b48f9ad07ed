//! H = L Lᵀ, dense.
//!
//! ```text
//! for k = 1..n:   L_kj = (H_kj − Σ_{m<j} L_km L_jm) / L_jj  for j < k      L_kk = √(H_kk − Σ_{m<k} L_km²)
//! ```
//! Golub & Van Loan, *Matrix Computations* (2013), §4.2. What a library without the tree would do: O(n³/3).

use eigenbody::scalar::Real;
use eigenbody::{Matrix, NotPositiveDefinite};

/// The factor L.
#[derive(Debug, Clone)]
pub struct Cholesky<T>(Matrix<T>);

impl<T: Real> Cholesky<T> {
    /// Factorises H. O(n³/3); allocates.
    ///
    /// Errors: [`NotPositiveDefinite`] at the first pivot that is not positive.
    ///
    /// ```
    /// use eigenbody::Matrix;
    /// let H = Matrix::from_fn(2, 2, |i, j| if i == j { 2.0 } else { 1.0 });
    /// let mut x = [3.0, 3.0];
    /// eigenbody_study::Cholesky::new(&H)?.solve(&mut x);
    /// assert!((x[0] - 1.0).abs() < 1e-15 && (x[1] - 1.0f64).abs() < 1e-15);
    /// # Ok::<(), eigenbody::NotPositiveDefinite>(())
    /// ```
    pub fn new(H: &Matrix<T>) -> Result<Self, NotPositiveDefinite> {
        let n = H.rows();
        let mut L = Matrix::zeros(n, n);
        for k in 0..n {
            for j in 0..=k {
                let left = (0..j).fold(H[(k, j)], |left, m| left - L[(k, m)] * L[(j, m)]);
                if j < k {
                    L[(k, j)] = left / L[(j, j)];
                } else if left > T::ZERO && left.is_finite() {
                    L[(k, k)] = left.sqrt();
                } else {
                    return Err(NotPositiveDefinite { dof: k, pivot: left.to_f64() });
                }
            }
        }
        Ok(Self(L))
    }

    /// x ← H⁻¹ x. O(n²); allocates nothing.
    pub fn solve(&self, x: &mut [T]) {
        let L = &self.0;
        for k in 0..x.len() {
            x[k] = (0..k).fold(x[k], |left, m| left - L[(k, m)] * x[m]) / L[(k, k)];
        }
        for k in (0..x.len()).rev() {
            x[k] = (k + 1..x.len()).fold(x[k], |left, m| left - L[(m, k)] * x[m]) / L[(k, k)];
        }
    }
}

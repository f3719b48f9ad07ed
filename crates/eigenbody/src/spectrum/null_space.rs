//! An orthonormal basis of all x with A x = 0.
//!
//! ```text
//! Aᵀ P = Q R      by Householder reflections, the longest remaining column first
//! rank r: the columns whose remaining length exceeds the tolerance times the first one's
//! N = the last n − r columns of Q
//! ```
//! Golub & Van Loan (2013), §5.4.2.

use crate::error::InputError;
use crate::matrix::Matrix;
use crate::model::check;

/// The null space of a matrix.
#[derive(Debug, Clone, PartialEq)]
pub struct NullSpace {
    /// n × (n − rank): orthonormal columns.
    pub basis: Matrix<f64>,
    /// Number of independent rows of A.
    pub rank: usize,
}

/// The null space of the m × n matrix A.
///
/// Rows whose part outside the rows before them is shorter than `tolerance` times the longest row count as dependent. Cost
/// O(m n rank + n² rank); allocates. Numerics: N is orthonormal to a few n ε, and ‖A N‖ is of order n ε ‖A‖ + tolerance ‖A‖.
/// A is scaled by a power of two, so that no square overflows.
///
/// Errors: [`InputError::NotFinite`], at an entry counted row by row.
///
/// ```
/// use eigenbody::{Matrix, spectrum::null_space};
/// let A = Matrix::from_fn(2, 3, |_, j| [1.0, 1.0, 0.0][j]);
/// let found = null_space(&A, 1e-12)?;
/// assert_eq!((found.rank, found.basis.cols()), (1, 2));
/// # Ok::<(), eigenbody::InputError>(())
/// ```
pub fn null_space(A: &Matrix<f64>, tolerance: f64) -> Result<NullSpace, InputError> {
    let (m, n) = (A.rows(), A.cols());
    check("A", A.as_slice(), m * n)?;
    let unit = (-A.max_abs().log2().floor()).clamp(-1000.0, 1000.0).exp2();
    // The columns of Aᵀ.
    let mut columns: Vec<Vec<f64>> = (0..m).map(|i| A.row(i).iter().map(|a| a * unit).collect()).collect();
    let mut reflections: Vec<Vec<f64>> = Vec::new();
    let mut first = 0.0;
    while reflections.len() < n && !columns.is_empty() {
        let k = reflections.len();
        let length = |c: &Vec<f64>| c[k..].iter().map(|x| x * x).sum::<f64>().sqrt();
        let (mut longest, mut norm) = (0, -1.0);
        for (j, column) in columns.iter().enumerate() {
            let own = length(column);
            if own > norm {
                (longest, norm) = (j, own);
            }
        }
        if k == 0 {
            first = norm;
        }
        if norm <= tolerance * first || norm == 0.0 {
            break;
        }
        let mut u = columns.swap_remove(longest);
        u[..k].fill(0.0);
        u[k] += norm.copysign(u[k]);
        let size = u.iter().map(|x| x * x).sum::<f64>().sqrt();
        u.iter_mut().for_each(|x| *x /= size);
        columns.iter_mut().for_each(|column| reflect(&u, column));
        reflections.push(u);
    }
    let rank = reflections.len();
    let mut basis = Matrix::zeros(n, n - rank);
    for j in 0..n - rank {
        let mut x = vec![0.0; n];
        x[rank + j] = 1.0;
        reflections.iter().rev().for_each(|u| reflect(u, &mut x));
        x.iter().enumerate().for_each(|(i, &x)| basis[(i, j)] = x);
    }
    Ok(NullSpace { basis, rank })
}

/// x − 2 u uᵀx.
fn reflect(u: &[f64], x: &mut [f64]) {
    let along: f64 = 2.0 * u.iter().zip(x.iter()).map(|(u, x)| u * x).sum::<f64>();
    x.iter_mut().zip(u).for_each(|(x, u)| *x -= along * u);
}

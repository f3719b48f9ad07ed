//! Estimates of κ that need no eigenvalues (Shah & Saha 2013, §4), and the bracket.

use eigenbody::{Conditioning, Error, Matrix, conditioning};

/// κ of one mass matrix beside what is said to estimate it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Estimates {
    /// κ = λmax/λmin.
    pub kappa: f64,
    /// r = δ = max H_dd / min H_dd.
    pub diagonal_ratio: f64,
    /// Largest over smallest pivot of Gaussian elimination.
    pub pivot_ratio: f64,
    /// r ≤ κ ≤ r κ′, always.
    pub bracket: (f64, f64),
}

/// κ and its estimates in the Euclidean metric.
///
/// | name | shape | unit |
/// |------|-------|------|
/// | `H` | n × n, symmetric positive definite | kg m², kg m, kg |
///
/// Method: dense eigenproblem and elimination, O(n³); allocates. A value that does not exist, as for a singular H, is not a number.
///
/// Errors: as [`conditioning()`].
///
/// ```
/// use eigenbody::{Family, mass_matrix};
/// let chain = Family::slender_chain(4, 2.2, 1.0)?.model::<f64>()?;
/// let found = eigenbody_study::estimators::estimates(&mass_matrix(&chain, &[0.0; 4])?)?;
/// assert!((found.kappa - 1074.4395).abs() < 1e-3 && (found.diagonal_ratio - 64.0).abs() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn estimates(H: &Matrix<f64>) -> Result<Estimates, Error> {
    let Conditioning { kappa, diagonal_ratio, bracket, .. } = conditioning(H, &vec![1.0; H.rows()])?;
    Ok(Estimates {
        kappa: kappa.unwrap_or(f64::NAN),
        diagonal_ratio: diagonal_ratio.unwrap_or(f64::NAN),
        pivot_ratio: pivot_ratio(H),
        bracket: bracket.unwrap_or((f64::NAN, f64::NAN)),
    })
}

/// Largest over smallest pivot of Gaussian elimination from the first row on, without exchanges.
///
/// ```text
/// for k = 1..n:   H_ij −= H_ik H_kj / H_kk   for i, j > k      pivots H_kk
/// ```
/// O(n³); allocates. A pivot of zero gives an infinite or undefined ratio, as it must.
///
/// ```
/// use eigenbody::Matrix;
/// let H = Matrix::from_fn(2, 2, |i, j| if i == j { 2.0 } else { 1.0 });
/// assert_eq!(eigenbody_study::estimators::pivot_ratio(&H), 2.0 / 1.5);
/// ```
pub fn pivot_ratio(H: &Matrix<f64>) -> f64 {
    let n = H.rows();
    let mut A = H.clone();
    let (mut smallest, mut largest) = (f64::INFINITY, 0.0f64);
    for k in 0..n {
        let pivot = A[(k, k)];
        (smallest, largest) = (smallest.min(pivot.abs()), largest.max(pivot.abs()));
        for i in k + 1..n {
            let factor = A[(i, k)] / pivot;
            for j in k + 1..n {
                let eliminated = factor * A[(k, j)];
                A[(i, j)] -= eliminated;
            }
        }
    }
    largest / smallest
}

/// Pearson's correlation of two sequences.
pub fn correlation(x: &[f64], y: &[f64]) -> f64 {
    let n = x.len().min(y.len()) as f64;
    let (x0, y0) = (x.iter().sum::<f64>() / n, y.iter().sum::<f64>() / n);
    let product = |a: &[f64], a0: f64, b: &[f64], b0: f64| -> f64 {
        a.iter().zip(b).map(|(a, b)| (a - a0) * (b - b0)).sum()
    };
    product(x, x0, y, y0) / (product(x, x0, x, x0) * product(y, y0, y, y0)).sqrt()
}

/// The median of some numbers; not a number for none.
pub fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    match sorted.len() {
        0 => f64::NAN,
        n => 0.5 * (sorted[(n - 1) / 2] + sorted[n / 2]),
    }
}

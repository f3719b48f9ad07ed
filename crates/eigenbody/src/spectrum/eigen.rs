//! The dense symmetric eigenproblem in a diagonal metric.
//!
//! ```text
//! H x = λ B x      ⇔      (B^-½ H B^-½) y = λ y,   x = B^-½ y
//! ```

use super::ql::ql;
use super::tridiagonal::{back_transform, reduce};
use crate::error::{Error, InputError, check_length};
use crate::matrix::Matrix;
use crate::scalar::Real;

/// Eigenvalues, ascending, and eigenvectors of H x = λ B x.
#[derive(Debug, Clone, PartialEq)]
pub struct SymmetricEigen<T> {
    /// λ, ascending (unit of H_dd/B_dd).
    pub values: Vec<T>,
    /// Row k is the eigenvector of `values[k]`, with xᵀBx = 1 and its largest entry (weighed by B) positive.
    pub vectors: Matrix<T>,
}

/// Eigenvalues and eigenvectors of H x = λ B x, B diagonal.
///
/// | name | shape | unit |
/// |------|-------|------|
/// | `H` | n × n, symmetric | kg m², kg m, kg |
/// | `weights` | n, the diagonal of B, positive | see [`Metric`](super::Metric) |
///
/// Method: rows ordered by ascending diagonal, Householder reduction, implicit QL. O(n³); allocates. Numerics: backward stable:
/// every eigenvalue to a few ε·λmax, small eigenvalues of graded matrices usually far better; so λmin carries a relative
/// error up to a few ε·κ.
///
/// Errors: [`InputError::Length`]; [`InputError::NotPositive`] for a weight; [`InputError::NotFinite`] where an entry of B^-½ H B^-½ is
/// none; [`InputError::Overflow`] where an eigenvalue, or a number on the way to it, is beyond the range of T; [`Error::NoConvergence`]
/// (never seen within that range).
///
/// ```
/// use eigenbody::{Matrix, spectrum::eigen};
/// let H = Matrix::from_fn(2, 2, |i, j| if i == j { 2.0 } else { 1.0 });
/// let spectrum = eigen(&H, &[1.0, 1.0])?;
/// assert!((spectrum.values[0] - 1.0_f64).abs() < 1e-15 && (spectrum.values[1] - 3.0).abs() < 1e-15);
/// # Ok::<(), eigenbody::Error>(())
/// ```
pub fn eigen<T: Real>(H: &Matrix<T>, weights: &[T]) -> Result<SymmetricEigen<T>, Error> {
    let n = H.rows();
    let Scaled { mut A, order, units } = scale(H, weights)?;
    let (mut t, h) = reduce(&mut A);
    let mut V = Matrix::identity(n);
    ql(&mut t, Some(&mut V))?;
    back_transform(&A, &h, &mut V);
    check_range(&t.d)?;
    check_range(V.as_slice())?;

    let mut ascending: Vec<usize> = (0..n).collect();
    ascending.sort_by(|&i, &j| t.d[i].to_f64().total_cmp(&t.d[j].to_f64()));
    let mut vectors = Matrix::zeros(n, n);
    for (k, &i) in ascending.iter().enumerate() {
        orient(V.row_mut(i));
        let x = vectors.row_mut(k);
        for (place, &d) in order.iter().enumerate() {
            x[d] = V[(i, place)] * units[d];
        }
    }
    Ok(SymmetricEigen { values: ascending.iter().map(|&i| t.d[i]).collect(), vectors })
}

/// Eigenvalues of H x = λ B x alone, ascending. A third of the cost of [`eigen`]; the same numerics and errors.
pub fn eigenvalues<T: Real>(H: &Matrix<T>, weights: &[T]) -> Result<Vec<T>, Error> {
    let Scaled { mut A, .. } = scale(H, weights)?;
    let (mut t, _) = reduce(&mut A);
    ql(&mut t, None)?;
    check_range(&t.d)?;
    t.d.sort_by(|a, b| a.to_f64().total_cmp(&b.to_f64()));
    Ok(t.d)
}

/// Refuses what came out beyond the range of T.
fn check_range<T: Real>(found: &[T]) -> Result<(), InputError> {
    match found.iter().all(|x| x.is_finite()) {
        true => Ok(()),
        false => Err(InputError::Overflow { what: "an eigenvalue" }),
    }
}

/// B^-½ H B^-½ with rows and columns in ascending order of its diagonal, the order, and B^-½.
struct Scaled<T> {
    A: Matrix<T>,
    order: Vec<usize>,
    units: Vec<T>,
}

fn scale<T: Real>(H: &Matrix<T>, weights: &[T]) -> Result<Scaled<T>, Error> {
    let n = H.rows();
    for (what, found) in [("columns of H", H.cols()), ("B", weights.len())] {
        check_length(what, found, n)?;
    }
    if let Some(index) = weights.iter().position(|&b| !(b > T::ZERO && b.is_finite())) {
        return Err(InputError::NotPositive { what: "B", index, value: weights[index].to_f64() }.into());
    }
    let units: Vec<T> = weights.iter().map(|&b| if b == T::ONE { b } else { T::ONE / b.sqrt() }).collect();
    let mut order: Vec<usize> = (0..n).collect();
    let key = |d: usize| (H[(d, d)] * units[d] * units[d]).to_f64();
    order.sort_by(|&d, &e| key(d).total_cmp(&key(e)));
    let A = Matrix::from_fn(n, n, |i, j| {
        let (d, e) = (order[i], order[j]);
        units[d] * H[(d, e)] * units[e]
    });
    match A.as_slice().iter().position(|x| !x.is_finite()) {
        Some(index) => Err(InputError::NotFinite { what: "H", index: order[index / n] }.into()),
        None => Ok(Scaled { A, order, units }),
    }
}

/// The sign that makes the largest entry positive.
fn orient<T: Real>(y: &mut [T]) {
    let largest = y.iter().fold(T::ZERO, |m, &a| if a.abs() > m.abs() { a } else { m });
    if largest < T::ZERO {
        y.iter_mut().for_each(|a| *a = -*a);
    }
}

//! Householder reduction of a symmetric matrix to tridiagonal form.
//!
//! ```text
//! for i = n−1..1:   x = A[i, 0..i]                        the row left of the diagonal
//!                   P = 1 − u uᵀ/h,  P x = (0, .., 0, ±|x|)
//!                   A[0..i, 0..i] ← P A P = A − u wᵀ − w uᵀ,   w = A u/h − (uᵀA u/2h²) u
//! ```
//! Golub & Van Loan (2013), §8.3.1; Wilkinson & Reinsch (1971), tred2. From the last row upwards: the small entries of a graded
//! matrix, first in order, are touched last and keep their digits. Cost 4n³/3, and as much again for the vectors.

use crate::matrix::{Matrix, dot};
use crate::scalar::Real;

/// Diagonal d and subdiagonal e (e[i] between i−1 and i, e[0] = 0) of QᵀAQ.
pub(super) struct Tridiagonal<T> {
    pub d: Vec<T>,
    pub e: Vec<T>,
}

/// Reduces `A`, overwriting it with the Householder vectors u in the rows; `h[i]` = |u_i|²/2, zero where nothing was to do.
pub(super) fn reduce<T: Real>(A: &mut Matrix<T>) -> (Tridiagonal<T>, Vec<T>) {
    let n = A.rows();
    let (mut d, mut e, mut h) = (vec![T::ZERO; n], vec![T::ZERO; n], vec![T::ZERO; n]);
    let mut w = vec![T::ZERO; n];
    for i in (1..n).rev() {
        d[i] = A[(i, i)];
        let scale = A.row(i)[..i].iter().fold(T::ZERO, |m, x| m.max(x.abs()));
        let left = A.row(i)[..i - 1].iter().fold(T::ZERO, |m, x| m.max(x.abs()));
        if left == T::ZERO {
            e[i] = A[(i, i - 1)];
            continue;
        }
        // u = x ± |x| e_last, scaled so that squares neither overflow nor vanish
        let u = &mut A.row_mut(i)[..i];
        u.iter_mut().for_each(|x| *x = *x / scale);
        let norm = dot(u, u).sqrt();
        let last = u[i - 1];
        let alpha = if last > T::ZERO { -norm } else { norm };
        e[i] = alpha * scale;
        h[i] = norm * norm - last * alpha;
        u[i - 1] = last - alpha;

        // w = A u/h − K u with K = uᵀ A u/2h², by the rows of the lower triangle
        let w = &mut w[..i];
        w.fill(T::ZERO);
        for j in 0..i {
            let (u, row) = A.row_pair(i, j);
            let u_j = u[j];
            let mut sum = row[j] * u_j;
            for k in 0..j {
                sum = row[k].mul_add(u[k], sum);
                w[k] = row[k].mul_add(u_j, w[k]);
            }
            w[j] += sum;
        }
        let h_inverse = T::ONE / h[i];
        w.iter_mut().for_each(|x| *x *= h_inverse);
        let u = &A.row(i)[..i];
        let K = dot(u, w) * h_inverse * T::from_f64(0.5);
        for (w, &u) in w.iter_mut().zip(u) {
            *w -= K * u;
        }
        for j in 0..i {
            let (u, row) = A.row_pair(i, j);
            let (u_j, w_j) = (u[j], w[j]);
            for k in 0..=j {
                row[k] -= u_j * w[k] + w_j * u[k];
            }
        }
    }
    if n > 0 {
        d[0] = A[(0, 0)];
    }
    (Tridiagonal { d, e }, h)
}

/// V Qᵀ, row by row: eigenvectors y of the tridiagonal matrix, the rows of `V`, become Q y of the full one.
pub(super) fn back_transform<T: Real>(A: &Matrix<T>, h: &[T], V: &mut Matrix<T>) {
    for i in 1..A.rows() {
        if h[i] == T::ZERO {
            continue;
        }
        let u = &A.row(i)[..i];
        for r in 0..V.rows() {
            let y = &mut V.row_mut(r)[..i];
            let s = dot(u, y) / h[i];
            for (y, &u) in y.iter_mut().zip(u) {
                *y -= s * u;
            }
        }
    }
}

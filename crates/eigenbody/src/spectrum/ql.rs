//! Eigenvalues of a symmetric tridiagonal matrix by implicit QL with Wilkinson's shift.
//!
//! ```text
//! for l = 0..n:   until e_{l+1} is negligible:
//!                     σ = eigenvalue of the leading 2×2 at l nearer to d_l
//!                     chase the bulge from the first negligible e_{m+1} down to l with plane rotations
//! ```
//! Wilkinson & Reinsch (1971), imtql2; Golub & Van Loan (2013), §8.3. About 1.7 passes an eigenvalue: O(n²), and 3n³ for the vectors.

use super::tridiagonal::Tridiagonal;
use crate::error::Error;
use crate::matrix::Matrix;
use crate::scalar::Real;

const MAX_ITERATIONS: usize = 60;

/// Eigenvalues into `t.d`, in no order; every rotation is applied to the rows of `V`, if given.
pub(super) fn ql<T: Real>(t: &mut Tridiagonal<T>, mut V: Option<&mut Matrix<T>>) -> Result<(), Error> {
    let n = t.d.len();
    let Tridiagonal { d, e } = t;
    // e[i] between i and i+1 reads more easily here.
    e.rotate_left(n.min(1));
    let two = T::from_f64(2.0);
    let epsilon = T::from_f64(T::EPSILON);
    for l in 0..n {
        for iterations in 0.. {
            let negligible = |m: usize| e[m].abs() <= epsilon * (d[m].abs().sqrt() * d[m + 1].abs().sqrt());
            let m = (l..n - 1).find(|&m| negligible(m)).unwrap_or(n - 1);
            if m == l {
                break;
            }
            if iterations == MAX_ITERATIONS {
                return Err(Error::NoConvergence { index: l, iterations });
            }
            let g = (d[l + 1] - d[l]) / (two * e[l]);
            let r = hypotenuse(g, T::ONE);
            let signed = if g < T::ZERO { -r } else { r };
            let mut g = d[m] - d[l] + e[l] / (g + signed);
            let (mut s, mut c, mut p) = (T::ONE, T::ONE, T::ZERO);
            let mut split = None;
            for i in (l..m).rev() {
                let (f, b) = (s * e[i], c * e[i]);
                let r = hypotenuse(f, g);
                e[i + 1] = r;
                if r == T::ZERO {
                    split = Some(i);
                    break;
                }
                (s, c) = (f / r, g / r);
                let q = d[i + 1] - p;
                let r = (d[i] - q) * s + two * c * b;
                p = s * r;
                d[i + 1] = q + p;
                g = c * r - b;
                if let Some(V) = V.as_deref_mut() {
                    rotate_rows(V, i, s, c);
                }
            }
            match split {
                Some(i) => d[i + 1] -= p,
                None => {
                    d[l] -= p;
                    e[l] = g;
                }
            }
            e[m] = T::ZERO;
        }
    }
    Ok(())
}

/// √(a² + b²) without overflow.
fn hypotenuse<T: Real>(a: T, b: T) -> T {
    let (a, b) = (a.abs(), b.abs());
    let (large, small) = (a.max(b), a.min(b));
    if large == T::ZERO {
        return T::ZERO;
    }
    let ratio = small / large;
    large * (T::ONE + ratio * ratio).sqrt()
}

/// Rows i and i+1 of V turned by the rotation [c −s; s c].
fn rotate_rows<T: Real>(V: &mut Matrix<T>, i: usize, s: T, c: T) {
    let (upper, lower) = V.two_rows_mut(i);
    for (a, b) in upper.iter_mut().zip(lower) {
        let (x, y) = (*a, *b);
        *a = c * x - s * y;
        *b = s * x + c * y;
    }
}

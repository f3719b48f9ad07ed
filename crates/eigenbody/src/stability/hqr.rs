//! Eigenvalues of a general real matrix: reduction to Hessenberg form, then QR steps with Francis' double shift.
//!
//! ```text
//! for m = 2..n−1:  exchange so that A_{i,m−1}, i ≥ m, is largest at i = m; subtract multiples of row m, add the same of columns
//! until all is split:  l ← where a subdiagonal is negligible;  one root or two at the end are done;
//!                      else a double-shift QR sweep on rows l..n
//! ```
//! Wilkinson & Reinsch, *Linear Algebra* (1971), II/13 (elmhes) and II/14 (hqr). Cost about 10 n³.

use crate::error::Error;
use crate::matrix::Matrix;

/// Sweeps for one eigenvalue; exceptional shifts at each tenth.
const SWEEPS: usize = 60;

/// All eigenvalues (real part, imaginary part).
pub(super) fn eigenvalues(mut A: Matrix<f64>) -> Result<Vec<(f64, f64)>, Error> {
    hessenberg(&mut A);
    hqr(&mut A)
}

fn hessenberg(A: &mut Matrix<f64>) {
    let n = A.rows();
    for m in 1..n.saturating_sub(1) {
        let pivot =
            (m..n).fold(m, |best, i| if A[(i, m - 1)].abs() > A[(best, m - 1)].abs() { i } else { best });
        let x = A[(pivot, m - 1)];
        if pivot != m {
            for j in m - 1..n {
                swap(A, (pivot, j), (m, j));
            }
            for i in 0..n {
                swap(A, (i, pivot), (i, m));
            }
        }
        if x == 0.0 {
            continue;
        }
        for i in m + 1..n {
            let y = A[(i, m - 1)] / x;
            if y == 0.0 {
                continue;
            }
            A[(i, m - 1)] = 0.0;
            for j in m..n {
                A[(i, j)] -= y * A[(m, j)];
            }
            for k in 0..n {
                A[(k, m)] += y * A[(k, i)];
            }
        }
    }
}

fn swap(A: &mut Matrix<f64>, a: (usize, usize), b: (usize, usize)) {
    let held = A[a];
    A[a] = A[b];
    A[b] = held;
}

fn hqr(A: &mut Matrix<f64>) -> Result<Vec<(f64, f64)>, Error> {
    let n = A.rows();
    let norm: f64 =
        (0..n).flat_map(|i| (i.saturating_sub(1)..n).map(move |j| (i, j))).map(|at| A[at].abs()).sum();
    let mut roots = Vec::with_capacity(n);
    let (mut end, mut shift, mut sweeps) = (n, 0.0, 0);
    while end > 0 {
        let last = end - 1;
        // The first row of the block that still hangs together.
        let mut l = last;
        while l > 0 {
            let around = A[(l - 1, l - 1)].abs() + A[(l, l)].abs();
            let size = if around == 0.0 { norm } else { around };
            if A[(l, l - 1)].abs() <= f64::EPSILON * size {
                A[(l, l - 1)] = 0.0;
                break;
            }
            l -= 1;
        }
        let x = A[(last, last)];
        if l == last {
            roots.push((x + shift, 0.0));
            (end, sweeps) = (last, 0);
            continue;
        }
        let y = A[(last - 1, last - 1)];
        let w = A[(last, last - 1)] * A[(last - 1, last)];
        if l + 1 == last {
            pair(x, y, w, shift, &mut roots);
            (end, sweeps) = (last - 1, 0);
            continue;
        }
        if sweeps == SWEEPS {
            return Err(Error::NoConvergence { index: last, iterations: sweeps });
        }
        let mut shifts = (x, y, w);
        if sweeps > 0 && sweeps % 10 == 0 {
            shift += x;
            (0..end).for_each(|i| A[(i, i)] -= x);
            let s = A[(last, last - 1)].abs() + A[(last - 1, last - 2)].abs();
            shifts = (0.75 * s, 0.75 * s, -0.4375 * s * s);
        }
        sweeps += 1;
        sweep(A, l, last, shifts);
    }
    Ok(roots)
}

/// The two roots of a 2 × 2 block.
fn pair(x: f64, y: f64, w: f64, shift: f64, roots: &mut Vec<(f64, f64)>) {
    let p = 0.5 * (y - x);
    let q = p * p + w;
    let z = q.abs().sqrt();
    let x = x + shift;
    if q >= 0.0 {
        let z = p + z.copysign(p);
        roots.push((x + z, 0.0));
        roots.push((if z == 0.0 { x } else { x - w / z }, 0.0));
    } else {
        roots.push((x + p, z));
        roots.push((x + p, -z));
    }
}

/// One double-shift QR sweep on rows l..=last.
fn sweep(A: &mut Matrix<f64>, l: usize, last: usize, (x, y, w): (f64, f64, f64)) {
    // Two small subdiagonals in a row: start there.
    let mut m = last - 2;
    let (mut p, mut q, mut r) = loop {
        let z = A[(m, m)];
        let (a, b) = (x - z, y - z);
        let p = (a * b - w) / A[(m + 1, m)] + A[(m, m + 1)];
        let q = A[(m + 1, m + 1)] - z - a - b;
        let r = A[(m + 2, m + 1)];
        let s = p.abs() + q.abs() + r.abs();
        let (p, q, r) = (p / s, q / s, r / s);
        if m == l {
            break (p, q, r);
        }
        let u = A[(m, m - 1)].abs() * (q.abs() + r.abs());
        let v = p.abs() * (A[(m - 1, m - 1)].abs() + z.abs() + A[(m + 1, m + 1)].abs());
        if u <= f64::EPSILON * v {
            break (p, q, r);
        }
        m -= 1;
    };
    for i in m + 2..=last {
        A[(i, i - 2)] = 0.0;
        if i > m + 2 {
            A[(i, i - 3)] = 0.0;
        }
    }
    let n = A.rows();
    for k in m..last {
        let mut scale = 1.0;
        if k != m {
            (p, q) = (A[(k, k - 1)], A[(k + 1, k - 1)]);
            r = if k + 1 < last { A[(k + 2, k - 1)] } else { 0.0 };
            scale = p.abs() + q.abs() + r.abs();
            if scale == 0.0 {
                continue;
            }
            (p, q, r) = (p / scale, q / scale, r / scale);
        }
        let s = (p * p + q * q + r * r).sqrt().copysign(p);
        if s == 0.0 {
            continue;
        }
        if k == m {
            if l != m {
                A[(k, k - 1)] = -A[(k, k - 1)];
            }
        } else {
            A[(k, k - 1)] = -s * scale;
        }
        p += s;
        let (a, b, c) = (p / s, q / s, r / s);
        q /= p;
        r /= p;
        for j in k..n {
            let mut sum = A[(k, j)] + q * A[(k + 1, j)];
            if k + 1 < last {
                sum += r * A[(k + 2, j)];
                A[(k + 2, j)] -= sum * c;
            }
            A[(k + 1, j)] -= sum * b;
            A[(k, j)] -= sum * a;
        }
        let bottom = last.min(k + 3);
        for i in 0..=bottom {
            let mut sum = a * A[(i, k)] + b * A[(i, k + 1)];
            if k + 1 < last {
                sum += c * A[(i, k + 2)];
                A[(i, k + 2)] -= sum * r;
            }
            A[(i, k + 1)] -= sum * q;
            A[(i, k)] -= sum;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::eigenvalues;
    use crate::matrix::Matrix;
    use crate::model::Random;

    /// Against nalgebra's Schur decomposition: both are backward stable, so sorted roots agree to their condition, here 1e-8 at worst.
    #[test]
    fn as_another_library_has_them() {
        for seed in 0..40 {
            let mut random = Random::new(seed);
            let n = 1 + (seed as usize * 7) % 31;
            let entries: Vec<f64> = (0..n * n).map(|_| random.between(-1.0, 1.0)).collect();
            let A = Matrix::from_fn(n, n, |i, j| entries[i * n + j]);
            let theirs = nalgebra::DMatrix::from_row_slice(n, n, &entries).complex_eigenvalues();
            let mut theirs: Vec<(f64, f64)> = theirs.iter().map(|z| (z.re, z.im)).collect();
            let ours = eigenvalues(A).unwrap();
            assert_eq!(ours.len(), n);
            for (re, im) in ours {
                let distance = |z: &(f64, f64)| (z.0 - re).hypot(z.1 - im);
                let near =
                    (0..theirs.len()).min_by(|&a, &b| distance(&theirs[a]).total_cmp(&distance(&theirs[b])));
                let found = theirs.swap_remove(near.unwrap());
                assert!(distance(&found) < 1e-8, "{seed}: {re} {im} against {found:?}");
            }
        }
    }
}

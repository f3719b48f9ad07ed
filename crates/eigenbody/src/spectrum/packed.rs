//! Both ends of small dense spectra, many matrices side by side.
//!
//! ```text
//! T = Qᵀ A Q tridiagonal, by Householder reflections from the last row on; A as a packed triangle, passed over once for each row:
//!     A_jk −= u_j w_k + w_j u_k        the reflection of the row before
//!     y_j += A_jk v_k,  y_k += A_jk v_j        towards that of this row
//! p_i = (d_i − λ) p_(i−1) − e_i² p_(i−2)       leading minors of T − λ:  all positive as long as λ < λmin
//! λ ← λ + n p/(−p' + √((n−1)((n−1) p'² − n p p'')))       Laguerre's step: never beyond λmin
//! ```
//! What [`ends`](super::ends) does for one matrix, in the form that suits lanes: minors instead of pivots, because a division costs as
//! much as a dozen products, and every entry touched once a row, because a triangle in lanes fills the nearest memory. Cost ⅔ n³ and
//! about 20 n a step. Nothing is decided by comparing values.

use super::ends::most_steps;
use crate::scalar::{Real, Scalar};

/// Rows after which minors are scaled anew: none can leave the range of numbers in so few.
const RANGE: usize = 8;

/// Matrices of n rows, and room for their reduction.
#[derive(Debug, Clone)]
pub(crate) struct Packed<S> {
    n: usize,
    /// Lower triangle by rows. Overwritten.
    pub A: Vec<S>,
    /// n: all that belongs to a row is fetched from one place.
    rows: Vec<Row<S>>,
    /// Diagonal and squares of the subdiagonal (the first is zero) of the tridiagonal matrix.
    T: Vec<(S, S)>,
}

/// Of the reflection that waits to be applied, u and w; of that in the making, v and y.
#[derive(Debug, Clone, Copy)]
struct Row<S> {
    u: S,
    w: S,
    v: S,
    y: S,
}

impl<S: Scalar> Packed<S> {
    /// Room for matrices of n rows.
    pub fn new(n: usize) -> Self {
        let row = Row { u: S::ZERO, w: S::ZERO, v: S::ZERO, y: S::ZERO };
        Self { n, A: vec![S::ZERO; n * (n + 1) / 2], rows: vec![row; n], T: vec![(S::ZERO, S::ZERO); n] }
    }

    /// λmin and λmax of the matrices in `A`, of one row at least.
    #[inline(always)]
    pub fn ends(&mut self) -> [S; 2] {
        let largest = self.reduce();
        // Minors of T/λmax stay within bounds.
        let scale = S::ONE / largest;
        for (d, e2) in &mut self.T {
            (*d, *e2) = (*d * scale, *e2 * (scale * scale));
        }
        let [min, max] = laguerre(&self.T);
        [min * largest, max * largest]
    }

    /// Householder reduction; returns a bound on the largest eigenvalue.
    #[inline(always)]
    fn reduce(&mut self) -> S {
        let Self { n, A, rows, T } = self;
        let (mut bound, mut outer) = (S::ZERO, S::ZERO);
        let mut waits = false;
        for i in (0..*n).rev() {
            let (above, row) = A.split_at_mut(i * (i + 1) / 2);
            let row = &mut row[..i + 1];
            if waits {
                let (u_i, w_i) = (-rows[i].u, -rows[i].w);
                for (a, Row { u, w, .. }) in row.iter_mut().zip(&rows[..i + 1]) {
                    *a = w_i.mul_add(*u, u_i.mul_add(*w, *a));
                }
            }
            let diagonal = row[i];
            if i == 0 {
                T[0] = (diagonal, S::ZERO);
                return bound.max(diagonal + outer);
            }
            // v = x − α e_last, α = −|x| by the sign of the last number.
            let x = &row[..i];
            let square = dot(x, x);
            let (last, norm) = (x[i - 1], square.sqrt());
            T[i] = (diagonal, square);
            bound = bound.max(diagonal + outer + norm);
            outer = norm;
            if i == 1 {
                continue;
            }
            let alpha = S::ZERO.select_lt(last, -norm, norm);
            let rows = &mut rows[..i];
            for (row, &x) in rows.iter_mut().zip(x) {
                row.v = x;
            }
            rows[i - 1].v = last - alpha;
            let h = square - last * alpha;
            let h_inverse = S::ZERO.select_lt(h, S::ONE / h, S::ZERO);
            if waits {
                pass::<true, S>(above, rows);
            } else {
                pass::<false, S>(above, rows);
            }
            // w = A v/h − K v, K = vᵀ A v/2h²
            let K = along(rows) * (h_inverse * h_inverse) * S::from_f64(-0.5);
            for Row { u, w, v, y } in rows {
                (*u, *w) = (*v, K.mul_add(*v, *y * h_inverse));
            }
            waits = true;
        }
        bound
    }
}

/// xᵀ y, in two sums.
#[inline(always)]
fn dot<S: Scalar>(x: &[S], y: &[S]) -> S {
    let (mut even, mut odd) = (S::ZERO, S::ZERO);
    for (x, y) in x.chunks(2).zip(y.chunks(2)) {
        even = x[0].mul_add(y[0], even);
        if x.len() == 2 {
            odd = x[1].mul_add(y[1], odd);
        }
    }
    even + odd
}

/// vᵀ y, in two sums.
#[inline(always)]
fn along<S: Scalar>(rows: &[Row<S>]) -> S {
    let (mut even, mut odd) = (S::ZERO, S::ZERO);
    for rows in rows.chunks(2) {
        even = rows[0].v.mul_add(rows[0].y, even);
        if rows.len() == 2 {
            odd = rows[1].v.mul_add(rows[1].y, odd);
        }
    }
    even + odd
}

/// A −= u wᵀ + w uᵀ where that waits, and y = A v; two rows at once, so that sums are fetched and put back half as often.
#[inline(always)]
fn pass<const WAITS: bool, S: Scalar>(A: &mut [S], rows: &mut [Row<S>]) {
    let n = rows.len();
    let (mut rest, mut j) = (A, 0);
    while j + 1 < n {
        let (first, after) = std::mem::take(&mut rest).split_at_mut(j + 1);
        let (second, after) = after.split_at_mut(j + 2);
        rest = after;
        let (before, own) = rows.split_at_mut(j);
        let ((u0, w0, v0), (u1, w1, v1)) =
            ((-own[0].u, -own[0].w, own[0].v), (-own[1].u, -own[1].w, own[1].v));
        let (mut y0, mut y1) = (S::ZERO, S::ZERO);
        for ((a0, a1), Row { u, w, v, y }) in first[..j].iter_mut().zip(&mut second[..j]).zip(before) {
            if WAITS {
                *a0 = w0.mul_add(*u, u0.mul_add(*w, *a0));
                *a1 = w1.mul_add(*u, u1.mul_add(*w, *a1));
            }
            y0 = a0.mul_add(*v, y0);
            y1 = a1.mul_add(*v, y1);
            *y = a1.mul_add(v1, a0.mul_add(v0, *y));
        }
        let (mut a00, mut a10, mut a11) = (first[j], second[j], second[j + 1]);
        if WAITS {
            let two = S::from_f64(2.0);
            a00 = (two * u0).mul_add(own[0].w, a00);
            a10 = w1.mul_add(own[0].u, u1.mul_add(own[0].w, a10));
            a11 = (two * u1).mul_add(own[1].w, a11);
            (first[j], second[j], second[j + 1]) = (a00, a10, a11);
        }
        own[0].y = a10.mul_add(v1, a00.mul_add(v0, y0));
        own[1].y = a11.mul_add(v1, a10.mul_add(v0, y1));
        j += 2;
    }
    if j < n {
        let row = &mut rest[..j + 1];
        let (before, own) = rows.split_at_mut(j);
        let (u0, w0, v0) = (-own[0].u, -own[0].w, own[0].v);
        let mut y0 = S::ZERO;
        for (a0, Row { u, w, v, y }) in row[..j].iter_mut().zip(before) {
            if WAITS {
                *a0 = w0.mul_add(*u, u0.mul_add(*w, *a0));
            }
            y0 = a0.mul_add(*v, y0);
            *y = a0.mul_add(v0, *y);
        }
        if WAITS {
            row[j] = (S::from_f64(2.0) * u0).mul_add(own[0].w, row[j]);
        }
        own[0].y = row[j].mul_add(v0, y0);
    }
}

/// λmin and λmax of T, whose eigenvalues are at most one.
#[inline(always)]
fn laguerre<S: Scalar>(T: &[(S, S)]) -> [S; 2] {
    let n = S::from_f64(T.len() as f64);
    // −T begins at −1: from below as well.
    let (mut low, mut high) = (Reached::at(S::ZERO), Reached::at(-S::ONE));
    for _ in 0..most_steps(T.len()) {
        let (mut a, mut b) = (Minor::START, Minor::START);
        for (k, rows) in T.chunks(RANGE).enumerate() {
            if k > 0 {
                a.rescale();
                b.rescale();
            }
            for &(d, e2) in rows {
                a.next(d - low.lambda, e2);
                b.next(-d - high.lambda, e2);
            }
        }
        low.step(n, &a);
        high.step(n, &b);
        if !(low.going + high.going).any_above(S::Constant::ZERO) {
            break;
        }
    }
    [low.lambda, -high.lambda]
}

/// A leading minor p of T − λ, p' and p''/2, and those of the minor before.
struct Minor<S> {
    now: [S; 3],
    before: [S; 3],
    smallest: S,
}

impl<S: Scalar> Minor<S> {
    const START: Self = Self { now: [S::ONE, S::ZERO, S::ZERO], before: [S::ZERO; 3], smallest: S::ONE };

    /// One row more; t = d − λ.
    #[inline(always)]
    fn next(&mut self, t: S, e2: S) {
        let ([p, p1, p2], [q, q1, q2]) = (self.now, self.before);
        let less = -e2;
        let next = [
            t.mul_add(p, less * q),
            t.mul_add(p1, less.mul_add(q1, -p)),
            t.mul_add(p2, less.mul_add(q2, -p1)),
        ];
        (self.before, self.now) = (self.now, next);
        self.smallest = self.smallest.min(next[0]);
    }

    /// Divides by the larger of both minors.
    #[inline(always)]
    fn rescale(&mut self) {
        let scale = S::ONE / self.now[0].abs().max(self.before[0].abs());
        for k in 0..3 {
            (self.now[k], self.before[k]) = (self.now[k] * scale, self.before[k] * scale);
        }
    }
}

/// How far one end has come.
#[derive(Clone, Copy)]
struct Reached<S> {
    lambda: S,
    /// The last step.
    last: S,
    /// One until it has arrived, then zero.
    going: S,
}

impl<S: Scalar> Reached<S> {
    #[inline(always)]
    fn at(lambda: S) -> Self {
        Self { lambda, last: S::ZERO, going: S::ONE }
    }

    /// Laguerre's step, unless a minor is not positive: then λ stands at the end but for rounding. Arrived where the next step, which
    /// shrinks at least as this one did, would be lost in rounding.
    #[inline(always)]
    fn step(&mut self, n: S, minor: &Minor<S>) {
        let [p, p1, p2] = minor.now;
        let others = n - S::ONE;
        let discriminant = others * others.mul_add(p1 * p1, -(n * p * (p2 + p2)));
        let step = n * p / (discriminant.max(S::ZERO).sqrt() - p1);
        let moved = self.lambda + step;
        // What is no number is not positive either.
        let positive = S::ZERO.select_lt(p, S::ZERO.select_lt(minor.smallest, self.going, S::ZERO), S::ZERO);
        let moves = S::ZERO.select_lt(step, positive, S::ZERO);
        self.lambda = S::ZERO.select_lt(moves, moved, self.lambda);
        let small = moved.abs() * S::from_f64(2.0 * <S::Constant as Real>::EPSILON);
        let more = small.select_lt(step, moves, S::ZERO);
        self.going = (small * self.last).select_lt(step * step, more, S::ZERO);
        self.last = step;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::matrix::Matrix;
    use crate::model::Random;
    use crate::scalar::{Array, Two};
    use crate::spectrum::eigenvalues;

    /// Qᵀ Λ Q by reflections, with eigenvalues of that many digits between the ends; the second half of them repeats the first.
    fn matrix(n: usize, digits: f64, twice: bool, random: &mut Random) -> Matrix<f64> {
        let mut H = Matrix::zeros(n, n);
        for i in 0..n {
            let k = if twice { i / 2 * 2 } else { i };
            H[(i, i)] = 10.0_f64.powf(-digits * k as f64 / n.max(2) as f64);
        }
        for _ in 0..3 {
            let u: Vec<f64> = (0..n).map(|_| random.between(-1.0, 1.0)).collect();
            let square: f64 = u.iter().map(|x| x * x).sum();
            let reflect = |i: usize, j: usize| f64::from(u8::from(i == j)) - 2.0 * u[i] * u[j] / square;
            let half = Matrix::from_fn(n, n, |i, j| (0..n).map(|k| reflect(i, k) * H[(k, j)]).sum::<f64>());
            let full =
                Matrix::from_fn(n, n, |i, j| (0..n).map(|k| half[(i, k)] * reflect(k, j)).sum::<f64>());
            H = Matrix::from_fn(n, n, |i, j| 0.5 * (full[(i, j)] + full[(j, i)]));
        }
        H
    }

    /// Of every size, well and badly conditioned, with double eigenvalues, side by side with a matrix of another kind.
    #[test]
    fn ends_are_those_of_the_spectrum() {
        let mut random = Random::new(5);
        for n in (1..=40).chain([64, 97]) {
            for (digits, twice) in [(0.0, false), (2.0, false), (2.0, true), (9.0, false), (12.0, true)] {
                let matrices = [
                    matrix(n, digits, twice, &mut random),
                    matrix(n, 3.0, false, &mut random),
                    Matrix::from_fn(n, n, |i, j| if i == j { 1e-30 * (1 + i) as f64 } else { 0.0 }),
                    matrix(n, 5.0, true, &mut random),
                ];
                let [a, b, c, d] = &matrices;
                let mut packed: Packed<Two<Array<2>>> = Packed::new(n);
                let places = (0..n).flat_map(|i| (0..=i).map(move |j| (i, j)));
                for (x, at) in packed.A.iter_mut().zip(places) {
                    *x = Two(Array([a[at], b[at]]), Array([c[at], d[at]]));
                }
                let [min, max] = packed.ends();
                let found = [min.0.0, min.1.0].concat().into_iter().zip([max.0.0, max.1.0].concat());
                for (H, (min, max)) in matrices.iter().zip(found) {
                    let all = eigenvalues(H, &vec![1.0; n]).unwrap();
                    let bound = 4.0 * n as f64 * f64::EPSILON * all[n - 1];
                    assert!((min - all[0]).abs() <= bound, "n = {n}, {digits}: {min:e} {:e}", all[0]);
                    assert!((max - all[n - 1]).abs() <= bound, "n = {n}, {digits}: {max:e} {:e}", all[n - 1]);
                }
            }
        }
    }
}

//! Both ends of one small dense spectrum, where four numbers fit into a register.
//!
//! ```text
//! Householder, from the last row on; the matrix waits one step for what the step before made of it:
//!     A ← A − u wᵀ − w uᵀ,  y = A x         one pass over the lower triangle, four rows by four columns, x the row left of the diagonal
//!     u = x − α e_last      w = (y − α A e_last)/h − K u
//!
//! p_i = (d_i − λ) p_(i−1) − e_i² p_(i−2)     with p' and p'': det(T − λ), no division;  all p_i positive as long as λ < λmin
//! λ ← λ + n p/(−p' + √((n−1)((n−1) p'² − n p p'')))                                       Laguerre's step
//! ```
//! The same numbers as [`ends`](mod@super::ends): there by pivots and in any scalar, here with both ends side by side in one register. T is
//! scaled so that its spectrum ends at one; every few rows so are the p.

use super::ends::{EndsWorkspace, most_steps};
use crate::scalar::{Quad, Real};

/// Numbers of a register.
const WIDTH: usize = 4;
/// Rows between two scalings of p: it changes by less than 3 a row, or by less than ε.
const ROWS: usize = 8;

/// λmin and λmax of the matrix in the workspace, of one row at least.
#[inline(always)]
pub(super) fn ends<T: Real, Q: Quad<T>>(workspace: &mut EndsWorkspace<T>) -> [T; 2] {
    let bound = reduce::<T, Q>(workspace);
    let EndsWorkspace { n, d, e2, .. } = workspace;
    if bound <= T::ZERO {
        return [T::ZERO; 2];
    }
    let scale = T::ONE / bound;
    let square = scale * scale;
    for (d, e2) in d[..*n].iter_mut().zip(e2) {
        (*d, *e2) = (*d * scale, *e2 * square);
    }
    let [min, max] = laguerre::<T, Q>(&workspace.d[..workspace.n], &workspace.e2);
    [min * bound, max * bound]
}

/// Ones before place `k`, zeros from it on.
#[inline(always)]
fn before<T: Real, Q: Quad<T>>(k: usize) -> Q {
    let (o, l) = (T::ZERO, T::ONE);
    Q::from_slice(&[[o, o, o, o], [l, o, o, o], [l, l, o, o], [l, l, l, o]][k % WIDTH])
}

/// The tridiagonal matrix into `d` and `e2`; returns a bound on its largest eigenvalue.
#[inline(always)]
fn reduce<T: Real, Q: Quad<T>>(workspace: &mut EndsWorkspace<T>) -> T {
    let EndsWorkspace { n, stride, A, u, w, x, y, d, e2 } = workspace;
    let (n, width) = (*n, *stride / WIDTH);
    let A = A.as_chunks_mut::<WIDTH>().0;
    let (u, w) = (u.as_chunks_mut::<WIDTH>().0, w.as_chunks_mut::<WIDTH>().0);
    let (x, y) = (x.as_chunks_mut::<WIDTH>().0, y.as_chunks_mut::<WIDTH>().0);
    for (u, w) in u.iter_mut().zip(&mut *w) {
        (*u, *w) = ([T::ZERO; WIDTH], [T::ZERO; WIDTH]);
    }
    let (mut bound, mut outer) = (T::ZERO, T::ZERO);
    for i in (0..n).rev() {
        // Row i as the step before leaves it.
        let (block, place) = (i / WIDTH, i % WIDTH);
        let (u_i, w_i) = (-Q::constant(u[block][place]), -Q::constant(w[block][place]));
        let row = &mut A[i * width..][..block + 1];
        let mut square = Q::ZERO;
        for (((row, u), w), x) in row.iter_mut().zip(&*u).zip(&*w).zip(&mut *x) {
            let a = u_i.mul_add(Q::from_slice(w), w_i.mul_add(Q::from_slice(u), Q::from_slice(row)));
            (*row, *x) = (a.numbers(), a.numbers());
        }
        // The diagonal and what lies behind it do not belong to x.
        x[block] = (Q::from_slice(&x[block]) * before(place)).numbers();
        for x in &x[..block + 1] {
            square = Q::from_slice(x).mul_add(Q::from_slice(x), square);
        }
        let [square, ..] = square.total().numbers();
        let diagonal = row[block][place];
        d[i] = diagonal;
        if i == 0 {
            e2[0] = T::ZERO;
            return bound.max(diagonal + outer);
        }
        e2[i] = square;
        let norm = square.sqrt();
        bound = bound.max(diagonal + outer + norm);
        outer = norm;
        if i == 1 {
            continue;
        }
        let blocks = i.div_ceil(WIDTH);
        pass::<T, Q>(A, width, &u[..blocks], &w[..blocks], &x[..blocks], &mut y[..blocks]);
        let (block, place) = ((i - 1) / WIDTH, (i - 1) % WIDTH);
        let last = x[block][place];
        let alpha = if last > T::ZERO { -norm } else { norm };
        let h = square - last * alpha;
        let h_inverse = if h > T::ZERO { T::ONE / h } else { T::ZERO };
        let (turned, scale) = (Q::constant(-alpha), Q::constant(h_inverse));
        let unit = before::<T, Q>(i) - before(i - 1);
        let unit = if i % WIDTH == 0 { Q::ONE - before(WIDTH - 1) } else { unit };
        let inside = if i % WIDTH == 0 { Q::ONE } else { before(i) };
        x[block] = turned.mul_add(unit, Q::from_slice(&x[block])).numbers();
        let row = &A[(i - 1) * width..][..blocks];
        let mut along = Q::ZERO;
        for k in 0..blocks {
            let p = turned.mul_add(Q::from_slice(&row[k]), Q::from_slice(&y[k])) * scale;
            let p = if k == block { p * inside } else { p };
            along = p.mul_add(Q::from_slice(&x[k]), along);
            y[k] = p.numbers();
        }
        let K = along.total() * scale * Q::from_f64(-0.5);
        for k in 0..blocks {
            let own = Q::from_slice(&x[k]);
            w[k] = K.mul_add(own, Q::from_slice(&y[k])).numbers();
            u[k] = own.numbers();
        }
    }
    bound
}

/// A ← A − u wᵀ − w uᵀ and y = A x, by the blocks of the lower triangle.
#[inline(always)]
fn pass<T: Real, Q: Quad<T>>(
    A: &mut [[T; WIDTH]],
    width: usize,
    u: &[[T; WIDTH]],
    w: &[[T; WIDTH]],
    x: &[[T; WIDTH]],
    y: &mut [[T; WIDTH]],
) {
    let blocks = u.len();
    let (w, x, y) = (&w[..blocks], &x[..blocks], &mut y[..blocks]);
    let mut below = A;
    for j in 0..blocks {
        let (four, rest) = below.split_at_mut(WIDTH * width);
        below = rest;
        let (a, b) = four.split_at_mut(2 * width);
        let ((a, b), (c, d)) = (a.split_at_mut(width), b.split_at_mut(width));
        let (a, b, c, d) = (&mut a[..=j], &mut b[..=j], &mut c[..=j], &mut d[..=j]);
        let [u0, u1, u2, u3] = (-Q::from_slice(&u[j])).each();
        let [w0, w1, w2, w3] = (-Q::from_slice(&w[j])).each();
        let [x0, x1, x2, x3] = Q::from_slice(&x[j]).each();
        let (mut s0, mut s1, mut s2, mut s3) = (Q::ZERO, Q::ZERO, Q::ZERO, Q::ZERO);
        for k in 0..=j {
            let (u, w, x) = (Q::from_slice(&u[k]), Q::from_slice(&w[k]), Q::from_slice(&x[k]));
            let a_k = u0.mul_add(w, w0.mul_add(u, Q::from_slice(&a[k])));
            let b_k = u1.mul_add(w, w1.mul_add(u, Q::from_slice(&b[k])));
            let c_k = u2.mul_add(w, w2.mul_add(u, Q::from_slice(&c[k])));
            let d_k = u3.mul_add(w, w3.mul_add(u, Q::from_slice(&d[k])));
            (a[k], b[k], c[k], d[k]) = (a_k.numbers(), b_k.numbers(), c_k.numbers(), d_k.numbers());
            (s0, s1) = (a_k.mul_add(x, s0), b_k.mul_add(x, s1));
            (s2, s3) = (c_k.mul_add(x, s2), d_k.mul_add(x, s3));
            if k < j {
                let half = b_k.mul_add(x1, a_k.mul_add(x0, Q::from_slice(&y[k])));
                y[k] = d_k.mul_add(x3, c_k.mul_add(x2, half)).numbers();
            }
        }
        let [p, q, r, s] = Q::transpose([s0, s1, s2, s3]);
        y[j] = ((p + q) + (r + s)).numbers();
    }
}

/// Laguerre's method from below on T and on −T, from 0 and from −1.
#[inline(always)]
fn laguerre<T: Real, Q: Quad<T>>(d: &[T], e2: &[T]) -> [T; 2] {
    let (o, l) = (T::ZERO, T::ONE);
    let sign = Q::of([l, -l, l, -l]);
    let mut lambda = Q::of([o, -l, o, -l]);
    let mut reached = lambda;
    let size = Q::from_f64(d.len() as f64);
    let less = size - Q::ONE;
    let epsilon = Q::from_f64(2.0 * T::EPSILON);
    // One where an end has yet to be reached.
    let (mut going, mut before) = (Q::ONE, Q::ZERO);
    for _ in 0..most_steps(d.len()) {
        // p and its derivatives at this row and the one before.
        let (mut p, mut p1, mut p2) = (Q::ONE, Q::ZERO, Q::ZERO);
        let (mut r, mut r1, mut r2) = (Q::ZERO, Q::ZERO, Q::ZERO);
        let mut smallest = Q::ONE;
        for (d, e2) in d.chunks(ROWS).zip(e2.chunks(ROWS)) {
            for (&d, &e2) in d.iter().zip(e2) {
                let (s, e2) = (Q::constant(d).mul_add(sign, -lambda), -Q::constant(e2));
                let next = s.mul_add(p, e2 * r);
                let next1 = s.mul_add(p1, e2.mul_add(r1, -p));
                let next2 = s.mul_add(p2, e2.mul_add(r2, -(p1 + p1)));
                (r, r1, r2) = (p, p1, p2);
                (p, p1, p2) = (next, next1, next2);
                // What is no number is no pivot either: the comparison chooses the first.
                smallest = Q::ZERO.select_lt(p, smallest, -Q::ONE);
            }
            if d.len() == ROWS {
                let scale = Q::ONE / (p.abs() + r.abs());
                (p, p1, p2) = (p * scale, p1 * scale, p2 * scale);
                (r, r1, r2) = (r * scale, r1 * scale, r2 * scale);
            }
        }
        let discriminant = less * (less * p1 * p1 - size * p * p2);
        let step = size * p / (discriminant.max(Q::ZERO).sqrt() - p1);
        let moved = lambda + step;
        // Steps shrink with their third power: the next one is about step⁴/before³.
        let small = moved.abs() * epsilon;
        let (square, cube) = (step * step, before * before * before);
        let still = small.select_lt(step, Q::ONE, Q::ZERO);
        let still = (small * cube).select_lt(square * square, still, Q::ZERO);
        // Beyond an eigenvalue: as near as rounding allows, or else halfway back.
        let beyond = (p1.abs() * epsilon).select_lt(p.abs(), Q::ONE, Q::ZERO);
        let halfway = (reached + lambda) * Q::from_f64(0.5);
        let back = Q::ZERO.select_lt(beyond, halfway, lambda);
        let next = Q::ZERO.select_lt(smallest, moved, back);
        reached = Q::ZERO.select_lt(smallest, lambda, reached);
        lambda = Q::ZERO.select_lt(going, next, lambda);
        going *= Q::ZERO.select_lt(smallest, still, beyond);
        before = step;
        if !going.any_above(T::ZERO) {
            break;
        }
    }
    let [min, max, ..] = lambda.numbers();
    [min, -max]
}

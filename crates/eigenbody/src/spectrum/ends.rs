//! Both ends of a small dense spectrum, without the rest of it.
//!
//! ```text
//! T = Qᵀ A Q tridiagonal, by Householder reflections from the last row on
//! q_i = d_i − λ − e_i²/q_(i−1)        pivots of T − λ;  all positive as long as λ < λmin
//! G = Σ (log q_i)' = −Σ 1/(λ_k − λ)   K = −Σ (log q_i)'' = Σ 1/(λ_k − λ)²
//! λ ← λ + n/(−G + √((n−1)(n K − G²)))                                      Laguerre's step: never beyond λmin
//! ```
//! λmax is −λmin of −A; both ends take their steps together, from 0 below and from a bound above. Laguerre's method converges
//! cubically and, for a polynomial with real zeros only, from one side: 4 to 15 steps; to clusters linearly. Parlett, *The Symmetric Eigenvalue Problem* (1980),
//! §8.  Cost n³ and about 20 n; nothing is decided by comparing values, so that matrices may stand side by side in lanes.

use super::abreast;
use crate::error::{InputError, check_length};
use crate::matrix::Matrix;
use crate::scalar::{Algorithm, Aligned, Quad, Real, Scalar, Unit, dispatch_one};

/// Laguerre's steps that any spectrum of n eigenvalues can take. Mostly 4 to 15 are taken; the slowest is a cluster of half of them, to
/// which every step leaves 1 − 2/(1 + √n) of the way: 2⁻⁵³ of it are left after 18.4 (1 + √n).
pub(super) fn most_steps(n: usize) -> usize {
    40 + 20 * n.isqrt()
}

/// Rows begin at multiples of this, so that columns of every width fit.
const ALIGN: usize = 4;

/// Room for [`extreme_eigenvalues_into`].
#[derive(Debug, Clone)]
pub struct EndsWorkspace<T> {
    pub(super) n: usize,
    pub(super) stride: usize,
    /// stride × stride: the matrix, both triangles, zero beyond column n. Overwritten.
    pub(super) A: Aligned<T>,
    /// stride: a reflection's vector, and the matrix times it; those of the step before.
    pub(super) u: Aligned<T>,
    pub(super) w: Aligned<T>,
    pub(super) x: Aligned<T>,
    pub(super) y: Aligned<T>,
    /// n: diagonal and squares of the subdiagonal (the first is zero) of the tridiagonal matrix.
    pub(super) d: Vec<T>,
    pub(super) e2: Vec<T>,
}

impl<T: Scalar> EndsWorkspace<T> {
    /// Room for matrices of n rows.
    pub fn new(n: usize) -> Self {
        let stride = n.next_multiple_of(ALIGN);
        let row = Aligned::new(T::ZERO, stride);
        Self {
            n,
            stride,
            A: Aligned::new(T::ZERO, stride * stride),
            u: row.clone(),
            w: row.clone(),
            x: row.clone(),
            y: row,
            d: vec![T::ZERO; n],
            e2: vec![T::ZERO; n],
        }
    }
}

/// λmin and λmax of H x = λ B x, without the other eigenvalues.
///
/// | name | shape | unit |
/// |------|-------|------|
/// | `H` | n × n, symmetric, positive semidefinite | kg m², kg m, kg |
/// | `weights` | n, the diagonal of B, positive | see [`Metric`](super::Metric) |
/// | returned | λmin, λmax | unit of H_dd/B_dd |
///
/// Method: Householder reduction, then Laguerre's method from both ends. O(n³), a tenth of [`eigenvalues`](super::eigenvalues); allocates.
/// Numerics: both to a few n·ε·λmax; a λmin below that is rounding, and may be zero.
///
/// Errors: [`InputError::Length`]; [`InputError::NotFinite`] where an entry of B^-½ H B^-½ is none; [`InputError::NotPositive`] for a
/// weight; [`InputError::Overflow`] if λmax is beyond the range of T.
///
/// ```
/// use eigenbody::{Matrix, spectrum::extreme_eigenvalues};
/// let H = Matrix::from_fn(2, 2, |i, j| if i == j { 2.0 } else { 1.0 });
/// let [min, max]: [f64; 2] = extreme_eigenvalues(&H, &[1.0, 1.0])?;
/// assert!((min - 1.0).abs() < 1e-15 && (max - 3.0).abs() < 1e-15);
/// # Ok::<(), eigenbody::InputError>(())
/// ```
pub fn extreme_eigenvalues<T: Real>(H: &Matrix<T>, weights: &[T]) -> Result<[T; 2], InputError> {
    extreme_eigenvalues_into(H, weights, &mut EndsWorkspace::new(H.rows()))
}

/// [`extreme_eigenvalues`] with the caller's workspace; allocates nothing.
///
/// Errors: as there, and if the workspace is for another size.
pub fn extreme_eigenvalues_into<T: Real>(
    H: &Matrix<T>,
    weights: &[T],
    workspace: &mut EndsWorkspace<T>,
) -> Result<[T; 2], InputError> {
    let n = workspace.n;
    for (what, found) in [("rows of H", H.rows()), ("columns of H", H.cols()), ("B", weights.len())] {
        check_length(what, found, n)?;
    }
    if n == 0 {
        return Ok([T::ZERO; 2]);
    }
    if let Some(index) = weights.iter().position(|&b| !(b > T::ZERO && b.is_finite())) {
        return Err(InputError::NotPositive { what: "B", index, value: weights[index].to_f64() });
    }
    for (u, &b) in workspace.u.iter_mut().zip(weights) {
        *u = if b == T::ONE { b } else { T::ONE / b.sqrt() };
    }
    let EndsWorkspace { A, u, stride, .. } = workspace;
    for (i, A) in A.chunks_exact_mut(*stride).take(n).enumerate() {
        let u_i = u[i];
        for ((A, &x), &u_j) in A.iter_mut().zip(H.row(i)).zip(&**u) {
            *A = u_i * x * u_j;
        }
        // Not more than one row of the last matrix's remains.
        A[n..].fill(T::ZERO);
    }
    if !A.iter().fold(true, |all, x| all & x.is_finite()) {
        let index = A.iter().position(|x| !x.is_finite()).unwrap_or(0) / *stride;
        return Err(InputError::NotFinite { what: "H", index });
    }
    within_range(reduced_ends(workspace))
}

/// Refuses ends that are beyond the range of T, though the matrix is not.
pub(super) fn within_range<T: Real>(ends: [T; 2]) -> Result<[T; 2], InputError> {
    match ends.iter().all(|end| end.is_finite()) {
        true => Ok(ends),
        false => Err(InputError::Overflow { what: "λmax" }),
    }
}

/// λmin and λmax of the matrix that stands in the workspace, of one row at least; whatever its unit, squares stay within the range of T.
pub(super) fn reduced_ends<T: Real>(workspace: &mut EndsWorkspace<T>) -> [T; 2] {
    let EndsWorkspace { n, stride, A, .. } = workspace;
    // No entry is larger than the largest on the diagonal.
    let largest = (0..*n).fold(T::ZERO, |largest, d| largest.max(A[d * *stride + d]));
    let least = T::from_f64(T::EPSILON * T::EPSILON);
    if largest == T::ZERO || (largest > least && T::ONE / largest > least) {
        return dispatch_one(Ends { workspace });
    }
    A.iter_mut().for_each(|x| *x = *x / largest);
    dispatch_one(Ends { workspace }).map(|end| end * largest)
}

struct Ends<'a, T> {
    workspace: &'a mut EndsWorkspace<T>,
}

impl<T: Real> Algorithm<T> for Ends<'_, T> {
    type Output = [T; 2];
    const UNIT: Unit = Unit::Avx512;
    #[inline(always)]
    fn run<S: Scalar<Constant = T, Stored = T>>(self) -> [T; 2] {
        let [min, max] = ends::<S>(self.workspace);
        [min.store(), max.store()]
    }
    #[inline(always)]
    fn run_in_fours<S: Scalar<Constant = T, Stored = T, Columns: Quad<T>>>(self) -> [T; 2] {
        abreast::ends::<T, S::Columns>(self.workspace)
    }
}

/// λmin and λmax of the matrix in the workspace, of one row at least.
#[inline(always)]
fn ends<S: Scalar>(workspace: &mut EndsWorkspace<S::Stored>) -> [S; 2] {
    let largest = reduce::<S>(workspace);
    let EndsWorkspace { n, d, e2, .. } = workspace;
    laguerre::<S>(*n, d, e2, largest)
}

/// Σ of columns.
#[inline(always)]
fn sum<S: Scalar>(x: S::Columns) -> S {
    let mut numbers = [S::ZERO.store(); ALIGN];
    S::store_columns(x, &mut numbers);
    let mut sum = S::ZERO;
    for &number in &numbers[..S::COLUMNS] {
        sum += S::load(number);
    }
    sum
}

/// xᵀ y.
#[inline(always)]
fn dot<S: Scalar>(x: &[S::Stored], y: &[S::Stored]) -> S {
    let mut total = S::Columns::ZERO;
    for (x, y) in x.chunks_exact(S::COLUMNS).zip(y.chunks_exact(S::COLUMNS)) {
        total = S::load_columns(x).mul_add(S::load_columns(y), total);
    }
    sum::<S>(total)
}

/// Householder reduction; returns a bound on the largest eigenvalue.
#[inline(always)]
fn reduce<S: Scalar>(workspace: &mut EndsWorkspace<S::Stored>) -> S {
    let EndsWorkspace { n, stride, A, u, w, d, e2, .. } = workspace;
    let (n, stride) = (*n, *stride);
    let zero = S::ZERO.store();
    let (mut bound, mut outer) = (S::ZERO, S::ZERO);
    for i in (0..n).rev() {
        let diagonal = S::load(A[i * stride + i]);
        d[i] = diagonal.store();
        if i == 0 {
            e2[0] = zero;
            return bound.max(diagonal + outer);
        }
        // u = x − α e_last, α = −|x| by the sign of the last number; only the first i numbers are not zero.
        let length = i.next_multiple_of(ALIGN);
        let (u, w) = (&mut u[..length], &mut w[..length]);
        u.copy_from_slice(&A[i * stride..][..length]);
        u[i..].fill(zero);
        let square = dot::<S>(u, u);
        let (last, norm) = (S::load(u[i - 1]), square.sqrt());
        let alpha = S::ZERO.select_lt(last, -norm, norm);
        u[i - 1] = (last - alpha).store();
        e2[i] = square.store();
        bound = bound.max(diagonal + outer + norm);
        outer = norm;
        if i == 1 {
            continue;
        }
        let h = square - last * alpha;
        let h_inverse = S::ZERO.select_lt(h, S::ONE / h, S::ZERO);
        // w = A u/h − K u, K = uᵀ A u/2h²
        w.fill(zero);
        for (j, w) in w[..i].iter_mut().enumerate() {
            *w = (dot::<S>(&A[j * stride..][..length], u) * h_inverse).store();
        }
        let K = (dot::<S>(u, w) * h_inverse * S::from_f64(-0.5)).spread();
        for (w, u) in w.chunks_exact_mut(S::COLUMNS).zip(u.chunks_exact(S::COLUMNS)) {
            let x = K.mul_add(S::load_columns(u), S::load_columns(w));
            S::store_columns(x, w);
        }
        for j in 0..i {
            let (u_j, w_j) = ((-S::load(u[j])).spread(), (-S::load(w[j])).spread());
            let row = A[j * stride..][..length].chunks_exact_mut(S::COLUMNS);
            for ((row, u), w) in row.zip(u.chunks_exact(S::COLUMNS)).zip(w.chunks_exact(S::COLUMNS)) {
                let x = u_j.mul_add(S::load_columns(w), S::load_columns(row));
                S::store_columns(w_j.mul_add(S::load_columns(u), x), row);
            }
        }
    }
    bound
}

/// How far one end has come.
#[derive(Clone, Copy)]
struct Reached<S> {
    lambda: S,
    /// The last with all pivots positive.
    below: S,
    /// One until it has arrived, then zero.
    going: S,
}

#[inline(always)]
fn laguerre<S: Scalar>(n: usize, d: &[S::Stored], e2: &[S::Stored], largest: S) -> [S; 2] {
    let mut low = Reached { lambda: S::ZERO, below: S::ZERO, going: S::ONE };
    // −T begins at −λmax: from below as well.
    let mut high = Reached { lambda: -largest, below: -largest, going: S::ONE };
    for _ in 0..most_steps(n) {
        let (mut a, mut b) = (Pivot::START, Pivot::START);
        for (&d, &e2) in d[..n].iter().zip(e2) {
            let (d, e2) = (S::load(d), S::load(e2));
            a.next(d - low.lambda, e2);
            b.next(-d - high.lambda, e2);
        }
        let size = S::from_f64(n as f64);
        low.step(size, &a, largest);
        high.step(size, &b, largest);
        if !(low.going + high.going).any_above(S::Constant::ZERO) {
            break;
        }
    }
    [low.lambda, -high.lambda]
}

/// A pivot q and what its logarithm's derivatives sum up to.
struct Pivot<S> {
    /// 1/q, q'/q and q''/q of the last.
    inverse: S,
    first: S,
    second: S,
    G: S,
    K: S,
    smallest: S,
}

impl<S: Scalar> Pivot<S> {
    const START: Self =
        Self { inverse: S::ZERO, first: S::ZERO, second: S::ZERO, G: S::ZERO, K: S::ZERO, smallest: S::ONE };

    /// q = d − e²/q, q' = −1 + (e²/q) q'/q, q'' = (e²/q)(q''/q − 2 (q'/q)²), d less λ.
    #[inline(always)]
    fn next(&mut self, d: S, e2: S) {
        let t = e2 * self.inverse;
        let q = d - t;
        let inverse = S::ONE / q;
        let two = S::from_f64(2.0);
        let second = t * (self.second - two * self.first * self.first) * inverse;
        let first = t.mul_add(self.first, -S::ONE) * inverse;
        self.G += first;
        self.K += first.mul_add(first, -second);
        // What is no number is no pivot either: the comparison chooses the first.
        self.smallest = S::ZERO.select_lt(q, self.smallest, -S::ONE);
        (self.inverse, self.first, self.second) = (inverse, first, second);
    }
}

impl<S: Scalar> Reached<S> {
    /// Laguerre's step; where a pivot is not positive, halfway back, unless λ stands at an eigenvalue but for rounding.
    #[inline(always)]
    fn step(&mut self, n: S, sums: &Pivot<S>, largest: S) {
        let epsilon = S::from_f64(2.0 * <S::Constant as Real>::EPSILON);
        let discriminant = (n - S::ONE) * n.mul_add(sums.K, -(sums.G * sums.G));
        let step = n / (discriminant.max(S::ZERO).sqrt() - sums.G);
        let moved = self.lambda + step;
        let still = (moved.abs() * epsilon).select_lt(step, S::ONE, S::ZERO);
        let beyond = (sums.G.abs() * largest * epsilon).select_lt(S::ONE, S::ONE, S::ZERO);
        let halfway = (self.below + self.lambda) * S::from_f64(0.5);
        let back = S::ZERO.select_lt(beyond, halfway, self.lambda);
        let next = S::ZERO.select_lt(sums.smallest, moved, back);
        self.below = S::ZERO.select_lt(sums.smallest, self.lambda, self.below);
        self.lambda = S::ZERO.select_lt(self.going, next, self.lambda);
        self.going *= S::ZERO.select_lt(sums.smallest, still, beyond);
    }
}

mod eigen;
mod ends;
mod extremes;
mod metric;
mod slice;
mod sturm;
mod systems;
mod tracker;

use eigenbody::Matrix;
use eigenbody::model::Random;
use eigenbody::scalar::Real;

/// Random symmetric, entries in [−1, 1): indefinite.
fn symmetric<T: Real>(n: usize, seed: u64) -> Matrix<T> {
    let mut random = Random::new(seed);
    let numbers: Vec<T> = (0..n * n).map(|_| T::from_f64(random.between(-1.0, 1.0))).collect();
    Matrix::from_fn(n, n, |i, j| numbers[i.min(j) * n + i.max(j)])
}

/// 1/10 + Σ a aᵀ: positive definite.
fn definite<T: Real>(n: usize, seed: u64) -> Matrix<T> {
    let A = symmetric::<T>(n, seed);
    Matrix::from_fn(n, n, |i, j| {
        let product = (0..n).fold(T::ZERO, |sum, k| sum + A[(i, k)] * A[(k, j)]);
        if i == j { product + T::from_f64(0.1) } else { product }
    })
}

/// Positive weights between 10⁻² and 10².
fn weights<T: Real>(n: usize, seed: u64) -> Vec<T> {
    let mut random = Random::new(seed);
    (0..n).map(|_| T::from_f64(10f64.powf(random.between(-2.0, 2.0)))).collect()
}

//! What a precision loses: H x = b by factors in any scalar, and its error.
//!
//! ```text
//! error = |D(x − x*)| / |D x*| / ε      D² = diag(weights), x* in double-double, ε of x's precision
//! ```

use crate::StudyError;
use eigenbody::factor::{Cholesky, Ltl};
use eigenbody::scalar::{Dd, Real, Scalar};
use eigenbody::{Error, Matrix, Model};

/// Numbers as another scalar holds them.
pub(crate) fn numbers<T: Real>(x: &[f64]) -> Vec<T> {
    x.iter().map(|&x| T::from_f64(x)).collect()
}

/// H x = b by the factors of the tree; b is replaced by x.
pub(crate) fn ltl<T: Real>(model: &Model<T>, H: &Matrix<T>, b: &mut [T]) -> Result<(), Error> {
    let mut factors = Ltl::new(model.dofs());
    factors.factor(H)?;
    factors.solve(b)
}

/// The same by Cholesky's.
pub(crate) fn cholesky<T: Real>(H: &Matrix<T>, b: &mut [T]) -> Result<(), Error> {
    let mut factors = Cholesky::new(H.rows());
    factors.factor(H)?;
    factors.solve(b)
}

/// None where a pivot is not positive: that is a result, not a failure.
pub(crate) fn unless_singular<X>(outcome: Result<X, Error>) -> Result<Option<X>, StudyError> {
    match outcome {
        Ok(x) => Ok(Some(x)),
        Err(Error::NotPositiveDefinite(_)) => Ok(None),
        Err(error) => Err(error.into()),
    }
}

/// Over ε; infinite where x is not finite.
pub(crate) fn error<T: Real>(x: &[T], exact: &[Dd], weights: impl Iterator<Item = f64>) -> f64 {
    let (mut off, mut size) = (0.0, 0.0);
    for ((x, exact), weight) in x.iter().zip(exact).zip(weights) {
        off += weight * (Dd::from_f64(x.to_f64()) - *exact).to_f64().powi(2);
        size += weight * exact.to_f64().powi(2);
    }
    let error = (off / size).sqrt() / T::EPSILON;
    if error.is_nan() { f64::INFINITY } else { error }
}

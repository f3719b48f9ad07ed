//! The kernels against the book's tables, on every kind of joint in every scalar.

use super::largest;
use crate::robots::{Case, cases};
use eigenbody::dynamics::plain;
use eigenbody::scalar::Real;
use eigenbody::{forward_dynamics, inverse_dynamics, mass_matrix};

/// Largest difference against the largest entry.
fn difference<T: Real>(x: &[T], y: &[T]) -> f64 {
    let apart: Vec<T> = x.iter().zip(y).map(|(&x, &y)| x - y).collect();
    largest(&apart) / largest(y).max(f64::MIN_POSITIVE)
}

/// Forces and entries of H to a few roundings for every body on the longest path.
fn forces_and_entries<T: Real>() {
    for Case { name, model, q, v, vdot } in cases::<T>(60) {
        let bound = 20.0 * (4 + model.bodies().len()) as f64 * T::EPSILON;
        let tau = inverse_dynamics(&model, &q, &v, &vdot).unwrap();
        let book = plain::inverse_dynamics(&model, &q, &v, &vdot).unwrap();
        assert!(difference(&tau, &book) < bound, "τ, {name}: {:e}", difference(&tau, &book));
        let (H, book) = (mass_matrix(&model, &q).unwrap(), plain::mass_matrix(&model, &q).unwrap());
        let apart = difference(H.as_slice(), book.as_slice());
        assert!(apart < bound, "H, {name}: {apart:e}");
        for d in 0..model.nv() {
            for e in 0..model.nv() {
                let size = (book[(d, d)].to_f64() * book[(e, e)].to_f64()).sqrt();
                let apart = (H[(d, e)] - book[(d, e)]).to_f64().abs();
                assert!(apart <= bound * size, "H({d}, {e}), {name}: {apart:e} of {size:e}");
                assert_eq!(H[(d, e)], H[(e, d)], "{name}");
            }
        }
    }
}

/// Accelerations as far as κ′ lets any method agree: residuals of both in H v̇ = τ − C.
fn accelerations<T: Real>() {
    for Case { name, model, q, v, vdot } in cases::<T>(30) {
        let found = forward_dynamics(&model, &q, &v, &vdot).unwrap();
        let back = plain::inverse_dynamics(&model, &q, &v, &found).unwrap();
        let size = largest(&back).max(largest(&found) * plain::mass_matrix(&model, &q).unwrap().max_abs());
        let apart: Vec<T> = back.iter().zip(&vdot).map(|(&x, &y)| x - y).collect();
        let bound = 50.0 * (4 + model.bodies().len()) as f64 * T::EPSILON * size;
        assert!(largest(&apart) < bound, "{name}: {:e} of {bound:e}", largest(&apart));
    }
}

scalars!(forces_and_entries, accelerations);

//! Identities over generated robots.

mod aba;
mod bias;
mod closure;
mod crba;
mod denoc;
mod energy;
mod floating;
mod gradient;
mod inertial;
mod kinematics;
mod momentum;
mod plain;
mod reduction;
mod rounding;
mod turns;
mod workspace;

use eigenbody::Model;
use eigenbody::scalar::{Dd, Real, Scalar};

/// Step of central differences in double-double.
const STEP: f64 = 1e-10;

/// d/dt of `f` at t = 0 while q moves with v: f(q ⊕ v t).
fn rate(model: &Model<Dd>, q: &[Dd], v: &[Dd], f: impl Fn(&[Dd], Dd) -> Dd) -> f64 {
    let at = |t: f64| {
        let t = Dd::from_f64(t);
        let step: Vec<Dd> = v.iter().map(|&v| v * t).collect();
        f(&model.integrate(q, &step).unwrap(), t)
    };
    ((at(STEP) - at(-STEP)) / Dd::from_f64(2.0 * STEP)).to_f64()
}

/// Error of [`rate`] for n DoFs at unit speed: h² times a third derivative (angular velocities add up to n, their cubes to
/// n³), and n ε/h of rounding; both in units of `size`.
fn rate_error(n: usize, size: f64) -> f64 {
    let n = n as f64;
    (STEP * STEP * n.powi(3) + n * f64::EPSILON * f64::EPSILON / STEP) * size
}

/// Largest absolute entry.
fn largest<T: Real>(x: &[T]) -> f64 {
    x.iter().fold(0.0, |m, x| m.max(x.to_f64().abs()))
}

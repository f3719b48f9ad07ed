//! The largest stable step of a simulator, and the largest gains at a step.
//!
//! ```text
//! H q̈ + D q̇ + K q = 0        the robot near a configuration, held by springs and dampers, gravity left out
//! ```
//! | method | step | stable exactly for |
//! |---|---|---|
//! | semi-implicit Euler | H (v⁺ − v) = −h (K q + D v) | h²K + 2hD ≺ 4H |
//! | Euler, dampers of joints implicit | (H + hD_j)(v⁺ − v) = −h (K q + D v) | h²K + 2h(D − 2D_j) ≺ 4H |
//! | implicit in velocity | (H + hD)(v⁺ − v) = −h (K q + D v) | h²K − 2hD ≺ 4H |
//! | Runge-Kutta 4 | – | \|R(hμ)\| ≤ 1 for every μ with det(μ²H + μD + K) = 0 |
//!
//! The first three end with q⁺ = q + h v⁺; R(z) = 1 + z + z²/2 + z³/6 + z⁴/24.
//!
//! **Why exactly.** With M = H + hD_i, D_i the part taken implicitly, the first three are z²M − z(2M − h²K − hD) + (M − hD) = 0 for
//! the factor z that a step multiplies a motion by. Let x be such a motion; xᴴ(..)x is a quadratic with real coefficients that has z
//! as a root, so by Jury's conditions |z| < 1 if its value at −1 is positive (the others hold by themselves for K, D ≥ 0, K x ≠ 0).
//! That value is xᴴ P(−1) x with P(−1) = 4H + 2h(D_i − D_e) − h²K, D_e = D − D_i. If P(−1) has a negative direction, then, P(z)
//! being positive definite for z → −∞, P is singular at some z < −1, and the step is unstable. K, D and H need not commute. Along
//! every x the bound is one quadratic in h, so all steps below the largest are stable too.
//!
//! **Two pencils bracket it.** With λ_K, λ_D the largest eigenvalues of (K, H) and (D, H):
//! 4/(λ_D + √(λ_D² + 4λ_K)) ≤ h ≤ min(2/√λ_K, 2/λ_D) for semi-implicit Euler. The lower end is sharp where one mode is worst in both.

mod euler;
mod hqr;
mod impedance;
mod integrator;
mod rk4;

use impedance::square;
pub use impedance::{Impedance, Spring, SpringSource};
pub use integrator::Integrator;
pub use rk4::{IMAGINARY_LIMIT, REAL_LIMIT};

use crate::error::{Error, InputError, NotPositiveDefinite};
use crate::factor::Cholesky;
use crate::matrix::Matrix;
use crate::model::check;

/// The largest stable step in one configuration, and the motion that sets it.
#[derive(Debug, Clone, PartialEq)]
pub struct StepLimit {
    /// The largest stable step (s); infinite if every step is stable.
    pub step: f64,
    /// The motion that grows beyond it, largest entry positive; amplitudes where its joints are out of step. Zero for an infinite step.
    pub mode: Vec<f64>,
}

/// The largest stable step of an integrator for a robot held by springs and dampers.
///
/// | name | shape | unit |
/// |------|-------|------|
/// | `H` | n × n, symmetric | kg m², kg m, kg |
/// | `impedance` | n × n each | N m/rad, N m s/rad and so on |
///
/// Method: see the [module](self); Cholesky factors and inverse iteration, about 5 n³; for Runge-Kutta all 2n eigenvalues by the QR
/// algorithm, about 100 n³. Allocates. Numerics: relative error of a few n·ε·κ′(H), from below.
///
/// Errors: [`InputError::Length`] or [`InputError::NotFinite`] for any of the matrices, [`NotPositiveDefinite`] where H is singular
/// to working precision, [`Error::NoConvergence`].
///
/// ```
/// use eigenbody::Matrix;
/// use eigenbody::stability::{Impedance, Integrator, largest_step};
/// // 2 kg on a spring of 50 N/m: ω = 5 rad/s.
/// let H = Matrix::from_fn(1, 1, |_, _| 2.0);
/// let spring = Impedance::diagonal(&[50.0], &[0.0])?;
/// let limit = largest_step(&H, &spring, Integrator::SemiImplicitEuler)?;
/// assert!((limit.step - 2.0 / 5.0).abs() < 1e-9);
/// # Ok::<(), eigenbody::Error>(())
/// ```
pub fn largest_step(
    H: &Matrix<f64>,
    impedance: &Impedance,
    integrator: Integrator,
) -> Result<StepLimit, Error> {
    square("H", H, H.rows())?;
    impedance.check(H.rows())?;
    resolved(H)?;
    match integrator.implicit_part(impedance) {
        Some(implicit) => euler::largest_step(H, impedance, &implicit),
        None => rk4::largest_step(H, impedance),
    }
}

/// Refuses a matrix whose Cholesky pivots are rounding: the step that it bears is not known.
fn resolved(H: &Matrix<f64>) -> Result<(), Error> {
    let n = H.rows();
    let mut factor = Cholesky::new(n);
    factor.factor(H)?;
    let lost = |dof: &usize| {
        let pivot = factor.l()[(*dof, *dof)].powi(2);
        pivot <= 4.0 * n as f64 * f64::EPSILON * H[(*dof, *dof)]
    };
    match (0..n).find(lost) {
        Some(dof) => Err(NotPositiveDefinite { dof, pivot: factor.l()[(dof, dof)].powi(2) }.into()),
        None => Ok(()),
    }
}

/// Whether a step (s) is surely stable at H; false where H is singular.
///
/// Cost: a Cholesky factorisation, n³/3; for [`Integrator::RungeKutta4`] that of [`largest_step`], which the step is compared with.
///
/// Errors: [`InputError::Length`] or [`InputError::NotFinite`] for any of the arguments, [`InputError::NotPositive`] for the step,
/// [`Error::NoConvergence`].
pub fn is_stable(
    H: &Matrix<f64>,
    impedance: &Impedance,
    integrator: Integrator,
    step: f64,
) -> Result<bool, Error> {
    square("H", H, H.rows())?;
    impedance.check(H.rows())?;
    check("step", &[step], 1)?;
    if step <= 0.0 {
        return Err(InputError::NotPositive { what: "step", index: 0, value: step }.into());
    }
    let Some(implicit) = integrator.implicit_part(impedance) else {
        return match largest_step(H, impedance, integrator) {
            Ok(limit) => Ok(step <= limit.step),
            Err(Error::NotPositiveDefinite(_)) => Ok(false),
            Err(error) => Err(error),
        };
    };
    Ok(euler::is_stable(H, impedance, &implicit, step))
}

//! What a precision keeps of forward dynamics: predicted from κ′, measured against double-double.
//!
//! ```text
//! v̇ = H⁻¹ τ      loss = log₁₀(error/ε),   error = |D(v̇ − v̇*)| / |D v̇*|,   D = diag(H)^½
//! predicted: log₁₀ (κ′/4) with factors of H, log₁₀ (e/6ε) with articulated bodies, e the error estimate of λ′min by the same sweep
//! ```
//! A rounding is half an ε, and roundings of either sign add up to about half of what they could. κ′/4 tells what Cholesky's factors
//! and LTL lose in f32 to within one digit for 127 of 129 published robots (docs/survey.md). The articulated-body algorithm loses by
//! cancellation inside the bodies' inertias, not by κ′: the engine's estimate bounds that, and is six times what is lost as a rule.
//!
//! The same robot in f32, f64 and double-double, random τ in units of each joint's own inertia, the configuration rounded to f32.

use crate::StudyError;
use crate::precision::{cholesky, error, ltl, numbers, unless_singular};
use eigenbody::dynamics::forward_dynamics;
use eigenbody::model::Random;
use eigenbody::scalar::{Dd, Real};
use eigenbody::spectrum::Precision;
use eigenbody::{Metric, Model, Reduction, mass_matrix};

/// Right-hand sides; the worst counts.
const SIDES: u64 = 8;
/// Decimal digits of f32 and f64.
const F32_DIGITS: f64 = 7.22;
const F64_DIGITS: f64 = 15.95;

/// Digits lost by one way of solving.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Loss {
    /// Its name.
    pub method: &'static str,
    /// Digits that it was expected to lose, zero or more.
    pub predicted: f64,
    /// Digits lost in f32; infinite where it failed.
    pub f32: f64,
    /// Digits lost in f64.
    pub f64: f64,
}

/// What precisions keep at one configuration.
#[derive(Debug, Clone, PartialEq)]
pub struct Digits {
    /// log₁₀ (κ′/4) at that configuration, zero or more.
    pub predicted_loss: f64,
    /// As measured.
    pub measured: Vec<Loss>,
}

impl Digits {
    /// Digits that the worst measured way keeps in f32: which one a simulator takes is not known.
    pub fn left_in_f32(&self) -> f64 {
        let most = self.measured.iter().map(|loss| loss.f32).fold(0.0, f64::max);
        (F32_DIGITS - most).max(0.0)
    }

    /// Digits that the worst measured way keeps in f64.
    pub fn left_in_f64(&self) -> f64 {
        let most = self.measured.iter().map(|loss| loss.f64).fold(0.0, f64::max);
        (F64_DIGITS - most).max(0.0)
    }
}

/// None where H is singular even in double-double.
pub(super) fn measure(
    model: &Model<f64>,
    reduction: Reduction,
    q: &[f64],
) -> Result<Option<Digits>, StudyError> {
    // f32 holds every coordinate; a quaternion rounded so is still a unit one within the tolerance.
    let q: Vec<f64> = q.iter().map(|&x| f64::from(x as f32)).collect();
    let H = reduction.mass_matrix(model, &q)?;
    let own: Vec<f64> = (0..H.rows()).map(|d| H[(d, d)]).collect();
    if own.iter().any(|&h| h <= 0.0) {
        return Ok(None);
    }
    let question = eigenbody::Question {
        metric: Metric::UnitDiagonal,
        reduction,
        method: eigenbody::Method::Auto,
        ..eigenbody::Question::default()
    };
    let Some(kappa_weighted) = eigenbody::conditioning_at(model, &q, &question)?.kappa else {
        return Ok(None);
    };
    let sides: Vec<Vec<f64>> = (0..SIDES).map(|seed| side(&own, seed)).collect();
    let reduced = reduction.base || reduction.mimic && model.coupling().is_some();
    let wide: Model<Dd> = model.cast();
    let mut exact = Vec::new();
    for tau in &sides {
        match by_cholesky(&wide, &q, reduction, tau)? {
            Some(x) => exact.push(x),
            None => return Ok(None),
        }
    }
    let single: Model<f32> = model.cast();
    let mut measured = Vec::new();
    let mut add =
        |method, predicted, f32: &Solver<'_, f32>, f64: &Solver<'_, f64>| -> Result<(), StudyError> {
            let f32 = loss(&single, &q, f32, &sides, &exact, &own)?;
            let f64 = loss(model, &q, f64, &sides, &exact, &own)?;
            measured.push(Loss { method, predicted, f32, f64 });
            Ok(())
        };
    let predicted_loss = (kappa_weighted / 4.0).log10().max(0.0);
    add(
        "H by CRBA, Cholesky",
        predicted_loss,
        &|model, q, tau| by_cholesky(model, q, reduction, tau),
        &|model, q, tau| by_cholesky(model, q, reduction, tau),
    )?;
    if !reduced {
        add("H by CRBA, LTL", predicted_loss, &by_ltl, &by_ltl)?;
        add("articulated bodies", by_sweep(model, reduction, &q)?, &by_aba, &by_aba)?;
    }
    Ok(Some(Digits { predicted_loss, measured }))
}

/// Digits that the articulated-body sweep is expected to lose.
fn by_sweep(model: &Model<f64>, reduction: Reduction, q: &[f64]) -> Result<f64, StudyError> {
    let question = eigenbody::Question {
        metric: Metric::UnitDiagonal,
        reduction,
        method: eigenbody::Method::Sturm,
        precision: Precision::F64,
        ..eigenbody::Question::default()
    };
    let [estimate, _] = eigenbody::conditioning_at(model, q, &question)?.error_estimate;
    Ok(estimate.map_or(F64_DIGITS, |e| (e / (6.0 * f64::EPSILON)).log10().max(0.0)))
}

/// A random force of the size that gives every joint alone an acceleration of the order of one.
fn side(own: &[f64], seed: u64) -> Vec<f64> {
    let mut random = Random::new(seed);
    // Numbers that f32 holds.
    own.iter().map(|h| f64::from((random.between(-1.0, 1.0) * h.sqrt()) as f32)).collect()
}

type Solver<'a, T> = dyn Fn(&Model<T>, &[f64], &[f64]) -> Result<Option<Vec<T>>, StudyError> + 'a;

fn loss<T: Real>(
    model: &Model<T>,
    q: &[f64],
    solver: &Solver<'_, T>,
    sides: &[Vec<f64>],
    exact: &[Vec<Dd>],
    own: &[f64],
) -> Result<f64, StudyError> {
    let mut worst = 0.0f64;
    for (tau, exact) in sides.iter().zip(exact) {
        let Some(x) = solver(model, q, tau)? else { return Ok(f64::INFINITY) };
        worst = worst.max(error(&x, exact, own.iter().copied()));
    }
    Ok(worst.max(1.0).log10())
}

fn by_ltl<T: Real>(model: &Model<T>, q: &[f64], tau: &[f64]) -> Result<Option<Vec<T>>, StudyError> {
    let H = mass_matrix(model, &numbers(q))?;
    let mut x = numbers(tau);
    unless_singular(ltl(model, &H, &mut x).map(|()| x))
}

fn by_aba<T: Real>(model: &Model<T>, q: &[f64], tau: &[f64]) -> Result<Option<Vec<T>>, StudyError> {
    let still = model.clone().with_gravity(eigenbody::spatial::Vec3::ZERO)?;
    let rest = vec![T::ZERO; model.nv()];
    unless_singular(forward_dynamics(&still, &numbers(q), &rest, &numbers(tau)))
}

fn by_cholesky<T: Real>(
    model: &Model<T>,
    q: &[f64],
    reduction: Reduction,
    tau: &[f64],
) -> Result<Option<Vec<T>>, StudyError> {
    let Some(H) = unless_singular(reduction.mass_matrix(model, &numbers(q)))? else { return Ok(None) };
    let mut x = numbers(tau);
    unless_singular(cholesky(&H, &mut x).map(|()| x))
}

//! What conditioning costs: digits of forward dynamics, steps of an adaptive solver, energy.
//!
//! ```text
//! error = |D^p (v̇ − v̇*)| / |D^p v̇*|      D = diag(H)^½, p = 0: rad/s², m/s² as they are; p = 1: each joint in units of its own inertia
//! ```
//! v̇* is that of the articulated-body algorithm in double-double, for the same q, v and τ. Forces are those of random accelerations: a
//! controller's, that asks for a motion. The model and the inputs are rounded to the precision that is judged.

use super::{Group, Subject, quantile};
use crate::StudyError;
use crate::precision::{cholesky, error, ltl, numbers, unless_singular};
use crate::simulate::{Algorithm, DORMAND_PRINCE, Forces, Method, RK4, Simulation, SimulationError, Steps};
use eigenbody::dynamics::{Denoc, Udu, bias_force, energy, forward_dynamics};
use eigenbody::model::Random;
use eigenbody::scalar::{Dd, Real};
use eigenbody::{Family, Model, Question, conditioning_at, inverse_dynamics, mass_matrix};

/// Ways of solving, in the order of [`Digits::errors`].
pub const WAYS: [&str; 4] = ["CRBA, LTL", "CRBA, Cholesky", "ABA", "DeNOC, UDUᵀ"];
/// Precisions.
pub const PRECISIONS: [&str; 2] = ["f32", "f64"];
/// Norms.
pub const NORMS: [&str; 2] = ["plain", "inertia-weighted"];
/// Configurations a robot.
const CONFIGURATIONS: u64 = 8;

/// Errors at one configuration.
#[derive(Debug, Clone)]
pub struct Digits {
    /// The robot.
    pub name: String,
    /// Its kind.
    pub group: Group,
    /// κ and κ′ of H, the base's six rows included.
    pub kappa: f64,
    /// κ′.
    pub kappa_weighted: f64,
    /// By way, precision and norm, over ε; infinite where a factorisation failed.
    pub errors: [[[f64; 2]; 2]; 4],
}

/// What an integration costs.
#[derive(Debug, Clone)]
pub struct Effort {
    /// The robot.
    pub name: String,
    /// Its kind.
    pub group: Group,
    /// Degrees of freedom.
    pub dofs: usize,
    /// Medians of κ and κ′ along the motion.
    pub kappa: f64,
    /// κ′.
    pub kappa_weighted: f64,
    /// Steps a second of Dormand-Prince at 1e-6, by articulated bodies.
    pub steps: Option<f64>,
    /// Steps at 1e-11: by articulated bodies and by CRBA with LTL, refused ones included.
    pub tight: [Option<f64>; 2],
    /// Energy drift of Runge-Kutta 4 in steps of 1 ms over a second, of the largest kinetic energy.
    pub drift: Option<f64>,
}

/// Chains from 2 to 100 links, tapered and branched ones.
///
/// # Errors
///
/// [`StudyError`], if a member cannot be built.
pub fn members() -> Result<Vec<Subject>, StudyError> {
    let mut members = Vec::new();
    let mut add = |n: usize, b: f64, alpha: f64, rho: f64| -> Result<(), StudyError> {
        let group = if b > 1.0 { Group::Tree } else { Group::Chain };
        let name = format!("hydra({n},{b},{alpha},{rho:.3})");
        members.push(Subject::family(name, group, &Family::hydra(n, b, alpha, rho)?)?);
        Ok(())
    };
    for n in [2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64, 100] {
        add(n, 1.0, 0.0, 1.0)?;
        add(n, 1.0, 0.5, 1.0)?;
    }
    for n in [4, 8, 16, 32] {
        for ratio in [0.1f64, 0.01] {
            add(n, 1.0, 0.3, ratio.powf(1.0 / (n as f64 - 1.0)))?;
        }
        add(n, 2.0, 0.5, 1.0)?;
    }
    Ok(members)
}

/// Errors at random configurations and velocities.
///
/// # Errors
///
/// [`StudyError`], if a state does not fit the model.
pub fn digits(subject: &Subject) -> Result<Vec<Digits>, StudyError> {
    let Subject { name, group, model } = subject;
    let (wide, single): (Model<Dd>, Model<f32>) = (model.cast(), model.cast());
    let mut found = Vec::new();
    for seed in 0..CONFIGURATIONS {
        let short = |x: f64| f64::from(x as f32);
        let q: Vec<f64> = model.random(seed).into_iter().map(short).collect();
        let Some((kappa, kappa_weighted)) = conditions(model, &q)? else { continue };
        let mut random = Random::new(seed + 100);
        let mut some = || (0..model.nv()).map(|_| short(random.between(-1.0, 1.0))).collect::<Vec<_>>();
        let (v, wanted) = (some(), some());
        let tau: Vec<f64> = inverse_dynamics(model, &q, &v, &wanted)?.into_iter().map(short).collect();
        let Ok(exact) = forward_dynamics(&wide, &numbers(&q), &numbers(&v), &numbers(&tau)) else { continue };
        let H = mass_matrix(model, &q)?;
        let own: Vec<f64> = (0..H.rows()).map(|d| H[(d, d)]).collect();
        let mut errors = [[[f64::INFINITY; 2]; 2]; 4];
        for (way, errors) in errors.iter_mut().enumerate() {
            errors[0] = in_both_norms(solve(way, &single, &q, &v, &tau)?, &exact, &own);
            errors[1] = in_both_norms(solve(way, model, &q, &v, &tau)?, &exact, &own);
        }
        found.push(Digits { name: name.clone(), group: *group, kappa, kappa_weighted, errors });
    }
    Ok(found)
}

/// κ and κ′; none where λmin is not resolved.
fn conditions(model: &Model<f64>, q: &[f64]) -> Result<Option<(f64, f64)>, StudyError> {
    let found = conditioning_at(model, q, &Question::default())?;
    Ok(found.kappa.zip(found.kappa_weighted))
}

/// v̇ by one of the ways; none where a pivot is not positive.
fn solve<T: Real>(
    way: usize,
    model: &Model<T>,
    q: &[f64],
    v: &[f64],
    tau: &[f64],
) -> Result<Option<Vec<T>>, StudyError> {
    let (q, v, tau): (Vec<T>, Vec<T>, Vec<T>) = (numbers(q), numbers(v), numbers(tau));
    unless_singular((|| {
        if way == 2 {
            return forward_dynamics(model, &q, &v, &tau);
        }
        let mut x = bias_force(model, &q, &v)?;
        x.iter_mut().zip(&tau).for_each(|(x, &tau)| *x = tau - *x);
        match way {
            0 => ltl(model, &mass_matrix(model, &q)?, &mut x)?,
            1 => cholesky(&mass_matrix(model, &q)?, &mut x)?,
            _ => {
                let mut denoc = Denoc::new(model);
                denoc.update(&q)?;
                let mut factors = Udu::new(&denoc);
                factors.factor(&denoc)?;
                factors.solve(&denoc, &mut x)?;
            }
        }
        Ok(x)
    })())
}

/// In both norms, over ε.
fn in_both_norms<T: Real>(x: Option<Vec<T>>, exact: &[Dd], own: &[f64]) -> [f64; 2] {
    let Some(x) = x else { return [f64::INFINITY; 2] };
    [0, 1].map(|power| error(&x, exact, own.iter().map(|h| h.powi(power))))
}

/// A second of motion from a random configuration, joints at random velocities of up to 2 rad/s or m/s, a floating base at rest.
///
/// # Errors
///
/// [`StudyError`], if a state does not fit the model.
pub fn effort(subject: &Subject) -> Result<Effort, StudyError> {
    let Subject { name, group, model } = subject;
    let q = model.random(3);
    let base = model.base_dofs();
    let mut random = Random::new(17);
    let v: Vec<f64> =
        (0..model.nv()).map(|d| if d < base { 0.0 } else { random.between(-2.0, 2.0) }).collect();
    let run = |steps, method, algorithm| integrate(model, (&q, &v), method, steps, algorithm, |_, _| {}).ok();
    let dopri = Method::RungeKutta(DORMAND_PRINCE);
    let loose = run(Steps::Adaptive(1e-6), dopri, Algorithm::Aba);
    let tight = [Algorithm::Aba, Algorithm::CrbaLtl].map(|a| run(Steps::Adaptive(1e-11), dopri, a));
    let (mut first, mut drift, mut largest) = (None, 0.0f64, 0.0f64);
    let (mut kappas, mut weighted) = (Vec::new(), Vec::new());
    let mut taken = 0u64;
    let fixed =
        integrate(model, (&q, &v), Method::RungeKutta(RK4), Steps::Fixed(1e-3), Algorithm::Aba, |q, v| {
            if let Ok(energy) = energy(model, q, v) {
                let total = energy.kinetic + energy.potential;
                let first = *first.get_or_insert(total);
                drift = drift.max((total - first).abs());
                largest = largest.max(energy.kinetic);
            }
            taken += 1;
            if taken % 50 != 1 {
                return;
            }
            if let Ok(Some((kappa, prime))) = conditions(model, q) {
                kappas.push(kappa);
                weighted.push(prime);
            }
        });
    let drift = fixed.is_ok().then_some(drift / largest);
    let (kappa, kappa_weighted) = (quantile(&kappas, 0.5), quantile(&weighted, 0.5));
    let dofs = model.nv();
    Ok(Effort { name: name.clone(), group: *group, dofs, kappa, kappa_weighted, steps: loose, tight, drift })
}

/// Steps of a second, refused ones included.
fn integrate(
    model: &Model<f64>,
    (q, v): (&[f64], &[f64]),
    method: Method,
    steps: Steps,
    algorithm: Algorithm,
    mut each: impl FnMut(&[f64], &[f64]),
) -> Result<f64, SimulationError> {
    let mut simulation = Simulation::new(model, q, v, method, steps, Forces::default(), algorithm)?;
    each(q, v);
    while simulation.state().t < 1.0 {
        simulation.step(1.0)?;
        each(&simulation.state().q, &simulation.state().v);
        let effort = simulation.effort();
        if effort.steps + effort.refused > 200_000 {
            let (t, joint) = (simulation.state().t, "any".into());
            return Err(SimulationError::Stuck { t, joint, step_s: t / effort.steps as f64 });
        }
    }
    let effort = simulation.effort();
    Ok((effort.steps + effort.refused) as f64)
}

/// Ten links without friction under the implicit midpoint rule.
#[derive(Debug, Clone)]
pub struct LongRun {
    /// How it is released.
    pub name: &'static str,
    /// Error of the energy in each tenth of the time, of the largest kinetic energy: at most, and on average.
    pub tenths: Vec<[f64; 2]>,
    /// The fastest joint (rad/s).
    pub fastest: f64,
}

/// First angles of [`long_run`]: the chain at rest and straight, 0.37 rad from hanging, and level.
pub const RELEASES: [(&str, f64); 2] = [("0.37 rad from hanging", -1.2), ("level", 0.0)];

/// The energy of ten slender links over `span_s` seconds of steps of `step_s`, released at rest as [`RELEASES`] say.
///
/// # Errors
///
/// [`StudyError`], if the motion ends early.
pub fn long_run(release: (&'static str, f64), span_s: f64, step_s: f64) -> Result<LongRun, StudyError> {
    let model: Model<f64> = Family::slender_chain(10, 1.0, 1.0)?.model()?;
    let (mut q, v) = (vec![0.0; 10], vec![0.0; 10]);
    q[0] = release.1;
    let (method, steps) = (Method::ImplicitMidpoint, Steps::Fixed(step_s));
    let mut simulation = Simulation::new(&model, &q, &v, method, steps, Forces::default(), Algorithm::Aba)?;
    let start = energy(&model, &q, &v)?.potential;
    let mut sums = [[0.0f64; 3]; 10];
    let (mut kinetic, mut fastest) = (0.0f64, 0.0f64);
    while simulation.state().t < span_s {
        simulation.step(span_s)?;
        let state = simulation.state();
        let now = energy(&model, &state.q, &state.v)?;
        let error = now.kinetic + now.potential - start;
        let [largest, sum, count] = &mut sums[((10.0 * state.t / span_s) as usize).min(9)];
        (*largest, *sum, *count) = (largest.max(error.abs()), *sum + error, *count + 1.0);
        kinetic = kinetic.max(now.kinetic);
        fastest = state.v.iter().fold(fastest, |most, v| most.max(v.abs()));
    }
    let tenths =
        sums.iter().map(|[largest, sum, count]| [largest / kinetic, sum / count / kinetic]).collect();
    Ok(LongRun { name: release.0, tenths, fastest })
}

/// κ′ tells digits: what a precision loses by this prediction, in units of ε.
pub fn predicted(kappa_weighted: f64) -> f64 {
    (kappa_weighted / 4.0).max(1.0)
}

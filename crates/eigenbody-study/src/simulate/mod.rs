//! Motion under gravity: explicit Runge-Kutta methods on q̇ = v, v̇ = H⁻¹(−C).
//!
//! ```text
//! k_s = f(y + h Σ_{j<s} a_sj k_j)      y⁺ = y + h Σ b_s k_s      error = h Σ (b_s − b̂_s) k_s
//! adaptive: accept if the error is within the tolerance; h ← 0.9 h (tolerance/error)^(1/order)
//! ```
//! Hairer, Nørsett & Wanner, *Solving Ordinary Differential Equations I* (1993), §II.4. Accelerations by the articulated-body
//! algorithm: O(N) a stage.

mod tableau;

pub use tableau::{DORMAND_PRINCE, RK4, Tableau};

use eigenbody::dynamics::{AbaWorkspace, forward_dynamics_into};
use eigenbody::{Joint, Model};
use thiserror::Error;

/// More steps than any motion here has needed; a guard, not a budget.
const MAX_STEPS: usize = 10_000_000;

/// How steps are chosen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Steps {
    /// All of one length (s).
    Fixed(f64),
    /// So that the estimated error of a step stays below this, absolute and relative; for methods that have an estimate.
    Adaptive(f64),
}

/// How to simulate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Schedule {
    /// The method.
    pub method: Tableau,
    /// Its steps. They are cut to end on every sample.
    pub steps: Steps,
    /// Length of the motion (s).
    pub span_s: f64,
    /// Number of intervals between samples, all of one length.
    pub intervals: usize,
}

/// Where a mechanism is and how it moves.
#[derive(Debug, Clone, PartialEq)]
pub struct State {
    /// Time (s).
    pub t: f64,
    /// Coordinates, `nq`.
    pub q: Vec<f64>,
    /// Velocities, `nv`.
    pub v: Vec<f64>,
}

/// Why a motion ends before its time.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum SimulationError {
    /// A joint whose coordinates do not change at the rate v.
    #[error("joint '{0}' has q̇ ≠ v: ball, planar and floating joints are not simulated")]
    Joint(String),
    /// A step, tolerance or span that is not positive, or an adaptive method without an error estimate.
    #[error("{0}")]
    Schedule(&'static str),
    /// The dynamics failed.
    #[error("at t = {t} s: {source}")]
    Dynamics {
        /// Time of the stage.
        t: f64,
        /// What the core says.
        source: eigenbody::Error,
    },
    /// The steps became too small or too many.
    #[error("no progress at t = {0} s: the tolerance asks for steps too small")]
    Stuck(f64),
}

/// The motion of a mechanism without actuators, sampled at equal intervals, the start included.
///
/// | name | shape | unit |
/// |------|-------|------|
/// | `q`, `v` | `nq`, `nv`: the start | rad, m; rad/s, m/s |
/// | returned | `intervals` + 1 states | s, rad, m, rad/s, m/s |
///
/// Method: see the module. Numerics: a fixed method of order p errs by O(hᵖ); an adaptive one keeps the local error below its tolerance. Neither
/// keeps the energy exactly: watch it.
///
/// Errors: [`SimulationError`].
///
/// ```
/// use eigenbody::Family;
/// use eigenbody_study::simulate::{DORMAND_PRINCE, Schedule, Steps, simulate};
/// let rod = Family::slender_chain(1, 1.0, 1.0)?.model::<f64>()?;
/// let schedule =
///     Schedule { method: DORMAND_PRINCE, steps: Steps::Adaptive(1e-10), span_s: 1.0, intervals: 10 };
/// let motion = simulate(&rod, &[0.0], &[0.0], &schedule)?;
/// assert_eq!(motion.len(), 11);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn simulate(
    model: &Model<f64>,
    q: &[f64],
    v: &[f64],
    schedule: &Schedule,
) -> Result<Vec<State>, SimulationError> {
    let Schedule { method, steps, span_s, intervals } = *schedule;
    check(model, q, v, schedule)?;
    let mut flow = Flow { model, workspace: AbaWorkspace::new(model), tau: vec![0.0; model.nv()] };
    let mut y = [q, v].concat();
    let interval = span_s / intervals as f64;
    let mut h = match steps {
        Steps::Fixed(h) => h,
        Steps::Adaptive(_) => interval / 8.0,
    };
    let mut runner = Runner::new(&method, y.len());
    let mut motion = vec![State { t: 0.0, q: q.to_vec(), v: v.to_vec() }];
    let mut taken = 0;
    for sample in 0..intervals {
        let (mut t, end) = (sample as f64 * interval, (sample + 1) as f64 * interval);
        while t < end {
            taken += 1;
            // A remainder that rounding leaves is no step of its own.
            let is_last = t + h * (1.0 + 1e-9) >= end;
            let step = if is_last { end - t } else { h };
            let error = runner.attempt(&mut flow, t, &y, step)?;
            if let Steps::Adaptive(tolerance) = steps {
                let size = error / tolerance;
                let growth = (0.9 * size.max(1e-10).powf(-1.0 / method.order as f64)).clamp(0.2, 5.0);
                if size > 1.0 || !is_last {
                    h = step * growth;
                } else {
                    h = h.max(step * growth);
                }
                if size.is_nan() || h < 1e-14 * span_s || taken > MAX_STEPS {
                    return Err(SimulationError::Stuck(t));
                }
                if size > 1.0 {
                    continue;
                }
            }
            y.copy_from_slice(&runner.next);
            t = if is_last { end } else { t + step };
        }
        let (q, v) = y.split_at(model.nq());
        motion.push(State { t: end, q: q.to_vec(), v: v.to_vec() });
    }
    Ok(motion)
}

fn check(model: &Model<f64>, q: &[f64], v: &[f64], schedule: &Schedule) -> Result<(), SimulationError> {
    let start = |error: eigenbody::InputError| SimulationError::Dynamics { t: 0.0, source: error.into() };
    model.check_q(q).map_err(start)?;
    model.check_v("v", v).map_err(start)?;
    let differs = |joint: &Joint<f64>| matches!(joint, Joint::Spherical | Joint::Floating | Joint::Planar);
    if let Some(joint) = model.joints().iter().find(|joint| differs(joint.kind())) {
        return Err(SimulationError::Joint(joint.name().to_owned()));
    }
    let positive = |x: f64| x > 0.0 && x.is_finite();
    match *schedule {
        Schedule { span_s, .. } if !positive(span_s) => {
            Err(SimulationError::Schedule("the span is a positive number of seconds"))
        }
        Schedule { intervals: 0, .. } => Err(SimulationError::Schedule("at least one interval")),
        Schedule { steps: Steps::Fixed(h) | Steps::Adaptive(h), .. } if !positive(h) => {
            Err(SimulationError::Schedule("step and tolerance are positive numbers"))
        }
        Schedule { steps: Steps::Adaptive(_), method, .. } if method.error.is_none() => {
            Err(SimulationError::Schedule("this method has no error estimate: its steps are fixed"))
        }
        _ => Ok(()),
    }
}

/// ẏ = f(y), y = [q; v].
struct Flow<'m> {
    model: &'m Model<f64>,
    workspace: AbaWorkspace<f64>,
    tau: Vec<f64>,
}

impl Flow<'_> {
    fn rate(&mut self, t: f64, y: &[f64], rate: &mut [f64]) -> Result<(), SimulationError> {
        let (q, v) = y.split_at(self.model.nq());
        let (qdot, vdot) = rate.split_at_mut(q.len());
        qdot.copy_from_slice(v);
        forward_dynamics_into(self.model, q, v, &self.tau, &mut self.workspace, vdot)
            .map_err(|source| SimulationError::Dynamics { t, source })
    }
}

/// Room for one step.
struct Runner<'t> {
    method: &'t Tableau,
    stages: Vec<Vec<f64>>,
    place: Vec<f64>,
    next: Vec<f64>,
}

impl<'t> Runner<'t> {
    fn new(method: &'t Tableau, n: usize) -> Self {
        Self { method, stages: vec![vec![0.0; n]; method.b.len()], place: vec![0.0; n], next: vec![0.0; n] }
    }

    /// One step from y into `next`; the estimated error in units of max(1, |y|), root mean square, or zero without an estimate.
    fn attempt(&mut self, flow: &mut Flow<'_>, t: f64, y: &[f64], h: f64) -> Result<f64, SimulationError> {
        let Self { method, stages, place, next } = self;
        for s in 0..method.b.len() {
            let (done, rest) = stages.split_at_mut(s);
            let row = if s == 0 { &[][..] } else { method.a[s - 1] };
            for (i, place) in place.iter_mut().enumerate() {
                *place = y[i] + h * row.iter().zip(done.iter()).map(|(a, k)| a * k[i]).sum::<f64>();
            }
            flow.rate(t, place, &mut rest[0])?;
        }
        let along = |weights: &[f64], i: usize| -> f64 {
            h * weights.iter().zip(stages.iter()).map(|(b, k)| b * k[i]).sum::<f64>()
        };
        for (i, next) in next.iter_mut().enumerate() {
            *next = y[i] + along(method.b, i);
        }
        let Some(error) = method.error else { return Ok(0.0) };
        let squares = (0..y.len()).map(|i| (along(error, i) / y[i].abs().max(1.0)).powi(2)).sum::<f64>();
        Ok((squares / y.len() as f64).sqrt())
    }
}

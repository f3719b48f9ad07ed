//! Motion on the configuration manifold: forces in, positions and velocities out.
//!
//! ```text
//! q̇ = v along every joint's own manifold      v̇ = H⁻¹(q) (τ − C(q, v))
//! ```
//! | method | steps | order | for |
//! |--------|-------|-------|-----|
//! | semi-implicit Euler | fixed | 1 | what physics engines do |
//! | Runge-Kutta 4 | fixed | 4 | short motions, smooth forces |
//! | Dormand-Prince 5(4) | chosen by its own error estimate | 5 | accuracy |
//! | implicit midpoint | fixed | 2 | long motions: symplectic, keeps momenta |
//!
//! Steps of balls, planar joints and floating bases are taken in the coordinates θ of q = q₀ ⊕ θ, so that every method keeps its order on
//! them. Adaptive steps: accepted if the error is within the tolerance; h ← 0.9 h (tolerance/error)^(1/order): Hairer, Nørsett & Wanner,
//! *Solving Ordinary Differential Equations I* (1993), §II.4.

mod acceleration;
mod error;
mod event;
mod explicit;
mod flow;
mod force;
mod level;
mod midpoint;
mod simulation;
mod tableau;
mod trajectory;

pub use acceleration::Algorithm;
pub use error::SimulationError;
pub use event::{Event, Watch, joint_limits};
pub use force::{Controller, Forces, joint_springs, passive_springs};
pub use level::{LevelError, level};
pub use simulation::Simulation;
pub use tableau::{DORMAND_PRINCE, RK4, Tableau};
pub use trajectory::Trajectory;

use eigenbody::Model;
use std::ops::ControlFlow;

/// How a step is taken.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Method {
    /// v ← v + h v̇, then q ← q ⊕ h v.
    SemiImplicitEuler,
    /// An explicit Runge-Kutta method.
    RungeKutta(Tableau),
    /// The implicit midpoint rule in positions and momenta.
    ImplicitMidpoint,
}

impl Method {
    /// What it is called.
    pub fn name(&self) -> &'static str {
        match self {
            Self::SemiImplicitEuler => "semi-implicit Euler",
            Self::RungeKutta(tableau) => tableau.name,
            Self::ImplicitMidpoint => "implicit midpoint",
        }
    }
}

/// How steps are chosen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Steps {
    /// All of one length (s); shortened a little where samples then fall on their ends.
    Fixed(f64),
    /// So that the estimated error of a step stays below this: in rad and m, and in units of max(1, |v|); for methods that have an estimate.
    Adaptive(f64),
}

/// How to simulate.
#[derive(Debug, Clone, PartialEq)]
pub struct Schedule {
    /// The method.
    pub method: Method,
    /// Its steps.
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

/// What a simulation did.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Effort {
    /// Steps that were taken.
    pub steps: u64,
    /// Steps that were refused.
    pub refused: u64,
    /// Accelerations that were computed; for the implicit midpoint rule, rounds of its iteration.
    pub evaluations: u64,
}

/// What is reported on the way.
#[derive(Debug)]
pub enum Report<'a> {
    /// The state at a sampling time.
    Sample(&'a State),
    /// A watched function has changed its sign.
    Event(Event),
    /// A step was taken: whoever wants no more may say so.
    Step,
}

/// The motion of a mechanism under gravity alone, sampled at equal intervals, the start included.
///
/// | name | shape | unit |
/// |------|-------|------|
/// | `q`, `v` | `nq`, `nv`: the start | rad, m, unit quaternion; rad/s, m/s |
/// | returned | `intervals` + 1 states | s, rad, m, unit quaternion; rad/s, m/s |
///
/// Method: see the module. Numerics: a fixed method of order p errs by O(hᵖ); an adaptive one keeps the local error below its tolerance, and
/// samples between its steps come from an interpolant one order lower. Watch the energy.
///
/// Errors: [`SimulationError`].
///
/// ```
/// use eigenbody::Family;
/// use eigenbody_study::simulate::{DORMAND_PRINCE, Method, Schedule, Steps, simulate};
/// let rod = Family::slender_chain(1, 1.0, 1.0)?.model::<f64>()?;
/// let method = Method::RungeKutta(DORMAND_PRINCE);
/// let schedule = Schedule { method, steps: Steps::Adaptive(1e-10), span_s: 1.0, intervals: 10 };
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
    let mut simulation = Simulation::new(model, q, v, method, steps, Forces::default(), Algorithm::Aba)?;
    let mut motion = Vec::new();
    _ = simulation.run(span_s, intervals, &mut [], &mut |report| {
        if let Report::Sample(state) = report {
            motion.push(state.clone());
        }
        ControlFlow::Continue(())
    })?;
    Ok(motion)
}

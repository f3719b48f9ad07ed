//! The implicit midpoint rule in positions and momenta, as a variational integrator on the configuration manifold.
//!
//! ```text
//! u = h ξ      q_m = q₀ ⊕ u/2      g = ∂T/∂q(q_m, ξ) − ∂V/∂q(q_m) + τ      q₁ = q₀ ⊕ u
//! H(q_m) ξ = dexp_uᵀ p₀ + h/2 dexp_{u/2}ᵀ g                                 by fixed-point iteration for ξ
//! p₁ = dexp₋u⁻ᵀ ( H(q_m) ξ + h/2 dexp₋_{u/2}ᵀ g )                            p = H v
//! ```
//! The discrete Euler-Lagrange equations of L_d(q₀, q₁) = h L(q_m, ξ): Marsden & West, *Discrete mechanics and variational integrators*,
//! Acta Numerica 10 (2001); Bou-Rabee & Marsden, *Hamilton-Pontryagin integrators on Lie groups*, Found. Comput. Math. 9 (2009). Where
//! q̇ = v, dexp is the identity and this is the implicit midpoint rule for q and p. Symplectic, of order 2: without damping the energy
//! stays near its start for times of any practical length, and momentum belonging to a symmetry is kept exactly.

use super::error::SimulationError;
use super::flow::Flow;
use eigenbody::dynamics::{
    AbaWorkspace, GradientWorkspace, RneaWorkspace, forward_dynamics_into, gravity_force_into,
    inverse_dynamics_into, kinetic_energy_gradient_into,
};
use eigenbody::spatial::Vec3;
use eigenbody::{Error, InputError, Model};

/// Rounds before a step is given up.
const ROUNDS: usize = 200;
/// Change of ξ, against max(1, |ξ|), below which iteration ends as soon as the change no longer shrinks: the rest is rounding.
const SETTLED: f64 = 1e-9;

/// Room for one step.
#[derive(Debug)]
pub(super) struct Midpoint {
    /// The mechanism without weight: ABA at rest solves H x = b in it.
    weightless: Model<f64>,
    aba: AbaWorkspace<f64>,
    rnea: RneaWorkspace<f64>,
    gradient: GradientWorkspace<f64>,
    rest: Vec<f64>,
    /// p₀, known from the step before, if there is one; and p₁.
    p0: Vec<f64>,
    p1: Vec<f64>,
    /// ξ, and those of the two steps before, the later one first.
    xi: Vec<f64>,
    before: [Vec<f64>; 2],
    /// Steps that were accepted.
    steps: usize,
    g: Vec<f64>,
    weight: Vec<f64>,
    part: Vec<f64>,
    sum: Vec<f64>,
    q: Vec<f64>,
    pub v1: Vec<f64>,
}

impl Midpoint {
    pub fn new(model: &Model<f64>) -> Result<Self, InputError> {
        let weightless = model.clone().with_gravity(Vec3::ZERO)?;
        let zeros = vec![0.0; model.nv()];
        Ok(Self {
            aba: AbaWorkspace::new(&weightless),
            rnea: RneaWorkspace::new(&weightless),
            gradient: GradientWorkspace::new(model),
            weightless,
            rest: zeros.clone(),
            p0: zeros.clone(),
            p1: zeros.clone(),
            xi: zeros.clone(),
            before: [zeros.clone(), zeros.clone()],
            steps: 0,
            g: zeros.clone(),
            weight: zeros.clone(),
            part: zeros.clone(),
            sum: zeros.clone(),
            q: vec![0.0; model.nq()],
            v1: zeros,
        })
    }

    /// A step of h from (q₀, v₀); it counts once it is [accepted](Self::accept), and leaves nothing behind if it is not.
    pub fn attempt(
        &mut self,
        flow: &mut Flow<'_>,
        t: f64,
        (q0, v0): (&[f64], &[f64]),
        h: f64,
    ) -> Result<(), SimulationError> {
        let model = flow.model;
        let failed = |source: Error| SimulationError::dynamics(model, t, source);
        if self.steps == 0 {
            inverse_dynamics_into(&self.weightless, q0, &self.rest, v0, &mut self.rnea, &mut self.p0)
                .map_err(|source| failed(source.into()))?;
        }
        // ξ starts from where the last two lead.
        let [one, two] = &self.before;
        for (d, v0) in v0.iter().enumerate() {
            self.xi[d] = if self.steps > 1 { 2.0 * one[d] - two[d] } else { *v0 };
        }
        let mut last = f64::INFINITY;
        for round in 0.. {
            self.round(flow, t, q0, h).map_err(failed)?;
            flow.check(t, &self.part, h)?;
            let change = |d: usize| (self.part[d] - self.xi[d]).abs() / self.part[d].abs().max(1.0);
            let (worst, size) = (0..self.xi.len())
                .fold((0, 0.0), |worst, d| if change(d) > worst.1 { (d, change(d)) } else { worst });
            if size <= f64::EPSILON || size <= SETTLED && size >= last {
                // ξ stays the one that `sum` was made from: both halves of the step then meet exactly, and with them momenta.
                break;
            }
            self.xi.copy_from_slice(&self.part);
            if round == ROUNDS || size > 1e3 {
                let joint = model.dof_name(worst);
                return Err(SimulationError::NoConvergence { t, joint, step_s: h });
            }
            last = size;
        }
        self.finish(model, q0, h).map_err(failed)?;
        flow.check(t + h, &self.v1, h)
    }

    /// The next step begins where this one ends.
    pub fn accept(&mut self) {
        std::mem::swap(&mut self.p0, &mut self.p1);
        self.before.swap(0, 1);
        self.before[0].copy_from_slice(&self.xi);
        self.steps += 1;
    }

    /// g and the next ξ, into `part`; the momentum H ξ is left in `sum`.
    fn round(&mut self, flow: &mut Flow<'_>, t: f64, q0: &[f64], h: f64) -> Result<(), Error> {
        let model = flow.model;
        flow.evaluations += 1;
        let Self { weightless, aba, rnea, gradient, rest, p0, xi, g, weight, part, sum, q, .. } = self;
        part.iter_mut().zip(&*xi).for_each(|(part, xi)| *part = 0.5 * h * xi);
        model.integrate_into(q0, part, q);
        flow.acting.at(model, t + 0.5 * h, q, xi, g);
        kinetic_energy_gradient_into(model, q, xi, gradient, part)?;
        gravity_force_into(model, q, rnea, weight)?;
        for d in 0..g.len() {
            g[d] += part[d] - weight[d];
        }
        for joint in model.joints() {
            let (kind, at) = (joint.kind(), joint.dofs());
            let (mut u, mut half, mut from_p, mut from_g) = ([0.0; 6], [0.0; 6], [0.0; 6], [0.0; 6]);
            let n = at.len();
            for (k, d) in at.clone().enumerate() {
                (u[k], half[k]) = (h * xi[d], 0.5 * h * xi[d]);
            }
            kind.dexp_dual(&u[..n], &p0[at.clone()], &mut from_p[..n]);
            kind.dexp_dual(&half[..n], &g[at.clone()], &mut from_g[..n]);
            for (k, d) in at.enumerate() {
                sum[d] = from_p[k] + 0.5 * h * from_g[k];
            }
        }
        forward_dynamics_into(weightless, q, rest, sum, aba, part)
    }

    /// p₁, q₁ and v₁.
    fn finish(&mut self, model: &Model<f64>, q0: &[f64], h: f64) -> Result<(), Error> {
        let Self { weightless, aba, rest, p1, xi, g, part, sum, q, v1, .. } = self;
        for joint in model.joints() {
            let (kind, at) = (joint.kind(), joint.dofs());
            let (mut u, mut half, mut from_g) = ([0.0; 6], [0.0; 6], [0.0; 6]);
            let n = at.len();
            for (k, d) in at.clone().enumerate() {
                (u[k], half[k]) = (-h * xi[d], -0.5 * h * xi[d]);
            }
            kind.dexp_dual(&half[..n], &g[at.clone()], &mut from_g[..n]);
            for (k, d) in at.clone().enumerate() {
                sum[d] += 0.5 * h * from_g[k];
            }
            kind.dexp_inverse_dual(&u[..n], &sum[at.clone()], &mut p1[at]);
        }
        part.iter_mut().zip(&*xi).for_each(|(part, xi)| *part = h * xi);
        model.integrate_into(q0, part, q);
        forward_dynamics_into(weightless, q, rest, p1, aba, v1)
    }

    /// The constant velocity of the step.
    pub fn xi(&self) -> &[f64] {
        &self.xi
    }
}

//! One step of an explicit Runge-Kutta method on the configuration manifold.
//!
//! ```text
//! θ_s = h Σ_{j<s} a_sj θ̇_j      v_s = v₀ + h Σ_{j<s} a_sj v̇_j      q_s = q₀ ⊕ θ_s
//! θ̇_s = dexp₋θ⁻¹ v_s            v̇_s = H⁻¹(q_s) (τ − C)
//! θ(s) = h Σ b_i(s) θ̇_i          v(s) = v₀ + h Σ b_i(s) v̇_i
//! ```
//! Munthe-Kaas, *High order Runge-Kutta methods on manifolds*, Applied Numerical Mathematics 29 (1999): in the coordinates θ of the step
//! the equations live in a vector space, so that the method keeps its order on balls and floating bases.

use super::error::SimulationError;
use super::flow::Flow;
use super::tableau::Tableau;

/// Room for one step.
#[derive(Debug)]
pub(super) struct Explicit {
    tableau: Tableau,
    /// θ̇ and v̇ of every stage.
    theta_rate: Vec<Vec<f64>>,
    vdot: Vec<Vec<f64>>,
    /// Where a stage stands.
    theta: Vec<f64>,
    q: Vec<f64>,
    v: Vec<f64>,
    begun: Begun,
}

/// What is known of the first stage.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Begun {
    Nothing,
    /// All: the last attempt was refused and started from the same place.
    Everything,
    /// v̇ is that of the last stage of the step before.
    LastStage,
}

impl Explicit {
    pub fn new(tableau: Tableau, nq: usize, nv: usize) -> Self {
        let stages = vec![vec![0.0; nv]; tableau.b.len()];
        Self {
            tableau,
            theta_rate: stages.clone(),
            vdot: stages,
            theta: vec![0.0; nv],
            q: vec![0.0; nq],
            v: vec![0.0; nv],
            begun: Begun::Nothing,
        }
    }

    pub fn attempt(
        &mut self,
        flow: &mut Flow<'_>,
        t: f64,
        (q0, v0): (&[f64], &[f64]),
        h: f64,
    ) -> Result<(), SimulationError> {
        if self.begun == Begun::LastStage {
            let last = self.vdot.len() - 1;
            self.vdot.swap(0, last);
            self.theta_rate[0].copy_from_slice(v0);
        }
        let first = usize::from(self.begun != Begun::Nothing);
        self.begun = Begun::Nothing;
        for stage in first..self.tableau.b.len() {
            let row = if stage == 0 { &[][..] } else { self.tableau.a[stage - 1] };
            let Self { theta_rate, vdot, theta, q, v, .. } = self;
            combine(row.iter().copied(), theta_rate, h, theta);
            combine(row.iter().copied(), vdot, h, v);
            v.iter_mut().zip(v0).for_each(|(v, v0)| *v += v0);
            flow.model.integrate_into(q0, theta, q);
            let at = t + self.tableau.node(stage) * h;
            flow.check(at, v, h)?;
            flow.tangent_rate(theta, v, &mut theta_rate[stage]);
            flow.accelerate(at, q, v, &mut vdot[stage])?;
        }
        self.begun = Begun::Everything;
        Ok(())
    }

    /// θ and v within the step, s from 0 to 1.
    pub fn at(&self, s: f64, h: f64, v0: &[f64], theta: &mut [f64], v: &mut [f64]) {
        let weights = (0..self.tableau.b.len()).map(|stage| self.tableau.weight(stage, s));
        combine(weights.clone(), &self.theta_rate, h, theta);
        combine(weights, &self.vdot, h, v);
        v.iter_mut().zip(v0).for_each(|(v, v0)| *v += v0);
    }

    /// θ and v at the end of the step.
    pub fn end(&self, h: f64, v0: &[f64], theta: &mut [f64], v: &mut [f64]) {
        combine(self.tableau.b.iter().copied(), &self.theta_rate, h, theta);
        combine(self.tableau.b.iter().copied(), &self.vdot, h, v);
        v.iter_mut().zip(v0).for_each(|(v, v0)| *v += v0);
    }

    /// Estimated error of the step: θ in rad and m, v in units of max(1, |v|); root mean square, and the DoF that has most of it.
    pub fn error(&mut self, h: f64, v0: &[f64]) -> Option<(f64, usize)> {
        let weights = self.tableau.error?;
        let Self { theta_rate, vdot, theta, v, .. } = self;
        combine(weights.iter().copied(), theta_rate, h, theta);
        combine(weights.iter().copied(), vdot, h, v);
        let (mut sum, mut worst) = (0.0, (0.0, 0));
        for d in 0..v0.len() {
            let square = theta[d].powi(2) + (v[d] / v0[d].abs().max(1.0)).powi(2);
            sum += square;
            if square > worst.0 || square.is_nan() {
                worst = (square, d);
            }
        }
        Some(((sum / (2 * v0.len().max(1)) as f64).sqrt(), worst.1))
    }

    pub fn order(&self) -> u32 {
        self.tableau.order
    }

    /// The step is taken: the next attempt starts from its end.
    pub fn accept(&mut self) {
        let is_same = self.tableau.is_first_same_as_last();
        self.begun = if is_same { Begun::LastStage } else { Begun::Nothing };
    }
}

/// h Σ w_i k_i.
fn combine(weights: impl Iterator<Item = f64>, stages: &[Vec<f64>], h: f64, out: &mut [f64]) {
    out.fill(0.0);
    for (w, stage) in weights.zip(stages) {
        if w != 0.0 {
            out.iter_mut().zip(stage).for_each(|(out, k)| *out += h * w * k);
        }
    }
}

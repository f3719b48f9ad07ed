//! What moves: a model, its forces and an algorithm for accelerations.

use super::acceleration::{Accelerator, Algorithm};
use super::error::SimulationError;
use super::force::{Acting, Forces};
use eigenbody::Model;

/// A joint that goes further than this in one step (rad, m) is not followed any more.
const FURTHEST: f64 = 1e3;

/// v̇ = H⁻¹(τ − C).
#[derive(Debug)]
pub(super) struct Flow<'m> {
    pub model: &'m Model<f64>,
    accelerator: Accelerator<'m>,
    pub acting: Acting,
    tau: Vec<f64>,
    /// Accelerations that were found so far.
    pub evaluations: u64,
}

impl<'m> Flow<'m> {
    pub fn new(model: &'m Model<f64>, forces: Forces, algorithm: Algorithm) -> Result<Self, SimulationError> {
        let accelerator = Accelerator::new(model, algorithm)
            .map_err(|source| SimulationError::dynamics(model, 0.0, source))?;
        let acting = Acting::new(model, forces)?;
        Ok(Self { model, accelerator, acting, tau: vec![0.0; model.nv()], evaluations: 0 })
    }

    /// v̇ at (t, q, v).
    pub fn accelerate(
        &mut self,
        t: f64,
        q: &[f64],
        v: &[f64],
        vdot: &mut [f64],
    ) -> Result<(), SimulationError> {
        self.evaluations += 1;
        self.acting.at(self.model, t, q, v, &mut self.tau);
        self.accelerator
            .accelerate(q, v, &self.tau, vdot)
            .map_err(|source| SimulationError::dynamics(self.model, t, source))
    }

    /// θ̇ = dexp₋θ⁻¹ v, joint by joint.
    pub fn tangent_rate(&self, theta: &[f64], v: &[f64], rate: &mut [f64]) {
        for joint in self.model.joints() {
            let at = joint.dofs();
            joint.kind().tangent_rate(&theta[at.clone()], &v[at.clone()], &mut rate[at]);
        }
    }

    /// Refuses velocities that carry a joint beyond all sense within a step.
    pub fn check(&self, t: f64, v: &[f64], h: f64) -> Result<(), SimulationError> {
        let fastest = v.iter().enumerate().fold((0, 0.0), |worst: (usize, f64), (d, v)| {
            if v.abs() > worst.1 || v.is_nan() && !worst.1.is_nan() { (d, v.abs()) } else { worst }
        });
        if fastest.1 * h <= FURTHEST {
            return Ok(());
        }
        Err(SimulationError::BlownUp {
            t,
            joint: self.model.dof_name(fastest.0),
            speed: fastest.1,
            unit: if self.model.is_translation(fastest.0) { "m/s" } else { "rad/s" },
            step_s: h,
        })
    }
}

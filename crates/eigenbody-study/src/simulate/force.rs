//! Forces on the joints, gravity aside.
//!
//! ```text
//! τ = −damping v − stiffness (q ⊖ rest) + kp (target(t) ⊖ q) + kd (target'(t) − v) + torque(t)
//! ```

use super::trajectory::Trajectory;
use eigenbody::{InputError, Model, mass_matrix};

/// A controller that pulls to a posture or along a trajectory.
#[derive(Debug, Clone, PartialEq)]
pub struct Controller {
    /// Configurations over time.
    pub target: Trajectory,
    /// nv: gains (N m/rad, N/m).
    pub kp: Vec<f64>,
    /// nv: gains (N m s/rad, N s/m).
    pub kd: Vec<f64>,
}

impl Controller {
    /// Gains ω² H_dd and 2ζω H_dd with ω = 2π `frequency_hz` and H at the first target; none on a floating base, which has no motors.
    ///
    /// Errors: [`InputError`] if the target does not fit the model.
    pub fn tuned(
        model: &Model<f64>,
        target: Trajectory,
        frequency_hz: f64,
        damping_ratio: f64,
    ) -> Result<Self, InputError> {
        target.rows().iter().try_for_each(|q| model.check_q(q))?;
        let H = mass_matrix(model, &target.rows()[0])?;
        let omega = std::f64::consts::TAU * frequency_hz;
        let base = if model.has_floating_base() { 6 } else { 0 };
        let inertia = |d: usize| if d < base { 0.0 } else { H[(d, d)] };
        let kp = (0..model.nv()).map(|d| omega * omega * inertia(d)).collect();
        let kd = (0..model.nv()).map(|d| 2.0 * damping_ratio * omega * inertia(d)).collect();
        Ok(Self { target, kp, kd })
    }
}

/// All forces on the joints but gravity. Empty lists and none: no such force.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Forces {
    /// nv: viscous damping (N m s/rad, N s/m).
    pub damping: Vec<f64>,
    /// nv: springs (N m/rad, N/m).
    pub stiffness: Vec<f64>,
    /// nq: where the springs are slack.
    pub rest: Vec<f64>,
    /// A controller.
    pub controller: Option<Controller>,
    /// External forces over time, nv a row (N m, N).
    pub torque: Option<Trajectory>,
}

/// Forces with room to evaluate them.
#[derive(Debug, Clone)]
pub(super) struct Acting {
    forces: Forces,
    q: Vec<f64>,
    v: Vec<f64>,
}

impl Acting {
    pub fn new(model: &Model<f64>, forces: Forces) -> Result<Self, InputError> {
        let fits = |what, x: &[f64]| if x.is_empty() { Ok(()) } else { model.check_v(what, x) };
        fits("damping", &forces.damping)?;
        fits("stiffness", &forces.stiffness)?;
        if !forces.stiffness.is_empty() {
            model.check_q(&forces.rest)?;
        }
        if let Some(controller) = &forces.controller {
            model.check_v("kp", &controller.kp)?;
            model.check_v("kd", &controller.kd)?;
            controller.target.rows().iter().try_for_each(|q| model.check_q(q))?;
        }
        if let Some(torque) = &forces.torque {
            torque.rows().iter().try_for_each(|tau| model.check_v("torque", tau))?;
        }
        Ok(Self { forces, q: vec![0.0; model.nq()], v: vec![0.0; model.nv()] })
    }

    /// τ at (t, q, v).
    pub fn at(&mut self, model: &Model<f64>, t: f64, q: &[f64], v: &[f64], tau: &mut [f64]) {
        let Self { forces, q: other, v: way } = self;
        match &forces.torque {
            Some(torque) => torque.numbers(t, tau),
            None => tau.fill(0.0),
        }
        for ((tau, damping), v) in tau.iter_mut().zip(&forces.damping).zip(v) {
            *tau -= damping * v;
        }
        if !forces.stiffness.is_empty() {
            model.difference_into(&forces.rest, q, way);
            for ((tau, stiffness), x) in tau.iter_mut().zip(&forces.stiffness).zip(&*way) {
                *tau -= stiffness * x;
            }
        }
        if let Some(Controller { target, kp, kd }) = &forces.controller {
            target.configuration(model, t, other, way);
            for d in 0..v.len() {
                tau[d] += kd[d] * (way[d] - v[d]);
            }
            model.difference_into(q, other, way);
            for d in 0..v.len() {
                tau[d] += kp[d] * way[d];
            }
        }
    }
}

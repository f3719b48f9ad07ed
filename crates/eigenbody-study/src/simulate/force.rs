//! Forces on the joints, gravity aside.
//!
//! ```text
//! l = Σ a_d (q ⊖ rest)_d      τ_d = −Σ a_d (k l + c l̇) + kp_d (target(t) ⊖ q)_d + kd_d (target'(t) − v)_d + torque_d(t)
//! ```

use super::trajectory::Trajectory;
use eigenbody::stability::{Spring, SpringSource};
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
        let base = model.base_dofs();
        let inertia = |d: usize| if d < base { 0.0 } else { H[(d, d)] };
        let kp = (0..model.nv()).map(|d| omega * omega * inertia(d)).collect();
        let kd = (0..model.nv()).map(|d| 2.0 * damping_ratio * omega * inertia(d)).collect();
        Ok(Self { target, kp, kd })
    }
}

/// All forces on the joints but gravity. Empty lists and none: no such force.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Forces {
    /// Springs and dampers: those of a robot's file, or [`joint_springs`].
    pub springs: Vec<Spring>,
    /// nq: where the springs are slack. May be empty where none is stiff.
    pub rest: Vec<f64>,
    /// A controller.
    pub controller: Option<Controller>,
    /// External forces over time, nv a row (N m, N).
    pub torque: Option<Trajectory>,
}

/// The same spring and damper on every degree of freedom but those of a floating base.
pub fn joint_springs(model: &Model<f64>, stiffness: f64, damping: f64) -> Vec<Spring> {
    let base = model.base_dofs();
    let spring = |d| {
        let (name, arms) = (model.dof_name(d), vec![(d, 1.0)]);
        Spring { name, source: SpringSource::Joint, arms, stiffness, damping }
    };
    (base..model.nv()).map(spring).collect()
}

/// Springs and dampers that a robot's file has of its own, and more on single degrees of freedom, none where a list is empty.
///
/// The feedback of actuators among them is left out: that is a [`Controller`]'s.
pub fn passive_springs(
    model: &Model<f64>,
    own: &[Spring],
    damping: &[Option<f64>],
    stiffness: &[Option<f64>],
) -> Vec<Spring> {
    let mut springs: Vec<Spring> =
        own.iter().filter(|spring| spring.source != SpringSource::Actuator).cloned().collect();
    let mut add = |gains: &[Option<f64>], part: fn(&mut Spring) -> &mut f64| {
        for (d, gain) in gains.iter().enumerate().filter_map(|(d, gain)| Some((d, (*gain)?))) {
            let (name, arms, source) = (model.dof_name(d), vec![(d, 1.0)], SpringSource::Joint);
            let mut spring = Spring { name, source, arms, stiffness: 0.0, damping: 0.0 };
            *part(&mut spring) = gain;
            springs.push(spring);
        }
    };
    add(damping, |spring| &mut spring.damping);
    add(stiffness, |spring| &mut spring.stiffness);
    springs.retain(|spring| spring.stiffness != 0.0 || spring.damping != 0.0);
    springs
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
        for (index, spring) in forces.springs.iter().enumerate() {
            spring.check(model.nv(), index)?;
        }
        if forces.springs.iter().any(|spring| spring.stiffness != 0.0) {
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
        if forces.rest.is_empty() {
            way.fill(0.0);
        } else {
            model.difference_into(&forces.rest, q, way);
        }
        for Spring { arms, stiffness, damping, .. } in &forces.springs {
            let force = arms.iter().fold(0.0, |sum, &(d, a)| sum + a * (stiffness * way[d] + damping * v[d]));
            arms.iter().for_each(|&(d, a)| tau[d] -= a * force);
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

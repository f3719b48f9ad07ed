//! The largest stable step over the joint limits, and the largest gains at a step.
//!
//! ```text
//! samples  ->  those at which the best bound so far is not stable (one Cholesky each)  ->  the bound there, exactly
//! the worst of them  ->  descent of h:  dh = 2 xᵀdH x / (xᵀΔx + h xᵀKx),  x the motion that sets h
//! one joint alone    kp ≤ c m/h²,  kd ≤ d m/h,  m = 1/(H⁻¹)_dd: its inertia with the others free
//! a mode             the same with m = λ: gains that are equal on all joints
//! ```
//! c = 4, d = 2 for Euler's methods, 8 and 2.785 for Runge-Kutta 4; kd is without bound where damping is implicit. Runge-Kutta's own
//! worst is looked for among the worst of the others.

mod field;
mod gains;

use super::{Drive, Part, Worst};
use crate::StudyError;
use eigenbody::search::Effort;
use eigenbody::stability::{Impedance, Integrator};
use eigenbody::{Model, Reduction};
use field::Field;
use std::ops::ControlFlow;

/// Configurations sampled at most.
const SAMPLES: u32 = 512;

/// What steps and gains are stable.
#[derive(Debug, Clone, PartialEq)]
pub struct Stepping {
    /// The step that is wanted (s), and how it is made.
    pub step: Option<f64>,
    /// How a step is made.
    pub integrator: Integrator,
    /// False if springs or dampers give energy away: then no step is stable, and nothing else is said.
    pub passive: bool,
    /// The largest stable step of each integrator, with the springs as they are; none without springs.
    pub limits: Vec<WorstStep>,
    /// What each joint bears at the step.
    pub joints: Vec<JointGains>,
    /// What the modes bear at the step, where λmin is least: the softest first.
    pub modes: Vec<ModeGains>,
}

/// The largest step that is stable everywhere.
#[derive(Debug, Clone, PartialEq)]
pub struct WorstStep {
    /// The integrator.
    pub integrator: Integrator,
    /// The step (s); infinite if every step is stable.
    pub step: f64,
    /// The configuration that bears no larger one; empty for an infinite step.
    pub at: Vec<f64>,
    /// Largest eigenvalues there of (K, H) (1/s²) and (D, H) (1/s).
    pub pencils: [f64; 2],
    /// The joints whose springs pull in the motion that grows, the largest part first.
    pub dofs: Vec<Part>,
}

impl WorstStep {
    /// What the two pencils alone say of semi-implicit Euler's step: at least, and at most.
    pub fn bracket(&self) -> [f64; 2] {
        let [k, d] = self.pencils;
        [4.0 / (d + d.mul_add(d, 4.0 * k).sqrt()), (2.0 / k.sqrt()).min(2.0 / d)]
    }
}

/// What a joint has and what it bears.
#[derive(Debug, Clone, PartialEq)]
pub struct JointGains {
    /// The degree of freedom.
    pub joint: String,
    /// Stiffness and damping that it has, all springs together (K_dd, D_dd).
    pub has: [f64; 2],
    /// 1/(H⁻¹)_dd, the least found: its inertia with all others free (kg m², kg).
    pub inertia: f64,
    /// Where.
    pub at: Vec<f64>,
    /// The largest kp and kd alone at the step, nothing else pulling.
    pub bears: Option<[f64; 2]>,
}

/// What gains that are equal on all joints a mode bears.
#[derive(Debug, Clone, PartialEq)]
pub struct ModeGains {
    /// The mode's inertia.
    pub lambda: f64,
    /// The largest kp and kd at the step; none without a step.
    pub bears: Option<[f64; 2]>,
    /// Joints, the largest share first.
    pub dofs: Vec<Part>,
}

/// None where there is nothing to say: neither springs nor a step.
pub(super) fn stepping(
    model: &Model<f64>,
    reduction: Reduction,
    drive: &Drive,
    effort: Effort,
    worst: &[Worst],
    progress: &Progress<'_>,
) -> Result<Option<Stepping>, StudyError> {
    let impedance = Impedance::new(model, reduction, &drive.springs)?;
    if impedance.is_zero() && drive.step.is_none() {
        return Ok(None);
    }
    let (step, integrator) = (drive.step, drive.integrator);
    let nothing = Stepping {
        step,
        integrator,
        passive: false,
        limits: Vec::new(),
        joints: Vec::new(),
        modes: Vec::new(),
    };
    if !impedance.is_passive()? {
        return Ok(Some(nothing));
    }
    let known: Vec<Vec<f64>> = worst.iter().map(|worst| worst.spread.at.clone()).collect();
    let field = Field::new(model, reduction, &impedance, progress)?;
    let effort = Effort { samples: effort.samples.min(SAMPLES), ..effort };
    let limits = if impedance.is_zero() { Vec::new() } else { field.limits(integrator, effort, &known)? };
    let joints = field.joints(drive, effort, &known)?;
    let modes = gains::modes(model, reduction, drive, worst)?;
    Ok(Some(Stepping { passive: true, limits, joints, modes, ..nothing }))
}

/// The largest stable step of one integrator over the joint limits, and where.
pub(super) fn worst_step(
    model: &Model<f64>,
    reduction: Reduction,
    impedance: &Impedance,
    integrator: Integrator,
    effort: Effort,
    known: &[Vec<f64>],
) -> Result<(f64, Vec<f64>), StudyError> {
    let field = Field::new(model, reduction, impedance, &|_| ControlFlow::Continue(()))?;
    let found = field.records(&[integrator], effort, known)?;
    let worst = found[0].iter().min_by(|a, b| a.0.total_cmp(&b.0));
    Ok(worst.map_or((f64::INFINITY, Vec::new()), |(step, point)| (*step, field.domain.configuration(point))))
}

/// Who may end a search, asked before each configuration.
type Progress<'a> = dyn Fn(usize) -> ControlFlow<()> + Sync + 'a;

/// Names with their rates and shares, the largest share first.
fn parts(names: &[String], x: &[f64], weight: &[f64]) -> Vec<Part> {
    let total: f64 = weight.iter().sum();
    let of = |d: usize| Part { name: names[d].clone(), rate: x[d], share: weight[d] / total };
    let mut parts: Vec<Part> = (0..x.len()).map(of).collect();
    parts.sort_by(|a, b| b.share.total_cmp(&a.share));
    parts
}

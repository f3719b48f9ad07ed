//! Verdicts: what is wrong, how gravely, and for whom.

use super::{Diagnosis, Mechanism, Part, Stepping, Worst};
use eigenbody::search::Measure;

/// How much a finding matters.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Severity {
    /// Good to know.
    Note,
    /// Will hurt some uses.
    Warning,
    /// Nothing that solves with H can work.
    Error,
}

/// What a finding endangers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Use {
    /// Everything.
    Everything,
    /// Solves with H: forward dynamics, operational-space control.
    Solves,
    /// Simulation in single precision, as on GPUs.
    SinglePrecision,
    /// Gains, explicit time steps, gradients.
    Gains,
    /// Simulation and control at the step that is wanted.
    Stepping,
}

/// Thresholds of findings.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits {
    /// κ′ above which solves in double precision are warned of.
    pub kappa_weighted: f64,
    /// κ above which gains and explicit steps are.
    pub kappa: f64,
    /// Digits that single precision must keep.
    pub f32_digits: f64,
}

impl Default for Limits {
    fn default() -> Self {
        Self { kappa_weighted: 1e8, kappa: 1e9, f32_digits: 3.0 }
    }
}

/// One thing that is wrong.
#[derive(Debug, Clone, PartialEq)]
pub struct Finding {
    /// A stable name.
    pub id: &'static str,
    /// How gravely.
    pub severity: Severity,
    /// What it endangers.
    pub endangers: Use,
    /// What was measured.
    pub value: f64,
    /// What it was held against.
    pub limit: f64,
    /// Degrees of freedom to blame.
    pub joints: Vec<String>,
    /// All coordinates of the configuration; empty where it holds in every one.
    pub at: Vec<f64>,
    /// How it comes about.
    pub mechanism: Option<Mechanism>,
}

pub(super) fn findings(found: &Diagnosis, limits: &Limits) -> Vec<Finding> {
    // What holds everywhere need not be said again of the worst configuration.
    if !found.null_motions.is_empty() {
        let mut joints = Vec::new();
        for (name, _) in found.null_motions.iter().flat_map(|motion| &motion.rates) {
            if !joints.contains(name) {
                joints.push(name.clone());
            }
        }
        return vec![Finding {
            id: "moves-no-mass",
            severity: Severity::Error,
            endangers: Use::Everything,
            value: found.null_motions.len() as f64,
            limit: 0.0,
            joints,
            at: Vec::new(),
            mechanism: None,
        }];
    }
    let mut findings = Vec::new();
    if let Some(worst) = found.by(Measure::KappaWeighted) {
        if worst.spread.worst > limits.kappa_weighted {
            let finding = at(worst, "solves", Use::Solves, worst.spread.worst, limits.kappa_weighted);
            findings.push(finding);
        }
        // Where H is singular there is nothing to measure, and nothing left.
        let left = found.digits.as_ref().map_or(0.0, super::Digits::left_in_f32);
        if left < limits.f32_digits {
            findings.push(at(worst, "single-precision", Use::SinglePrecision, left, limits.f32_digits));
        }
    }
    if let Some(worst) = found.by(Measure::Kappa)
        && worst.spread.worst > limits.kappa
    {
        findings.push(at(worst, "gains", Use::Gains, worst.spread.worst, limits.kappa));
    }
    findings.extend(found.stepping.as_ref().and_then(time_step));
    findings.sort_by_key(|finding| std::cmp::Reverse(finding.severity));
    findings
}

/// The step that is wanted is not stable everywhere.
fn time_step(stepping: &Stepping) -> Option<Finding> {
    let finding = |step: f64, limit: f64, joints: Vec<String>, at: Vec<f64>| Finding {
        id: "time-step",
        severity: Severity::Warning,
        endangers: Use::Stepping,
        value: step,
        limit,
        joints,
        at,
        mechanism: None,
    };
    if !stepping.passive {
        // Without a step of its own: none of any length is stable.
        return Some(finding(stepping.step.unwrap_or(f64::INFINITY), 0.0, Vec::new(), Vec::new()));
    }
    let step = stepping.step?;
    let own = stepping.limits.iter().find(|limit| limit.integrator == stepping.integrator)?;
    let joints = nine_tenths(&own.dofs);
    (step > own.step).then(|| finding(step, own.step, joints, own.at.clone()))
}

/// As many names as make up nine tenths.
fn nine_tenths(parts: &[Part]) -> Vec<String> {
    let mut sum = 0.0;
    let few = parts.iter().take_while(|part| {
        let before = sum;
        sum += part.share;
        before < 0.9
    });
    few.map(|part| part.name.clone()).collect()
}

fn at(worst: &Worst, id: &'static str, endangers: Use, value: f64, limit: f64) -> Finding {
    let joints = worst.blame.as_ref().map_or_else(Vec::new, |blame| nine_tenths(&blame.soft.dofs));
    Finding {
        id,
        severity: Severity::Warning,
        endangers,
        value,
        limit,
        joints,
        at: worst.spread.at.clone(),
        mechanism: worst.blame.as_ref().map(|blame| blame.mechanism.clone()),
    }
}

//! Stable steps and gains, for people and for programs.

use super::words::number;
use eigenbody::stability::Integrator;
use eigenbody_study::diagnosis::{JointGains, ModeGains, Part, Stepping, WorstStep};
use serde::Serialize;
use std::fmt::Write;

/// What steps and gains are stable.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SteppingReport {
    /// The step that is wanted (s).
    pub step: Option<f64>,
    /// How it is made.
    pub integrator: &'static str,
    /// False if springs or dampers give energy away: then no step is stable.
    pub passive: bool,
    /// The largest stable step of each integrator.
    pub limits: Vec<StepReport>,
    /// What joints have and bear.
    pub joints: Vec<JointGainsReport>,
    /// What the modes bear, where λmin is least.
    pub modes: Vec<ModeGainsReport>,
}

/// The largest stable step of an integrator.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct StepReport {
    /// The integrator.
    pub integrator: &'static str,
    /// The step (s); `null` if every step is stable.
    pub largest: Option<f64>,
    /// Where; empty for everywhere.
    pub q: Vec<f64>,
    /// Largest eigenvalue there of (K, H) (1/s²).
    pub stiffness: f64,
    /// Largest eigenvalue there of (D, H) (1/s).
    pub damping: f64,
    /// What these two alone say of the step of semi-implicit Euler: at least, and at most.
    pub bracket: Option<[f64; 2]>,
    /// Who pulls in the motion that grows.
    pub joints: Vec<PullReport>,
}

/// A joint's part of a pull.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PullReport {
    /// Its name.
    pub joint: String,
    /// Its rate in the motion.
    pub rate: f64,
    /// Its part.
    pub share: f64,
}

/// Gains of a joint.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct JointGainsReport {
    /// Its name.
    pub joint: String,
    /// Stiffness and damping that it has, all springs together.
    pub stiffness: f64,
    /// Damping.
    pub damping: f64,
    /// Its least inertia with all others free (kg m², kg).
    pub inertia: f64,
    /// Where.
    pub q: Vec<f64>,
    /// The largest stiffness that it bears alone at the step.
    pub largest_kp: Option<f64>,
    /// The largest damping; `null` where damping is implicit.
    pub largest_kd: Option<f64>,
}

/// Gains of a mode: equal on all joints.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ModeGainsReport {
    /// Its inertia.
    pub lambda: f64,
    /// The largest kp at the step.
    pub largest_kp: Option<f64>,
    /// The largest kd; `null` where damping is implicit.
    pub largest_kd: Option<f64>,
    /// Its joints.
    pub joints: Vec<PullReport>,
}

/// Joints named of a mode.
const NAMED: usize = 3;

fn finite(x: f64) -> Option<f64> {
    x.is_finite().then_some(x)
}

fn pulls(parts: &[Part]) -> Vec<PullReport> {
    let of = |part: &Part| PullReport { joint: part.name.clone(), rate: part.rate, share: part.share };
    parts.iter().map(of).collect()
}

fn each(bears: Option<[f64; 2]>) -> [Option<f64>; 2] {
    [0, 1].map(|k| bears.and_then(|bears| finite(bears[k])))
}

impl From<&Stepping> for SteppingReport {
    fn from(found: &Stepping) -> Self {
        let limit = |limit: &WorstStep| StepReport {
            integrator: limit.integrator.name(),
            largest: finite(limit.step),
            q: limit.at.clone(),
            stiffness: limit.pencils[0],
            damping: limit.pencils[1],
            bracket: Some(limit.bracket()).filter(|_| limit.integrator == Integrator::SemiImplicitEuler),
            joints: pulls(&limit.dofs),
        };
        let joint = |joint: &JointGains| {
            let [largest_kp, largest_kd] = each(joint.bears);
            JointGainsReport {
                joint: joint.joint.clone(),
                stiffness: joint.has[0],
                damping: joint.has[1],
                inertia: joint.inertia,
                q: joint.at.clone(),
                largest_kp,
                largest_kd,
            }
        };
        let mode = |mode: &ModeGains| {
            let [largest_kp, largest_kd] = each(mode.bears);
            let joints = pulls(&mode.dofs[..mode.dofs.len().min(NAMED)]);
            ModeGainsReport { lambda: mode.lambda, largest_kp, largest_kd, joints }
        };
        Self {
            step: found.step,
            integrator: found.integrator.name(),
            passive: found.passive,
            limits: found.limits.iter().map(limit).collect(),
            joints: found.joints.iter().map(joint).collect(),
            modes: found.modes.iter().map(mode).collect(),
        }
    }
}

/// A time: seconds, milli-, micro- or nanoseconds.
pub(super) fn time(seconds: f64) -> String {
    match seconds {
        t if !t.is_finite() => "without limit".into(),
        t if t >= 1.0 => format!("{} s", short(t)),
        t if t >= 1e-3 => format!("{} ms", short(1e3 * t)),
        t if t >= 1e-6 => format!("{} µs", short(1e6 * t)),
        t if t >= 1e-9 => format!("{} ns", short(1e9 * t)),
        _ => "below 1 ns".into(),
    }
}

/// Three digits, without zeros at the end.
fn short(x: f64) -> String {
    let text = number(x);
    match text.contains('.') && !text.contains('e') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text,
    }
}

/// The names and shares of the largest parts.
pub(super) fn shares(parts: &[Part]) -> String {
    let large = parts.iter().take(NAMED).filter(|part| part.share > 0.01);
    let named: Vec<String> = large.map(|part| format!("{} {:.0}%", part.name, 100.0 * part.share)).collect();
    named.join(", ")
}

/// Three lines at most: steps, who sets them, gains.
pub(super) fn stepping_text(found: &Stepping) -> String {
    let mut text = String::new();
    if !found.passive {
        return "  time step: none is stable: a stiffness or damping is below zero\n".into();
    }
    if !found.limits.is_empty() {
        let steps: Vec<String> = found
            .limits
            .iter()
            .map(|limit| format!("{} {}", limit.integrator.name(), time(limit.step)))
            .collect();
        let _ = writeln!(text, "  largest stable step: {}", steps.join(" · "));
    }
    let least = |k: usize| {
        let bears = found.joints.iter().filter_map(|joint| Some((joint.bears?[k], joint)));
        bears.filter(|(gain, _)| gain.is_finite()).min_by(|a, b| a.0.total_cmp(&b.0))
    };
    if let (Some(step), Some((kp, joint))) = (found.step, least(0)) {
        let mut gains = format!("kp {}", short(kp));
        if let Some((kd, _)) = least(1) {
            let _ = write!(gains, ", kd {}", short(kd));
        }
        let _ = write!(
            text,
            "  at {} {} bears {gains} on '{}' alone",
            time(step),
            found.integrator.name(),
            joint.joint
        );
        if let Some(ModeGains { bears: Some([kp, kd]), .. }) = found.modes.first() {
            let _ = write!(text, ", kp {}", short(*kp));
            if kd.is_finite() {
                let _ = write!(text, ", kd {}", short(*kd));
            }
            text.push_str(" on all joints");
        }
        text.push('\n');
    }
    text
}

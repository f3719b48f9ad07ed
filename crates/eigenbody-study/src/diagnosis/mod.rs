//! What is wrong with a robot, where, and what to change.
//!
//! ```text
//! survey of the joint limits  ->  the worst configurations by κ, κ′, λmin
//! blame of their modes        ->  which joints and links, by which mechanism
//! exact null motions          ->  what moves no mass anywhere
//! digits, measured            ->  float32-safe or not
//! gradients of the modes      ->  which mass, inertia or armature moves κ most
//! springs, dampers, feedback  ->  the largest stable step, the largest gains
//! limits                      ->  findings
//! ```

mod advise;
mod blame;
mod digits;
mod drive;
mod finding;
mod rest;
mod sensitivity;
mod stepping;

pub use advise::{
    Added, Advice, Change, Goal, LimitAdvice, LinkAdvice, Remedies, Wish, least_armature, remedies,
};
pub(crate) use blame::softest;
pub use blame::{Blame, Mechanism, Part, Soft};
pub use digits::{Digits, Loss};
pub use drive::Drive;
pub use finding::{Finding, Limits, Severity, Use};
pub use rest::NullMotion;
pub use sensitivity::{Parameter, Sensitivity};
pub use stepping::{JointGains, ModeGains, Stepping, WorstStep};

use crate::StudyError;
use eigenbody::search::{Effort, Evaluator, Measure, Spread, Survey, Values, survey};
use eigenbody::{Error, Metric, Model, Reduction};
use std::ops::ControlFlow;

/// How to look.
#[derive(Debug, Clone, PartialEq)]
pub struct Question {
    /// Which degrees of freedom.
    pub reduction: Reduction,
    /// The metric of κ and λmin.
    pub metric: Metric<f64>,
    /// How hard to search.
    pub effort: Effort,
    /// What counts as a finding.
    pub limits: Limits,
    /// How the robot is driven and simulated.
    pub drive: Drive,
}

impl Default for Question {
    fn default() -> Self {
        Self {
            reduction: Reduction::default(),
            metric: Metric::Euclidean,
            effort: Effort::default(),
            limits: Limits::default(),
            drive: Drive::default(),
        }
    }
}

/// The worst configuration by one measure, and who is to blame.
#[derive(Debug, Clone, PartialEq)]
pub struct Worst {
    /// Where, and how the measure is spread over the joint limits.
    pub spread: Spread,
    /// All measures there.
    pub values: Values,
    /// The softest mode there and its mechanism; none for a robot that cannot move.
    pub blame: Option<Blame>,
}

/// All that was found.
#[derive(Debug, Clone, PartialEq)]
pub struct Diagnosis {
    /// Names of the degrees of freedom of the study.
    pub dofs: Vec<String>,
    /// Unit of λmin.
    pub unit: &'static str,
    /// By κ, κ′ and λmin.
    pub worst: Vec<Worst>,
    /// Configurations evaluated.
    pub evaluations: usize,
    /// Motions that move no mass in any configuration.
    pub null_motions: Vec<NullMotion>,
    /// What single precision and double precision keep of a solve at the worst κ′; none for a singular robot.
    pub digits: Option<Digits>,
    /// What moves κ most where it is worst.
    pub sensitivities: Vec<Sensitivity>,
    /// Stable steps and gains; none without springs and without a step, and for a robot with motions that move no mass.
    pub stepping: Option<Stepping>,
    /// What is wrong, the gravest first.
    pub findings: Vec<Finding>,
}

impl Diagnosis {
    /// The worst by a measure.
    pub fn by(&self, measure: Measure) -> Option<&Worst> {
        self.worst.iter().find(|worst| worst.spread.measure == measure)
    }
}

/// Examines a robot over its joint limits.
///
/// Method: [`survey`], then modes, energy shares and joint axes at the worst configurations, null motions in double-double, and the
/// loss of digits of forward dynamics against double-double. `progress` is told of configurations as they are evaluated, from any thread.
///
/// Errors: [`StudyError`] if the metric does not fit or a floating base is missing; [`Error::Interrupted`] soon after `progress` breaks.
///
/// ```
/// use eigenbody::search::{Effort, Measure};
/// use eigenbody_study::diagnosis::{Question, diagnose};
/// use std::ops::ControlFlow::Continue;
/// let arm = eigenbody::Family::hydra(3, 1.0, 0.0, 1.0)?.model::<f64>()?;
/// let question = Question { effort: Effort { samples: 64, ..Effort::default() }, ..Question::default() };
/// let found = diagnose(&arm, &question, |_| Continue(()))?;
/// assert!((found.by(Measure::Kappa).unwrap().spread.worst - 306.06).abs() < 0.01);
/// assert!(found.findings.is_empty());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn diagnose(
    model: &Model<f64>,
    question: &Question,
    progress: impl Fn(usize) -> ControlFlow<()> + Sync,
) -> Result<Diagnosis, StudyError> {
    let Question { reduction, metric, effort, limits, drive } = question;
    let rows = reduction.dofs(model);
    let dofs: Vec<String> = rows.iter().map(|&d| model.dof_name(d)).collect();
    let unit = metric.unit(rows.iter().map(|&d| model.is_translation(d)));
    if rows.is_empty() {
        let (worst, null_motions, findings) = (Vec::new(), Vec::new(), Vec::new());
        return Ok(Diagnosis {
            dofs,
            unit,
            worst,
            evaluations: 0,
            null_motions,
            digits: None,
            sensitivities: Vec::new(),
            stepping: None,
            findings,
        });
    }
    let null_motions = rest::null_motions(model, *reduction)?;
    let Survey { spreads, evaluations } = survey(model, *reduction, metric, *effort, &progress)?;
    let mut evaluator = Evaluator::new(model, *reduction, metric.clone())?;
    let mut worst = Vec::new();
    for spread in spreads {
        proceed(&progress)?;
        let values = evaluator.values(&spread.at)?;
        let blame = blame::blame(model, *reduction, metric, &evaluator, &spread)?;
        worst.push(Worst { spread, values, blame });
    }
    let at = worst.iter().find(|worst| worst.spread.measure == Measure::KappaWeighted);
    proceed(&progress)?;
    let digits = match at {
        Some(worst) if null_motions.is_empty() => digits::measure(model, *reduction, &worst.spread.at)?,
        _ => None,
    };
    let stepping = match null_motions.is_empty() {
        true => stepping::stepping(model, *reduction, drive, *effort, &worst, &progress)?,
        false => None,
    };
    proceed(&progress)?;
    let sensitivities = match worst.iter().find(|worst| worst.spread.measure == Measure::Kappa) {
        Some(worst) => sensitivity::sensitivities(model, *reduction, metric, &evaluator, &worst.spread.at)?,
        None => Vec::new(),
    };
    let mut found = Diagnosis {
        dofs,
        unit,
        worst,
        evaluations,
        null_motions,
        digits,
        sensitivities,
        stepping,
        findings: Vec::new(),
    };
    found.findings = finding::findings(&found, limits);
    Ok(found)
}

/// An error where whoever watches wants no more.
fn proceed(progress: &(impl Fn(usize) -> ControlFlow<()> + ?Sized)) -> Result<(), Error> {
    if progress(0).is_break() { Err(Error::Interrupted) } else { Ok(()) }
}

//! Why a motion ends before its time.

use eigenbody::{Error, InputError, Model};
use thiserror::Error as ThisError;

/// Why a motion ends before its time, or does not begin.
#[derive(Debug, Clone, PartialEq, ThisError)]
pub enum SimulationError {
    /// A step, tolerance or span that is not positive, or a method that does not go with an option.
    #[error("{0}")]
    Schedule(&'static str),
    /// A start, force or target that does not fit the model.
    #[error(transparent)]
    Input(#[from] InputError),
    /// The dynamics failed.
    #[error("at t = {t} s: {source}{}", at_joint(joint))]
    Dynamics {
        /// Time of the stage.
        t: f64,
        /// The joint, where one is to blame.
        joint: Option<String>,
        /// What the core says.
        source: Error,
    },
    /// A joint goes so far in one step that nothing after it means anything.
    #[error(
        "at t = {t} s: the motion has blown up: '{joint}' moves at {speed:.1e} {unit} in steps of {step_s:.1e} s"
    )]
    BlownUp {
        /// Time of the step.
        t: f64,
        /// The degree of freedom.
        joint: String,
        /// How fast it moves.
        speed: f64,
        /// rad/s or m/s.
        unit: &'static str,
        /// The step (s).
        step_s: f64,
    },
    /// The steps became too small, or too many.
    #[error(
        "at t = {t} s: no progress: the tolerance asks for steps below {step_s:.1e} s, first of all on '{joint}'"
    )]
    Stuck {
        /// Time.
        t: f64,
        /// The degree of freedom with the largest error.
        joint: String,
        /// The step (s).
        step_s: f64,
    },
    /// The equations of an implicit step were not solved.
    #[error(
        "at t = {t} s: the implicit step of {step_s:.1e} s does not converge, first of all on '{joint}': take shorter ones"
    )]
    NoConvergence {
        /// Time.
        t: f64,
        /// The degree of freedom that is furthest from settled.
        joint: String,
        /// The step (s).
        step_s: f64,
    },
}

fn at_joint(joint: &Option<String>) -> String {
    joint.as_ref().map_or_else(String::new, |joint| format!(", at '{joint}'"))
}

impl SimulationError {
    /// An error of the core, with the time and the joint that it names.
    pub(super) fn dynamics(model: &Model<f64>, t: f64, source: impl Into<Error>) -> Self {
        let source = source.into();
        let joint = match &source {
            Error::NotPositiveDefinite(pivot) => Some(model.dof_name(pivot.dof)),
            _ => None,
        };
        Self::Dynamics { t, joint, source }
    }

    /// True if the motion began and went wrong; false if it could not begin.
    pub fn is_along_the_way(&self) -> bool {
        !matches!(self, Self::Schedule(_) | Self::Input(_))
    }
}

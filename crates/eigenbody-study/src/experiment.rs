//! Experiments by name.

use crate::claim::{CLAIMS, Reading};
use crate::lab::{Lab, StudyError};
use crate::table::Table;
use crate::{featherstone, shah_saha};
use thiserror::Error;

/// Where an experiment comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Paper {
    /// R. Featherstone, *An Empirical Study of the Joint Space Inertia Matrix*, Int. J. Robotics Research 23 (2004).
    Featherstone,
    /// S. V. Shah, S. K. Saha, *Correlation between diagonal ratio and condition number of the generalized inertia matrix of a
    /// serial-chain*, Archive of Mechanical Engineering 60 (2013).
    ShahSaha,
}

/// One figure, or one set of printed numbers.
#[derive(Debug, Clone, Copy)]
pub struct Experiment {
    /// `F-fig6`, `S-eq7`, ..; `-beyond` where it goes further than the paper.
    pub id: &'static str,
    /// The paper.
    pub paper: Paper,
    /// What it shows, as a caption.
    pub title: &'static str,
    /// What is seen, in a sentence.
    pub seen: &'static str,
    /// The claims that it tests, by id.
    pub claims: &'static [&'static str],
    /// A rough share of the time of a whole run, for a progress bar.
    pub effort: u64,
    pub(crate) compute: fn(&Lab<'_>) -> Result<Outcome, StudyError>,
}

impl Experiment {
    /// Computes the table and reads off the claims.
    ///
    /// # Errors
    ///
    /// [`StudyError`], if a robot cannot be built or an algorithm fails on it.
    pub fn run(&self, lab: &Lab<'_>) -> Result<Outcome, StudyError> {
        (self.compute)(lab)
    }
}

/// What an experiment yields.
#[derive(Debug, Clone, PartialEq)]
pub struct Outcome {
    /// The numbers.
    pub table: Table,
    /// A verdict on each of the claims.
    pub readings: Vec<Reading>,
    /// What the numbers say where the paper says nothing.
    pub remark: String,
}

impl Outcome {
    pub(crate) fn new(table: impl Into<Table>, readings: Vec<Reading>) -> Self {
        Self { table: table.into(), readings, remark: String::new() }
    }

    pub(crate) fn remarking(self, remark: impl Into<String>) -> Self {
        Self { remark: remark.into(), ..self }
    }
}

/// Every experiment, in the order of the papers.
pub static EXPERIMENTS: [&[Experiment]; 2] = [&featherstone::EXPERIMENTS, &shah_saha::EXPERIMENTS];

/// A name that no experiment and no claim has.
#[derive(Debug, Clone, PartialEq, Error)]
#[error("no experiment or claim '{id}'{}; known: {}", did_you_mean(id), known().join(", "))]
pub struct UnknownId {
    /// The name.
    pub id: String,
}

/// Names of experiments and of claims, without repetition.
fn known() -> Vec<&'static str> {
    let mut names: Vec<&str> = EXPERIMENTS.iter().flat_map(|paper| paper.iter().map(|e| e.id)).collect();
    names.extend(CLAIMS.iter().map(|claim| claim.id));
    names.sort_unstable();
    names.dedup();
    names
}

fn did_you_mean(id: &str) -> String {
    let rated = known()
        .into_iter()
        .map(|name| (strsim::osa_distance(&id.to_lowercase(), &name.to_lowercase()), name));
    match rated.min() {
        Some((distance, near)) if distance <= 2 => format!("; did you mean '{near}'?"),
        _ => String::new(),
    }
}

/// The experiments with these names, or those that test the claims with these names; all for no names.
///
/// Errors: [`UnknownId`] for a name that is neither.
///
/// ```
/// use eigenbody_study::select;
/// assert_eq!(select(&["F-Hprime-half"])?[0].id, "F-Hprime");
/// assert_eq!(select(&["F-fig66"]).unwrap_err().id, "F-fig66");
/// # Ok::<(), eigenbody_study::UnknownId>(())
/// ```
pub fn select<S: AsRef<str>>(ids: &[S]) -> Result<Vec<&'static Experiment>, UnknownId> {
    let all = || EXPERIMENTS.iter().flat_map(|paper| paper.iter());
    let wants = |experiment: &Experiment, id: &str| experiment.id == id || experiment.claims.contains(&id);
    for id in ids.iter().map(AsRef::as_ref) {
        if !all().any(|experiment| wants(experiment, id)) {
            return Err(UnknownId { id: id.to_owned() });
        }
    }
    let chosen =
        |experiment: &&Experiment| ids.is_empty() || ids.iter().any(|id| wants(experiment, id.as_ref()));
    Ok(all().filter(chosen).collect())
}

//! A report against an earlier one: what is new, what got worse, what is mended.
//!
//! ```text
//! the same finding: the same identity, code:joints; what is left over, by code alone (the blame moved)
//! worse: its value lies further beyond its limit than before, by more than a hundredth
//! ```

use super::DiagnosisReport;
use crate::number::significant;
use crate::text::count;
use serde::{Deserialize, Serialize};
use std::collections::HashSet;
use std::fmt::Write;

/// Relative change that counts: a search from other samples finds a little more or less.
const NOTABLE: f64 = 0.01;

/// An earlier report, as `check --format json` printed it.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct Baseline {
    worst: Vec<OldWorst>,
    findings: Vec<OldFinding>,
    #[serde(default)]
    remarks: Vec<OldRemark>,
}

#[derive(Debug, Clone, PartialEq, Deserialize)]
struct OldWorst {
    measure: String,
    worst: Option<f64>,
}

#[derive(Debug, Clone, PartialEq, Deserialize)]
struct OldFinding {
    id: String,
    message: String,
    joints: Vec<String>,
    value: Option<f64>,
}

#[derive(Debug, Clone, PartialEq, Deserialize)]
struct OldRemark {
    code: String,
    subject: String,
    message: String,
}

/// What became of a finding.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum State {
    /// It was not there.
    New,
    /// It was there, and less so.
    Worse,
    /// It was there.
    Unchanged,
}

/// A finding that is gone.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Fixed {
    /// Its code.
    pub id: String,
    /// What it said.
    pub message: String,
    /// Its identity.
    pub identity: String,
}

/// The worst value of a measure, then and now; `null` for an infinite one.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Change {
    /// `kappa`, `kappa_weighted` or `lambda_min`.
    pub measure: String,
    /// Then.
    pub before: Option<f64>,
    /// Now.
    pub after: Option<f64>,
}

/// A report against an earlier one.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Comparison {
    /// The earlier one's file.
    pub baseline: String,
    /// What became of each of the findings, in their order.
    pub findings: Vec<State>,
    /// And of each of the remarks on the model.
    pub remarks: Vec<State>,
    /// What is gone.
    pub fixed: Vec<Fixed>,
    /// The worst values.
    pub measures: Vec<Change>,
}

/// The same finding in two reports of a robot: its code and its joints, in alphabetical order.
pub(super) fn identity(code: &str, joints: &[String]) -> String {
    let mut names = joints.to_vec();
    names.sort();
    format!("{code}:{}", names.join(","))
}

impl Baseline {
    /// Reads the JSON of an earlier report.
    ///
    /// Errors: what is wrong with it, with line and column.
    pub fn parse(text: &str) -> Result<Self, serde_json::Error> {
        serde_json::from_str(text)
    }

    /// What became of it.
    pub fn compare(&self, file: &str, report: &DiagnosisReport) -> Comparison {
        let mut left: Vec<(String, &OldFinding)> =
            self.findings.iter().map(|old| (identity(&old.id, &old.joints), old)).collect();
        let mut before: Vec<Option<&OldFinding>> = vec![None; report.findings.len()];
        for by_code in [false, true] {
            for (finding, before) in report.findings.iter().zip(&mut before).filter(|(_, b)| b.is_none()) {
                let same = |(identity, old): &(String, &OldFinding)| match by_code {
                    true => old.id == finding.id,
                    false => *identity == finding.identity,
                };
                *before = left.iter().position(same).map(|k| left.remove(k).1);
            }
        }
        let state = |(finding, before): (&super::FindingReport, &Option<&OldFinding>)| match before {
            None => State::New,
            Some(old) if worse(old.value, finding.value, finding.limit) => State::Worse,
            Some(_) => State::Unchanged,
        };
        let known: HashSet<String> = self.remarks.iter().map(OldRemark::identity).collect();
        let now: HashSet<&str> = report.remarks.iter().map(|remark| remark.identity.as_str()).collect();
        let gone = self.remarks.iter().filter(|old| !now.contains(old.identity().as_str()));
        let fixed = left.iter().map(|(identity, old)| Fixed {
            id: old.id.clone(),
            message: old.message.clone(),
            identity: identity.clone(),
        });
        let mended = gone.map(|old| Fixed {
            id: old.code.clone(),
            message: old.message.clone(),
            identity: old.identity(),
        });
        let measures = report.worst.iter().filter_map(|worst| {
            let old = self.worst.iter().find(|old| old.measure == worst.measure)?;
            Some(Change { measure: worst.measure.to_owned(), before: old.worst, after: worst.worst })
        });
        Comparison {
            baseline: file.to_owned(),
            findings: report.findings.iter().zip(&before).map(state).collect(),
            remarks: report
                .remarks
                .iter()
                .map(|remark| if known.contains(&remark.identity) { State::Unchanged } else { State::New })
                .collect(),
            fixed: fixed.chain(mended).collect(),
            measures: measures.collect(),
        }
    }
}

impl OldRemark {
    fn identity(&self) -> String {
        identity(&self.code, std::slice::from_ref(&self.subject))
    }
}

/// True if a value lies further beyond its limit than before; one that does not exist lies at infinity.
fn worse(before: Option<f64>, after: Option<f64>, limit: f64) -> bool {
    match (before, after) {
        (Some(before), Some(after)) if after >= limit => after > before * (1.0 + NOTABLE),
        (Some(before), Some(after)) => after < before * (1.0 - NOTABLE),
        (Some(_), None) => true,
        (None, _) => false,
    }
}

impl Comparison {
    /// For the page: counts, the worst values that moved, and what is gone.
    pub fn to_text(&self) -> String {
        let of = |state: State| self.findings.iter().chain(&self.remarks).filter(|s| **s == state).count();
        let mut text = format!(
            "\n  against {}: {} new, {} worse, {} as before, {} gone\n",
            self.baseline,
            of(State::New),
            of(State::Worse),
            count(of(State::Unchanged), "finding", "findings"),
            self.fixed.len()
        );
        let number = |x: Option<f64>| x.map_or_else(|| "∞".to_owned(), |x| significant(x, 3));
        for Change { measure, before, after } in &self.measures {
            let (symbol, nothing) = match measure.as_str() {
                "kappa" => ("κ", f64::INFINITY),
                "kappa_weighted" => ("κ'", f64::INFINITY),
                _ => ("λmin", 0.0),
            };
            let (a, b) = (before.unwrap_or(nothing), after.unwrap_or(nothing));
            if (a - b).abs() > NOTABLE * a.abs().min(b.abs()) {
                let _ = writeln!(text, "    worst {symbol:<5} {} → {}", number(*before), number(*after));
            }
        }
        for fixed in &self.fixed {
            let _ = writeln!(text, "    gone: {}: {}", fixed.id, fixed.message);
        }
        text
    }
}

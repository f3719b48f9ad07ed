//! What is wrong with a robot, for people and for programs.

mod advice;
mod baseline;
mod sarif;
mod stepping;
mod text;
mod words;

pub use advice::{AddedReport, AdviceReport, advice_text};
pub use baseline::{Baseline, Change, Comparison, Fixed, State};
pub use stepping::SteppingReport;
pub use text::diagnosis_text;
pub(crate) use text::nothing_found;

use eigenbody::search::Measure;
use eigenbody_formats::{Kind, Loaded, Location};
use eigenbody_study::diagnosis::{
    Blame, Diagnosis, Finding, Goal, Mechanism, NullMotion, Remedies, Sensitivity, Worst,
};
use serde::Serialize;
use words::{advice, message, severity};

/// Everything that `eigenbody check --format json` prints. A number that does not exist, or is infinite, is `null`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DiagnosisReport {
    /// The model as it was asked for.
    pub model: String,
    /// Its file, if it has one.
    pub file: Option<String>,
    /// Number of degrees of freedom.
    pub dofs: usize,
    /// Configurations evaluated.
    pub evaluations: usize,
    /// By κ, κ′ and λmin.
    pub worst: Vec<WorstReport>,
    /// Joint rates that move no mass in any configuration.
    pub null_motions: Vec<Vec<RateReport>>,
    /// What precisions keep at the worst κ′.
    pub digits: Option<DigitsReport>,
    /// What moves κ most where it is worst: d log κ.
    pub sensitivities: Vec<SensitivityReport>,
    /// Stable steps and gains, with springs or a step.
    pub stepping: Option<SteppingReport>,
    /// What is wrong.
    pub findings: Vec<FindingReport>,
    /// What is suspicious about the model itself.
    pub model_findings: Vec<String>,
    /// The same in parts.
    pub remarks: Vec<RemarkReport>,
    /// What became of an earlier report, where one was given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub comparison: Option<Comparison>,
    /// What to add, where something was wanted.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub advice: Option<AdviceReport>,
}

/// The worst by one measure.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct WorstReport {
    /// `kappa`, `kappa_weighted` or `lambda_min`.
    pub measure: &'static str,
    /// The worst value found; `null` for an infinite one.
    pub worst: Option<f64>,
    /// Over the sampled configurations.
    pub median: Option<f64>,
    /// Exceeded in badness by one of ten samples.
    pub tenth: Option<f64>,
    /// All coordinates: what `--at 'q=[..]'` takes.
    pub q: Vec<f64>,
    /// How the softest mode comes about.
    pub mechanism: Option<MechanismReport>,
    /// The softest mode, the largest share first.
    pub softest: Vec<RateReport>,
    /// Who carries its energy.
    pub carriers: Vec<ShareReport>,
}

/// A degree of freedom in a motion.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RateReport {
    /// Its name.
    pub joint: String,
    /// Its rate in the motion.
    pub rate: f64,
    /// Its part.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub share: Option<f64>,
}

/// A link's or a rotor's part.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ShareReport {
    /// The link, or `armature of` a joint.
    pub name: String,
    /// Its part of the motion's energy.
    pub share: f64,
}

/// How a soft motion comes about.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum MechanismReport {
    /// One joint carries little inertia.
    LightTip {
        /// The joint.
        joint: String,
        /// The link.
        link: String,
    },
    /// Two joints cancel.
    Opposition {
        /// The joints.
        joints: [String; 2],
        /// Angle between their axes (rad).
        angle: f64,
        /// The links that they move.
        links: Vec<String>,
    },
    /// Many joints.
    Spread,
}

/// How much a parameter moves κ.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SensitivityReport {
    /// `mass`, `com x`, `ixx`, `armature` and so on.
    pub parameter: &'static str,
    /// The link or joint.
    pub of: String,
    /// What it is (kg, m, kg m²).
    pub value: f64,
    /// What a change is measured against: the mass, the radius of gyration, the mean principal moment, H_dd.
    pub against: f64,
    /// d log κ for a change of that size.
    pub rate: f64,
}

impl From<&Sensitivity> for SensitivityReport {
    fn from(found: &Sensitivity) -> Self {
        let Sensitivity { parameter, of, value, against, rate } = found.clone();
        Self { parameter: parameter.name(), of, value, against, rate }
    }
}

/// Digits kept.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DigitsReport {
    /// Predicted loss with factors of H, log₁₀ (κ′/4).
    pub predicted_loss: f64,
    /// Whether single precision keeps the digits that it must.
    pub float32_safe: bool,
    /// Digits kept by the worst way of solving in single precision.
    pub left_in_f32: f64,
    /// And in double precision.
    pub left_in_f64: f64,
    /// By method: digits lost in f32 and f64; `null` where it failed.
    pub lost: Vec<LossReport>,
}

/// Digits lost by one way of solving.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LossReport {
    /// The way.
    pub method: &'static str,
    /// Digits that it was expected to lose.
    pub predicted: f64,
    /// In single precision.
    pub f32: Option<f64>,
    /// In double precision.
    pub f64: Option<f64>,
}

/// A place in a file, line and column counted from 1.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PlaceReport {
    /// The file.
    pub file: String,
    /// Line.
    pub line: u32,
    /// Column, in characters.
    pub column: u32,
}

/// Something suspicious about the model.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RemarkReport {
    /// A stable name of its kind.
    pub code: &'static str,
    /// The link, joint or element.
    pub subject: String,
    /// The same in every report: code and subject.
    pub identity: String,
    /// One sentence.
    pub message: String,
    /// Where.
    pub place: Option<PlaceReport>,
}

impl RemarkReport {
    /// A remark of a reader.
    pub fn new(code: &'static str, subject: String, message: String, place: Option<PlaceReport>) -> Self {
        let identity = baseline::identity(code, std::slice::from_ref(&subject));
        Self { code, subject, identity, message, place }
    }
}

/// One finding.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FindingReport {
    /// A stable name.
    pub id: &'static str,
    /// `error`, `warning` or `note`.
    pub severity: &'static str,
    /// One sentence.
    pub message: String,
    /// What to do.
    pub advice: String,
    /// Joints to blame.
    pub joints: Vec<String>,
    /// Measured.
    pub value: Option<f64>,
    /// Held against.
    pub limit: f64,
    /// Where; empty for everywhere.
    pub q: Vec<f64>,
    /// The same in every report: id and joints.
    pub identity: String,
    /// Where the first of the joints stands in its file.
    pub place: Option<PlaceReport>,
}

fn finite(x: f64) -> Option<f64> {
    x.is_finite().then_some(x)
}

impl From<&Mechanism> for MechanismReport {
    fn from(mechanism: &Mechanism) -> Self {
        match mechanism.clone() {
            Mechanism::LightTip { joint, link } => Self::LightTip { joint, link },
            Mechanism::Opposition { joints, angle, links } => Self::Opposition { joints, angle, links },
            Mechanism::Spread => Self::Spread,
        }
    }
}

impl From<&Worst> for WorstReport {
    fn from(worst: &Worst) -> Self {
        let spread = &worst.spread;
        let (mut softest, mut carriers) = (Vec::new(), Vec::new());
        if let Some(Blame { soft, .. }) = &worst.blame {
            softest.extend(soft.dofs.iter().map(|part| RateReport {
                joint: part.name.clone(),
                rate: part.rate,
                share: Some(part.share),
            }));
            carriers.extend(
                soft.carriers.iter().map(|part| ShareReport { name: part.name.clone(), share: part.share }),
            );
        }
        Self {
            measure: measure_name(spread.measure),
            worst: finite(spread.worst),
            median: finite(spread.median),
            tenth: finite(spread.tenth),
            q: spread.at.clone(),
            mechanism: worst.blame.as_ref().map(|blame| MechanismReport::from(&blame.mechanism)),
            softest,
            carriers,
        }
    }
}

/// What a measure is called.
pub(crate) fn measure_name(measure: Measure) -> &'static str {
    match measure {
        Measure::Kappa => "kappa",
        Measure::KappaWeighted => "kappa_weighted",
        Measure::LambdaMin => "lambda_min",
    }
}

impl DiagnosisReport {
    /// What a diagnosis says about `model`; `model_findings` are the loader's.
    pub fn new(model: &str, found: &Diagnosis, model_findings: Vec<String>) -> Self {
        let rates = |motion: &NullMotion| {
            let rate =
                |(joint, rate): &(String, f64)| RateReport { joint: joint.clone(), rate: *rate, share: None };
            motion.rates.iter().map(rate).collect()
        };
        Self {
            model: model.into(),
            file: None,
            dofs: found.dofs.len(),
            evaluations: found.evaluations,
            worst: found.worst.iter().map(WorstReport::from).collect(),
            null_motions: found.null_motions.iter().map(rates).collect(),
            digits: found.digits.as_ref().map(|digits| DigitsReport {
                predicted_loss: digits.predicted_loss,
                float32_safe: found.findings.iter().all(|finding| finding.id != "single-precision"),
                left_in_f32: digits.left_in_f32(),
                left_in_f64: digits.left_in_f64(),
                lost: digits
                    .measured
                    .iter()
                    .map(|loss| LossReport {
                        method: loss.method,
                        predicted: loss.predicted,
                        f32: finite(loss.f32),
                        f64: finite(loss.f64),
                    })
                    .collect(),
            }),
            sensitivities: found.sensitivities.iter().map(SensitivityReport::from).collect(),
            stepping: found.stepping.as_ref().map(SteppingReport::from),
            findings: found.findings.iter().map(|finding| report(finding, found)).collect(),
            model_findings,
            remarks: Vec::new(),
            comparison: None,
            advice: None,
        }
    }

    /// What a diagnosis says about the robot of a text, with the places of joints in its file.
    pub fn of(model: &str, loaded: &Loaded, found: &Diagnosis) -> Self {
        let Kind::File(path) = &loaded.kind else { return Self::new(model, found, Vec::new()) };
        let place = |(file, at): (&str, Location)| PlaceReport {
            file: file.to_owned(),
            line: at.line,
            column: at.column,
        };
        let remarks = loaded.remarks().into_iter().map(|remark| {
            let at = remark.place.as_ref().map(|(file, at)| place((file, *at)));
            RemarkReport::new(remark.code, remark.subject, remark.text, at)
        });
        Self::new(model, found, loaded.findings()).located(
            Some(path.display().to_string()),
            |dof| loaded.place_of_dof(dof).map(place),
            remarks.collect(),
        )
    }

    /// The same with advice.
    pub fn with_advice(self, advice: Option<&(Goal, Remedies)>) -> Self {
        Self { advice: advice.map(|(goal, found)| AdviceReport::new(*goal, found)), ..self }
    }

    /// The same with the model's file, the places of joints in it, and what is suspicious about it.
    pub fn located(
        mut self,
        file: Option<String>,
        place: impl Fn(&str) -> Option<PlaceReport>,
        remarks: Vec<RemarkReport>,
    ) -> Self {
        for finding in &mut self.findings {
            finding.place = finding.joints.iter().find_map(|joint| place(joint));
        }
        Self { file, remarks, ..self }
    }

    /// The same against an earlier report.
    pub fn against(self, file: &str, baseline: &Baseline) -> Self {
        Self { comparison: Some(baseline.compare(file, &self)), ..self }
    }

    /// As JSON, floats that parse back to the same bits.
    ///
    /// Errors: those of the serialiser.
    pub fn to_json(&self) -> Result<String, serde_json::Error> {
        serde_json::to_string_pretty(self)
    }
}

fn report(finding: &Finding, found: &Diagnosis) -> FindingReport {
    FindingReport {
        id: finding.id,
        severity: severity(finding.severity),
        message: message(finding, found),
        advice: advice(finding, found),
        joints: finding.joints.clone(),
        value: finite(finding.value),
        limit: finding.limit,
        q: finding.at.clone(),
        identity: baseline::identity(finding.id, &finding.joints),
        place: None,
    }
}

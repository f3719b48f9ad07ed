//! What is wrong with a robot, for people and for programs.

use crate::number::significant;
use eigenbody::search::Measure;
use eigenbody_study::diagnosis::{Blame, Diagnosis, Finding, Mechanism, NullMotion, Severity, Use, Worst};
use serde::Serialize;
use std::fmt::Write;

/// Joints and links named of a mode.
const NAMED: usize = 3;
/// Angle below which two axes are nearly one (rad).
const ALIGNED: f64 = 0.2;
/// Width of the page.
const WIDTH: usize = 96;

/// Everything that `eigenbody check --format json` prints. A number that does not exist, or is infinite, is `null`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DiagnosisReport {
    /// The model as it was asked for.
    pub model: String,
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
    /// What is wrong.
    pub findings: Vec<FindingReport>,
    /// What is suspicious about the model itself.
    pub model_findings: Vec<String>,
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

/// Digits kept.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DigitsReport {
    /// Predicted loss, log₁₀ κ′.
    pub predicted_loss: f64,
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
    /// In single precision.
    pub f32: Option<f64>,
    /// In double precision.
    pub f64: Option<f64>,
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
            measure: name(spread.measure),
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

fn name(measure: Measure) -> &'static str {
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
            dofs: found.dofs.len(),
            evaluations: found.evaluations,
            worst: found.worst.iter().map(WorstReport::from).collect(),
            null_motions: found.null_motions.iter().map(rates).collect(),
            digits: found.digits.as_ref().map(|digits| DigitsReport {
                predicted_loss: digits.predicted_loss,
                left_in_f32: digits.left_in_f32(),
                left_in_f64: digits.left_in_f64(),
                lost: digits
                    .measured
                    .iter()
                    .map(|loss| LossReport {
                        method: loss.method,
                        f32: finite(loss.f32),
                        f64: finite(loss.f64),
                    })
                    .collect(),
            }),
            findings: found.findings.iter().map(|finding| report(finding, found)).collect(),
            model_findings,
        }
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
        advice: advice(finding),
        joints: finding.joints.clone(),
        value: finite(finding.value),
        limit: finding.limit,
        q: finding.at.clone(),
    }
}

fn severity(severity: Severity) -> &'static str {
    match severity {
        Severity::Note => "note",
        Severity::Warning => "warning",
        Severity::Error => "error",
    }
}

fn message(finding: &Finding, found: &Diagnosis) -> String {
    match finding.endangers {
        Use::Everything => {
            let motions = finding.value;
            let verb = if motions == 1.0 { "motion of" } else { "motions of" };
            format!(
                "{motions} {verb} {} move no mass in any configuration: H is singular",
                list(&finding.joints)
            )
        }
        Use::Solves => {
            let left = found.digits.as_ref().map_or(0.0, |digits| digits.left_in_f64().floor());
            format!(
                "solving with H loses digits: κ' reaches {}; double precision keeps {left} of 15",
                number(finding.value)
            )
        }
        Use::SinglePrecision => format!(
            "not float32-safe: single precision keeps {} of 7 digits of an acceleration",
            finding.value.floor()
        ),
        Use::Gains => format!(
            "κ reaches {}: gains and explicit steps that suit the stiffest motion are far off for the softest",
            number(finding.value)
        ),
    }
}

fn advice(finding: &Finding) -> String {
    match &finding.mechanism {
        None => format!("give inertia to the links of {}, or armature to one of them", list(&finding.joints)),
        Some(Mechanism::LightTip { joint, link }) => format!(
            "'{joint}' moves little but '{link}': check its mass and inertia (grams, millimetres?), or give '{joint}' the inertia of \
             its motor as armature"
        ),
        Some(Mechanism::Opposition { joints: [near, far], links, .. }) => format!(
            "give '{near}' or '{far}' the inertia of its motor as armature, give {} {} true inertia, or keep away from there by a limit",
            list(links),
            if links.len() == 1 { "its" } else { "their" }
        ),
        Some(Mechanism::Spread) => {
            "many joints share this motion: it is a property of the mechanism; armature on the outer joints helps most".into()
        }
    }
}

fn list(names: &[String]) -> String {
    let shown: Vec<String> = names.iter().take(4).map(|name| format!("'{name}'")).collect();
    match (shown.as_slice(), names.len()) {
        ([], _) => "nothing".into(),
        ([one], _) => one.clone(),
        (_, n) if n > shown.len() => format!("{} and {} more", shown.join(", "), n - shown.len()),
        ([before @ .., last], _) => format!("{} and {last}", before.join(", ")),
    }
}

fn number(x: f64) -> String {
    if x.is_finite() { significant(x, 3) } else { "∞".into() }
}

/// The page for the terminal: fits one screen.
pub fn diagnosis_text(model: &str, found: &Diagnosis, model_findings: &[String]) -> String {
    let mut page = format!("{model}\n");
    let _ = writeln!(
        page,
        "  {} degrees of freedom, {} configurations within the joint limits\n",
        found.dofs.len(),
        found.evaluations
    );
    for worst in &found.worst {
        page.push_str(&line(worst, found.unit));
    }
    if let Some(digits) = &found.digits {
        let (single, double) =
            (digits.left_in_f32().min(7.0).floor(), digits.left_in_f64().min(15.0).floor());
        let _ = writeln!(
            page,
            "  at the worst κ' an acceleration keeps {single} of 7 digits in f32, {double} of 15 in f64"
        );
    }
    if found.findings.is_empty() {
        let _ = writeln!(page, "\n  Nothing found: well-conditioned for solves, gains and single precision.");
    }
    // Findings that come of the same configuration are explained once.
    for group in found.findings.chunk_by(|a, b| a.at == b.at) {
        page.push('\n');
        for finding in group {
            let what = severity(finding.severity);
            let _ = writeln!(
                page,
                "  {}",
                wrapped(&format!("{what}[{}]: {}", finding.id, message(finding, found)), 4)
            );
        }
        page.push_str(&details(&group[0], found));
        let _ = writeln!(page, "    = help: {}", wrapped(&advice(&group[0]), 12));
    }
    if !model_findings.is_empty() {
        let n = model_findings.len();
        let what = if n == 1 { "finding" } else { "findings" };
        let _ = writeln!(
            page,
            "\n  {n} {what} on the file itself: `eigenbody info` lists {}",
            if n == 1 { "it" } else { "them" }
        );
    }
    page
}

fn line(worst: &Worst, unit: &str) -> String {
    let spread = &worst.spread;
    let (symbol, unit) = match spread.measure {
        Measure::Kappa => ("κ", ""),
        Measure::KappaWeighted => ("κ'", ""),
        Measure::LambdaMin => ("λmin", unit),
    };
    let line = format!(
        "  {symbol:<5} worst {:<10} median {:<10} worst tenth from {:<10} {unit}",
        number(spread.worst),
        number(spread.median),
        number(spread.tenth)
    );
    format!("{}\n", line.trim_end())
}

fn details(finding: &Finding, found: &Diagnosis) -> String {
    let mut text = String::new();
    let worst = found.worst.iter().find(|worst| worst.spread.at == finding.at && !finding.at.is_empty());
    if let Some(Blame { soft, mechanism }) = worst.and_then(|worst| worst.blame.as_ref()) {
        let parts: Vec<String> = soft
            .dofs
            .iter()
            .take(NAMED)
            .filter(|part| part.share > 0.01)
            .map(|part| format!("{} {:+.2} ({:.0}%)", part.name, part.rate, 100.0 * part.share))
            .collect();
        let _ = writeln!(text, "    softest motion: {}", parts.join(", "));
        let carriers: Vec<String> = soft
            .carriers
            .iter()
            .take(NAMED)
            .filter(|part| part.share > 0.01)
            .map(|part| format!("{} {:.0}%", part.name, 100.0 * part.share))
            .collect();
        let _ = writeln!(text, "    its inertia: {}", carriers.join(", "));
        let how = match mechanism {
            Mechanism::LightTip { joint, .. } => format!("little inertia behind '{joint}' alone"),
            Mechanism::Opposition { joints: [near, far], angle, .. } if *angle < ALIGNED => {
                format!(
                    "'{near}' and '{far}' turn about nearly the same line ({:.1}°), with little between",
                    angle.to_degrees()
                )
            }
            Mechanism::Opposition { joints: [near, far], .. } => {
                format!("'{near}' and '{far}' cancel: to them, what they carry is nearly a point")
            }
            Mechanism::Spread => "many joints together".into(),
        };
        let _ = writeln!(text, "    mechanism: {how}");
        let _ = writeln!(text, "    at: {}", configuration(&finding.at, found, &finding.joints));
    }
    if finding.endangers == Use::Everything {
        for motion in &found.null_motions {
            let rates: Vec<String> =
                motion.rates.iter().take(6).map(|(name, rate)| format!("{name} {rate:+.3}")).collect();
            let _ = writeln!(text, "    joint rates: {}", rates.join(", "));
        }
    }
    text
}

/// Coordinates of the joints to blame and of those between, where coordinates and degrees of freedom are the same.
fn configuration(q: &[f64], found: &Diagnosis, joints: &[String]) -> String {
    if q.len() != found.dofs.len() {
        return format!("--at 'q=[..]' with the {} numbers that --format json prints", q.len());
    }
    let of =
        |name: &String| found.dofs.iter().position(|dof| dof == name).map(|d| format!("{name}={:.6}", q[d]));
    let shown: Vec<String> = joints.iter().take(4).filter_map(of).collect();
    format!("{} (all coordinates: --format json)", shown.join(", "))
}

/// Wrapped to the page, further lines indented.
fn wrapped(text: &str, indent: usize) -> String {
    let mut lines = String::new();
    let mut column = indent;
    for word in text.split(' ') {
        let width = word.chars().count();
        if column + 1 + width > WIDTH && column > indent {
            let _ = write!(lines, "\n{}", " ".repeat(indent));
            column = indent;
        } else if column > indent {
            lines.push(' ');
            column += 1;
        }
        lines.push_str(word);
        column += width;
    }
    lines
}

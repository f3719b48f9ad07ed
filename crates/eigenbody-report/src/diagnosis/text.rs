//! The page for the terminal.

use super::stepping::{shares, stepping_text};
use super::words::{advice, message, number, severity};
use crate::text::count;
use eigenbody::search::Measure;
use eigenbody_study::diagnosis::{Blame, Diagnosis, Finding, Mechanism, Parameter, Sensitivity, Use, Worst};
use std::fmt::Write;

/// What is said where there is no finding.
pub(crate) fn nothing_found(dofs: usize) -> &'static str {
    match dofs {
        0 => "The robot cannot move: it has no degree of freedom, and nothing was assessed.",
        _ => "Nothing found: well-conditioned for solves, gains and single precision.",
    }
}

/// Joints and links named of a mode.
const NAMED: usize = 3;
/// Angle below which two axes are nearly one (rad).
const ALIGNED: f64 = 0.2;
/// Width of the page.
const WIDTH: usize = 96;

/// The page for the terminal: fits one screen.
pub fn diagnosis_text(model: &str, found: &Diagnosis, model_findings: &[String]) -> String {
    let mut page = format!("{model}\n");
    let _ = writeln!(
        page,
        "  {}, {} within the joint limits\n",
        count(found.dofs.len(), "degree of freedom", "degrees of freedom"),
        count(found.evaluations, "configuration", "configurations")
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
    if let Some(stepping) = &found.stepping {
        for line in stepping_text(stepping).lines() {
            let _ = writeln!(page, "  {}", wrapped(line.trim_start(), 4));
        }
    }
    if found.findings.is_empty() {
        let _ = writeln!(page, "\n  {}", nothing_found(found.dofs.len()));
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
        let _ = writeln!(page, "    = help: {}", wrapped(&advice(&group[0], found), 12));
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
    let here = |worst: &&Worst| worst.spread.at == finding.at && !finding.at.is_empty();
    let worst = found.worst.iter().find(here).filter(|_| finding.endangers != Use::Stepping);
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
        if worst.is_some_and(|worst| worst.spread.measure == Measure::Kappa)
            && !found.sensitivities.is_empty()
        {
            let of = |armature: bool, n: usize| {
                let kind = move |one: &&Sensitivity| (one.parameter == Parameter::Armature) == armature;
                found.sensitivities.iter().filter(kind).take(n)
            };
            let most = of(true, 1).chain(of(false, 2));
            let most: Vec<String> =
                most.map(|one| format!("{} of {}", one.parameter.name(), one.of)).collect();
            let _ = writeln!(text, "    moves κ most: {}", most.join(", "));
        }
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
    if finding.endangers == Use::Stepping {
        let own =
            found.stepping.iter().flat_map(|s| s.limits.iter().filter(|l| l.integrator == s.integrator));
        for limit in own.filter(|limit| !limit.at.is_empty()) {
            let _ = writeln!(text, "    what grows: {}", shares(&limit.dofs));
            let _ = writeln!(text, "    at: {}", configuration(&limit.at, found, &finding.joints));
        }
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
    let of = |name: &String| {
        found.dofs.iter().position(|dof| dof == name).map(|d| format!("{name}={}", place(q[d])))
    };
    let shown: Vec<String> = joints.iter().take(4).filter_map(of).collect();
    format!("{} (all coordinates: --format json)", shown.join(", "))
}

/// Six decimals, zero without a sign.
fn place(q: f64) -> String {
    let text = format!("{q:.6}");
    if text == "-0.000000" { "0.000000".into() } else { text }
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

//! Findings in words.

use super::stepping::time;
use crate::number::significant;
use eigenbody_study::diagnosis::{Diagnosis, Finding, Mechanism, Severity, Use};

pub(super) fn severity(severity: Severity) -> &'static str {
    match severity {
        Severity::Note => "note",
        Severity::Warning => "warning",
        Severity::Error => "error",
    }
}

pub(super) fn message(finding: &Finding, found: &Diagnosis) -> String {
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
        Use::Stepping if finding.limit == 0.0 => {
            "no time step is stable: a stiffness or damping is below zero".into()
        }
        Use::Stepping => {
            let method = found.stepping.as_ref().map_or("", |stepping| stepping.integrator.name());
            let (step, limit) = (time(finding.value), time(finding.limit));
            format!("{method} at {step} is not stable everywhere: {limit} is the largest step that is")
        }
        Use::Gains => format!(
            "κ reaches {}: gains and explicit steps that suit the stiffest motion are far off for the softest",
            number(finding.value)
        ),
    }
}

pub(super) fn advice(finding: &Finding, found: &Diagnosis) -> String {
    match &finding.mechanism {
        None if finding.endangers == Use::Stepping => step_advice(finding, found),
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

fn step_advice(finding: &Finding, found: &Diagnosis) -> String {
    if finding.limit == 0.0 {
        return "stiffness and damping take energy away if they are above zero: check signs".into();
    }
    let limits = found.stepping.iter().flat_map(|stepping| &stepping.limits);
    let best = limits.max_by(|a, b| a.step.total_cmp(&b.step)).filter(|limit| limit.step > finding.value);
    let other = best.map_or(String::new(), |limit| {
        format!(", step as {} does (stable up to {})", limit.integrator.name(), time(limit.step))
    });
    format!(
        "steps of {}, lower gains on {}{other}, or armature: --want-step {:?} says how much",
        time(finding.limit),
        list(&finding.joints),
        finding.value
    )
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

pub(super) fn number(x: f64) -> String {
    if x.is_finite() { significant(x, 3) } else { "∞".into() }
}

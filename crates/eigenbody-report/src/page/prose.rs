//! Findings in words, and how they were found.

use super::html::{Html, escape, table};
use super::{Page, heading};
use crate::diagnosis::{DiagnosisReport, FindingReport, PlaceReport, RemarkReport, State};
use crate::number::significant;
use crate::text::count;

/// Remarks from which on they are folded away.
const FOLDED: usize = 8;

/// What the page is about, and where to go.
pub(super) fn lead(page: &Page) -> Html {
    let report = &page.report;
    let name = if page.robot.is_empty() { &report.model } else { &page.robot };
    let from = if *name == report.model { String::new() } else { format!("{}: ", report.model) };
    let found = match report.findings.len() {
        0 => "nothing found".to_owned(),
        n => count(n, "finding", "findings"),
    };
    let line = format!(
        "{from}{}, {}, {} base, {} kg; {found} in {} configurations within the joint limits.",
        count(page.bodies, "moving body", "moving bodies"),
        count(report.dofs, "degree of freedom", "degrees of freedom"),
        page.base,
        significant(page.mass, 4),
        report.evaluations
    );
    let links = [
        ("#findings", "Findings"),
        ("#numbers", "Numbers"),
        ("#steps", "Time step and gains"),
        ("#worst", "Worst configurations"),
        ("#spectrum", "Spectrum"),
        ("#matrix", "Matrix"),
        ("#configurations", "Coordinates"),
        ("#method", "How it was computed"),
    ];
    let link = |(to, text): (&str, &str)| {
        Html::element("li", &[], Html::element("a", &[("href", to)], Html::text(text)))
    };
    let list = Html::element("ul", &[], Html::all(links.into_iter().map(link)));
    Html::words("h1", format!("How well-conditioned is {name}?"))
        .then(Html::element("p", &[("class", "lead")], Html::text(line)))
        .then(Html::element("nav", &[("aria-label", "Sections")], list))
}

/// Verdicts with advice, then what is suspicious about the file.
pub(super) fn findings(report: &DiagnosisReport) -> Html {
    let mut whole = Html::new();
    if report.findings.is_empty() {
        let text = crate::diagnosis::nothing_found(report.dofs);
        let words = Html::element("p", &[("class", "what")], Html::text(text));
        whole.push(Html::element("div", &[("class", "finding clean")], words));
    }
    for (k, found) in report.findings.iter().enumerate() {
        let state = report.comparison.as_ref().and_then(|c| c.findings.get(k)).copied();
        whole.push(finding(found, state));
    }
    if let Some(advice) = &report.advice {
        whole.push(super::numbers::advice(advice));
    }
    if let Some(comparison) = &report.comparison {
        whole.push(Html::words("h3", "Against the baseline"));
        whole.push(Html::words("pre", comparison.to_text().trim()));
    }
    if !report.remarks.is_empty() {
        whole.push(remarks(&report.remarks));
    }
    whole
}

/// What is suspicious about the file; many are folded away.
fn remarks(remarks: &[RemarkReport]) -> Html {
    let rows = remarks.iter().map(|remark| {
        vec![
            Html::words("code", remark.code),
            Html::text(remark.place.as_ref().map_or_else(String::new, line)),
            Html::text(&remark.message),
        ]
    });
    let caption = format!("{} on the file itself", count(remarks.len(), "finding", "findings"));
    let listed = Html::element("div", &[("class", "told")], table(&caption, &["kind", "line", "what"], rows));
    let heading = Html::words("h3", "The file");
    match remarks.len() > FOLDED {
        false => heading.then(listed),
        true => heading.then(Html::element("details", &[], Html::words("summary", caption).then(listed))),
    }
}

fn finding(found: &FindingReport, state: Option<State>) -> Html {
    let news = match state {
        Some(State::New) => " (new)",
        Some(State::Worse) => " (worse than before)",
        _ => "",
    };
    let what = format!("{}[{}]{news}: {}", found.severity, found.id, found.message);
    let mut inner = Html::element("p", &[("class", "what")], Html::text(what));
    if !found.joints.is_empty() {
        let place = found.place.as_ref().map_or_else(String::new, |place| {
            let name = place.file.rsplit(['/', '\\']).next().unwrap_or(&place.file);
            format!(" ({name}:{})", line(place))
        });
        inner.push(Html::words("p", format!("Joints: {}{place}", found.joints.join(", "))));
    }
    inner.push(Html::element(
        "p",
        &[],
        Html::fixed("<strong>What to do:</strong> ").then(Html::text(&found.advice)),
    ));
    Html::element("div", &[("class", &format!("finding {}", found.severity))], inner)
}

fn line(place: &PlaceReport) -> String {
    format!("{}:{}", place.line, place.column)
}

/// Method, effort, errors, and how to get the same again.
pub(super) fn method(page: &Page) -> Html {
    let rows = page.method.iter().map(|(what, how)| vec![Html::text(what), Html::text(how)]);
    let mut whole = table("What was done", &["", ""], rows);
    whole.push(Html::words(
        "p",
        "The joint limits are sampled by low-discrepancy points; from the worst of them a search descends along exact gradients of 1/κ, 1/κ′ and \
         λmin. What it finds is a lower bound on how bad things get: a search is no proof. Eigenvalues come with an estimate of \
         their relative error.",
    ));
    for worst in &page.worst {
        let q: Vec<String> = worst.portrait.q.iter().map(|x| format!("{x:?}")).collect();
        let call = format!(
            "eigenbody spectrum {} --at 'q=[{}]' --metric {}",
            quoted(&page.report.model),
            q.join(","),
            quoted(&worst.portrait.metric)
        );
        whole.push(Html::words("p", format!("To see the {} again:", heading(worst))));
        whole.push(Html::words("pre", call));
    }
    whole
}

/// A word of a shell.
fn quoted(text: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "-._/=".contains(c);
    if text.chars().all(plain) { text.to_owned() } else { format!("'{}'", text.replace('\'', "'\\''")) }
}

pub(super) fn footer() -> Html {
    let version = concat!("Made by eigenbody ", env!("CARGO_PKG_VERSION"), ".");
    Html::element("footer", &[], Html::words("p", escape(version)))
}

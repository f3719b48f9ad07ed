//! What a reproduction of the papers comes to: claims as JSON, as a table for the terminal, and a gallery of figures.

use crate::number::significant;
use comfy_table::{ContentArrangement, Table, presets};
use eigenbody_study::{Check, Experiment, Kind, Outcome, Paper, Reading, Verdict};
use serde::Serialize;
use std::fmt::Write;

/// One claim in `claims.json`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ClaimReport {
    /// Its name.
    pub id: &'static str,
    /// What is claimed.
    pub what: &'static str,
    /// The numbers as printed.
    pub printed: Vec<f64>,
    /// The numbers as computed.
    pub computed: Vec<Option<f64>>,
    /// The same at high precision, where that was done.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub exact: Vec<f64>,
    /// Largest relative difference between printed and computed.
    pub difference: Option<f64>,
    /// `agrees`, `paper rounds`, `paper's round-off`, `shape holds` or `fails`.
    pub verdict: String,
    /// What was tested besides.
    pub checks: Vec<CheckReport>,
    /// What there is to say.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub note: String,
}

/// One test of a shape.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CheckReport {
    /// What is measured.
    pub what: String,
    /// Its value.
    pub found: Option<f64>,
    /// Half the width of its 95 % confidence interval, for a fitted slope.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub half_width: Option<f64>,
    /// Where it must lie; `null` for no bound.
    pub low: Option<f64>,
    /// Where it must lie; `null` for no bound.
    pub high: Option<f64>,
    /// Whether it does.
    pub holds: bool,
}

fn finite(x: f64) -> Option<f64> {
    x.is_finite().then_some(x)
}

impl From<&Check> for CheckReport {
    fn from(check: &Check) -> Self {
        Self {
            what: check.what.clone(),
            found: finite(check.found),
            half_width: check.half_width.and_then(finite),
            low: finite(check.low),
            high: finite(check.high),
            holds: check.holds(),
        }
    }
}

impl From<&Reading> for ClaimReport {
    fn from(reading: &Reading) -> Self {
        let Reading { claim, computed, checks, note, verdict } = reading;
        Self {
            id: claim.id,
            what: claim.what,
            printed: claim.printed.to_vec(),
            computed: computed.iter().copied().map(finite).collect(),
            exact: claim.exact.to_vec(),
            difference: reading.difference().and_then(finite),
            verdict: verdict.to_string(),
            checks: checks.iter().map(CheckReport::from).collect(),
            note: note.clone(),
        }
    }
}

/// All claims as JSON; floats parse back to the same bits, a number that does not exist is `null`.
///
/// # Errors
///
/// Only if the serialiser fails, which plain numbers and strings do not make it do.
pub fn claims_json<'a>(readings: impl Iterator<Item = &'a Reading>) -> Result<String, serde_json::Error> {
    serde_json::to_string_pretty(&readings.map(ClaimReport::from).collect::<Vec<_>>())
}

/// Cells of a claim's row: printed, computed, exact, difference, verdict. Of many numbers the one that is off most.
fn cells(reading: &Reading) -> [String; 5] {
    let Reading { claim, computed, checks, verdict, .. } = reading;
    let off = |i: &usize| ((computed[*i] - claim.printed[*i]) / claim.printed[*i]).abs();
    let count = claim.printed.len().min(computed.len());
    let worst = (0..count).max_by(|a, b| off(a).total_cmp(&off(b)));
    let held = checks.iter().filter(|check| check.holds()).count();
    let numbers = match worst {
        Some(i) => {
            let more = if count > 1 { format!(" ({} of {count})", i + 1) } else { String::new() };
            let exact = claim.exact.get(i).map_or_else(String::new, |&x| significant(x, 10));
            [
                format!("{}{more}", claim.printed[i]),
                significant(computed[i], 8),
                exact,
                format!("{:.1e}", off(&i)),
            ]
        }
        None if claim.kind == Kind::Shape => {
            ["shape".into(), format!("{held} of {} tests hold", checks.len()), String::new(), String::new()]
        }
        None => Default::default(),
    };
    let [printed, computed, exact, difference] = numbers;
    [printed, computed, exact, difference, verdict.to_string()]
}

/// The claims as a table for the terminal, and what failed.
pub fn claims_text(readings: &[&Reading]) -> String {
    let mut table = Table::new();
    table.load_style(presets::NOTHING);
    table.set_content_arrangement(ContentArrangement::Disabled);
    table.set_header(["claim", "printed", "computed", "exact", "difference", "verdict"]);
    for reading in readings {
        let [a, b, c, d, e] = cells(reading);
        table.add_row([reading.claim.id.to_owned(), a, b, c, d, e]);
    }
    let mut page: String = table.lines().map(|line| format!("{}\n", line.trim_end())).collect();
    for reading in readings.iter().filter(|reading| reading.verdict == Verdict::Fails) {
        let _ = writeln!(page, "\n{} fails: {}", reading.claim.id, reading.claim.what);
        for check in reading.checks.iter().filter(|check| !check.holds()) {
            let Check { what, found, low, high, .. } = check;
            let _ = writeln!(page, "  {what}: {}, expected {low} to {high}", significant(*found, 6));
        }
    }
    page
}

/// An experiment that was run, and whether it has a figure.
pub struct Shown<'a> {
    /// The experiment.
    pub experiment: &'a Experiment,
    /// What it yielded.
    pub outcome: &'a Outcome,
    /// Its figure stands beside the page as `ID.svg`.
    pub has_figure: bool,
}

fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

/// The page `index.html`: every figure with what is seen, and every claim. Needs nothing but the files beside it.
pub fn gallery(shown: &[Shown<'_>]) -> String {
    let mut page = String::from(HEAD);
    let readings: Vec<&Reading> = shown.iter().flat_map(|shown| &shown.outcome.readings).collect();
    let failed = readings.iter().filter(|reading| reading.verdict == Verdict::Fails).count();
    let _ = writeln!(
        page,
        "<p>{} figures, {} claims, {failed} failed. Numbers: <a href=\"claims.json\">claims.json</a>, <a href=\"#claims\">table</a>; a CSV beside every figure.</p>",
        shown.iter().filter(|shown| shown.has_figure).count(),
        readings.len()
    );
    for (paper, title) in [(Paper::Featherstone, FEATHERSTONE), (Paper::ShahSaha, SHAH_SAHA)] {
        let mut members = shown.iter().filter(|shown| shown.experiment.paper == paper).peekable();
        if members.peek().is_none() {
            continue;
        }
        let _ = writeln!(page, "<h2>{title}</h2>");
        for shown in members {
            section(&mut page, shown);
        }
    }
    let _ = writeln!(
        page,
        "<h2 id=\"claims\">Claims</h2>\n<table>\n<tr><th>claim<th>what<th>printed<th>computed<th>exact<th>difference<th>verdict</tr>"
    );
    for reading in readings {
        let [a, b, c, d, e] = cells(reading);
        let note = if reading.note.is_empty() {
            String::new()
        } else {
            format!("<br><small>{}</small>", escape(&reading.note))
        };
        let _ = writeln!(
            page,
            "<tr><td><code>{}</code><td>{}{note}{}<td>{a}<td>{b}<td>{c}<td>{d}<td class=\"{}\">{e}</tr>",
            reading.claim.id,
            escape(reading.claim.what),
            tests(reading),
            if reading.verdict == Verdict::Fails { "fails" } else { "holds" }
        );
    }
    page.push_str("</table>\n</main>\n</body>\n</html>\n");
    page
}

fn section(page: &mut String, Shown { experiment, outcome, has_figure }: &Shown<'_>) {
    let Experiment { id, title, seen, .. } = experiment;
    let _ = writeln!(page, "<section id=\"{id}\">\n<h3><code>{id}</code> {}</h3>", escape(title));
    if *has_figure {
        let _ = writeln!(
            page,
            "<a href=\"{id}.svg\"><img src=\"{id}.svg\" alt=\"{}\" loading=\"lazy\"></a>",
            escape(title)
        );
    }
    let png = if *has_figure { format!(" · <a href=\"{id}.png\">PNG</a>") } else { String::new() };
    let remark =
        if outcome.remark.is_empty() { String::new() } else { format!(" {}", escape(&outcome.remark)) };
    let _ = writeln!(page, "<p>{}{remark} <a href=\"{id}.csv\">CSV</a>{png}</p>\n</section>", escape(seen));
}

/// The tests behind a verdict, folded away.
fn tests(reading: &Reading) -> String {
    if reading.checks.is_empty() {
        return String::new();
    }
    let mut list = format!("<details><summary>{} tests</summary><ul>", reading.checks.len());
    for check in &reading.checks {
        let Check { what, found, half_width, low, high } = check;
        let spread = half_width
            .filter(|w| w.is_finite())
            .map_or_else(String::new, |w| format!(" ± {}", significant(w, 2)));
        let mark = if check.holds() { "" } else { " <b>fails</b>" };
        let _ = write!(
            list,
            "<li>{}: {}{spread}, expected {low} to {high}{mark}",
            escape(what),
            significant(*found, 6)
        );
    }
    list + "</ul></details>"
}

const FEATHERSTONE: &str = "R. Featherstone, An Empirical Study of the Joint Space Inertia Matrix, Int. J. Robotics Research 23 (2004)";
const SHAH_SAHA: &str = "S. V. Shah, S. K. Saha, Correlation between diagonal ratio and condition number of the generalized inertia matrix of a serial-chain, Archive of Mechanical Engineering 60 (2013)";

const HEAD: &str = "<!DOCTYPE html>
<html lang=\"en\">
<head>
<meta charset=\"utf-8\">
<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">
<title>Two papers, reproduced</title>
<style>
:root { color-scheme: light; }
body { margin: 0; background: #fff; color: #1a1a1a; font: 16px/1.5 \"DejaVu Sans\", Verdana, sans-serif; }
main { max-width: 860px; margin: 0 auto; padding: 24px 16px; }
h1 { font-size: 26px; } h2 { font-size: 19px; margin: 40px 0 8px; } h3 { font-size: 16px; margin: 0 0 8px; }
section { border-top: 1px solid #ddd; padding: 16px 0; }
img { display: block; width: 100%; max-width: 800px; height: auto; }
table { border-collapse: collapse; font-size: 13px; } td, th { border-bottom: 1px solid #ddd; padding: 4px 8px; text-align: left; vertical-align: top; }
td:nth-child(n+3) { overflow-wrap: anywhere; }
.holds { color: #00613f; } .fails { color: #a33b00; font-weight: bold; }
a { color: #0b5394; }
</style>
</head>
<body>
<main>
<h1>Two papers on ill-conditioned inertia matrices, reproduced</h1>
";

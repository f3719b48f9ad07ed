//! A report to keep: one HTML file that needs nothing else.
//!
//! No script, no request: the style is inside, drawings are SVG by [`figure`](crate::figure), and the content security policy allows nothing
//! more. Every number that `check --format json` prints as a result stands in a `<data>` element whose `value` is exact. The
//! same robot, options and seed give the same bytes.

mod coordinates;
mod html;
mod numbers;
mod pictures;
mod prose;

use crate::diagnosis::{DiagnosisReport, measure_name};
use crate::number::significant;
use eigenbody::Model;
use eigenbody::search::Measure;
use eigenbody_study::diagnosis::{Diagnosis, Question};
use eigenbody_study::portrait::Portrait;
use html::Html;

/// Where a measure is worst, drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct WorstPicture {
    /// The measures that are worst here: `kappa`, `kappa_weighted`, `lambda_min`.
    pub measures: Vec<&'static str>,
    /// The robot there.
    pub portrait: Portrait,
}

/// What a page is made of.
#[derive(Debug, Clone, PartialEq)]
pub struct Page {
    /// The findings and the numbers.
    pub report: DiagnosisReport,
    /// The robot's own name.
    pub robot: String,
    /// `fixed`, `floating` or `free-floating`.
    pub base: String,
    /// Total mass (kg).
    pub mass: f64,
    /// Number of moving bodies.
    pub bodies: usize,
    /// Names and units of coordinates, for the table of configurations.
    pub coordinates: Vec<(String, &'static str)>,
    /// Unit of λmin.
    pub unit: &'static str,
    /// The worst configurations.
    pub worst: Vec<WorstPicture>,
    /// How it was computed: what, and how much.
    pub method: Vec<(String, String)>,
}

/// How a measure is written.
fn symbol(measure: &str) -> &'static str {
    match measure {
        "kappa" => "κ",
        "kappa_weighted" => "κ′",
        _ => "λmin",
    }
}

/// `worst κ and λmin`.
fn heading(worst: &WorstPicture) -> String {
    let symbols: Vec<&str> = worst.measures.iter().map(|measure| symbol(measure)).collect();
    format!("worst {}", symbols.join(" and "))
}

impl Page {
    /// The page of a robot that was examined: its report, the worst configurations, and what `settings` were read from a file.
    pub fn new(
        report: DiagnosisReport,
        model: &Model<f64>,
        question: &Question,
        found: &Diagnosis,
        worst: Vec<(Vec<Measure>, Portrait)>,
        settings: Option<String>,
    ) -> Self {
        let picture = |(measures, portrait): (Vec<Measure>, Portrait)| WorstPicture {
            measures: measures.into_iter().map(measure_name).collect(),
            portrait,
        };
        Self {
            report,
            robot: model.name().to_owned(),
            base: match (model.has_floating_base(), question.reduction.base) {
                (false, _) => "fixed",
                (true, false) => "floating",
                (true, true) => "free-floating",
            }
            .to_owned(),
            mass: model.bodies().iter().map(|body| body.inertia().m).sum(),
            bodies: model.bodies().len(),
            coordinates: coordinates::coordinates(model),
            unit: found.unit,
            worst: worst.into_iter().map(picture).collect(),
            method: method(question, settings, found),
        }
    }

    /// The page.
    pub fn to_html(&self) -> String {
        let title = format!("{}: conditioning", self.report.model);
        let section = |id: &'static str, heading: &'static str, inner: Html| {
            let heading = Html::words("h2", heading);
            Html::element("section", &[("id", id)], heading.then(inner)).then(Html::fixed("\n"))
        };
        let main = [
            section("findings", "Findings", prose::findings(&self.report)),
            section("numbers", "Numbers", numbers::summary(self)),
            section("steps", "Time step and gains", numbers::stepping(self.report.stepping.as_ref())),
            section("worst", "Worst configurations", pictures::worst(self)),
            section("spectrum", "Spectrum", pictures::spectrum(self)),
            section("matrix", "Matrix", pictures::matrices(self)),
            section("configurations", "Coordinates", numbers::coordinates(self)),
            section("method", "How it was computed", prose::method(self)),
        ];
        let page = Html::fixed("<a class=\"skip\" href=\"#findings\">To the findings</a>\n")
            .then(Html::element("header", &[], prose::lead(self)))
            .then(Html::element("main", &[], Html::all(main)))
            .then(prose::footer());
        format!(
            "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n\
             <meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'; base-uri 'none'; form-action 'none'\"/>\n\
             <meta name=\"viewport\" content=\"width=device-width,initial-scale=1\"/>\n\
             <meta name=\"color-scheme\" content=\"light dark\"/>\n\
             {}\n<style>\n{}</style>\n</head>\n<body>\n{}</body>\n</html>\n",
            Html::words("title", title).into_string(),
            include_str!("style.css"),
            page.into_string()
        )
    }
}

fn method(question: &Question, settings: Option<String>, found: &Diagnosis) -> Vec<(String, String)> {
    let Question { reduction, metric, effort, limits, .. } = question;
    let rows = [
        ("eigenbody", env!("CARGO_PKG_VERSION").to_owned()),
        ("samples", effort.samples.to_string()),
        ("seed", effort.seed.to_string()),
        ("configurations evaluated", found.evaluations.to_string()),
        ("metric of κ and λmin", metric.to_string()),
        ("mimic joints", if reduction.mimic { "follow" } else { "move freely" }.to_owned()),
        ("a finding if κ′ exceeds", significant(limits.kappa_weighted, 3)),
        ("a finding if κ exceeds", significant(limits.kappa, 3)),
        ("digits that single precision must keep", significant(limits.f32_digits, 3)),
        ("settings", settings.unwrap_or_else(|| "none".to_owned())),
    ];
    rows.map(|(what, how)| (what.to_owned(), how)).into()
}

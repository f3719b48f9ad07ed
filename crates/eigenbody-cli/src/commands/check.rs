//! `eigenbody check` and `eigenbody report`.

use super::advise::advise;
use super::convert::Written;
use super::drive::drive;
use super::positive;
use crate::args::{CheckArgs, CheckCommand, CheckFormat, ReportArgs};
use crate::fail_on::FailOn;
use crate::failure::Failure;
use crate::output::{self, deliver};
use crate::settings::Settings;
use crate::system::robot;
use eigenbody::Metric;
use eigenbody::search::Effort;
use eigenbody_formats::Loaded;
use eigenbody_report::{Baseline, DiagnosisReport, Page, State, advice_text, diagnosis_text};
use eigenbody_study::StudyError;
use eigenbody_study::diagnosis::{Diagnosis, Goal, Limits, Question, Remedies, Severity, diagnose};
use eigenbody_study::portrait::worst_portraits;
use indicatif::{ProgressBar, ProgressStyle};
use std::ops::ControlFlow;
use std::path::Path;
use std::time::Duration;

/// A robot, examined.
struct Examined {
    loaded: Loaded,
    question: Question,
    settings: Settings,
    found: Diagnosis,
    advice: Option<(Goal, Remedies)>,
    report: DiagnosisReport,
}

/// Prints what is wrong; false if something is.
pub fn run(args: &CheckCommand) -> Result<bool, Failure> {
    let examined = examine(&args.check, args.output.as_deref())?;
    let Examined { found, advice, report, settings, .. } = &examined;
    let json = |text: Result<String, serde_json::Error>| {
        text.map(|text| text + "\n").map_err(|error| Failure::Json(error.to_string()))
    };
    let text = match args.format {
        CheckFormat::Human => {
            let page = diagnosis_text(&report.model, found, &report.model_findings);
            let advice: String = advice.iter().map(|(goal, found)| advice_text(*goal, found)).collect();
            page + &advice
                + &report.comparison.as_ref().map_or_else(String::new, eigenbody_report::Comparison::to_text)
        }
        CheckFormat::Json => json(report.to_json())?,
        CheckFormat::Sarif => json(report.to_sarif())?,
        CheckFormat::Html => html(&examined)?,
    };
    let path = args.output.as_deref();
    match args.format {
        CheckFormat::Human => output::page(path, &text)?,
        _ => deliver(path, |out| out.write_all(text.as_bytes()))?,
    }
    let fail_on = args.fail_on.as_ref().or(settings.fail_on.as_ref());
    Ok(!fails(fail_on.unwrap_or(&FailOn::Level(Severity::Warning)), found, report))
}

/// Writes the page.
pub fn page(args: &ReportArgs) -> Result<(), Failure> {
    let page = html(&examine(&args.check, Some(&args.output))?)?;
    deliver(Some(&args.output), |out| out.write_all(page.as_bytes()))?;
    deliver(None, |out| writeln!(out, "{}: {} kB", args.output.display(), page.len().div_ceil(1000)))
}

/// True if a finding counts. Remarks on the file count only by name; where there is a baseline, only what is new or worse.
fn fails(fail_on: &FailOn, found: &Diagnosis, report: &DiagnosisReport) -> bool {
    let states = |pick: fn(&eigenbody_report::Comparison) -> &Vec<State>, n: usize| match &report.comparison {
        Some(comparison) => pick(comparison).clone(),
        None => vec![State::New; n],
    };
    let of_findings = states(|c| &c.findings, found.findings.len());
    let of_remarks = states(|c| &c.remarks, report.remarks.len());
    let counts = |state: &State| *state != State::Unchanged;
    match fail_on {
        FailOn::Never => false,
        FailOn::Level(least) => {
            found.findings.iter().zip(&of_findings).any(|(f, s)| f.severity >= *least && counts(s))
        }
        FailOn::Codes(codes) => {
            let findings = report.findings.iter().map(|f| f.id).zip(&of_findings);
            let remarks = report.remarks.iter().map(|r| r.code).zip(&of_remarks);
            findings.chain(remarks).any(|(code, s)| codes.iter().any(|c| c == code) && counts(s))
        }
    }
}

fn examine(args: &CheckArgs, output: Option<&Path>) -> Result<Examined, Failure> {
    args.write_patch.as_deref().map(|file| Written::of("--write-patch", file)).transpose()?;
    let (loaded, reduction) = robot(&args.model)?;
    let settings = Settings::find(args.config.as_deref(), &loaded)?;
    // The file that is found beside the model is read as well.
    let writes: Vec<&Path> = output.into_iter().chain(args.write_patch.as_deref()).collect();
    output::check_files(settings.path.as_deref().as_slice(), &writes)?;
    output::check_model(&loaded, &[output, args.write_patch.as_deref()])?;
    let baseline = args.baseline.as_deref().map(baseline).transpose()?;
    let metric = args.metric.as_ref().or(settings.metric.as_ref());
    let metric = metric.map_or(Ok(Metric::Euclidean), |text| eigenbody_formats::metric(text))?;
    let default = Effort::default();
    let effort = Effort {
        samples: args.samples.or(settings.samples).unwrap_or(default.samples),
        seed: args.seed.or(settings.seed).unwrap_or(default.seed),
        ..default
    };
    let drive = drive(&settings.drive(&args.gains), &loaded)?;
    let question = Question { reduction, metric, effort, limits: limits(args, &settings)?, drive };
    let bar = progress();
    let found = diagnose(&loaded.model, &question, |evaluated| {
        bar.inc(evaluated as u64);
        ControlFlow::Continue(())
    });
    bar.finish_and_clear();
    let name = &args.model.model;
    let found = found.map_err(|error| failed(name, error))?;
    let advice = advise(args, &loaded, reduction, effort, &question.drive)?;
    let report = DiagnosisReport::of(name, &loaded, &found).with_advice(advice.as_ref());
    let report = match &baseline {
        Some((file, baseline)) => report.against(file, baseline),
        None => report,
    };
    Ok(Examined { loaded, question, settings, found, advice, report })
}

fn failed(name: &str, error: StudyError) -> Failure {
    match error {
        StudyError::Numbers(source) => Failure::Numbers { model: name.to_owned(), source },
        error => Failure::Usage(format!("{name}: {error}")),
    }
}

/// An earlier report, and how its file is called.
fn baseline(path: &Path) -> Result<(String, Baseline), Failure> {
    let text =
        std::fs::read_to_string(path).map_err(|source| Failure::File { path: path.to_owned(), source })?;
    let name = path.display().to_string();
    let baseline = Baseline::parse(&text).map_err(|error| {
        Failure::Usage(format!(
            "{name}:{}:{}: no report of `eigenbody check --format json`: {error}",
            error.line(),
            error.column()
        ))
    })?;
    Ok((name, baseline))
}

/// The page: the report, and portraits of the worst configurations.
fn html(examined: &Examined) -> Result<String, Failure> {
    let Examined { loaded, question, settings, found, report, .. } = examined;
    let worst = worst_portraits(&loaded.model, question, found);
    let worst = worst.map_err(|error| failed(&report.model, error))?;
    let settings = settings.path.as_ref().map(|path| path.display().to_string());
    Ok(Page::new(report.clone(), &loaded.model, question, found, worst, settings).to_html())
}

/// What the options say, else the file, else the defaults.
fn limits(args: &CheckArgs, settings: &Settings) -> Result<Limits, Failure> {
    let default = Limits::default();
    let or = |option: &str, given: Option<f64>, kept: Option<f64>, default: f64| match given {
        Some(x) => positive(option, x),
        None => Ok(kept.unwrap_or(default)),
    };
    Ok(Limits {
        kappa_weighted: or(
            "--max-kappa-weighted",
            args.max_kappa_weighted,
            settings.max_kappa_weighted,
            default.kappa_weighted,
        )?,
        kappa: or("--max-kappa", args.max_kappa, settings.max_kappa, default.kappa)?,
        f32_digits: or("--f32-digits", args.f32_digits, settings.f32_digits, default.f32_digits)?,
    })
}

/// Configurations evaluated so far, on standard error, if a person looks at it.
fn progress() -> ProgressBar {
    let bar = ProgressBar::new_spinner();
    if let Ok(style) =
        ProgressStyle::with_template("{elapsed_precise} {spinner} {pos} configurations, {per_sec}")
    {
        bar.set_style(style);
    }
    bar.enable_steady_tick(Duration::from_millis(200));
    bar
}

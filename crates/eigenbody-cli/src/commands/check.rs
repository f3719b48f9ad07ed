//! `eigenbody check`.

use super::advise::advise;
use super::drive::drive;
use super::positive;
use crate::args::{CheckArgs, CheckFormat, FailOn};
use crate::failure::Failure;
use crate::output::deliver;
use crate::system::robot;
use eigenbody::search::Effort;
use eigenbody_formats::Kind;
use eigenbody_report::{DiagnosisReport, advice_text, diagnosis_text};
use eigenbody_study::StudyError;
use eigenbody_study::diagnosis::{Limits, Question, Severity, diagnose};
use indicatif::{ProgressBar, ProgressStyle};
use std::time::Duration;

/// Prints what is wrong; false if something is.
pub fn run(args: &CheckArgs) -> Result<bool, Failure> {
    let metric = eigenbody_formats::metric(&args.metric)?;
    let limits = limits(args)?;
    let (loaded, reduction) = robot(&args.model)?;
    let model = &loaded.model;
    let effort = Effort { samples: args.samples, seed: args.seed, ..Effort::default() };
    let drive = drive(&args.gains, &loaded)?;
    let question = Question { reduction, metric, effort, limits, drive };
    let bar = progress();
    let found = diagnose(model, &question, |evaluated| bar.inc(evaluated as u64));
    bar.finish_and_clear();
    let name = &args.model.model;
    let found = found.map_err(|error| match error {
        StudyError::Numbers(source) => Failure::Numbers { model: name.clone(), source },
        error => Failure::Usage(format!("{name}: {error}")),
    })?;
    let own = if matches!(loaded.kind, Kind::File(_)) { loaded.findings() } else { Vec::new() };
    let advice = advise(args, &loaded, reduction, effort, &question.drive)?;
    let text = match args.format {
        CheckFormat::Human => {
            let advice = advice.iter().map(|(goal, found)| advice_text(*goal, found));
            diagnosis_text(name, &found, &own) + &advice.collect::<String>()
        }
        CheckFormat::Json => {
            let json = DiagnosisReport::new(name, &found, own).with_advice(advice.as_ref()).to_json();
            format!("{}\n", json.map_err(|error| Failure::Json(error.to_string()))?)
        }
    };
    deliver(args.output.as_deref(), |out| out.write_all(text.as_bytes()))?;
    let least = match args.fail_on {
        FailOn::Warning => Severity::Warning,
        FailOn::Error => Severity::Error,
        FailOn::Never => return Ok(true),
    };
    Ok(!found.findings.iter().any(|finding| finding.severity >= least))
}

fn limits(args: &CheckArgs) -> Result<Limits, Failure> {
    let default = Limits::default();
    let or = |option: &str, given: Option<f64>, default: f64| match given {
        Some(x) => positive(option, x),
        None => Ok(default),
    };
    Ok(Limits {
        kappa_weighted: or("--max-kappa-weighted", args.max_kappa_weighted, default.kappa_weighted)?,
        kappa: or("--max-kappa", args.max_kappa, default.kappa)?,
        f32_digits: or("--f32-digits", args.f32_digits, default.f32_digits)?,
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

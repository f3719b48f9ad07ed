//! `eigenbody check`.

use super::drive::drive;
use super::positive;
use crate::args::{CheckArgs, CheckFormat, FailOn};
use crate::failure::Failure;
use crate::output::deliver;
use crate::system::robot;
use eigenbody::search::Effort;
use eigenbody::{Model, Reduction};
use eigenbody_formats::{Kind, write_mjcf};
use eigenbody_report::{DiagnosisReport, advice_text, diagnosis_text};
use eigenbody_study::StudyError;
use eigenbody_study::diagnosis::{Advice, Goal, Limits, Question, Severity, diagnose, least_armature};
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
    let advice = advise(args, model, reduction, effort)?;
    let text = match args.format {
        CheckFormat::Human => {
            diagnosis_text(name, &found, &own) + &advice.iter().map(advice_text).collect::<String>()
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

/// The least armature for what is wanted, and a model with it where one is asked for.
fn advise(
    args: &CheckArgs,
    model: &Model<f64>,
    reduction: Reduction,
    effort: Effort,
) -> Result<Option<Advice>, Failure> {
    let goal = match (args.want_kappa, args.want_lambda_min) {
        (None, None) if args.write_patch.is_some() => {
            return Err(Failure::Usage(
                "--write-patch: say what is wanted, --want-kappa or --want-lambda-min".into(),
            ));
        }
        (None, None) => return Ok(None),
        (Some(kappa), _) => Goal::Kappa(positive("--want-kappa", kappa)?),
        (None, Some(least)) => Goal::LambdaMin(positive("--want-lambda-min", least)?),
    };
    let name = &args.model.model;
    let failed = |error: StudyError| Failure::Usage(format!("{name}: {error}"));
    let Some(advice) = least_armature(model, reduction, goal, effort).map_err(failed)? else {
        return Err(Failure::Usage(format!("{name}: no armature was found that does what is wanted")));
    };
    if let Some(path) = &args.write_patch {
        let mended = model.clone().with_armature(advice.armature.clone());
        let mended =
            mended.map_err(|source| Failure::Numbers { model: name.clone(), source: source.into() })?;
        let text = write_mjcf(&mended).map_err(|source| Failure::Write { model: name.clone(), source })?;
        deliver(Some(path), |out| out.write_all(text.as_bytes()))?;
    }
    Ok(Some(advice))
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

//! What takes longer: checks, searches, the papers.

use crate::error::Failure;
use crate::model::Model;
use eigenbody::search::{Effort, survey};
use eigenbody_formats::{Loaded, Stepping};
use eigenbody_report::{DiagnosisReport, claims_json};
use eigenbody_study::diagnosis::{Drive, Limits, Question, diagnose};
use eigenbody_study::{Lab, select};
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;

fn effort((samples, seed): (u32, u32)) -> Result<Effort, Failure> {
    if !(1..=65_536).contains(&samples) {
        return Err(Failure::input("samples", format!("{samples}, expected 1 to 65536")));
    }
    Ok(Effort { samples, seed, ..Effort::default() })
}

fn positive(what: &str, given: Option<f64>, default: f64) -> Result<f64, Failure> {
    match given {
        None => Ok(default),
        Some(x) if x > 0.0 && x.is_finite() => Ok(x),
        Some(x) => Err(Failure::input(what, format!("{x}, expected a positive number"))),
    }
}

/// How a robot's own file drives and steps it.
fn drive(loaded: &Loaded) -> Drive {
    let springs = loaded.springs.clone();
    match loaded.stepping {
        Some(Stepping { step, integrator }) => Drive { springs, step: Some(step), integrator },
        None => Drive { springs, ..Drive::default() },
    }
}

/// What `eigenbody check --format json` prints, as a `Diagnosis`.
pub fn check<'py>(
    model: &Model,
    py: Python<'py>,
    metric: &str,
    look: (u32, u32),
    [kappa_weighted, kappa, f32_digits]: [Option<f64>; 3],
) -> Result<Bound<'py, PyAny>, Failure> {
    let shared = &model.shared;
    let default = Limits::default();
    let limits = Limits {
        kappa_weighted: positive("max_kappa_weighted", kappa_weighted, default.kappa_weighted)?,
        kappa: positive("max_kappa", kappa, default.kappa)?,
        f32_digits: positive("f32_digits", f32_digits, default.f32_digits)?,
    };
    let question = Question {
        reduction: shared.robot.reduction,
        metric: eigenbody_formats::metric(metric)?,
        effort: effort(look)?,
        limits,
        drive: shared.loaded.as_ref().map(drive).unwrap_or_default(),
    };
    let found = py.detach(|| diagnose(&shared.robot.model, &question, |_| ()))?;
    let report = DiagnosisReport::new(&shared.name, &found, shared.findings.clone());
    let json = report.to_json().map_err(|error| Failure::input("model", error))?;
    Ok(py.import("eigenbody._results")?.getattr("Diagnosis")?.call_method1("_of_json", (json,))?)
}

/// By measure: the worst value, where, the median and the worst of nine in ten.
pub fn worst_case<'py>(
    model: &Model,
    py: Python<'py>,
    metric: &str,
    look: (u32, u32),
) -> Result<Bound<'py, PyDict>, Failure> {
    let shared = &model.shared;
    let (metric, effort) = (eigenbody_formats::metric(metric)?, effort(look)?);
    let found = py.detach(|| survey(&shared.robot.model, shared.robot.reduction, &metric, effort, |_| ()))?;
    let class = py.import("eigenbody._results")?.getattr("WorstCase")?;
    let all = PyDict::new(py);
    for (name, spread) in ["kappa", "kappa_weighted", "lambda_min"].into_iter().zip(found.spreads) {
        let q = PyArray1::from_vec(py, model.given(&spread.at));
        all.set_item(name, class.call1((name, spread.worst, q, spread.median, spread.tenth))?)?;
    }
    Ok(all)
}

/// The claims of both papers, printed against computed.
#[pyfunction]
#[pyo3(signature = (*ids, quick=false))]
pub fn reproduce<'py>(py: Python<'py>, ids: Vec<String>, quick: bool) -> Result<Bound<'py, PyAny>, Failure> {
    let names: Vec<&str> = ids.iter().map(String::as_str).collect();
    let experiments = select(&names).map_err(|error| Failure::input("ids", error))?;
    let lab = Lab { quick, ..Lab::default() };
    let mut readings = Vec::new();
    for experiment in experiments {
        readings.extend(py.detach(|| experiment.run(&lab))?.readings);
        // A study takes minutes: Ctrl-C is heard between two.
        py.check_signals()?;
    }
    let json = claims_json(readings.iter()).map_err(|error| Failure::input("ids", error))?;
    Ok(py.import("json")?.call_method1("loads", (json,))?)
}

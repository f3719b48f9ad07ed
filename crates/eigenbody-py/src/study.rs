//! What takes longer: checks, searches, the papers.

use crate::compute::in_parallel;
use crate::error::Failure;
use crate::given::Gains;
use crate::model::{Model, Shared};
use eigenbody::search::{Effort, survey};
use eigenbody::stability::Integrator;
use eigenbody_report::{
    Baseline, Comparison, DiagnosisReport, Page, advice_text, claims_json, diagnosis_text,
};
use eigenbody_study::diagnosis::{
    Change, Diagnosis as Found, Drive, Goal, Limits, Question, Remedies, Wish, diagnose, remedies,
};
use eigenbody_study::portrait::worst_portraits;
use eigenbody_study::{Lab, select};
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::path::PathBuf;
use std::sync::Arc;

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

/// What is asked of a check, by its names in Python.
pub struct Look<'a, 'py> {
    pub metric: &'a str,
    /// Samples and seed.
    pub effort: (u32, u32),
    /// κ′, κ, digits in single precision.
    pub limits: [Option<f64>; 3],
    /// kp and kd.
    pub gains: [Option<Gains<'py>>; 2],
    pub step: Option<f64>,
    pub integrator: Option<String>,
    /// κ, λmin, step.
    pub wants: [Option<f64>; 3],
    pub baseline: Option<Bound<'py, PyAny>>,
}

impl Look<'_, '_> {
    fn question(&self, shared: &Shared) -> Result<Question, Failure> {
        let default = Limits::default();
        let [kappa_weighted, kappa, f32_digits] = self.limits;
        let limits = Limits {
            kappa_weighted: positive("max_kappa_weighted", kappa_weighted, default.kappa_weighted)?,
            kappa: positive("max_kappa", kappa, default.kappa)?,
            f32_digits: positive("f32_digits", f32_digits, default.f32_digits)?,
        };
        Ok(Question {
            reduction: shared.robot.reduction,
            metric: eigenbody_formats::metric(self.metric)?,
            effort: effort(self.effort)?,
            limits,
            drive: self.drive(shared)?,
        })
    }

    fn drive(&self, shared: &Shared) -> Result<Drive, Failure> {
        let model = &shared.robot.model;
        let mut drive = shared.drive.clone();
        let [kp, kd] = &self.gains;
        if let Some(kp) = kp {
            drive = drive.with_stiffness(model, &kp.read("kp", shared)?);
        }
        if let Some(kd) = kd {
            drive = drive.with_damping(model, &kd.read("kd", shared)?);
        }
        if self.step.is_some() {
            drive.step = Some(positive("step", self.step, 0.0)?);
        }
        drive.integrator = match self.integrator.as_deref() {
            None => drive.integrator,
            Some("semi-implicit") => Integrator::SemiImplicitEuler,
            Some("damped") => Integrator::DampedEuler,
            Some("implicit") => Integrator::ImplicitVelocity,
            Some("rk4") => Integrator::RungeKutta4,
            Some(other) => {
                let problem = format!("'{other}', expected semi-implicit, damped, implicit or rk4");
                return Err(Failure::input("integrator", problem));
            }
        };
        Ok(drive)
    }

    fn goal(&self, drive: &Drive) -> Result<Option<Goal>, Failure> {
        Ok(match self.wants {
            [None, None, None] => None,
            [kappa @ Some(_), None, None] => Some(Goal::Kappa(positive("want_kappa", kappa, 0.0)?)),
            [None, least @ Some(_), None] => Some(Goal::LambdaMin(positive("want_lambda_min", least, 0.0)?)),
            [None, None, step @ Some(_)] => {
                let step = positive("want_step", step, 0.0)?;
                if drive.springs.is_empty() {
                    let problem = "the file has no stiffness, damping or gains; give kp and kd";
                    return Err(Failure::input("want_step", problem));
                }
                if drive.integrator == Integrator::RungeKutta4 {
                    let problem = "for methods of Euler's kind; choose one with integrator=";
                    return Err(Failure::input("want_step", problem));
                }
                Some(Goal::Step(step, drive.integrator))
            }
            _ => return Err(Failure::input("want_kappa", "one thing at a time can be wanted")),
        })
    }

    /// An earlier `Diagnosis`, its dictionary, or the path of its JSON; and how to call it.
    fn baseline(&self) -> Result<Option<(String, Baseline)>, Failure> {
        let Some(given) = &self.baseline else { return Ok(None) };
        let py = given.py();
        let (name, text) = if let Ok(path) = given.extract::<PathBuf>() {
            let name = path.display().to_string();
            let text = std::fs::read_to_string(&path)
                .map_err(|error| Failure::input("baseline", format!("{name}: {error}")))?;
            (name, text)
        } else {
            let dictionary = match given.hasattr("to_dict")? {
                true => given.call_method0("to_dict")?,
                false => given.clone(),
            };
            let text = py.import("json")?.call_method1("dumps", (dictionary,))?.extract()?;
            ("baseline".to_owned(), text)
        };
        let baseline = Baseline::parse(&text)
            .map_err(|error| Failure::input("baseline", format!("{name}: no report of a check: {error}")))?;
        Ok(Some((name, baseline)))
    }
}

/// What a `Diagnosis` was made from.
#[pyclass(module = "eigenbody._eigenbody", frozen)]
pub struct Examination {
    shared: Arc<Shared>,
    question: Question,
    found: Found,
    advice: Option<(Goal, Remedies)>,
    report: DiagnosisReport,
}

#[pymethods]
impl Examination {
    /// What `eigenbody check --format json` prints.
    fn to_json(&self) -> Result<String, Failure> {
        self.report.to_json().map_err(|error| Failure::input("model", error))
    }

    /// What `eigenbody check --format sarif` prints.
    fn to_sarif(&self) -> Result<String, Failure> {
        self.report.to_sarif().map_err(|error| Failure::input("model", error))
    }

    /// What `eigenbody check` prints.
    fn to_text(&self) -> String {
        let Self { found, advice, report, .. } = self;
        let advice: String = advice.iter().map(|(goal, found)| advice_text(*goal, found)).collect();
        let against = report.comparison.as_ref().map_or_else(String::new, Comparison::to_text);
        diagnosis_text(&report.model, found, &report.model_findings) + &advice + &against
    }

    /// What `eigenbody report` writes.
    fn to_html(&self, py: Python<'_>) -> Result<String, Failure> {
        let Self { shared, question, found, report, .. } = self;
        let model = &shared.robot.model;
        in_parallel(py, |_| {
            let worst = worst_portraits(model, question, found)?;
            Ok(Page::new(report.clone(), model, question, found, worst, None).to_html())
        })
    }

    /// The robot with what was advised.
    #[pyo3(signature = (change="armature", /))]
    fn mended(&self, change: &str) -> Result<Model, Failure> {
        let change = match change {
            "armature" => Change::Armature,
            "link" => Change::Link,
            "limit" => Change::Limit,
            other => {
                let problem = format!("'{other}', expected armature, link or limit");
                return Err(Failure::input("change", problem));
            }
        };
        let Some((_, remedies)) = &self.advice else {
            return Err(Failure::input("change", "nothing was wanted; see want_kappa and its kin"));
        };
        let mended = remedies.mend(&self.shared.robot.model, change)?;
        let mended =
            mended.ok_or_else(|| Failure::input("change", "none was found that does what is wanted"))?;
        Ok(Model::with(&self.shared, mended))
    }
}

/// What `eigenbody check --format json` prints, as a `Diagnosis`.
pub fn check<'py>(
    model: &Model,
    py: Python<'py>,
    look: &Look<'_, 'py>,
) -> Result<Bound<'py, PyAny>, Failure> {
    let shared = &model.shared;
    let question = look.question(shared)?;
    let goal = look.goal(&question.drive)?;
    let baseline = look.baseline()?;
    let robot = &shared.robot;
    let (found, advice) = in_parallel(py, |progress| {
        let found = diagnose(&robot.model, &question, progress)?;
        let Question { reduction, effort, drive, .. } = &question;
        let advice = match goal {
            Some(goal) => {
                let wish = Wish { reduction: *reduction, goal, effort: *effort, springs: &drive.springs };
                Some((goal, remedies(&robot.model, &wish)?))
            }
            None => None,
        };
        Ok((found, advice))
    })?;
    if advice.as_ref().is_some_and(|(_, found)| found.is_empty()) {
        return Err(Failure::input("model", "nothing was found that does what is wanted"));
    }
    let report = match &shared.loaded {
        Some(loaded) => DiagnosisReport::of(&shared.name, loaded, &found),
        None => DiagnosisReport::new(&shared.name, &found, shared.findings.clone()),
    };
    let report = report.with_advice(advice.as_ref());
    let report = match &baseline {
        Some((name, baseline)) => report.against(name, baseline),
        None => report,
    };
    let examination = Examination { shared: Arc::clone(shared), question, found, advice, report };
    let class = py.import("eigenbody._results")?.getattr("Diagnosis")?;
    Ok(class.call_method1("_of", (examination,))?)
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
    let found = in_parallel(py, |progress| {
        Ok(survey(&shared.robot.model, shared.robot.reduction, &metric, effort, progress)?)
    })?;
    let class = py.import("eigenbody._results")?.getattr("WorstCase")?;
    let all = PyDict::new(py);
    for (name, spread) in ["kappa", "kappa_weighted", "lambda_min"].into_iter().zip(found.spreads) {
        let q = PyArray1::from_vec(py, shared.given(&spread.at));
        all.set_item(name, class.call1((name, spread.worst, q, spread.median, spread.tenth))?)?;
    }
    Ok(all)
}

/// The claims of Featherstone (2004) and Shah & Saha (2013), printed against computed; all, or those named.
#[pyfunction]
#[pyo3(signature = (*ids, quick=false))]
pub fn reproduce<'py>(py: Python<'py>, ids: Vec<String>, quick: bool) -> Result<Bound<'py, PyAny>, Failure> {
    let names: Vec<&str> = ids.iter().map(String::as_str).collect();
    let experiments = select(&names).map_err(|error| Failure::input("ids", error))?;
    let lab = Lab { quick, ..Lab::default() };
    let mut readings = Vec::new();
    for experiment in experiments {
        readings.extend(in_parallel(py, |_| Ok(experiment.run(&lab)?))?.readings);
    }
    let json = claims_json(readings.iter()).map_err(|error| Failure::input("ids", error))?;
    Ok(py.import("json")?.call_method1("loads", (json,))?)
}

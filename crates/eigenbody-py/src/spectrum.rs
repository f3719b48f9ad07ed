//! Eigenvalues, their ends, and κ with all that belongs to it.

use crate::array::{Out, Rows, room};
use crate::compute::{Progress, compute, go_on};
use crate::error::Failure;
use crate::given::At;
use crate::model::{Model, Shared};
use eigenbody::batch::{Batch, BatchError};
use eigenbody::spectrum::Precision;
use eigenbody::{Method, Question, conditioning_at};
use eigenbody_report::{SpectrumReport, Subject};
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use rayon::prelude::*;

/// What is asked besides q.
pub struct Asked<'a> {
    pub metric: &'a str,
    pub method: &'a str,
    pub precision: &'a str,
    pub all: bool,
}

impl Asked<'_> {
    fn question(&self, shared: &Shared) -> Result<Question, Failure> {
        let method = match self.method {
            "auto" => Method::Auto,
            "dense" => Method::Dense,
            "sturm" => Method::Sturm,
            other => {
                return Err(Failure::input(
                    "method",
                    format!("'{other}', expected 'auto', 'dense' or 'sturm'"),
                ));
            }
        };
        let precision = match self.precision {
            "auto" => Precision::Auto,
            "f64" => Precision::F64,
            "dd" => Precision::Dd,
            other => {
                return Err(Failure::input(
                    "precision",
                    format!("'{other}', expected 'auto', 'f64' or 'dd'"),
                ));
            }
        };
        let metric = eigenbody_formats::metric(self.metric)?;
        Ok(Question { metric, reduction: shared.robot.reduction, method, precision, all: self.all })
    }
}

/// Robots of so many degrees of freedom have the answer to one row before another thread could take it up.
const QUICK: usize = 64;
/// Entries of H in as many rows as are computed side by side before Ctrl-C is looked for.
const AT_ONCE: usize = 1 << 22;
/// Rows are computed side by side in multiples of this.
const GROUP: usize = 512;

/// Applies the question to every row.
fn answers(
    shared: &Shared,
    rows: &Rows<'_, f64>,
    question: &Question,
    py: Python<'_>,
) -> Result<Vec<eigenbody::Conditioning<f64>>, Failure> {
    let numbers = rows.numbers()?;
    let numbers: &[f64] = numbers.as_ref();
    let robot = &shared.robot;
    let width = rows.width();
    let count = rows.count().unwrap_or(1);
    let is_batch = rows.count().is_some();
    let mut answers = room(count)?;
    compute(py, !is_batch && robot.model.nv() <= QUICK, |progress| {
        let answer = |k: usize| -> Result<_, Failure> {
            go_on(progress)?;
            let q = robot.expand(&numbers[k * width..(k + 1) * width]);
            conditioning_at(&robot.model, &q, question)
                .map_err(|source| Failure::Numbers { row: is_batch.then_some(k), source })
        };
        match is_batch {
            // Only as many as are computed at a time are not where they belong.
            true => (0..count).step_by(GROUP).try_for_each(|first| {
                let rows = first..count.min(first + GROUP);
                let found: Vec<_> = rows.into_par_iter().map(&answer).collect::<Result<_, Failure>>()?;
                answers.extend(found);
                Ok(())
            }),
            false => {
                answers.push(answer(0)?);
                Ok(())
            }
        }
    })?;
    Ok(answers)
}

/// All eigenvalues, ascending: `(n,)` or `(k, n)`.
pub fn eigenvalues<'py>(
    model: &Model,
    q: &Bound<'py, PyAny>,
    metric: &str,
    out: Option<&Bound<'py, PyAny>>,
) -> Result<Bound<'py, PyAny>, Failure> {
    let shared = &model.shared;
    let asked = Asked { metric, method: "auto", precision: "auto", all: true };
    let question = asked.question(shared)?;
    table(shared, q, &question, &[shared.dofs.len()], out, |answer, row| match &answer.eigenvalues {
        Some(values) if values.len() == row.len() => row.copy_from_slice(values),
        _ => row.fill(f64::NAN),
    })
}

/// λmin and λmax: `(2,)` or `(k, 2)`; NaN where λmin is not resolved.
pub fn extremes<'py>(
    model: &Model,
    q: &Bound<'py, PyAny>,
    metric: &str,
    accuracy: f64,
    out: Option<&Bound<'py, PyAny>>,
) -> Result<Bound<'py, PyAny>, Failure> {
    let shared = &model.shared;
    let asked = Asked { metric, method: "auto", precision: "auto", all: false };
    let question = asked.question(shared)?;
    let rows = Rows::<f64>::new("q", q, shared.nq)?;
    match in_lanes(shared, &rows, accuracy)? {
        Some(count) => {
            let numbers = rows.numbers()?;
            Out::new(q.py(), &[count, 2], out)?.fill(false, |out, progress| {
                side_by_side(shared, &numbers, &question, accuracy, progress, |k, ends| {
                    out[2 * k..2 * k + 2].copy_from_slice(&ends);
                })
            })
        }
        None => table(shared, q, &question, &[2], out, |answer, row| {
            row[0] = answer.lambda_min.unwrap_or(f64::NAN);
            row[1] = answer.lambda_max.unwrap_or(f64::NAN);
        }),
    }
}

/// κ: a number or `(k,)`; NaN where λmin is not resolved.
pub fn kappa<'py>(
    model: &Model,
    q: &Bound<'py, PyAny>,
    metric: &str,
    accuracy: f64,
    out: Option<&Bound<'py, PyAny>>,
) -> Result<Bound<'py, PyAny>, Failure> {
    let shared = &model.shared;
    let asked = Asked { metric, method: "auto", precision: "auto", all: false };
    let question = asked.question(shared)?;
    let rows = Rows::<f64>::new("q", q, shared.nq)?;
    match in_lanes(shared, &rows, accuracy)? {
        Some(count) => {
            let numbers = rows.numbers()?;
            Out::new(q.py(), &[count], out)?.fill(false, |out, progress| {
                side_by_side(shared, &numbers, &question, accuracy, progress, |k, [min, max]| {
                    out[k] = max / min;
                })
            })
        }
        None => {
            let found = table(shared, q, &question, &[], out, |answer, row| {
                row[0] = answer.kappa.unwrap_or(f64::NAN);
            })?;
            // One configuration has one number.
            if rows.count().is_none() && out.is_none() { Ok(found.call_method0("item")?) } else { Ok(found) }
        }
    }
}

/// The rows of a batch that is to be computed side by side: to so many digits, where H is that of all joints.
fn in_lanes(shared: &Shared, rows: &Rows<'_, f64>, accuracy: f64) -> Result<Option<usize>, Failure> {
    if !(0.0..1.0).contains(&accuracy) {
        return Err(Failure::input("accuracy", format!("{accuracy}, expected 0 or a part of 1")));
    }
    let fits = accuracy > 0.0
        && shared.nq > 0
        && shared.robot.is_plain()
        && shared.robot.model.check_dense().is_ok();
    Ok(rows.count().filter(|&count| fits && count > 0))
}

/// Gives λmin, NaN where it is not resolved, and λmax of every row to `keep`, with the row's number.
fn side_by_side(
    shared: &Shared,
    q: &[f64],
    question: &Question,
    accuracy: f64,
    progress: &Progress<'_>,
    mut keep: impl FnMut(usize, [f64; 2]),
) -> Result<(), Failure> {
    let model = &shared.robot.model;
    let batch = Batch::new(model);
    let rows = (AT_ONCE / model.nv().pow(2)).div_ceil(GROUP).max(1) * GROUP;
    let mut ends = vec![0.0; 2 * rows.min(q.len() / model.nq())];
    for (part, q) in q.chunks(rows * model.nq()).enumerate() {
        go_on(progress)?;
        let (first, ends) = (part * rows, &mut ends[..2 * q.len() / model.nq()]);
        batch.extremes(q, &question.metric, accuracy, ends).map_err(|error| match error {
            BatchError::Configuration { index, error } => {
                BatchError::Configuration { index: first + index, error }
            }
            shape @ BatchError::Shape(_) => shape,
        })?;
        for (k, ends) in ends.chunks_exact(2).enumerate() {
            keep(first + k, [if ends[0] == 0.0 { f64::NAN } else { ends[0] }, ends[1]]);
        }
    }
    Ok(())
}

fn table<'py>(
    shared: &Shared,
    q: &Bound<'py, PyAny>,
    question: &Question,
    shape: &[usize],
    out: Option<&Bound<'py, PyAny>>,
    write: impl Fn(&eigenbody::Conditioning<f64>, &mut [f64]) + Send + Sync,
) -> Result<Bound<'py, PyAny>, Failure> {
    let py = q.py();
    let rows = Rows::<f64>::new("q", q, shared.nq)?;
    let width: usize = shape.iter().product();
    let full: Vec<usize> = rows.count().iter().chain(shape).copied().collect();
    let out = Out::new(py, &full, out)?;
    let answers = answers(shared, &rows, question, py)?;
    out.fill(true, |out, _| {
        if width > 0 {
            out.chunks_mut(width).zip(&answers).for_each(|(row, answer)| write(answer, row));
        }
        Ok(())
    })
}

/// κ and what belongs to it: one `Conditioning`, or `Conditionings` of a batch.
pub fn conditioning<'py>(
    model: &Model,
    py: Python<'py>,
    q: &At<'py>,
    asked: &Asked<'_>,
) -> Result<Bound<'py, PyAny>, Failure> {
    let shared = &model.shared;
    let question = asked.question(shared)?;
    let (text, q) = match q {
        At::Text(text) => (text.clone(), model.configuration(py, text)?.into_any()),
        At::Numbers(q) => ("q".into(), q.clone()),
    };
    let rows = Rows::<f64>::new("q", &q, shared.nq)?;
    let answers = answers(shared, &rows, &question, py)?;
    let results = py.import("eigenbody._results")?;
    if rows.count().is_some() {
        return Ok(results.getattr("Conditionings")?.call1((columns(py, &answers, asked.all)?,))?);
    }
    let translations: Vec<bool> = {
        let model = &shared.robot.model;
        question.reduction.dofs(model).into_iter().map(|d| model.is_translation(d)).collect()
    };
    let base = match (shared.robot.model.has_floating_base(), question.reduction.base) {
        (false, _) => "fixed",
        (true, false) => "floating",
        (true, true) => "free-floating",
    };
    let subject = Subject {
        model: shared.name.clone(),
        bodies: shared.robot.model.bodies().len(),
        base: base.into(),
        configuration: text,
        q: rows.numbers()?.into_owned(),
    };
    let unit = question.metric.unit(translations.into_iter());
    let report = SpectrumReport::new(subject, &question.metric, unit, &answers[0], shared.dofs.clone());
    let report = SpectrumReport { findings: shared.findings.clone(), ..report };
    let json = report.to_json().map_err(|error| Failure::input("q", error))?;
    Ok(results.getattr("Conditioning")?.call_method1("_of_json", (json,))?)
}

/// One array a quantity, NaN where it does not exist.
fn columns<'py>(
    py: Python<'py>,
    answers: &[eigenbody::Conditioning<f64>],
    all: bool,
) -> Result<Bound<'py, PyDict>, Failure> {
    type Pick = fn(&eigenbody::Conditioning<f64>) -> Option<f64>;
    let picks: [(&str, Pick); 9] = [
        ("kappa", |a| a.kappa),
        ("kappa_weighted", |a| a.kappa_weighted),
        ("lambda_min", |a| a.lambda_min),
        ("lambda_max", |a| a.lambda_max),
        ("diagonal_ratio", |a| a.diagonal_ratio),
        ("bracket_low", |a| a.bracket.map(|ends| ends.0)),
        ("bracket_high", |a| a.bracket.map(|ends| ends.1)),
        ("error_of_min", |a| a.error_estimate[0]),
        ("error_of_max", |a| a.error_estimate[1]),
    ];
    let columns = PyDict::new(py);
    for (name, pick) in picks {
        let column: Vec<f64> = answers.iter().map(|answer| pick(answer).unwrap_or(f64::NAN)).collect();
        columns.set_item(name, PyArray1::from_vec(py, column))?;
    }
    type List = fn(&eigenbody::Conditioning<f64>) -> Option<&Vec<f64>>;
    let lists: [(&str, List); 3] = [
        ("softest", |a| a.softest.as_ref()),
        ("stiffest", |a| a.stiffest.as_ref()),
        ("eigenvalues", |a| a.eigenvalues.as_ref()),
    ];
    let n = answers.first().map_or(0, |answer| answer.weights.len());
    for (name, pick) in lists.into_iter().filter(|(name, _)| all || *name != "eigenvalues") {
        let rows = Out::<f64>::new(py, &[answers.len(), n], None)?.fill(true, |out, _| {
            for (row, answer) in out.chunks_exact_mut(n.max(1)).zip(answers) {
                match pick(answer).filter(|list| list.len() == n) {
                    Some(list) => row.copy_from_slice(list),
                    None => row.fill(f64::NAN),
                }
            }
            Ok(())
        })?;
        columns.set_item(name, rows)?;
    }
    Ok(columns)
}

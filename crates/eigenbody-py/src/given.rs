//! What a caller may give as a text, a number, names or an array: configurations, velocities, gains, tables over time.

use crate::array::Rows;
use crate::error::Failure;
use crate::model::Shared;
use eigenbody::InputError;
use eigenbody_formats::motion::Wanted;
use eigenbody_formats::{gains, velocity};
use eigenbody_study::simulate::Trajectory;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyMapping};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// A configuration or a velocity: a text, or numbers.
#[derive(FromPyObject)]
pub enum At<'py> {
    Text(String),
    Numbers(Bound<'py, PyAny>),
}

impl Default for At<'_> {
    fn default() -> Self {
        Self::Text("zero".into())
    }
}

/// Stiffness or damping: a number for all joints, a text as the command line takes it, numbers by joint, or one a degree of freedom.
#[derive(FromPyObject)]
pub enum Gains<'py> {
    Text(String),
    Named(BTreeMap<String, f64>),
    Numbers(Bound<'py, PyAny>),
}

/// Rows over time: a file, or times and rows.
#[derive(FromPyObject)]
pub enum Table<'py> {
    File(PathBuf),
    Numbers((Bound<'py, PyAny>, Bound<'py, PyAny>)),
}

/// One row of numbers, no batch.
fn one(what: &str, numbers: &Bound<'_, PyAny>, width: usize) -> Result<Vec<f64>, Failure> {
    let rows = Rows::<f64>::new(what, numbers, width)?;
    match rows.count() {
        None => Ok(rows.numbers()?.into_owned()),
        Some(_) => Err(Failure::input(what, format!("is a batch, expected shape ({width},)"))),
    }
}

impl At<'_> {
    /// All coordinates.
    pub fn configuration(&self, what: &str, shared: &Shared) -> Result<Vec<f64>, Failure> {
        let model = &shared.robot.model;
        let q = match self {
            Self::Text(text) => shared.configuration(text)?,
            Self::Numbers(numbers) => shared.robot.expand(&one(what, numbers, shared.nq)?).into_owned(),
        };
        model.check_q(&q)?;
        Ok(q)
    }

    /// Velocities of all degrees of freedom; those of mimic joints follow.
    pub fn velocity(&self, what: &str, shared: &Shared) -> Result<Vec<f64>, Failure> {
        let (model, map) = (&shared.robot.model, shared.robot.coupling());
        let v = match self {
            Self::Text(text) => {
                let v = velocity(text, model)?;
                map.map_or(v.clone(), |map| map.follow(&v))
            }
            Self::Numbers(numbers) => {
                let v = one(what, numbers, shared.nv)?;
                map.map_or(v.clone(), |map| map.push_forward(&v))
            }
        };
        model.check_v("v", &v)?;
        Ok(v)
    }
}

impl Gains<'_> {
    /// One for each degree of freedom, none where nothing is said.
    pub fn read(&self, what: &str, shared: &Shared) -> Result<Vec<Option<f64>>, Failure> {
        let model = &shared.robot.model;
        let base = model.base_dofs();
        let mut all = vec![None; model.nv()];
        match self {
            Self::Text(text) => return Ok(gains(text, model)?),
            Self::Named(named) => {
                for (name, gain) in named {
                    let joint = model.joints().iter().find(|joint| joint.name() == name);
                    let joint = joint
                        .ok_or_else(|| Failure::input(what, format!("no moving joint is named '{name}'")))?;
                    joint.dofs().for_each(|d| all[d] = Some(*gain));
                }
            }
            Self::Numbers(mapping) if mapping.hasattr("keys")? => {
                let named = PyDict::new(mapping.py());
                named.update(mapping.cast::<PyMapping>().map_err(PyErr::from)?)?;
                return Self::Named(named.extract()?).read(what, shared);
            }
            Self::Numbers(number) if number.len().is_err() => {
                let gain = number.extract().map_err(|_| {
                    Failure::Type(format!("{what} is no number, text, dict or array of numbers"))
                })?;
                all[base..].fill(Some(gain));
            }
            Self::Numbers(numbers) => {
                let given = one(what, numbers, shared.nv)?;
                let dofs = shared
                    .robot
                    .coupling()
                    .map_or((0..model.nv()).collect(), |map| map.independent_dofs().to_vec());
                dofs.into_iter().zip(given).for_each(|(d, gain)| all[d] = Some(gain));
            }
        }
        match all.iter().flatten().find(|gain| !(**gain >= 0.0 && gain.is_finite())) {
            None => Ok(all),
            Some(gain) => Err(Failure::input(what, format!("{gain}, expected no number below zero"))),
        }
    }
}

impl Table<'_> {
    /// All coordinates over time.
    pub fn configurations(&self, what: &str, shared: &Shared) -> Result<Trajectory, Failure> {
        let robot = &shared.robot;
        let (nq, all) = (robot.model.nq(), |row: &[f64]| robot.expand(row).into_owned());
        match self {
            Self::File(file) => from_file(file, shared, Wanted::Configurations),
            Self::Numbers((times, rows)) => numbers(what, times, rows, shared.nq, nq, all),
        }
    }

    /// Forces on all degrees of freedom over time.
    pub fn forces(&self, what: &str, shared: &Shared) -> Result<Trajectory, Failure> {
        let model = &shared.robot.model;
        let nv = model.nv();
        let all = |row: &[f64]| match shared.robot.coupling() {
            None => row.to_vec(),
            Some(map) => {
                let mut tau = vec![0.0; nv];
                map.independent_dofs().iter().zip(row).for_each(|(&d, x)| tau[d] = *x);
                tau
            }
        };
        match self {
            Self::File(file) => from_file(file, shared, Wanted::Forces),
            Self::Numbers((times, rows)) => numbers(what, times, rows, shared.nv, nv, all),
        }
    }
}

fn from_file(file: &Path, shared: &Shared, wanted: Wanted) -> Result<Trajectory, Failure> {
    let robot = &shared.robot;
    Trajectory::read(file, &robot.model, robot.reduction.mimic, wanted).map_err(|error| Failure::Input {
        message: error.to_string(),
        what: Some(file.display().to_string()),
    })
}

fn numbers(
    what: &str,
    times: &Bound<'_, PyAny>,
    rows: &Bound<'_, PyAny>,
    given: usize,
    width: usize,
    all: impl Fn(&[f64]) -> Vec<f64>,
) -> Result<Trajectory, Failure> {
    let rows = Rows::<f64>::new(what, rows, given)?;
    let count = rows.count().ok_or_else(|| Failure::input(what, "has one row, expected shape (k, ..)"))?;
    let times = one(&format!("times of {what}"), times, count)?;
    if let Some(index) = times.iter().position(|t| !t.is_finite()) {
        return Err(InputError::NotFinite { what: "times", index }.into());
    }
    let numbers = rows.numbers()?;
    let rows = (0..count).map(|k| all(&numbers[k * given..(k + 1) * given])).collect();
    Trajectory::new(times, rows, width).map_err(|error| Failure::input(what, error))
}

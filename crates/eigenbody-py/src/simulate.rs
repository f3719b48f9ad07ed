//! `Model.simulate`: motions with monitors, the numbers of `eigenbody simulate`.

use crate::compute::in_parallel;
use crate::error::Failure;
use crate::given::{At, Gains, Table};
use crate::model::{Model, Shared};
use eigenbody::spatial::Vec3;
use eigenbody_study::monitor::{Monitors, Quantity};
use eigenbody_study::simulate::{
    Algorithm, Controller, DORMAND_PRINCE, Forces, Method, RK4, Report, Simulation, SimulationError, Steps,
    Trajectory, Watch, joint_limits, level, passive_springs,
};
use eigenbody_study::{Cell, Shape};
use numpy::{PyArray1, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::cell::Cell as Kept;
use std::ops::ControlFlow;

/// Numbers that a motion may have in memory.
const MOST: f64 = 1e9;

/// What is asked for, by its names in Python.
pub struct Asked<'py> {
    pub time: f64,
    pub rate: f64,
    pub q: Option<At<'py>>,
    pub v: Option<At<'py>>,
    pub method: String,
    pub step: f64,
    pub tolerance: f64,
    pub dynamics: String,
    pub gravity: bool,
    pub springs: bool,
    pub damping: Option<Gains<'py>>,
    pub stiffness: Option<Gains<'py>>,
    pub rest: Option<At<'py>>,
    pub hold: Option<At<'py>>,
    pub follow: Option<Table<'py>>,
    pub bandwidth: f64,
    pub damping_ratio: f64,
    pub kp: Option<Gains<'py>>,
    pub kd: Option<Gains<'py>>,
    pub torque: Option<Table<'py>>,
    pub monitors: Vec<String>,
    pub events: Vec<String>,
}

fn positive(what: &str, x: f64) -> Result<f64, Failure> {
    match x > 0.0 && x.is_finite() {
        true => Ok(x),
        false => Err(Failure::input(what, format!("{x}, expected a positive number"))),
    }
}

fn one_of<T: Copy>(what: &str, name: &str, known: &[(&str, T)]) -> Result<T, Failure> {
    known.iter().find(|(known, _)| *known == name).map(|(_, value)| *value).ok_or_else(|| {
        let names: Vec<&str> = known.iter().map(|(name, _)| *name).collect();
        Failure::input(what, format!("'{name}', expected one of {}", names.join(", ")))
    })
}

impl Asked<'_> {
    fn method(&self) -> Result<(Method, Steps), Failure> {
        let known = [
            ("euler", Method::SemiImplicitEuler),
            ("rk4", Method::RungeKutta(RK4)),
            ("dopri5", Method::RungeKutta(DORMAND_PRINCE)),
            ("midpoint", Method::ImplicitMidpoint),
        ];
        let method = one_of("method", &self.method, &known)?;
        let steps = match method == Method::RungeKutta(DORMAND_PRINCE) {
            true => Steps::Adaptive(positive("tolerance", self.tolerance)?),
            false => Steps::Fixed(positive("step", self.step)?),
        };
        Ok((method, steps))
    }

    fn quantities(&self) -> Result<Vec<Quantity>, Failure> {
        let known: Vec<(&str, Quantity)> =
            Quantity::ALL.iter().map(|&quantity| (quantity.about().name, quantity)).collect();
        let mut found = Vec::new();
        for name in &self.monitors {
            let quantity = one_of("monitors", name, &known)?;
            if !found.contains(&quantity) {
                found.push(quantity);
            }
        }
        Ok(found)
    }

    fn forces(&self, shared: &Shared) -> Result<Forces, Failure> {
        let model = &shared.robot.model;
        let own = if self.springs { &shared.drive.springs[..] } else { &[] };
        let read = |what: &str, gains: &Option<Gains<'_>>| match gains {
            Some(gains) => gains.read(what, shared),
            None => Ok(Vec::new()),
        };
        let (damping, stiffness) = (read("damping", &self.damping)?, read("stiffness", &self.stiffness)?);
        let springs = passive_springs(model, own, &damping, &stiffness);
        let rest = match &self.rest {
            Some(rest) => rest.configuration("rest", shared)?,
            None => At::default().configuration("rest", shared)?,
        };
        let target = match (&self.hold, &self.follow) {
            (Some(_), Some(_)) => return Err(Failure::input("hold", "a controller holds or follows")),
            (Some(posture), None) => Some(Trajectory::constant(posture.configuration("hold", shared)?)),
            (None, Some(table)) => Some(table.configurations("follow", shared)?),
            (None, None) => None,
        };
        let tuned = (positive("bandwidth", self.bandwidth)?, positive("damping_ratio", self.damping_ratio)?);
        let controller = match target {
            None if self.kp.is_some() || self.kd.is_some() => {
                return Err(Failure::input("kp", "gains of a controller: say what to hold or to follow"));
            }
            None => None,
            Some(target) => {
                let mut controller = Controller::tuned(model, target, tuned.0, tuned.1)?;
                let replace = |own: &mut [f64], given: Vec<Option<f64>>| {
                    own.iter_mut().zip(given).for_each(|(own, given)| *own = given.unwrap_or(*own));
                };
                replace(&mut controller.kp, read("kp", &self.kp)?);
                replace(&mut controller.kd, read("kd", &self.kd)?);
                Some(controller)
            }
        };
        let torque = self.torque.as_ref().map(|table| table.forces("torque", shared)).transpose()?;
        Ok(Forces { springs, rest, controller, torque })
    }
}

/// Rows as they are collected.
#[derive(Default)]
struct Rows {
    t: Vec<f64>,
    pub q: Vec<f64>,
    pub v: Vec<f64>,
    cells: Vec<Vec<Cell>>,
    pub events: Vec<(f64, String)>,
}

/// A motion as `eigenbody._results.Motion`.
pub fn simulate<'py>(
    model: &Model,
    py: Python<'py>,
    asked: &Asked<'py>,
) -> Result<Bound<'py, PyAny>, Failure> {
    let shared = &model.shared;
    let reduction = shared.robot.reduction;
    let own = shared.robot.model.clone();
    let moving = if asked.gravity { own } else { own.with_gravity(Vec3::ZERO)? };
    let start = |at: &Option<At<'_>>| match at {
        Some(at) => at.configuration("q", shared),
        None => At::default().configuration("q", shared),
    };
    let q = start(&asked.q)?;
    let v = match &asked.v {
        Some(v) => v.velocity("v", shared)?,
        None => At::default().velocity("v", shared)?,
    };
    let forces = asked.forces(shared)?;
    let (method, steps) = asked.method()?;
    let algorithms = [("aba", Algorithm::Aba), ("crba", Algorithm::CrbaLtl)];
    let algorithm = one_of("dynamics", &asked.dynamics, &algorithms)?.of(&moving, reduction);
    let (time, rate) = (positive("time", asked.time)?, positive("rate", asked.rate)?);
    let intervals = (time * rate).round().max(1.0);
    let quantities = asked.quantities()?;
    let mut monitors = Monitors::new(&moving, reduction, &quantities)?;
    let width = 1 + shared.nq + shared.nv + shared.dofs.len() * quantities.len();
    if intervals * width as f64 > MOST {
        let problem = format!("{intervals} rows of up to {width} numbers: more than memory should hold");
        return Err(Failure::input("rate", problem));
    }
    let mut simulation =
        Simulation::new(&moving, &q, &v, method, steps, forces, algorithm).map_err(refused)?;
    let crossing = |text: &String| {
        level(text, &moving, reduction, &q)
            .map_err(|error| Failure::input("events", format!("{text}: {error}")))
    };

    let mut rows = Rows::default();
    let events = &asked.events;
    let outcome = in_parallel(py, |progress| {
        // Ctrl-C is an event like any other: it is looked for at every step.
        let interrupted = Kept::new(false);
        let mut watches = joint_limits(&moving);
        for text in events {
            watches.push(crossing(text)?);
        }
        watches.push(Watch::new("interrupted", "", "interrupted", |_| {
            interrupted.set(progress(0).is_break());
            if interrupted.get() { 1.0 } else { -1.0 }
        }));
        let mut failure = None;
        let outcome = simulation.run(time, intervals as usize, &mut watches, &mut |report| {
            match report {
                Report::Event(_) if interrupted.get() => return ControlFlow::Break(()),
                Report::Event(event) => rows.events.push((event.t, event.what)),
                Report::Step => {}
                Report::Sample(state) => match monitors.observe(state) {
                    Ok(cells) => {
                        rows.t.push(state.t);
                        rows.q.extend(shared.given(&state.q));
                        rows.v.extend(shared.given_rates(&state.v));
                        rows.cells.push(cells);
                    }
                    Err(error) => {
                        failure = Some(Failure::from(error));
                        return ControlFlow::Break(());
                    }
                },
            }
            ControlFlow::Continue(())
        });
        drop(watches);
        failure.map_or(Ok(outcome), Err)
    })?;
    let note = match outcome {
        Ok(_) => None,
        Err(error) if error.is_along_the_way() => Some(error.to_string()),
        Err(error) => return Err(refused(error)),
    };

    let details = PyDict::new(py);
    let table =
        |numbers: Vec<f64>, width: usize| PyArray1::from_vec(py, numbers).reshape([rows.t.len(), width]);
    details.set_item("name", &shared.name)?;
    details.set_item("q", table(rows.q, shared.nq)?)?;
    details.set_item("v", table(rows.v, shared.nv)?)?;
    let (columns, units) = (PyDict::new(py), PyDict::new(py));
    for (k, field) in monitors.fields().iter().enumerate() {
        units.set_item(&field.name, &field.unit)?;
        columns.set_item(&field.name, column(py, &rows.cells, k, field.shape)?)?;
    }
    details.set_item("monitors", columns)?;
    details.set_item("units", units)?;
    details.set_item("events", rows.events)?;
    details.set_item("method", method.name())?;
    let effort = simulation.effort();
    details.set_item("steps", effort.steps)?;
    details.set_item("refused", effort.refused)?;
    details.set_item("evaluations", effort.evaluations)?;
    details.set_item("note", note)?;
    details.set_item("t", PyArray1::from_vec(py, rows.t))?;
    Ok(py.import("eigenbody._results")?.getattr("Motion")?.call((), Some(&details))?)
}

fn refused(error: SimulationError) -> Failure {
    match error {
        SimulationError::Input(source) => source.into(),
        error => Failure::Input { message: error.to_string(), what: None },
    }
}

/// What a monitor gave, row by row: NaN where there is nothing.
fn column<'py>(
    py: Python<'py>,
    rows: &[Vec<Cell>],
    k: usize,
    shape: Shape,
) -> Result<Bound<'py, PyAny>, Failure> {
    if shape == Shape::List {
        let list = |row: &Vec<Cell>| match &row[k] {
            Cell::List(numbers) => numbers.clone(),
            _ => Vec::new(),
        };
        let lists: Vec<Vec<f64>> = rows.iter().map(list).collect();
        let width = lists.iter().map(Vec::len).max().unwrap_or(0);
        let mut numbers = vec![f64::NAN; lists.len() * width];
        if width > 0 {
            numbers
                .chunks_mut(width)
                .zip(&lists)
                .for_each(|(row, list)| row[..list.len()].copy_from_slice(list));
        }
        return Ok(PyArray1::from_vec(py, numbers).reshape([lists.len(), width])?.into_any());
    }
    let number = |row: &Vec<Cell>| match row[k] {
        Cell::Number(Some(x)) => x,
        _ => f64::NAN,
    };
    Ok(PyArray1::from_vec(py, rows.iter().map(number).collect()).into_any())
}

//! `eigenbody.Tracker`: both ends of the spectrum along a motion.

use crate::array::Rows;
use crate::error::Failure;
use crate::model::{Model, Shared};
use eigenbody::InputError;
use numpy::{PyArray1, PyArray2};
use pyo3::prelude::*;
use self_cell::self_cell;
use std::sync::{Arc, Mutex, PoisonError};

type Inner<'m> = eigenbody::spectrum::Tracker<'m>;

self_cell!(
    struct Cell {
        owner: Arc<Shared>,
        #[not_covariant]
        dependent: Inner,
    }
);

/// λmin and λmax along a motion, exact, at about one factorisation a step. Starts at q.
#[pyclass(module = "eigenbody", frozen)]
pub struct Tracker {
    cell: Mutex<Cell>,
    shared: Arc<Shared>,
}

impl Tracker {
    fn with<R>(&self, work: impl FnOnce(&mut Inner<'_>) -> R) -> R {
        let mut cell = self.cell.lock().unwrap_or_else(PoisonError::into_inner);
        cell.with_dependent_mut(|_, tracker| work(tracker))
    }
}

#[pymethods]
impl Tracker {
    #[new]
    #[pyo3(signature = (model, q, /, *, metric="euclidean"))]
    fn new(model: &Bound<'_, Model>, q: &Bound<'_, PyAny>, metric: &str) -> Result<Self, Failure> {
        let shared = Arc::clone(&model.get().shared);
        let reduction = shared.robot.reduction;
        if reduction.mimic && shared.robot.model.coupling().is_some() {
            return Err(InputError::NotATree.into());
        }
        let metric = eigenbody_formats::metric(metric)?;
        let rows = Rows::<f64>::new("q", q, shared.nq)?;
        let numbers = rows.numbers()?;
        let start = &numbers[..shared.nq.min(numbers.len())];
        let cell = Cell::try_new(Arc::clone(&shared), |shared| {
            Inner::new(&shared.robot.model, start, &metric, reduction.base)
        })?;
        Ok(Self { cell: Mutex::new(cell), shared })
    }

    /// λmin and λmax at the next q, (2,), or at each row of a batch in turn, (k, 2).
    #[pyo3(signature = (q, /))]
    fn update<'py>(&self, py: Python<'py>, q: &Bound<'py, PyAny>) -> Result<Bound<'py, PyAny>, Failure> {
        let rows = Rows::<f64>::new("q", q, self.shared.nq)?;
        let numbers = rows.numbers()?;
        let (numbers, width) = (numbers.as_ref(), rows.width());
        let is_batch = rows.count().is_some();
        let count = rows.count().unwrap_or(1);
        let values = py.detach(|| {
            self.with(|tracker| {
                let mut values = Vec::with_capacity(count);
                for k in 0..count {
                    let [min, max] =
                        tracker.update(&numbers[k * width..(k + 1) * width]).map_err(|source| {
                            Failure::Numbers { row: is_batch.then_some(k), source: source.into() }
                        })?;
                    values.push(vec![min.value, max.value]);
                }
                Ok::<_, Failure>(values)
            })
        })?;
        if !is_batch {
            return Ok(PyArray1::from_vec(py, values.concat()).into_any());
        }
        if values.is_empty() {
            return Ok(PyArray2::<f64>::zeros(py, [0, 2], false).into_any());
        }
        let array = PyArray2::from_vec2(py, &values).map_err(|error| Failure::input("q", error))?;
        Ok(array.into_any())
    }

    /// The latest mode of λmin, (nv,).
    #[getter]
    fn softest<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        let mode: Vec<f64> = self.with(|tracker| tracker.mode(0).collect());
        PyArray1::from_vec(py, mode)
    }

    /// The latest mode of λmax, (nv,).
    #[getter]
    fn stiffest<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        let mode: Vec<f64> = self.with(|tracker| tracker.mode(1).collect());
        PyArray1::from_vec(py, mode)
    }
}

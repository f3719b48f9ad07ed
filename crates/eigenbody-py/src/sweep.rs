//! `eigenbody._eigenbody.SweepPlan`: what an executor needs of a sweep.

use crate::compute::in_parallel;
use crate::error::Failure;
use eigenbody_report::{PlanRecord, SweepFolder, chunk_text};
use eigenbody_study::sweep::{Plan, Spec};
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use std::path::PathBuf;

/// The numbered cases of a sweep's text, in chunks.
#[pyclass(module = "eigenbody", frozen)]
pub struct SweepPlan {
    plan: Plan,
}

impl SweepPlan {
    fn folder(&self, path: &std::path::Path) -> Result<SweepFolder, Failure> {
        let record = PlanRecord::new(&self.plan, env!("CARGO_PKG_VERSION"));
        SweepFolder::open(path, record).map_err(|error| Failure::input("output", error))
    }
}

#[pymethods]
impl SweepPlan {
    #[new]
    #[pyo3(signature = (text, /, folder=PathBuf::new()))]
    fn new(py: Python<'_>, text: &str, folder: PathBuf) -> Result<Self, Failure> {
        let spec = Spec::parse(text).map_err(|error| Failure::input("spec", error))?;
        let plan = py.detach(|| Plan::new(spec, &folder)).map_err(|error| Failure::input("spec", error))?;
        Ok(Self { plan })
    }

    #[getter]
    fn cases(&self) -> u64 {
        self.plan.cases()
    }

    #[getter]
    fn chunks(&self) -> u64 {
        self.plan.chunks()
    }

    #[getter]
    fn fingerprint(&self) -> String {
        self.plan.fingerprint(env!("CARGO_PKG_VERSION"))
    }

    /// The text of a chunk's file, computed on one thread.
    #[pyo3(signature = (number, /))]
    fn compute<'py>(&self, py: Python<'py>, number: u64) -> Result<Bound<'py, PyBytes>, Failure> {
        let text = in_parallel(py, |_| {
            let chunk = self.plan.compute(number).map_err(|error| Failure::input("spec", error))?;
            chunk_text(&self.plan, &chunk).map_err(|error| Failure::input("spec", error))
        })?;
        Ok(PyBytes::new(py, &text))
    }

    #[pyo3(signature = (output, /))]
    fn missing(&self, output: PathBuf) -> Result<Vec<u64>, Failure> {
        Ok(self.folder(&output)?.missing())
    }

    #[pyo3(signature = (output, number, text, /))]
    fn keep(&self, py: Python<'_>, output: PathBuf, number: u64, text: &[u8]) -> Result<(), Failure> {
        let folder = self.folder(&output)?;
        py.detach(|| folder.keep(number, text)).map_err(|error| Failure::input("output", error))
    }

    #[pyo3(signature = (output, /))]
    fn merge(&self, py: Python<'_>, output: PathBuf) -> Result<PathBuf, Failure> {
        let folder = self.folder(&output)?;
        py.detach(|| folder.merge(&self.plan)).map_err(|error| Failure::input("output", error))
    }
}

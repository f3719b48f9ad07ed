//! `eigenbody._eigenbody.SweepPlan`: what an executor needs of a sweep.

use crate::compute::in_parallel;
use crate::error::Failure;
use eigenbody_report::{PlanRecord, SweepFolder, chunk_text};
use eigenbody_study::sweep::{Plan, Spec};
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use std::path::PathBuf;

/// The numbered cases of a sweep's text (TOML), in chunks that may be computed anywhere and in any order.
///
/// Paths in the text are seen from `folder`, or from the current one.
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

    /// Number of rows.
    #[getter]
    fn cases(&self) -> u64 {
        self.plan.cases()
    }

    /// Number of chunks.
    #[getter]
    fn chunks(&self) -> u64 {
        self.plan.chunks()
    }

    /// Of everything that a row depends on: spec, robots, version.
    #[getter]
    fn fingerprint(&self) -> String {
        self.plan.fingerprint(env!("CARGO_PKG_VERSION"))
    }

    /// The rows of a chunk, on one thread.
    #[pyo3(signature = (number, /))]
    fn compute<'py>(&self, py: Python<'py>, number: u64) -> Result<Bound<'py, PyBytes>, Failure> {
        let text = in_parallel(py, |_| {
            let chunk = self.plan.compute(number).map_err(|error| Failure::input("spec", error))?;
            chunk_text(&self.plan, &chunk).map_err(|error| Failure::input("spec", error))
        })?;
        Ok(PyBytes::new(py, &text))
    }

    /// Chunks that a folder does not hold; makes the folder.
    #[pyo3(signature = (output, /))]
    fn missing(&self, output: PathBuf) -> Result<Vec<u64>, Failure> {
        Ok(self.folder(&output)?.missing())
    }

    /// Puts a chunk's rows into a folder, whole.
    #[pyo3(signature = (output, number, text, /))]
    fn keep(&self, py: Python<'_>, output: PathBuf, number: u64, text: &[u8]) -> Result<(), Failure> {
        let folder = self.folder(&output)?;
        py.detach(|| folder.keep(number, text)).map_err(|error| Failure::input("output", error))
    }

    /// Makes the table of a folder that holds every chunk.
    #[pyo3(signature = (output, /))]
    fn merge(&self, py: Python<'_>, output: PathBuf) -> Result<PathBuf, Failure> {
        let folder = self.folder(&output)?;
        py.detach(|| folder.merge(&self.plan)).map_err(|error| Failure::input("output", error))
    }
}

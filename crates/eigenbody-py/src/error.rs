//! Failures as the exceptions of `eigenbody._errors`, with what a program wants to know about them.

use eigenbody::batch::BatchError;
use eigenbody::{Error, InputError};
use eigenbody_formats::FormatError;
use eigenbody_study::StudyError;
use pyo3::exceptions::{PyMemoryError, PyTypeError};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// What went wrong.
pub enum Failure {
    /// An array or an argument of the wrong shape or value.
    Input { message: String, what: Option<String> },
    /// An array or argument of the wrong type.
    Type(String),
    /// Numbers, in a row of a batch.
    Numbers { row: Option<usize>, source: Error },
    /// A file or an expression.
    Format(Box<FormatError>),
    /// A model given part by part.
    Build(eigenbody::BuildError),
    /// A study.
    Study(StudyError),
    /// So many bytes were not to be had.
    Memory(usize),
    /// Raised by Python itself.
    Python(PyErr),
}

impl Failure {
    pub fn input(what: impl Into<String>, message: impl std::fmt::Display) -> Self {
        let what = what.into();
        Self::Input { message: format!("{what}: {message}"), what: Some(what) }
    }
}

impl From<Error> for Failure {
    fn from(source: Error) -> Self {
        Self::Numbers { row: None, source }
    }
}

impl From<InputError> for Failure {
    fn from(source: InputError) -> Self {
        Self::Numbers { row: None, source: source.into() }
    }
}

impl From<BatchError> for Failure {
    fn from(source: BatchError) -> Self {
        match source {
            BatchError::Shape(source) => source.into(),
            BatchError::Configuration { index, error } => Self::Numbers { row: Some(index), source: error },
        }
    }
}

impl From<FormatError> for Failure {
    fn from(source: FormatError) -> Self {
        Self::Format(Box::new(source))
    }
}

impl From<StudyError> for Failure {
    fn from(source: StudyError) -> Self {
        match source {
            StudyError::Numbers(source) => Self::Numbers { row: None, source },
            source => Self::Study(source),
        }
    }
}

impl From<PyErr> for Failure {
    fn from(source: PyErr) -> Self {
        Self::Python(source)
    }
}

impl From<Failure> for PyErr {
    fn from(failure: Failure) -> Self {
        Python::attach(|py| raise(py, failure).unwrap_or_else(|error| error))
    }
}

fn raise(py: Python<'_>, failure: Failure) -> PyResult<PyErr> {
    let details = PyDict::new(py);
    let (class, message) = match failure {
        Failure::Python(error) => return Ok(error),
        Failure::Memory(size) => {
            return Ok(PyMemoryError::new_err(format!("unable to allocate {size} bytes")));
        }
        Failure::Type(message) => return Ok(PyTypeError::new_err(message)),
        Failure::Input { message, what } => {
            details.set_item("what", what)?;
            ("InputError", message)
        }
        Failure::Study(error) => ("InputError", error.to_string()),
        Failure::Build(error) => {
            details.set_item("joint", quoted(&error.to_string(), "joint '"))?;
            details.set_item("link", quoted(&error.to_string(), "link '"))?;
            ("ModelError", error.to_string())
        }
        Failure::Format(error) => {
            let message = error.to_string();
            if let Some((file, at, problem)) = error.place() {
                details.set_item("file", file)?;
                details.set_item("line", at.line)?;
                details.set_item("column", at.column)?;
                details.set_item("joint", quoted(&problem, "joint '"))?;
                details.set_item("link", quoted(&problem, "link '"))?;
            }
            ("ModelError", message)
        }
        Failure::Numbers { row, source } => {
            let before = row.map(|row| format!("row {row}: ")).unwrap_or_default();
            details.set_item("row", row)?;
            let class = match &source {
                Error::Input(error) => {
                    match error {
                        InputError::Length { what, .. }
                        | InputError::OtherModel { what }
                        | InputError::Overflow { what } => {
                            details.set_item("what", what)?;
                        }
                        InputError::NotFinite { what, index }
                        | InputError::NotPositive { what, index, .. }
                        | InputError::Negative { what, index, .. } => {
                            details.set_item("what", what)?;
                            details.set_item("index", index)?;
                        }
                        InputError::NotUnitQuaternion { joint, index, .. } => {
                            details.set_item("what", "q")?;
                            details.set_item("joint", joint)?;
                            details.set_item("index", index)?;
                        }
                        _ => {}
                    }
                    "InputError"
                }
                Error::NotPositiveDefinite(fault) => {
                    details.set_item("dof", fault.dof)?;
                    details.set_item("pivot", fault.pivot)?;
                    "NotPositiveDefiniteError"
                }
                _ => "EigenbodyError",
            };
            (class, format!("{before}{source}"))
        }
    };
    let class = py.import("eigenbody._errors")?.getattr(class)?;
    Ok(PyErr::from_value(class.call((message,), Some(&details))?))
}

/// What stands in quotes after some words.
fn quoted<'a>(text: &'a str, before: &str) -> Option<&'a str> {
    Some(text.split_once(before)?.1.split_once('\'')?.0)
}

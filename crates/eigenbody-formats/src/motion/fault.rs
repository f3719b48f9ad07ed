//! What can be wrong with a log.

use crate::error::{FileFault, OneLine, counted};
use thiserror::Error;

/// A log that cannot be followed. The message is one line.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum MotionError {
    /// The file cannot be read.
    #[error("{}: {}", OneLine(file), OneLine(fault))]
    File {
        /// The file, as it was given.
        file: String,
        /// What is wrong with it.
        fault: FileFault,
    },
    /// The columns do not fit the robot.
    #[error("{}{}: {}", OneLine(file), line.map_or_else(String::new, |line| format!(":{line}")), OneLine(problem))]
    Heading {
        /// The file.
        file: String,
        /// Line of a CSV file.
        line: Option<u64>,
        /// What does not fit.
        problem: String,
    },
    /// A bad row.
    #[error("{}:{place}: {}", OneLine(file), OneLine(fault))]
    Row {
        /// The file.
        file: String,
        /// Line of a CSV file, row of a Parquet file, both from 1.
        place: u64,
        /// What is wrong with it.
        fault: RowFault,
    },
}

/// What is wrong with a row.
#[derive(Debug, Clone, PartialEq, Error)]
#[allow(missing_docs)] // the messages say it all
pub enum RowFault {
    #[error("{}, expected {expected}", counted(*found, "column", "columns"))]
    Columns { found: usize, expected: usize },
    #[error("column '{column}': '{found}' is no finite number")]
    Number { column: String, found: String },
    #[error("column '{column}' is empty")]
    Empty { column: String },
    #[error("t = {t} s does not come after {last} s")]
    Time { t: f64, last: f64 },
    #[error("a gap: t = {t} s comes {step:.3} s after the row before, where steps took up to {usual:.3} s")]
    Gap { t: f64, step: f64, usual: f64 },
    #[error("{0}")]
    Configuration(String),
}

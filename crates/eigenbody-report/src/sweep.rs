//! A sweep's folder: what was planned, a file a chunk, and the table that they make.
//!
//! ```text
//! DIR/plan.json               fingerprint, seed, cases, chunks, version
//! DIR/chunks/000012.csv       whole or not there
//! DIR/sweep.parquet           all rows in the order of cases, once every chunk is there
//! ```
//! A chunk's file depends on the plan and its number alone, so that it does not matter who computed it, when, or how often.

use std::io;
use std::path::{Path, PathBuf};

use eigenbody_study::sweep::{Chunk, Plan};
use eigenbody_study::{Cell, Field};
use serde::{Deserialize, Serialize};
use thiserror::Error;

#[cfg(feature = "parquet")]
use crate::ParquetFailure;
use crate::file::{is_temporary, write_whole};
use crate::{RowsCsv, read_rows};

/// Why a folder does not do.
#[derive(Debug, Error)]
pub enum SweepFolderError {
    /// The system refuses.
    #[error("{}: {source}", path.display())]
    Io {
        /// Which file.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// The folder holds something else.
    #[error("{}: {what}", path.display())]
    Other {
        /// The folder or file.
        path: PathBuf,
        /// What it holds, and what was expected.
        what: String,
    },
}

/// What identifies a plan.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct PlanRecord {
    /// Of the spec, the robots and the version.
    pub fingerprint: String,
    /// Of everything random.
    pub seed: u64,
    /// Number of cases.
    pub cases: u64,
    /// Number of chunks.
    pub chunks: u64,
    /// The program's version.
    pub version: String,
}

impl PlanRecord {
    /// Of a plan.
    pub fn new(plan: &Plan, version: &str) -> Self {
        Self {
            fingerprint: plan.fingerprint(version),
            seed: plan.spec().seed,
            cases: plan.cases(),
            chunks: plan.chunks(),
            version: version.to_owned(),
        }
    }
}

/// A chunk as the text of its file.
///
/// # Errors
///
/// None that memory does not give.
pub fn chunk_text(plan: &Plan, chunk: &Chunk) -> io::Result<Vec<u8>> {
    let mut rows = RowsCsv::new(Vec::new(), &plan.fields())?;
    for row in &chunk.rows {
        rows.push(row)?;
    }
    rows.into_inner()
}

/// The folder of a sweep.
#[derive(Debug, Clone)]
pub struct SweepFolder {
    path: PathBuf,
    record: PlanRecord,
}

impl SweepFolder {
    /// Makes the folder, or takes up one of the same plan.
    ///
    /// # Errors
    ///
    /// [`SweepFolderError`], if it holds another sweep or something else, or cannot be written.
    pub fn open(path: &Path, record: PlanRecord) -> Result<Self, SweepFolderError> {
        let folder = Self { path: path.to_owned(), record };
        let chunks = folder.path.join("chunks");
        let plan = folder.path.join("plan.json");
        if path.exists() && !plan.exists() {
            let mut entries = std::fs::read_dir(path).map_err(|source| io_error(path, source))?;
            // A folder that was begun and not named yet may be taken up: only its own names are in it.
            if entries.any(|entry| {
                entry.is_ok_and(|entry| {
                    entry.file_name() != "chunks" && !is_temporary(&entry.file_name().to_string_lossy())
                })
            }) {
                return Err(other(path, "not empty, and no sweep's folder".into()));
            }
        }
        std::fs::create_dir_all(&chunks).map_err(|source| io_error(&chunks, source))?;
        if plan.exists() {
            let text = std::fs::read_to_string(&plan).map_err(|source| io_error(&plan, source))?;
            let found: PlanRecord = serde_json::from_str(&text)
                .map_err(|error| other(&plan, format!("no plan of a sweep: {error}")))?;
            if found != folder.record {
                let what = "holds another sweep: its spec, robots or version differ";
                return Err(other(path, what.into()));
            }
        } else {
            let text = serde_json::to_string_pretty(&folder.record).unwrap_or_default() + "\n";
            keep(&plan, text.as_bytes())?;
        }
        Ok(folder)
    }

    fn chunk(&self, number: u64) -> PathBuf {
        self.path.join("chunks").join(format!("{number:06}.csv"))
    }

    /// Chunks that are not there yet.
    pub fn missing(&self) -> Vec<u64> {
        (0..self.record.chunks).filter(|&number| !self.chunk(number).exists()).collect()
    }

    /// True if a chunk is there, with the rows of its cases.
    pub fn is_whole(&self, plan: &Plan, number: u64) -> bool {
        self.rows(plan, &plan.fields(), number).is_ok()
    }

    /// The rows of a chunk. Errors: [`SweepFolderError`], with the file, if they are not those of its cases.
    fn rows(&self, plan: &Plan, fields: &[Field], number: u64) -> Result<Vec<Vec<Cell>>, SweepFolderError> {
        let path = self.chunk(number);
        let file = std::fs::File::open(&path).map_err(|source| io_error(&path, source))?;
        let rows: Vec<Vec<Cell>> = read_rows(io::BufReader::new(file), fields)
            .collect::<io::Result<_>>()
            .map_err(|error| other(&path, format!("no chunk of this sweep: {error}")))?;
        let cases = plan.cases_of(number);
        let has = |(case, row): (u64, &Vec<Cell>)| row.first() == Some(&Cell::from(case as f64));
        if rows.len() as u64 != cases.end - cases.start || !cases.clone().zip(&rows).all(has) {
            let what = format!("no chunk of this sweep: expected cases {} to {}", cases.start, cases.end - 1);
            return Err(other(&path, what));
        }
        Ok(rows)
    }

    /// Keeps a chunk, whole.
    ///
    /// # Errors
    ///
    /// If it cannot be written; then nothing stands under its name.
    pub fn keep(&self, number: u64, text: &[u8]) -> Result<(), SweepFolderError> {
        keep(&self.chunk(number), text)
    }

    /// Writes all rows, in the order of cases, as `sweep.parquet`; its path.
    ///
    /// # Errors
    ///
    /// If a chunk is missing or not whole, or the file cannot be written.
    #[cfg(feature = "parquet")]
    pub fn merge(&self, plan: &Plan) -> Result<PathBuf, SweepFolderError> {
        let missing = self.missing();
        if let Some(first) = missing.first() {
            let what = format!(
                "{} of {} chunks are missing, the first is {first}",
                missing.len(),
                self.record.chunks
            );
            return Err(other(&self.path, what));
        }
        let path = self.path.join("sweep.parquet");
        let fields = plan.fields();
        let metadata = [
            ("eigenbody:version", self.record.version.clone()),
            ("eigenbody:fingerprint", self.record.fingerprint.clone()),
            ("eigenbody:seed", self.record.seed.to_string()),
            ("eigenbody:metric", plan.spec().metric.clone()),
            ("eigenbody:models", plan.models_text()),
        ];
        let mut damaged = None;
        let rows = (0..self.record.chunks).flat_map(|number| match self.rows(plan, &fields, number) {
            Ok(rows) => rows.into_iter().map(Ok).collect::<Vec<_>>(),
            Err(error) => {
                damaged = Some(error);
                vec![Err(io::Error::from(io::ErrorKind::InvalidData))]
            }
        });
        let written = write_whole(&path, |out| {
            crate::write_parquet(&fields, &metadata, rows, out).map_err(ParquetFailure::into_io)
        });
        match damaged {
            Some(error) => Err(error),
            None => written.map(|()| path.clone()).map_err(|source| io_error(&path, source)),
        }
    }
}

fn io_error(path: &Path, source: io::Error) -> SweepFolderError {
    SweepFolderError::Io { path: path.to_owned(), source }
}

fn other(path: &Path, what: String) -> SweepFolderError {
    SweepFolderError::Other { path: path.to_owned(), what }
}

fn keep(path: &Path, text: &[u8]) -> Result<(), SweepFolderError> {
    write_whole(path, |out| out.write_all(text)).map_err(|source| io_error(path, source))
}

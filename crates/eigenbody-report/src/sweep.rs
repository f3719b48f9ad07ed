//! A sweep's folder: what was planned, a file a chunk, and the table that they make.
//!
//! ```text
//! DIR/plan.json               fingerprint, seed, cases, chunks, version
//! DIR/chunks/000012.csv       whole or not there
//! DIR/sweep.parquet           all rows in the order of cases, once every chunk is there
//! ```
//! A chunk's file depends on the plan and its number alone, so that it does not matter who computed it, when, or how often.

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use eigenbody_study::sweep::{Chunk, Plan};
use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::RowsCsv;

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
    /// The table cannot be written.
    #[cfg(feature = "parquet")]
    #[error("{}: {source}", path.display())]
    Parquet {
        /// Which file.
        path: PathBuf,
        /// Why.
        source: crate::ParquetFailure,
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
                entry.is_ok_and(|entry| entry.file_name() != "chunks" && !is_temporary(&entry.path()))
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
            write_whole(&plan, text.as_bytes())?;
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

    /// Keeps a chunk, whole.
    ///
    /// # Errors
    ///
    /// If it cannot be written; then nothing stands under its name.
    pub fn keep(&self, number: u64, text: &[u8]) -> Result<(), SweepFolderError> {
        write_whole(&self.chunk(number), text)
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
        let mut next = 0u64;
        let rows = (0..self.record.chunks).flat_map(|number| {
            let opened = std::fs::File::open(self.chunk(number));
            match opened {
                Ok(file) => Box::new(
                    crate::read_rows(io::BufReader::new(file), &fields).collect::<Vec<_>>().into_iter(),
                ) as Box<dyn Iterator<Item = io::Result<_>>>,
                Err(error) => Box::new(std::iter::once(Err(error))),
            }
        });
        let counted = rows.inspect(|_| next += 1);
        let metadata = [
            ("eigenbody:version", self.record.version.clone()),
            ("eigenbody:fingerprint", self.record.fingerprint.clone()),
            ("eigenbody:seed", self.record.seed.to_string()),
            ("eigenbody:metric", plan.spec().metric.clone()),
            ("eigenbody:models", plan.models_text()),
        ];
        let failed = |source| SweepFolderError::Parquet { path: path.clone(), source };
        let temporary = temporary(&self.path)?;
        crate::write_parquet(&fields, &metadata, counted, io::BufWriter::new(temporary.as_file()))
            .map_err(failed)?;
        if next != self.record.cases {
            return Err(other(&self.path, format!("{next} rows of {} cases", self.record.cases)));
        }
        persist(temporary, &path)?;
        Ok(path)
    }
}

fn is_temporary(path: &Path) -> bool {
    path.file_name().is_some_and(|name| name.to_string_lossy().starts_with(".tmp"))
}

fn io_error(path: &Path, source: io::Error) -> SweepFolderError {
    SweepFolderError::Io { path: path.to_owned(), source }
}

fn other(path: &Path, what: String) -> SweepFolderError {
    SweepFolderError::Other { path: path.to_owned(), what }
}

fn temporary(folder: &Path) -> Result<tempfile::NamedTempFile, SweepFolderError> {
    // The library's own message names the temporary file, which means nothing to the user.
    tempfile::NamedTempFile::new_in(folder).map_err(|error| io_error(folder, error.kind().into()))
}

fn persist(temporary: tempfile::NamedTempFile, path: &Path) -> Result<(), SweepFolderError> {
    temporary.as_file().sync_all().map_err(|source| io_error(path, source))?;
    temporary.persist(path).map_err(|error| io_error(path, error.error))?;
    Ok(())
}

fn write_whole(path: &Path, text: &[u8]) -> Result<(), SweepFolderError> {
    let folder = path.parent().unwrap_or(Path::new("."));
    let mut file = temporary(folder)?;
    file.as_file_mut().write_all(text).map_err(|source| io_error(path, source))?;
    persist(file, path)
}

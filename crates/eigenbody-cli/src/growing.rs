//! A table that grows row by row, and whose rows so far can be read whatever happens.
//!
//! ```text
//! FILE.csv        rows go to FILE.csv.partial, which is CSV at any time; at the end it is renamed
//! FILE.parquet    rows go to FILE.parquet.partial.csv; at the end they are written as Parquet, which is readable only as a whole
//! ```
//! Lines are written whole, at most a tenth of a second after they come. Where the disk is full, a torn line is taken back. A killed run
//! leaves the partial file; the next one does not overwrite it.

use crate::failure::Failure;
use eigenbody_report::file::Place;
use eigenbody_report::{RowsCsv, read_rows};
use eigenbody_study::{Cell, Field};
use std::fs::{File, OpenOptions, Permissions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Rows wait no longer than this,
const PATIENCE: Duration = Duration::from_millis(100);
/// and no more of them than so many bytes.
const BLOCK: usize = 1 << 15;

/// A growing table.
pub struct Growing {
    target: Target,
    fields: Vec<Field>,
    metadata: Vec<(&'static str, String)>,
    rows: RowsCsv<Box<dyn Write>>,
    flushed: Instant,
}

enum Target {
    Stdout,
    /// A device or a pipe, which cannot be renamed.
    Direct(PathBuf),
    File {
        path: PathBuf,
        partial: PathBuf,
        handle: File,
        permissions: Option<Permissions>,
        is_parquet: bool,
    },
}

impl Growing {
    /// A table in a file, or on standard output, with its heading written.
    pub fn create(
        path: Option<&Path>,
        fields: Vec<Field>,
        metadata: Vec<(&'static str, String)>,
    ) -> Result<Self, Failure> {
        let (target, out): (Target, Box<dyn Write>) = match path {
            None => (Target::Stdout, Box::new(io::stdout())),
            Some(path) => {
                let failed = |source| Failure::File { path: path.to_owned(), source };
                match Place::find(path).map_err(failed)? {
                    Place::Stream => {
                        let out = OpenOptions::new().write(true).open(path).map_err(failed)?;
                        (Target::Direct(path.to_owned()), Box::new(out))
                    }
                    Place::File { path: target, permissions } => file(path, &target, permissions)?,
                }
            }
        };
        let mut growing = match RowsCsv::new(out, &fields) {
            Ok(rows) => Self { target, fields, metadata, rows, flushed: Instant::now() },
            Err(source) => return Err(target.failure(source, 0)),
        };
        growing.flush()?;
        Ok(growing)
    }

    /// One more row.
    pub fn push(&mut self, row: &[Cell]) -> Result<(), Failure> {
        self.rows.push(row).map_err(|source| self.target.failure(source, self.rows.written().1))?;
        if self.rows.waiting() >= BLOCK || self.flushed.elapsed() >= PATIENCE {
            self.flush()?;
        }
        Ok(())
    }

    /// Writes the rows that wait; what can be read afterwards is whole lines.
    pub fn flush(&mut self) -> Result<(), Failure> {
        self.flushed = Instant::now();
        let Err(source) = self.rows.flush() else { return Ok(()) };
        let (bytes, rows) = self.rows.written();
        if let Target::File { handle, .. } = &self.target {
            // Shortening needs no space. If it fails all the same, the last line is torn, and readers say so.
            _ = handle.set_len(bytes);
        }
        Err(self.target.failure(source, rows))
    }

    /// The rows are of no use: nothing is left of them.
    pub fn discard(self) {
        if let Target::File { partial, .. } = &self.target {
            _ = std::fs::remove_file(partial);
        }
    }

    /// All rows are there: the table under its own name.
    pub fn finish(mut self) -> Result<u64, Failure> {
        self.flush()?;
        let count = self.rows.written().1;
        if let Target::File { path, partial, handle, permissions, is_parquet } = &self.target {
            let failed = |source| self.target.failure(source, count);
            if *is_parquet {
                self.convert(path, partial).map_err(failed)?;
                std::fs::remove_file(partial).map_err(failed)?;
            } else {
                if let Some(permissions) = permissions {
                    handle.set_permissions(permissions.clone()).map_err(failed)?;
                }
                handle.sync_all().map_err(failed)?;
                std::fs::rename(partial, path).map_err(failed)?;
            }
        }
        Ok(count)
    }

    /// The Parquet file from the rows on disk.
    #[cfg(feature = "parquet")]
    fn convert(&self, path: &Path, partial: &Path) -> io::Result<()> {
        let rows = read_rows(File::open(partial)?, &self.fields);
        eigenbody_report::file::write_whole(path, |out| {
            eigenbody_report::write_parquet(&self.fields, &self.metadata, rows, out)
                .map_err(eigenbody_report::ParquetFailure::into_io)
        })
    }

    #[cfg(not(feature = "parquet"))]
    fn convert(&self, _: &Path, _: &Path) -> io::Result<()> {
        Err(io::ErrorKind::Unsupported.into())
    }
}

/// The partial file of a target that is, or will be, a file; `path` is how the user calls it.
fn file(
    path: &Path,
    target: &Path,
    permissions: Option<Permissions>,
) -> Result<(Target, Box<dyn Write>), Failure> {
    let failed = |source| Failure::File { path: path.to_owned(), source };
    let is_parquet = match path.extension().and_then(|extension| extension.to_str()) {
        Some("parquet") => true,
        Some("csv") => false,
        _ => return Err(Failure::Usage(format!("{}: expected a .csv or .parquet file", path.display()))),
    };
    if is_parquet && !cfg!(feature = "parquet") {
        return Err(Failure::Usage(format!("{}: Parquet is not built in", path.display())));
    }
    let mut name = target.as_os_str().to_owned();
    name.push(if is_parquet { ".partial.csv" } else { ".partial" });
    let partial = PathBuf::from(name);
    let handle =
        OpenOptions::new().write(true).create_new(true).open(&partial).map_err(|error| {
            match error.kind() {
                io::ErrorKind::AlreadyExists => Failure::Usage(format!(
                    "{}: holds the rows of a run that did not end; move or remove it",
                    partial.display()
                )),
                _ => failed(error),
            }
        })?;
    let out = handle.try_clone().map_err(failed)?;
    Ok((Target::File { path: target.to_owned(), partial, handle, permissions, is_parquet }, Box::new(out)))
}

impl Target {
    fn failure(&self, source: io::Error, rows: u64) -> Failure {
        match self {
            Self::Stdout => Failure::Stdout(source),
            Self::Direct(path) => Failure::Rows { path: path.clone(), source, partial: None },
            Self::File { path, partial, .. } => {
                Failure::Rows { path: path.clone(), source, partial: Some((partial.clone(), rows)) }
            }
        }
    }
}

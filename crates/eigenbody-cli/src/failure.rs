//! Everything that ends a command with status 2: one line each.

use eigenbody_formats::{FormatError, PatchError};
use std::io;
use std::path::PathBuf;
use thiserror::Error;

/// Why a command ended.
#[derive(Debug, Error)]
pub enum Failure {
    /// The model or the configuration could not be read.
    #[error(transparent)]
    Format(#[from] FormatError),
    /// The robot was read, but the question has no answer.
    #[error("{model}: {source}")]
    Numbers {
        /// The model as it was asked for.
        model: String,
        /// What the core says.
        source: eigenbody::Error,
    },
    /// The built-in robot could not be built.
    #[error(transparent)]
    Build(#[from] eigenbody::BuildError),
    /// The format to be written cannot say what the model is.
    #[error("{model}: {source}")]
    Write {
        /// The model as it was asked for.
        model: String,
        /// What it cannot say.
        source: eigenbody_formats::WriteError,
    },
    /// The model's own file cannot be changed where it stands.
    #[error("{model}: {source}{}", plain_copy(source))]
    Patch {
        /// The model as it was asked for.
        model: String,
        /// Why not.
        source: PatchError,
    },
    /// An option does not fit the others.
    #[error("{0}")]
    Usage(String),
    /// Standard output could not be written.
    #[error("standard output: {0}")]
    Stdout(io::Error),
    /// A file could not be written; what stood there before still does.
    #[error("{}: {source}", path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// Why not.
        source: io::Error,
    },
    /// Rows could not be written any more; those before stand.
    #[error("{}: {source}{}", path.display(), kept(partial))]
    Rows {
        /// The file.
        path: PathBuf,
        /// Why not.
        source: io::Error,
        /// Where rows stand, and how many.
        partial: Option<(PathBuf, u64)>,
    },
    /// A sweep's folder does not do.
    #[error(transparent)]
    Sweep(#[from] eigenbody_report::SweepFolderError),
    /// A log cannot be followed.
    #[error(transparent)]
    Log(#[from] eigenbody_formats::MotionError),
    /// A motion did not begin.
    #[error("{model}: {source}")]
    Simulation {
        /// The model as it was asked for.
        model: String,
        /// Why not.
        source: eigenbody_study::simulate::SimulationError,
    },
    /// The explorer could not listen.
    #[cfg(feature = "web")]
    #[error("127.0.0.1:{port}: {source}")]
    Listen {
        /// The port that was asked for.
        port: u16,
        /// Why not.
        source: io::Error,
    },
    /// A folder cannot take the output.
    #[error("{}: {what}", path.display())]
    Folder {
        /// The folder.
        path: PathBuf,
        /// Why not.
        what: String,
    },
    /// An experiment has no result.
    #[error("{id}: {source}")]
    Study {
        /// The experiment.
        id: &'static str,
        /// Why not.
        source: eigenbody_study::StudyError,
    },
    /// The serialiser failed.
    #[error("JSON: {0}")]
    Json(String),
}

/// What else can be done about a file whose elements are not one for each joint and link.
fn plain_copy(error: &PatchError) -> &'static str {
    match error {
        PatchError::Included { .. } | PatchError::Several { .. } | PatchError::Differs { .. } => {
            "; a plain copy by `eigenbody convert` can be changed"
        }
        _ => "",
    }
}

fn kept(partial: &Option<(PathBuf, u64)>) -> String {
    match partial {
        Some((path, rows)) => {
            format!(
                "; the {} so far: {}",
                eigenbody_report::count(*rows as usize, "row", "rows"),
                path.display()
            )
        }
        None => String::new(),
    }
}

impl Failure {
    /// The error with the line of the file that it is about, for a person at a terminal.
    pub fn excerpt(&self, styled: bool) -> Option<String> {
        let Self::Format(error) = self else { return None };
        let (file, at, message) = error.place()?;
        let text = std::fs::read_to_string(file).ok()?;
        eigenbody_report::excerpt(file, &text, (at.line, at.column), &message, styled)
    }

    /// The reader of our output has gone, as `head` does: no error.
    pub fn is_closed_pipe(&self) -> bool {
        matches!(self, Self::Stdout(error) if error.kind() == io::ErrorKind::BrokenPipe)
    }
}

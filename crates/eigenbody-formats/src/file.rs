//! The bytes of a file, or why there are none.

use crate::error::{FileFault, FormatError};
use std::fs::File;
use std::io::{ErrorKind, Read};
use std::path::{Path, PathBuf};

/// Largest file that is read: 256 MiB.
const LIMIT: u64 = 1 << 28;

pub(crate) fn read(path: &Path) -> Result<Vec<u8>, FormatError> {
    contents(path).map_err(|fault| FormatError::File { file: path.display().to_string(), fault })
}

fn contents(path: &Path) -> Result<Vec<u8>, FileFault> {
    if path.is_dir() {
        return Err(FileFault::Directory);
    }
    let file = File::open(path).map_err(|error| fault(&error))?;
    let mut bytes = Vec::new();
    file.take(LIMIT + 1).read_to_end(&mut bytes).map_err(|error| fault(&error))?;
    match bytes.len() as u64 > LIMIT {
        true => Err(FileFault::TooLarge { limit: LIMIT }),
        false => Ok(bytes),
    }
}

/// Where the files that a text names are looked for. Everything that a reader asks of the disk on a text's behalf goes through here.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) enum Shelf {
    /// On the disk.
    #[default]
    Disk,
    /// Nowhere: the text stands alone, and nothing tells it even whether a file is there.
    Empty,
}

impl Shelf {
    /// True if something stands at the path.
    pub fn has(self, path: &Path) -> bool {
        self == Self::Disk && path.exists()
    }

    /// The file of a path: itself, or a file of that name if it is a folder.
    pub fn file(self, path: PathBuf, in_folder: &str) -> Option<PathBuf> {
        if self == Self::Empty {
            return None;
        }
        let file = if path.is_dir() { path.join(in_folder) } else { path };
        file.is_file().then_some(file)
    }

    /// One path for all ways to write it.
    pub fn canonical(self, path: &Path) -> PathBuf {
        let known = if self == Self::Disk { std::fs::canonicalize(path).ok() } else { None };
        known.unwrap_or_else(|| path.to_owned())
    }

    /// The bytes of a file.
    pub fn contents(self, path: &Path) -> Result<Vec<u8>, FileFault> {
        match self {
            Self::Disk => contents(path),
            Self::Empty => Err(FileFault::Alone),
        }
    }
}

fn fault(error: &std::io::Error) -> FileFault {
    match error.kind() {
        ErrorKind::NotFound => FileFault::Missing,
        _ => FileFault::Io(error.to_string()),
    }
}

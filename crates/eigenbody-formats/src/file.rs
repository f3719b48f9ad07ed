//! The bytes of a file, or why there are none.

use crate::error::{FileFault, FormatError};
use std::fs::File;
use std::io::{ErrorKind, Read};
use std::path::Path;

/// Largest file that is read: 256 MiB.
const LIMIT: u64 = 1 << 28;

pub(crate) fn read(path: &Path) -> Result<Vec<u8>, FormatError> {
    contents(path).map_err(|fault| FormatError::File { file: path.display().to_string(), fault })
}

pub(crate) fn contents(path: &Path) -> Result<Vec<u8>, FileFault> {
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

fn fault(error: &std::io::Error) -> FileFault {
    match error.kind() {
        ErrorKind::NotFound => FileFault::Missing,
        _ => FileFault::Io(error.to_string()),
    }
}

//! Files that appear whole or not at all.
//!
//! ```text
//! device, pipe         written into as it is
//! link                 what it points to is meant
//! regular file, none   written beside it under another name, then renamed; an old file hands on its permissions
//! ```

use std::collections::BTreeSet;
use std::fs::{OpenOptions, Permissions};
use std::io::{self, BufWriter, IntoInnerError, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};
use tempfile::{Builder, NamedTempFile};

/// How temporary files' names begin.
const PREFIX: &str = ".tmp";
/// Links that are followed, one after the other.
const LINKS: usize = 40;

/// Temporary files of this process.
static UNFINISHED: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

fn unfinished() -> MutexGuard<'static, BTreeSet<PathBuf>> {
    UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Removes the temporary files of this process, and goes on to `end` it: no more are made meanwhile.
pub fn remove_unfinished(end: impl FnOnce()) {
    let all = unfinished();
    for path in all.iter() {
        _ = std::fs::remove_file(path);
    }
    end();
}

/// True for the name of a temporary file that an earlier process may have left.
pub fn is_temporary(name: &str) -> bool {
    name.starts_with(PREFIX)
}

/// What stands where output goes.
#[derive(Debug, Clone)]
pub enum Place {
    /// A device or a pipe.
    Stream,
    /// A regular file, or none yet.
    File {
        /// Its path, all links followed.
        path: PathBuf,
        /// What it keeps.
        permissions: Option<Permissions>,
    },
}

impl Place {
    /// What stands at `path`.
    ///
    /// # Errors
    ///
    /// If it is a folder, or there is no folder for it.
    pub fn find(path: &Path) -> io::Result<Self> {
        if path.file_name().is_none() || path.as_os_str().to_string_lossy().ends_with(std::path::is_separator)
        {
            return Err(io::ErrorKind::IsADirectory.into());
        }
        match std::fs::metadata(path) {
            Ok(found) if found.is_dir() => Err(io::ErrorKind::IsADirectory.into()),
            Ok(found) if found.is_file() => {
                Ok(Self::File { path: std::fs::canonicalize(path)?, permissions: Some(found.permissions()) })
            }
            Ok(_) => Ok(Self::Stream),
            Err(_) => {
                let path = followed(path);
                let folder = folder(&path);
                if !folder.is_dir() {
                    let what = format!("no folder '{}'", folder.display());
                    return Err(io::Error::new(io::ErrorKind::NotFound, what));
                }
                Ok(Self::File { path, permissions: None })
            }
        }
    }

    /// The same for two paths of one regular file, or of one that would be made.
    pub fn identity(&self) -> Option<PathBuf> {
        let Self::File { path, .. } = self else { return None };
        let folder = std::fs::canonicalize(folder(path)).ok()?;
        Some(folder.join(path.file_name()?))
    }
}

/// Where a link points to that leads nowhere yet.
fn followed(path: &Path) -> PathBuf {
    let mut path = path.to_owned();
    for _ in 0..LINKS {
        let Ok(next) = std::fs::read_link(&path) else { break };
        path = folder(&path).join(next);
    }
    path
}

/// The folder of a file.
pub fn folder(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// Writes a file: an interrupted or failed run leaves the old one as it was.
///
/// # Errors
///
/// If it cannot be written, or `write` fails.
pub fn write_whole(
    path: &Path,
    write: impl FnOnce(&mut (dyn Write + Send)) -> io::Result<()>,
) -> io::Result<()> {
    let (target, permissions) = match Place::find(path)? {
        Place::Stream => {
            let mut out = BufWriter::new(OpenOptions::new().write(true).open(path)?);
            write(&mut out)?;
            return out.flush();
        }
        Place::File { path, permissions } => (path, permissions),
    };
    let temporary = Temporary::beside(&target)?;
    let mut out = BufWriter::new(temporary);
    write(&mut out)?;
    out.into_inner().map_err(IntoInnerError::into_error)?.keep(&target, permissions)
}

/// A file under a temporary name, removed when dropped.
struct Temporary {
    file: NamedTempFile,
    name: PathBuf,
}

impl Temporary {
    fn beside(path: &Path) -> io::Result<Self> {
        // Files that others may read, as far as the user's mask allows: temporary ones are private unless told.
        let mut builder = Builder::new();
        builder.prefix(PREFIX);
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            builder.permissions(Permissions::from_mode(0o666));
        }
        let mut all = unfinished();
        // The library's own message names the temporary file, which means nothing to the user: only the kind is kept.
        let file = builder.tempfile_in(folder(path)).map_err(|error| io::Error::from(error.kind()))?;
        let name = file.path().to_owned();
        all.insert(name.clone());
        Ok(Self { file, name })
    }

    fn keep(self, path: &Path, permissions: Option<Permissions>) -> io::Result<()> {
        let file = self.file.as_file();
        if let Some(permissions) = permissions {
            file.set_permissions(permissions)?;
        }
        file.sync_all()?;
        let done = self.file.persist(path).map_err(|error| error.error);
        unfinished().remove(&self.name);
        done.map(drop)
    }
}

impl Write for Temporary {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.file.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

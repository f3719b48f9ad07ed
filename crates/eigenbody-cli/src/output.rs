//! Where results go: standard output, or a file that appears whole or not at all.

use crate::failure::Failure;
use std::io::{self, Write};
use std::path::Path;

/// Runs `write` on the file `path`, or on standard output if there is none.
pub fn deliver(
    path: Option<&Path>,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), Failure> {
    match path {
        None => {
            let mut out = io::BufWriter::new(io::stdout().lock());
            write(&mut out).and_then(|()| out.flush()).map_err(Failure::Stdout)
        }
        Some(path) => to_file(path, write).map_err(|source| Failure::File { path: path.to_owned(), source }),
    }
}

/// Makes the folder `path`, or checks that it takes files and is empty; with `force` it need not be empty.
pub fn folder(path: &Path, force: bool) -> Result<(), Failure> {
    let refuse = |what: String| Failure::Folder { path: path.to_owned(), what };
    let system = |what: &str, error: &io::Error| refuse(format!("{what}: {}", error.kind()));
    if path.exists() && !path.is_dir() {
        return Err(refuse("not a folder".into()));
    }
    std::fs::create_dir_all(path).map_err(|error| system("the folder cannot be made", &error))?;
    let mut entries = std::fs::read_dir(path).map_err(|error| system("the folder cannot be read", &error))?;
    if !force && entries.next().is_some() {
        return Err(refuse("the folder is not empty; --force writes into it all the same".into()));
    }
    tempfile::NamedTempFile::new_in(path).map_err(|error| system("the folder cannot be written", &error))?;
    Ok(())
}

/// Files that others may read, as far as the user's mask allows: temporary ones are private unless told.
pub fn builder() -> tempfile::Builder<'static, 'static> {
    #[allow(unused_mut)] // nothing to set elsewhere
    let mut builder = tempfile::Builder::new();
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(std::fs::Permissions::from_mode(0o666));
    }
    builder
}

/// Writes beside the target and renames: an interrupted or failed run leaves the old file as it was.
fn to_file(path: &Path, write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    if !folder.is_dir() {
        return Err(io::Error::new(io::ErrorKind::NotFound, format!("no folder '{}'", folder.display())));
    }
    // The library's own message names the temporary file, which means nothing to the user: only the kind is kept.
    let temporary = builder().tempfile_in(folder).map_err(|error| io::Error::from(error.kind()))?;
    let mut out = io::BufWriter::new(temporary);
    write(&mut out)?;
    let temporary = out.into_inner().map_err(io::IntoInnerError::into_error)?;
    temporary.as_file().sync_all()?;
    temporary.persist(path).map_err(|error| error.error)?;
    Ok(())
}

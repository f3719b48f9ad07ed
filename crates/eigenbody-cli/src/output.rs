//! Where results go: standard output, or a file that appears whole or not at all.

use crate::failure::Failure;
use eigenbody_formats::Loaded;
use eigenbody_report::file::{Place, is_temporary, write_whole};
use std::fmt::Display;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

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
        Some(path) => write_whole(path, |out| write(out))
            .map_err(|source| Failure::File { path: path.to_owned(), source }),
    }
}

/// A page for people: control characters and marks that turn the direction of writing, as names may have them, are shown and not obeyed.
pub fn page(path: Option<&Path>, text: &str) -> Result<(), Failure> {
    deliver(path, |out| out.write_all(shown(text).as_bytes()))
}

/// A line for the user. There is nobody to tell if it cannot be written.
pub fn say(line: impl Display) {
    _ = writeln!(io::stderr(), "{}", shown(&line.to_string()));
}

fn shown(text: &str) -> String {
    let mut shown = String::with_capacity(text.len());
    for c in text.chars() {
        let turns = matches!(c, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
        let breaks = matches!(c, '\u{2028}' | '\u{2029}');
        match turns || breaks || (c.is_control() && c != '\n') {
            true => shown.extend(c.escape_unicode()),
            false => shown.push(c),
        }
    }
    shown
}

/// Refuses outputs that have no folder, that are files which the command reads, or that are the same file twice.
pub fn check_files(reads: &[&Path], writes: &[&Path]) -> Result<(), Failure> {
    let place =
        |path: &Path| Place::find(path).map_err(|source| Failure::File { path: path.to_owned(), source });
    let read: Vec<_> = reads
        .iter()
        .filter(|path| path.exists())
        .filter_map(|path| Some((path, Place::find(path).ok()?.identity()?)))
        .collect();
    let mut written = Vec::new();
    for path in writes {
        let Some(file) = place(path)?.identity() else { continue };
        let refuse = |what: &str| Err(Failure::Folder { path: (*path).to_owned(), what: what.into() });
        if read.iter().any(|(_, other)| *other == file) {
            return refuse("is what this command reads: choose another output");
        }
        if written.contains(&file) {
            return refuse("two outputs are this one file");
        }
        written.push(file);
    }
    Ok(())
}

/// The same for the files that a model comes from, which are known when it is read.
pub fn check_model(loaded: &Loaded, writes: &[Option<&Path>]) -> Result<(), Failure> {
    let files = loaded.files();
    let reads: Vec<&Path> = files.iter().map(PathBuf::as_path).collect();
    let writes: Vec<&Path> = writes.iter().flatten().copied().collect();
    check_files(&reads, &writes)
}

/// Makes the folder `path`, or checks that it takes files and holds nothing but what `is_own` knows by name; with `force` it may hold more.
pub fn folder(path: &Path, force: bool, is_own: impl Fn(&str) -> bool) -> Result<(), Failure> {
    let refuse = |what: String| Failure::Folder { path: path.to_owned(), what };
    let system = |what: &str, error: &io::Error| refuse(format!("{what}: {}", error.kind()));
    if path.exists() && !path.is_dir() {
        return Err(refuse("not a folder".into()));
    }
    std::fs::create_dir_all(path).map_err(|error| system("the folder cannot be made", &error))?;
    let mut entries = std::fs::read_dir(path).map_err(|error| system("the folder cannot be read", &error))?;
    let is_foreign = |entry: io::Result<std::fs::DirEntry>| {
        entry.map_or(true, |entry| {
            let name = entry.file_name();
            let name = name.to_string_lossy();
            !is_own(&name) && !is_temporary(&name)
        })
    };
    if !force && entries.any(is_foreign) {
        return Err(refuse("the folder is not empty; --force writes into it all the same".into()));
    }
    tempfile::NamedTempFile::new_in(path).map_err(|error| system("the folder cannot be written", &error))?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::shown;

    #[test]
    fn what_would_steer_a_terminal_is_shown() {
        assert_eq!(shown("a\u{9b}31m\u{202e}b\u{1b}[0m\nκ"), "a\\u{9b}31m\\u{202e}b\\u{1b}[0m\nκ");
    }
}

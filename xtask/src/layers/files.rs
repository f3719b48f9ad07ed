//! The source files of a folder.

use std::path::{Path, PathBuf};

/// A file and its text.
pub struct Source {
    /// Path from the root of the repository.
    pub path: PathBuf,
    /// What it holds.
    pub text: String,
}

/// Names of what stands in `folder`, sorted, without hidden files.
pub fn entries(root: &Path, folder: &Path) -> Result<Vec<String>, String> {
    let cannot = |error: std::io::Error| format!("cannot read {}: {error}", folder.display());
    let mut names = Vec::new();
    for entry in std::fs::read_dir(root.join(folder)).map_err(cannot)? {
        names.push(entry.map_err(cannot)?.file_name().to_string_lossy().into_owned());
    }
    names.retain(|name| !name.starts_with('.'));
    names.sort();
    Ok(names)
}

/// Every Rust file in `folder` and below.
pub fn sources(root: &Path, folder: &Path) -> Result<Vec<Source>, String> {
    let mut found = Vec::new();
    for name in entries(root, folder)? {
        let path = folder.join(&name);
        if root.join(&path).is_dir() {
            found.extend(sources(root, &path)?);
        } else if name.ends_with(".rs") {
            let text = read(root, &path)?;
            found.push(Source { path, text });
        }
    }
    Ok(found)
}

/// The text of a file.
pub fn read(root: &Path, path: &Path) -> Result<String, String> {
    std::fs::read_to_string(root.join(path))
        .map_err(|error| format!("cannot read {}: {error}", path.display()))
}

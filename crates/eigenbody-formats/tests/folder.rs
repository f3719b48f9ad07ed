//! Files for a test.

use eigenbody_formats::{Loaded, MjcfOptions, read_mjcf};
use std::path::PathBuf;

/// A folder of its own, removed when dropped.
pub struct Folder(tempfile::TempDir);

impl Folder {
    pub fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    pub fn file(&self, name: &str, contents: impl AsRef<[u8]>) -> PathBuf {
        let path = self.path(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(&path, contents).unwrap();
        path
    }

    pub fn load(&self, text: &str) -> Loaded {
        read_mjcf(&self.file("main.xml", text), &MjcfOptions::default()).unwrap()
    }

    /// The error, paths cut to the folder.
    pub fn fault(&self, text: &str) -> String {
        let path = self.file("main.xml", text);
        self.cut(&read_mjcf(&path, &MjcfOptions::default()).unwrap_err().to_string())
    }

    /// A message, paths cut to the folder.
    pub fn cut(&self, message: &str) -> String {
        message.replace(&format!("{}/", self.0.path().display()), "")
    }
}

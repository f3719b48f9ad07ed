//! The files that a model comes from.

use crate::loaded::{Kind, Loaded};
use crate::looks::{Form, places};
use std::collections::HashSet;
use std::path::PathBuf;

impl Loaded {
    /// The files that it comes from: its own, those that it includes, and meshes and height fields that it names, whether H needs
    /// them or not. None for a family or a built-in robot.
    pub fn files(&self) -> Vec<PathBuf> {
        let Kind::File(own) = &self.kind else { return Vec::new() };
        let drawn = self.looks.iter().filter_map(|look| match &look.form {
            Form::Mesh { file, .. } => Some(file),
            Form::Primitive(_) => None,
        });
        let named = drawn.chain(&self.meshes).flat_map(|file| places(own, file));
        let texts = self.places.files.iter().map(PathBuf::from);
        let mut files: Vec<PathBuf> = std::iter::once(own.clone()).chain(texts).collect();
        files.extend(self.assets.iter().cloned().chain(named));
        let mut seen = HashSet::new();
        files.retain(|path| seen.insert(path.clone()));
        files
    }
}

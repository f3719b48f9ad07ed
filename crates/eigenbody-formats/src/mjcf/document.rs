//! Documents: a root with everything included, and the models that its assets name.

use super::fault::{Fault, MjcfFault, fault};
use super::include::{Splicer, text};
use super::{names, schema};
use crate::xml::{Element, Files, Spot};
use std::collections::HashSet;
use std::path::{Path, PathBuf};

/// Most files of one model.
const MAX_FILES: usize = 1000;

/// A spliced root that follows the schema.
#[derive(Debug)]
pub(super) struct Model {
    pub root: Element,
    /// The folder of its main file.
    pub folder: PathBuf,
    /// The models of its `<asset><model>` elements, each with the place of that element.
    pub models: Vec<(Spot, Model)>,
}

impl Model {
    /// The model of a text, and all models that it names.
    pub fn load(text: String, path: &Path, name: &str, files: &mut Files) -> Result<Self, Fault> {
        Self::load_below(text, path, name, files, &mut Vec::new())
    }

    /// `above` are the files of the models that this one is an asset of.
    fn load_below(
        contents: String,
        path: &Path,
        name: &str,
        files: &mut Files,
        above: &mut Vec<PathBuf>,
    ) -> Result<Self, Fault> {
        let mut splicer = Splicer::new(files, path);
        let (root, folder) = (splicer.root(contents, name)?, splicer.folder);
        if root.tag != "mujoco" {
            return Err(fault(root.at, MjcfFault::Root { tag: root.tag }));
        }
        schema::check(&root)?;
        names::check(&root, files)?;
        above.push(files.shelf.canonical(path));
        let named = root.children_named("asset").flat_map(|a| a.children_named("model"));
        let mut models = Vec::new();
        for element in named {
            let at = element.spot_of("file");
            let file = element.get("file").unwrap_or_default();
            let here = files.all.get(at.file as usize).map(|f| f.folder.clone()).unwrap_or_default();
            let candidates = [folder.join(file), here.join(file)];
            let path = candidates.iter().find(|path| files.shelf.has(path)).unwrap_or(&candidates[0]);
            let known = files.shelf.canonical(path);
            if above.contains(&known) || files.all.len() >= MAX_FILES {
                return Err(fault(at, MjcfFault::IncludedTwice { file: file.to_owned() }));
            }
            let bytes = files
                .shelf
                .contents(path)
                .map_err(|problem| fault(at, MjcfFault::Include { file: file.to_owned(), fault: problem }))?;
            let contents = text(bytes, files.all.len() as u32, path, files)?;
            let name = path.display().to_string();
            models.push((element.at, Self::load_below(contents, path, &name, files, above)?));
        }
        above.pop();
        Ok(Self { root, folder, models })
    }
}

/// A model being read.
pub(super) struct Document<'a> {
    pub model: &'a Model,
    pub root: &'a Element,
    pub files: &'a Files,
    inertial: HashSet<Spot>,
}

impl<'a> Document<'a> {
    /// The document of a model.
    pub fn new(model: &'a Model, files: &'a Files) -> Self {
        let root = &model.root;
        let mut inertial = HashSet::new();
        let mut stack: Vec<(&Element, Spot)> = vec![(root, root.at)];
        while let Some((element, body)) = stack.pop() {
            for child in &element.children {
                match child.tag.as_str() {
                    "inertial" => {
                        inertial.insert(body);
                    }
                    "body" => stack.push((child, child.at)),
                    // What these hold belongs to the body around them.
                    "frame" | "worldbody" | "replicate" => stack.push((child, body)),
                    _ => {}
                }
            }
        }
        Self { model, root, files, inertial }
    }

    /// True if the body at a spot has an `<inertial>`, wherever in its frames.
    pub fn has_inertial(&self, body: Spot) -> bool {
        self.inertial.contains(&body)
    }
}

//! `<include>`: models of other files within the folder.

use super::fault::{Fault, SdfFault, boolean_in, child, fault, minor_version, required, unsupported};
use crate::error::FileFault;
use crate::location::Location;
use crate::xml::{self, Element, Files, SourceFile, Spot};
use std::path::{Path, PathBuf};

/// Most files of one document.
const MAX_FILES: usize = 500;

/// Replaces the includes of a document by the models they name.
pub(super) struct Splicer<'a> {
    pub files: &'a mut Files,
    /// The files being read, the innermost last.
    pub open: Vec<PathBuf>,
}

impl Splicer<'_> {
    /// The root of a text, everything included.
    pub fn root(&mut self, text: String, path: &Path, name: &str) -> Result<Element, Fault> {
        let file = self.files.all.len() as u32;
        let root = xml::parse(&text, file).map_err(|(at, problem)| {
            let offset = offset_of(&text, at);
            fault(Spot { file, offset }, SdfFault::Xml(problem))
        });
        let folder = path.parent().map(Path::to_owned).unwrap_or_default();
        self.files.all.push(SourceFile { name: name.to_owned(), folder, text });
        let mut root = root?;
        if root.tag != "sdf" {
            return Err(fault(root.at, SdfFault::Root { tag: root.tag }));
        }
        minor_version(&root)?;
        self.open.push(self.files.shelf.canonical(path));
        self.splice(&mut root)?;
        self.open.pop();
        Ok(root)
    }

    fn splice(&mut self, element: &mut Element) -> Result<(), Fault> {
        for child in &mut element.children {
            match child.tag.as_str() {
                "include" => *child = self.include(child)?,
                "model" | "world" => self.splice(child)?,
                _ => {}
            }
        }
        Ok(())
    }

    /// The model that an include names, with the include's own name, pose and placement.
    fn include(&mut self, include: &Element) -> Result<Element, Fault> {
        if include.get("merge") == Some("true") {
            return Err(unsupported(include, "merged includes mix two models' frames"));
        }
        let uri = &required(include, "uri")?.text;
        let refused = |problem| fault(include.at, SdfFault::Include { uri: uri.clone(), fault: problem });
        let path = self.find(include, uri).ok_or_else(|| refused(FileFault::Missing))?;
        let known = self.files.shelf.canonical(&path);
        if self.open.contains(&known) || self.files.all.len() >= MAX_FILES {
            return Err(fault(include.at, SdfFault::IncludeLoop { uri: uri.clone(), limit: MAX_FILES }));
        }
        let bytes = self.files.shelf.contents(&path).map_err(refused)?;
        let text = String::from_utf8_lossy(&bytes).into_owned();
        let root = self.root(text, &path, &path.display().to_string())?;
        let model = root.children.into_iter().find(|c| c.tag == "model");
        let mut model = model.ok_or_else(|| fault(include.at, SdfFault::NoModel))?;
        if let Some(name) = child(include, "name")? {
            model.attributes.retain(|a| a.name != "name");
            model.attributes.push(xml::Attribute {
                name: "name".into(),
                value: name.text.clone(),
                at: name.at,
            });
        }
        if let Some(pose) = child(include, "pose")? {
            model.children.retain(|c| c.tag != "pose");
            model.children.push(pose.clone());
            model.attributes.retain(|a| a.name != "placement_frame");
        }
        if let Some(frame) = child(include, "placement_frame")? {
            model.attributes.retain(|a| a.name != "placement_frame");
            let value = frame.text.clone();
            model.attributes.push(xml::Attribute { name: "placement_frame".into(), value, at: frame.at });
        }
        if boolean_in(include, "static", false)? {
            model.children.retain(|c| c.tag != "static");
            model.children.extend(child(include, "static")?.cloned());
        }
        Ok(model)
    }

    /// The file of a URI: beside the including file, or in a folder of that name beside it or above.
    fn find(&self, include: &Element, uri: &str) -> Option<PathBuf> {
        let folder = self.files.all.get(include.at.file as usize)?.folder.clone();
        let name = uri.strip_prefix("model://").or(uri.strip_prefix("file://")).unwrap_or(uri);
        let above = folder.join("..");
        let places = [folder.join(name), above.join(name)];
        places.into_iter().find_map(|path| self.files.shelf.file(path, "model.sdf"))
    }
}

/// The byte offset of a line and column.
fn offset_of(text: &str, at: Location) -> usize {
    let line = text.split_inclusive('\n').take(at.line as usize - 1).map(str::len).sum::<usize>();
    let column = text[line..].char_indices().nth(at.column as usize - 1);
    column.map_or(text.len(), |(k, _)| line + k)
}

//! `<include>`: the elements of another file in its place.

use super::fault::{Fault, MjcfFault, fault};
use crate::xml::{self, Element, Files, SourceFile, Spot};
use std::collections::HashSet;
use std::path::{Path, PathBuf};

/// Deepest nesting of included files.
const MAX_DEPTH: usize = 50;

/// Files being spliced into one tree.
pub(super) struct Splicer<'a> {
    pub files: &'a mut Files,
    /// The folder of the main file: included files are looked for there first.
    pub folder: PathBuf,
    included: HashSet<PathBuf>,
}

impl<'a> Splicer<'a> {
    /// Nothing included yet but the main file.
    pub fn new(files: &'a mut Files, main: &Path) -> Self {
        let folder = main.parent().map(Path::to_owned).unwrap_or_default();
        Self { files, folder, included: HashSet::from([main.to_owned()]) }
    }

    /// The root of a text, with every include replaced by what it names.
    pub fn root(&mut self, text: String, name: &str) -> Result<Element, Fault> {
        let mut root = self.parse(text, name, &self.folder.clone())?;
        self.splice(&mut root, 0, 0)?;
        Ok(root)
    }

    fn parse(&mut self, text: String, name: &str, folder: &Path) -> Result<Element, Fault> {
        let file = self.files.all.len() as u32;
        let root = xml::parse(&text, file)
            .map_err(|(at, problem)| fault(Spot { file, offset: at.offset(&text) }, MjcfFault::Xml(problem)));
        self.files.all.push(SourceFile { name: name.to_owned(), folder: folder.to_owned(), text });
        root
    }

    /// Replaces the includes below an element, which stands so deep among elements and among files.
    fn splice(&mut self, element: &mut Element, depth: usize, nesting: usize) -> Result<(), Fault> {
        if depth > xml::MAX_DEPTH {
            let limit = xml::MAX_DEPTH;
            return Err(fault(element.at, MjcfFault::Xml(xml::XmlFault::TooDeep { limit })));
        }
        let has_include = element.children.iter().any(|c| c.tag == "include");
        if !has_include {
            return element.children.iter_mut().try_for_each(|c| self.splice(c, depth + 1, nesting));
        }
        for mut child in std::mem::take(&mut element.children) {
            if child.tag == "include" {
                element.children.extend(self.include(&child, depth, nesting)?);
            } else {
                self.splice(&mut child, depth + 1, nesting)?;
                element.children.push(child);
            }
        }
        Ok(())
    }

    /// The elements of the file that an include names, its own includes spliced.
    fn include(&mut self, include: &Element, depth: usize, nesting: usize) -> Result<Vec<Element>, Fault> {
        if nesting >= MAX_DEPTH {
            return Err(fault(include.at, MjcfFault::IncludeDepth { limit: MAX_DEPTH }));
        }
        let Some(name) = include.get("file") else {
            return Err(fault(
                include.at,
                MjcfFault::MissingAttribute { element: include.described(), name: "file" },
            ));
        };
        let at = include.spot_of("file");
        let here = self.files.all.get(include.at.file as usize).map(|f| f.folder.clone()).unwrap_or_default();
        let candidates = [self.folder.join(name), here.join(name)];
        let path = candidates.iter().find(|path| self.files.shelf.has(path)).unwrap_or(&candidates[0]);
        let known = self.files.shelf.canonical(path);
        if !self.included.insert(known) {
            return Err(fault(at, MjcfFault::IncludedTwice { file: name.to_owned() }));
        }
        let bytes = self
            .files
            .shelf
            .contents(path)
            .map_err(|problem| fault(at, MjcfFault::Include { file: name.to_owned(), fault: problem }))?;
        let text = text(bytes, self.files.all.len() as u32, path, self.files)?;
        let folder = path.parent().map(Path::to_owned).unwrap_or_default();
        let mut root = self.parse(text, &path.display().to_string(), &folder)?;
        if root.children.is_empty() {
            return Err(fault(at, MjcfFault::IncludedEmpty { file: name.to_owned() }));
        }
        self.splice(&mut root, depth, nesting + 1)?;
        Ok(root.children)
    }
}

/// The text of a file's bytes. Bytes that are no UTF-8 are a fault in that file, which is kept to be pointed into.
pub(super) fn text(bytes: Vec<u8>, file: u32, path: &Path, files: &mut Files) -> Result<String, Fault> {
    String::from_utf8(bytes).map_err(|error| {
        let offset = error.utf8_error().valid_up_to();
        let byte = error.as_bytes().get(offset).copied().unwrap_or_default();
        let text = String::from_utf8_lossy(error.as_bytes()).into_owned();
        let folder = path.parent().map(Path::to_owned).unwrap_or_default();
        files.all.push(SourceFile { name: path.display().to_string(), folder, text });
        fault(Spot { file, offset }, MjcfFault::Xml(xml::XmlFault::NotUtf8 { byte }))
    })
}

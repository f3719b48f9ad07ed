//! XML as owned elements that remember where they stand, in one file or in several.
//!
//! URDF borrows its document; MJCF splices files into one another and copies subtrees, so its elements own what they hold.

mod lenient;
mod parse;

pub(crate) use lenient::lenient;
pub use parse::XmlFault;
pub(crate) use parse::parse;

use crate::error::shortened;
use crate::file::Shelf;
use crate::location::Location;
use std::path::PathBuf;

/// Deepest nesting of elements that is read.
pub(crate) const MAX_DEPTH: usize = 500;

/// A place: a byte offset in one of the files.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) struct Spot {
    pub file: u32,
    pub offset: usize,
}

/// A file that was read: how errors call it, the folder it is in, its text.
#[derive(Debug)]
pub(crate) struct SourceFile {
    pub name: String,
    pub folder: PathBuf,
    pub text: String,
}

/// The files of one model, in the order in which they were opened, and where more may be read from.
#[derive(Debug, Default)]
pub(crate) struct Files {
    pub all: Vec<SourceFile>,
    pub shelf: Shelf,
}

impl Files {
    /// The name of a spot's file, and the line and column.
    pub fn locate(&self, spot: Spot) -> (&str, Location) {
        match self.all.get(spot.file as usize) {
            Some(file) => (&file.name, Location::at(file.text.as_bytes(), spot.offset)),
            None => ("", Location::START),
        }
    }

    /// File names, and the places of many spots: one pass over each file.
    pub fn locate_all(&self, spots: &[Spot]) -> Vec<(u32, Location)> {
        let mut order: Vec<usize> = (0..spots.len()).collect();
        order.sort_by_key(|&i| (spots[i].file, spots[i].offset));
        let mut located = vec![(0, Location::START); spots.len()];
        for group in order.chunk_by(|&a, &b| spots[a].file == spots[b].file) {
            let Some(&first) = group.first() else { continue };
            let file = spots[first].file;
            let Some(source) = self.all.get(file as usize) else { continue };
            let offsets: Vec<usize> = group.iter().map(|&i| spots[i].offset).collect();
            let places = Location::all(source.text.as_bytes(), &offsets);
            for (&i, place) in group.iter().zip(places) {
                located[i] = (file, place);
            }
        }
        located
    }
}

/// An attribute.
#[derive(Debug, Clone)]
pub(crate) struct Attribute {
    pub name: String,
    pub value: String,
    pub at: Spot,
}

/// An element.
#[derive(Debug, Clone)]
pub(crate) struct Element {
    pub tag: String,
    pub attributes: Vec<Attribute>,
    pub children: Vec<Element>,
    /// The text directly inside, trimmed.
    pub text: String,
    pub at: Spot,
}

impl Element {
    /// An attribute by name.
    pub fn find(&self, name: &str) -> Option<&Attribute> {
        self.attributes.iter().find(|a| a.name == name)
    }

    /// An attribute's text.
    pub fn get(&self, name: &str) -> Option<&str> {
        self.find(name).map(|a| a.value.as_str())
    }

    /// Where an attribute stands, the element itself without it.
    pub fn spot_of(&self, name: &str) -> Spot {
        self.find(name).map_or(self.at, |a| a.at)
    }

    /// Its children with a tag, in order.
    pub fn children_named<'a>(&'a self, tag: &'a str) -> impl Iterator<Item = &'a Element> {
        self.children.iter().filter(move |c| c.tag == tag)
    }

    /// `joint 'knee'`, or `<joint>` without a name.
    pub fn described(&self) -> String {
        match self.get("name") {
            Some(name) => format!("{} '{}'", self.tag, shortened(name)),
            None => format!("<{}>", self.tag),
        }
    }
}

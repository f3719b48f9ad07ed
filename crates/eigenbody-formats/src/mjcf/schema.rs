//! The elements of MJCF and their attributes: what is known, and what is a slip of the fingers.
//!
//! `schema.txt` lists them as MuJoCo 4.0 prints them, an element a line, indented below its parent: tag, how often it may
//! stand there (`!` once, `?` at most once, `*` any number, `R` any number and inside itself), attributes.

use super::fault::{Fault, MjcfFault, fault};
use crate::error::shortened;
use crate::suggest::did_you_mean;
use crate::xml::Element;
use std::sync::OnceLock;

const TEXT: &str = include_str!("schema.txt");

/// An element of the language.
struct Entry {
    tag: &'static str,
    often: &'static str,
    attributes: Vec<&'static str>,
    children: Vec<Entry>,
}

/// Attributes that only these relatives of <body> have.
const FRAME: [&str; 8] = ["name", "childclass", "pos", "quat", "axisangle", "xyaxes", "zaxis", "euler"];
const REPLICATE: [&str; 5] = ["count", "offset", "euler", "sep", "childclass"];

/// Refuses what is no MJCF, at its place.
pub(super) fn check(root: &Element) -> Result<(), Fault> {
    static SCHEMA: OnceLock<Entry> = OnceLock::new();
    let schema = SCHEMA.get_or_init(|| {
        let lines: Vec<&'static str> = TEXT.lines().collect();
        entry(&lines, &mut 0)
    });
    schema.check(root)
}

/// The entry at a line, and those indented below it.
fn entry(lines: &[&'static str], next: &mut usize) -> Entry {
    let depth = |line: &str| line.len() - line.trim_start().len();
    let line = lines[*next];
    *next += 1;
    let mut words = line.split_whitespace();
    let (tag, often) = (words.next().unwrap_or_default(), words.next().unwrap_or_default());
    let mut found = Entry { tag, often, attributes: words.collect(), children: Vec::new() };
    while *next < lines.len() && depth(lines[*next]) > depth(line) {
        found.children.push(entry(lines, next));
    }
    found
}

impl Entry {
    fn check(&self, element: &Element) -> Result<(), Fault> {
        let tag = &element.tag;
        let known: &[&str] = match tag.as_str() {
            "frame" if self.tag == "body" => &FRAME,
            "replicate" if self.tag == "body" => &REPLICATE,
            "worldbody" => &[],
            _ => &self.attributes,
        };
        if let Some(attribute) = element.attributes.iter().find(|a| !known.contains(&a.name.as_str())) {
            let suggestion = did_you_mean(&attribute.name, known.iter().copied());
            let (name, tag) = (shortened(&attribute.name), tag.clone());
            return Err(fault(attribute.at, MjcfFault::UnknownAttribute { name, tag, suggestion }));
        }
        let mut counts = vec![0; self.children.len()];
        for child in &element.children {
            if self.is_recursive_child(child) {
                self.check(child)?;
                continue;
            }
            let Some(k) = self.children.iter().position(|entry| entry.accepts(&child.tag)) else {
                return Err(self.unknown(element, child));
            };
            counts[k] += 1;
            if counts[k] > 1 && matches!(self.children[k].often, "?" | "!") {
                let (tag, parent) = (shortened(&child.tag), element.tag.clone());
                return Err(fault(child.at, MjcfFault::SecondChild { tag, parent }));
            }
            self.children[k].check(child)?;
        }
        Ok(())
    }

    /// True for the entry's own tag. Below the root, <worldbody> and its relatives stand for <body>; MuJoCo accepts the
    /// relatives there and passes them over.
    fn accepts(&self, tag: &str) -> bool {
        match self.tag {
            "body" => matches!(tag, "worldbody" | "body" | "frame" | "replicate"),
            own => own == tag,
        }
    }

    fn is_recursive_child(&self, child: &Element) -> bool {
        match self.tag {
            "body" => matches!(child.tag.as_str(), "body" | "frame" | "replicate"),
            own => self.often == "R" && own == child.tag,
        }
    }

    fn unknown(&self, parent: &Element, child: &Element) -> Fault {
        let relatives: &[&str] = if self.tag == "body" { &["body", "frame", "replicate"] } else { &[] };
        let known = self.children.iter().map(|e| if e.tag == "body" { "worldbody" } else { e.tag });
        let suggestion = did_you_mean(&child.tag, known.chain(relatives.iter().copied()));
        let (tag, parent) = (shortened(&child.tag), parent.tag.clone());
        fault(child.at, MjcfFault::UnknownElement { tag, parent, suggestion })
    }
}

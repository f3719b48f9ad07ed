//! `<default>`: classes of attributes, nested.

use super::fault::{Fault, MjcfFault, fault};
use crate::suggest::did_you_mean;
use crate::xml::{Attribute, Element, Files};
use std::collections::HashMap;

/// A class of default attributes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Class(usize);

/// The outermost class.
pub(super) const MAIN: Class = Class(0);

/// The classes of a document.
pub(super) struct Defaults<'a> {
    classes: Vec<Entry<'a>>,
    by_name: HashMap<&'a str, usize>,
}

struct Entry<'a> {
    parent: Option<usize>,
    /// What the class says of each element; a later one goes before an earlier one.
    elements: Vec<&'a Element>,
    at: Option<&'a Element>,
}

/// An element with the class that speaks where it is silent.
#[derive(Clone, Copy)]
pub(super) struct Styled<'a> {
    pub element: &'a Element,
    class: Class,
    /// The tags by which classes speak of it; none for its own.
    tags: &'static [&'static str],
    defaults: &'a Defaults<'a>,
}

impl<'a> Defaults<'a> {
    /// All `<default>` elements of a document.
    pub fn read(root: &'a Element, files: &Files) -> Result<Self, Fault> {
        let main = Entry { parent: None, elements: Vec::new(), at: None };
        let mut found = Self { classes: vec![main], by_name: HashMap::from([("main", 0)]) };
        for element in root.children_named("default") {
            if let Some(name) = element.get("class").filter(|name| !matches!(*name, "" | "main")) {
                let name = name.to_owned();
                return Err(fault(element.spot_of("class"), MjcfFault::RenamedMain { name }));
            }
            found.fill(0, element, files)?;
        }
        Ok(found)
    }

    fn fill(&mut self, class: usize, element: &'a Element, files: &Files) -> Result<(), Fault> {
        let plain = element.children.iter().filter(|c| c.tag != "default");
        self.classes[class].elements.extend(plain);
        for child in element.children_named("default") {
            let Some(name) = child.get("class").filter(|name| !name.is_empty()) else {
                return Err(fault(child.at, MjcfFault::UnnamedClass));
            };
            if let Some(&first) = self.by_name.get(name) {
                let first = files.locate(self.classes[first].at.map_or(root_spot(child), |e| e.at)).1;
                let name = name.to_owned();
                return Err(fault(child.spot_of("class"), MjcfFault::SecondClass { name, first }));
            }
            let id = self.classes.len();
            self.classes.push(Entry { parent: Some(class), elements: Vec::new(), at: Some(child) });
            self.by_name.insert(name, id);
            self.fill(id, child, files)?;
        }
        Ok(())
    }

    /// The class that an attribute of an element names, if it has that attribute.
    pub fn named(&self, element: &Element, attribute: &str) -> Result<Option<Class>, Fault> {
        let Some(attribute) = element.find(attribute) else { return Ok(None) };
        match self.by_name.get(attribute.value.as_str()) {
            Some(&id) => Ok(Some(Class(id))),
            None => {
                let name = attribute.value.clone();
                let suggestion = did_you_mean(&name, self.by_name.keys().copied());
                Err(fault(attribute.at, MjcfFault::UnknownClass { name, suggestion }))
            }
        }
    }

    /// An element in the class it names, or in that of what it stands in.
    pub fn styled(&'a self, element: &'a Element, outer: Class) -> Result<Styled<'a>, Fault> {
        self.styled_as(element, outer, &[])
    }

    /// The same where classes speak of the element by other tags than its own.
    pub fn styled_as(
        &'a self,
        element: &'a Element,
        outer: Class,
        tags: &'static [&'static str],
    ) -> Result<Styled<'a>, Fault> {
        let class = self.named(element, "class")?.unwrap_or(outer);
        Ok(Styled { element, class, tags, defaults: self })
    }
}

fn root_spot(element: &Element) -> crate::xml::Spot {
    crate::xml::Spot { offset: 0, ..element.at }
}

impl<'a> Styled<'a> {
    /// The elements that speak for this one, nearest first: itself, then those of its class, then of the class around that.
    pub fn layers(&self) -> impl Iterator<Item = &'a Element> + use<'a> {
        let (classes, tag, tags) = (&self.defaults.classes, self.element.tag.as_str(), self.tags);
        let speaks =
            move |e: &&Element| if tags.is_empty() { e.tag == tag } else { tags.contains(&e.tag.as_str()) };
        let chain = std::iter::successors(Some(self.class.0), |&id| classes[id].parent);
        let of_class = chain.flat_map(move |id| classes[id].elements.iter().rev().copied().filter(speaks));
        std::iter::once(self.element).chain(of_class)
    }

    /// An attribute, its own or its class's.
    pub fn find(&self, name: &str) -> Option<&'a Attribute> {
        self.layers().find_map(|e| e.find(name))
    }
}

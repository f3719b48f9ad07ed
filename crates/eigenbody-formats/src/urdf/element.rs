//! An XML element read by its tag, attributes and numbers, with located faults.

use super::fault::UrdfFault;
use crate::error::shortened;
use crate::location::Location;
use roxmltree::{Attribute, Node};

/// A fault and the byte offset of what it is about.
pub(crate) struct Fault {
    pub offset: usize,
    pub fault: UrdfFault,
}

/// An element of the document.
#[derive(Clone, Copy)]
pub(crate) struct Element<'a, 'i>(pub Node<'a, 'i>);

impl<'a, 'i: 'a> Element<'a, 'i> {
    /// Its name, without a namespace.
    pub fn tag(self) -> &'a str {
        self.0.tag_name().name()
    }

    /// Where it begins.
    pub fn offset(self) -> usize {
        self.0.range().start
    }

    /// Where it begins, as line and column. Cost: one pass over the text before it.
    pub fn location(self) -> Location {
        Location::at(self.0.document().input_text().as_bytes(), self.offset())
    }

    /// A fault at this element.
    pub fn fault(self, fault: UrdfFault) -> Fault {
        Fault { offset: self.offset(), fault }
    }

    /// Its children with a tag of its own namespace, in order.
    pub fn children(self, tag: &'a str) -> impl Iterator<Item = Self> {
        let namespace = self.0.tag_name().namespace();
        let wanted = move |n: &Node<'_, '_>| {
            n.is_element() && n.tag_name().name() == tag && n.tag_name().namespace() == namespace
        };
        self.0.children().filter(wanted).map(Self)
    }

    /// Its only child with a tag, if it has one; two are a fault.
    pub fn child(self, tag: &'a str) -> Result<Option<Self>, Fault> {
        let mut found = self.children(tag);
        let first = found.next();
        match found.next() {
            None => Ok(first),
            Some(second) => {
                let (tag, parent) = (tag.to_owned(), self.tag().to_owned());
                Err(second.fault(UrdfFault::SecondChild { tag, parent }))
            }
        }
    }

    /// Its only child with a tag; none is a fault.
    pub fn required_child(self, tag: &'a str) -> Result<Self, Fault> {
        let missing =
            || self.fault(UrdfFault::MissingElement { parent: self.described(), tag: tag.to_owned() });
        self.child(tag)?.ok_or_else(missing)
    }

    fn find(self, name: &str) -> Option<Attribute<'a, 'i>> {
        self.0.attributes().find(|a| a.name() == name && a.namespace().is_none())
    }

    /// An attribute's text; none is a fault.
    pub fn attribute(self, name: &str) -> Result<&'a str, Fault> {
        let missing = || UrdfFault::MissingAttribute { element: self.described(), name: name.to_owned() };
        self.find(name).map(|a| a.value()).ok_or_else(|| self.fault(missing()))
    }

    /// A fault at an attribute.
    pub fn fault_at(self, name: &str, fault: UrdfFault) -> Fault {
        let offset = self.find(name).map_or(self.offset(), |a| a.range().start);
        Fault { offset, fault }
    }

    /// An attribute that holds K finite numbers, if it is there.
    pub fn numbers<const K: usize>(self, name: &str) -> Result<Option<[f64; K]>, Fault> {
        let Some(attribute) = self.find(name) else { return Ok(None) };
        let what = || format!("'{name}' of <{}>", self.tag());
        let fault = |fault| Fault { offset: attribute.range().start, fault };
        let (mut numbers, mut found) = ([0.0; K], 0);
        for word in attribute.value().split_whitespace() {
            // The words inf and nan are numbers to Rust, not to a robot.
            let number = word.parse().ok().filter(|x: &f64| x.is_finite());
            let not_finite = || fault(UrdfFault::NotFinite { what: what(), text: shortened(word) });
            let number = number.ok_or_else(not_finite)?;
            if let Some(slot) = numbers.get_mut(found) {
                *slot = number;
            }
            found += 1;
        }
        match found == K {
            true => Ok(Some(numbers)),
            false => Err(fault(UrdfFault::NumberCount { what: what(), found, expected: K })),
        }
    }

    /// An attribute that holds one finite number, if it is there.
    pub fn number(self, name: &str) -> Result<Option<f64>, Fault> {
        Ok(self.numbers(name)?.map(|[x]| x))
    }

    /// An attribute that holds one finite number; none is a fault.
    pub fn required_number(self, name: &str) -> Result<f64, Fault> {
        self.attribute(name)?;
        Ok(self.number(name)?.unwrap_or_default())
    }

    /// `<link name="arm">`, `<mass>`: enough to recognise it.
    pub fn described(self) -> String {
        match self.find("name") {
            Some(name) => format!("{} '{}'", self.tag(), shortened(name.value())),
            None => format!("<{}>", self.tag()),
        }
    }
}

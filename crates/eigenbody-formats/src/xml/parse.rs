//! Text to elements.

use super::lenient::lenient;
use super::{Attribute, Element, MAX_DEPTH, Spot};
use crate::location::Location;
use roxmltree::{Document, Node, ParsingOptions};
use thiserror::Error;

/// A text that is no XML that can be read.
#[derive(Debug, Clone, PartialEq, Error)]
#[allow(missing_docs)] // the messages say it all
pub enum XmlFault {
    #[error("byte 0x{byte:02x} is not UTF-8 text")]
    NotUtf8 { byte: u8 },
    #[error("not well-formed XML: {0}")]
    NotXml(String),
    #[error("document type declarations (<!DOCTYPE .. [..]>) are refused")]
    Doctype,
    #[error("elements are nested deeper than {limit}")]
    TooDeep { limit: usize },
}

impl From<roxmltree::Error> for XmlFault {
    fn from(error: roxmltree::Error) -> Self {
        match error {
            roxmltree::Error::DtdDetected => Self::Doctype,
            // The place is printed before the message already.
            _ => Self::NotXml(error.to_string().replace(&format!(" at {}", error.pos()), "")),
        }
    }
}

/// The root element of a text; `file` is its number among the model's files.
pub(crate) fn parse(text: &str, file: u32) -> Result<Element, (Location, XmlFault)> {
    let text = lenient(text);
    let text = text.as_ref();
    // No document type declarations: no entities to expand.
    let options = ParsingOptions { allow_dtd: false, ..Default::default() };
    let document = Document::parse_with_options(text, options).map_err(|error| {
        let at = error.pos();
        (Location { line: at.row, column: at.col }, XmlFault::from(error))
    })?;
    element(document.root_element(), file, 0)
}

fn element(node: Node<'_, '_>, file: u32, depth: usize) -> Result<Element, (Location, XmlFault)> {
    let spot = |offset| Spot { file, offset };
    if depth > MAX_DEPTH {
        let at = Location::at(node.document().input_text().as_bytes(), node.range().start);
        return Err((at, XmlFault::TooDeep { limit: MAX_DEPTH }));
    }
    let attribute = |a: roxmltree::Attribute<'_, '_>| Attribute {
        name: a.name().to_owned(),
        value: a.value().to_owned(),
        at: spot(a.range().start),
    };
    let below = node.children().filter(Node::is_element).map(|child| element(child, file, depth + 1));
    Ok(Element {
        tag: node.tag_name().name().to_owned(),
        attributes: node.attributes().map(attribute).collect(),
        children: below.collect::<Result<_, _>>()?,
        text: node.text().unwrap_or_default().trim().to_owned(),
        at: spot(node.range().start),
    })
}

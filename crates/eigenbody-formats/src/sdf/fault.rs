//! What can be wrong at one place of an SDF file.

use crate::error::{FileFault, shortened};
use crate::location::Location;
use crate::xml::{Element, Spot, XmlFault};
use eigenbody::BuildError;
use thiserror::Error;

/// What is wrong at one place of an SDF file.
#[derive(Debug, Clone, PartialEq, Error)]
#[allow(missing_docs)] // the messages say it all
pub enum SdfFault {
    #[error("{0}")]
    Xml(#[from] XmlFault),
    #[error("no SDF: the root element is <{tag}>, expected <sdf>")]
    Root { tag: String },
    #[error("<sdf> has version '{found}', expected 1.x")]
    Version { found: String },
    #[error("<sdf> holds no <model> and no <world>")]
    NoModel,
    #[error("{element} has no attribute '{name}'")]
    MissingAttribute { element: String, name: &'static str },
    #[error("{parent} has no <{tag}>")]
    MissingElement { parent: String, tag: &'static str },
    #[error("a second <{tag}> in one <{parent}>")]
    SecondChild { tag: String, parent: String },
    #[error("<{tag}> holds '{text}', expected {expected}")]
    Value { tag: String, text: String, expected: String },
    #[error("the name '{name}' holds '::', which separates names of models")]
    Separator { name: String },
    #[error("a second link, joint, frame or model is named '{name}'; the first is at {first}")]
    SecondName { name: String, first: Location },
    #[error("no link, joint, frame or model is named '{name}' here{suggestion}")]
    UnknownName { name: String, suggestion: String },
    #[error("no link is named '{name}' here{suggestion}")]
    UnknownLink { name: String, suggestion: String },
    #[error("the pose of '{name}' is relative to itself, directly or through others")]
    PoseLoop { name: String },
    #[error("'{name}' is attached to no link")]
    NoLink { name: String },
    #[error(
        "joint '{joint}' has type '{found}', expected one of revolute, continuous, prismatic, revolute2, universal, ball, fixed"
    )]
    JointType { joint: String, found: String },
    #[error("joint '{joint}' moves the world: its child is 'world'")]
    WorldChild { joint: String },
    #[error("{what} cannot be read: {why}")]
    Unsupported { what: String, why: &'static str },
    #[error("'{uri}' cannot be included: {fault}")]
    Include { uri: String, fault: FileFault },
    #[error("'{uri}' includes itself, or more than {limit} files are included")]
    IncludeLoop { uri: String, limit: usize },
    #[error("{0}")]
    Build(BuildError),
}

/// A fault and where it is.
#[derive(Debug)]
pub(super) struct Fault {
    pub at: Spot,
    pub fault: SdfFault,
}

/// A fault at a place.
pub(super) fn fault(at: Spot, fault: SdfFault) -> Fault {
    Fault { at, fault }
}

/// The x of version 1.x; 9 where a file says nothing.
pub(super) fn minor_version(root: &Element) -> Result<u32, Fault> {
    let Some(version) = root.find("version") else { return Ok(9) };
    let minor = version.value.strip_prefix("1.").and_then(|minor| minor.parse().ok());
    minor.ok_or_else(|| fault(version.at, SdfFault::Version { found: shortened(&version.value) }))
}

/// Says that an element means more than this reader can do.
pub(super) fn unsupported(element: &Element, why: &'static str) -> Fault {
    fault(element.at, SdfFault::Unsupported { what: element.described(), why })
}

/// The only child with a tag, if there is one.
pub(super) fn child<'a>(element: &'a Element, tag: &'a str) -> Result<Option<&'a Element>, Fault> {
    let mut found = element.children_named(tag);
    let first = found.next();
    match found.next() {
        None => Ok(first),
        Some(second) => {
            let (tag, parent) = (tag.to_owned(), element.tag.clone());
            Err(fault(second.at, SdfFault::SecondChild { tag, parent }))
        }
    }
}

/// The only child with a tag.
pub(super) fn required<'a>(element: &'a Element, tag: &'static str) -> Result<&'a Element, Fault> {
    let missing = || fault(element.at, SdfFault::MissingElement { parent: element.described(), tag });
    child(element, tag)?.ok_or_else(missing)
}

/// An element's name.
pub(super) fn name(element: &Element) -> Result<&str, Fault> {
    let missing =
        || fault(element.at, SdfFault::MissingAttribute { element: element.described(), name: "name" });
    let name = element.get("name").ok_or_else(missing)?;
    match name.contains("::") {
        true => Err(fault(element.spot_of("name"), SdfFault::Separator { name: name.to_owned() })),
        false => Ok(name),
    }
}

/// All finite numbers of an element's text.
pub(super) fn numbers(element: &Element) -> Result<Vec<f64>, Fault> {
    let number = |word: &str| {
        let value = word.parse().ok().filter(|x: &f64| x.is_finite());
        value.ok_or_else(|| value_fault(element, word, "a finite number"))
    };
    element.text.split_whitespace().map(number).collect()
}

/// K finite numbers.
pub(super) fn array<const K: usize>(element: &Element) -> Result<[f64; K], Fault> {
    let found = numbers(element)?;
    found.try_into().map_err(|_| value_fault(element, &element.text, &format!("{K} numbers")))
}

/// The number in a child, or what stands for it.
pub(super) fn number_in(element: &Element, tag: &str, default: f64) -> Result<f64, Fault> {
    match child(element, tag)? {
        None => Ok(default),
        Some(child) => array(child).map(|[x]| x),
    }
}

/// The truth in a child, or what stands for it.
pub(super) fn boolean_in(element: &Element, tag: &str, default: bool) -> Result<bool, Fault> {
    match child(element, tag)? {
        None => Ok(default),
        Some(child) => match child.text.to_ascii_lowercase().as_str() {
            "true" | "1" => Ok(true),
            "false" | "0" => Ok(false),
            _ => Err(value_fault(child, &child.text, "true or false")),
        },
    }
}

/// An element's text is something else than what is expected.
pub(super) fn value_fault(element: &Element, text: &str, expected: &str) -> Fault {
    let (tag, text) = (element.tag.clone(), shortened(text));
    fault(element.at, SdfFault::Value { tag, text, expected: expected.to_owned() })
}

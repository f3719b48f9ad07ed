//! What can be wrong at one place of a URDF file.

use super::element::{Element, Fault};
use crate::error::numbers_of;
use crate::location::Location;
use eigenbody::BuildError;
use thiserror::Error;

/// What is wrong at one place of a URDF file.
#[derive(Debug, Clone, PartialEq, Error)]
#[allow(missing_docs)] // the messages say it all
pub enum UrdfFault {
    #[error("byte 0x{byte:02x} is not UTF-8 text")]
    NotUtf8 { byte: u8 },
    #[error("not well-formed XML: {0}")]
    NotXml(String),
    #[error("document type declarations (<!DOCTYPE .. [..]>) are refused")]
    Doctype,
    #[error("no URDF: the root element <{tag}> is that of an {format} file")]
    OtherFormat { tag: String, format: &'static str },
    #[error("no URDF: the root element is <{tag}>, expected <robot>")]
    NotRobot { tag: String },
    #[error("<{tag}> is a xacro macro; expand the file with xacro first")]
    Xacro { tag: String },
    #[error("{element} has no attribute '{name}'")]
    MissingAttribute { element: String, name: String },
    #[error("{parent} has no <{tag}>")]
    MissingElement { parent: String, tag: String },
    #[error("a second <{tag}> in one <{parent}>")]
    SecondChild { tag: String, parent: String },
    #[error("{what} holds '{text}', expected a finite number")]
    NotFinite { what: String, text: String },
    #[error("{what} holds {}, expected {expected}", numbers_of(*found))]
    NumberCount { what: String, found: usize, expected: usize },
    #[error("'quat_xyzw' of <origin> has norm {norm}, expected a unit quaternion x y z w")]
    NotUnitQuaternion { norm: f64 },
    #[error("<origin> has both 'rpy' and 'quat_xyzw', expected one orientation")]
    TwoOrientations,
    #[error(
        "joint '{joint}' has type '{found}', expected one of revolute, continuous, prismatic, fixed, floating, planar"
    )]
    JointType { joint: String, found: String },
    #[error("joint '{joint}' names {role} link '{link}', which is not in the file{suggestion}")]
    UnknownLink { joint: String, role: &'static str, link: String, suggestion: String },
    #[error("{error}; the first is at {first}")]
    Duplicate { error: BuildError, first: Location },
    #[error("the name '{name}' is that of the floating base's own joint; rename this joint")]
    ReservedName { name: String },
    #[error("{0}")]
    Build(BuildError),
}

impl From<roxmltree::Error> for UrdfFault {
    fn from(error: roxmltree::Error) -> Self {
        match error {
            roxmltree::Error::DtdDetected => Self::Doctype,
            // The place is printed before the message already.
            _ => Self::NotXml(error.to_string().replace(&format!(" at {}", error.pos()), "")),
        }
    }
}

/// Refuses a document that is no URDF, naming the format that it is.
pub(super) fn check_root(root: Element<'_, '_>) -> Result<(), Fault> {
    let fault = match root.tag() {
        "robot" => match root.0.children().find(|n| is_xacro(n)) {
            None => return Ok(()),
            Some(node) => {
                let tag = format!("xacro:{}", node.tag_name().name());
                return Err(Element(node).fault(UrdfFault::Xacro { tag }));
            }
        },
        tag @ ("mujoco" | "mujocoinclude") => UrdfFault::OtherFormat { tag: tag.to_owned(), format: "MJCF" },
        tag @ "sdf" => UrdfFault::OtherFormat { tag: tag.to_owned(), format: "SDF" },
        tag => UrdfFault::NotRobot { tag: tag.to_owned() },
    };
    Err(root.fault(fault))
}

fn is_xacro(node: &roxmltree::Node<'_, '_>) -> bool {
    node.is_element() && node.tag_name().namespace().is_some_and(|uri| uri.contains("xacro"))
}

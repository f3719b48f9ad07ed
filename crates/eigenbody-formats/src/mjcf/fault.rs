//! What can be wrong at one place of an MJCF file.

use super::mesh::MeshFault;
use crate::error::{FileFault, numbers_of};
use crate::location::Location;
use crate::xml::{Element, Spot, XmlFault};
use eigenbody::{BuildError, InputError};
use thiserror::Error;

/// What is wrong at one place of an MJCF file.
#[derive(Debug, Clone, PartialEq, Error)]
#[allow(missing_docs)] // the messages say it all
pub enum MjcfFault {
    #[error("{0}")]
    Xml(#[from] XmlFault),
    #[error("no MJCF: the root element is <{tag}>, expected <mujoco>")]
    Root { tag: String },
    #[error("<{parent}> has no element <{tag}>{suggestion}")]
    UnknownElement { tag: String, parent: String, suggestion: String },
    #[error("<{tag}> has no attribute '{name}'{suggestion}")]
    UnknownAttribute { name: String, tag: String, suggestion: String },
    #[error("a second <{tag}> in one <{parent}>")]
    SecondChild { tag: String, parent: String },
    #[error("{element} has no attribute '{name}'")]
    MissingAttribute { element: String, name: &'static str },
    #[error("'{name}' of <{tag}> holds '{text}', expected {expected}")]
    Value { name: String, tag: String, text: String, expected: String },
    #[error("'{name}' of <{tag}> holds {}, expected {expected}", numbers_of(*found))]
    NumberCount { name: String, tag: String, found: usize, expected: String },
    #[error("'{file}' cannot be included: {fault}")]
    Include { file: String, fault: FileFault },
    #[error("'{file}' is included already; a file is included once, and not in itself")]
    IncludedTwice { file: String },
    #[error("'{file}' is included, but has no elements")]
    IncludedEmpty { file: String },
    #[error("includes are nested deeper than {limit}")]
    IncludeDepth { limit: usize },
    #[error("the default class has no name; only the outermost may have none")]
    UnnamedClass,
    #[error("the outermost default class is named '{name}', expected 'main' or no name")]
    RenamedMain { name: String },
    #[error("a second default class is named '{name}'; the first is at {first}")]
    SecondClass { name: String, first: Location },
    #[error("no default class is named '{name}'{suggestion}")]
    UnknownClass { name: String, suggestion: String },
    #[error("no {kind} is named '{name}'{suggestion}")]
    Unknown { kind: String, name: String, suggestion: String },
    #[error("a second {kind} is named '{name}'; the first is at {first}")]
    Second { kind: String, name: String, first: Location },
    #[error("{element} acts on nothing, expected one of joint, jointinparent, tendon, site, body, cranksite")]
    NoTarget { element: String },
    #[error("{what} cannot be read: {why}")]
    Unsupported { what: String, why: &'static str },
    #[error("{element} has '{first}' and '{second}', expected one orientation")]
    TwoOrientations { element: String, first: String, second: String },
    #[error("'{name}' of <{tag}> is too short to give a direction")]
    NoDirection { name: String, tag: String },
    #[error("{0} cannot stand in the world body, which is fixed")]
    World(String),
    #[error("{element} cannot stand directly in a <replicate>: the joint would be on the body outside it")]
    ReplicatedJoint { element: String },
    #[error("{element}: size {index} is {value}, expected more than 0 for a {kind}")]
    Size { element: String, index: usize, value: f64, kind: &'static str },
    #[error("{element}: {problem}")]
    Shape { element: String, problem: &'static str },
    #[error("mesh '{name}': {fault}")]
    Mesh { name: String, fault: Box<MeshFault> },
    #[error("{element}: mass {mass}, inertia {inertia:?} and density may not be negative")]
    NegativeMass { element: String, mass: f64, inertia: [f64; 3] },
    #[error("{element} has {problem}")]
    Inertial { element: String, problem: &'static str },
    #[error("body '{body}' has more than 6 degrees of freedom")]
    TooManyDofs { body: String },
    #[error("body '{body}' has a rotation after a ball joint, which has all rotations already")]
    RotationAfterBall { body: String },
    #[error("{joint} is free, so its body must stand in the world body")]
    FreeBelow { joint: String },
    #[error("{element} has a range but does not say limited=\"true\" or \"false\", and autolimits is off")]
    AutoLimits { element: String },
    #[error("{element}: range {lower} {upper} is empty, expected the lower limit first")]
    EmptyRange { element: String, lower: f64, upper: f64 },
    #[error("more than {limit} bodies")]
    TooManyBodies { limit: usize },
    #[error("more than {limit} geoms")]
    TooManyGeoms { limit: usize },
    #[error("more than {limit} attachments")]
    TooManyAttachments { limit: usize },
    #[error("no body or frame is named '{name}' to attach{suggestion}")]
    NothingToAttach { name: String, suggestion: String },
    #[error("key '{name}': qpos holds {}, expected {expected}", numbers_of(*found))]
    KeyLength { name: String, found: usize, expected: usize },
    #[error("key '{name}': the quaternion of joint '{joint}' is zero")]
    KeyQuaternion { name: String, joint: String },
    #[error("the floating base has {0}")]
    Base(InputError),
    #[error("{0}")]
    Build(BuildError),
}

/// A fault and where it is.
#[derive(Debug)]
pub(super) struct Fault {
    pub at: Spot,
    pub fault: MjcfFault,
}

/// A fault at a place.
pub(super) fn fault(at: Spot, fault: MjcfFault) -> Fault {
    Fault { at, fault }
}

/// Says that an element means more than this reader can do.
pub(super) fn unsupported(element: &Element, why: &'static str) -> Fault {
    fault(element.at, MjcfFault::Unsupported { what: element.described(), why })
}

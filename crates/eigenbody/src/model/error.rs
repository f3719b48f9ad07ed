//! Why a model cannot be built.

use super::builder::{JointId, LinkId};
use thiserror::Error;

/// The part of the model that an error or a finding is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// The model as a whole.
    Model,
    /// One link.
    Link(LinkId),
    /// One joint.
    Joint(JointId),
}

/// A description that is no kinematic tree of rigid bodies.
#[derive(Debug, Clone, PartialEq, Error)]
#[allow(missing_docs)] // the messages say it all
pub enum BuildError {
    #[error("the model has no links")]
    NoLinks,
    #[error("{count} bodies, more than the limit of {limit}")]
    TooManyBodies { count: usize, limit: usize },
    #[error("gravity is not a finite vector")]
    GravityNotFinite,
    #[error("joint '{name}' is on link number {}, counted from 0, and there are {count}", link.index())]
    UnknownLink { joint: JointId, name: String, link: LinkId, count: usize },
    #[error("a second link is named '{name}'")]
    DuplicateLink { link: LinkId, name: String },
    #[error("a second joint is named '{name}'")]
    DuplicateJoint { joint: JointId, name: String },
    #[error(
        "link '{link_name}' is the child of joint '{first}' and of joint '{second_name}'; in a tree a link has one parent"
    )]
    TwoParents { second: JointId, link_name: String, first: String, second_name: String },
    #[error("joint '{name}' closes a loop: its child link '{child}' is among its own ancestors")]
    Loop { joint: JointId, name: String, child: String },
    #[error("two root links, '{first}' and '{second_name}'; a tree has one link that is no joint's child")]
    TwoRoots { second: LinkId, first: String, second_name: String },
    #[error("{what} of link '{name}' is not a finite number")]
    LinkNotFinite { link: LinkId, name: String, what: &'static str },
    #[error("link '{name}' has mass {mass}, expected zero or more (kg)")]
    NegativeMass { link: LinkId, name: String, mass: f64 },
    #[error("{what} of joint '{name}' is not a finite number")]
    JointNotFinite { joint: JointId, name: String, what: &'static str },
    #[error("joint '{name}' has an orientation that is no rotation")]
    NotARotation { joint: JointId, name: String },
    #[error("joint '{name}' has axis 0 0 0, expected a direction")]
    ZeroAxis { joint: JointId, name: String },
    #[error(
        "joint '{name}' has {found} armature values, expected {expected}: one a degree of freedom, or none"
    )]
    ArmatureLength { joint: JointId, name: String, expected: usize, found: usize },
    #[error("joint '{name}' has armature {armature}, expected zero or more (kg m² or kg)")]
    NegativeArmature { joint: JointId, name: String, armature: f64 },
    #[error("joint '{name}' has lower limit {lower} above upper limit {upper}")]
    CrossedLimits { joint: JointId, name: String, lower: f64, upper: f64 },
    #[error("joint '{name}' mimics itself, directly or through others")]
    MimicLoop { joint: JointId, name: String },
    #[error("joint '{name}' of kind {kind} cannot mimic another: only joints with one coordinate can")]
    MimicKind { joint: JointId, name: String, kind: &'static str },
}

impl BuildError {
    /// The link or joint to point at.
    pub fn place(&self) -> Place {
        match *self {
            Self::NoLinks | Self::TooManyBodies { .. } | Self::GravityNotFinite => Place::Model,
            Self::DuplicateLink { link, .. }
            | Self::TwoRoots { second: link, .. }
            | Self::LinkNotFinite { link, .. }
            | Self::NegativeMass { link, .. } => Place::Link(link),
            Self::UnknownLink { joint, .. }
            | Self::DuplicateJoint { joint, .. }
            | Self::TwoParents { second: joint, .. }
            | Self::Loop { joint, .. }
            | Self::JointNotFinite { joint, .. }
            | Self::NotARotation { joint, .. }
            | Self::ZeroAxis { joint, .. }
            | Self::ArmatureLength { joint, .. }
            | Self::NegativeArmature { joint, .. }
            | Self::CrossedLimits { joint, .. }
            | Self::MimicLoop { joint, .. }
            | Self::MimicKind { joint, .. } => Place::Joint(joint),
        }
    }
}

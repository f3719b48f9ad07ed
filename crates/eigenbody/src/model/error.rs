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
#[non_exhaustive]
pub enum BuildError {
    /// A description without links.
    #[error("the model has no links")]
    NoLinks,
    /// More bodies than a model may have.
    #[error("{count} bodies, more than the limit of {limit}")]
    TooManyBodies {
        /// How many there are.
        count: usize,
        /// How many there may be.
        limit: usize,
    },
    /// Gravity has a NaN or an infinity.
    #[error("gravity is not a finite vector")]
    GravityNotFinite,
    /// A joint on a link that was not added: its number is from another builder.
    #[error("joint '{name}' is on link number {}, counted from 0, and there are {count}", link.index())]
    UnknownLink {
        /// The joint.
        joint: JointId,
        /// Its name.
        name: String,
        /// The link's number.
        link: LinkId,
        /// How many links there are.
        count: usize,
    },
    /// A link with the name of another.
    #[error("a second link is named '{name}'")]
    DuplicateLink {
        /// The link.
        link: LinkId,
        /// Its name.
        name: String,
    },
    /// A joint with the name of another.
    #[error("a second joint is named '{name}'")]
    DuplicateJoint {
        /// The joint.
        joint: JointId,
        /// Its name.
        name: String,
    },
    /// Two joints carry one link.
    #[error(
        "link '{link_name}' is the child of joint '{first}' and of joint '{second_name}'; in a tree a link has one parent"
    )]
    TwoParents {
        /// The second one.
        second: JointId,
        /// The link's name.
        link_name: String,
        /// The first one's name.
        first: String,
        /// The second one's name.
        second_name: String,
    },
    /// Joints in a circle.
    #[error("joint '{name}' closes a loop: its child link '{child}' is among its own ancestors")]
    Loop {
        /// The joint.
        joint: JointId,
        /// Its name.
        name: String,
        /// The name of the link that the joint carries.
        child: String,
    },
    /// Two links that no joint carries.
    #[error("two root links, '{first}' and '{second_name}'; a tree has one link that is no joint's child")]
    TwoRoots {
        /// The second one.
        second: LinkId,
        /// The first one's name.
        first: String,
        /// The second one's name.
        second_name: String,
    },
    /// A NaN or an infinity in a link's inertia.
    #[error("{what} of link '{name}' is not a finite number")]
    LinkNotFinite {
        /// The link.
        link: LinkId,
        /// Its name.
        name: String,
        /// Which of them.
        what: &'static str,
    },
    /// A mass below zero.
    #[error("link '{name}' has mass {mass}, expected zero or more (kg)")]
    NegativeMass {
        /// The link.
        link: LinkId,
        /// Its name.
        name: String,
        /// The mass (kg).
        mass: f64,
    },
    /// A NaN or an infinity in a joint's numbers.
    #[error("{what} of joint '{name}' is not a finite number")]
    JointNotFinite {
        /// The joint.
        joint: JointId,
        /// Its name.
        name: String,
        /// Which of them.
        what: &'static str,
    },
    /// An orientation whose E Eᵀ is not 1 to within 1e-6, or a reflection.
    #[error("joint '{name}' has an orientation that is no rotation")]
    NotARotation {
        /// The joint.
        joint: JointId,
        /// Its name.
        name: String,
    },
    /// An axis without a direction.
    #[error("joint '{name}' has axis 0 0 0, expected a direction")]
    ZeroAxis {
        /// The joint.
        joint: JointId,
        /// Its name.
        name: String,
    },
    /// Armature for more or fewer degrees of freedom than the joint has.
    #[error(
        "joint '{name}' has {found} armature values, expected {expected}: one a degree of freedom, or none"
    )]
    ArmatureLength {
        /// The joint.
        joint: JointId,
        /// Its name.
        name: String,
        /// Degrees of freedom.
        expected: usize,
        /// Numbers of armature.
        found: usize,
    },
    /// Armature below zero.
    #[error("joint '{name}' has armature {armature}, expected zero or more (kg m² or kg)")]
    NegativeArmature {
        /// The joint.
        joint: JointId,
        /// Its name.
        name: String,
        /// The armature (kg m² or kg).
        armature: f64,
    },
    /// A lower limit above the upper one.
    #[error("joint '{name}' has lower limit {lower} above upper limit {upper}")]
    CrossedLimits {
        /// The joint.
        joint: JointId,
        /// Its name.
        name: String,
        /// The lower limit (rad, m).
        lower: f64,
        /// The upper limit (rad, m).
        upper: f64,
    },
    /// Mimic joints in a circle.
    #[error("joint '{name}' mimics itself, directly or through others")]
    MimicLoop {
        /// The joint.
        joint: JointId,
        /// Its name.
        name: String,
    },
    /// A mimic joint with several coordinates, or none.
    #[error("joint '{name}' of kind {kind} cannot mimic another: only joints with one coordinate can")]
    MimicKind {
        /// The joint.
        joint: JointId,
        /// Its name.
        name: String,
        /// Its kind.
        kind: &'static str,
    },
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

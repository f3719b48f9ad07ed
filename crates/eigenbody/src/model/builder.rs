//! The description of a mechanism, link by link and joint by joint, in any order.

use super::error::BuildError;
use crate::joint::Joint;
use crate::scalar::Real;
use crate::spatial::{RigidInertia, Transform, Vec3};

/// A link of the description.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct LinkId(pub(crate) u32);

/// A joint of the description.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct JointId(pub(crate) u32);

impl LinkId {
    /// Position among the links, in the order of addition.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

impl JointId {
    /// Position among the joints, in the order of addition.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// What the root link is fastened to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Base {
    /// The world.
    #[default]
    Fixed,
    /// Nothing: six more degrees of freedom, first in q and v, in a joint named `floating_base`.
    Floating,
}

/// A mimic joint: coordinate = multiplier · (the other joint's coordinate) + offset.
#[derive(Debug, Clone, PartialEq)]
pub struct MimicSpec<T> {
    /// Name of the joint that is followed.
    pub joint: String,
    /// Ratio of the coordinates.
    pub multiplier: T,
    /// Coordinate when the other joint's is zero (rad, m).
    pub offset: T,
}

/// A joint of the description.
#[derive(Debug, Clone, PartialEq)]
#[must_use]
pub struct JointSpec<T> {
    /// A name that no other joint has.
    pub name: String,
    /// Its kind.
    pub kind: Joint<T>,
    /// The link that carries it.
    pub parent: LinkId,
    /// The link that it carries; the link's frame is the joint's frame.
    pub child: LinkId,
    /// From the parent link's frame to the joint's frame; E Eᵀ is 1 to within 1e-6.
    pub placement: Transform<T>,
    /// Axis in the joint's frame, any length but zero; unused by fixed, spherical and floating joints.
    pub axis: Vec3<T>,
    /// Rotor inertia reflected to the joint, one number a DoF (kg m², kg); empty for none.
    pub armature: Vec<T>,
    /// Lower and upper limit of a joint with one coordinate (rad, m).
    pub limits: Option<(T, T)>,
    /// The joint that it follows, if any.
    pub mimic: Option<MimicSpec<T>>,
}

impl<T: Real> JointSpec<T> {
    /// A joint at the parent's origin about z, without armature, limits or mimic.
    pub fn new(name: impl Into<String>, kind: Joint<T>, parent: LinkId, child: LinkId) -> Self {
        Self {
            name: name.into(),
            kind,
            parent,
            child,
            placement: Transform::IDENTITY,
            axis: Vec3::Z,
            armature: Vec::new(),
            limits: None,
            mimic: None,
        }
    }

    /// The same joint elsewhere.
    pub fn at(mut self, placement: Transform<T>) -> Self {
        self.placement = placement;
        self
    }

    /// The same joint about another axis.
    pub fn about(mut self, axis: Vec3<T>) -> Self {
        self.axis = axis;
        self
    }

    /// The same joint with armature.
    pub fn with_armature(mut self, armature: impl Into<Vec<T>>) -> Self {
        self.armature = armature.into();
        self
    }
}

/// A mechanism being described.
///
/// ```
/// use eigenbody::model::JointSpec;
/// use eigenbody::spatial::{RigidInertia, Sym3, Vec3};
/// use eigenbody::{Base, Joint, ModelBuilder};
///
/// let mut robot = ModelBuilder::<f64>::new("pendulum");
/// let base = robot.link("base", RigidInertia::ZERO);
/// let rod = RigidInertia::from_com(2.0, Vec3::new(0.5, 0.0, 0.0), Sym3::diagonal(0.0, 0.1, 0.1));
/// let rod = robot.link("rod", rod);
/// robot.joint(JointSpec::new("hinge", Joint::Revolute, base, rod));
/// let model = robot.build(Base::Fixed)?;
/// assert_eq!((model.nv(), model.dof_name(0).as_str()), (1, "hinge"));
/// # Ok::<(), eigenbody::BuildError>(())
/// ```
#[derive(Debug, Clone)]
#[must_use]
pub struct ModelBuilder<T> {
    pub(super) name: String,
    pub(super) links: Vec<(Box<str>, RigidInertia<T>)>,
    /// The links that only stand between two joints, ascending.
    pub(super) frames: Vec<u32>,
    pub(super) joints: Vec<JointSpec<T>>,
    pub(super) gravity: Vec3<T>,
}

impl<T: Real> ModelBuilder<T> {
    /// An empty description; gravity is 9.81 m/s² along −z.
    pub fn new(name: impl Into<String>) -> Self {
        let gravity = Vec3::from_f64([0.0, 0.0, -9.81]);
        Self { name: name.into(), links: Vec::new(), frames: Vec::new(), joints: Vec::new(), gravity }
    }

    /// Makes room for so many links and joints more.
    pub fn reserve(&mut self, bodies: usize) -> &mut Self {
        self.links.reserve(bodies);
        self.joints.reserve(bodies);
        self
    }

    /// Adds a link with its inertia about its own frame's origin.
    pub fn link(&mut self, name: impl Into<Box<str>>, inertia: RigidInertia<T>) -> LinkId {
        self.links.push((name.into(), inertia));
        LinkId(self.links.len() as u32 - 1)
    }

    /// Adds a link without mass that stands between two joints of one body: that it has no mass is no finding.
    pub fn frame(&mut self, name: impl Into<Box<str>>) -> LinkId {
        let link = self.link(name, RigidInertia::ZERO);
        self.frames.push(link.0);
        link
    }

    /// Adds a joint. Joints may come in any order; coordinates follow it.
    pub fn joint(&mut self, joint: JointSpec<T>) -> JointId {
        self.joints.push(joint);
        JointId(self.joints.len() as u32 - 1)
    }

    /// Gravity in the world's frame (m/s²).
    pub fn gravity(&mut self, gravity: Vec3<T>) -> &mut Self {
        self.gravity = gravity;
        self
    }

    /// The model. What is impossible is refused; what is only suspicious becomes a [`Finding`](super::Finding).
    ///
    /// Cost O(N). Errors: [`BuildError`], each naming the link or joint at fault.
    pub fn build(self, base: Base) -> Result<super::Model<T>, BuildError> {
        super::build::build(self, base)
    }
}

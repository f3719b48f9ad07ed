//! The mechanism: built once, then immutable.

mod body;
mod build;
mod builder;
mod canonical;
mod cast;
mod change;
mod configuration;
mod coupling;
mod dof_tree;
mod error;
mod finding;
mod frames;
mod mechanism;
mod number;
mod plausible;
mod random;
mod shape;
mod topology;

pub use body::{Body, JointInfo, LinkInfo};
pub use builder::{Base, JointId, JointSpec, LinkId, MimicSpec, ModelBuilder};
pub(crate) use configuration::{QUATERNION_TOLERANCE, ROTATION_TOLERANCE, check};
pub use coupling::Coupling;
pub use dof_tree::DofTree;
pub use error::{BuildError, Place};
pub use finding::Finding;
pub(crate) use frames::{Twist, with_turn, with_twist};
pub(crate) use mechanism::{Block, COLUMNS, Deferred, EMPTY, Mechanism, Member, MotionKind, SMALL};
pub use random::Random;
pub(crate) use shape::Shape;

use crate::error::InputError;
use crate::joint::Joint;
use crate::scalar::Scalar;
use crate::spatial::Vec3;

/// Largest number of bodies a model may have.
pub const MAX_BODIES: usize = 10_000_000;

/// Largest nv for which a dense nv × nv matrix is formed (3.2 GB in f64).
pub const DENSE_LIMIT: usize = 20_000;

/// A kinematic tree of rigid bodies: immutable; what follows from it is computed once.
///
/// Bodies stand in pre-order; degrees of freedom in the order in which the joints were added.
#[derive(Debug, Clone, PartialEq)]
pub struct Model<T> {
    pub(crate) name: String,
    pub(crate) bodies: Vec<Body<T>>,
    pub(crate) shape: Shape,
    pub(crate) mechanism: Deferred<T>,
    pub(crate) links: Vec<LinkInfo<T>>,
    pub(crate) joints: Vec<JointInfo<T>>,
    /// The joints whose coordinates hold a quaternion, and where it begins in q.
    pub(crate) quaternions: Vec<(u32, u32)>,
    pub(crate) dofs: DofTree,
    pub(crate) dof_joint: Vec<u32>,
    pub(crate) armature: Vec<T>,
    pub(crate) nq: usize,
    pub(crate) floating_base: bool,
    pub(crate) gravity: Vec3<T>,
    pub(crate) coupling: Option<Coupling<T>>,
    pub(crate) findings: Vec<Finding>,
}

impl<T: Scalar> Model<T> {
    /// The robot's name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Number of coordinates.
    pub fn nq(&self) -> usize {
        self.nq
    }

    /// Number of degrees of freedom.
    pub fn nv(&self) -> usize {
        self.dof_joint.len()
    }

    /// The moving bodies, in pre-order.
    pub fn bodies(&self) -> &[Body<T>] {
        &self.bodies
    }

    /// Every link that was given, merged ones included, in the order given.
    pub fn links(&self) -> &[LinkInfo<T>] {
        &self.links
    }

    /// The moving joints, in the order of their coordinates.
    pub fn joints(&self) -> &[JointInfo<T>] {
        &self.joints
    }

    /// The tree of degrees of freedom.
    pub fn dofs(&self) -> &DofTree {
        &self.dofs
    }

    /// Inertia added to each degree of freedom: reflected rotor inertia (kg m², kg).
    pub fn armature(&self) -> &[T] {
        &self.armature
    }

    /// Gravity in the world's frame (m/s²).
    pub fn gravity(&self) -> Vec3<T> {
        self.gravity
    }

    /// True if the root link moves freely: the first six DoFs are its own.
    pub fn has_floating_base(&self) -> bool {
        self.floating_base
    }

    /// Degrees of freedom of the floating base, the first ones: six, or none.
    ///
    /// ```
    /// use eigenbody::Family;
    /// let arm = Family::hydra(4, 1.0, 0.0, 1.0)?;
    /// assert_eq!(arm.clone().model::<f64>()?.base_dofs(), 0);
    /// // The first of four hinges gives way to the base.
    /// let free = arm.floating().model::<f64>()?;
    /// assert_eq!((free.base_dofs(), free.nv()), (6, 6 + 3));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn base_dofs(&self) -> usize {
        if self.floating_base { Joint::<T>::Floating.nv() } else { 0 }
    }

    /// The linear map of mimic joints, if the model has any.
    pub fn coupling(&self) -> Option<&Coupling<T>> {
        self.coupling.as_ref()
    }

    /// What is suspicious about the model. Nothing was changed on its account.
    pub fn findings(&self) -> &[Finding] {
        &self.findings
    }

    /// Name of DoF d: its joint's name, with a suffix where the joint has several.
    pub fn dof_name(&self, d: usize) -> String {
        let joint = &self.joints[self.dof_joint[d] as usize];
        format!("{}{}", joint.name, joint.kind.dof_suffixes()[d - joint.v0 as usize])
    }

    /// True if DoF d is a translation.
    pub fn is_translation(&self, d: usize) -> bool {
        let joint = &self.joints[self.dof_joint[d] as usize];
        joint.kind.translations()[d - joint.v0 as usize]
    }

    /// Refuses a model whose dense matrices would not fit.
    pub fn check_dense(&self) -> Result<(), InputError> {
        match self.nv() {
            nv if nv > DENSE_LIMIT => Err(InputError::TooLargeForDense { nv, limit: DENSE_LIMIT }),
            _ => Ok(()),
        }
    }
}

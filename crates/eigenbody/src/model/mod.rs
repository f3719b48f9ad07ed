//! The mechanism: built once, then immutable.

mod body;
mod build;
mod builder;
mod canonical;
mod cast;
mod configuration;
mod coupling;
mod dof_tree;
mod error;
mod finding;
mod frames;
mod mechanism;
mod plausible;
mod random;
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

use crate::error::InputError;
use crate::scalar::{Real, Scalar};
use crate::spatial::{RigidInertia, Vec3};

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

    /// The same model with other armature, one number a DoF, zero or more (kg m², kg).
    ///
    /// Errors: [`InputError`] for a wrong length or a number that is negative or not finite.
    pub fn with_armature(mut self, armature: Vec<T>) -> Result<Self, InputError>
    where
        T: Real,
    {
        self.check_v("armature", &armature)?;
        if let Some(index) = armature.iter().position(|&a| a < T::ZERO) {
            let value = armature[index].to_f64();
            return Err(InputError::NotPositive { what: "armature", index, value });
        }
        self.armature = armature;
        Ok(self)
    }

    /// The same model with another inertia of the body that a link is part of, about the link's origin on the link's axes.
    ///
    /// Errors: [`InputError`] for a link that is not there or does not move, or numbers that are not finite.
    pub fn with_inertia(mut self, link: usize, inertia: RigidInertia<T>) -> Result<Self, InputError>
    where
        T: Real,
    {
        let found = self.links.get(link).and_then(LinkInfo::body);
        let Some(body) = found else {
            return Err(InputError::Length { what: "links", expected: self.links.len(), found: link });
        };
        let RigidInertia { m, h, I } = inertia.map(Real::to_f64);
        let numbers = [m, h.x, h.y, h.z, I.xx, I.yy, I.zz, I.xy, I.xz, I.yz];
        if let Some(index) = numbers.iter().position(|x| !x.is_finite()) {
            return Err(InputError::NotFinite { what: "inertia", index });
        }
        self.bodies[body].I = self.links[link].link_from_body().transpose_rigid(inertia);
        self.mechanism = Deferred::default();
        Ok(self)
    }

    /// The same model with other limits of a joint of one coordinate (rad, m).
    ///
    /// Errors: [`InputError`] for a joint that is not there or has several coordinates, or limits that are no interval.
    pub fn with_limits(mut self, joint: usize, limits: Option<(T, T)>) -> Result<Self, InputError>
    where
        T: Real,
    {
        let count = self.joints.len();
        let Some(info) = self.joints.get_mut(joint).filter(|info| info.kind.nq() == 1) else {
            return Err(InputError::Length { what: "joints", expected: count, found: joint });
        };
        if limits.is_some_and(|(l, u)| l.partial_cmp(&u).is_none_or(std::cmp::Ordering::is_gt)) {
            return Err(InputError::NotFinite { what: "limits", index: joint });
        }
        info.limits = limits;
        Ok(self)
    }

    /// Gravity in the world's frame (m/s²).
    pub fn gravity(&self) -> Vec3<T> {
        self.gravity
    }

    /// The same model under another gravity (m/s²).
    ///
    /// Errors: [`InputError::NotFinite`].
    pub fn with_gravity(mut self, gravity: Vec3<T>) -> Result<Self, InputError>
    where
        T: Real,
    {
        check("gravity", &gravity.to_array(), 3)?;
        self.gravity = gravity;
        Ok(self)
    }

    /// True if the root link moves freely: the first six DoFs are its own.
    pub fn has_floating_base(&self) -> bool {
        self.floating_base
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

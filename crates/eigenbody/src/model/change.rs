//! The same model with other numbers.

use super::number::{check_armature, check_inertia, crossed_limits};
use super::{Deferred, Model, check, finding};
use crate::error::InputError;
use crate::scalar::Real;
use crate::spatial::{RigidInertia, Vec3};

impl<T: Real> Model<T> {
    /// The same model with other armature, one number a DoF, zero or more (kg m², kg).
    ///
    /// Errors: [`InputError::Length`], [`InputError::NotFinite`], [`InputError::Negative`].
    pub fn with_armature(mut self, armature: Vec<T>) -> Result<Self, InputError> {
        self.check_v("armature", &armature)?;
        check_armature(&armature)?;
        self.armature = armature;
        Ok(self)
    }

    /// The same model with another inertia of the body that a link is part of, about the link's origin on the link's axes.
    ///
    /// Links that are fastened to it lose their own inertia, and findings on any of them give way to those on the new one, under the
    /// name of the link that the joint carries. [`Finding::Units`](super::Finding::Units) stays that of the description.
    ///
    /// Errors: [`InputError::NoSuch`] for a link that is not there, [`InputError::Immovable`] for one that does not move,
    /// [`InputError::NotFinite`], and [`InputError::Negative`] for a mass below zero.
    pub fn with_inertia(mut self, link: usize, inertia: RigidInertia<T>) -> Result<Self, InputError> {
        let count = self.links.len();
        let info = self.links.get(link).ok_or(InputError::NoSuch { what: "link", index: link, count })?;
        let immovable = || InputError::Immovable { link: info.name().to_owned() };
        let body = info.body().ok_or_else(immovable)?;
        check_inertia(&inertia)?;
        let before =
            std::mem::replace(&mut self.bodies[body].I, info.link_from_body().transpose_rigid(inertia));
        self.findings = finding::of_change(&self, body, &before, &inertia);
        self.mechanism = Deferred::default();
        Ok(self)
    }

    /// The same model with other limits of a joint of one coordinate (rad, m).
    ///
    /// Errors: [`InputError::NoSuch`] for a joint that is not there, [`InputError::SeveralCoordinates`] for one that cannot have
    /// limits, [`InputError::NotFinite`] for a NaN, [`InputError::CrossedLimits`].
    pub fn with_limits(mut self, joint: usize, limits: Option<(T, T)>) -> Result<Self, InputError> {
        let count = self.joints.len();
        let no_such = InputError::NoSuch { what: "joint", index: joint, count };
        let info = self.joints.get_mut(joint).ok_or(no_such)?;
        if info.kind.nq() != 1 {
            return Err(InputError::SeveralCoordinates { joint: info.name.to_string() });
        }
        if let Some((lower, upper)) = crossed_limits(limits)? {
            return Err(InputError::CrossedLimits { joint: info.name.to_string(), lower, upper });
        }
        info.limits = limits;
        Ok(self)
    }

    /// The same model under another gravity (m/s²).
    ///
    /// Errors: [`InputError::NotFinite`].
    pub fn with_gravity(mut self, gravity: Vec3<T>) -> Result<Self, InputError> {
        check("gravity", &gravity.to_array(), 3)?;
        self.gravity = gravity;
        Ok(self)
    }
}

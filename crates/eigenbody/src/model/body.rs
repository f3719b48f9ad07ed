//! What a model knows of a body, a link and a joint.

use crate::joint::Joint;
use crate::scalar::Scalar;
use crate::spatial::{RigidInertia, Transform};
use std::ops::Range;

/// Parent index of a body that hangs on the world.
pub(crate) const WORLD: u32 = u32::MAX;

/// A moving body: the links that a joint carries, merged, in an internal frame whose z is the joint's axis.
#[derive(Debug, Clone, PartialEq)]
pub struct Body<T> {
    pub(crate) parent: u32,
    pub(crate) q0: u32,
    pub(crate) v0: u32,
    pub(crate) link: u32,
    pub(crate) joint: Joint<T>,
    /// From the parent's frame to the joint's frame.
    pub(crate) X_tree: Transform<T>,
    pub(crate) I: RigidInertia<T>,
}

impl<T: Scalar> Body<T> {
    /// The body that carries this one; none on the world.
    #[inline(always)]
    pub fn parent(&self) -> Option<usize> {
        (self.parent != WORLD).then_some(self.parent as usize)
    }

    /// The joint that carries it.
    pub fn joint(&self) -> &Joint<T> {
        &self.joint
    }

    /// Its coordinates in q.
    #[inline(always)]
    pub fn coordinates(&self) -> Range<usize> {
        let q0 = self.q0 as usize;
        q0..q0 + self.joint.nq()
    }

    /// Its degrees of freedom in v.
    #[inline(always)]
    pub fn dofs(&self) -> Range<usize> {
        let v0 = self.v0 as usize;
        v0..v0 + self.joint.nv()
    }

    /// From the parent's internal frame to the joint's frame, whose z is the axis.
    pub fn tree_transform(&self) -> &Transform<T> {
        &self.X_tree
    }

    /// Index of the link that the joint carries, in [`links`](super::Model::links).
    pub fn link(&self) -> usize {
        self.link as usize
    }

    /// Its inertia, in its internal frame.
    pub fn inertia(&self) -> &RigidInertia<T> {
        &self.I
    }
}

/// A link as it was given.
#[derive(Debug, Clone, PartialEq)]
pub struct LinkInfo<T> {
    pub(crate) name: Box<str>,
    pub(crate) body: u32,
    /// From the body's frame to the link's; none where they are the same.
    pub(crate) X_link: Option<Box<Transform<T>>>,
}

impl<T: Scalar> LinkInfo<T> {
    /// Its name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The body it is part of; none for the world.
    pub fn body(&self) -> Option<usize> {
        (self.body != WORLD).then_some(self.body as usize)
    }

    /// From the body's internal frame to the link's own frame.
    pub fn link_from_body(&self) -> Transform<T> {
        self.X_link.as_deref().copied().unwrap_or(Transform::IDENTITY)
    }
}

/// A moving joint as it was given.
#[derive(Debug, Clone, PartialEq)]
pub struct JointInfo<T> {
    pub(crate) name: Box<str>,
    pub(crate) kind: Joint<T>,
    pub(crate) q0: u32,
    pub(crate) v0: u32,
    pub(crate) limits: Option<(T, T)>,
}

impl<T: Scalar> JointInfo<T> {
    /// Its name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Its kind.
    pub fn kind(&self) -> &Joint<T> {
        &self.kind
    }

    /// Its coordinates in q.
    pub fn coordinates(&self) -> Range<usize> {
        let q0 = self.q0 as usize;
        q0..q0 + self.kind.nq()
    }

    /// Its degrees of freedom in v.
    pub fn dofs(&self) -> Range<usize> {
        let v0 = self.v0 as usize;
        v0..v0 + self.kind.nv()
    }

    /// Lower and upper limit of its one coordinate (rad, m), if it has them.
    pub fn limits(&self) -> Option<(T, T)> {
        self.limits
    }
}

//! The inertia of a rigid body: ten numbers.

use super::{Force, Mat3, Motion, Sym3, Vec3};
use crate::scalar::{Real, Scalar};
use std::ops::{Add, AddAssign};

/// Spatial inertia of a rigid body about the origin of its frame: [I h×; −h× m].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RigidInertia<T> {
    /// Mass (kg).
    pub m: T,
    /// First moment m c, c the centre of mass (kg m).
    pub h: Vec3<T>,
    /// Rotational inertia about the frame's origin (kg m²).
    pub I: Sym3<T>,
}

impl<T: Scalar> RigidInertia<T> {
    /// No mass.
    pub const ZERO: Self = Self { m: T::ZERO, h: Vec3::ZERO, I: Sym3::ZERO };

    /// From mass, centre of mass and rotational inertia about the centre of mass.
    ///
    /// ```text
    /// I = I_com − m [c]×[c]×
    /// ```
    pub fn from_com(m: T, c: Vec3<T>, I_com: Sym3<T>) -> Self {
        let shift = Mat3::cross(c) * Mat3::cross(c) * m;
        Self { m, h: c * m, I: I_com - shift.symmetric() }
    }

    /// Mass, centre of mass and rotational inertia about it: the inverse of [`from_com`](Self::from_com). Without mass the centre is
    /// the origin.
    pub fn central(&self) -> (T, Vec3<T>, Sym3<T>)
    where
        T: Real,
    {
        let c = if self.m > T::ZERO { self.h * (T::ONE / self.m) } else { Vec3::ZERO };
        (self.m, c, self.I - Self::from_com(self.m, c, Sym3::ZERO).I)
    }

    /// I v: the momentum of the body that moves with v.
    #[inline(always)]
    pub fn times(&self, v: Motion<T>) -> Force<T> {
        Force { ang: self.I * v.ang + self.h.cross(v.lin), lin: v.lin * self.m - self.h.cross(v.ang) }
    }

    /// The entries in another scalar.
    #[inline(always)]
    pub fn map<U: Scalar>(&self, f: impl Fn(T) -> U + Copy) -> RigidInertia<U> {
        RigidInertia { m: f(self.m), h: self.h.map(f), I: self.I.map(f) }
    }
}

impl<T: Scalar> Add for RigidInertia<T> {
    type Output = Self;
    #[inline(always)]
    fn add(self, b: Self) -> Self {
        Self { m: self.m + b.m, h: self.h + b.h, I: self.I + b.I }
    }
}

impl<T: Scalar> AddAssign for RigidInertia<T> {
    #[inline(always)]
    fn add_assign(&mut self, b: Self) {
        *self = *self + b;
    }
}

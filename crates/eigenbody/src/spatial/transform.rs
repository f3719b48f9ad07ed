//! Plücker transforms: from the coordinates of one frame to those of another.

use super::{ArticulatedInertia, Force, Mat3, Motion, RigidInertia, Vec3};
use crate::scalar::Scalar;
use std::ops::Mul;

/// ₙX_o, from an old frame to a new one: X = [E 0; −E r× E].
///
/// `E` turns old coordinates into new ones; `r` is where the new origin stands in the old frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Transform<T> {
    /// Rotation of coordinates, old to new.
    pub E: Mat3<T>,
    /// Position of the new origin in the old frame (m).
    pub r: Vec3<T>,
}

impl<T: Scalar> Transform<T> {
    /// No change of frame.
    pub const IDENTITY: Self = Self { E: Mat3::IDENTITY, r: Vec3::ZERO };

    /// E first names how axes turn, r where the origin goes.
    #[inline(always)]
    pub fn new(E: Mat3<T>, r: Vec3<T>) -> Self {
        Self { E, r }
    }

    /// A shift of the origin.
    #[inline(always)]
    pub fn translation(r: Vec3<T>) -> Self {
        Self { E: Mat3::IDENTITY, r }
    }

    /// X m: a motion vector in new coordinates.
    #[inline(always)]
    pub fn motion(&self, m: Motion<T>) -> Motion<T> {
        Motion { ang: self.E * m.ang, lin: self.E * (m.lin - self.r.cross(m.ang)) }
    }

    /// X⁻¹ m: a motion vector back in old coordinates.
    #[inline(always)]
    pub fn inverse_motion(&self, m: Motion<T>) -> Motion<T> {
        let ang = self.E.transpose_times(m.ang);
        Motion { ang, lin: self.E.transpose_times(m.lin) + self.r.cross(ang) }
    }

    /// Xᵀ f: a force vector back in old coordinates.
    #[inline(always)]
    pub fn transpose_force(&self, f: Force<T>) -> Force<T> {
        let lin = self.E.transpose_times(f.lin);
        Force { ang: self.E.transpose_times(f.ang) + self.r.cross(lin), lin }
    }

    /// A point given in new coordinates, in old ones.
    #[inline(always)]
    pub fn inverse_point(&self, p: Vec3<T>) -> Vec3<T> {
        self.E.transpose_times(p) + self.r
    }

    /// Xᵀ I X: a rigid-body inertia back in old coordinates.
    ///
    /// ```text
    /// h' = Eᵀh + m r      I' = Eᵀ I E − [r]×[Eᵀh]× − [h']×[r]×
    /// ```
    #[inline(always)]
    pub fn transpose_rigid(&self, I: RigidInertia<T>) -> RigidInertia<T> {
        let (r, h0) = (self.r, self.E.transpose_times(I.h));
        let h = h0 + r * I.m;
        let (h0x, hx) = (Mat3::cross(h0), Mat3::cross(h));
        RigidInertia { m: I.m, h, I: I.I.congruence(self.E).plus_shift(r, h0x, hx) }
    }

    /// Xᵀ IA X: an articulated-body inertia back in old coordinates.
    ///
    /// ```text
    /// M' = Eᵀ M E     H' = Eᵀ H E + [r]× M'     I' = Eᵀ I E + [r]× (EᵀHE)ᵀ − H' [r]×
    /// ```
    #[inline(always)]
    pub fn transpose_articulated(&self, A: ArticulatedInertia<T>) -> ArticulatedInertia<T> {
        A.turned(self.E).shifted(self.r)
    }

    /// The inverse transform.
    #[inline(always)]
    pub fn inverse(&self) -> Self {
        Self { E: self.E.transpose(), r: -(self.E * self.r) }
    }

    /// The entries in another scalar.
    #[inline(always)]
    pub fn map<U: Scalar>(&self, f: impl Fn(T) -> U + Copy) -> Transform<U> {
        Transform { E: self.E.map(f), r: self.r.map(f) }
    }
}

impl<T: Scalar> Mul for Transform<T> {
    type Output = Self;
    /// X₂ X₁: first `b`, then `self`.
    #[inline(always)]
    fn mul(self, b: Self) -> Self {
        Self { E: self.E * b.E, r: b.r + b.E.transpose_times(self.r) }
    }
}

//! Motion and force vectors: two types, so that a velocity is never added to a momentum.

use super::Vec3;
use crate::scalar::Scalar;
use std::ops::{Add, AddAssign, Mul, Neg, Sub};

macro_rules! spatial_vector {
    ($Name:ident, $what:literal, $ang:literal, $lin:literal) => {
        #[doc = $what]
        #[derive(Debug, Clone, Copy, PartialEq)]
        pub struct $Name<T> {
            #[doc = $ang]
            pub ang: Vec3<T>,
            #[doc = $lin]
            pub lin: Vec3<T>,
        }

        impl<T: Scalar> $Name<T> {
            /// All zeros.
            pub const ZERO: Self = Self { ang: Vec3::ZERO, lin: Vec3::ZERO };

            /// [angular; linear].
            #[inline(always)]
            pub fn new(ang: Vec3<T>, lin: Vec3<T>) -> Self {
                Self { ang, lin }
            }

            /// The numbers in another scalar.
            #[inline(always)]
            pub fn map<U>(self, f: impl Fn(T) -> U + Copy) -> $Name<U> {
                $Name { ang: self.ang.map(f), lin: self.lin.map(f) }
            }

            /// The six numbers, angular first.
            #[inline(always)]
            pub fn to_array(self) -> [T; 6] {
                let ([a, b, c], [d, e, f]) = (self.ang.to_array(), self.lin.to_array());
                [a, b, c, d, e, f]
            }
        }

        impl<T: Scalar> Add for $Name<T> {
            type Output = Self;
            #[inline(always)]
            fn add(self, b: Self) -> Self {
                Self { ang: self.ang + b.ang, lin: self.lin + b.lin }
            }
        }

        impl<T: Scalar> Sub for $Name<T> {
            type Output = Self;
            #[inline(always)]
            fn sub(self, b: Self) -> Self {
                Self { ang: self.ang - b.ang, lin: self.lin - b.lin }
            }
        }

        impl<T: Scalar> Neg for $Name<T> {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                Self { ang: -self.ang, lin: -self.lin }
            }
        }

        impl<T: Scalar> Mul<T> for $Name<T> {
            type Output = Self;
            #[inline(always)]
            fn mul(self, s: T) -> Self {
                Self { ang: self.ang * s, lin: self.lin * s }
            }
        }

        impl<T: Scalar> AddAssign for $Name<T> {
            #[inline(always)]
            fn add_assign(&mut self, b: Self) {
                *self = *self + b;
            }
        }
    };
}

spatial_vector!(
    Motion,
    "A motion vector: velocity, acceleration, or a column of a motion subspace.",
    "Angular part (rad/s, rad/s²).",
    "Linear part: of the body-fixed point at the frame's origin (m/s, m/s²)."
);
spatial_vector!(
    Force,
    "A force vector: wrench or momentum.",
    "Moment about the frame's origin (N m), or angular momentum.",
    "Force (N), or linear momentum."
);

impl<T: Scalar> Force<T> {
    /// Number K of the six, angular first.
    #[inline(always)]
    pub(crate) fn component<const K: usize>(self) -> T {
        match K {
            0 => self.ang.x,
            1 => self.ang.y,
            2 => self.ang.z,
            3 => self.lin.x,
            4 => self.lin.y,
            _ => self.lin.z,
        }
    }
}

impl<T: Scalar> Motion<T> {
    /// v · f: the power of a force along a motion.
    #[inline(always)]
    pub fn dot(self, f: Force<T>) -> T {
        self.ang.dot(f.ang) + self.lin.dot(f.lin)
    }

    /// v × m: rate of change of a motion vector that moves with v.
    #[inline(always)]
    pub fn cross(self, m: Self) -> Self {
        Self { ang: self.ang.cross(m.ang), lin: self.ang.cross(m.lin) + self.lin.cross(m.ang) }
    }

    /// v ×* f: rate of change of a force vector that moves with v.
    #[inline(always)]
    pub fn cross_force(self, f: Force<T>) -> Force<T> {
        Force { ang: self.ang.cross(f.ang) + self.lin.cross(f.lin), lin: self.ang.cross(f.lin) }
    }
}

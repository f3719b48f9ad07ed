//! Vectors in three dimensions.

use crate::scalar::Scalar;
use std::ops::{Add, AddAssign, Mul, Neg, Sub};

/// A vector in three dimensions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Vec3<T> {
    /// First component.
    pub x: T,
    /// Second component.
    pub y: T,
    /// Third component.
    pub z: T,
}

impl<T: Scalar> Vec3<T> {
    /// (0, 0, 0).
    pub const ZERO: Self = Self { x: T::ZERO, y: T::ZERO, z: T::ZERO };
    /// (1, 0, 0).
    pub const X: Self = Self { x: T::ONE, y: T::ZERO, z: T::ZERO };
    /// (0, 1, 0).
    pub const Y: Self = Self { x: T::ZERO, y: T::ONE, z: T::ZERO };
    /// (0, 0, 1).
    pub const Z: Self = Self { x: T::ZERO, y: T::ZERO, z: T::ONE };

    /// (x, y, z).
    #[inline(always)]
    pub fn new(x: T, y: T, z: T) -> Self {
        Self { x, y, z }
    }

    /// The nearest vector to three f64.
    pub fn from_f64([x, y, z]: [f64; 3]) -> Self {
        Self { x: T::from_f64(x), y: T::from_f64(y), z: T::from_f64(z) }
    }

    /// a · b.
    #[inline(always)]
    pub fn dot(self, b: Self) -> T {
        self.x.mul_add(b.x, self.y.mul_add(b.y, self.z * b.z))
    }

    /// a × b.
    #[inline(always)]
    pub fn cross(self, b: Self) -> Self {
        Self {
            x: self.y.mul_add(b.z, -(self.z * b.y)),
            y: self.z.mul_add(b.x, -(self.x * b.z)),
            z: self.x.mul_add(b.y, -(self.y * b.x)),
        }
    }

    /// a × b + c.
    #[inline(always)]
    pub fn cross_add(self, b: Self, c: Self) -> Self {
        Self {
            x: self.y.mul_add(b.z, (-self.z).mul_add(b.y, c.x)),
            y: self.z.mul_add(b.x, (-self.x).mul_add(b.z, c.y)),
            z: self.x.mul_add(b.y, (-self.y).mul_add(b.x, c.z)),
        }
    }

    /// a · b + c.
    #[inline(always)]
    pub fn dot_add(self, b: Self, c: T) -> T {
        self.x.mul_add(b.x, self.y.mul_add(b.y, self.z.mul_add(b.z, c)))
    }

    /// Eᵀ a with E a turn about z by the angle with this sine and cosine.
    #[inline(always)]
    pub fn turned_about_z(self, (s, c): (T, T)) -> Self {
        Self { x: c.mul_add(self.x, -(s * self.y)), y: s.mul_add(self.x, c * self.y), z: self.z }
    }

    /// a s + b.
    #[inline(always)]
    pub fn mul_add(self, s: T, b: Self) -> Self {
        Self { x: self.x.mul_add(s, b.x), y: self.y.mul_add(s, b.y), z: self.z.mul_add(s, b.z) }
    }

    /// |a|.
    #[inline(always)]
    pub fn norm(self) -> T {
        self.dot(self).sqrt()
    }

    /// The components in another scalar.
    #[inline(always)]
    pub fn map<U>(self, f: impl Fn(T) -> U) -> Vec3<U> {
        Vec3 { x: f(self.x), y: f(self.y), z: f(self.z) }
    }

    /// [x, y, z].
    #[inline(always)]
    pub fn to_array(self) -> [T; 3] {
        [self.x, self.y, self.z]
    }
}

impl<T: Scalar> Add for Vec3<T> {
    type Output = Self;
    #[inline(always)]
    fn add(self, b: Self) -> Self {
        Self { x: self.x + b.x, y: self.y + b.y, z: self.z + b.z }
    }
}

impl<T: Scalar> Sub for Vec3<T> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, b: Self) -> Self {
        Self { x: self.x - b.x, y: self.y - b.y, z: self.z - b.z }
    }
}

impl<T: Scalar> Neg for Vec3<T> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self { x: -self.x, y: -self.y, z: -self.z }
    }
}

impl<T: Scalar> Mul<T> for Vec3<T> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, s: T) -> Self {
        Self { x: self.x * s, y: self.y * s, z: self.z * s }
    }
}

impl<T: Scalar> AddAssign for Vec3<T> {
    #[inline(always)]
    fn add_assign(&mut self, b: Self) {
        *self = *self + b;
    }
}

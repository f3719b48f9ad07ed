//! Where an origin stands, by what is known of it before the configuration is: a coordinate that is zero is in no product.

use super::{Mat3, Vec3};
use crate::scalar::Scalar;

/// The coordinate of r that is zero.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Zero {
    X,
    Y,
    Z,
    None,
}

/// r, the position of an origin.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Offset<T> {
    r: Vec3<T>,
    zero: Zero,
}

impl<T: Scalar> Offset<T> {
    #[inline(always)]
    pub fn new(r: Vec3<T>, zero: Zero) -> Self {
        Self { r, zero }
    }

    /// r_x a + b.
    #[inline(always)]
    pub fn x(self, a: T, b: T) -> T {
        if self.zero == Zero::X { b } else { self.r.x.mul_add(a, b) }
    }

    /// r_y a + b.
    #[inline(always)]
    pub fn y(self, a: T, b: T) -> T {
        if self.zero == Zero::Y { b } else { self.r.y.mul_add(a, b) }
    }

    /// r_z a + b.
    #[inline(always)]
    pub fn z(self, a: T, b: T) -> T {
        if self.zero == Zero::Z { b } else { self.r.z.mul_add(a, b) }
    }

    /// r × b + c.
    #[inline(always)]
    pub fn cross_add(self, b: Vec3<T>, c: Vec3<T>) -> Vec3<T> {
        Vec3::new(self.cross_x(b, c.x), self.cross_y(b, c.y), self.cross_z(b, c.z))
    }

    /// (r × b)_x + c.
    #[inline(always)]
    pub fn cross_x(self, b: Vec3<T>, c: T) -> T {
        self.y(b.z, self.z(-b.y, c))
    }

    /// (r × b)_y + c.
    #[inline(always)]
    pub fn cross_y(self, b: Vec3<T>, c: T) -> T {
        self.z(b.x, self.x(-b.z, c))
    }

    /// (r × b)_z + c.
    #[inline(always)]
    pub fn cross_z(self, b: Vec3<T>, c: T) -> T {
        self.x(b.y, self.y(-b.x, c))
    }

    /// A r + b.
    #[inline(always)]
    pub fn image_add(self, A: Mat3<T>, b: Vec3<T>) -> Vec3<T> {
        Vec3::new(self.dot_add(A.x, b.x), self.dot_add(A.y, b.y), self.dot_add(A.z, b.z))
    }

    /// a · r + b.
    #[inline(always)]
    fn dot_add(self, a: Vec3<T>, b: T) -> T {
        self.x(a.x, self.y(a.y, self.z(a.z, b)))
    }

    /// a_x r_x + a_y r_y + a_z r_z.
    #[inline(always)]
    pub fn dot(self, a: Vec3<T>) -> T {
        let r = self.r;
        match self.zero {
            Zero::X => r.y.mul_add(a.y, r.z * a.z),
            Zero::Y => r.x.mul_add(a.x, r.z * a.z),
            Zero::Z => r.x.mul_add(a.x, r.y * a.y),
            Zero::None => r.x.mul_add(a.x, r.y.mul_add(a.y, r.z * a.z)),
        }
    }
}

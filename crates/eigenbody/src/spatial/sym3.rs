//! Symmetric 3 × 3 matrices, six numbers.

use super::mat3::turned;
use super::{Mat3, Offset, Vec3, Zero};
use crate::scalar::Scalar;
use std::ops::{Add, AddAssign, Mul, Sub};

/// A symmetric 3 × 3 matrix.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sym3<T> {
    /// Entry (x, x).
    pub xx: T,
    /// Entry (y, y).
    pub yy: T,
    /// Entry (z, z).
    pub zz: T,
    /// Entry (x, y).
    pub xy: T,
    /// Entry (x, z).
    pub xz: T,
    /// Entry (y, z).
    pub yz: T,
}

impl<T: Scalar> Sym3<T> {
    /// All zeros.
    pub const ZERO: Self =
        Self { xx: T::ZERO, yy: T::ZERO, zz: T::ZERO, xy: T::ZERO, xz: T::ZERO, yz: T::ZERO };

    /// A diagonal matrix.
    #[inline(always)]
    pub fn diagonal(xx: T, yy: T, zz: T) -> Self {
        Self { xx, yy, zz, ..Self::ZERO }
    }

    /// A + a bᵀ for a parallel to b.
    #[inline(always)]
    pub fn plus_outer(self, a: Vec3<T>, b: Vec3<T>) -> Self {
        Self {
            xx: a.x.mul_add(b.x, self.xx),
            yy: a.y.mul_add(b.y, self.yy),
            zz: a.z.mul_add(b.z, self.zz),
            xy: a.x.mul_add(b.y, self.xy),
            xz: a.x.mul_add(b.z, self.xz),
            yz: a.y.mul_add(b.z, self.yz),
        }
    }

    /// `A + [r]× Bᵀ + ([r]× Cᵀ)ᵀ`, where that is symmetric as a whole.
    ///
    /// Entry (i, j) of `[r]× Bᵀ` is `(r × b_j)_i`, b_j the rows of B.
    #[inline(always)]
    pub fn plus_shift(self, r: Vec3<T>, B: Mat3<T>, C: Mat3<T>) -> Self {
        self.offset(Offset::new(r, Zero::None), B, C)
    }

    /// [`plus_shift`](Self::plus_shift) by what is known of r.
    #[inline(always)]
    pub(crate) fn offset(self, r: Offset<T>, B: Mat3<T>, C: Mat3<T>) -> Self {
        Self {
            xx: r.cross_x(B.x + C.x, self.xx),
            yy: r.cross_y(B.y + C.y, self.yy),
            zz: r.cross_z(B.z + C.z, self.zz),
            xy: r.cross_x(B.y, r.cross_y(C.x, self.xy)),
            xz: r.cross_x(B.z, r.cross_z(C.x, self.xz)),
            yz: r.cross_y(B.z, r.cross_z(C.y, self.yz)),
        }
    }

    /// All nine entries.
    #[inline(always)]
    pub fn full(self) -> Mat3<T> {
        Mat3 {
            x: Vec3::new(self.xx, self.xy, self.xz),
            y: Vec3::new(self.xy, self.yy, self.yz),
            z: Vec3::new(self.xz, self.yz, self.zz),
        }
    }

    /// Eᵀ A E.
    #[inline(always)]
    pub fn congruence(self, E: Mat3<T>) -> Self {
        // (A E)ᵀ has the rows A e_c, e_c the columns of E; entry (c, d) of Eᵀ A E is e_c · A e_d.
        let E = E.transpose();
        let (Ax, Ay, Az) = (self * E.x, self * E.y, self * E.z);
        Self {
            xx: E.x.dot(Ax),
            yy: E.y.dot(Ay),
            zz: E.z.dot(Az),
            xy: E.x.dot(Ay),
            xz: E.x.dot(Az),
            yz: E.y.dot(Az),
        }
    }

    /// [`congruence`](Self::congruence) with a turn about z by the angle with this sine and cosine.
    #[inline(always)]
    pub fn turned_about_z(self, (s, c): (T, T)) -> Self {
        let Self { xx, yy, zz, xy, xz, yz } = self;
        let [[xx, xy], [_, yy]] = turned([[xx, xy], [xy, yy]], (s, c));
        Self { xx, yy, zz, xy, xz: c.mul_add(xz, -(s * yz)), yz: s.mul_add(xz, c * yz) }
    }

    /// The entries in another scalar.
    #[inline(always)]
    pub fn map<U>(self, f: impl Fn(T) -> U) -> Sym3<U> {
        Sym3 {
            xx: f(self.xx),
            yy: f(self.yy),
            zz: f(self.zz),
            xy: f(self.xy),
            xz: f(self.xz),
            yz: f(self.yz),
        }
    }
}

impl<T: Scalar> Mul<Vec3<T>> for Sym3<T> {
    type Output = Vec3<T>;
    #[inline(always)]
    fn mul(self, b: Vec3<T>) -> Vec3<T> {
        self.full() * b
    }
}

impl<T: Scalar> Mul<T> for Sym3<T> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, s: T) -> Self {
        self.map(|a| a * s)
    }
}

impl<T: Scalar> Add for Sym3<T> {
    type Output = Self;
    #[inline(always)]
    fn add(self, B: Self) -> Self {
        Self {
            xx: self.xx + B.xx,
            yy: self.yy + B.yy,
            zz: self.zz + B.zz,
            xy: self.xy + B.xy,
            xz: self.xz + B.xz,
            yz: self.yz + B.yz,
        }
    }
}

impl<T: Scalar> Sub for Sym3<T> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, B: Self) -> Self {
        Self {
            xx: self.xx - B.xx,
            yy: self.yy - B.yy,
            zz: self.zz - B.zz,
            xy: self.xy - B.xy,
            xz: self.xz - B.xz,
            yz: self.yz - B.yz,
        }
    }
}

impl<T: Scalar> AddAssign for Sym3<T> {
    #[inline(always)]
    fn add_assign(&mut self, B: Self) {
        *self = *self + B;
    }
}

//! The inertia of an articulated body: a symmetric 6 × 6 matrix, 21 numbers.

use super::{Force, Mat3, Motion, Offset, PseudoInertia, RigidInertia, Sym3, Vec3};
use crate::scalar::Scalar;
use std::ops::{Add, AddAssign};

/// Articulated-body inertia IA = [I H; Hᵀ M].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ArticulatedInertia<T> {
    /// Angular block.
    pub I: Sym3<T>,
    /// Coupling block.
    pub H: Mat3<T>,
    /// Linear block: the apparent mass.
    pub M: Sym3<T>,
}

impl<T: Scalar> ArticulatedInertia<T> {
    /// No inertia.
    pub const ZERO: Self = Self { I: Sym3::ZERO, H: Mat3::ZERO, M: Sym3::ZERO };

    /// IA v.
    #[inline(always)]
    pub fn times(&self, v: Motion<T>) -> Force<T> {
        Force { ang: self.I * v.ang + self.H * v.lin, lin: self.H.transpose_times(v.ang) + self.M * v.lin }
    }

    /// The lower triangle, by rows; what stands beyond the diagonal has no meaning.
    #[inline(always)]
    pub(crate) fn rows(&self) -> [[T; 6]; 6] {
        let (Self { I, H, M }, o) = (*self, T::ZERO);
        [
            [I.xx, o, o, o, o, o],
            [I.xy, I.yy, o, o, o, o],
            [I.xz, I.yz, I.zz, o, o, o],
            [H.x.x, H.y.x, H.z.x, M.xx, o, o],
            [H.x.y, H.y.y, H.z.y, M.xy, M.yy, o],
            [H.x.z, H.y.z, H.z.z, M.xz, M.yz, M.zz],
        ]
    }

    /// IA − U Uᵀ s: one hinge eliminated, s = 1/D.
    #[inline(always)]
    pub fn minus_outer(&self, U: Force<T>, s: T) -> Self {
        let (n, f) = (U.ang, U.lin);
        let (ns, fs) = (n * -s, f * -s);
        let H =
            Mat3::from_rows(f.mul_add(ns.x, self.H.x), f.mul_add(ns.y, self.H.y), f.mul_add(ns.z, self.H.z));
        Self { I: self.I.plus_outer(ns, n), H, M: self.M.plus_outer(fs, f) }
    }

    /// In the frame from which E turns: Eᵀ I E, Eᵀ H E, Eᵀ M E.
    #[inline(always)]
    pub fn turned(self, E: Mat3<T>) -> Self {
        Self { I: self.I.congruence(E), H: E.transpose() * self.H * E, M: self.M.congruence(E) }
    }

    /// [`turned`](Self::turned) for a turn about z by the angle with this sine and cosine: fewer than half the products.
    #[inline(always)]
    pub fn turned_about_z(self, turn: (T, T)) -> Self {
        Self {
            I: self.I.turned_about_z(turn),
            H: self.H.turned_about_z(turn),
            M: self.M.turned_about_z(turn),
        }
    }

    /// About a point at −r, in parallel axes.
    ///
    /// ```text
    /// M' = M      H' = H + [r]× M      I' = I + [r]× Hᵀ − H' [r]×
    /// ```
    #[inline(always)]
    pub fn shifted(self, r: Vec3<T>) -> Self {
        let Self { I, H: H0, M } = self;
        let H = H0 + Mat3::cross_times(r, M.full());
        Self { I: I.plus_shift(r, H0, H), H, M }
    }

    /// [`shifted`](Self::shifted) by what is known of r, without an intermediate sum: a third fewer operations.
    #[inline(always)]
    pub(crate) fn offset(self, r: Offset<T>) -> Self {
        let Self { I, H: H0, M } = self;
        let (columns, H) = (M.full(), H0.transpose());
        let (x, y, z) =
            (r.cross_add(columns.x, H.x), r.cross_add(columns.y, H.y), r.cross_add(columns.z, H.z));
        let H = Mat3 { x, y, z }.transpose();
        Self { I: I.offset(r, H0, H), H, M }
    }

    /// With a rigid body besides.
    #[inline(always)]
    pub(crate) fn plus_body(self, PseudoInertia { m, h, P }: PseudoInertia<T>) -> Self {
        let Self { I, H, M } = self;
        Self {
            I: Sym3 {
                xx: I.xx + (P.yy + P.zz),
                yy: I.yy + (P.xx + P.zz),
                zz: I.zz + (P.xx + P.yy),
                xy: I.xy - P.xy,
                xz: I.xz - P.xz,
                yz: I.yz - P.yz,
            },
            H: Mat3 {
                x: Vec3::new(H.x.x, H.x.y - h.z, H.x.z + h.y),
                y: Vec3::new(H.y.x + h.z, H.y.y, H.y.z - h.x),
                z: Vec3::new(H.z.x - h.y, H.z.y + h.x, H.z.z),
            },
            M: Sym3 { xx: M.xx + m, yy: M.yy + m, zz: M.zz + m, ..M },
        }
    }

    /// The entries in another scalar.
    #[inline(always)]
    pub(crate) fn map<U>(self, f: impl Fn(T) -> U + Copy) -> ArticulatedInertia<U> {
        ArticulatedInertia { I: self.I.map(f), H: self.H.map(f), M: self.M.map(f) }
    }

    /// Column K of the 6 × 6 matrix.
    #[inline(always)]
    pub(crate) fn column<const K: usize>(&self) -> Force<T> {
        let Self { I, H, M } = self;
        match K {
            0 => Force::new(Vec3::new(I.xx, I.xy, I.xz), H.x),
            1 => Force::new(Vec3::new(I.xy, I.yy, I.yz), H.y),
            2 => Force::new(Vec3::new(I.xz, I.yz, I.zz), H.z),
            3 => Force::new(Vec3::new(H.x.x, H.y.x, H.z.x), Vec3::new(M.xx, M.xy, M.xz)),
            4 => Force::new(Vec3::new(H.x.y, H.y.y, H.z.y), Vec3::new(M.xy, M.yy, M.yz)),
            _ => Force::new(Vec3::new(H.x.z, H.y.z, H.z.z), Vec3::new(M.xz, M.yz, M.zz)),
        }
    }

    /// Row and column K replaced.
    #[inline(always)]
    pub(crate) fn with_column<const K: usize>(mut self, U: Force<T>) -> Self {
        let Self { I, H, M } = &mut self;
        let (n, f) = (U.ang, U.lin);
        match K {
            0 => (I.xx, I.xy, I.xz, H.x) = (n.x, n.y, n.z, f),
            1 => (I.xy, I.yy, I.yz, H.y) = (n.x, n.y, n.z, f),
            2 => (I.xz, I.yz, I.zz, H.z) = (n.x, n.y, n.z, f),
            3 => (H.x.x, H.y.x, H.z.x, M.xx, M.xy, M.xz) = (n.x, n.y, n.z, f.x, f.y, f.z),
            4 => (H.x.y, H.y.y, H.z.y, M.xy, M.yy, M.yz) = (n.x, n.y, n.z, f.x, f.y, f.z),
            _ => (H.x.z, H.y.z, H.z.z, M.xz, M.yz, M.zz) = (n.x, n.y, n.z, f.x, f.y, f.z),
        }
        self
    }
}

impl<T: Scalar> From<RigidInertia<T>> for ArticulatedInertia<T> {
    #[inline(always)]
    fn from(b: RigidInertia<T>) -> Self {
        Self { I: b.I, H: Mat3::cross(b.h), M: Sym3::diagonal(b.m, b.m, b.m) }
    }
}

impl<T: Scalar> Add for ArticulatedInertia<T> {
    type Output = Self;
    #[inline(always)]
    fn add(self, b: Self) -> Self {
        Self { I: self.I + b.I, H: self.H + b.H, M: self.M + b.M }
    }
}

impl<T: Scalar> AddAssign for ArticulatedInertia<T> {
    #[inline(always)]
    fn add_assign(&mut self, b: Self) {
        *self = *self + b;
    }
}

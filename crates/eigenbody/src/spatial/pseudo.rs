//! The inertia of a rigid body by its moments of mass: cheaper to move than moments of inertia.
//!
//! ```text
//! m = Σ m_k      h = Σ m_k ρ_k      P = Σ m_k ρ_k ρ_kᵀ      I = (tr P) 1 − P
//! ```
//! Wensing, Kim and Slotine, "Linear matrix inequalities for physically consistent inertial parameter identification" (2018).

use super::{ArticulatedInertia, Force, Mat3, Offset, RigidInertia, Sym3, Vec3};
use crate::scalar::{Real, Scalar};
use std::ops::{Add, AddAssign};

/// Zeroth, first and second moments of mass about the frame's origin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct PseudoInertia<T> {
    /// Mass (kg).
    pub m: T,
    /// First moment (kg m).
    pub h: Vec3<T>,
    /// Second moments (kg m²).
    pub P: Sym3<T>,
}

impl<T: Scalar> PseudoInertia<T> {
    pub const ZERO: Self = Self { m: T::ZERO, h: Vec3::ZERO, P: Sym3::ZERO };

    /// About a point at −r, in parallel axes: h' = h + m r, P' = P + r hᵀ + h' rᵀ.
    #[inline(always)]
    pub fn shifted(self, r: Offset<T>) -> Self {
        let Self { m, h: h0, P } = self;
        let h = Vec3::new(r.x(m, h0.x), r.y(m, h0.y), r.z(m, h0.z));
        let P = Sym3 {
            xx: r.x(h0.x + h.x, P.xx),
            yy: r.y(h0.y + h.y, P.yy),
            zz: r.z(h0.z + h.z, P.zz),
            xy: r.x(h0.y, r.y(h.x, P.xy)),
            xz: r.x(h0.z, r.z(h.x, P.xz)),
            yz: r.y(h0.z, r.z(h.y, P.yz)),
        };
        Self { m, h, P }
    }

    /// Momentum of a turn about z at unit rate.
    #[inline(always)]
    pub fn times_ang_z(self) -> Force<T> {
        let Self { h, P, .. } = self;
        Force::new(Vec3::new(-P.xz, -P.yz, P.xx + P.yy), Vec3::new(-h.y, h.x, T::ZERO))
    }

    /// Momentum of a shift along z at unit rate.
    #[inline(always)]
    pub fn times_lin_z(self) -> Force<T> {
        let Self { m, h, .. } = self;
        Force::new(Vec3::new(h.y, -h.x, T::ZERO), Vec3::new(T::ZERO, T::ZERO, m))
    }

    /// The force that gives the frame's origin the acceleration a and the body Ψ = [α]× + [ω]×²: every point ρ has a + Ψ ρ.
    ///
    /// ```text
    /// f = m a + Ψ h      n = h × a + Σ m_k ρ_k × Ψ ρ_k
    /// ```
    #[inline(always)]
    pub fn force(self, a: Vec3<T>, Psi: Mat3<T>) -> Force<T> {
        let Self { m, h, P } = self;
        let P = P.full();
        let n = Vec3::new(
            Psi.z.dot_add(P.y, -Psi.y.dot(P.z)),
            Psi.x.dot_add(P.z, -Psi.z.dot(P.x)),
            Psi.y.dot_add(P.x, -Psi.x.dot(P.y)),
        );
        Force::new(h.cross_add(a, n), Psi.times_add(h, a * m))
    }

    /// I = (tr P) 1 − P.
    #[inline(always)]
    pub fn rigid(self) -> RigidInertia<T> {
        let Self { m, h, P } = self;
        let I = Sym3 { xx: P.yy + P.zz, yy: P.xx + P.zz, zz: P.xx + P.yy, xy: -P.xy, xz: -P.xz, yz: -P.yz };
        RigidInertia { m, h, I }
    }

    #[inline(always)]
    pub fn articulated(self) -> ArticulatedInertia<T> {
        self.rigid().into()
    }

    #[inline(always)]
    pub fn map<U: Scalar>(&self, f: impl Fn(T) -> U + Copy) -> PseudoInertia<U> {
        PseudoInertia { m: f(self.m), h: self.h.map(f), P: self.P.map(f) }
    }
}

impl<T: Real> From<RigidInertia<T>> for PseudoInertia<T> {
    /// Every second moment to the last digit, however thin the body: where the difference cancels, by the triangle inequality of
    /// moments of inertia, it is exact.
    fn from(RigidInertia { m, h, I }: RigidInertia<T>) -> Self {
        let moment = |a: T, b: T, c: T| ((a.max(b) - c) + a.min(b)) * T::from_f64(0.5);
        let P = Sym3 {
            xx: moment(I.yy, I.zz, I.xx),
            yy: moment(I.xx, I.zz, I.yy),
            zz: moment(I.xx, I.yy, I.zz),
            xy: -I.xy,
            xz: -I.xz,
            yz: -I.yz,
        };
        Self { m, h, P }
    }
}

impl<T: Scalar> Add for PseudoInertia<T> {
    type Output = Self;
    #[inline(always)]
    fn add(self, b: Self) -> Self {
        Self { m: self.m + b.m, h: self.h + b.h, P: self.P + b.P }
    }
}

impl<T: Scalar> AddAssign for PseudoInertia<T> {
    #[inline(always)]
    fn add_assign(&mut self, b: Self) {
        *self = *self + b;
    }
}

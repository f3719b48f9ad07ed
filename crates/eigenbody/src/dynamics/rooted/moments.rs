//! Moments of mass in the root's axes.

use super::{Stand, combined, components, spread};
use crate::model::Member;
use crate::scalar::{Quad, Real};
use crate::spatial::Vec3;

/// h = Σ m_k ρ_k and P = Σ m_k ρ_k ρ_kᵀ, by columns, about a body's origin. The mass itself does not depend on q.
#[derive(Debug, Clone, Copy)]
pub(super) struct Moments<Q> {
    pub h: Q,
    pub P: Vec3<Q>,
}

impl<Q> Moments<Q> {
    /// A body's own: h = R h, P = R P Rᵀ.
    #[inline(always)]
    pub fn own<T: Real>(m: &Member<T>, stand: &Stand<T>) -> Self
    where
        Q: Quad<T>,
    {
        let (R, P) = (stand.axes::<Q>(), m.I.P.map(Q::constant).full());
        let Y = Vec3::new(combined(R, P.x), combined(R, P.y), combined(R, P.z));
        let (x, y, z) = (components(&stand.x), components(&stand.y), components(&stand.z));
        let P = Vec3::new(
            combined(Y, Vec3::new(x.x, y.x, z.x)),
            combined(Y, Vec3::new(x.y, y.y, z.y)),
            combined(Y, Vec3::new(x.z, y.z, z.z)),
        );
        Self { h: combined(R, spread(m.I.h)), P }
    }

    /// What a body carries, seen from its parent: P + h rᵀ + r hᵀ + m r rᵀ.
    #[inline(always)]
    pub fn shifted<T: Real>(self, m: T, r: &[T; 4]) -> Self
    where
        Q: Quad<T>,
    {
        let (shift, r) = (Q::from_slice(r), components::<T, Q>(r));
        let [hx, hy, hz, _] = self.h.each();
        let h = shift.mul_add(Q::constant(m), self.h);
        Self {
            h,
            P: Vec3::new(
                shift.mul_add(hx, h.mul_add(r.x, self.P.x)),
                shift.mul_add(hy, h.mul_add(r.y, self.P.y)),
                shift.mul_add(hz, h.mul_add(r.z, self.P.z)),
            ),
        }
    }

    #[inline(always)]
    pub fn plus<T: Real>(self, b: Self) -> Self
    where
        Q: Quad<T>,
    {
        Self { h: self.h + b.h, P: self.P + b.P }
    }

    /// I, by columns: (tr P) 1 − P, with nothing added to the diagonal that is then taken away.
    #[inline(always)]
    pub fn rotational<T: Real>(&self) -> Vec3<Q>
    where
        Q: Quad<T>,
    {
        let (x, y, z) = (self.P.x.numbers(), self.P.y.numbers(), self.P.z.numbers());
        let sums = Q::of([y[1], z[2], x[0], T::ZERO]) + Q::of([z[2], x[0], y[1], T::ZERO]);
        let [xx, yy, zz, _] = sums.numbers();
        let (x, y, z) = ((-self.P.x).numbers(), (-self.P.y).numbers(), (-self.P.z).numbers());
        Vec3::new(Q::of([xx, x[1], x[2], x[3]]), Q::of([y[0], yy, y[2], y[3]]), Q::of([z[0], z[1], zz, z[3]]))
    }

    /// I w.
    #[inline(always)]
    pub fn moment<T: Real>(&self, w: &[T; 4]) -> Q
    where
        Q: Quad<T>,
    {
        let (x, y, z) = (self.P.x.numbers(), self.P.y.numbers(), self.P.z.numbers());
        let diagonal = Q::of([x[0], y[1], z[2], T::ZERO]).yzx();
        let sums = diagonal + diagonal.yzx();
        let (x, y, z) =
            ([T::ZERO, x[1], x[2], x[3]], [y[0], T::ZERO, y[2], y[3]], [z[0], z[1], T::ZERO, z[3]]);
        let Vec3 { x: wx, y: wy, z: wz } = components::<T, Q>(w);
        wx.mul_add(-Q::of(x), wy.mul_add(-Q::of(y), wz.mul_add(-Q::of(z), sums * Q::from_slice(w))))
    }
}

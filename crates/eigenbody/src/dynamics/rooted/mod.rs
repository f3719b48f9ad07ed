//! One configuration, in the axes of the body at the root: a vector is a register, and nothing turns on its way along a branch.
//!
//! ```text
//! R_i = R_p Eᵀ        the axes of body i, as columns        R = 1 at a root
//! r_i = R_p r         its origin, seen from its parent's
//! ```
//! Every vector and inertia of body i is about its own origin; moving it to the parent is a shift by r alone. What a hinge feels of mass
//! far out along its axis cancels here, and not in the body's frame: a mechanism for which that matters is not stout. Neither H nor C depend on where a free base stands, nor on how its axes lie.

mod aba;
mod crba;
mod moments;
mod rnea;

pub(super) use aba::{AbaRoom, aba};
pub(super) use crba::{CrbaRoom, crba};
pub(super) use rnea::{RneaRoom, rnea};

use super::posture::Posture;
use crate::model::{Mechanism, Member, MotionKind, SMALL, with_twist};
use crate::scalar::{Quad, Real, Scalar};
use crate::spatial::{Motion, Placed, Rotation, ThenZ, Vec3};

/// Whether a mechanism is of the size and the build that this is for, and T one number.
pub(super) fn suits<T: Scalar>(mechanism: &Mechanism<T::Constant>) -> bool {
    fits::<T>(mechanism) && mechanism.stout
}

/// Whether room is kept: for every model of a shape alike, as another inertia may make a mechanism stout.
fn fits<T: Scalar>(mechanism: &Mechanism<T::Constant>) -> bool {
    mechanism.slots.len() <= SMALL && size_of::<T>() == size_of::<T::Constant>()
}

/// A body's axes and where its origin stands, seen from its parent's.
#[derive(Debug, Clone, Copy)]
#[repr(align(32))]
pub(super) struct Stand<T> {
    x: [T; 4],
    y: [T; 4],
    z: [T; 4],
    r: [T; 4],
}

impl<T: Scalar> Stand<T> {
    const UNITS: [[T; 4]; 4] = {
        let (o, l) = (T::ZERO, T::ONE);
        [[l, o, o, o], [o, l, o, o], [o, o, l, o], [o, o, o, l]]
    };
    pub const ROOT: Self = {
        let [x, y, z, _] = Self::UNITS;
        Self { x, y, z, r: [T::ZERO; 4] }
    };
}

impl<T: Real> Stand<T> {
    #[inline(always)]
    fn axes<Q: Quad<T>>(&self) -> Vec3<Q> {
        Vec3::new(Q::from_slice(&self.x), Q::from_slice(&self.y), Q::from_slice(&self.z))
    }

    /// R v.
    #[inline(always)]
    fn turned<Q: Quad<T>>(&self, v: Vec3<T>) -> Q {
        combined(self.axes::<Q>(), spread(v))
    }
}

/// Each component in a register.
#[inline(always)]
fn spread<T: Real, Q: Quad<T>>(v: Vec3<T>) -> Vec3<Q> {
    Vec3::new(Q::constant(v.x), Q::constant(v.y), Q::constant(v.z))
}

/// The first three numbers, each in a register.
#[inline(always)]
fn components<T: Real, Q: Quad<T>>(v: &[T; 4]) -> Vec3<Q> {
    Vec3::new(Q::constant(v[0]), Q::constant(v[1]), Q::constant(v[2]))
}

/// A v, by the columns of A or, where it is symmetric, its rows; aᵀ A by the rows of any.
#[inline(always)]
fn combined<T: Real, Q: Quad<T>>(A: Vec3<Q>, v: Vec3<Q>) -> Q {
    A.x.mul_add(v.x, A.y.mul_add(v.y, A.z * v.z))
}

/// The unit vectors.
#[inline(always)]
fn units<T: Real, Q: Quad<T>>() -> Vec3<Q> {
    let [x, y, z, _] = Stand::<T>::UNITS;
    Vec3::new(Q::of(x), Q::of(y), Q::of(z))
}

/// Every body's stand, from the root on.
#[inline(always)]
fn stand<T: Real, Q: Quad<T>>(
    mechanism: &Mechanism<T>,
    posture: &Posture<T>,
    q: &[T],
    stands: &mut [Stand<T>],
) {
    let members = mechanism.members.as_slice();
    let n = members.len();
    let (stands, sin, cos) = (&mut stands[..n], &posture.sin[..n], &posture.cos[..n]);
    let mut before = Stand::ROOT.axes::<Q>();
    for (i, m) in members.iter().enumerate() {
        let Some(p) = (m.parent as usize).checked_sub(1) else {
            stands[i] = Stand::ROOT;
            before = stands[i].axes::<Q>();
            continue;
        };
        let R = if m.place.first { before } else { stands[p].axes::<Q>() };
        let (own, r) = match m.motion {
            MotionKind::Hinge => {
                let turn = (Q::constant(sin[i]), Q::constant(cos[i]));
                with_twist!(m, C: Q => at(R, Placed { E: ThenZ { turn, first: C }, r: spread(m.r) }))
            }
            MotionKind::Slide => {
                let r = m.C.z.mul_add(q[m.q0 as usize], m.r);
                at(R, Placed { E: m.C.map(Q::constant), r: spread(r) })
            }
            MotionKind::Other => {
                let X = &posture.X[i];
                at(R, Placed { E: X.E.map(Q::constant), r: spread(X.r) })
            }
        };
        before = own;
        stands[i] = Stand { x: own.x.numbers(), y: own.y.numbers(), z: own.z.numbers(), r: r.numbers() };
    }
}

/// R Eᵀ and R r: to the three columns of R, E does what it does to the components of a vector.
#[inline(always)]
fn at<Q: Scalar, E: Rotation<Q>>(R: Vec3<Q>, X_up: Placed<Q, E>) -> (Vec3<Q>, Q) {
    (X_up.E.times(R), X_up.offset().dot(R))
}

/// The columns of S of a joint of any kind, angular and linear.
#[inline(always)]
fn columns<T: Real, Q: Quad<T>>(
    m: &Member<T>,
    posture: &Posture<T>,
    stand: &Stand<T>,
) -> ([(Q, Q); 6], usize) {
    let mut columns = [(Q::ZERO, Q::ZERO); 6];
    let count = m.joint.nv().min(6);
    for (k, column) in columns[..count].iter_mut().enumerate() {
        let Motion { ang, lin } = match m.motion {
            MotionKind::Hinge => Motion::new(Vec3::Z, Vec3::ZERO),
            MotionKind::Slide => Motion::new(Vec3::ZERO, Vec3::Z),
            MotionKind::Other => posture.S[m.v0 as usize + k],
        };
        *column = (stand.turned(ang), stand.turned(lin));
    }
    (columns, count)
}

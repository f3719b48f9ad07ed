//! Newton and Euler in the root's axes.
//!
//! ```text
//! a = −a_g at a root
//! for i = 1..N:   a_i = a_p + α_p × r + ω_p × (ω_p × r) + a_J + 2 ω_p × v_J + ω_J × v_J
//!                 ω_i = ω_p + ω_J        α_i = α_p + α_J + ω_p × ω_J
//! for i = N..1:   n_i = h × a + I α + ω × I ω      f_i = m a + α × h + ω × (ω × h)
//!                 τ_d = S_d · [n; f]               [n; f]_p += [n + r × f; f]
//! ```

use super::moments::Moments;
use super::{Stand, columns, combined, components, fits, stand};
use crate::dynamics::posture::Posture;
use crate::joint::Joint;
use crate::model::{Mechanism, Member, Model, MotionKind, with_twist};
use crate::scalar::{Line, Quad, Real, Scalar};
use crate::spatial::{Motion, Rotation, ThenZ, Vec3};

/// How a body moves: ω, α, and the acceleration of its origin, gravity included.
#[derive(Debug, Clone, Copy)]
#[repr(align(32))]
pub(super) struct Moving<T> {
    omega: [T; 4],
    alpha: [T; 4],
    a: [T; 4],
}

/// Room for [`rnea`]; empty for a mechanism that it does not suit.
#[derive(Debug, Clone)]
pub(in crate::dynamics) struct RneaRoom<T> {
    /// N, written by the sweep from the root.
    pub(super) stands: Vec<Stand<T>>,
    pub(super) moving: Vec<Moving<T>>,
    /// N: moment and force of what a body with several children carries.
    waiting: Vec<Line<[[T; 4]; 2]>>,
}

impl<T: Scalar> RneaRoom<T> {
    pub fn new(mechanism: &Mechanism<T::Constant>) -> Self {
        let n = if fits::<T>(mechanism) { mechanism.members.len() } else { 0 };
        let o = [T::ZERO; 4];
        Self {
            stands: vec![Stand::ROOT; n],
            moving: vec![Moving { omega: o, alpha: o, a: o }; n],
            waiting: vec![Line([o; 2]); n],
        }
    }
}

/// τ from [q, q̇, q̈].
#[inline(always)]
pub(in crate::dynamics) fn rnea<T: Real, Q: Quad<T>>(
    model: &Model<T>,
    posture: &Posture<T>,
    [q, qd, qdd]: [&[T]; 3],
    room: &mut RneaRoom<T>,
    tau: &mut [T],
) {
    move_all::<T, Q>(model, posture, [q, qd, qdd], room);
    let RneaRoom { stands, moving, waiting } = room;
    let members = &model.mechanism().members;
    let mut next = (Q::ZERO, Q::ZERO);
    for i in (0..members.len()).rev() {
        let (m, at) = (&members[i], &stands[i]);
        let d = m.v0 as usize;
        let (mut n, mut f) = force(m, &Moments::<Q>::own(m, at), &moving[i]);
        if !m.place.leaf {
            (n, f) = (n + next.0, f + next.1);
            if m.place.branches {
                let [n0, f0] = &waiting[i].0;
                (n, f) = (n + Q::from_slice(n0), f + Q::from_slice(f0));
            }
        }
        if m.motion != MotionKind::Other {
            let along = if m.motion == MotionKind::Hinge { n } else { f };
            let [along, ..] = (Q::from_slice(&at.z) * along).total().numbers();
            tau[d] = model.armature[d].mul_add(qdd[d], along);
        } else {
            let (S, count) = columns::<T, Q>(m, posture, at);
            for (d, (w, v)) in (d..).zip(&S[..count]) {
                let [along, ..] = w.mul_add(n, *v * f).total().numbers();
                tau[d] = model.armature[d].mul_add(qdd[d], along);
            }
        }
        if m.parent > 0 {
            let up = (n + Q::from_slice(&at.r).cross(f), f);
            let p = m.parent as usize - 1;
            if m.place.first {
                next = up;
            } else if m.place.last {
                waiting[p].0 = [up.0.numbers(), up.1.numbers()];
            } else {
                let [n0, f0] = waiting[p].0;
                waiting[p].0 = [(Q::of(n0) + up.0).numbers(), (Q::of(f0) + up.1).numbers()];
            }
        }
    }
}

/// Where every body stands and how it moves.
#[inline(always)]
pub(super) fn move_all<T: Real, Q: Quad<T>>(
    model: &Model<T>,
    posture: &Posture<T>,
    [q, qd, qdd]: [&[T]; 3],
    RneaRoom { stands, moving, .. }: &mut RneaRoom<T>,
) {
    stand::<T, Q>(model.mechanism(), posture, q, stands);
    let n = model.mechanism().members.len();
    let (stands, moving) = (&stands[..n], &mut moving[..n]);
    for (i, m) in model.mechanism().members.iter().enumerate() {
        let at = &stands[i];
        let (omega, alpha, a) = match (m.parent as usize).checked_sub(1) {
            None => (Q::ZERO, Q::ZERO, at_root(m, i, posture, -model.gravity)),
            Some(p) => {
                let up = &moving[p];
                let (omega, alpha) = (Q::from_slice(&up.omega), Q::from_slice(&up.alpha));
                let (a, r) = (Q::from_slice(&up.a), Q::from_slice(&at.r));
                (omega, alpha, a + alpha.cross(r) + omega.cross(omega.cross(r)))
            }
        };
        let d = m.v0 as usize;
        let (omega, alpha, a) = match m.motion {
            MotionKind::Hinge => {
                let z = Q::from_slice(&at.z);
                let omega_J = z * Q::constant(qd[d]);
                let alpha_J = z.mul_add(Q::constant(qdd[d]), omega.cross(omega_J));
                (omega + omega_J, alpha + alpha_J, a)
            }
            MotionKind::Slide => {
                let z = Q::from_slice(&at.z);
                let twice = z * Q::constant(qd[d] + qd[d]);
                (omega, alpha, a + z.mul_add(Q::constant(qdd[d]), omega.cross(twice)))
            }
            MotionKind::Other => {
                let (S, count) = columns::<T, Q>(m, posture, at);
                let mut own = [Q::ZERO; 4];
                for (d, &(w, v)) in (d..).zip(&S[..count]) {
                    let (qd, qdd) = (Q::constant(qd[d]), Q::constant(qdd[d]));
                    let [omega_J, v_J, alpha_J, a_J] = own;
                    own = [
                        w.mul_add(qd, omega_J),
                        v.mul_add(qd, v_J),
                        w.mul_add(qdd, alpha_J),
                        v.mul_add(qdd, a_J),
                    ];
                }
                let [omega_J, v_J, alpha_J, a_J] = own;
                let bias = bias(m, posture, qd);
                let (alpha_J, a_J) = (alpha_J + at.turned(bias.ang), a_J + at.turned(bias.lin));
                let after = omega + omega_J;
                let alpha = alpha + alpha_J + omega.cross(omega_J);
                (after, alpha, a + a_J + (omega + after).cross(v_J))
            }
        };
        moving[i] = Moving { omega: omega.numbers(), alpha: alpha.numbers(), a: a.numbers() };
    }
}

/// S° q̇ in the body's frame.
#[inline(always)]
fn bias<T: Real>(m: &Member<T>, posture: &Posture<T>, qd: &[T]) -> Motion<T> {
    let d = m.v0 as usize;
    match m.joint {
        Joint::Universal { .. } => m.joint.bias(&posture.S[d..d + 2], &qd[d..d + 2]),
        _ => Motion::ZERO,
    }
}

/// A vector of the world in the axes of a root.
#[inline(always)]
fn at_root<T: Real, Q: Quad<T>>(m: &Member<T>, i: usize, posture: &Posture<T>, v: Vec3<T>) -> Q {
    let Vec3 { x, y, z } = match m.motion {
        MotionKind::Hinge => {
            let turn = (posture.sin[i], posture.cos[i]);
            with_twist!(m, C: T => ThenZ { turn, first: C }.times(v))
        }
        MotionKind::Slide => m.C * v,
        MotionKind::Other => posture.X[i].E * v,
    };
    Q::of([x, y, z, T::ZERO])
}

/// Moment and force that a body's own motion takes.
#[inline(always)]
pub(super) fn force<T: Real, Q: Quad<T>>(m: &Member<T>, J: &Moments<Q>, moving: &Moving<T>) -> (Q, Q) {
    let (omega, alpha) = (Q::from_slice(&moving.omega), Q::from_slice(&moving.alpha));
    let a = Q::from_slice(&moving.a);
    let I = J.rotational();
    let (I_omega, I_alpha) = (combined(I, components(&moving.omega)), combined(I, components(&moving.alpha)));
    let n = J.h.cross(a) + I_alpha + omega.cross(I_omega);
    let f = a.mul_add(Q::constant(m.I.m), alpha.cross(J.h) + omega.cross(omega.cross(J.h)));
    (n, f)
}

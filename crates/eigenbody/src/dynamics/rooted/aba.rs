//! Articulated bodies in the root's axes.
//!
//! ```text
//! ω, α, a of every body at q̈ = 0, gravity included             as in RNEA
//! for i = N..1:   IA = I_i, p = [n; f]_i of that motion, and what the children hand on
//!                 for d of body i, last to first:
//!                     U = IA S      D = Sᵀ U + armature      y = (τ − Sᵀ p)/D
//!                     IA −= U D⁻¹ Uᵀ      p += U y
//!                 IA_p += IA shifted by r      p_p += p shifted by r
//! for i = 1..N:   δ = δ_p shifted by r
//!                 for d of body i, first to last:   q̈ = y − D⁻¹ Uᵀ δ;   δ += S q̈
//! ```
//! δ is what the accelerations q̈ add to the motion at q̈ = 0.

use super::moments::Moments;
use super::rnea::{RneaRoom, force, move_all};
use super::{Stand, columns, combined, components, fits, units};
use crate::dynamics::posture::Posture;
use crate::model::{Model, MotionKind};
use crate::scalar::{Line, Quad, Real, Scalar};
use crate::spatial::Vec3;

/// IA by rows: [I H; Hᵀ M], nine registers.
#[derive(Debug, Clone, Copy)]
struct Articulated<Q> {
    I: Vec3<Q>,
    H: Vec3<Q>,
    M: Vec3<Q>,
}

/// A bias force.
#[derive(Debug, Clone, Copy)]
struct Wrench<Q> {
    n: Q,
    f: Q,
}

/// A degree of freedom that is eliminated: U/D, and y in all places.
#[derive(Debug, Clone, Copy)]
#[repr(align(32))]
struct Eliminated<T> {
    n: [T; 4],
    f: [T; 4],
    y: [T; 4],
}

/// Room for [`aba`]; empty for a mechanism that it does not suit.
#[derive(Debug, Clone)]
pub(in crate::dynamics) struct AbaRoom<T> {
    /// N: IA and p of what a body with several children carries.
    waiting: Vec<Line<[[T; 4]; 11]>>,
    /// nv.
    dofs: Vec<Eliminated<T>>,
    /// N: angular and linear δ.
    delta: Vec<Line<[[T; 4]; 2]>>,
}

impl<T: Scalar> AbaRoom<T> {
    pub fn new(model: &Model<T::Constant>) -> Self {
        let n = if fits::<T>(model.mechanism()) { model.mechanism().members.len() } else { 0 };
        let o = [T::ZERO; 4];
        Self {
            waiting: vec![Line([o; 11]); n],
            dofs: vec![Eliminated { n: o, f: o, y: o }; if n > 0 { model.nv() } else { 0 }],
            delta: vec![Line([o; 2]); n],
        }
    }
}

/// q̈ and the pivots D, from [q, q̇, zeros, τ].
#[inline(always)]
pub(in crate::dynamics) fn aba<T: Real, Q: Quad<T>>(
    model: &Model<T>,
    posture: &Posture<T>,
    [q, qd, zeros, tau]: [&[T]; 4],
    room: &mut RneaRoom<T>,
    AbaRoom { waiting, dofs, delta }: &mut AbaRoom<T>,
    (D, qdd): (&mut [T], &mut [T]),
) {
    move_all::<T, Q>(model, posture, [q, qd, zeros], room);
    let RneaRoom { stands, moving, .. } = room;
    let members = &model.mechanism().members;
    let o = Vec3::new(Q::ZERO, Q::ZERO, Q::ZERO);
    let mut next = (Articulated { I: o, H: o, M: o }, Wrench { n: Q::ZERO, f: Q::ZERO });
    for i in (0..members.len()).rev() {
        let (m, at) = (&members[i], &stands[i]);
        let d = m.v0 as usize;
        let J = Moments::<Q>::own(m, at);
        let (n, f) = force(m, &J, &moving[i]);
        let (mut IA, mut p) = (Articulated::rigid(Q::constant(m.I.m), &J), Wrench { n, f });
        if !m.place.leaf {
            (IA, p) = (IA.plus(next.0), p.plus(next.1));
            if m.place.branches {
                let (more, force) = load(&waiting[i].0);
                (IA, p) = (IA.plus(more), p.plus(force));
            }
        }
        if m.motion != MotionKind::Other {
            let (z, axis) = (components::<T, Q>(&at.z), Q::from_slice(&at.z));
            let (U, along, force) = match m.motion {
                MotionKind::Hinge => {
                    let U = Wrench { n: combined(IA.I, z), f: combined(IA.H, z) };
                    (U, U.n, p.n)
                }
                _ => {
                    let U = Wrench { n: combined(transpose(IA.H), z), f: combined(IA.M, z) };
                    (U, U.f, p.f)
                }
            };
            let pivot = (axis * along).total() + Q::constant(model.armature[d]);
            let u = Q::constant(tau[d]) - (axis * force).total();
            (dofs[d], D[d]) = eliminate(&mut IA, &mut p, U, pivot, u);
        } else {
            let (S, count) = columns::<T, Q>(m, posture, at);
            let columns = m.joint.columns();
            for ((d, &(w, v)), column) in (d..d + count).zip(&S[..count]).zip(columns).rev() {
                let U = match column.place() {
                    // The axes of a root are its own.
                    Some(place) if m.parent == 0 => IA.column(place),
                    _ => IA.times(w, v),
                };
                let pivot = w.mul_add(U.n, v * U.f).total() + Q::constant(model.armature[d]);
                let u = Q::constant(tau[d]) - w.mul_add(p.n, v * p.f).total();
                (dofs[d], D[d]) = eliminate(&mut IA, &mut p, U, pivot, u);
            }
        }
        if m.parent > 0 {
            let up =
                (IA.shifted(components(&at.r)), Wrench { n: p.n + Q::from_slice(&at.r).cross(p.f), f: p.f });
            let parent = m.parent as usize - 1;
            if m.place.first {
                next = up;
            } else if m.place.last {
                waiting[parent].0 = store(up);
            } else {
                let (IA, p) = load(&waiting[parent].0);
                waiting[parent].0 = store((IA.plus(up.0), p.plus(up.1)));
            }
        }
    }
    accelerate::<T, Q>(model, posture, stands, dofs, delta, qdd);
}

/// The sweep from the root.
#[inline(always)]
fn accelerate<T: Real, Q: Quad<T>>(
    model: &Model<T>,
    posture: &Posture<T>,
    stands: &[Stand<T>],
    dofs: &[Eliminated<T>],
    delta: &mut [Line<[[T; 4]; 2]>],
    qdd: &mut [T],
) {
    for (i, m) in model.mechanism().members.iter().enumerate() {
        let at = &stands[i];
        let (mut ang, mut lin) = match (m.parent as usize).checked_sub(1) {
            None => (Q::ZERO, Q::ZERO),
            Some(p) => {
                let [ang, lin] = &delta[p].0;
                let ang = Q::from_slice(ang);
                (ang, Q::from_slice(lin) + ang.cross(Q::from_slice(&at.r)))
            }
        };
        let d = m.v0 as usize;
        if m.is_free_root() {
            (ang, lin) = free_root(&dofs[d..d + 6], &mut qdd[d..d + 6]);
        } else if m.motion != MotionKind::Other {
            let (x, z) = (accelerated(&dofs[d], ang, lin), Q::from_slice(&at.z));
            [qdd[d], ..] = x.numbers();
            match m.motion {
                MotionKind::Hinge => ang = z.mul_add(x, ang),
                _ => lin = z.mul_add(x, lin),
            }
        } else {
            let (S, count) = columns::<T, Q>(m, posture, at);
            for (d, (w, v)) in (d..).zip(&S[..count]) {
                let x = accelerated(&dofs[d], ang, lin);
                [qdd[d], ..] = x.numbers();
                (ang, lin) = (w.mul_add(x, ang), v.mul_add(x, lin));
            }
        }
        delta[i].0 = [ang.numbers(), lin.numbers()];
    }
}

/// q̈ and δ of a body that is free in the world: S = 1, and what an acceleration changes is taken from all later ones at once.
#[inline(always)]
fn free_root<T: Real, Q: Quad<T>>(dofs: &[Eliminated<T>], qdd: &mut [T]) -> (Q, Q) {
    let mut x = [T::ZERO; 6];
    for d in 0..6 {
        [x[d], ..] = dofs[d].y;
    }
    for e in 0..6 {
        for d in e + 1..6 {
            let U = if e < 3 { dofs[d].n[e] } else { dofs[d].f[e - 3] };
            x[d] = U.mul_add(-x[e], x[d]);
        }
    }
    qdd.copy_from_slice(&x);
    (Q::of([x[0], x[1], x[2], T::ZERO]), Q::of([x[3], x[4], x[5], T::ZERO]))
}

/// y − D⁻¹ Uᵀ δ.
#[inline(always)]
fn accelerated<T: Real, Q: Quad<T>>(dof: &Eliminated<T>, ang: Q, lin: Q) -> Q {
    Q::from_slice(&dof.y) - Q::from_slice(&dof.n).mul_add(ang, Q::from_slice(&dof.f) * lin).total()
}

/// IA −= U D⁻¹ Uᵀ, p += U y; what is kept of the degree of freedom, and D.
#[inline(always)]
fn eliminate<T: Real, Q: Quad<T>>(
    IA: &mut Articulated<Q>,
    p: &mut Wrench<Q>,
    U: Wrench<Q>,
    D: Q,
    u: Q,
) -> (Eliminated<T>, T) {
    let D_inverse = Q::ONE / D;
    let (n, f, y) = (U.n * D_inverse, U.f * D_inverse, u * D_inverse);
    let ([nx, ny, nz, _], [fx, fy, fz, _]) = ((-n).each(), (-f).each());
    let Articulated { I, H, M } = *IA;
    *IA = Articulated {
        I: Vec3::new(U.n.mul_add(nx, I.x), U.n.mul_add(ny, I.y), U.n.mul_add(nz, I.z)),
        H: Vec3::new(U.f.mul_add(nx, H.x), U.f.mul_add(ny, H.y), U.f.mul_add(nz, H.z)),
        M: Vec3::new(U.f.mul_add(fx, M.x), U.f.mul_add(fy, M.y), U.f.mul_add(fz, M.z)),
    };
    *p = Wrench { n: U.n.mul_add(y, p.n), f: U.f.mul_add(y, p.f) };
    let [pivot, ..] = D.numbers();
    (Eliminated { n: n.numbers(), f: f.numbers(), y: y.numbers() }, pivot)
}

impl<Q> Articulated<Q> {
    /// I, [h]× and m 1.
    #[inline(always)]
    fn rigid<T: Real>(m: Q, J: &Moments<Q>) -> Self
    where
        Q: Quad<T>,
    {
        let ([x, y, z, _], o) = (J.h.numbers(), T::ZERO);
        let H = Vec3::new(Q::of([o, -z, y, o]), Q::of([z, o, -x, o]), Q::of([-y, x, o, o]));
        Self { I: J.rotational(), H, M: units::<T, Q>() * m }
    }

    #[inline(always)]
    fn plus<T: Real>(self, b: Self) -> Self
    where
        Q: Quad<T>,
    {
        Self { I: self.I + b.I, H: self.H + b.H, M: self.M + b.M }
    }

    /// Column k.
    #[inline(always)]
    fn column<T: Real>(&self, k: usize) -> Wrench<Q>
    where
        Q: Quad<T>,
    {
        let Self { I, H, M } = *self;
        match k {
            0 => Wrench { n: I.x, f: H.x },
            1 => Wrench { n: I.y, f: H.y },
            2 => Wrench { n: I.z, f: H.z },
            3 => Wrench { n: transpose(H).x, f: M.x },
            4 => Wrench { n: transpose(H).y, f: M.y },
            _ => Wrench { n: transpose(H).z, f: M.z },
        }
    }

    /// IA [w; v].
    #[inline(always)]
    fn times<T: Real>(&self, w: Q, v: Q) -> Wrench<Q>
    where
        Q: Quad<T>,
    {
        let ([wx, wy, wz, _], [vx, vy, vz, _]) = (w.each(), v.each());
        let (w, v) = (Vec3::new(wx, wy, wz), Vec3::new(vx, vy, vz));
        Wrench {
            n: combined(self.I, w) + combined(transpose(self.H), v),
            f: combined(self.H, w) + combined(self.M, v),
        }
    }

    /// H + W, W = [r]× M;  I + X + Xᵀ, X = [r]× (H + W/2)ᵀ.
    #[inline(always)]
    fn shifted<T: Real>(self, r: Vec3<Q>) -> Self
    where
        Q: Quad<T>,
    {
        let Self { I, H, M } = self;
        let W = crossed(r, M);
        let half = Q::from_f64(0.5);
        let X = crossed(r, transpose(W.mul_add(half, H)));
        Self { I: I + X + transpose(X), H: H + W, M }
    }
}

impl<Q> Wrench<Q> {
    #[inline(always)]
    fn plus<T: Real>(self, b: Self) -> Self
    where
        Q: Quad<T>,
    {
        Self { n: self.n + b.n, f: self.f + b.f }
    }
}

/// [r]× A, by rows.
#[inline(always)]
fn crossed<T: Real, Q: Quad<T>>(r: Vec3<Q>, A: Vec3<Q>) -> Vec3<Q> {
    Vec3::new(A.z.mul_add(r.y, -(A.y * r.z)), A.x.mul_add(r.z, -(A.z * r.x)), A.y.mul_add(r.x, -(A.x * r.y)))
}

#[inline(always)]
fn transpose<T: Real, Q: Quad<T>>(A: Vec3<Q>) -> Vec3<Q> {
    let [x, y, z, _] = Q::transpose([A.x, A.y, A.z, Q::ZERO]);
    Vec3::new(x, y, z)
}

#[inline(always)]
fn load<T: Real, Q: Quad<T>>(
    [ix, iy, iz, hx, hy, hz, mx, my, mz, n, f]: &[[T; 4]; 11],
) -> (Articulated<Q>, Wrench<Q>) {
    let IA = Articulated {
        I: Vec3::new(Q::from_slice(ix), Q::from_slice(iy), Q::from_slice(iz)),
        H: Vec3::new(Q::from_slice(hx), Q::from_slice(hy), Q::from_slice(hz)),
        M: Vec3::new(Q::from_slice(mx), Q::from_slice(my), Q::from_slice(mz)),
    };
    (IA, Wrench { n: Q::from_slice(n), f: Q::from_slice(f) })
}

#[inline(always)]
fn store<T: Real, Q: Quad<T>>((Articulated { I, H, M }, p): (Articulated<Q>, Wrench<Q>)) -> [[T; 4]; 11] {
    [
        I.x.numbers(),
        I.y.numbers(),
        I.z.numbers(),
        H.x.numbers(),
        H.y.numbers(),
        H.z.numbers(),
        M.x.numbers(),
        M.y.numbers(),
        M.z.numbers(),
        p.n.numbers(),
        p.f.numbers(),
    ]
}

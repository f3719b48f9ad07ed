//! The articulated-body algorithm: forces at q̈ = 0 first, then a robot at rest under them.
//!
//! ```text
//! p_i                                                the force that moves body i at q̈ = 0, gravity included: RNEA's forward sweep
//! for i = N..1:   for d of body i, last to first:
//!                     U_d = IA_i S_d      D_d = S_dᵀ U_d + armature_d      u_d = τ_d − S_dᵀ p_i
//!                     IA_i −= U_d D_d⁻¹ U_dᵀ      p_i += U_d D_d⁻¹ u_d
//!                 IA_p += X_upᵀ IA_i X_up        p_p += X_upᵀ p_i          (IA_i starts as I_i)
//! for i = 1..N:   a = X_up a_p
//!                 for d of body i, first to last:   q̈_d = D_d⁻¹ (u_d − U_dᵀ a);   a += S_d q̈_d
//! ```
//! Featherstone (2008), table 7.1, without its velocity terms: H q̈ = τ − C is a robot at rest, pushed by −p_i. A joint of
//! k DoFs is k hinges in the same place with massless links between. Cost O(N). H = L D Lᵀ with these D: they are the pivots of a
//! Cholesky-type elimination of H from the tips inwards.

use super::posture::{Posture, position, slide};
use super::rnea::{RneaWorkspace, forces};
use super::rooted;
use crate::error::{Error, NotPositiveDefinite, check_length};
use crate::joint::Column;
use crate::model::{Model, MotionKind, with_turn, with_twist};
use crate::scalar::{Algorithm, Quad, Real, Scalar, dispatch_one};
use crate::spatial::{ArticulatedInertia, Force, Motion, Placed, ThenZ, Vec3};

/// Room for [`forward_dynamics_into`].
#[derive(Debug, Clone)]
pub struct AbaWorkspace<T> {
    bias: RneaWorkspace<T>,
    /// By level: what the subtrees of a body add to its own articulated inertia and bias force. Written and read by the backward sweep.
    carried: Vec<Handed<T>>,
    /// By level, the world first: accelerations on the path to the body at hand.
    a: Vec<Motion<T>>,
    /// nv: what q̈ is made of. Written by the backward sweep.
    hinges: Vec<Hinge<T>>,
    /// nv: hinge inertias. Written by the backward sweep.
    D: Vec<T>,
    rooted: rooted::AbaRoom<T>,
}

/// u, U = IA S, and D⁻¹ of a degree of freedom.
#[derive(Debug, Clone, Copy)]
struct Hinge<T> {
    u: T,
    U: Force<T>,
    D_inverse: T,
}

impl<T: Scalar> AbaWorkspace<T> {
    /// Room for a model.
    pub fn new(model: &Model<T::Constant>) -> Self {
        let (levels, nv) = (model.mechanism().depth + 1, model.nv());
        Self {
            bias: RneaWorkspace::new(model),
            carried: vec![(ArticulatedInertia::ZERO, Force::ZERO); levels],
            a: vec![Motion::ZERO; levels],
            hinges: vec![Hinge { u: T::ZERO, U: Force::ZERO, D_inverse: T::ZERO }; nv],
            D: vec![T::ZERO; nv],
            rooted: rooted::AbaRoom::new(model),
        }
    }
}

impl<T> AbaWorkspace<T> {
    /// The hinge inertias of the last sweep.
    pub(crate) fn pivots(&self) -> &[T] {
        &self.D
    }
}

/// Acceleration under the generalised forces τ: v̇ = H(q)⁻¹ (τ − C(q, v)), without forming H.
///
/// | name | shape | unit |
/// |------|-------|------|
/// | `q` | `nq` | rad, m, unit quaternion |
/// | `v` | `nv` | rad/s, m/s |
/// | `tau` | `nv` | N m, N |
/// | v̇ (returned) | `nv` | rad/s², m/s² |
///
/// Method: articulated bodies, Featherstone (2008) table 7.1. O(N); allocates. Numerics: error governed by κ′, the
/// conditioning with each joint in units of its own inertia. Hinge inertias are looked at, v̇ is not: what overflows on the way to it is
/// infinite or NaN, as IEEE 754 has it.
///
/// Errors: [`InputError`](crate::InputError) as [`inverse_dynamics`](super::inverse_dynamics); [`NotPositiveDefinite`] with the
/// DoF if a hinge inertia is not positive.
///
/// ```
/// use eigenbody::{Family, forward_dynamics};
/// let arm = Family::slender_chain(1, 2.0, 1.0)?.model::<f64>()?;
/// // A rod let go from the horizontal: 3g/2l.
/// let vdot = forward_dynamics(&arm, &[0.0], &[0.0], &[0.0])?;
/// assert!((vdot[0] + 1.5 * 9.81).abs() < 1e-13);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[doc(alias = "aba")]
pub fn forward_dynamics<T: Real>(model: &Model<T>, q: &[T], v: &[T], tau: &[T]) -> Result<Vec<T>, Error> {
    let mut vdot = vec![T::ZERO; model.nv()];
    forward_dynamics_into(model, q, v, tau, &mut AbaWorkspace::new(model), &mut vdot)?;
    Ok(vdot)
}

/// [`forward_dynamics`] into the caller's memory; allocates nothing.
///
/// Errors: as [`forward_dynamics`], if `vdot` has the wrong length, and [`InputError::OtherModel`](crate::InputError::OtherModel) for the
/// workspace. After [`NotPositiveDefinite`] `vdot` holds no result.
pub fn forward_dynamics_into<T: Real>(
    model: &Model<T>,
    q: &[T],
    v: &[T],
    tau: &[T],
    workspace: &mut AbaWorkspace<T>,
    vdot: &mut [T],
) -> Result<(), Error> {
    model.check_shape("workspace", workspace.bias.shape)?;
    model.check_q(q)?;
    model.check_v("v", v)?;
    model.check_v("tau", tau)?;
    check_length("vdot", vdot.len(), model.nv())?;
    dispatch_one(Aba { model, q, v, tau, workspace: &mut *workspace, vdot });
    // Checked from the tips inwards, in the order of elimination: the first bad pivot is the one to name.
    match model.dofs.order().rev().find(|&d| !(workspace.D[d] > T::ZERO && workspace.D[d].is_finite())) {
        Some(dof) => Err(NotPositiveDefinite { dof, pivot: workspace.D[dof].to_f64() }.into()),
        None => Ok(()),
    }
}

/// The algorithm with its arguments, which have been checked.
pub(crate) struct Aba<'a, T, U> {
    pub model: &'a Model<T>,
    pub q: &'a [U],
    pub v: &'a [U],
    pub tau: &'a [U],
    pub workspace: &'a mut AbaWorkspace<U>,
    pub vdot: &'a mut [U],
}

impl<T: Real> Algorithm<T> for Aba<'_, T, T> {
    type Output = ();
    #[inline(always)]
    fn run<S: Scalar<Constant = T, Stored = T>>(self) {
        self.sweep::<S>();
    }
    #[inline(always)]
    fn run_in_fours<S: Scalar<Constant = T, Stored = T, Columns: Quad<T>>>(self) {
        if !rooted::suits::<T>(self.model.mechanism()) {
            return self.run::<S>();
        }
        let Self { model, q, v, tau, workspace: AbaWorkspace { bias, D, rooted, .. }, vdot } = self;
        bias.posture.update::<S>(model.mechanism(), q);
        let RneaWorkspace { posture, zeros, rooted: moving, .. } = bias;
        rooted::aba::<T, S::Columns>(model, posture, [q, v, zeros, tau], moving, rooted, (D, vdot));
    }
}

impl<T: Real, U: Scalar<Constant = T>> Aba<'_, T, U> {
    /// Bias pass and both sweeps.
    #[inline(always)]
    pub fn sweep<S: Scalar<Constant = T, Stored = U>>(self) {
        let Self { model, q, v, tau, workspace, vdot } = self;
        let AbaWorkspace { bias, carried, a, hinges, D, .. } = workspace;
        bias.posture.update::<S>(model.mechanism(), q);
        let zeros = std::mem::take(&mut bias.zeros);
        forces::<S>(model, q, v, &zeros, bias);
        bias.zeros = zeros;
        inwards::<S>(model, q, tau, bias, carried, hinges, D);
        outwards::<S>(model, &bias.posture, q, a, hinges, vdot);
    }
}

/// What a body's children hand down: inertia and bias force.
type Handed<T> = (ArticulatedInertia<T>, Force<T>);

/// Eliminates the hinges, tips first.
#[inline(always)]
fn inwards<S: Scalar>(
    model: &Model<S::Constant>,
    q: &[S::Stored],
    tau: &[S::Stored],
    RneaWorkspace { posture, f, .. }: &RneaWorkspace<S::Stored>,
    carried: &mut [Handed<S::Stored>],
    hinges: &mut [Hinge<S::Stored>],
    D: &mut [S::Stored],
) {
    for (i, m) in model.mechanism().members.iter().enumerate().rev() {
        let (body, f_i) = (m.I.map(S::constant), f[i + 1].map(S::load));
        let (mut IA_i, mut p_i) = if m.place.leaf {
            (body.articulated(), f_i)
        } else {
            let (IA, p) = &carried[m.own_sum()];
            (IA.map(S::load).plus_body(body), f_i + p.map(S::load))
        };
        let mut eliminate =
            Eliminate { IA: &mut IA_i, p: &mut p_i, tau, hinges, D, armature: &model.armature };
        let d = m.v0 as usize;
        match m.motion {
            MotionKind::Hinge => eliminate.unit::<2>(d),
            MotionKind::Slide => eliminate.unit::<5>(d),
            MotionKind::Other if m.is_free_root() => eliminate.all(d),
            MotionKind::Other => {
                for (d, &column) in (d..d + m.joint.nv()).zip(m.joint.columns()).rev() {
                    eliminate.column(d, column, posture.S[d].map(S::load));
                }
            }
        }
        if m.parent == 0 {
            continue;
        }
        let (mut IA_up, mut p_up) = match m.motion {
            MotionKind::Hinge => {
                let (turn, r) = (posture.turn::<S>(i), position::<S>(m));
                with_twist!(m, C: S => Placed { E: ThenZ { turn, first: C }, r }.transpose_both(IA_i, p_i))
            }
            MotionKind::Slide => {
                with_turn!(m, C: S => slide::<S, _>(m, C, q).transpose_both(IA_i, p_i))
            }
            MotionKind::Other => posture.placed::<S>(i).transpose_both(IA_i, p_i),
        };
        let (IA, p) = &mut carried[m.carrier_sum()];
        if !m.place.last {
            (IA_up, p_up) = (IA_up + IA.map(S::load), p_up + p.map(S::load));
        }
        (*IA, *p) = (IA_up.map(S::store), p_up.map(S::store));
    }
}

/// Accelerations, from the world on.
#[inline(always)]
fn outwards<S: Scalar>(
    model: &Model<S::Constant>,
    posture: &Posture<S::Stored>,
    q: &[S::Stored],
    a: &mut [Motion<S::Stored>],
    hinges: &[Hinge<S::Stored>],
    qdd: &mut [S::Stored],
) {
    for (i, m) in model.mechanism().members.iter().enumerate() {
        let d = m.v0 as usize;
        let mut a_i = if m.parent == 0 {
            Motion::ZERO
        } else {
            let a_p = a[m.level as usize - 1].map(S::load);
            match m.motion {
                MotionKind::Hinge => {
                    let (turn, r) = (posture.turn::<S>(i), position::<S>(m));
                    with_twist!(m, C: S => Placed { E: ThenZ { turn, first: C }, r }.motion(a_p))
                }
                MotionKind::Slide => with_turn!(m, C: S => slide::<S, _>(m, C, q).motion(a_p)),
                MotionKind::Other => posture.placed::<S>(i).motion(a_p),
            }
        };
        match m.motion {
            MotionKind::Hinge => a_i.ang.z += accelerate::<S>(d, a_i, hinges, qdd),
            MotionKind::Slide => a_i.lin.z += accelerate::<S>(d, a_i, hinges, qdd),
            MotionKind::Other if m.is_free_root() => {
                let mut x = [S::ZERO; 6];
                for ((qdd, x), hinge) in qdd[d..d + 6].iter_mut().zip(&mut x).zip(&hinges[d..d + 6]) {
                    (*qdd, *x) = (hinge.u, S::load(hinge.u));
                }
                a_i = Motion::new(Vec3::new(x[0], x[1], x[2]), Vec3::new(x[3], x[4], x[5]));
            }
            MotionKind::Other => {
                for (d, &column) in (d..).zip(m.joint.columns()) {
                    let qdd_d = accelerate::<S>(d, a_i, hinges, qdd);
                    a_i = column.moved(a_i, posture.S[d].map(S::load), qdd_d);
                }
            }
        }
        a[m.level as usize] = a_i.map(S::store);
    }
}

/// q̈_d = D_d⁻¹ (u_d − U_dᵀ a).
#[inline(always)]
fn accelerate<S: Scalar>(d: usize, a: Motion<S>, hinges: &[Hinge<S::Stored>], qdd: &mut [S::Stored]) -> S {
    let Hinge { u, U, D_inverse } = &hinges[d];
    // Two sums that do not wait for each other: the next body waits for this one.
    let U = U.map(S::load);
    let qdd_d = ((-a.ang).dot_add(U.ang, S::load(*u)) - a.lin.dot(U.lin)) * S::load(*D_inverse);
    qdd[d] = qdd_d.store();
    qdd_d
}

/// A body's inertia and bias force while its hinges are eliminated.
struct Eliminate<'a, S: Scalar> {
    IA: &'a mut ArticulatedInertia<S>,
    p: &'a mut Force<S>,
    tau: &'a [S::Stored],
    hinges: &'a mut [Hinge<S::Stored>],
    D: &'a mut [S::Stored],
    armature: &'a [S::Constant],
}

impl<S: Scalar> Eliminate<'_, S> {
    /// DoF d, whose column is the K-th unit vector. What is left of IA S, a row and a column, is written without cancelling.
    #[inline(always)]
    fn unit<const K: usize>(&mut self, d: usize) {
        let (U, armature) = (self.IA.column::<K>(), S::constant(self.armature[d]));
        let D = U.component::<K>() + armature;
        let (D_inverse, u) = (S::ONE / D, S::load(self.tau[d]) - self.p.component::<K>());
        *self.IA = self.IA.minus_outer(U, D_inverse).with_column::<K>(U * (armature * D_inverse));
        *self.p += U * (D_inverse * u);
        self.hinges[d] = Hinge { u: u.store(), U: U.map(S::store), D_inverse: D_inverse.store() };
        self.D[d] = D.store();
    }

    /// Six DoFs from d on whose columns are the unit vectors, of a body that the world carries: u becomes q̈, and U no longer matters.
    ///
    /// ```text
    /// L D Lᵀ q̈ = τ − p,   the last row first
    /// ```
    #[inline(always)]
    fn all(&mut self, d: usize) {
        let (mut A, mut u) = (self.IA.rows(), self.p.to_array());
        for (k, u) in u.iter_mut().enumerate() {
            A[k][k] += S::constant(self.armature[d + k]);
            *u = S::load(self.tau[d + k]) - *u;
        }
        for k in (0..6).rev() {
            let U = A[k];
            let D_inverse = S::ONE / U[k];
            self.D[d + k] = U[k].store();
            u[k] *= D_inverse;
            for e in 0..k {
                let L = U[e] * D_inverse;
                for f in 0..=e {
                    A[e][f] = U[f].mul_add(-L, A[e][f]);
                }
                u[e] = U[e].mul_add(-u[k], u[e]);
                A[k][e] = L;
            }
        }
        for k in 1..6 {
            for e in 0..k {
                u[k] = A[k][e].mul_add(-u[e], u[k]);
            }
        }
        for (hinge, u) in self.hinges[d..d + 6].iter_mut().zip(u) {
            hinge.u = u.store();
        }
    }

    /// DoF d with any column.
    #[inline(always)]
    fn any(&mut self, d: usize, S_d: Motion<S>) {
        let U = self.IA.times(S_d);
        let D = S_d.dot(U) + S::constant(self.armature[d]);
        let (D_inverse, u) = (S::ONE / D, S::load(self.tau[d]) - S_d.dot(*self.p));
        *self.IA = self.IA.minus_outer(U, D_inverse);
        *self.p += U * (D_inverse * u);
        self.hinges[d] = Hinge { u: u.store(), U: U.map(S::store), D_inverse: D_inverse.store() };
        self.D[d] = D.store();
    }

    #[inline(always)]
    fn column(&mut self, d: usize, column: Column, S_d: Motion<S>) {
        match column {
            Column::AngX => self.unit::<0>(d),
            Column::AngY => self.unit::<1>(d),
            Column::AngZ => self.unit::<2>(d),
            Column::LinX => self.unit::<3>(d),
            Column::LinY => self.unit::<4>(d),
            Column::LinZ => self.unit::<5>(d),
            Column::General => self.any(d, S_d),
        }
    }
}

//! The recursive Newton-Euler algorithm, in the form that never needs a linear velocity.
//!
//! ```text
//! a_0 = −a_g
//! for i = 1..N:   ω_i = E ω_p + ω_J                α_i = E α_p + α_J + E ω_p × ω_J
//!                 a_i = E (a_p + Ψ_p r) + a_J + (2 E ω_p + ω_J) × v_J
//!                 Ψ_i = [α_i]× + [ω_i]×²           every point ρ of body i accelerates by a_i + Ψ_i ρ
//!                 f_i = m a_i + Ψ_i h              n_i = h × a_i + axial(Ψ_i P)
//! for i = N..1:   τ_i = S_iᵀ [n_i; f_i] + armature_i q̈_i
//!                 [n_p; f_p] += X_upᵀ [n_i; f_i]
//! ```
//! ω_J, v_J and α_J, a_J are S q̇ and S q̈ + S° q̇. Accelerations are those of points, not spatial ones: table 5.1 of Featherstone (2008),
//! which `plain` has as it stands, with a_i + ω_i × v_i for the linear part. P are the second moments of mass. Cost O(N).

use super::posture::{Posture, position, slide};
use super::rooted;
use crate::error::{InputError, check_length};
use crate::joint::Joint;
use crate::model::{Mechanism, Member, Model, MotionKind, Shape, with_turn, with_twist};
use crate::scalar::{Algorithm, Quad, Real, Scalar, dispatch_one};
use crate::spatial::{Force, Mat3, Motion, Placed, Rotation, ThenZ, Vec3};

/// Room for [`inverse_dynamics_into`].
#[derive(Debug, Clone)]
pub struct RneaWorkspace<T> {
    pub(super) shape: Shape,
    pub(super) posture: Posture<T>,
    /// By level, the world first: the bodies on the path to the one at hand.
    path: Vec<Moving<T>>,
    /// N + 1, the world first: force that moves each body, then force transmitted through its joint. Written forwards, accumulated
    /// backwards.
    pub(super) f: Vec<Force<T>>,
    /// nv: zeros, for the callers that need v = 0 or v̇ = 0.
    pub(super) zeros: Vec<T>,
    pub(super) rooted: rooted::RneaRoom<T>,
}

/// How a body moves. Written by the forward sweep.
#[derive(Debug, Clone, Copy)]
struct Moving<T> {
    omega: Vec3<T>,
    alpha: Vec3<T>,
    /// Of the frame's origin, gravity included.
    a: Vec3<T>,
    Psi: Mat3<T>,
}

impl<T: Scalar> RneaWorkspace<T> {
    /// Room for a model.
    pub fn new(model: &Model<T::Constant>) -> Self {
        let n = model.bodies.len() + 1;
        let still = Moving { omega: Vec3::ZERO, alpha: Vec3::ZERO, a: Vec3::ZERO, Psi: Mat3::ZERO };
        Self {
            shape: model.shape,
            posture: Posture::new(model.mechanism()),
            path: vec![still; model.mechanism().depth + 1],
            f: vec![Force::ZERO; n],
            zeros: vec![T::ZERO; model.nv()],
            rooted: rooted::RneaRoom::new(model.mechanism()),
        }
    }
}

/// Generalised forces that give the acceleration v̇: τ = H(q) v̇ + C(q, v).
///
/// | name | shape | unit |
/// |------|-------|------|
/// | `q` | `nq` | rad, m, unit quaternion |
/// | `v` | `nv` | rad/s, m/s |
/// | `vdot` | `nv` | rad/s², m/s² |
/// | τ (returned) | `nv` | N m, N |
///
/// Method: recursive Newton-Euler, Featherstone (2008) table 5.1, in body frames; gravity as an acceleration of the base.
/// O(N); allocates. Numerics: backward stable, error of order ε times the forces that meet in a joint. What overflows is
/// infinite or NaN, as IEEE 754 has it.
///
/// Errors: [`InputError`] if an argument has the wrong length, a number that is not finite, or no unit quaternion.
///
/// ```
/// use eigenbody::{Family, inverse_dynamics};
/// let arm = Family::slender_chain(1, 2.0, 1.0)?.model::<f64>()?;
/// // A horizontal rod of 2 kg and 1 m: holding torque m g l/2.
/// let tau = inverse_dynamics(&arm, &[0.0], &[0.0], &[0.0])?;
/// assert!((tau[0] - 9.81).abs() < 1e-14);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[doc(alias = "rnea")]
pub fn inverse_dynamics<T: Real>(
    model: &Model<T>,
    q: &[T],
    v: &[T],
    vdot: &[T],
) -> Result<Vec<T>, InputError> {
    let mut tau = vec![T::ZERO; model.nv()];
    inverse_dynamics_into(model, q, v, vdot, &mut RneaWorkspace::new(model), &mut tau)?;
    Ok(tau)
}

/// [`inverse_dynamics`] into the caller's memory; allocates nothing.
///
/// Errors: as [`inverse_dynamics`], if `tau` has the wrong length, and [`InputError::OtherModel`] for the workspace.
pub fn inverse_dynamics_into<T: Real>(
    model: &Model<T>,
    q: &[T],
    v: &[T],
    vdot: &[T],
    workspace: &mut RneaWorkspace<T>,
    tau: &mut [T],
) -> Result<(), InputError> {
    model.check_shape("workspace", workspace.shape)?;
    model.check_q(q)?;
    model.check_v("v", v)?;
    model.check_v("vdot", vdot)?;
    check_length("tau", tau.len(), model.nv())?;
    dispatch_one(Rnea { model, q, v, vdot, workspace, tau });
    Ok(())
}

/// The algorithm with its arguments, which have been checked.
pub(crate) struct Rnea<'a, T, U> {
    pub model: &'a Model<T>,
    pub q: &'a [U],
    pub v: &'a [U],
    pub vdot: &'a [U],
    pub workspace: &'a mut RneaWorkspace<U>,
    pub tau: &'a mut [U],
}

impl<T: Real> Algorithm<T> for Rnea<'_, T, T> {
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
        let Self { model, q, v, vdot, workspace: RneaWorkspace { posture, rooted, .. }, tau } = self;
        posture.update::<S>(model.mechanism(), q);
        rooted::rnea::<T, S::Columns>(model, posture, [q, v, vdot], rooted, tau);
    }
}

impl<T: Real, U: Scalar<Constant = T>> Rnea<'_, T, U> {
    /// Position pass and both sweeps.
    #[inline(always)]
    pub fn sweep<S: Scalar<Constant = T, Stored = U>>(self) {
        let Self { model, q, v, vdot, workspace, tau } = self;
        workspace.posture.update::<S>(model.mechanism(), q);
        rnea::<S>(model, q, v, vdot, workspace, tau);
    }
}

/// Both sweeps; the posture stands in the workspace.
#[inline(always)]
pub(super) fn rnea<S: Scalar>(
    model: &Model<S::Constant>,
    q: &[S::Stored],
    qd: &[S::Stored],
    qdd: &[S::Stored],
    workspace: &mut RneaWorkspace<S::Stored>,
    tau: &mut [S::Stored],
) {
    forces::<S>(model, q, qd, qdd, workspace);
    let RneaWorkspace { posture, f, .. } = workspace;
    for (i, m) in model.mechanism().members.iter().enumerate().rev() {
        let (d, f_i) = (m.v0 as usize, f[i + 1].map(S::load));
        let armature = |d: usize| S::constant(model.armature[d]) * S::load(qdd[d]);
        match m.motion {
            MotionKind::Hinge => tau[d] = (f_i.ang.z + armature(d)).store(),
            MotionKind::Slide => tau[d] = (f_i.lin.z + armature(d)).store(),
            MotionKind::Other if matches!(m.joint, Joint::Floating) => {
                for (tau, (d, f)) in tau[d..d + 6].iter_mut().zip((d..).zip(f_i.to_array())) {
                    *tau = (f + armature(d)).store();
                }
            }
            MotionKind::Other => {
                for (d, &column) in (d..).zip(m.joint.columns()) {
                    let S_d = posture.S[d].map(S::load);
                    tau[d] = (column.along(S_d, f_i) + armature(d)).store();
                }
            }
        }
        if m.parent == 0 {
            continue;
        }
        let up = match m.motion {
            MotionKind::Hinge => {
                let (turn, r) = (posture.turn::<S>(i), position::<S>(m));
                with_twist!(m, C: S => Placed { E: ThenZ { turn, first: C }, r }.transpose_force(f_i))
            }
            MotionKind::Slide => with_turn!(m, C: S => slide::<S, _>(m, C, q).transpose_force(f_i)),
            MotionKind::Other => posture.placed::<S>(i).transpose_force(f_i),
        };
        let p = m.parent as usize;
        f[p] = (f[p].map(S::load) + up).map(S::store);
    }
}

/// The forward sweep: the force that moves each body as q̇ and q̈ say.
#[inline(always)]
pub(super) fn forces<S: Scalar>(
    model: &Model<S::Constant>,
    q: &[S::Stored],
    qd: &[S::Stored],
    qdd: &[S::Stored],
    RneaWorkspace { posture, path, f, .. }: &mut RneaWorkspace<S::Stored>,
) {
    let Mechanism { members, .. } = model.mechanism();
    path[0].a = (-model.gravity.map(S::constant)).map(S::store);
    for (i, m) in members.iter().enumerate() {
        let (before, rest) = path.split_at_mut(m.level as usize);
        let (up, out) = (&before[m.level as usize - 1], &mut rest[0]);
        let d = m.v0 as usize;
        let force = match m.motion {
            MotionKind::Hinge => {
                let (turn, rate) = (posture.turn::<S>(i), (S::load(qd[d]), S::load(qdd[d])));
                with_twist!(m, C: S => hinge::<S, _>(ThenZ { turn, first: C }, m, rate, up, out))
            }
            MotionKind::Slide => {
                let rate = (S::load(qd[d]), S::load(qdd[d]));
                with_turn!(m, C: S => sliding::<S, _>(slide(m, C, q), m, rate, up, out))
            }
            MotionKind::Other if matches!(m.joint, Joint::Floating) => {
                let [qd, qdd] = [qd, qdd].map(|x| six::<S>(&x[d..]));
                floating(posture.placed::<S>(i), m, (qd, qdd), up, out)
            }
            MotionKind::Other => other::<S>(posture, i, m, qd, qdd, up, out),
        };
        f[i + 1] = force.map(S::store);
    }
}

/// A revolute joint: ω_J = z q̇.
#[inline(always)]
fn hinge<S: Scalar, R: Rotation<S>>(
    E: R,
    m: &Member<S::Constant>,
    (qd, qdd): (S, S),
    up: &Moving<S::Stored>,
    out: &mut Moving<S::Stored>,
) -> Force<S> {
    let (mut omega, alpha, a) = carried(m, Placed { E, r: position::<S>(m) }, up);
    let alpha = Vec3::new(omega.y.mul_add(qd, alpha.x), alpha.y - omega.x * qd, alpha.z + qdd);
    omega.z += qd;
    finish(m, omega, alpha, a, out)
}

/// A prismatic joint: v_J = z q̇.
#[inline(always)]
fn sliding<S: Scalar, R: Rotation<S>>(
    X_up: Placed<S, R>,
    m: &Member<S::Constant>,
    (qd, qdd): (S, S),
    up: &Moving<S::Stored>,
    out: &mut Moving<S::Stored>,
) -> Force<S> {
    let (omega, alpha, a) = carried(m, X_up, up);
    let twice = qd + qd;
    let a = Vec3::new(omega.y.mul_add(twice, a.x), a.y - omega.x * twice, a.z + qdd);
    finish(m, omega, alpha, a, out)
}

/// A free body: v_J = q̇.
#[inline(always)]
fn floating<S: Scalar>(
    X_up: Placed<S, Mat3<S>>,
    m: &Member<S::Constant>,
    (v_J, a_J): (Motion<S>, Motion<S>),
    up: &Moving<S::Stored>,
    out: &mut Moving<S::Stored>,
) -> Force<S> {
    let (omega_p, alpha_p, a_p) = carried(m, X_up, up);
    if m.parent == 0 {
        return finish(m, v_J.ang, a_J.ang, a_p + a_J.lin + v_J.ang.cross(v_J.lin), out);
    }
    let omega = omega_p + v_J.ang;
    let alpha = alpha_p + a_J.ang + omega_p.cross(v_J.ang);
    finish(m, omega, alpha, a_p + a_J.lin + (omega_p + omega).cross(v_J.lin), out)
}

/// Six numbers as a motion.
#[inline(always)]
fn six<S: Scalar>(x: &[S::Stored]) -> Motion<S> {
    let x = &x[..6];
    let load = |k: usize| S::load(x[k]);
    Motion::new(Vec3::new(load(0), load(1), load(2)), Vec3::new(load(3), load(4), load(5)))
}

/// Any joint, by its columns.
#[inline(always)]
fn other<S: Scalar>(
    posture: &Posture<S::Stored>,
    i: usize,
    m: &Member<S::Constant>,
    qd: &[S::Stored],
    qdd: &[S::Stored],
    up: &Moving<S::Stored>,
    out: &mut Moving<S::Stored>,
) -> Force<S> {
    let (omega_p, alpha_p, a_p) = carried(m, posture.placed::<S>(i), up);
    let (mut columns, mut rates) = ([Motion::<S>::ZERO; 6], [S::ZERO; 6]);
    let (mut v_J, mut a_J) = (Motion::ZERO, Motion::ZERO);
    let d0 = m.v0 as usize;
    for (k, &column) in m.joint.columns().iter().enumerate() {
        (columns[k], rates[k]) = (posture.S[d0 + k].map(S::load), S::load(qd[d0 + k]));
        v_J = column.moved(v_J, columns[k], rates[k]);
        a_J = column.moved(a_J, columns[k], S::load(qdd[d0 + k]));
    }
    a_J += m.joint.map(S::constant).bias(&columns, &rates);
    let omega = omega_p + v_J.ang;
    let alpha = alpha_p + a_J.ang + omega_p.cross(v_J.ang);
    let a = a_p + a_J.lin + (omega_p + omega).cross(v_J.lin);
    finish(m, omega, alpha, a, out)
}

/// ω, α and a of the point where the joint stands, in the body's axes. The world only falls upwards.
#[inline(always)]
fn carried<S: Scalar, R: Rotation<S>>(
    m: &Member<S::Constant>,
    X_up: Placed<S, R>,
    up: &Moving<S::Stored>,
) -> (Vec3<S>, Vec3<S>, Vec3<S>) {
    let E = X_up.E;
    if m.parent == 0 {
        return (Vec3::ZERO, Vec3::ZERO, E.times(up.a.map(S::load)));
    }
    let a = X_up.offset().image_add(up.Psi.map(S::load), up.a.map(S::load));
    (E.times(up.omega.map(S::load)), E.times(up.alpha.map(S::load)), E.times(a))
}

#[inline(always)]
fn finish<S: Scalar>(
    m: &Member<S::Constant>,
    omega: Vec3<S>,
    alpha: Vec3<S>,
    a: Vec3<S>,
    out: &mut Moving<S::Stored>,
) -> Force<S> {
    let Psi = Psi(omega, alpha);
    if !m.place.leaf {
        *out = Moving {
            omega: omega.map(S::store),
            alpha: alpha.map(S::store),
            a: a.map(S::store),
            Psi: Psi.map(S::store),
        };
    }
    m.I.map(S::constant).force(a, Psi)
}

/// [α]× + [ω]×².
#[inline(always)]
fn Psi<S: Scalar>(w: Vec3<S>, alpha: Vec3<S>) -> Mat3<S> {
    let (xx, yy, zz) = (w.x * w.x, w.y * w.y, w.z * w.z);
    Mat3 {
        x: Vec3::new((-w.y).mul_add(w.y, -zz), w.x.mul_add(w.y, -alpha.z), w.x.mul_add(w.z, alpha.y)),
        y: Vec3::new(w.x.mul_add(w.y, alpha.z), (-w.z).mul_add(w.z, -xx), w.y.mul_add(w.z, -alpha.x)),
        z: Vec3::new(w.x.mul_add(w.z, -alpha.y), w.y.mul_add(w.z, alpha.x), (-w.x).mul_add(w.x, -yy)),
    }
}

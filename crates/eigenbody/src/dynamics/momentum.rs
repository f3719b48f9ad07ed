//! Momentum of the whole mechanism.
//!
//! ```text
//! for i = 1..N:   v_i = X_up v_p + S_i q̇_i      h_i = I_i v_i      Ic_i = I_i
//! for i = N..1:   h_p += X_upᵀ h_i              Ic_p += X_upᵀ Ic_i X_up
//! ```
//! Featherstone (2008), §2.10 and §9.6. Rotor inertia moves no mass in the world's frame and adds nothing. Cost O(N).

use super::kinematics::Kinematics;
use crate::error::InputError;
use crate::model::{Model, Shape};
use crate::scalar::{Real, Scalar};
use crate::spatial::{Force, Motion, RigidInertia, Vec3};

/// Momentum and mass of the whole mechanism, in the world's frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Momentum<T> {
    /// Angular momentum about the world's origin (kg m²/s); linear momentum (kg m/s).
    pub h: Force<T>,
    /// Mass of all moving bodies (kg).
    pub mass: T,
    /// First moment of mass m c about the world's origin (kg m).
    pub moment: Vec3<T>,
}

/// Room for [`momentum_into`] and [`energy_into`](super::energy_into).
#[derive(Debug, Clone)]
pub struct MomentumWorkspace<T> {
    shape: Shape,
    kinematics: Kinematics<T>,
    /// N: velocity of each body. Written forwards.
    pub(super) v: Vec<Motion<T>>,
    /// N: momentum and composite inertia of each body with all that it carries. Accumulated backwards.
    h: Vec<Force<T>>,
    Ic: Vec<RigidInertia<T>>,
}

impl<T: Scalar> MomentumWorkspace<T> {
    /// Room for a model.
    pub fn new(model: &Model<T>) -> Self {
        let n = model.bodies.len();
        Self {
            shape: model.shape,
            kinematics: Kinematics::new(model),
            v: vec![Motion::ZERO; n],
            h: vec![Force::ZERO; n],
            Ic: vec![RigidInertia::ZERO; n],
        }
    }
}

/// Total momentum, mass and first moment at (q, v).
///
/// | name | shape | unit |
/// |------|-------|------|
/// | `q` | `nq` | rad, m, unit quaternion |
/// | `v` | `nv` | rad/s, m/s |
///
/// Cost O(N); allocates. Errors: [`InputError`] if q or v does not fit the model.
///
/// ```
/// use eigenbody::{Family, dynamics::momentum};
/// let rod = Family::slender_chain(1, 3.0, 1.0)?.model::<f64>()?;
/// let total = momentum(&rod, &[0.0], &[2.0])?;
/// // m l²/3 · ω about the pivot, m ω l/2 along y.
/// assert!((total.h.ang.z - 2.0).abs() < 1e-15 && (total.h.lin.y - 3.0).abs() < 1e-15);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn momentum<T: Real>(model: &Model<T>, q: &[T], v: &[T]) -> Result<Momentum<T>, InputError> {
    momentum_into(model, q, v, &mut MomentumWorkspace::new(model))
}

/// [`momentum`] with the caller's workspace; allocates nothing.
///
/// Errors: as [`momentum`], and [`InputError::OtherModel`] for the workspace.
pub fn momentum_into<T: Real>(
    model: &Model<T>,
    q: &[T],
    v: &[T],
    workspace: &mut MomentumWorkspace<T>,
) -> Result<Momentum<T>, InputError> {
    model.check_shape("workspace", workspace.shape)?;
    model.check_q(q)?;
    model.check_v("v", v)?;
    workspace.kinematics.update(model, q);
    Ok(sweep(model, v, workspace))
}

#[inline(always)]
fn sweep<T: Scalar>(model: &Model<T>, qd: &[T], workspace: &mut MomentumWorkspace<T>) -> Momentum<T> {
    let MomentumWorkspace { kinematics: Kinematics { X_up, S }, v, h, Ic, .. } = workspace;
    for (i, body) in model.bodies.iter().enumerate() {
        let mut v_i = X_up[i].motion(body.parent().map_or(Motion::ZERO, |p| v[p]));
        for d in body.dofs() {
            v_i += S[d] * qd[d];
        }
        v[i] = v_i;
        h[i] = body.I.times(v_i);
        Ic[i] = body.I;
    }
    let (mut h_0, mut Ic_0) = (Force::ZERO, RigidInertia::ZERO);
    for (i, body) in model.bodies.iter().enumerate().rev() {
        let (h_i, Ic_i) = (X_up[i].transpose_force(h[i]), X_up[i].transpose_rigid(Ic[i]));
        match body.parent() {
            Some(p) => {
                h[p] += h_i;
                Ic[p] += Ic_i;
            }
            None => {
                h_0 += h_i;
                Ic_0 += Ic_i;
            }
        }
    }
    Momentum { h: h_0, mass: Ic_0.m, moment: Ic_0.h }
}

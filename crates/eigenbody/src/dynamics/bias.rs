//! The force of gravity and of velocity: what τ must hold when nothing accelerates.
//!
//! ```text
//! C(q, v) = τ of RNEA at v̇ = 0          g(q) = C(q, 0)
//! ```

use super::rnea::{Rnea, RneaWorkspace};
use crate::error::{InputError, check_length};
use crate::model::Model;
use crate::scalar::{Real, dispatch_one};

/// C(q, v): gravity, Coriolis and centrifugal forces.
///
/// | name | shape | unit |
/// |------|-------|------|
/// | `q` | `nq` | rad, m, unit quaternion |
/// | `v` | `nv` | rad/s, m/s |
/// | C (returned) | `nv` | N m, N |
///
/// Method: RNEA at v̇ = 0, O(N); allocates. Numerics and errors: as [`inverse_dynamics`](super::inverse_dynamics).
///
/// ```
/// use eigenbody::{Family, bias_force, dynamics::gravity_force};
/// let arm = Family::hydra(3, 1.0, 0.0, 1.0)?.model::<f64>()?;
/// let q = [0.1, 0.2, 0.3];
/// assert_eq!(bias_force(&arm, &q, &[0.0; 3])?, gravity_force(&arm, &q)?);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn bias_force<T: Real>(model: &Model<T>, q: &[T], v: &[T]) -> Result<Vec<T>, InputError> {
    let mut C = vec![T::ZERO; model.nv()];
    bias_force_into(model, q, v, &mut RneaWorkspace::new(model), &mut C)?;
    Ok(C)
}

/// [`bias_force`] into the caller's memory; allocates nothing.
///
/// Errors: as [`bias_force`], if `C` has the wrong length, and [`InputError::OtherModel`] for the workspace.
pub fn bias_force_into<T: Real>(
    model: &Model<T>,
    q: &[T],
    v: &[T],
    workspace: &mut RneaWorkspace<T>,
    C: &mut [T],
) -> Result<(), InputError> {
    let zeros = std::mem::take(&mut workspace.zeros);
    let result = bias_force_at(model, q, v, &zeros, workspace, C);
    workspace.zeros = zeros;
    result
}

/// g(q): the force of gravity alone, positive where τ must hold it.
///
/// Shapes, method and errors: as [`bias_force`] at v = 0.
pub fn gravity_force<T: Real>(model: &Model<T>, q: &[T]) -> Result<Vec<T>, InputError> {
    let mut g = vec![T::ZERO; model.nv()];
    gravity_force_into(model, q, &mut RneaWorkspace::new(model), &mut g)?;
    Ok(g)
}

/// [`gravity_force`] into the caller's memory; allocates nothing.
///
/// Errors: as [`gravity_force`], if `g` has the wrong length, and [`InputError::OtherModel`] for the workspace.
pub fn gravity_force_into<T: Real>(
    model: &Model<T>,
    q: &[T],
    workspace: &mut RneaWorkspace<T>,
    g: &mut [T],
) -> Result<(), InputError> {
    let zeros = std::mem::take(&mut workspace.zeros);
    let result = bias_force_at(model, q, &zeros, &zeros, workspace, g);
    workspace.zeros = zeros;
    result
}

fn bias_force_at<T: Real>(
    model: &Model<T>,
    q: &[T],
    v: &[T],
    zeros: &[T],
    workspace: &mut RneaWorkspace<T>,
    C: &mut [T],
) -> Result<(), InputError> {
    model.check_shape("workspace", workspace.shape)?;
    model.check_q(q)?;
    model.check_v("v", v)?;
    check_length("C", C.len(), model.nv())?;
    dispatch_one(Rnea { model, q, v, vdot: zeros, workspace, tau: C });
    Ok(())
}

//! How the kinetic energy of a motion changes with masses, centres of mass and rotational inertias.
//!
//! ```text
//! 2T_i = m |u|² + ωᵀ I ω            u = v + ω × c: velocity of the centre of mass c;  I about c
//! ∂2T/∂m = |u|²      ∂2T/∂c = 2m u × ω      ∂2T/∂I_jk = ω_j ω_k (twice that off the diagonal)
//! ```
//! H is linear in the inertial parameters of every body. With the motion a mode of H x = λ B x, xᵀBx = 1, these are ∂λ/∂(parameter).
//! Cost O(N).

use super::momentum::{MomentumWorkspace, momentum_into};
use crate::error::InputError;
use crate::model::Model;
use crate::scalar::Real;
use crate::spatial::{Sym3, Vec3};

/// What one body's part in twice the kinetic energy depends on, along the axes of its link.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InertialGradient<T> {
    /// Mass (kg).
    pub m: T,
    /// Centre of mass in the link's frame (m).
    pub c: Vec3<T>,
    /// Rotational inertia about the centre of mass, on the link's axes (kg m²).
    pub I: Sym3<T>,
    /// ∂2T/∂m.
    pub of_m: T,
    /// ∂2T/∂c.
    pub of_c: Vec3<T>,
    /// ∂2T/∂I, an entry off the diagonal and its mirror image moved together.
    pub of_I: Sym3<T>,
}

/// The inertial gradient of 2T = vᵀHv for every body, in the order of [`Model::bodies`].
///
/// | name | shape | unit |
/// |------|-------|------|
/// | `q` | `nq` | rad, m, unit quaternion |
/// | `v` | `nv` | rad/s, m/s |
/// | returned | N | J/kg, J/m, J/(kg m²), times two |
///
/// A body without mass has its centre at its link's origin. Cost O(N); allocates. Numerics: sums of products without cancellation
/// but in u. Errors: [`InputError`] if q or v does not fit the model.
///
/// ```
/// use eigenbody::{Family, dynamics::inertial_gradient};
/// let rod = Family::slender_chain(1, 3.0, 1.0)?.model::<f64>()?;
/// let of = inertial_gradient(&rod, &[0.0], &[2.0])?[0];
/// // Half a metre from the pivot at 2 rad/s.
/// assert!((of.of_m - 1.0).abs() < 1e-15 && (of.of_I.zz - 4.0).abs() < 1e-15);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn inertial_gradient<T: Real>(
    model: &Model<T>,
    q: &[T],
    v: &[T],
) -> Result<Vec<InertialGradient<T>>, InputError> {
    let mut workspace = MomentumWorkspace::new(model);
    momentum_into(model, q, v, &mut workspace)?;
    let of = |i: usize| {
        let body = &model.bodies[i];
        let X = model.links[body.link()].link_from_body();
        let twist = X.motion(workspace.v[i]);
        let (m, c, I) = X.inverse().transpose_rigid(body.I).central();
        let u = twist.lin + twist.ang.cross(c);
        let w = twist.ang;
        let two = T::ONE + T::ONE;
        let of_I = Sym3 {
            xx: w.x * w.x,
            yy: w.y * w.y,
            zz: w.z * w.z,
            xy: two * w.x * w.y,
            xz: two * w.x * w.z,
            yz: two * w.y * w.z,
        };
        InertialGradient { m, c, I, of_m: u.dot(u), of_c: u.cross(w) * (two * m), of_I }
    };
    Ok((0..model.bodies.len()).map(of).collect())
}

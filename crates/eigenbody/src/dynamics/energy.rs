//! Kinetic and potential energy.
//!
//! ```text
//! T = ½ Σ v_i · I_i v_i + ½ Σ armature_d q̇_d²        V = −a_g · m c
//! ```

use super::momentum::{MomentumWorkspace, momentum_into};
use crate::error::InputError;
use crate::model::Model;
use crate::scalar::Real;

/// Energy of the whole mechanism (J).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Energy<T> {
    /// Kinetic energy, rotors included: ½ vᵀ H v.
    pub kinetic: T,
    /// Potential energy of gravity, zero with the centre of mass at the world's origin.
    pub potential: T,
}

/// Energy at (q, v).
///
/// | name | shape | unit |
/// |------|-------|------|
/// | `q` | `nq` | rad, m, unit quaternion |
/// | `v` | `nv` | rad/s, m/s |
///
/// Cost O(N); allocates. The kinetic energy is a sum of squares: no cancellation, whatever κ.
///
/// Errors: [`InputError`] if q or v does not fit the model.
///
/// ```
/// use eigenbody::{Family, dynamics::energy};
/// let rod = Family::slender_chain(1, 3.0, 1.0)?.model::<f64>()?;
/// let total = energy(&rod, &[0.0], &[2.0])?;
/// assert!((total.kinetic - 2.0).abs() < 1e-15 && total.potential == 0.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn energy<T: Real>(model: &Model<T>, q: &[T], v: &[T]) -> Result<Energy<T>, InputError> {
    energy_into(model, q, v, &mut MomentumWorkspace::new(model))
}

/// [`energy`] with the caller's workspace; allocates nothing.
///
/// Errors: as [`energy`], and [`InputError::OtherModel`] for the workspace.
pub fn energy_into<T: Real>(
    model: &Model<T>,
    q: &[T],
    v: &[T],
    workspace: &mut MomentumWorkspace<T>,
) -> Result<Energy<T>, InputError> {
    let total = momentum_into(model, q, v, workspace)?;
    let mut twice = T::ZERO;
    for (body, &v_i) in model.bodies.iter().zip(&workspace.v) {
        twice += v_i.dot(body.I.times(v_i));
    }
    for (&armature, &v) in model.armature.iter().zip(v) {
        twice += armature * v * v;
    }
    Ok(Energy { kinetic: twice * T::from_f64(0.5), potential: -model.gravity.dot(total.moment) })
}

/// Who carries the kinetic energy of a motion.
#[derive(Debug, Clone, PartialEq)]
pub struct EnergyShares<T> {
    /// N: v_i · I_i v_i / 2T of every body.
    pub bodies: Vec<T>,
    /// nv: armature_d v_d² / 2T of every degree of freedom.
    pub armature: Vec<T>,
}

/// Part of every body and every rotor in the kinetic energy of (q, v); they sum to one, or are all zero for a motion without energy.
///
/// | name | shape | unit |
/// |------|-------|------|
/// | `q` | `nq` | rad, m, unit quaternion |
/// | `v` | `nv` | rad/s, m/s |
///
/// With v a mode of H these are sensitivities: the mode's λ changes by share · δ where a body's mass and inertia, or a rotor's
/// inertia, change by the factor 1 + δ. Cost O(N); allocates.
///
/// Errors: [`InputError`] if q or v does not fit the model.
///
/// ```
/// use eigenbody::{Family, dynamics::energy_shares};
/// let pair = Family::slender_chain(2, 1.0, 1.0)?.model::<f64>()?;
/// // The second rod turns about its own end: it alone moves.
/// assert_eq!(energy_shares(&pair, &[0.0, 0.0], &[0.0, 1.0])?.bodies, [0.0, 1.0]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn energy_shares<T: Real>(model: &Model<T>, q: &[T], v: &[T]) -> Result<EnergyShares<T>, InputError> {
    let mut workspace = MomentumWorkspace::new(model);
    momentum_into(model, q, v, &mut workspace)?;
    let bodies = model.bodies.iter().zip(&workspace.v).map(|(body, &v)| v.dot(body.I.times(v)));
    let armature = model.armature.iter().zip(v).map(|(&armature, &v)| armature * v * v);
    let (mut bodies, mut armature): (Vec<T>, Vec<T>) = (bodies.collect(), armature.collect());
    let twice = bodies.iter().chain(&armature).fold(T::ZERO, |sum, &part| sum + part);
    bodies
        .iter_mut()
        .chain(&mut armature)
        .for_each(|part| *part = if twice > T::ZERO { *part / twice } else { T::ZERO });
    Ok(EnergyShares { bodies, armature })
}

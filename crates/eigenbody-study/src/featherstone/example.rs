//! Equation 1: an example of what ill-conditioning does.

use super::curves::planar;
use crate::claim::{Check, Reading};
use crate::experiment::Outcome;
use crate::lab::{Lab, StudyError};
use crate::table::Rows;
use eigenbody::spatial::Vec3;
use eigenbody::{Posture, forward_dynamics, inverse_dynamics};
use std::f64::consts::FRAC_PI_2;

/// Eq. 1: torques for unit accelerations, and what the torques give when rounded to three figures.
///
/// # Errors
///
/// [`StudyError`], as every experiment.
pub fn eq1(lab: &Lab<'_>) -> Result<Outcome, StudyError> {
    let posed = lab.pose(&planar(8)?, Posture::Zag(FRAC_PI_2))?;
    let still = posed.model.clone().with_gravity(Vec3::ZERO)?;
    let (zero, one) = ([0.0; 8], [1.0; 8]);
    let tau = inverse_dynamics(&still, &posed.q, &zero, &one)?;
    let rounded = [302.0, 250.0, 201.0, 151.0, 106.0, 64.5, 31.5, 8.68];
    let vdot = forward_dynamics(&still, &posed.q, &zero, &rounded)?;
    let numbers = [
        ("joint", "1"),
        ("tau", "N m"),
        ("tau_rounded", "N m"),
        ("vdot_desired", "rad/s^2"),
        ("vdot", "rad/s^2"),
    ];
    let mut table = Rows::new(&[], &numbers);
    for i in 0..8 {
        table.push([], [i as f64 + 1.0, tau[i], rounded[i], 1.0, vdot[i]].map(Some));
    }
    let off = tau.iter().zip(rounded).map(|(t, r)| (r / t - 1.0).abs()).fold(0.0, f64::max);
    let response = vdot.iter().map(|a| (a - 1.0).abs()).fold(0.0, f64::max);
    let straight = lab.kappa(&planar(8)?, Posture::Zag(0.0))?;
    let effects = vec![
        Check::within("largest relative error of the torques", off, 0.0, 0.005),
        Check::within("largest relative error of the accelerations", response, 0.45, 0.55),
    ];
    let elsewhere = vec![Check::within("κ stretched out, zag(0)", straight, 1e4, f64::INFINITY)];
    let readings = vec![
        Reading::new("F-eq1-tau", tau, Vec::new()),
        Reading::new("F-eq1-qdd", vdot, effects),
        Reading::new("F-eq1-kappa", vec![posed.ends()?.kappa()], elsewhere),
    ];
    Ok(Outcome::new(table, readings))
}

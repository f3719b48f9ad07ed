//! How far rounding may have moved an eigenvalue.
//!
//! ```text
//! |δλ| ≲ ε/2 Σ_i |a_i|ᵀ |IA_i| |a_i| / xᵀBx          a_i: motion of body i in the mode x
//! ```
//! Rounding in body i's step perturbs its articulated inertia by E_i with |E_i| of order ε|IA_i|, which perturbs H by J_iᵀE_iJ_i and
//! the eigenvalue by a_iᵀE_i a_i/xᵀBx. So the error is governed by what cancels inside each 6 × 6 inertia, weighed by the
//! body's part in the mode; the condition number of H does not enter.

use super::hinge::Hinge;
use super::pencil::Pencil;
use super::sweep::{Pivots, sweep};
use crate::spatial::{ArticulatedInertia, Motion, Vec3};

/// Estimated absolute error of the eigenvalue `shift` whose mode moves the bodies by `motions`; the mode has xᵀBx = 1.
pub(crate) fn absolute_error(pencil: &Pencil<f64>, shift: f64, motions: &[Motion<f64>]) -> f64 {
    let mut sum = Sum { motions, total: 0.0 };
    sweep(pencil, shift, &mut Vec::new(), &mut sum);
    0.5 * f64::EPSILON * sum.total
}

struct Sum<'a> {
    motions: &'a [Motion<f64>],
    total: f64,
}

impl Pivots<f64> for Sum<'_> {
    fn pivot(&mut self, _: usize, _: &Hinge<f64>) {}

    fn body(&mut self, i: usize, IA: &ArticulatedInertia<f64>) {
        let absolute = |v: Vec3<f64>| v.map(f64::abs);
        let a = Motion::new(absolute(self.motions[i].ang), absolute(self.motions[i].lin));
        let IA = ArticulatedInertia { I: IA.I.map(f64::abs), H: IA.H.map(f64::abs), M: IA.M.map(f64::abs) };
        self.total += a.dot(IA.times(a));
    }
}

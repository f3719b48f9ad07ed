//! Configurations: checked, neutral, random, moved along a velocity.

use super::{Model, Random};
use crate::error::InputError;
use crate::joint::Joint;
use crate::scalar::Real;
use std::f64::consts::PI;

/// How far a quaternion's norm may be from 1.
const QUATERNION_TOLERANCE: f64 = 1e-6;

/// Refuses a slice of the wrong length or with a number that is not finite.
pub(crate) fn check<T: Real>(what: &'static str, x: &[T], expected: usize) -> Result<(), InputError> {
    if x.len() != expected {
        return Err(InputError::Length { what, expected, found: x.len() });
    }
    // All are looked at before any is named: a loop without a jump in it.
    if x.iter().fold(true, |all, x| all & x.is_finite()) {
        return Ok(());
    }
    let index = x.iter().position(|x| !x.is_finite()).unwrap_or(0);
    Err(InputError::NotFinite { what, index })
}

impl<T: Real> Model<T> {
    /// Refuses a q of the wrong length, with a number that is not finite, or with a quaternion that is not a unit one.
    pub fn check_q(&self, q: &[T]) -> Result<(), InputError> {
        check("q", q, self.nq)?;
        for &(joint, index) in &self.mechanism.quaternions {
            let index = index as usize;
            let norm = q[index..index + 4].iter().map(|x| x.to_f64().powi(2)).sum::<f64>().sqrt();
            if (norm - 1.0).abs() > QUATERNION_TOLERANCE {
                let joint = self.joints[joint as usize].name.to_string();
                return Err(InputError::NotUnitQuaternion { joint, index, norm });
            }
        }
        Ok(())
    }

    /// Refuses a v, v̇ or τ of the wrong length or with a number that is not finite.
    pub fn check_v(&self, what: &'static str, v: &[T]) -> Result<(), InputError> {
        check(what, v, self.nv())
    }

    /// All coordinates zero, quaternions the identity.
    pub fn neutral(&self) -> Vec<T> {
        let mut q = vec![T::ZERO; self.nq];
        for joint in &self.joints {
            if let Some(at) = joint.kind.quaternion() {
                q[joint.q0 as usize + at] = T::ONE;
            }
        }
        q
    }

    /// A random configuration, the same for the same seed on every machine.
    ///
    /// Uniform between limits where both are finite; else angles in [−π, π), displacements in [−1, 1) m, rotations uniform
    /// over all rotations.
    pub fn random(&self, seed: u64) -> Vec<T> {
        let mut random = Random::new(seed);
        let mut q = Vec::with_capacity(self.nq);
        for joint in &self.joints {
            let limits = joint.limits.map(|(lower, upper)| (lower.to_f64(), upper.to_f64()));
            let limits = limits.filter(|(lower, upper)| lower.is_finite() && upper.is_finite());
            let numbers = match joint.kind {
                Joint::Spherical => random.quaternion().to_vec(),
                Joint::Floating => {
                    let p = [0; 3].map(|_| random.between(-1.0, 1.0));
                    [p.as_slice(), &random.quaternion()].concat()
                }
                _ => {
                    let mut one = |&translation: &bool| {
                        let (lower, upper) =
                            limits.unwrap_or(if translation { (-1.0, 1.0) } else { (-PI, PI) });
                        random.between(lower, upper)
                    };
                    joint.kind.translations().iter().map(&mut one).collect()
                }
            };
            q.extend(numbers.into_iter().map(T::from_f64));
        }
        q
    }

    /// q ⊕ v: the configuration after moving with the constant velocity v for unit time.
    ///
    /// Errors: [`InputError`] if q or v does not fit the model.
    pub fn integrate(&self, q: &[T], v: &[T]) -> Result<Vec<T>, InputError> {
        self.check_q(q)?;
        self.check_v("v", v)?;
        let mut moved = q.to_vec();
        for joint in &self.joints {
            let at = joint.coordinates();
            joint.kind.integrate(&q[at.clone()], &v[joint.dofs()], &mut moved[at]);
        }
        Ok(moved)
    }
}

//! Configurations: checked, neutral, random, moved along a velocity.

use super::{Model, Random};
use crate::error::InputError;
use crate::joint::Joint;
use crate::scalar::Real;
use std::f64::consts::PI;

/// How far a quaternion's norm may be from 1.
pub(crate) const QUATERNION_TOLERANCE: f64 = 1e-6;
/// How far an entry of E Eᵀ may be from that of 1.
pub(crate) const ROTATION_TOLERANCE: f64 = QUATERNION_TOLERANCE;

/// Refuses a slice of the wrong length or with a number that is not finite.
#[inline]
pub(crate) fn check<T: Real>(what: &'static str, x: &[T], expected: usize) -> Result<(), InputError> {
    match x.len() == expected && all_finite(x) {
        true => Ok(()),
        false => refuse(what, x, expected),
    }
}

/// 0 x is zero for a finite number and for no other. All are looked at: a loop without a jump in it.
#[inline]
fn all_finite<T: Real>(x: &[T]) -> bool {
    let (mut a, mut b) = (T::ZERO, T::ZERO);
    let (pairs, rest) = x.as_chunks::<2>();
    for [x, y] in pairs {
        a += *x * T::ZERO;
        b += *y * T::ZERO;
    }
    for &x in rest {
        a += x * T::ZERO;
    }
    a + b == T::ZERO
}

#[cold]
#[inline(never)]
fn refuse<T: Real>(what: &'static str, x: &[T], expected: usize) -> Result<(), InputError> {
    if x.len() != expected {
        return Err(InputError::Length { what, expected, found: x.len() });
    }
    let index = x.iter().position(|x| !x.is_finite()).unwrap_or(0);
    Err(InputError::NotFinite { what, index })
}

impl<T: Real> Model<T> {
    /// Refuses a q of the wrong length, with a number that is not finite, or with a quaternion that is not a unit one.
    #[inline]
    pub fn check_q(&self, q: &[T]) -> Result<(), InputError> {
        check("q", q, self.nq)?;
        match self.quaternions.is_empty() {
            true => Ok(()),
            false => self.check_quaternions(q),
        }
    }

    /// Refuses a q with a quaternion that is not a unit one.
    pub(crate) fn check_quaternions(&self, q: &[T]) -> Result<(), InputError> {
        for &(joint, index) in &self.quaternions {
            let index = index as usize;
            let square = q[index..index + 4].iter().map(|x| x.to_f64() * x.to_f64()).sum::<f64>();
            // Mostly the square is near enough, and no root has to be taken.
            if (square - 1.0).abs() > QUATERNION_TOLERANCE
                && (square.sqrt() - 1.0).abs() > QUATERNION_TOLERANCE
            {
                let norm = square.sqrt();
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
        self.integrate_into(q, v, &mut moved);
        Ok(moved)
    }

    /// [`integrate`](Self::integrate) into `moved`, `nq` numbers; allocates nothing and checks nothing.
    ///
    /// # Panics
    ///
    /// If a slice is shorter than the model says.
    pub fn integrate_into(&self, q: &[T], v: &[T], moved: &mut [T]) {
        for joint in &self.joints {
            let at = joint.coordinates();
            joint.kind.integrate(&q[at.clone()], &v[joint.dofs()], &mut moved[at]);
        }
    }

    /// to ⊖ from: the constant velocity that moves `from` to `to` in unit time, joint by joint, rotations the shorter way round.
    ///
    /// Errors: [`InputError`] if a configuration does not fit the model.
    ///
    /// ```
    /// use eigenbody::Family;
    /// let robot = Family::auto_tree(9, 1.5, 0.3, 0.9)?.floating().model::<f64>()?;
    /// let (from, to) = (robot.random(1), robot.random(2));
    /// let arrived = robot.integrate(&from, &robot.difference(&from, &to)?)?;
    /// let back = robot.difference(&arrived, &to)?;
    /// assert!(back.iter().all(|x| x.abs() < 1e-13));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn difference(&self, from: &[T], to: &[T]) -> Result<Vec<T>, InputError> {
        self.check_q(from)?;
        self.check_q(to)?;
        let mut v = vec![T::ZERO; self.nv()];
        self.difference_into(from, to, &mut v);
        Ok(v)
    }

    /// [`difference`](Self::difference) into `v`, `nv` numbers; allocates nothing and checks nothing.
    ///
    /// # Panics
    ///
    /// If a slice is shorter than the model says.
    pub fn difference_into(&self, from: &[T], to: &[T], v: &mut [T]) {
        for joint in &self.joints {
            let at = joint.coordinates();
            joint.kind.difference(&from[at.clone()], &to[at], &mut v[joint.dofs()]);
        }
    }
}

//! Comparable configurations (Featherstone 2004, §4.1).

use crate::model::Model;
use crate::scalar::Real;
use std::fmt;

/// A configuration that is defined for every number of joints.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Posture {
    /// All coordinates zero, quaternions the identity.
    Zero,
    /// q_i = (−1)^(i+1) θ: a zigzag.
    Zag(f64),
    /// q_i = θ: an arc.
    Curl(f64),
}

/// `zero`, `zag(0.5)`, `curl(0.1)`: the expression that names it.
impl fmt::Display for Posture {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Zero => f.write_str("zero"),
            Self::Zag(angle) => write!(f, "zag({angle})"),
            Self::Curl(angle) => write!(f, "curl({angle})"),
        }
    }
}

impl Posture {
    /// q of a model. Joints with one coordinate are counted i = 1, 2, ..; all others, and a floating base, stay neutral.
    ///
    /// On a floating family member joint 1 is gone and i starts at 2: the shape is that of the fixed robot.
    ///
    /// ```
    /// use eigenbody::{Family, Posture};
    /// let robot = Family::hydra(3, 1.0, 0.0, 1.0)?.model::<f64>()?;
    /// assert_eq!(Posture::Zag(0.5).configuration(&robot), [0.5, -0.5, 0.5]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn configuration<T: Real>(&self, model: &Model<T>) -> Vec<T> {
        let mut q = model.neutral();
        let (theta, alternating) = match *self {
            Self::Zero => return q,
            Self::Zag(theta) => (T::from_f64(theta), true),
            Self::Curl(theta) => (T::from_f64(theta), false),
        };
        let single = model.joints().iter().filter(|joint| joint.kind().nq() == 1);
        let first = usize::from(model.has_floating_base());
        for (i, joint) in (first..).zip(single) {
            q[joint.coordinates().start] = if alternating && i % 2 == 1 { -theta } else { theta };
        }
        q
    }
}

//! What room for an algorithm depends on: which body carries which, on what joint, and where its numbers stand.

use super::Model;
use super::body::Body;
use crate::error::InputError;
use crate::joint::Joint;
use crate::scalar::Scalar;

/// A number that models of the same bodies and joints share, whatever their inertias, placements and limits; others do not.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Shape(u64);

impl Shape {
    pub(super) fn of<T: Scalar>(bodies: &[Body<T>]) -> Self {
        let mix = |sum: u64, word: u64| (sum.rotate_left(5) ^ word).wrapping_mul(0x517c_c1b7_2722_0a95);
        let body = |sum: u64, body: &Body<T>| {
            let stands = mix(sum, u64::from(body.parent) << 4 | kind(&body.joint));
            mix(stands, u64::from(body.q0) << 32 | u64::from(body.v0))
        };
        Self(bodies.iter().fold(bodies.len() as u64, body))
    }
}

/// Joints that are computed alike have one number.
fn kind<T>(joint: &Joint<T>) -> u64 {
    match joint {
        Joint::Fixed => 0,
        Joint::Revolute | Joint::Continuous => 1,
        Joint::Prismatic => 2,
        Joint::Helical { .. } => 3,
        Joint::Cylindrical => 4,
        Joint::Universal { .. } => 5,
        Joint::Planar => 6,
        Joint::Spherical => 7,
        Joint::Floating => 8,
    }
}

impl<T: Scalar> Model<T> {
    /// Refuses room that was made for a model of another shape.
    #[inline]
    pub(crate) fn check_shape(&self, what: &'static str, shape: Shape) -> Result<(), InputError> {
        if self.shape == shape { Ok(()) } else { Err(InputError::OtherModel { what }) }
    }
}

//! Spatial (6-D) vectors, transforms and inertias, in Plücker coordinates [angular; linear].
//!
//! Reference: Featherstone, *Rigid Body Dynamics Algorithms* (2008), chapter 2 and appendix A.

mod articulated;
mod mat3;
mod motion;
mod offset;
mod pseudo;
mod rigid;
mod rotation;
mod sym3;
mod transform;
mod vec3;

pub use articulated::ArticulatedInertia;
pub use mat3::Mat3;
pub use motion::{Force, Motion};
pub(crate) use offset::{Offset, Zero};
pub(crate) use pseudo::PseudoInertia;
pub use rigid::RigidInertia;
pub(crate) use rotation::{AboutX, Anywhere, Corner, Placed, Quarter, Rotation, Straight, ThenZ};
pub use sym3::Sym3;
pub use transform::Transform;
pub use vec3::Vec3;

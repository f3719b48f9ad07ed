//! `<link>`: a rigid body, of which only `<inertial>` matters here.

use super::element::{Element, Fault};
use super::pose::origin;
use eigenbody::spatial::{RigidInertia, Sym3};

/// The link's inertia about its own frame's origin; zero without `<inertial>`.
///
/// ```text
/// c = xyz,  I_com = R I Rᵀ = Eᵀ I E,  about the origin: I_com − m [c]×[c]×
/// ```
pub(super) fn inertia(link: Element<'_, '_>) -> Result<RigidInertia<f64>, Fault> {
    let Some(inertial) = link.child("inertial")? else { return Ok(RigidInertia::ZERO) };
    let X = origin(inertial)?;
    let m = inertial.required_child("mass")?.required_number("value")?;
    let entries = inertial.required_child("inertia")?;
    let entry = |name| entries.required_number(name);
    let I = Sym3 {
        xx: entry("ixx")?,
        yy: entry("iyy")?,
        zz: entry("izz")?,
        xy: entry("ixy")?,
        xz: entry("ixz")?,
        yz: entry("iyz")?,
    };
    Ok(RigidInertia::from_com(m, X.r, I.congruence(X.E)))
}

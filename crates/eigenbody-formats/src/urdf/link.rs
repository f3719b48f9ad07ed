//! `<link>`: a rigid body, of which only `<inertial>` matters here.

use super::element::{Element, Fault};
use super::pose::origin;
use crate::note::Note;
use eigenbody::spatial::{RigidInertia, Sym3};

/// The entries of `<inertia>`.
const ENTRIES: [&str; 6] = ["ixx", "iyy", "izz", "ixy", "ixz", "iyz"];

/// The link's inertia about its own frame's origin; zero without `<inertial>`.
///
/// ```text
/// c = xyz,  I_com = R I Rᵀ = Eᵀ I E,  about the origin: I_com − m [c]×[c]×
/// ```
///
/// Without `<mass>` it is zero too, and without `<inertia>`, or with some of its entries missing, a point mass: so Pinocchio
/// reads it. Both are noted.
pub(crate) fn inertia(link: Element<'_, '_>) -> Result<(RigidInertia<f64>, Option<Note>), Fault> {
    let Some(inertial) = link.child("inertial")? else { return Ok((RigidInertia::ZERO, None)) };
    let X = origin(inertial)?;
    let Some(mass) = inertial.child("mass")? else {
        return Ok((RigidInertia::ZERO, Some(Note::NoMass { link: link.attribute("name")?.to_owned() })));
    };
    let m = mass.required_number("value")?;
    let entries = inertial.child("inertia")?;
    let complete = entries.is_some_and(|entries| ENTRIES.iter().all(|name| entries.attribute(name).is_ok()));
    let Some(entries) = entries.filter(|_| complete) else {
        let note = Note::PointMass { link: link.attribute("name")?.to_owned() };
        return Ok((RigidInertia::from_com(m, X.r, Sym3::ZERO), Some(note)));
    };
    let entry = |name| entries.required_number(name);
    let I = Sym3 {
        xx: entry("ixx")?,
        yy: entry("iyy")?,
        zz: entry("izz")?,
        xy: entry("ixy")?,
        xz: entry("ixz")?,
        yz: entry("iyz")?,
    };
    Ok((RigidInertia::from_com(m, X.r, I.congruence(X.E)), None))
}

//! Changes in a URDF file.

use super::changes::Change;
use super::text::Text;
use super::{PatchError, Source};
use crate::urdf::{Element, inertia};
use crate::write::{rotor_element, urdf_inertial};
use eigenbody::spatial::RigidInertia;
use std::ops::Range;

/// Puts a change where its element is.
pub(super) fn apply(
    change: &Change<'_>,
    source: &Source<'_, '_>,
    text: &mut Text<'_>,
) -> Result<(), PatchError> {
    let no_place = |problem| PatchError::NoPlace { what: change.what(), problem };
    match *change {
        Change::Armature { joint, was, is } => {
            let (&[was], &[is]) = (was, is) else {
                return Err(no_place("a rotor drives one degree of freedom, and it has several"));
            };
            if is < was {
                return Err(no_place("a rotor can only add armature"));
            }
            let robot = source.document.root_element();
            if !robot.namespaces().any(|space| space.name() == Some("drake")) {
                text.set_once(robot, "xmlns:drake", "http://drake.mit.edu");
            }
            text.append(robot, &rotor_element(joint.name(), is - was));
        }
        Change::Limits { is, .. } => {
            let element = source.element(change)?;
            let limit = element.children().find(|child| child.has_tag_name("limit"));
            let (Some((lower, upper)), Some(limit), false) =
                (is, limit, element.attribute("type") == Some("continuous"))
            else {
                return Err(no_place("it has no <limit> that could change"));
            };
            text.set(limit, "lower", &format!("{lower:?}"));
            text.set(limit, "upper", &format!("{upper:?}"));
        }
        Change::Matter { added, .. } => {
            let element = source.element(change)?;
            let own = inertia(Element(element)).map_or(RigidInertia::ZERO, |(inertia, _)| inertia);
            let inertial = element.children().find(|child| child.has_tag_name("inertial"));
            let mut lines = String::new();
            urdf_inertial(&mut lines, &(own + added));
            match inertial.map(|inertial| inertial.range()) {
                Some(Range { start, end }) => text.replace(start..end, lines.trim().to_owned()),
                None => text.append(element, &lines),
            }
        }
    }
    Ok(())
}

//! Changes in an MJCF file.

use super::changes::Change;
use super::text::Text;
use super::{PatchError, Source};
use crate::write::{escaped, mjcf_inertial};
use eigenbody::Joint;
use eigenbody::spatial::{Transform, Vec3};
use roxmltree::Node;

/// Puts a change where its element is.
pub(super) fn apply(
    change: &Change<'_>,
    source: &Source<'_, '_>,
    text: &mut Text<'_>,
) -> Result<(), PatchError> {
    let no_place = |problem| PatchError::NoPlace { what: change.what(), problem };
    let element = source.element(change)?;
    match *change {
        Change::Armature { is, .. } => {
            if !element.has_tag_name("joint") {
                return Err(no_place("its element is no <joint>, and has no armature"));
            }
            if is.iter().any(|&armature| armature != is[0]) {
                return Err(no_place("its degrees of freedom have one armature together"));
            }
            text.set(element, "armature", &format!("{:?}", is[0]));
        }
        Change::Limits { joint, is } => {
            let Some((lower, upper)) = is else { return Err(no_place("it would lose its limits")) };
            let turns = matches!(joint.kind(), Joint::Revolute | Joint::Continuous);
            let unit = if turns && in_degrees(source) { 180.0 / std::f64::consts::PI } else { 1.0 };
            text.set(element, "range", &format!("{:?} {:?}", lower * unit, upper * unit));
            text.set(element, "limited", "true");
        }
        Change::Matter { link, name, added } => {
            if !element.has_tag_name("body") {
                return Err(no_place("its element is no <body>"));
            }
            let pad = format!("{}  ", text.indent(element.range().start));
            let name = escaped(&free_name(source, name));
            let origin = source.loaded.places.origins.get(link).copied().unwrap_or(Vec3::ZERO);
            let inertial = mjcf_inertial(&Transform::translation(origin).transpose_rigid(added));
            text.append(element, &format!("{pad}<body name=\"{name}\">{inertial}</body>\n"));
        }
    }
    Ok(())
}

/// Whether angles are in degrees, as they are unless a compiler says otherwise.
fn in_degrees(source: &Source<'_, '_>) -> bool {
    let compilers = source.document.root_element().children().filter(|e| e.has_tag_name("compiler"));
    compilers.filter_map(|compiler| compiler.attribute("angle")).next_back() != Some("radian")
}

/// A name for matter on a body that no element has.
fn free_name(source: &Source<'_, '_>, body: &str) -> String {
    let mut name = format!("{body} more");
    let taken = |name: &str| {
        let mut elements = source.document.descendants().filter(Node::is_element);
        elements.any(|element| element.attribute("name") == Some(name))
    };
    while taken(&name) {
        name.push('_');
    }
    name
}

//! `<transmission>`: rotor inertia reflected to a joint, where a file gives it.

use super::element::{Element, Fault};
use super::fault::UrdfFault;
use crate::error::shortened;
use roxmltree::Node;

/// Rotor inertia behind a gear, as the joint feels it.
#[derive(Debug, Clone, PartialEq)]
pub struct Rotor {
    /// The joint's name.
    pub joint: String,
    /// n² I_rotor (kg m², or kg).
    pub reflected: f64,
}

/// The rotors of a file. A reduction may stand with the joint or with the actuator; without one it is 1.
///
/// ```text
/// I = n² I_rotor,  I_rotor from <rotorInertia>, <motorInertia> or <rotor_inertia>,  n from <mechanicalReduction> or <gear_ratio>
/// ```
pub(super) fn rotors(robot: Element<'_, '_>) -> Result<Vec<(Rotor, usize)>, Fault> {
    let mut found = Vec::new();
    for transmission in robot.children("transmission") {
        let mut inertia: Option<f64> = None;
        let mut reduction = 1.0;
        for node in transmission.0.descendants().filter(Node::is_element) {
            match node.tag_name().name() {
                "rotorInertia" | "motorInertia" | "rotor_inertia" => inertia = Some(value(node)?),
                "mechanicalReduction" | "gear_ratio" => reduction *= value(node)?,
                _ => {}
            }
        }
        let Some(inertia) = inertia else { continue };
        for joint in transmission.children("joint") {
            let name = joint.attribute("name")?.to_owned();
            let rotor = Rotor { joint: name, reflected: reduction * reduction * inertia };
            found.push((rotor, transmission.offset()));
        }
    }
    Ok(found)
}

/// An element's number, as text or as `value`; zero or more.
fn value(node: Node<'_, '_>) -> Result<f64, Fault> {
    let text = node.attribute("value").or(node.text()).unwrap_or_default().trim();
    let number = text.parse().ok().filter(|x: &f64| x.is_finite());
    number.ok_or_else(|| {
        let (what, text) = (format!("<{}>", node.tag_name().name()), shortened(text));
        Element(node).fault(UrdfFault::NotFinite { what, text })
    })
}

//! `<dynamics damping="..">`: dampers of joints.

use super::element::{Element, Fault};
use eigenbody::Model;
use eigenbody::model::JointInfo;
use eigenbody::stability::{Spring, SpringSource};

/// The dampers of a file's moving joints, one a degree of freedom.
pub(super) fn springs(robot: Element<'_, '_>, model: &Model<f64>) -> Result<Vec<Spring>, Fault> {
    let mut springs = Vec::new();
    for element in robot.children("joint") {
        let Some(dynamics) = element.children("dynamics").next() else { continue };
        let damping = dynamics.number("damping")?.unwrap_or(0.0);
        let name = element.attribute("name")?;
        let joint = model.joints().iter().find(|joint| joint.name() == name);
        let dofs = joint.filter(|_| damping != 0.0).map_or(0..0, JointInfo::dofs);
        springs.extend(dofs.map(|d| Spring {
            name: name.to_owned(),
            source: SpringSource::Joint,
            arms: vec![(d, 1.0)],
            stiffness: 0.0,
            damping,
        }));
    }
    Ok(springs)
}

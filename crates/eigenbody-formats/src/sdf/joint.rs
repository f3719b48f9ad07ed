//! `<joint>`: kind, axes in the joint's frame, limits, mimic.

use super::fault::{Fault, SdfFault, array, boolean_in, child, fault, number_in, required};
use super::scope::Scopes;
use crate::xml::Element;
use eigenbody::Joint;
use eigenbody::dynamics::Tie;
use eigenbody::model::MimicSpec;
use eigenbody::spatial::{Mat3, Vec3};

/// Limits from here on are none.
const UNLIMITED: f64 = 1e15;

/// What a joint says of itself.
pub(super) struct Motion {
    pub kind: Joint<f64>,
    pub axis: Vec3<f64>,
    pub limits: Option<(f64, f64)>,
    pub mimic: Option<MimicSpec<f64>>,
}

impl Motion {
    /// What the joint leaves its links, if it closes a loop.
    pub fn tie(&self) -> Tie {
        let unit = |axis: Vec3<f64>| axis * (1.0 / axis.norm());
        match self.kind {
            Joint::Fixed => Tie::Weld,
            Joint::Prismatic => Tie::Slide(unit(self.axis)),
            Joint::Universal { first } => Tie::Universal { first: unit(first), second: unit(self.axis) },
            Joint::Revolute | Joint::Continuous => Tie::Hinge(unit(self.axis)),
            // The only other kind that is read.
            _ => Tie::Ball,
        }
    }
}

/// A joint's motion; `E` turns world coordinates into those of the joint's frame.
pub(super) fn read(
    joint: &Element,
    name: &str,
    scope: &str,
    scopes: &Scopes<'_>,
    E: &Mat3<f64>,
    axes_in_model: bool,
) -> Result<Motion, Fault> {
    let axis = |tag: &'static str| axis(required(joint, tag)?, scope, scopes, E, axes_in_model);
    let plain = |kind| Motion { kind, axis: Vec3::Z, limits: None, mimic: None };
    let found = joint.get("type").unwrap_or_default();
    Ok(match found {
        "fixed" => plain(Joint::Fixed),
        "ball" => plain(Joint::Spherical),
        "revolute" | "continuous" | "prismatic" => {
            let element = required(joint, "axis")?;
            let limits = limits(element)?;
            let kind = match found {
                "prismatic" => Joint::Prismatic,
                "revolute" if limits.is_some() => Joint::Revolute,
                _ => Joint::Continuous,
            };
            Motion { kind, axis: axis("axis")?, limits, mimic: mimic(element, scope)? }
        }
        "universal" | "revolute2" => {
            Motion { axis: axis("axis2")?, ..plain(Joint::Universal { first: axis("axis")? }) }
        }
        _ => {
            let (joint_name, found) = (name.to_owned(), found.to_owned());
            return Err(fault(joint.spot_of("type"), SdfFault::JointType { joint: joint_name, found }));
        }
    })
}

fn axis(
    axis: &Element,
    scope: &str,
    scopes: &Scopes<'_>,
    E: &Mat3<f64>,
    axes_in_model: bool,
) -> Result<Vec3<f64>, Fault> {
    let Some(xyz) = child(axis, "xyz")? else { return Ok(Vec3::Z) };
    let direction = Vec3::from_f64(array(xyz)?);
    let in_model = boolean_in(axis, "use_parent_model_frame", axes_in_model)?;
    let frame = match xyz.get("expressed_in").filter(|name| !name.is_empty()) {
        Some(name) => scopes.find(name, scope, xyz.at)?,
        None if in_model => scopes.find("", scope, xyz.at)?,
        None => return Ok(direction),
    };
    Ok(*E * scopes.pose(frame)?.E.transpose_times(direction))
}

fn limits(axis: &Element) -> Result<Option<(f64, f64)>, Fault> {
    let Some(limit) = child(axis, "limit")? else { return Ok(None) };
    let bound = |tag, default| number_in(limit, tag, default);
    let (lower, upper) = (bound("lower", f64::NEG_INFINITY)?, bound("upper", f64::INFINITY)?);
    Ok((lower > -UNLIMITED || upper < UNLIMITED).then_some((lower, upper)))
}

/// q = multiplier (q of the other − reference) + offset.
fn mimic(axis: &Element, scope: &str) -> Result<Option<MimicSpec<f64>>, Fault> {
    let Some(mimic) = child(axis, "mimic")? else { return Ok(None) };
    let missing = || {
        let element = mimic.described();
        fault(mimic.at, SdfFault::MissingAttribute { element, name: "joint" })
    };
    let leader = mimic.get("joint").ok_or_else(missing)?;
    let multiplier = number_in(mimic, "multiplier", 1.0)?;
    let offset = number_in(mimic, "offset", 0.0)? - multiplier * number_in(mimic, "reference", 0.0)?;
    Ok(Some(MimicSpec { joint: format!("{scope}{leader}"), multiplier, offset }))
}

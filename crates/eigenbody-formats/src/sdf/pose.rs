//! `<pose>`: six numbers, position and roll-pitch-yaw, or seven with a quaternion.

use super::fault::{Fault, SdfFault, child, fault, numbers, value_fault};
use crate::xml::{Attribute, Element, Spot};
use eigenbody::spatial::{Mat3, Transform, Vec3};

/// What names the frame that a pose is relative to; `frame` is its name up to version 1.6.
fn relative(pose: &Element) -> Option<&Attribute> {
    pose.find("relative_to").or(pose.find("frame"))
}

/// Where a `<pose>` says what it is relative to.
pub(super) fn relative_spot(pose: &Element) -> Spot {
    relative(pose).map_or(pose.at, |attribute| attribute.at)
}

/// The pose of an element in the frame of what it stands in; it may be relative to no other.
pub(super) fn own_pose(element: &Element) -> Result<Transform<f64>, Fault> {
    match (pose(element)?, child(element, "pose")?) {
        ((_, Some(_)), Some(pose)) => {
            let why = "mass is read in the frame of its link alone";
            Err(fault(relative_spot(pose), SdfFault::Unsupported { what: pose.described(), why }))
        }
        ((X, _), _) => Ok(X),
    }
}

/// The pose of an element and what it says the pose is relative to.
pub(super) fn pose(element: &Element) -> Result<(Transform<f64>, Option<&str>), Fault> {
    let Some(pose) = child(element, "pose")? else { return Ok((Transform::IDENTITY, None)) };
    let relative_to = relative(pose).map(|a| a.value.as_str()).filter(|name| !name.is_empty());
    let quaternion = pose.get("rotation_format") == Some("quat_xyzw");
    let scale = match pose.get("degrees") {
        Some("true" | "1") => 1f64.to_radians(),
        None | Some("false" | "0") => 1.0,
        Some(text) => return Err(value_fault(pose, text, "'degrees' to be true or false")),
    };
    let E = match (numbers(pose)?.as_slice(), quaternion) {
        ([], _) => return Ok((Transform::IDENTITY, relative_to)),
        (&[x, y, z, roll, pitch, yaw], false) => {
            let E = Mat3::rotation_rpy(roll * scale, pitch * scale, yaw * scale);
            Transform::new(E, Vec3::new(x, y, z))
        }
        (&[x, y, z, i, j, k, w], true) if w * w + i * i + j * j + k * k > 1e-12 => {
            Transform::new(Mat3::rotation_quaternion(w, Vec3::new(i, j, k)), Vec3::new(x, y, z))
        }
        (_, true) => return Err(value_fault(pose, &pose.text, "x y z and a quaternion x y z w")),
        (_, false) => return Err(value_fault(pose, &pose.text, "x y z roll pitch yaw")),
    };
    Ok((E, relative_to))
}

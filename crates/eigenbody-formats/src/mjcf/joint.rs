//! `<joint>` and `<freejoint>`.

use super::attribute::{array, boolean, keyword, number, numbers};
use super::body::{Align, Joint, Motion};
use super::compiler::Compiler;
use super::defaults::Styled;
use super::fault::{Fault, MjcfFault, fault};
use super::names::name;
use super::spring::JointSpring;
use crate::xml::Element;
use eigenbody::spatial::{Transform, Vec3};

const TYPES: [&str; 4] = ["free", "ball", "slide", "hinge"];

/// Shortest axis that gives a direction.
const SHORTEST: f64 = 1e-7;

/// A joint in its body, inside a frame.
pub(super) fn read(joint: &Styled<'_>, frame: &Transform<f64>, settings: &Compiler) -> Result<Joint, Fault> {
    let tag = "joint";
    let motion = match keyword(joint.find("type"), tag, &TYPES)? {
        Some(0) => Motion::Free,
        Some(1) => Motion::Ball,
        Some(2) => Motion::Slide,
        _ => Motion::Hinge,
    };
    let angle = if motion == Motion::Hinge { settings.radians } else { 1.0 };
    let axis = Vec3::from_f64(array(joint.find("axis"), tag)?.unwrap_or([0.0, 0.0, 1.0]));
    let axis = match motion {
        Motion::Free | Motion::Ball => Vec3::Z,
        _ if axis.norm() < SHORTEST => {
            let at = joint.find("axis").map_or(joint.element.at, |a| a.at);
            return Err(fault(at, MjcfFault::NoDirection { name: "axis".into(), tag: tag.into() }));
        }
        _ => frame.E.transpose_times(axis * (1.0 / axis.norm())),
    };
    let pos = Vec3::from_f64(array(joint.find("pos"), tag)?.unwrap_or_default());
    let pos = if motion == Motion::Free { Vec3::ZERO } else { frame.inverse_point(pos) };
    // What does not touch H must still be numbers.
    for name in ["springref", "frictionloss", "margin"] {
        number(joint.find(name), tag)?;
    }
    Ok(Joint {
        name: name(joint.element).map(str::to_owned),
        called: name(joint.element).map(str::to_owned),
        at: joint.element.at,
        motion,
        pos,
        axis,
        reference: number(joint.find("ref"), tag)?.unwrap_or(0.0) * angle,
        armature: armature(joint)?,
        spring: JointSpring::read(joint)?,
        limits: limits(joint, motion, settings)?.map(|(lower, upper)| (lower * angle, upper * angle)),
        align: Align::Auto,
    })
}

/// A free joint, which knows no classes.
pub(super) fn read_free(element: &Element) -> Result<Joint, Fault> {
    let align = match keyword(element.find("align"), "freejoint", &["false", "true", "auto"])? {
        Some(0) => Align::Never,
        Some(1) => Align::Always,
        _ => Align::Auto,
    };
    Ok(Joint {
        name: name(element).map(str::to_owned),
        called: name(element).map(str::to_owned),
        at: element.at,
        motion: Motion::Free,
        pos: Vec3::ZERO,
        axis: Vec3::Z,
        reference: 0.0,
        armature: 0.0,
        spring: JointSpring::default(),
        limits: None,
        align,
    })
}

fn armature(joint: &Styled<'_>) -> Result<f64, Fault> {
    Ok(number(joint.find("armature"), "joint")?.unwrap_or(0.0))
}

/// The range of a limited joint, as written.
fn limits(joint: &Styled<'_>, motion: Motion, settings: &Compiler) -> Result<Option<(f64, f64)>, Fault> {
    let range = numbers(joint.find("range"), "joint", 2..=2)?;
    let [lower, upper] = match range.as_deref() {
        Some(&[lower, upper]) => [lower, upper],
        _ => [0.0, 0.0],
    };
    if motion == Motion::Free {
        return Ok(None);
    }
    let limited = joint.find("limited").filter(|a| a.value != "auto");
    let limited = match boolean(limited, "joint")? {
        Some(limited) => limited,
        None if lower == 0.0 && upper == 0.0 => false,
        None if settings.autolimits => true,
        None => {
            let element = joint.element.described();
            return Err(fault(joint.element.at, MjcfFault::AutoLimits { element }));
        }
    };
    if !limited || motion == Motion::Ball {
        return Ok(None);
    }
    if lower >= upper {
        let element = joint.element.described();
        return Err(fault(joint.element.at, MjcfFault::EmptyRange { element, lower, upper }));
    }
    Ok(Some((lower, upper)))
}

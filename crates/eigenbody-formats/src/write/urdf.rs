//! A model as URDF.

use super::{Central, WriteError, body_name, escaped, numbers, vector};
use eigenbody::model::Body;
use eigenbody::spatial::{Mat3, RigidInertia, Transform};
use eigenbody::{Joint, Model};
use std::fmt::Write;

/// The model as a URDF file that reloads to the same H, degrees of freedom in the same order.
///
/// A floating base is left to whoever reads the file. Universal joints become two revolute ones, cylindrical joints a revolute
/// and a prismatic one. Errors: [`WriteError`] for armature, and for spherical and helical joints.
pub fn write_urdf(model: &Model<f64>) -> Result<String, WriteError> {
    let armed = model.joints().iter().find(|joint| joint.dofs().any(|d| model.armature()[d] != 0.0));
    match armed {
        Some(joint) => Err(WriteError::Armature { joint: joint.name().to_owned() }),
        None => write(model, ""),
    }
}

/// The same with armature as the rotors of transmissions, in the words that Drake reads too.
///
/// ```text
/// n² I_rotor = armature,  n = 1
/// ```
/// Whoever does not read rotors reads another H: reloading with [`Loaded::with_rotors`](crate::Loaded::with_rotors) gives the same.
/// Errors: [`WriteError`] as [`write_urdf`], and for armature on a joint of several degrees of freedom.
pub fn write_urdf_with_rotors(model: &Model<f64>) -> Result<String, WriteError> {
    let mut rotors = String::new();
    for joint in model.joints() {
        let armature: Vec<f64> = joint.dofs().map(|d| model.armature()[d]).collect();
        match armature.as_slice() {
            all if all.iter().all(|&a| a == 0.0) => {}
            &[armature] => rotors.push_str(&rotor(joint.name(), armature)),
            _ => return Err(WriteError::Rotor { joint: joint.name().to_owned() }),
        }
    }
    write(model, &rotors)
}

/// A rotor that gives a joint armature, as lines below `<robot>`.
pub(crate) fn rotor(joint: &str, armature: f64) -> String {
    let name = escaped(joint);
    format!(
        "  <transmission name=\"{name} transmission\">\n    <type>transmission_interface/SimpleTransmission</type>\n    \
         <joint name=\"{name}\"/>\n    <actuator name=\"{name} motor\"><drake:rotor_inertia value=\"{armature:?}\"/>\
         <drake:gear_ratio value=\"1\"/></actuator>\n  </transmission>\n"
    )
}

fn write(model: &Model<f64>, rotors: &str) -> Result<String, WriteError> {
    let drake = if rotors.is_empty() { "" } else { " xmlns:drake=\"http://drake.mit.edu\"" };
    let mut out = format!("<?xml version=\"1.0\"?>\n<robot name=\"{}\"{drake}>\n", escaped(model.name()));
    if !model.has_floating_base() {
        let _ = writeln!(out, "  <link name=\"{}\"/>", escaped(&root(model)));
    }
    for (b, body) in model.bodies().iter().enumerate() {
        if let Some(between) = between(model, b) {
            let _ = writeln!(out, "  <link name=\"{}\"/>", escaped(&between));
        }
        let _ = writeln!(out, "  <link name=\"{}\">", escaped(body_name(model, b)));
        inertial(&mut out, body.inertia());
        let _ = writeln!(out, "  </link>");
    }
    // Coordinates follow the order of joints.
    let mut order: Vec<usize> = (0..model.bodies().len()).collect();
    order.sort_by_key(|&b| model.bodies()[b].dofs().start);
    for b in order {
        joint(&mut out, model, b)?;
    }
    out.push_str(rotors);
    out.push_str("</robot>\n");
    Ok(out)
}

/// A name for the world's link that no body has.
fn root(model: &Model<f64>) -> String {
    let mut name = "world".to_owned();
    while (0..model.bodies().len()).any(|b| body_name(model, b) == name) {
        name.push('_');
    }
    name
}

/// The massless link inside a joint with two axes.
fn between(model: &Model<f64>, body: usize) -> Option<String> {
    let two = matches!(model.bodies()[body].joint(), Joint::Universal { .. } | Joint::Cylindrical);
    two.then(|| format!("{} 1", body_name(model, body)))
}

/// `<inertial>` as lines below `<link>`; none without inertia.
pub(crate) fn inertial(out: &mut String, inertia: &RigidInertia<f64>) {
    if *inertia == RigidInertia::ZERO {
        return;
    }
    let Central { m, com, I } = Central::of(inertia);
    let _ = writeln!(
        out,
        "    <inertial><origin xyz=\"{}\"/><mass value=\"{m:?}\"/>\n      <inertia ixx=\"{:?}\" ixy=\"{:?}\" ixz=\"{:?}\" iyy=\"{:?}\" iyz=\"{:?}\" izz=\"{:?}\"/></inertial>",
        vector(com),
        I.xx,
        I.xy,
        I.xz,
        I.yy,
        I.yz,
        I.zz
    );
}

fn joint(out: &mut String, model: &Model<f64>, b: usize) -> Result<(), WriteError> {
    let body = &model.bodies()[b];
    let Some(info) = model.joints().iter().find(|j| j.dofs().start == body.dofs().start) else {
        return Ok(());
    };
    let name = info.name();
    let parent = match body.parent() {
        Some(parent) => body_name(model, parent).to_owned(),
        None if model.has_floating_base() => return Ok(()),
        None => root(model),
    };
    let child = body_name(model, b);
    let at = *body.tree_transform();
    let limits = limits(model, body);
    match *body.joint() {
        Joint::Revolute => {
            let kind = if limits.is_empty() { "continuous" } else { "revolute" };
            let rest = limits + &mimic(model, body);
            write_joint(out, name, kind, [&parent, child], &at, "0 0 1", &rest);
        }
        Joint::Continuous => {
            write_joint(out, name, "continuous", [&parent, child], &at, "0 0 1", &mimic(model, body));
        }
        Joint::Prismatic => {
            let rest = limits + &mimic(model, body);
            write_joint(out, name, "prismatic", [&parent, child], &at, "0 0 1", &rest);
        }
        Joint::Planar => write_joint(out, name, "planar", [&parent, child], &at, "0 0 1", ""),
        Joint::Floating => write_joint(out, name, "floating", [&parent, child], &at, "0 0 1", ""),
        Joint::Universal { first } => {
            let middle = format!("{child} 1");
            let identity = Transform::IDENTITY;
            write_joint(
                out,
                &format!("{name}/first"),
                "continuous",
                [&parent, &middle],
                &at,
                &vector(first),
                "",
            );
            write_joint(
                out,
                &format!("{name}/second"),
                "continuous",
                [&middle, child],
                &identity,
                "0 0 1",
                "",
            );
        }
        Joint::Cylindrical => {
            let middle = format!("{child} 1");
            let identity = Transform::IDENTITY;
            write_joint(out, &format!("{name}/angle"), "continuous", [&parent, &middle], &at, "0 0 1", "");
            let ends = [middle.as_str(), child];
            write_joint(out, &format!("{name}/displacement"), "prismatic", ends, &identity, "0 0 1", "");
        }
        Joint::Fixed => {}
        Joint::Spherical | Joint::Helical { .. } => {
            let (joint, kind) = (name.to_owned(), body.joint().kind());
            return Err(WriteError::Joint { joint, kind, format: "URDF" });
        }
    }
    Ok(())
}

fn write_joint(
    out: &mut String,
    name: &str,
    kind: &str,
    [parent, child]: [&str; 2],
    at: &Transform<f64>,
    axis: &str,
    rest: &str,
) {
    let _ = writeln!(
        out,
        "  <joint name=\"{}\" type=\"{kind}\"><parent link=\"{}\"/><child link=\"{}\"/>\n    <origin xyz=\"{}\" rpy=\"{}\"/><axis xyz=\"{axis}\"/>{rest}</joint>",
        escaped(name),
        escaped(parent),
        escaped(child),
        vector(at.r),
        numbers(&rpy(&at.E)),
    );
}

fn limits(model: &Model<f64>, body: &Body<f64>) -> String {
    let info = model.joints().iter().find(|j| j.dofs().start == body.dofs().start);
    match info.and_then(eigenbody::model::JointInfo::limits) {
        Some((lower, upper)) if lower.is_finite() && upper.is_finite() => {
            format!("<limit lower=\"{lower:?}\" upper=\"{upper:?}\" effort=\"0\" velocity=\"0\"/>")
        }
        _ => String::new(),
    }
}

fn mimic(model: &Model<f64>, body: &Body<f64>) -> String {
    let k = body.coordinates().start;
    match model.coupling().map(|coupling| coupling.follows(k)) {
        Some((leader, multiplier, offset)) if leader != k => {
            let leader = model.joints().iter().find(|j| j.coordinates().start == leader);
            let name = escaped(leader.map_or("", |j| j.name()));
            format!("<mimic joint=\"{name}\" multiplier=\"{multiplier:?}\" offset=\"{offset:?}\"/>")
        }
        _ => String::new(),
    }
}

/// Roll, pitch and yaw of a coordinate rotation E = Rᵀ, R = Rz Ry Rx.
///
/// Roll is taken after yaw is undone, so that looking straight up costs no digits: any yaw will do there.
fn rpy(E: &Mat3<f64>) -> [f64; 3] {
    let yaw = E.x.y.atan2(E.x.x);
    let (s, c) = yaw.sin_cos();
    let pitch = (-E.x.z).atan2(c * E.x.x + s * E.x.y);
    let roll = (s * E.z.x - c * E.z.y).atan2(c * E.y.y - s * E.y.x);
    [roll, pitch, yaw]
}

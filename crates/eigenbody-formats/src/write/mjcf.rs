//! A model as MJCF.

use super::{Central, WriteError, body_name, escaped, numbers, quaternion, vector};
use eigenbody::spatial::RigidInertia;
use eigenbody::{Joint, Model};
use std::fmt::Write;

/// The model as an MJCF file that reloads to the same H; degrees of freedom stand in the order of the bodies.
///
/// Universal joints become two hinges, cylindrical joints a hinge and a slide; mimic joints become equalities. Errors:
/// [`WriteError`] for helical and planar joints, for inertias with a moment below zero, and for floating joints below the world.
pub fn write_mjcf(model: &Model<f64>) -> Result<String, WriteError> {
    let mut out = format!("<mujoco model=\"{}\">\n", escaped(model.name()));
    out.push_str("  <compiler angle=\"radian\" autolimits=\"true\"/>\n");
    let _ = writeln!(out, "  <option gravity=\"{}\"/>\n  <worldbody>", vector(model.gravity()));
    let mut open: Vec<usize> = Vec::new();
    for (b, body) in model.bodies().iter().enumerate() {
        while open.last().copied() != body.parent() {
            open.pop();
            let _ = writeln!(out, "{}</body>", indent(open.len()));
        }
        write_body(&mut out, model, b, open.len())?;
        open.push(b);
    }
    while open.pop().is_some() {
        let _ = writeln!(out, "{}</body>", indent(open.len()));
    }
    out.push_str("  </worldbody>\n");
    equalities(&mut out, model);
    out.push_str("</mujoco>\n");
    Ok(out)
}

fn indent(depth: usize) -> String {
    " ".repeat(4 + 2 * depth)
}

fn write_body(out: &mut String, model: &Model<f64>, b: usize, depth: usize) -> Result<(), WriteError> {
    let body = &model.bodies()[b];
    let at = body.tree_transform();
    let (r, q) = (vector(at.r), numbers(&quaternion(&at.E)));
    let pad = indent(depth);
    let _ = writeln!(out, "{pad}<body name=\"{}\" pos=\"{r}\" quat=\"{q}\">", escaped(body_name(model, b)));
    if *body.inertia() != RigidInertia::ZERO {
        let least = Central::of(body.inertia()).least_moment();
        if least < 0.0 {
            let link = body_name(model, b).to_owned();
            return Err(WriteError::Inertia { link, least, format: "MJCF" });
        }
        let _ = writeln!(out, "{pad}  {}", inertial(body.inertia()));
    }
    let info = model.joints().iter().find(|j| j.dofs().start == body.dofs().start);
    let Some(info) = info else { return Ok(()) };
    let name = info.name();
    let armature: Vec<f64> = body.dofs().map(|d| model.armature()[d]).collect();
    let mut joint = |name: &str, kind: &str, axis: &str, armature: f64, limits: Option<(f64, f64)>| {
        let _ = write!(out, "{pad}  <joint name=\"{}\" type=\"{kind}\"", escaped(name));
        if !axis.is_empty() {
            let _ = write!(out, " axis=\"{axis}\"");
        }
        if armature != 0.0 {
            let _ = write!(out, " armature=\"{armature:?}\"");
        }
        if let Some((lower, upper)) = limits.filter(|(l, u)| l < u) {
            let _ = write!(out, " range=\"{lower:?} {upper:?}\"");
        }
        out.push_str("/>\n");
    };
    let unsupported = || {
        let (joint, kind) = (name.to_owned(), body.joint().kind());
        Err(WriteError::Joint { joint, kind, format: "MJCF" })
    };
    let same = armature.iter().all(|&a| a == armature[0]);
    match *body.joint() {
        Joint::Revolute | Joint::Continuous => joint(name, "hinge", "0 0 1", armature[0], info.limits()),
        Joint::Prismatic => joint(name, "slide", "0 0 1", armature[0], info.limits()),
        Joint::Spherical if same => joint(name, "ball", "", armature[0], None),
        Joint::Floating if same && body.parent().is_none() => joint(name, "free", "", armature[0], None),
        Joint::Universal { first } => {
            joint(&format!("{name}/first"), "hinge", &vector(first), armature[0], None);
            joint(&format!("{name}/second"), "hinge", "0 0 1", armature[1], None);
        }
        Joint::Cylindrical => {
            joint(&format!("{name}/angle"), "hinge", "0 0 1", armature[0], None);
            joint(&format!("{name}/displacement"), "slide", "0 0 1", armature[1], None);
        }
        Joint::Fixed => {}
        _ => return unsupported(),
    }
    Ok(())
}

/// `<inertial>` of a body.
pub(crate) fn inertial(inertia: &RigidInertia<f64>) -> String {
    let Central { m, com, I } = Central::of(inertia);
    let full = numbers(&[I.xx, I.yy, I.zz, I.xy, I.xz, I.yz]);
    format!("<inertial pos=\"{}\" mass=\"{m:?}\" fullinertia=\"{full}\"/>", vector(com))
}

/// Mimic joints. Their joints have no reference coordinates, so offsets are as they are.
fn equalities(out: &mut String, model: &Model<f64>) {
    let Some(coupling) = model.coupling() else { return };
    out.push_str("  <equality>\n");
    for joint in model.joints().iter().filter(|j| j.kind().nq() == 1) {
        let k = joint.coordinates().start;
        let (leader, multiplier, offset) = coupling.follows(k);
        let leader_joint = model.joints().iter().find(|j| j.coordinates().start == leader);
        if let (true, Some(leader)) = (leader != k, leader_joint) {
            let (name, leader) = (escaped(joint.name()), escaped(leader.name()));
            let coefficients = numbers(&[offset, multiplier]);
            let _ = writeln!(
                out,
                "    <joint joint1=\"{name}\" joint2=\"{leader}\" polycoef=\"{coefficients}\"/>"
            );
        }
    }
    out.push_str("  </equality>\n");
}

//! `<link>`: its mass, given or from its collision shapes.

use super::fault::{Fault, array, child, number_in, unsupported, value_fault};
use super::pose::own_pose;
use crate::shape::Shape;
use crate::xml::Element;
use eigenbody::spatial::{RigidInertia, Sym3, Vec3};

/// The link's inertia about its own frame's origin. A link that says nothing has 1 kg and 1 kg m², as the format says.
pub(super) fn inertia(link: &Element) -> Result<RigidInertia<f64>, Fault> {
    let Some(inertial) = child(link, "inertial")? else {
        return Ok(RigidInertia::from_com(1.0, Vec3::ZERO, Sym3::diagonal(1.0, 1.0, 1.0)));
    };
    if inertial.get("auto") == Some("true") {
        return from_collisions(link, inertial);
    }
    if child(inertial, "fluid_added_mass")?.is_some() {
        return Err(unsupported(inertial, "fluid_added_mass is no rigid-body inertia"));
    }
    let m = number_in(inertial, "mass", 1.0)?;
    let X = own_pose(inertial)?;
    let I = match child(inertial, "inertia")? {
        None => Sym3::diagonal(1.0, 1.0, 1.0),
        Some(entries) => Sym3 {
            xx: number_in(entries, "ixx", 1.0)?,
            yy: number_in(entries, "iyy", 1.0)?,
            zz: number_in(entries, "izz", 1.0)?,
            xy: number_in(entries, "ixy", 0.0)?,
            xz: number_in(entries, "ixz", 0.0)?,
            yz: number_in(entries, "iyz", 0.0)?,
        },
    };
    Ok(RigidInertia::from_com(m, X.r, I.congruence(X.E)))
}

/// The sum of the link's collision shapes.
fn from_collisions(link: &Element, inertial: &Element) -> Result<RigidInertia<f64>, Fault> {
    let density = number_in(inertial, "density", 1000.0)?;
    let mut sum = RigidInertia::ZERO;
    for collision in link.children_named("collision") {
        let density = number_in(collision, "density", density)?;
        let X = own_pose(collision)?;
        let Some(geometry) = child(collision, "geometry")? else { continue };
        let Some(shape) = geometry.children.first() else { continue };
        let shape = primitive(shape)?;
        let m = density * shape.volume(false);
        let [xx, yy, zz] = shape.unit_inertia(false).map(|i| i * m);
        sum += RigidInertia::from_com(m, X.r, Sym3::diagonal(xx, yy, zz).congruence(X.E));
    }
    Ok(sum)
}

pub(super) fn primitive(shape: &Element) -> Result<Shape, Fault> {
    let size = |tag: &'static str| -> Result<f64, Fault> {
        let element = super::fault::required(shape, tag)?;
        let [x] = array(element)?;
        if x > 0.0 { Ok(x) } else { Err(value_fault(element, &element.text, "more than 0")) }
    };
    let sizes = |tag: &'static str| -> Result<[f64; 3], Fault> {
        let element = super::fault::required(shape, tag)?;
        let found: [f64; 3] = array(element)?;
        match found.iter().all(|&x| x > 0.0) {
            true => Ok(found),
            false => Err(value_fault(element, &element.text, "three numbers more than 0")),
        }
    };
    Ok(match shape.tag.as_str() {
        "box" => Shape::Box(sizes("size")?.map(|s| s / 2.0)),
        "sphere" => Shape::Sphere([size("radius")?]),
        "cylinder" => Shape::Cylinder([size("radius")?, size("length")? / 2.0]),
        "capsule" => Shape::Capsule([size("radius")?, size("length")? / 2.0]),
        "ellipsoid" => Shape::Ellipsoid(sizes("radii")?),
        "plane" => Shape::Plane,
        _ => {
            return Err(unsupported(
                shape,
                "inertia comes from boxes, spheres, cylinders, capsules and ellipsoids",
            ));
        }
    })
}

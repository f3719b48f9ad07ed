//! `<visual>`: how a link looks.

use super::element::Element;
use super::pose::origin;
use crate::looks::{Form, Look};
use crate::shape::Shape;

/// The visuals of a robot's links. One that is not understood is passed over: nothing is computed from it.
pub(super) fn looks(robot: Element<'_, '_>) -> Vec<Look> {
    let mut found = Vec::new();
    for link in robot.children("link") {
        let Ok(name) = link.attribute("name") else { continue };
        for visual in link.children("visual") {
            if let Some((pose, form)) = origin(visual).ok().zip(form(visual)) {
                found.push(Look { link: name.to_owned(), pose, form });
            }
        }
    }
    found
}

/// Files of meshes that visuals and collisions name.
pub(super) fn meshes(robot: Element<'_, '_>) -> Vec<String> {
    let mut found = Vec::new();
    for link in robot.children("link") {
        for shape in link.children("visual").chain(link.children("collision")) {
            let geometry = shape.child("geometry").ok().flatten();
            let mesh = geometry.and_then(|geometry| geometry.child("mesh").ok()?);
            found.extend(mesh.and_then(|mesh| mesh.attribute("filename").ok().map(str::to_owned)));
        }
    }
    found
}

fn form(visual: Element<'_, '_>) -> Option<Form> {
    let geometry = visual.child("geometry").ok()??;
    let shape = |tag| geometry.child(tag).ok().flatten();
    let number = |element: Element<'_, '_>, name| element.number(name).ok().flatten().map(f64::abs);
    if let Some(element) = shape("box") {
        let size: [f64; 3] = element.numbers("size").ok()??;
        return Some(Form::Primitive(Shape::Box(size.map(|edge| 0.5 * edge.abs()))));
    }
    if let Some(element) = shape("sphere") {
        return Some(Form::Primitive(Shape::Sphere([number(element, "radius")?])));
    }
    for tag in ["cylinder", "capsule"] {
        if let Some(element) = shape(tag) {
            let sizes = [number(element, "radius")?, 0.5 * number(element, "length")?];
            return Some(Form::Primitive(match tag {
                "cylinder" => Shape::Cylinder(sizes),
                _ => Shape::Capsule(sizes),
            }));
        }
    }
    let mesh = shape("mesh")?;
    let scale = mesh.numbers("scale").ok()?.unwrap_or([1.0; 3]);
    Some(Form::Mesh { file: mesh.attribute("filename").ok()?.to_owned(), scale })
}

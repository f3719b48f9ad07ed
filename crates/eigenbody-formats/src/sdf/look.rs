//! `<visual>`: how a link looks.

use super::fault::{array, child, required};
use super::{link, pose};
use crate::looks::Form;
use crate::shape::Shape;
use crate::xml::Element;
use eigenbody::spatial::Transform;

/// The visuals of a link, from its own frame to theirs. One that is not understood is passed over: nothing is computed from it.
pub(super) fn looks(link: &Element) -> Vec<(Transform<f64>, Form)> {
    link.children_named("visual").filter_map(|visual| Some((place(visual)?, form(visual)?))).collect()
}

fn place(visual: &Element) -> Option<Transform<f64>> {
    match pose::pose(visual).ok()? {
        (X, None) => Some(X),
        (_, Some(_)) => None,
    }
}

fn form(visual: &Element) -> Option<Form> {
    let geometry = child(visual, "geometry").ok()??;
    let Some(mesh) = child(geometry, "mesh").ok()? else {
        let shape = link::primitive(geometry.children.first()?).ok()?;
        return (shape != Shape::Plane).then_some(Form::Primitive(shape));
    };
    let scale = child(mesh, "scale").ok()?.map_or(Ok([1.0; 3]), array).ok()?;
    Some(Form::Mesh { file: required(mesh, "uri").ok()?.text.clone(), scale })
}

//! `<keyframe>`: configurations with names.

use super::attribute::numbers;
use super::fault::{Fault, MjcfFault, fault};
use crate::loaded::Keyframe;
use crate::xml::Element;
use eigenbody::Model;

/// The name of the pose that the file describes.
pub(super) const REFERENCE: &str = "qpos0";

/// The pose that the file describes, and those of its `<key>` elements.
pub(super) fn read(root: &Element, model: &Model<f64>, reference: &[f64]) -> Result<Vec<Keyframe>, Fault> {
    let mut found = vec![Keyframe { name: REFERENCE.to_owned(), q: reference.to_vec() }];
    let keys = root.children_named("keyframe").flat_map(|section| &section.children);
    for (k, key) in keys.enumerate() {
        let name = key.get("name").map_or_else(|| k.to_string(), str::to_owned);
        let q = match numbers(key.find("qpos"), "key", 0..=usize::MAX)? {
            None => reference.to_vec(),
            Some(q) => coordinates(key, &name, q, model)?,
        };
        found.push(Keyframe { name, q });
    }
    Ok(found)
}

/// The coordinates of a key, quaternions normalised.
fn coordinates(key: &Element, name: &str, mut q: Vec<f64>, model: &Model<f64>) -> Result<Vec<f64>, Fault> {
    let at = key.spot_of("qpos");
    if q.len() != model.nq() {
        let (name, found, expected) = (name.to_owned(), q.len(), model.nq());
        return Err(fault(at, MjcfFault::KeyLength { name, found, expected }));
    }
    for joint in model.joints() {
        let Some(first) = joint.kind().quaternion() else { continue };
        let first = joint.coordinates().start + first;
        let quaternion = &mut q[first..first + 4];
        let norm = quaternion.iter().map(|x| x * x).sum::<f64>().sqrt();
        if norm < 1e-14 {
            let (name, joint) = (name.to_owned(), joint.name().to_owned());
            return Err(fault(at, MjcfFault::KeyQuaternion { name, joint }));
        }
        quaternion.iter_mut().for_each(|x| *x /= norm);
    }
    Ok(q)
}

//! `<keyframe>`: configurations with names.

use super::attribute::numbers;
use super::fault::{Fault, MjcfFault, fault};
use crate::loaded::Keyframe;
use crate::xml::Element;
use eigenbody::Model;
use eigenbody::spatial::Mat3;

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

/// The unit quaternion w, x, y, z of a coordinate rotation E.
pub(super) fn quaternion(E: &Mat3<f64>) -> [f64; 4] {
    let [a, b, c] = [E.x.x, E.y.y, E.z.z];
    // Four times the squares; the largest is at least 1.
    let squares = [1.0 + a + b + c, 1.0 + a - b - c, 1.0 - a + b - c, 1.0 - a - b + c];
    let largest = (0..4).max_by(|&i, &j| squares[i].total_cmp(&squares[j])).unwrap_or(0);
    let s = 0.5 / squares[largest].sqrt();
    // E is the transpose of R.
    let (wx, wy, wz) = (E.y.z - E.z.y, E.z.x - E.x.z, E.x.y - E.y.x);
    let (xy, xz, yz) = (E.x.y + E.y.x, E.x.z + E.z.x, E.y.z + E.z.y);
    let half = squares[largest];
    match largest {
        0 => [half * s, wx * s, wy * s, wz * s],
        1 => [wx * s, half * s, xy * s, xz * s],
        2 => [wy * s, xy * s, half * s, yz * s],
        _ => [wz * s, xz * s, yz * s, half * s],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use eigenbody::spatial::Vec3;

    #[test]
    fn a_quaternion_gives_its_rotation_back() {
        for q in [[0.5, 0.5, -0.5, 0.5], [0.1, 0.9, 0.3, -0.2], [0.0, 0.2, 0.9, 0.1], [-0.1, 0.1, 0.2, 0.9]] {
            let norm = q.iter().map(|x| x * x).sum::<f64>().sqrt();
            let E = Mat3::rotation_quaternion(q[0], Vec3::new(q[1], q[2], q[3]));
            let found = quaternion(&E);
            let cosine: f64 = found.iter().zip(q).map(|(a, b)| a * b / norm).sum();
            // the same up to sign, 10 ε
            assert!((cosine.abs() - 1.0).abs() < 10.0 * f64::EPSILON, "{found:?} {q:?}");
        }
    }
}

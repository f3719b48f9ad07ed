//! How links look: primitives from the text, and meshes of the file that the server was started with.

use crate::robot::Robot;
use eigenbody::spatial::Transform;
use eigenbody_formats::{Form, Mesh, Shape, read_look};
use eigenbody_study::explore::pose;
use serde::Serialize;
use std::collections::HashMap;
use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError};

/// Most files of a run.
const FILES: usize = 500;
/// Triangles above which a mesh is thinned, and cells along its longest side that it is thinned to.
const FINE: usize = 6000;
const CELLS: f64 = 40.0;

/// A shape of a body, for drawing.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ShapeView {
    kind: &'static str,
    size: Vec<f32>,
    pose: [f32; 7],
    #[serde(skip_serializing_if = "Option::is_none")]
    mesh: Option<usize>,
}

#[derive(Serialize)]
struct MeshView {
    positions: Vec<f32>,
    indices: Vec<u32>,
}

/// Meshes that were read in this run, each once, thinned, as JSON; none for a file that gives no mesh.
#[derive(Default)]
pub struct Meshes(Mutex<Vec<Read>>);

/// A file's name and its mesh.
type Read = (String, Option<Arc<[u8]>>);

impl Meshes {
    /// A mesh by its number.
    pub fn get(&self, k: usize) -> Option<Arc<[u8]>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).get(k)?.1.clone()
    }

    /// The number of a file's mesh, if it gives one.
    fn number(&self, robot: &Path, file: &str) -> Option<usize> {
        let mut meshes = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let known = meshes.iter().position(|mesh| mesh.0 == file);
        let k = match known {
            Some(k) => k,
            None if meshes.len() >= FILES => return None,
            None => {
                let text =
                    read_look(robot, file).ok().and_then(|mesh| serde_json::to_vec(&thinned(&mesh)).ok());
                meshes.push((file.to_owned(), text.map(Arc::from)));
                meshes.len() - 1
            }
        };
        meshes[k].1.as_ref().map(|_| k)
    }
}

/// Shapes of every body in its link's frame, and of what does not move in the world's. `file` is the robot's own, where it has one that
/// may be read from.
pub fn shapes(robot: &Robot, meshes: &Meshes, file: Option<&Path>) -> (Vec<Vec<ShapeView>>, Vec<ShapeView>) {
    let model = robot.model();
    let links: HashMap<&str, usize> =
        model.links().iter().enumerate().map(|(k, link)| (link.name(), k)).collect();
    let (mut moving, mut still) = (vec![Vec::new(); model.bodies().len()], Vec::new());
    for look in &robot.loaded.looks {
        let Some(link) = links.get(look.link.as_str()).map(|&k| &model.links()[k]) else { continue };
        let own = link.body().map(|i| model.links()[model.bodies()[i].link()].link_from_body().inverse());
        let frame = look.pose * link.link_from_body() * own.unwrap_or(Transform::IDENTITY);
        let (kind, size, mesh) = match &look.form {
            Form::Primitive(shape) => {
                let (kind, size) = primitive(*shape);
                (kind, size, None)
            }
            Form::Mesh { file: name, scale } => match file.and_then(|file| meshes.number(file, name)) {
                Some(k) => ("mesh", scale.to_vec(), Some(k)),
                None => continue,
            },
        };
        let size = size.into_iter().map(|x| x as f32).collect();
        let view = ShapeView { kind, size, pose: pose(&frame).map(|x| x as f32), mesh };
        match link.body() {
            Some(i) => moving[i].push(view),
            None => still.push(view),
        }
    }
    (moving, still)
}

fn primitive(shape: Shape) -> (&'static str, Vec<f64>) {
    match shape {
        Shape::Sphere(size) => ("sphere", size.to_vec()),
        Shape::Capsule(size) => ("capsule", size.to_vec()),
        Shape::Cylinder(size) => ("cylinder", size.to_vec()),
        Shape::Ellipsoid(size) => ("ellipsoid", size.to_vec()),
        Shape::Box(size) => ("box", size.to_vec()),
        Shape::Plane => ("plane", Vec::new()),
    }
}

/// A mesh with its corners merged: equal ones, and of a fine mesh those that share a cell of a grid, at their mean.
fn thinned(mesh: &Mesh) -> MeshView {
    let bound = |pick: fn(f64, f64) -> f64, start: f64| {
        [0, 1, 2].map(|k| mesh.vertices.iter().map(|p| p[k]).fold(start, pick))
    };
    let (low, high) = (bound(f64::min, f64::INFINITY), bound(f64::max, f64::NEG_INFINITY));
    let longest = (0..3).map(|k| high[k] - low[k]).fold(0.0, f64::max);
    let is_fine = mesh.faces.len() > FINE && longest > 0.0;
    let cell = |p: &[f64; 3]| -> [u64; 3] {
        match is_fine {
            true => [0, 1, 2].map(|k| ((p[k] - low[k]) / longest * CELLS) as u64),
            false => p.map(f64::to_bits),
        }
    };
    let mut corners: HashMap<[u64; 3], u32> = HashMap::new();
    let mut sums: Vec<([f64; 3], f64)> = Vec::new();
    let place: Vec<u32> = mesh
        .vertices
        .iter()
        .map(|p| {
            let k = *corners.entry(cell(p)).or_insert_with(|| {
                sums.push(([0.0; 3], 0.0));
                sums.len() as u32 - 1
            });
            let (sum, count) = &mut sums[k as usize];
            sum.iter_mut().zip(p).for_each(|(sum, p)| *sum += p);
            *count += 1.0;
            k
        })
        .collect();
    let corners = mesh.faces.iter().map(|face| face.map(|v| place[v as usize]));
    let faces = corners.filter(|[a, b, c]| a != b && b != c && c != a);
    MeshView {
        indices: faces.flatten().collect(),
        positions: sums.iter().flat_map(|(sum, count)| sum.map(|x| (x / count) as f32)).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A ball of many triangles keeps its size and its closed surface with a few per cent of them.
    #[test]
    fn a_fine_mesh_is_thinned() {
        let (rings, sides) = (100u32, 200u32);
        let mut ball = Mesh::default();
        for i in 0..=rings {
            for j in 0..sides {
                let (s, c) = (std::f64::consts::PI * f64::from(i) / f64::from(rings)).sin_cos();
                let (t, u) = (std::f64::consts::TAU * f64::from(j) / f64::from(sides)).sin_cos();
                ball.vertices.push([s * u, s * t, c]);
            }
        }
        for i in 0..rings {
            for j in 0..sides {
                let at = |i: u32, j: u32| i * sides + j % sides;
                ball.faces.push([at(i, j), at(i + 1, j), at(i, j + 1)]);
                ball.faces.push([at(i, j + 1), at(i + 1, j), at(i + 1, j + 1)]);
            }
        }
        let thin = thinned(&ball);
        let triangles = thin.indices.len() / 3;
        assert!((2000..12_000).contains(&triangles) && triangles * 3 < ball.faces.len(), "{triangles}");
        let point = |v: u32| [0, 1, 2].map(|k| f64::from(thin.positions[3 * v as usize + k]));
        let volume: f64 = thin
            .indices
            .chunks(3)
            .map(|face| {
                let [a, b, c] = [point(face[0]), point(face[1]), point(face[2])];
                let cross = [b[1] * c[2] - b[2] * c[1], b[2] * c[0] - b[0] * c[2], b[0] * c[1] - b[1] * c[0]];
                (a[0] * cross[0] + a[1] * cross[1] + a[2] * cross[2]) / 6.0
            })
            .sum();
        // A cell is a twentieth of the radius: the surface moves by its square.
        let ball = 4.0 / 3.0 * std::f64::consts::PI;
        assert!((volume.abs() / ball - 1.0).abs() < 0.02, "{volume}");
    }
}

//! OBJ: `v` and `f` lines of the first group that has faces. Polygons are cut into triangles.

use super::polygon::triangles;
use super::{Mesh, MeshFault};

pub(super) fn read(file: &str, bytes: &[u8]) -> Result<Mesh, MeshFault> {
    let text = String::from_utf8_lossy(bytes);
    let mut mesh = Mesh::default();
    let mut polygons: Vec<Vec<u32>> = Vec::new();
    let mut first_group_is_over = false;
    for (k, line) in text.lines().enumerate() {
        let fault = |problem| MeshFault::Obj { file: file.to_owned(), line: k + 1, problem };
        let mut words = line.split_whitespace();
        match words.next() {
            Some("v") => {
                // Coordinates are f32 in the reference; a missing one is 0 there.
                let mut vertex = [0.0; 3];
                for (slot, word) in vertex.iter_mut().zip(words) {
                    let number: f32 = word.parse().map_err(|_| fault("a vertex holds no number"))?;
                    *slot = f64::from(number);
                }
                mesh.vertices.push(vertex);
            }
            Some("f") if !first_group_is_over => {
                let corners = words.map(|word| corner(word, mesh.vertices.len()));
                let polygon: Vec<u32> =
                    corners.collect::<Option<_>>().ok_or_else(|| fault("a face names no vertex"))?;
                polygons.push(polygon);
            }
            // The reference passes over a group line without the blank before its name.
            Some("g" | "o") if !polygons.is_empty() => {
                first_group_is_over |= line.trim_start()[1..].starts_with([' ', '\t']);
            }
            _ => {}
        }
    }
    for polygon in polygons {
        if let Some(&vertex) = polygon.iter().find(|&&v| v as usize >= mesh.vertices.len()) {
            let (face, count) = (mesh.faces.len(), mesh.vertices.len());
            return Err(MeshFault::NoVertex { face, vertex: i64::from(vertex), count });
        }
        triangles(&mesh.vertices, &polygon, &mut mesh.faces);
    }
    Ok(mesh)
}

/// The vertex of `7`, `7/2`, `7//3` or `7/2/3`, from 1; negative ones count from the last.
fn corner(word: &str, count: usize) -> Option<u32> {
    let index: i64 = word.split('/').next()?.parse().ok()?;
    let index = if index < 0 { count as i64 + index } else { index - 1 };
    u32::try_from(index).ok()
}

//! STL, binary: an 80-byte heading, the number of triangles, 50 bytes a triangle.

use super::{Mesh, MeshFault};

pub(super) fn read(file: &str, bytes: &[u8]) -> Result<Mesh, MeshFault> {
    let size = |expected: String| MeshFault::Size { file: file.to_owned(), found: bytes.len(), expected };
    let (Some(count), Some(body)) = (bytes.get(80..84), bytes.get(84..)) else {
        return Err(match bytes.starts_with(b"solid") {
            true => MeshFault::TextStl { file: file.to_owned() },
            false => size("at least 84".to_owned()),
        });
    };
    let count = u32::from_le_bytes([count[0], count[1], count[2], count[3]]) as usize;
    if count.checked_mul(50) != Some(body.len()) {
        return Err(match bytes.starts_with(b"solid") {
            true => MeshFault::TextStl { file: file.to_owned() },
            false => size(format!("{} for {count} triangles", count.saturating_mul(50).saturating_add(84))),
        });
    }
    let mut mesh = Mesh::default();
    for triangle in body.chunks_exact(50) {
        let first = mesh.vertices.len() as u32;
        // A normal first, which the vertices tell anyway.
        mesh.vertices.extend(triangle[12..48].chunks_exact(12).map(vertex));
        mesh.faces.push([first, first + 1, first + 2]);
    }
    Ok(mesh)
}

/// Three little-endian f32.
pub(super) fn vertex(bytes: &[u8]) -> [f64; 3] {
    let number =
        |k: usize| f64::from(f32::from_le_bytes([bytes[k], bytes[k + 1], bytes[k + 2], bytes[k + 3]]));
    [number(0), number(4), number(8)]
}

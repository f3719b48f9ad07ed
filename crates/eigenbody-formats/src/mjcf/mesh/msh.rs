//! MSH, MuJoCo's own: counts of vertices, normals, texture coordinates and faces, then the arrays.

use super::stl::vertex;
use super::{Mesh, MeshFault};

pub(super) fn read(file: &str, bytes: &[u8]) -> Result<Mesh, MeshFault> {
    let size = |expected: String| MeshFault::Size { file: file.to_owned(), found: bytes.len(), expected };
    let Some(heading) = bytes.get(..16) else { return Err(size("at least 16".to_owned())) };
    let count =
        |k: usize| u32::from_le_bytes([heading[k], heading[k + 1], heading[k + 2], heading[k + 3]]) as usize;
    let (vertices, normals, texels, faces) = (count(0), count(4), count(8), count(12));
    let expected = 16 + 12 * vertices + 12 * normals + 8 * texels + 12 * faces;
    if bytes.len() != expected {
        let counts = format!("{vertices} vertices, {normals} normals, {texels} texels and {faces} faces");
        return Err(size(format!("{expected} for {counts}")));
    }
    let (v, f) = (16 + 12 * vertices, bytes.len() - 12 * faces);
    let index = |b: &[u8]| u32::from_le_bytes([b[0], b[1], b[2], b[3]]);
    Ok(Mesh {
        vertices: bytes[16..v].chunks_exact(12).map(vertex).collect(),
        faces: bytes[f..].chunks_exact(12).map(|b| [index(b), index(&b[4..]), index(&b[8..])]).collect(),
    })
}

//! Meshes: triangles from STL, OBJ and MSH files, and the mass that they enclose.

mod hull;
mod inertia;
mod msh;
mod obj;
mod polygon;
mod stl;

pub(super) use inertia::{Enclosed, Mode, enclosed};

use crate::error::counted;
use thiserror::Error;

/// Most triangles of one mesh.
const MAX_FACES: usize = 2_000_000;

/// Why a mesh gives no mass.
#[derive(Debug, Clone, PartialEq, Error)]
#[allow(missing_docs)] // the messages say it all
pub enum MeshFault {
    #[error("file '{file}': {fault}")]
    File { file: String, fault: crate::error::FileFault },
    #[error("file '{file}' is of no known kind, expected .stl, .obj or .msh")]
    Kind { file: String },
    #[error("file '{file}' is an STL file of text, expected a binary one")]
    TextStl { file: String },
    #[error("file '{file}' holds {}, expected {expected}", counted(*found, "byte", "bytes"))]
    Size { file: String, found: usize, expected: String },
    #[error("file '{file}': {problem}")]
    Malformed { file: String, problem: String },
    #[error("file '{file}', line {line}: {problem}")]
    Obj { file: String, line: usize, problem: &'static str },
    #[error("{}, expected at least 4", counted(*found, "vertex", "vertices"))]
    FewVertices { found: usize },
    #[error("face {face} names vertex {vertex} of {count}")]
    NoVertex { face: usize, vertex: i64, count: usize },
    #[error("a vertex is not finite")]
    NotFinite,
    #[error("all vertices lie in one plane")]
    Flat,
    #[error("more than {limit} faces or vertices")]
    TooLarge { limit: usize },
    #[error("its surface is too small")]
    NoSurface,
    #[error("its volume is too small; inertia=\"shell\" needs no volume")]
    NoVolume,
    #[error("its volume is negative: the triangles are turned inside out")]
    NegativeVolume,
    #[error("its faces around the edge from vertex {from} to vertex {to} are turned against each other")]
    Orientation { from: u32, to: u32 },
    #[error("its moments of inertia {0:?} belong to no body")]
    Moments([f64; 3]),
    #[error("inertia=\"convex\" with a limited maxhullvert depends on the order in which a hull is built")]
    LimitedHull,
}

/// Triangles.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Mesh {
    /// Corners (m).
    pub vertices: Vec<[f64; 3]>,
    /// Three corners each, anticlockwise from outside.
    pub faces: Vec<[u32; 3]>,
}

impl Mesh {
    /// A mesh file's contents; the name says of which kind. `mirrored` turns the triangles around, for a scale that mirrors.
    pub fn read(file: &str, bytes: &[u8], mirrored: bool) -> Result<Self, MeshFault> {
        let extension = file.rsplit('.').next().unwrap_or_default().to_ascii_lowercase();
        let mut mesh = match extension.as_str() {
            "stl" => stl::read(file, bytes)?,
            "obj" => obj::read(file, bytes)?,
            "msh" => msh::read(file, bytes)?,
            _ => return Err(MeshFault::Kind { file: file.to_owned() }),
        };
        if mirrored {
            mesh.faces.iter_mut().for_each(|face| face.swap(1, 2));
        }
        Ok(mesh)
    }

    /// Refuses what is no mesh.
    pub fn check(&self) -> Result<(), MeshFault> {
        if self.vertices.len() < 4 {
            return Err(MeshFault::FewVertices { found: self.vertices.len() });
        }
        if self.faces.len() > MAX_FACES {
            return Err(MeshFault::TooLarge { limit: MAX_FACES });
        }
        if !self.vertices.iter().flatten().all(|x| x.is_finite()) {
            return Err(MeshFault::NotFinite);
        }
        let count = self.vertices.len();
        for (k, face) in self.faces.iter().enumerate() {
            if let Some(&vertex) = face.iter().find(|&&v| v as usize >= count) {
                return Err(MeshFault::NoVertex { face: k, vertex: i64::from(vertex), count });
            }
        }
        Ok(())
    }

    /// The faces of its convex hull.
    pub fn hull(&self) -> Result<Vec<[u32; 3]>, MeshFault> {
        hull::hull(&self.vertices)
    }
}

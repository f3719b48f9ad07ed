//! The mass that a mesh encloses, as MuJoCo computes it.
//!
//! ```text
//! legacy: every triangle spans a pyramid with the surface's centroid, all volumes counted as positive
//! exact:  signed volumes          convex: of the convex hull          shell: the surface itself
//! ```
//! The result is an equivalent box: volume (or area), centre, principal axes and half-edges.

use super::super::principal::{Care, Principal, principal};
use super::{Mesh, MeshFault};
use eigenbody::spatial::{Mat3, Sym3, Vec3};

/// How a mesh encloses mass.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(in super::super) enum Mode {
    Convex,
    Legacy,
    Exact,
    Shell,
}

/// The equivalent box of a mesh.
#[derive(Debug, Clone, PartialEq)]
pub(in super::super) struct Enclosed {
    /// Volume (m³), or area (m²) of a shell.
    pub volume: f64,
    /// Centre of mass in the mesh's frame.
    pub com: Vec3<f64>,
    /// Rotation of coordinates from the mesh's frame to its principal axes.
    pub E: Mat3<f64>,
    /// Half-edges of the box with the same inertia.
    pub half: [f64; 3],
    /// The vertices seen from the box.
    pub vertices: Vec<Vec3<f64>>,
}

/// Smaller areas and volumes count as none.
const SMALLEST: f64 = 1e-15;

/// One triangle: its area, unit normal and centre.
struct Triangle {
    area: f64,
    normal: Vec3<f64>,
    center: Vec3<f64>,
}

/// What a mesh encloses.
pub(in super::super) fn enclosed(mesh: &Mesh, mode: Mode) -> Result<Enclosed, MeshFault> {
    mesh.check()?;
    let hull = match mesh.faces.is_empty() || mode == Mode::Convex {
        true => mesh.hull()?,
        false => Vec::new(),
    };
    let own = if mesh.faces.is_empty() { &hull } else { &mesh.faces };
    let faces = if mode == Mode::Convex { &hull } else { own };
    let v: Vec<Vec3<f64>> = mesh.vertices.iter().map(|&v| Vec3::from_f64(v)).collect();
    if mode == Mode::Exact {
        check_orientation(&v, own)?;
    }
    let middle = centroid(&v, own)?;
    let com = center_of_mass(&v, faces, mode, middle)?;
    let (volume, second) = moments(&v, faces, mode, com);
    let Principal { moments: [a, b, c], E } = principal(second, Care::Mesh);
    let impossible = |x: f64, y: f64, z: f64| x + y < z * (1.0 - 1e-6) - 1e-9;
    if c <= 0.0 || impossible(a, b, c) || impossible(a, c, b) || impossible(b, c, a) {
        return Err(MeshFault::Moments([a, b, c]));
    }
    let half = [b + c - a, a + c - b, a + b - c].map(|m| 0.5 * (6.0 * m / volume).sqrt());
    if !half.iter().all(|h| h.is_finite()) {
        return Err(MeshFault::Moments([a, b, c]));
    }
    let vertices = v.iter().map(|&p| E * (p - com)).collect();
    Ok(Enclosed { volume, com, E, half, vertices })
}

fn triangle(v: &[Vec3<f64>], face: [u32; 3]) -> Triangle {
    let [a, b, c] = face.map(|i| v[i as usize]);
    let normal = (b - a).cross(c - a);
    let length = normal.norm();
    let center = (a + b + c) * (1.0 / 3.0);
    match length < SMALLEST {
        true => Triangle { area: 0.0, normal, center },
        false => Triangle { area: 0.5 * length, normal: normal * (1.0 / length), center },
    }
}

/// The surface's centroid.
fn centroid(v: &[Vec3<f64>], faces: &[[u32; 3]]) -> Result<Vec3<f64>, MeshFault> {
    let (mut total, mut sum) = (0.0, Vec3::ZERO);
    for &face in faces {
        let t = triangle(v, face);
        total += t.area;
        sum += t.center * t.area;
    }
    if total < SMALLEST { Err(MeshFault::NoSurface) } else { Ok(sum * (1.0 / total)) }
}

fn center_of_mass(
    v: &[Vec3<f64>],
    faces: &[[u32; 3]],
    mode: Mode,
    middle: Vec3<f64>,
) -> Result<Vec3<f64>, MeshFault> {
    let (mut total, mut sum) = (0.0, Vec3::ZERO);
    for &face in faces {
        let t = triangle(v, face);
        let volume = (t.center - middle).dot(t.normal) * t.area / 3.0;
        let weight = match mode {
            Mode::Shell => t.area,
            Mode::Legacy => volume.abs(),
            Mode::Exact | Mode::Convex => volume,
        };
        total += weight;
        // A pyramid's centre; MuJoCo takes the same point for a shell's triangle, whose base it would be.
        sum += (t.center * 0.75 + middle * 0.25) * weight;
    }
    match total {
        _ if total >= SMALLEST => Ok(sum * (1.0 / total)),
        _ if mode == Mode::Shell => Err(MeshFault::NoSurface),
        _ if total < 0.0 => Err(MeshFault::NegativeVolume),
        _ => Err(MeshFault::NoVolume),
    }
}

/// Volume and moments of inertia about a point, for unit density.
fn moments(v: &[Vec3<f64>], faces: &[[u32; 3]], mode: Mode, com: Vec3<f64>) -> (f64, Sym3<f64>) {
    let centred: Vec<Vec3<f64>> = v.iter().map(|&p| p - com).collect();
    let mut total = 0.0;
    let mut P = Sym3::ZERO;
    for &face in faces {
        let t = triangle(&centred, face);
        let volume = match mode {
            Mode::Shell => t.area,
            Mode::Legacy => (t.center.dot(t.normal) * t.area / 3.0).abs(),
            Mode::Exact | Mode::Convex => t.center.dot(t.normal) * t.area / 3.0,
        };
        total += volume;
        let [a, b, c] = face.map(|i| centred[i as usize]);
        let s = a + b + c;
        // ∫ x xᵀ over the pyramid to the origin, or over the triangle: (Σ vᵢvᵢᵀ + s sᵀ) times this.
        let weight = volume / if mode == Mode::Shell { 12.0 } else { 20.0 };
        for p in [a, b, c, s] {
            P = P.plus_outer(p * weight, p);
        }
    }
    let I = Sym3 { xx: P.yy + P.zz, yy: P.xx + P.zz, zz: P.xx + P.yy, xy: -P.xy, xz: -P.xz, yz: -P.yz };
    (total, I)
}

/// Refuses two triangles that run through an edge in the same direction.
fn check_orientation(v: &[Vec3<f64>], faces: &[[u32; 3]]) -> Result<(), MeshFault> {
    // Coinciding vertices count as one, as after reading an STL file.
    let mut ids = std::collections::HashMap::new();
    let key = |p: Vec3<f64>| p.to_array().map(|x| (x + 0.0).to_bits());
    let id: Vec<u32> = (0u32..).zip(v).map(|(i, &p)| *ids.entry(key(p)).or_insert(i)).collect();
    let mut edges = std::collections::HashSet::new();
    for &face in faces {
        if triangle(v, face).area <= SMALLEST.sqrt() {
            continue;
        }
        let [a, b, c] = face.map(|i| id[i as usize]);
        for (from, to) in [(a, b), (b, c), (c, a)] {
            if !edges.insert((from, to)) {
                return Err(MeshFault::Orientation { from, to });
            }
        }
    }
    Ok(())
}

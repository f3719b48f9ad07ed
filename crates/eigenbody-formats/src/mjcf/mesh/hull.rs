//! Convex hulls, by Quickhull.
//!
//! ```text
//! start with a tetrahedron; each face keeps the points that see it
//! while a face has points: take the farthest; remove every face it sees; join it to the horizon's edges
//! ```
//! Reference: Barber, Dobkin, Huhdanpaa (1996). Cost O(n log n) as a rule.

use super::MeshFault;
use eigenbody::spatial::Vec3;
use std::collections::HashMap;

/// Most points of a hull.
const MAX_POINTS: usize = 1_000_000;

struct Face {
    corners: [u32; 3],
    normal: Vec3<f64>,
    offset: f64,
    /// Points above the face.
    above: Vec<u32>,
    alive: bool,
}

/// Triangles of the convex hull, normals outwards.
pub(super) fn hull(points: &[[f64; 3]]) -> Result<Vec<[u32; 3]>, MeshFault> {
    if points.len() > MAX_POINTS {
        return Err(MeshFault::TooLarge { limit: MAX_POINTS });
    }
    let p: Vec<Vec3<f64>> = points.iter().map(|&v| Vec3::from_f64(v)).collect();
    let size = p.iter().map(|v| v.x.abs().max(v.y.abs()).max(v.z.abs())).fold(0.0, f64::max);
    // A point this little above a face is in it.
    let thickness = 1e-13 * size;
    let corners = tetrahedron(&p, thickness).ok_or(MeshFault::Flat)?;
    let mut hull = Hull { p: &p, faces: Vec::new(), edges: HashMap::new(), thickness };
    let [a, b, c, d] = corners;
    for face in [[a, b, c], [a, d, b], [b, d, c], [c, d, a]] {
        hull.add(face);
    }
    let all: Vec<u32> = (0..p.len() as u32).filter(|i| !corners.contains(i)).collect();
    hull.share_out(all, 0);
    let mut next = 0;
    while next < hull.faces.len() {
        match hull.farthest(next) {
            Some(point) => hull.extend(next, point),
            None => next += 1,
        }
    }
    Ok(hull.faces.iter().filter(|f| f.alive).map(|f| f.corners).collect())
}

/// Four points far from a common plane, positively oriented.
fn tetrahedron(p: &[Vec3<f64>], thickness: f64) -> Option<[u32; 4]> {
    let farthest = |distance: &dyn Fn(Vec3<f64>) -> f64| {
        let best = (0..p.len()).max_by(|&i, &j| distance(p[i]).total_cmp(&distance(p[j])))?;
        (distance(p[best]) > thickness).then_some(best)
    };
    let a = (0..p.len()).min_by(|&i, &j| p[i].x.total_cmp(&p[j].x))?;
    let b = farthest(&|q| (q - p[a]).norm())?;
    let line = (p[b] - p[a]) * (1.0 / (p[b] - p[a]).norm());
    let c = farthest(&|q| (q - p[a]).cross(line).norm())?;
    let normal = line.cross(p[c] - p[a]);
    let normal = normal * (1.0 / normal.norm());
    let d = farthest(&|q| (q - p[a]).dot(normal).abs())?;
    let [a, b, c, d] = [a, b, c, d].map(|i| i as u32);
    // The fourth point below the face a, b, c.
    match (p[d as usize] - p[a as usize]).dot(normal) < 0.0 {
        true => Some([a, b, c, d]),
        false => Some([a, c, b, d]),
    }
}

struct Hull<'a> {
    p: &'a [Vec3<f64>],
    faces: Vec<Face>,
    /// The face to the left of each directed edge.
    edges: HashMap<(u32, u32), usize>,
    thickness: f64,
}

impl Hull<'_> {
    fn add(&mut self, corners: [u32; 3]) {
        let [a, b, c] = corners.map(|i| self.p[i as usize]);
        let normal = (b - a).cross(c - a);
        let length = normal.norm();
        let normal = if length > 0.0 { normal * (1.0 / length) } else { Vec3::ZERO };
        let id = self.faces.len();
        let [i, j, k] = corners;
        for edge in [(i, j), (j, k), (k, i)] {
            self.edges.insert(edge, id);
        }
        self.faces.push(Face { corners, normal, offset: normal.dot(a), above: Vec::new(), alive: true });
    }

    fn height(&self, face: usize, point: u32) -> f64 {
        let face = &self.faces[face];
        face.normal.dot(self.p[point as usize]) - face.offset
    }

    /// Gives each point to the first face, from `first` on, that it sees; a point that sees none is inside.
    fn share_out(&mut self, points: Vec<u32>, first: usize) {
        for point in points {
            let seen = (first..self.faces.len()).find(|&f| self.height(f, point) > self.thickness);
            if let Some(face) = seen {
                self.faces[face].above.push(point);
            }
        }
    }

    fn farthest(&self, face: usize) -> Option<u32> {
        if !self.faces[face].alive {
            return None;
        }
        let above = self.faces[face].above.iter().copied();
        above.max_by(|&i, &j| self.height(face, i).total_cmp(&self.height(face, j)))
    }

    /// Replaces every face that a point sees by faces to the point.
    fn extend(&mut self, face: usize, point: u32) {
        let (mut visible, mut horizon, mut stack) = (Vec::new(), Vec::new(), vec![face]);
        self.faces[face].alive = false;
        while let Some(f) = stack.pop() {
            visible.push(f);
            let [i, j, k] = self.faces[f].corners;
            for (from, to) in [(i, j), (j, k), (k, i)] {
                let Some(&other) = self.edges.get(&(to, from)) else { continue };
                if !self.faces[other].alive {
                    continue;
                }
                if self.height(other, point) > self.thickness {
                    self.faces[other].alive = false;
                    stack.push(other);
                } else {
                    horizon.push((from, to));
                }
            }
        }
        // A face may have been found on the horizon before another one made it visible.
        horizon.retain(|&(from, to)| self.edges.get(&(to, from)).is_some_and(|&f| self.faces[f].alive));
        let mut orphans = Vec::new();
        for &f in &visible {
            orphans.append(&mut self.faces[f].above);
        }
        orphans.retain(|&p| p != point);
        let first = self.faces.len();
        for (from, to) in horizon {
            self.add([from, to, point]);
        }
        self.share_out(orphans, first);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hull_of_a_grid_is_its_box() {
        let grid: Vec<[f64; 3]> =
            (0..1000).map(|i| [i % 10, (i / 10) % 10, i / 100].map(f64::from)).collect();
        let faces = hull(&grid).unwrap_or_default();
        let volume: f64 = faces
            .iter()
            .map(|f| {
                let [a, b, c]: [Vec3<f64>; 3] = f.map(|i| Vec3::from_f64(grid[i as usize]));
                a.dot(b.cross(c)) / 6.0
            })
            .sum();
        // 100 ε of the volume
        assert!((volume - 729.0).abs() < 100.0 * f64::EPSILON * 729.0, "{volume}");
    }

    #[test]
    fn points_in_a_plane_have_none() {
        let square = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]];
        assert_eq!(hull(&square), Err(MeshFault::Flat));
    }
}

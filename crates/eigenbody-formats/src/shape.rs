//! Primitive shapes: volume and inertia, solid or as a shell.
//!
//! Sizes are half-lengths. Inertia is about the centre, per unit of the whole mass, on the shape's own axes.

use std::f64::consts::PI;

/// A primitive.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Shape {
    /// Radius.
    Sphere([f64; 1]),
    /// Radius, half-length of the straight part along z.
    Capsule([f64; 2]),
    /// Radius, half-length along z.
    Cylinder([f64; 2]),
    /// Half-axes.
    Ellipsoid([f64; 3]),
    /// Half-edges; height fields count as their boxes.
    Box([f64; 3]),
    /// A plane has neither volume nor mass.
    Plane,
}

impl Shape {
    /// Volume (m³), or area (m²) of a shell.
    pub fn volume(self, shell: bool) -> f64 {
        match (self, shell) {
            (Self::Sphere([r]), false) => 4.0 * PI * r.powi(3) / 3.0,
            (Self::Sphere([r]), true) => 4.0 * PI * r * r,
            (Self::Capsule([r, l]), false) => PI * (r * r * 2.0 * l + 4.0 * r.powi(3) / 3.0),
            (Self::Capsule([r, l]), true) => 4.0 * PI * r * r + 4.0 * PI * r * l,
            (Self::Cylinder([r, l]), false) => PI * r * r * 2.0 * l,
            (Self::Cylinder([r, l]), true) => 2.0 * PI * r * r + 4.0 * PI * r * l,
            (Self::Ellipsoid([a, b, c]), false) => 4.0 * PI * a * b * c / 3.0,
            // Thomsen's approximation, as MuJoCo takes it.
            (Self::Ellipsoid([a, b, c]), true) => {
                let p = 1.6075;
                let sum = (a * b).powf(p) + (b * c).powf(p) + (c * a).powf(p);
                4.0 * PI * (sum / 3.0).powf(1.0 / p)
            }
            (Self::Box([a, b, c]), false) => 8.0 * a * b * c,
            (Self::Box([a, b, c]), true) => 8.0 * (a * b + b * c + c * a),
            (Self::Plane, _) => 0.0,
        }
    }

    /// Moments of inertia per unit of mass (m²).
    pub fn unit_inertia(self, shell: bool) -> [f64; 3] {
        match (self, shell) {
            (Self::Sphere([r]), false) => [0.4 * r * r; 3],
            (Self::Sphere([r]), true) => [2.0 / 3.0 * r * r; 3],
            (Self::Capsule([r, l]), false) => capsule(r, l),
            (Self::Capsule([r, l]), true) => capsule_shell(r, l),
            (Self::Cylinder([r, l]), false) => {
                let across = (3.0 * r * r + 4.0 * l * l) / 12.0;
                [across, across, r * r / 2.0]
            }
            (Self::Cylinder([r, l]), true) => cylinder_shell(r, l),
            (Self::Ellipsoid([a, b, c]), false) => about(a * a / 5.0, b * b / 5.0, c * c / 5.0),
            (Self::Ellipsoid(axes), true) => ellipsoid_shell(axes),
            (Self::Box([a, b, c]), false) => about(a * a / 3.0, b * b / 3.0, c * c / 3.0),
            (Self::Box(edges), true) => box_shell(edges),
            (Self::Plane, _) => [0.0; 3],
        }
    }
}

/// Moments about three axes from mean squares along them.
fn about(xx: f64, yy: f64, zz: f64) -> [f64; 3] {
    [yy + zz, xx + zz, xx + yy]
}

/// A cylinder and two half balls, by their shares of the volume.
fn capsule(r: f64, l: f64) -> [f64; 3] {
    let h = 2.0 * l;
    let balls = 4.0 * r / (4.0 * r + 3.0 * h);
    let middle = 1.0 - balls;
    let ball = 0.4 * r * r;
    let across = middle * (3.0 * r * r + h * h) / 12.0 + balls * (ball + h * (3.0 * r + 2.0 * h) / 8.0);
    [across, across, middle * r * r / 2.0 + balls * ball]
}

/// A tube and two half spheres, by their shares of the area.
fn capsule_shell(r: f64, l: f64) -> [f64; 3] {
    let h = 2.0 * l;
    let (sphere, tube) = (4.0 * PI * r * r, 2.0 * PI * r * h);
    let caps = sphere / (sphere + tube);
    let middle = 1.0 - caps;
    let cap = 2.0 / 3.0 * r * r;
    // A half sphere's centre of mass stands r/2 above its rim.
    let (com, at) = (r / 2.0, l + r / 2.0);
    let across = middle * (6.0 * r * r + h * h) / 12.0 + caps * (cap + at * at - com * com);
    [across, across, middle * r * r + caps * cap]
}

/// A tube and two discs.
fn cylinder_shell(r: f64, l: f64) -> [f64; 3] {
    let h = 2.0 * l;
    let (disc, tube) = (PI * r * r, 2.0 * PI * r * h);
    let lid = disc / (2.0 * disc + tube);
    let middle = 1.0 - 2.0 * lid;
    let across = middle * (6.0 * r * r + h * h) / 12.0 + 2.0 * lid * (r * r / 4.0 + l * l);
    [across, across, middle * r * r + lid * r * r]
}

/// MuJoCo's shell: what an ellipsoid gains when its half-axes grow by a micrometre.
fn ellipsoid_shell([a, b, c]: [f64; 3]) -> [f64; 3] {
    let grown = [a + 1e-6, b + 1e-6, c + 1e-6];
    let moments = |[a, b, c]: [f64; 3], mass: f64| {
        [mass * (b * b + c * c) / 5.0, mass * (a * a + c * c) / 5.0, mass * (a * a + b * b) / 5.0]
    };
    let inner = Shape::Ellipsoid([a, b, c]).volume(false);
    let outer = Shape::Ellipsoid(grown).volume(false);
    let density = 1.0 / (outer - inner);
    let (small, large) = (moments([a, b, c], inner * density), moments(grown, outer * density));
    [large[0] - small[0], large[1] - small[1], large[2] - small[2]]
}

/// Six rectangles.
fn box_shell([a, b, c]: [f64; 3]) -> [f64; 3] {
    let area = 2.0 * (a * b + b * c + c * a);
    // Mean squares along x: the two sides at ±a, and the four sides that span it.
    let mean = |along: f64, u: f64, v: f64| {
        let end = 2.0 * u * v / area;
        along * along * (end + (1.0 - end) / 3.0)
    };
    about(mean(a, b, c), mean(b, c, a), mean(c, a, b))
}

//! Where a robot may be.
//!
//! ```text
//! limits l, u           q = (l + u)/2 + (u − l)/2 · sin t      every t is allowed, and a bound is an ordinary point of t
//! angle without limits  q = t, one turn
//! ball joint            any rotation, moved along the body's own axes
//! free joint            any rotation, within a reach; on the world it stays where it is: H does not depend on its pose
//! ```

use crate::joint::Joint;
use crate::model::Model;
use std::f64::consts::{PI, TAU};

/// Metres to each side of zero in which a translation without limits is searched.
const REACH: f64 = 1.0;
/// A free joint at rest.
const NEUTRAL: [f64; 7] = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0];

/// All configurations that the limits allow, as images of the unit cube.
#[derive(Debug, Clone)]
pub struct Domain<'m> {
    model: &'m Model<f64>,
    parts: Vec<Part>,
    follows: bool,
}

/// A joint's coordinates among the independent ones.
#[derive(Debug, Clone)]
struct Part {
    kind: Kind,
    /// Its first coordinate and its first degree of freedom.
    q0: usize,
    v0: usize,
}

#[derive(Debug, Clone, Copy)]
enum Kind {
    /// One coordinate between bounds.
    Between(f64, f64),
    /// One angle without bounds.
    Turn,
    /// A unit quaternion.
    Ball,
    /// Position and unit quaternion.
    Free,
    /// The same, where it makes no difference.
    Held,
}

impl<'m> Domain<'m> {
    /// The domain of a model; `follows`: mimic joints follow.
    pub fn new(model: &'m Model<f64>, follows: bool) -> Self {
        let coupling = model.coupling().filter(|_| follows);
        let leads =
            |q0: usize| coupling.is_none_or(|c| c.independent_coordinates().binary_search(&q0).is_ok());
        let (mut q0, mut v0) = (0, 0);
        let mut parts = Vec::new();
        let roots: Vec<usize> =
            model.bodies().iter().filter(|b| b.parent().is_none()).map(|b| b.coordinates().start).collect();
        for joint in model.joints().iter().filter(|joint| leads(joint.coordinates().start)) {
            let on_world = roots.contains(&joint.coordinates().start);
            for kind in kinds(joint.kind(), joint.limits(), on_world) {
                parts.push(Part { kind, q0, v0 });
                (q0, v0) = (q0 + kind.nq(), v0 + kind.nv());
            }
        }
        Self { model, parts, follows: coupling.is_some() }
    }

    /// The model.
    pub fn model(&self) -> &'m Model<f64> {
        self.model
    }

    /// Number of coordinates of the unit cube.
    pub fn dimensions(&self) -> usize {
        self.parts.iter().map(|part| part.kind.dimensions()).sum()
    }

    /// Number of independent degrees of freedom.
    pub fn nv(&self) -> usize {
        self.parts.last().map_or(0, |part| part.v0 + part.kind.nv())
    }

    /// The point of the domain for a point of the unit cube; uniform if that is.
    ///
    /// # Panics
    ///
    /// If `u` has fewer than [`dimensions`](Self::dimensions) numbers.
    pub fn point(&self, u: &[f64]) -> Point {
        let mut u = u.iter();
        let mut next = || u.next().copied().unwrap_or(0.5);
        let mut point = Point { p: Vec::new(), t: Vec::new() };
        for part in &self.parts {
            match part.kind {
                Kind::Between(lower, upper) => {
                    point.push_between(lower, upper, lower + (upper - lower) * next());
                }
                Kind::Turn => point.push(TAU * next() - PI),
                Kind::Ball => {
                    let [a, b, c] = [next(), next(), next()];
                    point.p.extend(rotation(a, b, c));
                    point.t.extend([0.0; 3]);
                }
                Kind::Free => {
                    let [x, y, z, a, b, c] = [(); 6].map(|()| next());
                    point.p.extend([x, y, z].map(|x| REACH * (2.0 * x - 1.0)));
                    point.p.extend(rotation(a, b, c));
                    point.t.extend([0.0; 6]);
                }
                Kind::Held => point.hold(&NEUTRAL),
            }
        }
        point
    }

    /// The point nearest to a configuration `q` of all coordinates.
    pub fn nearest(&self, q: &[f64]) -> Point {
        let independent: Vec<f64> = match self.model.coupling().filter(|_| self.follows) {
            Some(coupling) => coupling.independent_coordinates().iter().map(|&k| q[k]).collect(),
            None => q.to_vec(),
        };
        let mut point = Point { p: Vec::new(), t: Vec::new() };
        for &Part { kind, q0, .. } in &self.parts {
            match kind {
                Kind::Between(lower, upper) => {
                    point.push_between(lower, upper, independent[q0].clamp(lower, upper));
                }
                Kind::Turn => point.push(independent[q0]),
                Kind::Ball => {
                    point.p.extend(&independent[q0..q0 + 4]);
                    point.t.extend([0.0; 3]);
                }
                Kind::Free => point.hold(&independent[q0..q0 + 7]),
                Kind::Held => point.hold(&NEUTRAL),
            }
        }
        point
    }

    /// The point moved along `step`, one number a DoF.
    pub fn moved(&self, from: &Point, step: &[f64]) -> Point {
        let mut point = from.clone();
        for &Part { kind, q0, v0 } in &self.parts {
            match kind {
                Kind::Between(lower, upper) => {
                    point.t[v0] += step[v0];
                    point.p[q0] = between(lower, upper, point.t[v0]);
                }
                Kind::Turn => {
                    point.t[v0] += step[v0];
                    point.p[q0] = point.t[v0];
                }
                Kind::Ball => {
                    let (q, v) = (&from.p[q0..q0 + 4], &step[v0..v0 + 3]);
                    Joint::Spherical.integrate(q, v, &mut point.p[q0..q0 + 4]);
                }
                Kind::Free => {
                    let (q, v) = (&from.p[q0..q0 + 7], &step[v0..v0 + 6]);
                    Joint::Floating.integrate(q, v, &mut point.p[q0..q0 + 7]);
                }
                Kind::Held => {}
            }
        }
        point
    }

    /// A gradient along the DoFs as one along `step` of [`moved`](Self::moved).
    pub fn pull_back(&self, at: &Point, gradient: &mut [f64]) {
        for &Part { kind, v0, .. } in &self.parts {
            match kind {
                Kind::Between(lower, upper) => gradient[v0] *= 0.5 * (upper - lower) * at.t[v0].cos(),
                // Turns only: its position would run away.
                Kind::Free => gradient[v0 + 3..v0 + 6].fill(0.0),
                Kind::Held => gradient[v0..v0 + 6].fill(0.0),
                Kind::Turn | Kind::Ball => {}
            }
        }
    }

    /// All coordinates of the model; angles without limits within one turn around zero.
    pub fn configuration(&self, point: &Point) -> Vec<f64> {
        let mut p = point.p.clone();
        for part in self.parts.iter().filter(|part| matches!(part.kind, Kind::Turn)) {
            p[part.q0] -= TAU * (p[part.q0] / TAU).round();
        }
        match self.model.coupling().filter(|_| self.follows) {
            Some(coupling) => coupling.expand(&p),
            None => p,
        }
    }
}

/// A point of a [`Domain`]: independent coordinates, and the parameters they come from.
#[derive(Debug, Clone, PartialEq)]
pub struct Point {
    p: Vec<f64>,
    t: Vec<f64>,
}

impl Point {
    fn push(&mut self, q: f64) {
        self.p.push(q);
        self.t.push(q);
    }

    fn push_between(&mut self, lower: f64, upper: f64, q: f64) {
        let half = 0.5 * (upper - lower);
        let sine = if half > 0.0 { ((q - (lower + half)) / half).clamp(-1.0, 1.0) } else { 0.0 };
        let t = sine.asin();
        self.t.push(t);
        self.p.push(between(lower, upper, t));
    }

    fn hold(&mut self, q: &[f64]) {
        self.p.extend(q);
        self.t.extend([0.0; 6]);
    }
}

fn between(lower: f64, upper: f64, t: f64) -> f64 {
    (lower + 0.5 * (upper - lower) * (1.0 + t.sin())).clamp(lower, upper)
}

/// A rotation uniform over all rotations for a uniform point of the cube (Shoemake 1992).
fn rotation(u: f64, v: f64, w: f64) -> [f64; 4] {
    let ((s1, c1), (s2, c2)) = ((TAU * v).sin_cos(), (TAU * w).sin_cos());
    let (a, b) = ((1.0 - u).sqrt(), u.sqrt());
    [b * c2, a * s1, a * c1, b * s2]
}

fn kinds(joint: &Joint<f64>, limits: Option<(f64, f64)>, on_world: bool) -> Vec<Kind> {
    match joint {
        Joint::Floating => vec![if on_world { Kind::Held } else { Kind::Free }],
        Joint::Spherical => vec![Kind::Ball],
        _ => {
            let finite = limits.filter(|(lower, upper)| lower.is_finite() && upper.is_finite());
            let kind = |&translation: &bool| match finite {
                Some((lower, upper)) if translation || upper - lower < TAU => Kind::Between(lower, upper),
                _ if translation => Kind::Between(-REACH, REACH),
                _ => Kind::Turn,
            };
            joint.translations().iter().map(kind).collect()
        }
    }
}

impl Kind {
    fn nq(self) -> usize {
        match self {
            Self::Between(..) | Self::Turn => 1,
            Self::Ball => 4,
            Self::Free | Self::Held => 7,
        }
    }
    fn nv(self) -> usize {
        match self {
            Self::Between(..) | Self::Turn => 1,
            Self::Ball => 3,
            Self::Free | Self::Held => 6,
        }
    }
    fn dimensions(self) -> usize {
        match self {
            Self::Held => 0,
            other => other.nv(),
        }
    }
}

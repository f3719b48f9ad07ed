//! A robot in a configuration, from two sides, with one of its modes.
//!
//! ```text
//! links       lines between joints, dashed to the centres of mass
//! the mode    where they are a little later, and arrows at the joints that take part: along the axis that a joint turns about
//!             (right-hand rule, two heads) or the direction it slides in (one head)
//! ```

use super::scene::{Anchor, Scene};
use super::style::{FAINT, INK, PAPER};
use eigenbody_study::portrait::{ModePlace, Portrait};

type Point = (f64, f64);
type Vec3 = [f64; 3];

/// One picture (px).
const CELL: f64 = 400.0;
const EDGE: f64 = 44.0;
/// Joints with arrows.
const SHOWN: usize = 6;
/// Least share of a joint with an arrow.
const LEAST: f64 = 0.02;
/// A part smaller than this against the whole is seen from near.
const NEAR: f64 = 0.3;
/// How far the farthest point of the robot moves, against the picture.
const STRIDE: f64 = 0.12;
/// Colour of the mode.
const MOVED: &str = "#0072b2";
const ARROW: &str = "#d55e00";

/// From where the robot is seen: unit vectors to the right, up, and towards the viewer.
struct View {
    name: &'static str,
    right: Vec3,
    up: Vec3,
    towards: Vec3,
}

fn dot(a: Vec3, b: Vec3) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: Vec3, b: Vec3) -> Vec3 {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn unit(a: Vec3) -> Vec3 {
    let size = dot(a, a).sqrt();
    a.map(|x| x / size)
}

fn add(a: Vec3, b: Vec3, scale: f64) -> Vec3 {
    [0, 1, 2].map(|i| a[i] + scale * b[i])
}

impl View {
    /// Looking from a direction, z upwards where it can be.
    fn from(name: &'static str, towards: Vec3) -> Self {
        let above = if towards[2].abs() > 0.95 { [0.0, 1.0, 0.0] } else { [0.0, 0.0, 1.0] };
        let right = unit(cross(above, towards));
        Self { name, right, up: cross(towards, right), towards }
    }

    fn flat(&self, p: Vec3) -> Point {
        (dot(p, self.right), dot(p, self.up))
    }
}

/// Points in space to pixels of one picture.
struct Paper<'v> {
    view: &'v View,
    middle: Point,
    centre: Point,
    scale: f64,
}

impl<'v> Paper<'v> {
    fn around(view: &'v View, points: &[Vec3], left: f64, top: f64) -> Self {
        let flat: Vec<Point> = points.iter().map(|&p| view.flat(p)).collect();
        let ends = |pick: fn(&Point) -> f64| {
            let all = flat.iter().map(pick);
            all.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)))
        };
        let (x, y) = (ends(|p| p.0), ends(|p| p.1));
        let extent = (x.1 - x.0).max(y.1 - y.0).max(1e-9);
        Self {
            view,
            middle: (left + 0.5 * CELL, top + 0.5 * CELL),
            centre: (0.5 * (x.0 + x.1), 0.5 * (y.0 + y.1)),
            scale: (CELL - 2.0 * EDGE) / extent,
        }
    }

    fn at(&self, p: Vec3) -> Point {
        let (x, y) = self.view.flat(p);
        (self.middle.0 + self.scale * (x - self.centre.0), self.middle.1 - self.scale * (y - self.centre.1))
    }
}

/// The drawing: two pictures side by side; with a mode, the joints that have arrows are listed below.
pub fn scene(portrait: &Portrait, mode: Option<&ModePlace>) -> Scene {
    let listed = mode.map_or_else(Vec::new, largest);
    let rows = listed.len().div_ceil(2);
    let mut scene = Scene::new(2.0 * CELL, CELL + 30.0 + 22.0 * rows as f64);
    let points: Vec<Vec3> =
        portrait.bodies.iter().flat_map(|b| [b.origin, b.centre]).chain([[0.0; 3]]).collect();
    let views = [
        View::from("from the front, left and above", unit([0.78, 0.55, 0.36])),
        View::from("from where it is widest", thinnest(&points)),
    ];
    // A mode of a small part is seen from near.
    let part = near(portrait, &listed).filter(|part| reach(part) < NEAR * reach(&points));
    for (k, view) in views.iter().enumerate() {
        let left = CELL * k as f64;
        let near = part.as_ref().filter(|_| k == 1);
        let paper = Paper::around(view, near.unwrap_or(&points), left, 16.0);
        scene.window((left, 24.0), CELL, CELL - 4.0);
        let name = if near.is_some() { "the joints that move most, from near" } else { view.name };
        if let Some(mode) = mode {
            moved(&mut scene, &paper, portrait, mode);
        }
        body(&mut scene, &paper, portrait);
        if let Some(mode) = mode {
            for (number, &k) in listed.iter().enumerate() {
                arrow(&mut scene, &paper, portrait, mode, k, number + 1);
            }
        }
        scene.close_window();
        scene.text((left + 0.5 * CELL, 16.0), Anchor::Middle, 13.0, name);
    }
    for (number, &k) in listed.iter().enumerate() {
        let at = (40.0 + CELL * (number % 2) as f64, CELL + 34.0 + 22.0 * (number / 2) as f64);
        if let Some(mode) = mode {
            label(&mut scene, (at.0 - 14.0, at.1 - 5.0), number + 1);
            let text =
                format!("{}  {:+.3}  ({:.0}%)", portrait.dofs[k].name, mode.rates[k], 100.0 * mode.shares[k]);
            scene.text(at, Anchor::Start, 13.0, &text.replace('-', "−"));
        }
    }
    scene
}

/// Joints with arrows, the largest share first.
fn largest(mode: &ModePlace) -> Vec<usize> {
    let mut order: Vec<usize> = (0..mode.shares.len()).collect();
    order.sort_by(|&a, &b| mode.shares[b].total_cmp(&mode.shares[a]));
    order
        .into_iter()
        .take(SHOWN)
        .enumerate()
        .filter(|&(place, k)| place == 0 || mode.shares[k] >= LEAST)
        .map(|(_, k)| k)
        .collect()
}

/// The bodies of joints with arrows, those that carry them and those that they carry.
fn near(portrait: &Portrait, listed: &[usize]) -> Option<Vec<Vec3>> {
    let bodies = &portrait.bodies;
    let moved: Vec<usize> = listed.iter().filter_map(|&k| portrait.dofs.get(k)).map(|dof| dof.body).collect();
    let own = moved.iter().flat_map(|&i| [i].into_iter().chain(bodies.get(i).and_then(|b| b.parent)));
    let carried = (0..bodies.len()).filter(|&i| bodies[i].parent.is_some_and(|p| moved.contains(&p)));
    let points: Vec<Vec3> = own.chain(carried).flat_map(|i| [bodies[i].origin, bodies[i].centre]).collect();
    (points.len() > 2 && reach(&points) > 0.0).then_some(points)
}

/// The largest side of a box around points.
fn reach(points: &[Vec3]) -> f64 {
    let side = |i: usize| {
        let ends =
            points.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), p| (l.min(p[i]), h.max(p[i])));
        ends.1 - ends.0
    };
    (0..3).map(side).fold(0.0, f64::max)
}

/// The direction along which points are spread least.
fn thinnest(points: &[Vec3]) -> Vec3 {
    let n = points.len().max(1) as f64;
    let mean = points.iter().fold([0.0; 3], |sum, &p| add(sum, p, 1.0 / n));
    let spread = |d: Vec3| points.iter().map(|&p| dot(add(p, mean, -1.0), d).powi(2)).sum::<f64>();
    // As good as an eigenvector for a picture, and the same wherever directions tie.
    let mut best = ([1.0, 0.0, 0.0], f64::INFINITY);
    let candidates =
        [[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]].into_iter().chain((0..400).map(|k| {
            let z = 1.0 - (f64::from(k) + 0.5) / 400.0;
            let (s, c) = (2.399_963_229_728_653 * f64::from(k)).sin_cos();
            let r = (1.0 - z * z).sqrt();
            [r * c, r * s, z]
        }));
    for direction in candidates {
        let own = spread(direction);
        if own < best.1 * 0.98 {
            best = (direction, own);
        }
    }
    best.0
}

/// Links, joints and masses.
fn body(scene: &mut Scene, paper: &Paper<'_>, portrait: &Portrait) {
    let bodies = &portrait.bodies;
    let heaviest = bodies.iter().map(|b| b.mass).fold(0.0, f64::max);
    for b in bodies.iter().filter(|b| b.mass > 0.0) {
        scene.line(&[paper.at(b.origin), paper.at(b.centre)], INK, 1.0, "3 3");
        scene.circle(paper.at(b.centre), 2.0 + 7.0 * (b.mass / heaviest).cbrt(), FAINT, INK, 0.8);
    }
    for b in bodies {
        let from = b.parent.map_or([0.0; 3], |p| bodies[p].origin);
        let width = if b.parent.is_some() { 3.0 } else { 1.4 };
        scene.line(&[paper.at(from), paper.at(b.origin)], INK, width, "");
    }
    for b in bodies {
        scene.circle(paper.at(b.origin), 3.2, PAPER, INK, 1.4);
    }
    // The world's origin.
    let (x, y) = paper.at([0.0; 3]);
    scene.line(&[(x - 9.0, y + 6.0), (x + 9.0, y + 6.0)], INK, 2.0, "");
    for k in 0..4 {
        let from = x - 8.0 + 5.0 * f64::from(k);
        scene.line(&[(from, y + 11.0), (from + 4.0, y + 6.0)], INK, 1.0, "");
    }
}

/// Where links are a little later.
fn moved(scene: &mut Scene, paper: &Paper<'_>, portrait: &Portrait, mode: &ModePlace) {
    let bodies = &portrait.bodies;
    let fastest = mode.velocities.iter().flatten().map(|v| dot(*v, *v).sqrt()).fold(0.0, f64::max);
    if fastest * paper.scale < 1e-12 {
        return;
    }
    let later = STRIDE * (CELL - 2.0 * EDGE) / (paper.scale * fastest);
    let place = |i: usize, which: usize| {
        let from = if which == 0 { bodies[i].origin } else { bodies[i].centre };
        add(from, mode.velocities[i][which], later)
    };
    for (i, b) in bodies.iter().enumerate() {
        if let Some(p) = b.parent {
            scene.line(&[paper.at(place(p, 0)), paper.at(place(i, 0))], MOVED, 2.0, "5 3");
        }
        if b.mass > 0.0 {
            let ends = [paper.at(b.centre), paper.at(place(i, 1))];
            scene.line(&ends, MOVED, 1.2, "");
            scene.circle(ends[1], 2.2, MOVED, MOVED, 0.5);
        }
    }
}

/// The arrow of a joint, with its number.
fn arrow(
    scene: &mut Scene,
    paper: &Paper<'_>,
    portrait: &Portrait,
    mode: &ModePlace,
    k: usize,
    number: usize,
) {
    let dof = &portrait.dofs[k];
    let Some(body) = portrait.bodies.get(dof.body) else { return };
    let from = paper.at(body.origin);
    let sign = if mode.rates[k] < 0.0 { -1.0 } else { 1.0 };
    let axis = dof.axis.map(|x| sign * x);
    let (right, up) = paper.view.flat(axis);
    let long = 22.0 + 30.0 * mode.shares[k].sqrt();
    let across = right.hypot(up);
    let tip = (from.0 + long * right, from.1 - long * up);
    if across < 0.25 {
        // Towards the viewer a point, away a cross, as on the feathers.
        scene.circle(from, 8.0, PAPER, ARROW, 2.0);
        if dot(axis, paper.view.towards) > 0.0 {
            scene.circle(from, 2.6, ARROW, ARROW, 1.0);
        } else {
            for (a, b) in [((-5.0, -5.0), (5.0, 5.0)), ((-5.0, 5.0), (5.0, -5.0))] {
                scene.line(&[(from.0 + a.0, from.1 + a.1), (from.0 + b.0, from.1 + b.1)], ARROW, 2.0, "");
            }
        }
    } else {
        scene.line(&[from, tip], ARROW, 2.6, "");
        let heads = if dof.slides { 1 } else { 2 };
        for head in 0..heads {
            let back = 8.0 * f64::from(head);
            let point = (tip.0 - back * right / across, tip.1 + back * up / across);
            let (dx, dy) = (right / across, -up / across);
            let barb =
                |side: f64| (point.0 - 10.0 * dx - side * 4.5 * dy, point.1 - 10.0 * dy + side * 4.5 * dx);
            scene.shape(&[point, barb(1.0), barb(-1.0)], ARROW, ARROW, 0.5);
        }
    }
    // Numbers stand off the arrow's tip, those of one place one after the other.
    let turn = 0.9 * number as f64;
    let away = if across < 0.25 {
        (15.0 * turn.cos(), 15.0 * turn.sin())
    } else {
        (12.0 * right / across, -12.0 * up / across)
    };
    let base = if across < 0.25 { from } else { tip };
    label(scene, (base.0 + away.0, base.1 + away.1), number);
}

fn label(scene: &mut Scene, (x, y): Point, number: usize) {
    scene.circle((x, y), 8.0, PAPER, ARROW, 1.2);
    scene.text((x, y + 4.0), Anchor::Middle, 11.0, &number.to_string());
}

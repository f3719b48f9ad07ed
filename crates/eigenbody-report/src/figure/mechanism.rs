//! Drawings of mechanisms: planar chains, a tree, a link with its axes, shells about a point.

use super::scene::{Anchor, Scene};
use super::style::{INK, Style};
use eigenbody_study::Table;
use std::f64::consts::{PI, TAU};

const WIDTH: f64 = 800.0;
const SIZE: f64 = 14.0;

/// A column's numbers, zero where there is none.
fn column(table: &Table, name: &str) -> Vec<f64> {
    table.number(name).iter().map(|x| x.unwrap_or(0.0)).collect()
}

/// The links of one robot: both ends of each.
type Chain = Vec<[(f64, f64); 2]>;

/// Planar chains: a panel for every word of `panel`, in it a robot for every word of `robot`. Links are tubes, joints open circles.
pub fn planar(table: &Table, title: &str) -> String {
    let (x0, y0, x1, y1) =
        (column(table, "x0"), column(table, "y0"), column(table, "x1"), column(table, "y1"));
    let chain = |panel: &str, robot: &str| -> Chain {
        let words = table.text("panel").iter().zip(table.text("robot")).enumerate();
        let rows = words.filter(|(_, (p, r))| *p == panel && *r == robot).map(|(i, _)| i);
        rows.map(|i| [(x0[i], y0[i]), (x1[i], y1[i])]).collect()
    };
    let panels = table.distinct("panel");
    let columns = if panels.len() > 1 { 3 } else { 1 };
    let (cell, height) = (WIDTH / columns as f64, if panels.len() > 1 { 250.0 } else { 360.0 });
    let mut scene = Scene::new(WIDTH, height * panels.len().div_ceil(columns) as f64);
    for (k, panel) in panels.iter().enumerate() {
        let corner = ((k % columns) as f64 * cell, (k / columns) as f64 * height);
        let robots: Vec<(&str, Chain)> = table
            .distinct("robot")
            .into_iter()
            .map(|robot| (robot, chain(panel, robot)))
            .filter(|(_, links)| !links.is_empty())
            .collect();
        let names = if robots.len() > 1 { robots.len() as f64 * 22.0 } else { 0.0 };
        let heading = if panel.is_empty() { 0.0 } else { 26.0 };
        let view = View::around(
            robots.iter().flat_map(|(_, links)| links.iter().flatten().copied()),
            (corner.0 + 30.0, corner.1 + 20.0 + heading + names),
            (cell - 60.0, height - 40.0 - heading - names),
        );
        if heading > 0.0 {
            scene.text((corner.0 + 0.5 * cell, corner.1 + 26.0), Anchor::Middle, SIZE, panel);
        }
        for (k, (name, links)) in robots.iter().enumerate() {
            let style = Style::nth(k);
            view.chain(&mut scene, links, style);
            if names > 0.0 {
                let y = corner.1 + heading + 24.0 + 22.0 * k as f64;
                scene.line(&[(corner.0 + 40.0, y), (corner.0 + 76.0, y)], style.colour, 5.0, "");
                scene.line(&[(corner.0 + 42.0, y), (corner.0 + 74.0, y)], fill(k), 2.4, "");
                scene.text((corner.0 + 86.0, y + 5.0), Anchor::Start, SIZE, name);
            }
        }
    }
    scene.finish(title)
}

/// Inside of a link: white for the first robot, grey for the second.
fn fill(k: usize) -> &'static str {
    if k == 0 { "#ffffff" } else { "#f4c9a8" }
}

/// Metres to pixels, the same for both axes.
struct View {
    scale: f64,
    centre: (f64, f64),
    middle: (f64, f64),
}

impl View {
    fn around(points: impl Iterator<Item = (f64, f64)>, corner: (f64, f64), size: (f64, f64)) -> Self {
        let none = (f64::INFINITY, f64::NEG_INFINITY);
        let (x, y) = points
            .fold((none, none), |(x, y), p| ((x.0.min(p.0), x.1.max(p.0)), (y.0.min(p.1), y.1.max(p.1))));
        // A chain in line has no height of its own.
        let extent = ((x.1 - x.0).max(1e-9), (y.1 - y.0).max(1e-9));
        let scale = (size.0 / extent.0).min(size.1 / extent.1);
        let middle = (corner.0 + 0.5 * size.0, corner.1 + 0.5 * size.1);
        Self { scale, centre: (0.5 * (x.0 + x.1), 0.5 * (y.0 + y.1)), middle }
    }

    fn at(&self, (x, y): (f64, f64)) -> (f64, f64) {
        (self.middle.0 + self.scale * (x - self.centre.0), self.middle.1 - self.scale * (y - self.centre.1))
    }

    fn chain(&self, scene: &mut Scene, links: &Chain, style: Style) {
        let length = links.first().map_or(1.0, |[a, b]| (b.0 - a.0).hypot(b.1 - a.1)) * self.scale;
        let thick = (0.1 * length).clamp(2.0, 9.0);
        let inside = if style.colour == Style::nth(0).colour { fill(0) } else { fill(1) };
        for &[a, b] in links {
            let ends = [self.at(a), self.at(b)];
            scene.line(&ends, style.colour, thick + 2.4, "");
            scene.line(&ends, inside, thick, "");
        }
        for &[a, _] in links {
            scene.circle(self.at(a), 0.5 * thick + 1.0, "#ffffff", style.colour, 1.3);
        }
    }
}

/// A kinematic tree, the base at the top.
pub fn tree(table: &Table, title: &str) -> String {
    let number = |name: &str| -> Vec<usize> { column(table, name).into_iter().map(|x| x as usize).collect() };
    let (parent, depth) = (number("parent"), number("depth"));
    let n = parent.len();
    let deepest = depth.iter().copied().max().unwrap_or(0);
    // Links that carry none stand side by side, every other one above the middle of those it carries.
    let mut x = vec![0.0; n + 1];
    let mut leaves = 0.0;
    place(0, &parent, &mut x, &mut leaves);
    let height = 90.0 + 66.0 * deepest as f64;
    let mut scene = Scene::new(WIDTH, height);
    let at = |i: usize| {
        let level = if i == 0 { 0 } else { depth[i - 1] };
        (WIDTH * 0.5 + (x[i] - 0.5 * (leaves - 1.0)) * 110.0, 45.0 + 66.0 * level as f64)
    };
    for i in 1..=n {
        scene.line(&[at(parent[i - 1]), at(i)], INK, 1.6, "");
    }
    for i in 0..=n {
        let (x, y) = at(i);
        scene.circle((x, y), 17.0, if i == 0 { "#e4e4e4" } else { "#ffffff" }, INK, 1.6);
        scene.text((x, y + 5.0), Anchor::Middle, SIZE, &i.to_string());
    }
    let (x, y) = at(0);
    scene.text((x + 28.0, y + 5.0), Anchor::Start, SIZE, "fixed base");
    scene.finish(title)
}

fn place(i: usize, parent: &[usize], x: &mut [f64], leaves: &mut f64) {
    let children: Vec<usize> = (1..=parent.len()).filter(|&j| parent[j - 1] == i).collect();
    for &j in &children {
        place(j, parent, x, leaves);
    }
    x[i] = match (children.first(), children.last()) {
        (Some(&first), Some(&last)) => 0.5 * (x[first] + x[last]),
        _ => {
            *leaves += 1.0;
            *leaves - 1.0
        }
    };
}

/// A point in space on paper: x to the right, z up, y to the back.
fn oblique(x: f64, y: f64, z: f64, scale: f64, origin: (f64, f64)) -> (f64, f64) {
    (origin.0 + scale * (x + 0.45 * y), origin.1 - scale * (z + 0.32 * y))
}

fn arrow(scene: &mut Scene, from: (f64, f64), to: (f64, f64), colour: &str, width: f64) {
    scene.line(&[from, to], colour, width, "");
    let angle = (to.1 - from.1).atan2(to.0 - from.0);
    let barb = |turn: f64| (to.0 - 11.0 * (angle + turn).cos(), to.1 - 11.0 * (angle + turn).sin());
    scene.shape(&[to, barb(0.4), barb(-0.4)], colour, colour, 1.0);
}

/// Link 1 of hydra: a tube with both axes.
pub fn link(table: &Table, title: &str) -> String {
    let words = table.text("feature");
    let get = |feature: &str, name: &str| {
        let row = words.iter().position(|word| word == feature);
        row.and_then(|row| table.number(name).get(row).copied().flatten()).unwrap_or(0.0)
    };
    let (scale, origin) = (430.0, (170.0, 300.0));
    let to = |x: f64, y: f64, z: f64| oblique(x, y, z, scale, origin);
    let mut scene = Scene::new(WIDTH, 430.0);
    let (length, radius) = (get("tube, from end to end", "dx"), get("radius", "dy"));
    // The round ends stand across x, seen a little from the side.
    let ring = |x: f64, from: f64, until: f64| -> Vec<(f64, f64)> {
        let steps = (0..=24).map(|k| from + (until - from) * f64::from(k) / 24.0);
        steps.map(|a| to(x, radius * a.cos(), radius * a.sin())).collect()
    };
    let (near, far) = (ring(0.0, 0.0, TAU), ring(length, 0.0, TAU));
    let body =
        [to(0.0, 0.0, radius), to(length, 0.0, radius), to(length, 0.0, -radius), to(0.0, 0.0, -radius)];
    scene.shape(&far, "#e9eef4", INK, 1.4);
    scene.shape(&body, "#e9eef4", "#e9eef4", 0.0);
    scene.line(&body[..2], INK, 1.4, "");
    scene.line(&body[2..], INK, 1.4, "");
    scene.shape(&near, "#ffffff", INK, 1.4);

    let [inboard, outboard] = [Style::nth(2).colour, Style::nth(1).colour];
    let axis = |scene: &mut Scene, x: f64, (dy, dz): (f64, f64), colour: &str| {
        let (tail, tip) = (to(x, -0.32 * dy, -0.32 * dz), to(x, 0.5 * dy, 0.5 * dz));
        scene.line(&[tail, to(x, 0.0, 0.0)], colour, 1.6, "7 4");
        arrow(scene, to(x, 0.0, 0.0), tip, colour, 2.2);
        tip
    };
    axis(&mut scene, 0.0, (get("inboard axis", "dy"), get("inboard axis", "dz")), inboard);
    let end = get("outboard axis", "x");
    // The direction of the inboard axis again, to show the angle between.
    let parallel = to(end, 0.0, 0.5);
    scene.line(&[to(end, 0.0, 0.0), parallel], inboard, 1.2, "2 3");
    let direction = (get("outboard axis", "dy"), get("outboard axis", "dz"));
    let tip = axis(&mut scene, end, direction, outboard);
    let angle = (-direction.0).atan2(direction.1);
    let arc: Vec<(f64, f64)> = (0..=12)
        .map(|k| angle * f64::from(k) / 12.0)
        .map(|a| to(end, -0.38 * a.sin(), 0.38 * a.cos()))
        .collect();
    scene.line(&arc, INK, 1.2, "");
    scene.text((0.5 * (arc[0].0 + arc[12].0) - 4.0, arc[0].1 - 8.0), Anchor::End, SIZE + 1.0, "α");
    let (x, y) = to(0.0, 0.0, 0.5);
    scene.text((x - 12.0, y + 6.0), Anchor::End, SIZE, "inboard axis, z");
    scene.text((tip.0 - 6.0, tip.1 - 12.0), Anchor::End, SIZE, "outboard axis (0, −sin α, cos α)");
    arrow(&mut scene, to(length, 0.0, 0.0), to(1.32 * length, 0.0, 0.0), INK, 1.4);
    let (x, y) = to(1.32 * length, 0.0, 0.0);
    scene.text((x + 6.0, y + 5.0), Anchor::Start, SIZE, "x");
    let centre = to(get("centre of mass", "x"), 0.0, 0.0);
    scene.circle(centre, 4.0, INK, INK, 1.0);
    scene.text((centre.0, centre.1 - 34.0), Anchor::Middle, SIZE, "centre of mass (0.5, 0, 0), 1 kg");
    let (a, b) = (to(0.0, 0.0, -0.2), to(length, 0.0, -0.2));
    scene.line(&[a, b], INK, 1.0, "");
    for end in [a, b] {
        scene.line(&[(end.0, end.1 - 5.0), (end.0, end.1 + 5.0)], INK, 1.0, "");
    }
    scene.text((0.5 * (a.0 + b.0), a.1 + 20.0), Anchor::Middle, SIZE, "1 m, radius 0.05 m");
    scene.finish(title)
}

/// Nested shells, each about its own axis through the common centre.
pub fn shells(table: &Table, title: &str) -> String {
    let (x, y, z) = (column(table, "axis_x"), column(table, "axis_y"), column(table, "axis_z"));
    let mut scene = Scene::new(WIDTH, 430.0);
    let centre = (WIDTH * 0.5, 225.0);
    let to = |p: [f64; 3], r: f64| (centre.0 + r * dot(p, RIGHT), centre.1 - r * dot(p, UP));
    for (k, radius) in (0..x.len()).map(|k| (k, 150.0 * 0.62f64.powi(k as i32))) {
        let colour = Style::nth(2 - k.min(1)).colour;
        scene.circle(centre, radius, "none", colour, 2.4);
        scene.circle(centre, radius - 9.0, "none", colour, 1.0);
        let axis = [x[k], y[k], z[k]];
        // A great circle across the axis, its back half dashed.
        let across = circle_across(axis);
        let half = across.len() / 2;
        let points: Vec<(f64, f64)> = across.iter().map(|&p| to(p, radius)).collect();
        scene.line(&points[..=half], colour, 1.0, "4 3");
        scene.line(&points[half..], colour, 1.0, "");
        // Shafts reach from one shell to the next outer one, the first to the base.
        let reach = if k == 0 { 1.3 } else { 1.0 / 0.62 };
        for side in [1.0, -1.0] {
            let ends = [1.0, reach].map(|r| to(axis.map(|a| side * r * a), radius));
            scene.line(&ends, INK, 6.0, "");
            scene.line(&ends, "#ffffff", 3.0, "");
        }
        // Words stand to the right, each with a thin line to what it names.
        let word = |scene: &mut Scene, from: (f64, f64), row: f64, text: &str| {
            let end = (centre.0 + 215.0, 90.0 + 54.0 * row);
            scene.line(&[from, (end.0 - 6.0, end.1 - 5.0)], "#777777", 1.0, "");
            scene.text(end, Anchor::Start, SIZE, text);
        };
        let shell = |degrees: f64| {
            let (s, c) = degrees.to_radians().sin_cos();
            (centre.0 + radius * c, centre.1 - radius * s)
        };
        let row = k as f64;
        let tip = to(axis.map(|a| a * 1.25), radius);
        word(
            &mut scene,
            tip,
            2.0 * row - 0.6,
            &format!("axis {}{}", k + 1, if k == 0 { ", in the base" } else { ", turned by α" }),
        );
        word(&mut scene, shell(35.0 - 45.0 * row), 2.0 * row + 0.4, &format!("link {}", k + 1));
    }
    scene.circle(centre, 3.0, INK, INK, 1.0);
    scene.finish(title)
}

/// Where shells are seen from: unit vectors to the right, up and away on paper, 0.5 rad beside the y axis and 0.3 rad above.
const RIGHT: [f64; 3] = [0.877_583, 0.479_426, 0.0];
const UP: [f64; 3] = [-0.141_679, 0.259_343, 0.955_336];
const AWAY: [f64; 3] = [-0.458_013, 0.838_387, -0.295_520];

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// 49 points of the unit circle across a unit vector, the half at the back first.
fn circle_across(axis: [f64; 3]) -> Vec<[f64; 3]> {
    let u = cross(axis, AWAY);
    let length = dot(u, u).sqrt().max(1e-12);
    let u = u.map(|x| x / length);
    // u × axis points away from the viewer.
    let w = cross(u, axis);
    let at = |k: i32| {
        let (s, c) = (PI * f64::from(k) / 24.0).sin_cos();
        [0, 1, 2].map(|i| c * u[i] + s * w[i])
    };
    (0..=48).map(at).collect()
}

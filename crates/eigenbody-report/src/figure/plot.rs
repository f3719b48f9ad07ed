//! Curves in panels, with axes and a legend.

use super::axis::{Axis, Range};
use super::scene::{Anchor, Scene};
use super::style::{FAINT, INK, Style};

/// One curve.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// Its name in the legend; empty to be left out there.
    pub name: String,
    /// Its points, in order.
    pub points: Vec<(f64, f64)>,
    /// Its looks.
    pub style: Style,
}

/// One coordinate system.
#[derive(Debug, Clone, PartialEq)]
pub struct Panel {
    /// Its heading; may be empty.
    pub title: String,
    /// To the right.
    pub x: Axis,
    /// Upwards.
    pub y: Axis,
    /// What is in it, the first at the bottom.
    pub curves: Vec<Curve>,
}

/// Panels side by side and below each other.
#[derive(Debug, Clone, PartialEq)]
pub struct Plot {
    /// Its panels, row by row.
    pub panels: Vec<Panel>,
    /// Panels in a row.
    pub columns: usize,
}

/// Width of a whole figure (px).
const WIDTH: f64 = 800.0;
/// Most markers along a curve.
const MARKS: usize = 40;
/// Height of words (px).
const SIZE: f64 = 13.0;

/// How many numbers an upright axis of so many pixels takes.
fn room_upwards(height: f64) -> usize {
    (height / 38.0) as usize
}

/// Width of a word, generously (px).
fn width(text: &str) -> f64 {
    0.62 * SIZE * text.chars().count() as f64
}

impl Plot {
    /// The figure as SVG. Panels that stand alone in their rows have legends at their sides, others on top.
    pub fn svg(&self, title: &str) -> String {
        self.scene().finish(title)
    }

    /// The same, not yet written.
    pub fn scene(&self) -> Scene {
        let columns = self.columns.max(1);
        let rows = self.panels.len().div_ceil(columns);
        let height = match (rows, columns) {
            (1, 1) => 520.0,
            (_, 1) => 360.0,
            _ => 330.0,
        };
        let cell = (WIDTH / columns as f64, height);
        let mut scene = Scene::new(WIDTH, cell.1 * rows as f64);
        for (k, panel) in self.panels.iter().enumerate() {
            let corner = ((k % columns) as f64 * cell.0, (k / columns) as f64 * cell.1);
            panel.draw(&mut scene, corner, cell, columns == 1);
        }
        scene
    }
}

/// The rectangle that curves are drawn in.
struct Field {
    /// Left edge of the panel.
    corner: f64,
    left: f64,
    top: f64,
    width: f64,
    height: f64,
    x: Range,
    y: Range,
}

impl Field {
    fn at(&self, (x, y): (f64, f64)) -> Option<(f64, f64)> {
        let (x, y) = (self.x.place(x)?, self.y.place(y)?);
        Some((self.left + x * self.width, self.top + (1.0 - y) * self.height))
    }
}

impl Panel {
    fn draw(&self, scene: &mut Scene, corner: (f64, f64), cell: (f64, f64), side_legend: bool) {
        let all = || self.curves.iter().flat_map(|curve| curve.points.iter());
        let x = Range::around(self.x.scale, all().map(|point| point.0));
        let y = Range::around(self.y.scale, all().map(|point| point.1));
        let named: Vec<&Curve> = self.curves.iter().filter(|curve| !curve.name.is_empty()).collect();
        let legend = named.iter().map(|curve| width(&curve.name) + 48.0).fold(0.0, f64::max);
        let per_row = (((cell.0 - 60.0) / legend.max(1.0)) as usize).max(1);
        let above = match (side_legend, named.len()) {
            (true, _) | (false, 0) => 0.0,
            (false, n) => 18.0 * n.div_ceil(per_row) as f64,
        };
        let heading = if self.title.is_empty() { 0.0 } else { 22.0 };
        let right = if side_legend && !named.is_empty() { legend + 14.0 } else { 18.0 };
        let height = cell.1 - 16.0 - heading - above - 54.0;
        let numbers = y.ticks(room_upwards(height)).0;
        let left = 46.0 + numbers.iter().map(|tick| 0.92 * width(&tick.1)).fold(0.0, f64::max);
        let (top, width) = (corner.1 + 16.0 + heading + above, cell.0 - left - right);
        let field = Field { corner: corner.0, left: corner.0 + left, top, width, height, x, y };
        self.axes(scene, &field);
        for curve in &self.curves {
            curve.draw(scene, &field);
        }
        scene.frame((field.left, field.top), field.width, field.height);
        let middle = field.left + 0.5 * field.width;
        if heading > 0.0 {
            scene.text((middle, corner.1 + 22.0), Anchor::Middle, SIZE + 1.0, &self.title);
        }
        for (k, curve) in named.iter().enumerate() {
            let at = if side_legend {
                (field.left + field.width + 14.0, field.top + 12.0 + 22.0 * k as f64)
            } else {
                let place = (k % per_row) as f64 * legend;
                (field.left + place, corner.1 + heading + 18.0 + 18.0 * (k / per_row) as f64)
            };
            curve.entry(scene, at);
        }
    }

    fn axes(&self, scene: &mut Scene, field: &Field) {
        let Field { corner, left, top, width, height, x, y } = field;
        let (bottom, right) = (top + height, left + width);
        let (words, marks) = x.ticks((width / 62.0) as usize);
        for (at, word) in &words {
            let x = left + at * width;
            scene.line(&[(x, *top), (x, bottom)], FAINT, 1.0, "");
            scene.text((x, bottom + 18.0), Anchor::Middle, SIZE, word);
        }
        for at in words.iter().map(|tick| tick.0).chain(marks) {
            let x = left + at * width;
            scene.line(&[(x, bottom), (x, bottom - 4.0)], INK, 1.0, "");
        }
        let (words, marks) = y.ticks(room_upwards(*height));
        for (at, word) in &words {
            let y = bottom - at * height;
            scene.line(&[(*left, y), (right, y)], FAINT, 1.0, "");
            scene.text((left - 7.0, y + 0.36 * SIZE), Anchor::End, SIZE, word);
        }
        for at in words.iter().map(|tick| tick.0).chain(marks) {
            let y = bottom - at * height;
            scene.line(&[(*left, y), (left + 4.0, y)], INK, 1.0, "");
        }
        scene.text((left + 0.5 * width, bottom + 42.0), Anchor::Middle, SIZE + 1.0, &self.x.label);
        scene.turned_text(
            (corner + 20.0, top + 0.5 * height),
            Anchor::Middle,
            SIZE + 1.0,
            &self.y.label,
            -90.0,
        );
    }
}

impl Curve {
    fn draw(&self, scene: &mut Scene, field: &Field) {
        let places: Vec<(f64, f64)> = self.points.iter().filter_map(|&point| field.at(point)).collect();
        if self.style.dashes != "none" {
            scene.line(&places, self.style.colour, 1.7, self.style.dashes);
        }
        // Long curves get a marker now and then, those without a line every one.
        let every = if self.style.dashes == "none" { 1 } else { places.len().div_ceil(MARKS).max(1) };
        let every = if places.len() > 150 && every > 1 { places.len() / 12 } else { every };
        for &place in places.iter().step_by(every) {
            scene.marker(place, self.style);
        }
    }

    fn entry(&self, scene: &mut Scene, (x, y): (f64, f64)) {
        if self.style.dashes != "none" {
            scene.line(&[(x, y), (x + 32.0, y)], self.style.colour, 1.7, self.style.dashes);
        }
        scene.marker((x + 16.0, y), self.style);
        scene.text((x + 38.0, y + 0.36 * SIZE), Anchor::Start, SIZE, &self.name);
    }
}

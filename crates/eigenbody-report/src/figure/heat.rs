//! A matrix as coloured squares.
//!
//! Colours run along cividis (Nuñez, Anderton & Renslow 2018), which reads the same with and without colour blindness.

use super::scene::{Anchor, Scene};
use super::style::{INK, PAPER};

/// Most rows that are drawn one by one.
const MOST: usize = 96;
/// Most rows with their names.
const NAMED: usize = 60;
/// Longest name that is written (characters).
const LONGEST: usize = 22;
/// Side of the whole matrix (px).
const SIDE: f64 = 600.0;

/// Cividis, from none to all.
const SCALE: [[f64; 3]; 9] = [
    [0.0, 34.0, 78.0],
    [18.0, 53.0, 112.0],
    [59.0, 73.0, 108.0],
    [87.0, 93.0, 109.0],
    [112.0, 113.0, 115.0],
    [138.0, 134.0, 120.0],
    [165.0, 156.0, 116.0],
    [205.0, 190.0, 98.0],
    [254.0, 232.0, 56.0],
];

/// A matrix to draw.
#[derive(Debug, Clone, PartialEq)]
pub struct Heat {
    /// Names of rows and columns.
    pub names: Vec<String>,
    /// From 0 to 1, row by row; none for an entry that is zero.
    pub cells: Vec<Option<f64>>,
    /// What the ends of the scale stand for.
    pub ends: [String; 2],
}

/// The colour of a number from 0 to 1.
fn colour(x: f64) -> String {
    let at = x.clamp(0.0, 1.0) * (SCALE.len() - 1) as f64;
    let k = (at as usize).min(SCALE.len() - 2);
    let part = at - k as f64;
    let channel = |c: usize| (SCALE[k][c] + part * (SCALE[k + 1][c] - SCALE[k][c])).round() as u8;
    format!("#{:02x}{:02x}{:02x}", channel(0), channel(1), channel(2))
}

/// A name of at most so many characters.
fn short(name: &str) -> String {
    match name.chars().count() {
        n if n > LONGEST => name.chars().take(LONGEST - 1).chain(['…']).collect(),
        _ => name.to_owned(),
    }
}

impl Heat {
    /// The drawing. Of more than 96 rows, each square stands for several and has the largest of them.
    pub fn scene(&self) -> Scene {
        let n = self.names.len();
        let group = n.div_ceil(MOST).max(1);
        let rows = n.div_ceil(group);
        let cell = SIDE / rows.max(1) as f64;
        let named = rows <= NAMED && group == 1;
        let size = (0.8 * cell).clamp(6.0, 13.0);
        let longest = self.names.iter().map(|name| short(name).chars().count()).max().unwrap_or(0);
        let margin = if named { 0.62 * size * longest as f64 + 12.0 } else { 24.0 };
        let mut scene = Scene::new(margin + SIDE + 90.0, margin + SIDE + 16.0);
        let square = |scene: &mut Scene, (i, j): (usize, usize), wide: usize, fill: &str| {
            let (x, y) = (margin + cell * j as f64, margin + cell * i as f64);
            scene.fill((x, y), cell * wide as f64, cell, fill);
        };
        for i in 0..rows {
            // Neighbours of one colour are one rectangle.
            let fills: Vec<Option<String>> = (0..rows).map(|j| self.block(i, j, group).map(colour)).collect();
            let mut j = 0;
            while j < rows {
                let wide = fills[j..].iter().take_while(|fill| **fill == fills[j]).count();
                if let Some(fill) = &fills[j] {
                    square(&mut scene, (i, j), wide, fill);
                }
                j += wide;
            }
        }
        scene.frame((margin, margin), SIDE, SIDE);
        for (k, name) in self.names.iter().enumerate().filter(|_| named) {
            let along = margin + cell * (k as f64 + 0.5);
            scene.text((margin - 6.0, along + 0.36 * size), Anchor::End, size, &short(name));
            scene.turned_text((along + 0.36 * size, margin - 6.0), Anchor::Start, size, &short(name), -90.0);
        }
        self.legend(&mut scene, (margin + SIDE + 18.0, margin));
        scene
    }

    /// The largest entry of a square.
    fn block(&self, i: usize, j: usize, group: usize) -> Option<f64> {
        let n = self.names.len();
        let range = |k: usize| k * group..((k + 1) * group).min(n);
        let entries = range(i).flat_map(|row| range(j).map(move |column| row * n + column));
        entries.filter_map(|at| self.cells.get(at).copied().flatten()).reduce(f64::max)
    }

    fn legend(&self, scene: &mut Scene, (x, y): (f64, f64)) {
        let steps = 40;
        let height = 200.0;
        for k in 0..steps {
            let from = y + height * f64::from(k) / f64::from(steps);
            let fill = colour(1.0 - (f64::from(k) + 0.5) / f64::from(steps));
            scene.fill((x, from), 14.0, height / f64::from(steps) + 0.5, &fill);
        }
        scene.frame((x, y), 14.0, height);
        scene.text((x + 20.0, y + 10.0), Anchor::Start, 12.0, &self.ends[1]);
        scene.text((x + 20.0, y + height), Anchor::Start, 12.0, &self.ends[0]);
        scene.shape(
            &[
                (x, y + height + 14.0),
                (x + 14.0, y + height + 14.0),
                (x + 14.0, y + height + 28.0),
                (x, y + height + 28.0),
            ],
            PAPER,
            INK,
            1.0,
        );
        scene.text((x + 20.0, y + height + 26.0), Anchor::Start, 12.0, "zero");
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_scale_runs_from_end_to_end() {
        assert_eq!([colour(0.0), colour(1.0), colour(2.0)], ["#00224e", "#fee838", "#fee838"]);
    }

    /// A thousand rows become 91 squares of eleven, each with the largest of its entries.
    #[test]
    fn large_matrices_are_grouped() {
        let n = 1000;
        let mut cells = vec![None; n * n];
        cells[n * n - 1] = Some(1.0);
        cells[n * n - 2] = Some(0.5);
        let heat = Heat { names: vec!["x".into(); n], cells, ends: ["a".into(), "b".into()] };
        assert_eq!((heat.block(90, 90, 11), heat.block(90, 89, 11)), (Some(1.0), None));
        assert!(heat.scene().finish("t").len() < 20_000);
    }
}

//! What a model consists of: its tree, its degrees of freedom, its findings.

use crate::number::significant;
use crate::text::{count, one_line};
use comfy_table::{Table, presets};
use serde::Serialize;
use std::fmt::Write;

/// What `eigenbody info` answers.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct InfoReport {
    /// The model as it was asked for.
    pub model: String,
    /// The robot's own name.
    pub name: String,
    /// `fixed` or `floating`.
    pub base: String,
    /// Number of coordinates.
    pub nq: usize,
    /// Number of degrees of freedom.
    pub nv: usize,
    /// Mass of all moving bodies (kg).
    pub mass: f64,
    /// The moving bodies, a body before those it carries.
    pub bodies: Vec<BodyRow>,
    /// The degrees of freedom, in the order of H.
    pub dofs: Vec<DofRow>,
    /// Names of configurations that the file gives.
    pub keyframes: Vec<String>,
    /// What is suspicious.
    pub findings: Vec<String>,
}

/// A moving body.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BodyRow {
    /// Its name.
    pub name: String,
    /// How many bodies carry it.
    pub depth: usize,
    /// The kind of joint that carries it.
    pub joint: String,
    /// Its mass, with all that is fixed to it (kg).
    pub mass: f64,
}

/// A degree of freedom.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DofRow {
    /// Its row in H.
    pub dof: usize,
    /// Its name.
    pub name: String,
    /// The kind of its joint.
    pub kind: String,
    /// Where its joint's coordinates stand in q: first, and one past the last.
    pub coordinates: [usize; 2],
    /// rad or m.
    pub unit: String,
    /// Lower and upper limit.
    pub limits: Option<(f64, f64)>,
    /// Rotor inertia reflected to it (kg m², kg).
    pub armature: f64,
    /// The joint that its joint follows.
    pub follows: Option<String>,
}

impl InfoReport {
    /// As JSON; floats parse back to the same bits.
    ///
    /// # Errors
    ///
    /// Only if the serialiser fails, which plain numbers and strings do not make it do.
    pub fn to_json(&self) -> Result<String, serde_json::Error> {
        serde_json::to_string(self)
    }

    /// For the terminal.
    pub fn to_text(&self) -> String {
        let (bodies, mass) = (self.bodies.len(), significant(self.mass, 4));
        let mut page = format!("{}\n", self.model);
        let _ = writeln!(
            page,
            "  {}: {}, {mass} kg, {}, {}, {} base\n",
            one_line(&self.name),
            count(bodies, "moving body", "moving bodies"),
            count(self.nv, "degree of freedom", "degrees of freedom"),
            count(self.nq, "coordinate", "coordinates"),
            self.base
        );
        page.push_str("  tree\n");
        for body in &self.bodies {
            let indent = "  ".repeat(body.depth.min(20));
            let mass = significant(body.mass, 4);
            let _ = writeln!(page, "  {indent}└ {} ({}, {mass} kg)", one_line(&body.name), body.joint);
        }
        page.push('\n');
        for line in self.dof_table().lines() {
            let _ = writeln!(page, "  {}", line.trim_end());
        }
        if !self.keyframes.is_empty() {
            let _ =
                writeln!(page, "\n  configurations in the file: {}", one_line(&self.keyframes.join(", ")));
        }
        match self.findings.len() {
            0 => page.push_str("\n  no findings\n"),
            n => {
                let _ = writeln!(page, "\n  {n} {}", if n == 1 { "finding" } else { "findings" });
                self.findings.iter().for_each(|finding| {
                    let _ = writeln!(page, "  - {finding}");
                });
            }
        }
        page
    }

    fn dof_table(&self) -> String {
        let mut table = Table::new();
        table.load_style(presets::NOTHING);
        table.set_header(["row", "degree of freedom", "joint", "q", "limits", "armature", "follows"]);
        for dof in &self.dofs {
            let [from, to] = dof.coordinates;
            let q = if to - from == 1 { from.to_string() } else { format!("{from}..{}", to - 1) };
            let limits = dof.limits.map_or(String::new(), |(lower, upper)| {
                format!("{} .. {} {}", significant(lower, 4), significant(upper, 4), dof.unit)
            });
            let armature = if dof.armature == 0.0 { String::new() } else { significant(dof.armature, 4) };
            let follows = dof.follows.as_deref().map_or_else(String::new, one_line);
            table.add_row([
                dof.dof.to_string(),
                one_line(&dof.name),
                dof.kind.clone(),
                q,
                limits,
                armature,
                follows,
            ]);
        }
        table.to_string()
    }
}

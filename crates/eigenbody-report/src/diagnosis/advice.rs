//! What to add, for people and for programs.

use crate::number::significant;
use comfy_table::{CellAlignment, Table, presets};
use eigenbody_study::diagnosis::{Advice, Goal};
use serde::Serialize;
use std::fmt::Write;

/// The least armature that does what is wanted.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct AdviceReport {
    /// `kappa` or `lambda_min`.
    pub measure: &'static str,
    /// The value that is wanted.
    pub wanted: f64,
    /// The worst value found with the armature added.
    pub reached: Option<f64>,
    /// Configurations in which that was looked for.
    pub checked: usize,
    /// Joint by joint.
    pub added: Vec<AddedReport>,
}

/// Armature for one degree of freedom.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct AddedReport {
    /// Its name.
    pub joint: String,
    /// What the model has (kg m², kg).
    pub authored: f64,
    /// What to add (kg m², kg).
    pub added: f64,
    /// The same against the median of H_dd.
    pub inflation: f64,
}

impl From<&Advice> for AdviceReport {
    fn from(advice: &Advice) -> Self {
        let (measure, wanted) = goal(advice.goal);
        let added = advice.added.iter().map(|added| AddedReport {
            joint: added.joint.clone(),
            authored: added.authored,
            added: added.added,
            inflation: added.inflation,
        });
        let reached = advice.reached.is_finite().then_some(advice.reached);
        Self { measure, wanted, reached, checked: advice.checked, added: added.collect() }
    }
}

fn goal(goal: Goal) -> (&'static str, f64) {
    match goal {
        Goal::Kappa(most) => ("kappa", most),
        Goal::LambdaMin(least) => ("lambda_min", least),
    }
}

/// The advice as a part of the page for the terminal.
pub fn advice_text(advice: &Advice) -> String {
    let wanted = match advice.goal {
        Goal::Kappa(most) => format!("κ ≤ {}", significant(most, 3)),
        Goal::LambdaMin(least) => format!("λmin ≥ {} kg m²", significant(least, 3)),
    };
    let needed: Vec<_> = advice.added.iter().filter(|added| added.added > 0.0).collect();
    if needed.is_empty() {
        return format!("\n  advice: {wanted} holds in every configuration that was tried; nothing to add\n");
    }
    let mut table = Table::new();
    table.load_style(presets::NOTHING);
    table.set_header(["joint", "has", "add", "of its own inertia"]);
    for added in needed {
        table.add_row([
            added.joint.clone(),
            significant(added.authored, 3),
            significant(added.added, 3),
            // A joint without inertia of its own has nothing to compare with.
            if added.inflation < 1e3 {
                format!("+{:.2}%", 100.0 * added.inflation)
            } else {
                "has none".into()
            },
        ]);
    }
    for column in table.column_iter_mut().skip(1) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    let mut text =
        format!("\n  advice: the least armature (kg m², kg) for {wanted} in every configuration\n");
    for line in table.lines() {
        let _ = writeln!(text, "   {}", line.trim_end());
    }
    let _ = writeln!(text, "  with it the worst found is {}", significant(advice.reached, 3));
    text
}

//! What to change, for people and for programs.

use super::stepping::time;
use crate::number::significant;
use comfy_table::{CellAlignment, Table, presets};
use eigenbody::spatial::Sym3;
use eigenbody_study::diagnosis::{Advice, Goal, LimitAdvice, LinkAdvice, Remedies};
use serde::Serialize;
use std::fmt::Write;

/// What does what is wanted: the least armature, and what else would.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct AdviceReport {
    /// `kappa`, `lambda_min` or `step`.
    pub measure: &'static str,
    /// The value that is wanted.
    pub wanted: f64,
    /// The worst value found with the armature added; `null` if no armature does.
    pub reached: Option<f64>,
    /// Configurations in which that was looked for.
    pub checked: usize,
    /// Joint by joint; empty if no armature does.
    pub added: Vec<AddedReport>,
    /// Part by which the kinetic energy of equal joint rates grows.
    pub energy: Option<f64>,
    /// Single links whose inertia does, the smallest change first.
    pub links: Vec<LinkReport>,
    /// Single limits that do, the smallest loss first.
    pub limits: Vec<LimitReport>,
}

/// Armature for one degree of freedom.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct AddedReport {
    /// Its name.
    pub joint: String,
    /// What the model has (kg m², kg).
    pub authored: f64,
    /// What would do if no joint had any; where the model has some.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub needed: Option<f64>,
    /// What to add (kg m², kg).
    pub added: f64,
    /// The same against the median of H_dd.
    pub inflation: f64,
}

/// More inertia for one link.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LinkReport {
    /// The link.
    pub link: String,
    /// Its mass (kg).
    pub mass: f64,
    /// Mass to add at its centre (kg).
    pub added_mass: f64,
    /// Its inertia about its centre of mass on its own axes: xx, yy, zz, xy, xz, yz (kg m²).
    pub inertia: [f64; 6],
    /// What to add.
    pub added_inertia: [f64; 6],
    /// In parts of its own mass and second moment.
    pub cost: f64,
    /// The worst value found with it.
    pub reached: f64,
}

/// A limit on one joint.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LimitReport {
    /// The joint.
    pub joint: String,
    /// Its range (rad, m).
    pub range: [f64; 2],
    /// What it may do.
    pub kept: [f64; 2],
    /// The part that it loses.
    pub lost: f64,
    /// The worst value found with it.
    pub reached: f64,
}

fn six(inertia: &Sym3<f64>) -> [f64; 6] {
    let Sym3 { xx, yy, zz, xy, xz, yz } = *inertia;
    [xx, yy, zz, xy, xz, yz]
}

impl AdviceReport {
    /// What was found for a goal.
    pub fn new(goal: Goal, found: &Remedies) -> Self {
        let (measure, wanted) = match goal {
            Goal::Kappa(most) => ("kappa", most),
            Goal::LambdaMin(least) => ("lambda_min", least),
            Goal::Step(step, _) => ("step", step),
        };
        let armature = found.armature.as_ref();
        let added = armature.into_iter().flat_map(|advice| &advice.added).map(|added| AddedReport {
            joint: added.joint.clone(),
            authored: added.authored,
            needed: added.needed,
            added: added.added,
            inflation: added.inflation,
        });
        let link = |link: &LinkAdvice| LinkReport {
            link: link.link.clone(),
            mass: link.mass[0],
            added_mass: link.mass[1],
            inertia: six(&link.inertia[0]),
            added_inertia: six(&link.inertia[1]),
            cost: link.cost,
            reached: link.reached,
        };
        let limit = |limit: &LimitAdvice| LimitReport {
            joint: limit.joint.clone(),
            range: [limit.range.0, limit.range.1],
            kept: [limit.kept.0, limit.kept.1],
            lost: limit.lost,
            reached: limit.reached,
        };
        Self {
            measure,
            wanted,
            reached: armature.map(|advice| advice.reached).filter(|reached| reached.is_finite()),
            checked: armature.map_or(0, |advice| advice.checked),
            added: added.collect(),
            energy: armature.map(|advice| advice.energy),
            links: found.links.iter().map(link).collect(),
            limits: found.limits.iter().map(limit).collect(),
        }
    }
}

fn wanted(goal: Goal) -> String {
    match goal {
        Goal::Kappa(most) => format!("κ ≤ {}", significant(most, 3)),
        Goal::LambdaMin(least) => format!("λmin ≥ {} kg m²", significant(least, 3)),
        Goal::Step(step, integrator) => format!("steps of {} by {}", time(step), integrator.name()),
    }
}

/// The advice as a part of the page for the terminal.
pub fn advice_text(goal: Goal, found: &Remedies) -> String {
    let what = wanted(goal);
    let mut text = match &found.armature {
        Some(advice) if advice.added.iter().all(|added| added.added == 0.0) => {
            let mut text =
                format!("\n  advice: {what} holds in every configuration that was tried; nothing to add\n");
            if advice.added.iter().any(|added| added.needed.is_some()) {
                text.push_str(&table(advice, true));
            }
            return text;
        }
        Some(advice) => {
            let head =
                format!("\n  advice: the least armature (kg m², kg) for {what} in every configuration\n");
            let reached = match goal {
                Goal::Step(..) => time(advice.reached),
                _ => significant(advice.reached, 3),
            };
            format!(
                "{head}{}  with it the worst found is {reached}; motions at equal joint rates take {} more energy\n",
                table(advice, false),
                percent(advice.energy)
            )
        }
        None => format!("\n  advice: no armature was found for {what} in every configuration\n"),
    };
    if let Some(link) = found.links.first() {
        let _ = writeln!(
            text,
            "  or inertia in one link: '{}' {} kg, {} kg m² more (it has {} and {})",
            link.link,
            significant(link.mass[1], 3),
            significant(trace(&link.inertia[1]), 3),
            significant(link.mass[0], 3),
            significant(trace(&link.inertia[0]), 3),
        );
    }
    if let Some(limit) = found.limits.first() {
        let _ = writeln!(
            text,
            "  or a limit: '{}' kept within {:.4} .. {:.4}, {} of its range less",
            limit.joint,
            limit.kept.0,
            limit.kept.1,
            percent(limit.lost)
        );
    }
    text
}

fn trace(inertia: &Sym3<f64>) -> f64 {
    inertia.xx + inertia.yy + inertia.zz
}

fn percent(part: f64) -> String {
    match 100.0 * part {
        p if p >= 100.0 => format!("{p:.0}%"),
        p if p >= 0.01 => format!("{p:.2}%"),
        p => format!("{p:.0e}%"),
    }
}

/// What is to be added, and where the model has armature, what would be needed without; `all`: of joints that have some as well.
fn table(advice: &Advice, all: bool) -> String {
    let compared = advice.added.iter().any(|added| added.needed.is_some());
    let mut table = Table::new();
    table.load_style(presets::NOTHING);
    let needs = ["needs"];
    let needs = if compared { &needs[..] } else { &[] };
    table.set_header([&["joint", "has"][..], needs, &["add", "of its own inertia"]].concat());
    for added in advice.added.iter().filter(|added| added.added > 0.0 || all && added.authored > 0.0) {
        let mut row = vec![added.joint.clone(), significant(added.authored, 3)];
        if compared {
            row.push(added.needed.map_or("–".into(), |needed| significant(needed, 3)));
        }
        row.push(significant(added.added, 3));
        // A joint without inertia of its own has nothing to compare with.
        row.push(if added.inflation < 1e3 {
            format!("+{}", percent(added.inflation))
        } else {
            "has none".into()
        });
        table.add_row(row);
    }
    for column in table.column_iter_mut().skip(1) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    let lines = table.lines().map(|line| format!("   {}\n", line.trim_end()));
    lines.collect()
}

//! Pages on two studies along motions: Markdown and figures.

mod cost;
mod judged;

pub use cost::cost_page;
pub use judged::judged_page;

use crate::significant;

/// A page, and the figures that it shows by name.
#[derive(Debug, Clone, PartialEq)]
pub struct Page {
    /// Markdown.
    pub text: String,
    /// File names and SVG.
    pub figures: Vec<(String, String)>,
}

/// Where figures stand, seen from a page in docs/.
const FIGURES: &str = "guide/src/figures";

fn table(head: &[&str], rows: &[Vec<String>]) -> String {
    let line = |cells: Vec<String>| format!("| {} |\n", cells.join(" | "));
    let head_line = line(head.iter().map(ToString::to_string).collect());
    let rule = format!("|{}\n", "---|".repeat(head.len()));
    format!("{head_line}{rule}{}", rows.iter().map(|row| line(row.clone())).collect::<String>())
}

fn number(x: f64) -> String {
    if x.is_finite() { significant(x, 3) } else { "–".into() }
}

fn shown(name: &str, what: &str) -> String {
    format!("![{what}]({FIGURES}/{name})\n")
}

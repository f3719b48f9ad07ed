//! The spectrum as a page for the terminal.

use crate::number::significant;
use crate::spectrum::{CountReport, ErrorEstimate, LoopsReport, ModeReport, SpectrumReport, Subject};
use comfy_table::{Table, presets};
use std::fmt::Write;

/// Width of the largest bar.
const BAR: usize = 16;
/// DoFs shown of a mode.
const SHOWN: usize = 6;

/// A mode with its heading.
pub struct Mode<'a> {
    /// Heading, such as `softest mode`.
    pub title: String,
    /// The mode.
    pub mode: &'a ModeReport,
}

impl SpectrumReport {
    /// The page.
    pub fn to_text(&self) -> String {
        let mut page = format!("{}\n\n", self.heading());
        for line in self.numbers().lines() {
            let _ = writeln!(page, "{}", line.trim_end());
        }
        page.push('\n');
        if let Some(loops) = &self.loops {
            let _ = writeln!(page, "{}\n", loops.to_text());
        }
        if let Some(CountReport { sigma, count }) = self.count_below {
            let _ = writeln!(page, "  {count} of {} eigenvalues lie below {sigma}\n", self.dofs);
        }
        let titled = |what: &str, lambda: Option<f64>| match lambda {
            Some(lambda) => format!("{what} mode, λ = {}", significant(lambda, 4)),
            None => format!("{what} mode"),
        };
        let modes: Vec<Mode<'_>> = [
            self.softest.as_ref().map(|mode| Mode { title: titled("softest", self.lambda_min), mode }),
            self.stiffest.as_ref().map(|mode| Mode { title: titled("stiffest", self.lambda_max), mode }),
        ]
        .into_iter()
        .flatten()
        .collect();
        page.push_str(&crate::text::modes(&modes));
        if let Some(eigenvalues) = &self.eigenvalues {
            page.push_str("\n  eigenvalues, ascending\n");
            for row in eigenvalues.chunks(6) {
                let cells: Vec<String> = row.iter().map(|&x| format!("{:<12}", significant(x, 6))).collect();
                let _ = writeln!(page, "  {}", cells.concat().trim_end());
            }
        }
        if let Some(note) = &self.note {
            let _ = writeln!(page, "\n  note: {}", wrap(note, 72, "        "));
        }
        if !self.findings.is_empty() {
            let _ = writeln!(page, "\n  {} on the model:", count(self.findings.len(), "finding", "findings"));
            for finding in self.findings.iter().take(SHOWN) {
                let place = finding.strip_prefix(&self.subject.model).and_then(|rest| rest.strip_prefix(':'));
                let finding = place.map_or_else(|| finding.clone(), |rest| format!("line {rest}"));
                let _ = writeln!(page, "  - {}", wrap(&finding.replace(" warning:", ""), 74, "    "));
            }
            if self.findings.len() > SHOWN {
                let _ = writeln!(page, "  - .. and {} more (--json lists all)", self.findings.len() - SHOWN);
            }
        }
        page
    }

    fn heading(&self) -> String {
        let Subject { model, bodies, base, configuration, .. } = &self.subject;
        format!(
            "{model}\n  {}, {}, {base} base, at {configuration}",
            count(*bodies, "moving body", "moving bodies"),
            count(self.dofs, "degree of freedom", "degrees of freedom"),
        )
    }

    fn numbers(&self) -> Table {
        let show = |x: Option<f64>| x.map_or_else(|| "–".into(), |x| significant(x, 6));
        let with_unit = |x: Option<f64>| match x {
            Some(x) => format!("{} {}", significant(x, 6), self.unit).trim_end().to_owned(),
            None => "–".into(),
        };
        let kappa = format!("λmax/λmin, {} metric: for gains and time steps", self.metric);
        let digits = self.kappa_weighted.map_or_else(String::new, |weighted| {
            let left = |digits: f64| (digits - weighted.log10()).max(0.0).floor();
            format!("digits left in a solve: {} of 15 in f64, {} of 7 in f32", left(15.95), left(7.22))
        });
        let bracket = self.bracket.map_or_else(String::new, |[lo, hi]| {
            format!("bracket: {} ≤ κ ≤ {}", significant(lo, 3), significant(hi, 3))
        });
        let mut table = Table::new();
        table.load_style(presets::NOTHING);
        table.add_row(["κ", &show(self.kappa), &kappa]);
        table.add_row(["κ'", &show(self.kappa_weighted), &digits]);
        table.add_row(["r", &show(self.diagonal_ratio), &bracket]);
        let error = |what: &str, estimate: Option<f64>| match estimate {
            Some(estimate) => format!("inertia of the {what} motion, ± {estimate:.0e}"),
            None => format!("inertia of the {what} motion"),
        };
        let ErrorEstimate { lambda_min, lambda_max } = self.error_estimate;
        table.add_row(["λmin", &with_unit(self.lambda_min), &error("softest", lambda_min)]);
        table.add_row(["λmax", &with_unit(self.lambda_max), &error("stiffest", lambda_max)]);
        for (column, padding) in [(0, (2, 1)), (1, (1, 2))] {
            if let Some(column) = table.column_mut(column) {
                column.set_padding(padding);
            }
        }
        table
    }
}

impl LoopsReport {
    /// What was closed, what is left, and whether the configuration had to move.
    fn to_text(&self) -> String {
        let loops = count(self.closures.len(), "loop", "loops");
        let left = count(self.freedom, "degree of freedom", "degrees of freedom");
        let text = format!("  {loops} closed: {} independent conditions leave {left}", self.rank);
        match self.steps {
            0 => text,
            steps => format!(
                "{text}\n  open by {} (m, rad) at first, closed to {:.0e} in {}; --json has that q",
                significant(self.opened, 3),
                self.residual,
                count(steps, "step", "steps")
            ),
        }
    }
}

/// Modes side by side: their main DoFs, signs and shares.
pub fn modes(modes: &[Mode<'_>]) -> String {
    let blocks: Vec<Vec<String>> = modes.iter().map(block).collect();
    let height = blocks.iter().map(Vec::len).max().unwrap_or(0);
    let widths: Vec<usize> =
        blocks.iter().map(|b| b.iter().map(|line| line.chars().count()).max().unwrap_or(0)).collect();
    // Side by side where both fit in a terminal of 100 columns, else one above the other.
    if widths.iter().sum::<usize>() + 4 * widths.len() > 100 {
        return blocks
            .iter()
            .map(|b| b.iter().map(|line| format!("  {line}\n")).collect::<String>())
            .collect::<Vec<_>>()
            .join("\n");
    }
    let mut page = String::new();
    for row in 0..height {
        let mut line = String::new();
        for (block, &width) in blocks.iter().zip(&widths) {
            let cell = block.get(row).map_or("", String::as_str);
            let pad = width - cell.chars().count();
            let _ = write!(line, "  {cell}{:pad$}  ", "");
        }
        page.push_str(line.trim_end());
        page.push('\n');
    }
    page
}

fn block(Mode { title, mode }: &Mode<'_>) -> Vec<String> {
    let mut order: Vec<usize> = (0..mode.share.len()).collect();
    order.sort_by(|&a, &b| mode.share[b].total_cmp(&mode.share[a]));
    let shown: Vec<usize> =
        order.iter().copied().take(SHOWN).filter(|&d| mode.share[d] >= 5e-4 || d == order[0]).collect();
    let name_width = shown.iter().map(|&d| one_line(&mode.joints[d]).chars().count()).max().unwrap_or(0);
    let mut lines = vec![title.clone()];
    for &d in &shown {
        let name = one_line(&mode.joints[d]);
        let pad = name_width - name.chars().count();
        let sign = if mode.vector[d] < 0.0 { '−' } else { '+' };
        let bar = "█".repeat(((mode.share[d] * BAR as f64).round() as usize).max(1));
        lines.push(format!("{name}{:pad$} {sign} {:>5.1}% {bar:<BAR$}", "", 100.0 * mode.share[d]));
    }
    let rest: f64 = order.iter().filter(|d| !shown.contains(d)).map(|&d| mode.share[d]).sum();
    if rest >= 5e-4 {
        lines.push(format!("and {} more, {:.1}%", order.len() - shown.len(), 100.0 * rest));
    }
    lines
}

/// A name whose line breaks are shown: a page's own are no part of it.
pub fn one_line(name: &str) -> String {
    name.replace('\n', "\\n")
}

/// A number of things, in words: `1 figure`, `2 figures`.
///
/// ```
/// assert_eq!(eigenbody_report::count(1, "claim", "claims"), "1 claim");
/// ```
pub fn count(n: usize, one: &str, many: &str) -> String {
    format!("{n} {}", if n == 1 { one } else { many })
}

/// Words in lines of at most `width`, the later ones indented.
fn wrap(text: &str, width: usize, indent: &str) -> String {
    let (mut out, mut column) = (String::new(), 0);
    for word in text.split_whitespace() {
        let length = word.chars().count();
        if column > 0 && column + 1 + length > width {
            out.push('\n');
            out.push_str(indent);
            column = 0;
        } else if column > 0 {
            out.push(' ');
            column += 1;
        }
        out.push_str(word);
        column += length;
    }
    out
}

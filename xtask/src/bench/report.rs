//! The tables of docs/performance.md.

use std::path::Path;

use super::{Figures, SHAPES, SIZES, write};
use crate::Outcome;

const END: &str = "<!-- end -->";

/// Puts what a task wrote between its markers in a file.
pub fn update(path: &Path, task: &str, text: &str) -> Outcome {
    let old =
        std::fs::read_to_string(path).map_err(|error| format!("cannot read {}: {error}", path.display()))?;
    let new = between(&old, task, text).ok_or_else(|| format!("{}: no markers of {task}", path.display()))?;
    write(&path.to_path_buf(), &new)
}

fn between(old: &str, task: &str, text: &str) -> Option<String> {
    let begin = format!("<!-- begin: written by `cargo xtask {task}` -->\n");
    let (before, rest) = old.split_once(&begin)?;
    let (_, after) = rest.split_once(END)?;
    Some(format!("{before}{begin}\n{text}\n{END}{after}"))
}

/// All tables, in Markdown.
pub fn text(figures: &Figures) -> String {
    [extremes(figures), all(figures), crossover(figures), sweeps(figures), scale(figures), counts(figures)]
        .join("\n")
}

/// A time with three digits and a fitting unit.
pub fn time(seconds: f64) -> String {
    let (number, unit) = match seconds {
        s if s < 1e-6 => (s * 1e9, "ns"),
        s if s < 1e-3 => (s * 1e6, "µs"),
        s if s < 1.0 => (s * 1e3, "ms"),
        s => (s, "s"),
    };
    let digits = if number < 10.0 { 2 } else { usize::from(number < 100.0) };
    format!("{number:.digits$} {unit}")
}

/// A table in Markdown under its title.
pub fn table(title: &str, head: &[&str], rows: &[Vec<String>]) -> String {
    let line = |cells: &[String]| format!("| {} |\n", cells.join(" | "));
    let head: Vec<String> = head.iter().map(ToString::to_string).collect();
    let rule = format!("|{}\n", "---|".repeat(head.len()));
    format!("### {title}\n\n{}{rule}{}", line(&head), rows.iter().map(|row| line(row)).collect::<String>())
}

fn extremes(figures: &Figures) -> String {
    let rows: Vec<Vec<String>> = [(1000, 60), (2000, 150)]
        .map(|(n, goal)| {
            let engine = figures.get(&format!("extremes {n}"));
            let (crba, lapack) = (figures.get(&format!("crba {n}")), figures.get(&format!("lapack {n}")));
            let ratio = (crba + lapack) / engine;
            let row = [n.to_string(), time(engine), time(crba), time(lapack), format!("{ratio:.0}×")];
            row.into_iter().chain([format!("{goal}×")]).collect()
        })
        .into();
    let error = |name: &str| format!("{:.1e}", figures.get(&format!("error {name}")));
    let head = ["N", "eigenbody, with modes", "H by CRBA", "LAPACK, eigenvalues only", "ratio", "goal"];
    format!(
        "{}\nRelative errors at N = 1000: λmin {} (LAPACK {}), λmax {} (LAPACK {}); {} passes of eight counts.\n",
        table("Both extremes of hydra(N, 1, 0, 1) at zag(0), one thread", &head, &rows),
        error("min eigenbody"),
        error("min lapack"),
        error("max eigenbody"),
        error("max lapack"),
        figures.get("passes"),
    )
}

fn all(figures: &Figures) -> String {
    let lapack = figures.get("lapack 1000");
    let row = |name: &str, one: f64, all: Option<f64>| {
        vec![name.to_owned(), time(one), all.map_or_else(|| "–".to_owned(), time)]
    };
    let measured = |name: &str| {
        (figures.get(&format!("{name} 1000 one thread")), Some(figures.get(&format!("{name} 1000"))))
    };
    let ((slice, slice_all), (faer, faer_all)) = (measured("slice"), measured("faer"));
    let rows = [row("eigenbody", slice, slice_all), row("faer", faer, faer_all), row("LAPACK", lapack, None)];
    format!(
        "{}\nThe dense solvers are given H. Worst relative error over all of onion(1000, 1, 0, 1), which has a closed form: \
         {:.1e}; faer {:.1e}.\n",
        table("All eigenvalues of hydra(1000, 1, 0, 1)", &["", "one thread", "all threads"], &rows),
        figures.get("error all eigenbody"),
        figures.get("error all faer"),
    )
}

fn crossover(figures: &Figures) -> String {
    let mut sizes: Vec<usize> = figures.names("dense ").filter_map(|n| n.parse().ok()).collect();
    sizes.sort_unstable();
    let measured = |n: usize| (figures.get(&format!("dense {n}")), figures.get(&format!("sturm {n}")));
    let row = |&n: &usize| {
        let (dense, sturm) = measured(n);
        vec![n.to_string(), time(dense), time(sturm), format!("{:.2}", dense / sturm)]
    };
    let rows: Vec<_> = sizes.iter().map(row).collect();
    let faster = sizes.iter().find(|&&n| measured(n).0 > measured(n).1);
    format!(
        "{}\nBoth give κ, κ′, the bracket and both modes. The engine is faster from n = {} on.\n",
        table("`conditioning_at` by either method", &["n", "dense", "sturm", "dense/sturm"], &rows),
        faster.map_or_else(|| "?".to_owned(), ToString::to_string),
    )
}

fn sweeps(figures: &Figures) -> String {
    let mut sizes: Vec<usize> = figures.names("sweep chain ").filter_map(|n| n.parse().ok()).collect();
    sizes.sort_unstable();
    let body = |name: &str, n: usize| time(figures.get(&format!("sweep {name} {n}")) / n as f64);
    let row = |&n: &usize| vec![n.to_string(), body("chain", n), body("tree", n)];
    let rows: Vec<_> = sizes.iter().map(row).collect();
    let title = "One counting sweep with eight shifts, per body (goal: 80 ns)";
    table(title, &["N", "hydra(N, 1, 0, 1)", "hydra(N, 2, 0.5, 1)"], &rows)
}

fn scale(figures: &Figures) -> String {
    let get = |what: &str, name: &str, n: usize| figures.get(&format!("{what} {name} {n}"));
    let row = |n: usize| {
        let cells = SHAPES.map(|(name, _)| {
            let bytes = get("memory", name, n) * 1024.0 / n as f64;
            [time(get("command", name, n)), format!("{bytes:.0}")]
        });
        std::iter::once(n.to_string()).chain(cells.into_iter().flatten()).collect()
    };
    let rows: Vec<Vec<String>> = SIZES.map(row).into();
    let head = ["N", "chain", "bytes a body", "tree", "bytes a body"];
    // From 10⁴ on: below, starting the program takes the time.
    let exponents = SHAPES.map(|(name, _)| {
        let points = SIZES[1..].iter().map(|&n| ((n as f64).ln(), get("command", name, n).ln()));
        format!("{:.2}", slope(&points.collect::<Vec<_>>()))
    });
    format!(
        "{}\nTime grows as N^p from N = 10⁴ on, p = {} for chains and {} for trees (goal: p ≤ 1.1, 3 s and 1 KB a body at \
         N = 10⁶).\n",
        table(
            "`eigenbody spectrum 'hydra(N,…)' --at 'zag(0)'`, model building and κ′ included",
            &head,
            &rows
        ),
        exponents[0],
        exponents[1],
    )
}

fn counts(figures: &Figures) -> String {
    let row = |name: &str| vec![name.to_owned(), figures.get(&format!("instructions {name}")).to_string()];
    let rows: Vec<_> = figures.names("instructions ").map(row).collect();
    if rows.is_empty() {
        return "Instructions were not counted: Valgrind is not installed.\n".into();
    }
    let title = "Instructions, on AVX2 (sweeps: N = 1000; cold extremes: N = 100; batches: 64 states; else one state)";
    table(title, &["", "instructions"], &rows)
}

/// Of the least-squares line through points.
fn slope(points: &[(f64, f64)]) -> f64 {
    let n = points.len() as f64;
    let (x, y) = points.iter().fold((0.0, 0.0), |(x, y), p| (x + p.0 / n, y + p.1 / n));
    let (xy, xx) = points
        .iter()
        .fold((0.0, 0.0), |(xy, xx), p| (xy + (p.0 - x) * (p.1 - y), xx + (p.0 - x) * (p.0 - x)));
    xy / xx
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_have_three_digits() {
        let times = [62.3e-9, 4.88e-6, 123.4e-6, 2.359e-3, 1.127];
        assert_eq!(times.map(time), ["62.3 ns", "4.88 µs", "123 µs", "2.36 ms", "1.13 s"]);
    }

    #[test]
    fn the_text_goes_between_the_markers() {
        let old = "a\n<!-- begin: written by `cargo xtask x` -->\nold\n<!-- end -->\nb\n";
        let new = "a\n<!-- begin: written by `cargo xtask x` -->\n\nnew\n\n<!-- end -->\nb\n";
        assert_eq!(between(old, "x", "new\n").as_deref(), Some(new));
        assert_eq!(between(old, "y", "new\n"), None);
    }

    #[test]
    fn the_slope_of_a_line() {
        assert!((slope(&[(0.0, 1.0), (1.0, 3.0), (3.0, 7.0)]) - 2.0).abs() < 1e-15);
    }
}

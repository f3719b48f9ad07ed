//! How each experiment of the two papers is drawn: which columns, on which axes, in which looks.

use super::axis::Axis;
use super::mechanism;
use super::plot::{Curve, Panel, Plot};
use super::style::Style;
use eigenbody_study::Table;

const N: &str = "number of links N";
const KAPPA: &str = "condition number κ";
const LAMBDA: &str = "eigenvalue (kg m²)";
const EITHER: &str = "condition number";
const BOTH: &[(&str, &str)] = &[("κ", "kappa"), ("κ′", "kappa_weighted")];
const PLACE: &str = "place in the spectrum, smallest 0, largest 1";
const COORDINATE: &str = "coordinate of the eigenvector";
const TIME: &str = "time (s)";

/// The figure of an experiment as SVG; none for experiments that only have numbers.
///
/// ```
/// use eigenbody_study::{Lab, select};
/// let experiment = select(&["F-fig14"])?[0];
/// let outcome = experiment.run(&Lab::default())?;
/// let svg = eigenbody_report::figure::draw(experiment.id, experiment.title, &outcome.table);
/// assert!(svg.is_some_and(|svg| svg.contains("e₃, N = 20")));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn draw(id: &str, title: &str, table: &Table) -> Option<String> {
    let kappa = |curves| one(Axis::log(N), Axis::log(KAPPA), curves);
    let plot = match id {
        "F-fig6" | "F-fig6-beyond" | "F-fig7" | "F-fig7-beyond" => kappa(curves(table, "N", "kappa")),
        "F-fig8" | "F-fig9" | "F-fig9-beyond" | "F-fig10" => kappa(kinds(table, "N", "kappa")),
        "F-fig11" | "F-fig13" => one(Axis::linear(PLACE), Axis::log(LAMBDA), curves(table, "x", "lambda")),
        "F-fig12" => {
            one(Axis::log("normalised period 1/i"), Axis::log(LAMBDA), curves(table, "period", "lambda"))
        }
        "F-fig14" | "F-fig17" => {
            one(Axis::linear("joint"), Axis::linear(COORDINATE), curves(table, "joint", "coordinate"))
        }
        "F-Imin" => {
            let y = Axis::linear("smallest eigenvalue (kg m²)");
            one(Axis::linear("θ (rad)"), y, curves(table, "theta", "lambda_min"))
        }
        "F-asymptotic" => one(Axis::log(N), Axis::linear("κ / (N H₁₁/Hₙₙ)"), curves(table, "N", "ratio")),
        "F-fig16" => Plot { panels: split(table, "N", "kappa", N, KAPPA), columns: 1 },
        "F-fig18" => one(Axis::log("number of joints N"), Axis::log(KAPPA), kinds(table, "N", "kappa")),
        "F-fig20" => one(Axis::log(N), Axis::log(EITHER), both_metrics(table)),
        "F-fig21" => one(Axis::linear(N), Axis::log(EITHER), both_metrics(table)),
        "S-eq11" => one(Axis::log(N), Axis::log("difference, over the largest entry"), rounding(table)),
        "S-fig2" => swing_of_four(table),
        "S-fig3" => pairs(table, &[("kappa", KAPPA), ("delta", "diagonal ratio δ")]),
        "S-fig4" => pairs(table, &[("pivot_ratio", "pivot ratio"), ("kappa", KAPPA)]),
        "S-fig5" => overlaid(table),
        "S-beyond-swing" => one(Axis::linear(TIME), Axis::log(EITHER), estimators(table, None, "t")),
        "S-beyond-robots" => robots(table),
        "F-fig1" | "F-fig5" | "F-fig15" | "F-fig19" | "S-fig1" => {
            return Some(mechanism::planar(table, title));
        }
        "F-fig2" => return Some(mechanism::tree(table, title)),
        "F-fig3" => return Some(mechanism::link(table, title)),
        "F-fig4" => return Some(mechanism::shells(table, title)),
        _ => return None,
    };
    Some(plot.svg(title))
}

/// What is drawn of a figure of κ against N.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Growth {
    /// What N counts.
    pub x: &'static str,
    /// Whether N is drawn by its logarithm.
    pub log: bool,
    /// What is drawn against it, by its logarithm.
    pub y: &'static str,
    /// A symbol and a column for each.
    pub columns: &'static [(&'static str, &'static str)],
}

/// The figures of κ against N: for a page that draws them itself. Each row of their tables is about one robot.
pub fn growth(id: &str) -> Option<Growth> {
    let kappa = Growth { x: N, log: true, y: KAPPA, columns: &[("κ", "kappa")] };
    Some(match id {
        "F-fig6" | "F-fig7" | "F-fig8" | "F-fig9" | "F-fig10" | "F-fig16" => kappa,
        "F-fig18" => Growth { x: "number of joints N", ..kappa },
        "F-fig20" => Growth { y: EITHER, columns: BOTH, ..kappa },
        "F-fig21" => Growth { y: EITHER, columns: BOTH, log: false, ..kappa },
        _ => return None,
    })
}

fn one(x: Axis, y: Axis, curves: Vec<Curve>) -> Plot {
    Plot { panels: vec![Panel { title: String::new(), x, y, curves }], columns: 1 }
}

/// A curve for every word in the column `curve`.
fn curves(table: &Table, x: &str, y: &str) -> Vec<Curve> {
    let names = table.distinct("curve").into_iter().enumerate();
    let curve = |(k, name): (usize, &str)| Curve {
        name: name.to_owned(),
        points: table.points("curve", name, x, y),
        // An eighth curve takes the first one's colour with another dash.
        style: if k < 7 {
            Style::nth(k)
        } else {
            Style { marker: Style::nth(k - 6).marker, ..Style::of_kind(k - 7, 1) }
        },
    };
    names.map(curve).collect()
}

/// Curves named `kind, parameter`: looks follow both.
fn kinds(table: &Table, x: &str, y: &str) -> Vec<Curve> {
    let (mut found_kinds, mut parameters) = (Vec::new(), Vec::new());
    let place = |list: &mut Vec<String>, word: &str| {
        list.iter().position(|other| other == word).unwrap_or_else(|| {
            list.push(word.to_owned());
            list.len() - 1
        })
    };
    let mut curves = Vec::new();
    for name in table.distinct("curve") {
        let (kind, parameter) = name.split_once(", ").unwrap_or(("", name));
        let style = Style::of_kind(place(&mut parameters, parameter), place(&mut found_kinds, kind));
        curves.push(Curve { name: name.to_owned(), points: table.points("curve", name, x, y), style });
    }
    curves
}

/// A panel for every kind of curves named `kind, parameter`.
fn split(table: &Table, x: &str, y: &str, x_label: &str, y_label: &str) -> Vec<Panel> {
    let mut panels: Vec<Panel> = Vec::new();
    for name in table.distinct("curve") {
        let (kind, parameter) = name.split_once(", ").unwrap_or(("", name));
        if panels.last().is_none_or(|panel| panel.title != kind) {
            let (x, y) = (Axis::log(x_label), Axis::log(y_label));
            panels.push(Panel { title: kind.to_owned(), x, y, curves: Vec::new() });
        }
        if let Some(panel) = panels.last_mut() {
            let style = Style::nth(panel.curves.len());
            panel.curves.push(Curve {
                name: parameter.to_owned(),
                points: table.points("curve", name, x, y),
                style,
            });
        }
    }
    panels
}

/// κ solid with filled marks, κ′ dashed with open ones.
fn both_metrics(table: &Table) -> Vec<Curve> {
    let mut curves = Vec::new();
    for (k, name) in table.distinct("curve").into_iter().enumerate() {
        for (kind, &(symbol, column)) in BOTH.iter().enumerate() {
            let points = table.points("curve", name, "N", column);
            curves.push(Curve { name: format!("{symbol}, {name}"), points, style: Style::of_kind(k, kind) });
        }
    }
    curves
}

/// Points of two columns of numbers, where both are there.
fn columns(table: &Table, x: &str, y: &str) -> Vec<(f64, f64)> {
    table.number(x).iter().zip(table.number(y)).filter_map(|(&x, &y)| x.zip(y)).collect()
}

fn rounding(table: &Table) -> Vec<Curve> {
    let names = [
        ("entries_apart", "matrix, CRBA"),
        ("reconstruction_apart", "U D Uᵀ"),
        ("solve_apart", "solve, ABA"),
    ];
    let curve = |(k, (column, name)): (usize, (&str, &str))| Curve {
        name: name.into(),
        points: columns(table, "N", column),
        style: Style::nth(k).points(),
    };
    names.into_iter().enumerate().map(curve).collect()
}

fn swing_of_four(table: &Table) -> Plot {
    let four = |names: [(&str, &str); 4]| -> Vec<Curve> {
        let curve = |(k, (column, name)): (usize, (&str, &str))| Curve {
            name: name.into(),
            points: columns(table, "t", column),
            style: Style::nth(k),
        };
        names.into_iter().enumerate().map(curve).collect()
    };
    let single = |column: &str| {
        vec![Curve { name: String::new(), points: columns(table, "t", column), style: Style::nth(0).plain() }]
    };
    let panel = |title: &str, y: Axis, curves: Vec<Curve>| Panel {
        title: title.into(),
        x: Axis::linear(TIME),
        y,
        curves,
    };
    let lambda = four([("lambda_1", "λ₁"), ("lambda_2", "λ₂"), ("lambda_3", "λ₃"), ("lambda_4", "λ₄")]);
    let diagonal = four([("I_11", "I₁₁"), ("I_22", "I₂₂"), ("I_33", "I₃₃"), ("I_44", "I₄₄")]);
    let panels = vec![
        panel("(a) eigenvalues", Axis::log(LAMBDA), lambda),
        panel("(b) diagonal elements", Axis::log("element (kg m²)"), diagonal),
        panel("(c) condition number", Axis::linear(KAPPA), single("kappa")),
        panel("(d) diagonal ratio", Axis::linear("diagonal ratio δ"), single("delta")),
    ];
    Plot { panels, columns: 2 }
}

/// For every number of links a row of panels, one a column.
fn pairs(table: &Table, shown: &[(&str, &str)]) -> Plot {
    let mut panels = Vec::new();
    for name in table.distinct("curve") {
        for &(column, label) in shown {
            let points = table.points("curve", name, "t", column);
            let letter = char::from(b'a' + panels.len() as u8);
            panels.push(Panel {
                title: format!("({letter}) {name}: {label}"),
                x: Axis::linear(TIME),
                y: Axis::linear(label),
                curves: vec![Curve { name: String::new(), points, style: Style::nth(0).plain() }],
            });
        }
    }
    Plot { panels, columns: shown.len() }
}

/// κ and δₛ over each other, a panel for every number of links.
fn overlaid(table: &Table) -> Plot {
    let panel = |(k, name): (usize, &str)| {
        let curve = |k: usize, column: &str, label: &str| Curve {
            name: label.into(),
            points: table.points("curve", name, "t", column),
            style: Style::nth(k),
        };
        Panel {
            title: format!("({}) {name}", char::from(b'a' + k as u8)),
            x: Axis::linear(TIME),
            y: Axis::linear(EITHER),
            curves: vec![curve(0, "kappa", "κ"), curve(1, "delta_scaled", "scaled diagonal ratio δₛ")],
        }
    };
    Plot { panels: table.distinct("curve").into_iter().enumerate().map(panel).collect(), columns: 1 }
}

/// κ, what estimates it, and its bracket.
fn estimators(table: &Table, robot: Option<&str>, x: &str) -> Vec<Curve> {
    let shown = [
        ("lower", "r, the bracket's lower end", Style { dashes: "2 3", ..Style::nth(2) }.plain()),
        ("upper", "r κ′, its upper end", Style { dashes: "9 3 2 3", ..Style::nth(2) }.plain()),
        ("pivot_ratio", "pivot ratio", Style { dashes: "5 3", ..Style::nth(3) }.plain()),
        ("delta_scaled", "scaled diagonal ratio δₛ", Style { dashes: "", ..Style::nth(1) }),
        ("kappa", "κ", Style::nth(0).plain()),
    ];
    let points = |column: &str| match robot {
        Some(robot) => table.points("robot", robot, x, column),
        None => columns(table, x, column),
    };
    shown
        .into_iter()
        .map(|(column, name, style)| Curve { name: name.into(), points: points(column), style })
        .collect()
}

fn robots(table: &Table) -> Plot {
    let panel = |name: &str| {
        let mut curves = estimators(table, Some(name), "rank");
        for (curve, name) in curves.iter_mut().zip(["r", "r κ′", "pivots", "δₛ", "κ"]) {
            curve.name = name.into();
            if name == "δₛ" {
                curve.style = curve.style.points();
            }
        }
        Panel {
            title: name.to_owned(), x: Axis::linear("configuration, by κ"), y: Axis::log(EITHER), curves
        }
    };
    Plot { panels: table.distinct("robot").into_iter().map(panel).collect(), columns: 2 }
}

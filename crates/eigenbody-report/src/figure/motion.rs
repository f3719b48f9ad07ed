//! Quantities over time.

use super::axis::Axis;
use super::plot::{Curve, Panel, Plot};
use super::style::Style;

/// One quantity along a motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Series<'a> {
    /// Its name.
    pub name: &'a str,
    /// Its unit; `1` for a pure number.
    pub unit: &'a str,
    /// One number a time; those that are not finite leave a gap.
    pub values: &'a [f64],
}

/// Points along a curve that can be told apart on paper.
const POINTS: usize = 1500;

/// Quantities over time as SVG, one panel a unit: energies on even axes, all others on logarithmic ones.
///
/// ```
/// use eigenbody_report::figure::{Series, motion};
/// let svg = motion("arm", &[0.0, 0.5, 1.0], &[Series { name: "kappa", unit: "1", values: &[10.0, 20.0, 15.0] }]);
/// assert!(svg.contains("time (s)") && svg.contains("κ"));
/// ```
pub fn motion(title: &str, times: &[f64], series: &[Series<'_>]) -> String {
    let mut units: Vec<&str> = Vec::new();
    for one in series {
        if !units.contains(&one.unit) {
            units.push(one.unit);
        }
    }
    let every = times.len().div_ceil(POINTS).max(1);
    let panel = |unit: &&str| {
        let of_unit = || series.iter().filter(|one| one.unit == *unit);
        let is_even = *unit == "J";
        let words = if *unit == "1" { String::new() } else { format!(" ({})", pretty(unit)) };
        let label = match of_unit().count() {
            1 => format!("{}{words}", of_unit().map(|one| name(one.name)).collect::<String>()),
            _ if is_even => format!("energy{words}"),
            _ if *unit == "1" => "ratio".to_owned(),
            _ => format!("eigenvalue{words}"),
        };
        let curve = |(k, one): (usize, &Series<'_>)| {
            let points = times.iter().zip(one.values).step_by(every).map(|(&t, &x)| (t, x));
            let name = if of_unit().count() > 1 { name(one.name) } else { String::new() };
            Curve {
                name,
                points: points.filter(|(_, x)| x.is_finite()).collect(),
                style: Style::nth(k).plain(),
            }
        };
        Panel {
            title: String::new(),
            x: Axis::linear("time (s)"),
            y: if is_even { Axis::linear(label) } else { Axis::log(label) },
            curves: of_unit().enumerate().map(curve).collect(),
        }
    };
    Plot { panels: units.iter().map(panel).collect(), columns: 1 }.svg(title)
}

fn pretty(unit: &str) -> String {
    unit.replace("^2", "²")
}

fn name(name: &str) -> String {
    match name {
        "kappa" => "κ",
        "kappa_weighted" => "κ′",
        "lambda_min" => "λmin",
        "lambda_max" => "λmax",
        "diagonal_ratio" => "diagonal ratio r",
        "scaled_diagonal_ratio" => "scaled diagonal ratio",
        "pivot_ratio" => "pivot ratio",
        "bracket_lo" => "bracket, r",
        "bracket_hi" => "bracket, r κ′",
        "kinetic_energy" => "kinetic",
        "potential_energy" => "potential",
        "energy" => "total",
        other => other,
    }
    .to_owned()
}

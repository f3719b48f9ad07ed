//! What most figures are: κ against N, a curve a parameter.

use crate::lab::{Lab, StudyError};
use crate::table::{Rows, Table};
use eigenbody::{Family, Posture, family::FamilyError};
use rayon::prelude::*;

/// Numbers of the E12 series.
const E12: [usize; 12] = [10, 12, 15, 18, 22, 27, 33, 39, 47, 56, 68, 82];

/// 1 to 8, then E12 to `last`: the paper's sample set.
pub fn samples(last: usize) -> Vec<usize> {
    let series = (0..6).flat_map(|decade| E12.map(|n| n * 10usize.pow(decade)));
    (1..=8).chain(series).filter(|&n| n <= last).collect()
}

/// A robot for every N.
pub type Member<'a> = &'a (dyn Fn(usize) -> Result<Family, FamilyError> + Sync);

/// The same, owned: for members that remember a parameter.
pub type OwnedMember = Box<dyn Fn(usize) -> Result<Family, FamilyError> + Sync>;

/// One curve: its name and parameter, its robots, their posture, where it ends.
pub struct Curve<'a> {
    pub name: String,
    pub parameter: f64,
    pub member: Member<'a>,
    pub posture: Posture,
    pub samples: Vec<usize>,
}

/// κ of every curve's robots, rows in the curves' order. `parameter` names the column of parameters and its unit.
pub fn kappa_curves(
    lab: &Lab<'_>,
    parameter: (&'static str, &'static str),
    curves: &[Curve<'_>],
) -> Result<Table, StudyError> {
    let mut points: Vec<(usize, usize)> =
        curves.iter().enumerate().flat_map(|(c, curve)| curve.samples.iter().map(move |&n| (c, n))).collect();
    let rows = points.clone();
    // The largest first, so that no core waits for a last long one.
    points.sort_by_key(|&(c, n)| (std::cmp::Reverse(n), c));
    let found: Result<std::collections::BTreeMap<(usize, usize), f64>, StudyError> = points
        .into_par_iter()
        .with_max_len(1)
        .map(|(c, n)| Ok(((c, n), lab.kappa(&(curves[c].member)(n)?, curves[c].posture)?)))
        .collect();
    let found = found?;
    let mut table = Rows::new(&[("curve", "")], &[parameter, ("N", "1"), ("kappa", "1")]);
    for (c, n) in rows {
        let Curve { name, parameter, member, posture, .. } = &curves[c];
        table.push([name.clone()], [Some(*parameter), Some(n as f64), found.get(&(c, n)).copied()]);
        table.about(member(n)?, *posture);
    }
    Ok(table.into())
}

/// Planar chain of identical links.
pub fn planar(n: usize) -> Result<Family, FamilyError> {
    Family::hydra(n, 1.0, 0.0, 1.0)
}

/// y at x of one curve of a table of κ.
pub fn at(points: &[(f64, f64)], x: usize) -> f64 {
    points.iter().find(|point| point.0 == x as f64).map_or(f64::NAN, |point| point.1)
}

/// θ as the name of a curve.
pub fn theta(angle: f64) -> String {
    format!("θ = {}", angle_text(angle))
}

/// An angle, multiples of π/2 by name.
pub fn angle_text(angle: f64) -> String {
    use std::f64::consts::{FRAC_PI_2, PI};
    match angle {
        PI => "π".into(),
        FRAC_PI_2 => "π/2".into(),
        _ => format!("{angle}"),
    }
}

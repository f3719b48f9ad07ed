//! The inertia-weighted metric: figures 20 and 21, and the matrices H′.

use super::curves::{planar, samples, theta};
use super::sizes::decimal;
use crate::claim::{Check, Reading};
use crate::experiment::Outcome;
use crate::fit::line;
use crate::lab::{Lab, StudyError};
use crate::table::{Rows, Table};
use eigenbody::{Family, Posture};
use rayon::prelude::*;

/// κ and κ′ of robots, in parallel; a row holds the parameter, N, κ and κ′.
fn both(
    lab: &Lab<'_>,
    parameter: (&'static str, &'static str),
    robots: Vec<(String, f64, usize, Family, Posture)>,
) -> Result<Table, StudyError> {
    let rows: Result<Vec<_>, StudyError> = robots
        .into_par_iter()
        .with_max_len(1)
        .map(|(name, value, n, family, posture)| {
            let posed = lab.pose(&family, posture)?;
            let numbers = [value, n as f64, posed.ends()?.kappa(), posed.kappa_weighted()?];
            Ok((name, numbers, family, posture))
        })
        .collect();
    let numbers = [parameter, ("N", "1"), ("kappa", "1"), ("kappa_weighted", "1")];
    let mut table = Rows::new(&[("curve", "")], &numbers);
    for (name, numbers, family, posture) in rows? {
        table.push([name], numbers.map(Some));
        table.about(family, posture);
    }
    Ok(table.into())
}

/// Figure 20: κ and κ′ of hydra(N,1,0,1) in zag(θ).
///
/// # Errors
///
/// [`StudyError`], as every experiment.
pub fn fig20(lab: &Lab<'_>) -> Result<Outcome, StudyError> {
    let mut robots = Vec::new();
    for angle in [0.0, 2.5, 3.0, std::f64::consts::PI] {
        for n in samples(560) {
            robots.push((theta(angle), angle, n, planar(n)?, Posture::Zag(angle)));
        }
    }
    let table = both(lab, ("theta", "rad"), robots)?;
    let ratio = |n: usize| {
        let at = |column| super::curves::at(&table.points("curve", "θ = 0", "N", column), n);
        at("kappa_weighted") / at("kappa")
    };
    let all: Vec<f64> = table
        .number("kappa_weighted")
        .iter()
        .zip(table.number("kappa"))
        .filter_map(|(weighted, kappa)| Some((*weighted)? / (*kappa)?))
        .collect();
    let shape = vec![
        Check::within("κ′/κ at θ = 0, N = 2", ratio(2), 0.33, 0.41),
        Check::within("κ′/κ at θ = 0, N = 5", ratio(5), 0.55, 0.65),
        Check::within("κ′/κ at θ = 0, N = 15", ratio(15), 1.3, 1.5),
        Check::within("κ′/κ at θ = 0, N = 100", ratio(100), 2.5, 2.8),
        Check::within("smallest κ′/κ anywhere", all.iter().copied().fold(f64::NAN, f64::min), 0.2, 1.0),
        Check::within("largest κ′/κ anywhere", all.iter().copied().fold(f64::NAN, f64::max), 1.0, 4.0),
    ];
    Ok(Outcome::new(table, vec![Reading::shape("F-fig20", shape)]))
}

/// Figure 21: κ and κ′ of hydra(N,1,0,ρ) at curl(0).
///
/// # Errors
///
/// [`StudyError`], as every experiment.
pub fn fig21(lab: &Lab<'_>) -> Result<Outcome, StudyError> {
    let mut robots = Vec::new();
    for taper in [0.5f64, 0.7, 0.9, 1.0] {
        let last = match taper {
            1.0 => 100,
            _ => ((15.5 / -taper.log10() / 5.0) as usize).min(100),
        };
        for n in (1..=last).filter(|&n| n <= 20 || samples(100).contains(&n)) {
            let family = Family::hydra(n, 1.0, 0.0, decimal(taper))?;
            robots.push((format!("ρ = {taper}"), taper, n, family, Posture::Curl(0.0)));
        }
    }
    let table = both(lab, ("rho", "1"), robots)?;
    let log: Vec<(f64, f64)> = table
        .points("curve", "ρ = 0.7", "N", "kappa")
        .into_iter()
        .filter(|point| point.0 >= 8.0)
        .map(|(n, kappa)| (n, kappa.log10()))
        .collect();
    let weighted = |taper: f64, n: usize| -> Result<f64, StudyError> {
        lab.pose(&Family::hydra(n, 1.0, 0.0, decimal(taper))?, Posture::Curl(0.0))?.kappa_weighted()
    };
    let per_link = -5.0 * 0.7f64.log10();
    let shape = vec![
        Check::slope(
            "powers of ten of κ a link, ρ = 0.7, N = 8 on (5 log 1/ρ = 0.775)",
            line(&log),
            per_link,
            1.15 * per_link,
        ),
        Check::within(
            "κ′ at N = 40 over N = 20, ρ = 0.5",
            weighted(0.5, 40)? / weighted(0.5, 20)?,
            1.0,
            1.05,
        ),
        Check::within(
            "κ′ at N = 80 over N = 40, ρ = 0.7",
            weighted(0.7, 80)? / weighted(0.7, 40)?,
            1.0,
            1.05,
        ),
        Check::within("κ′ at N = 19, ρ = 0.5", weighted(0.5, 19)?, 16.2, 16.4),
        Check::within("κ′ at N = 19, ρ = 0.7", weighted(0.7, 19)?, 186.0, 187.5),
    ];
    Ok(Outcome::new(table, vec![Reading::shape("F-fig21", shape)]))
}

/// The matrices H′ = D H D, d_i = H_ii^(−1/2), for ρ = 1 and ρ = 0.5.
///
/// # Errors
///
/// [`StudyError`], as every experiment.
pub fn h_prime(lab: &Lab<'_>) -> Result<Outcome, StudyError> {
    let numbers = [("row", "1"), ("column", "1"), ("entry", "1")];
    let mut table = Rows::new(&[("matrix", "")], &numbers);
    let mut readings = Vec::new();
    for (id, taper) in [("F-Hprime-1", 1.0), ("F-Hprime-half", 0.5)] {
        let H = lab.pose(&Family::hydra(5, 1.0, 0.0, taper)?, Posture::Curl(0.0))?.mass_matrix()?;
        let mut entries = Vec::new();
        for i in 0..5 {
            for j in 0..5 {
                let entry = H[(i, j)] / (H[(i, i)] * H[(j, j)]).sqrt();
                entries.push(entry);
                table.push([format!("ρ = {taper}")], [i as f64 + 1.0, j as f64 + 1.0, entry].map(Some));
            }
        }
        readings.push(Reading::new(id, entries, Vec::new()));
    }
    Ok(Outcome::new(table, readings))
}

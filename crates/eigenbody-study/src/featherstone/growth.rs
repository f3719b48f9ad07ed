//! κ against the number of identical links: figures 6, 7 and 8.

use super::curves::{Curve, at, kappa_curves, planar, samples, theta};
use crate::claim::{Check, Reading};
use crate::experiment::Outcome;
use crate::fit::power;
use crate::lab::{Lab, StudyError};
use crate::table::{Rows, Table};
use eigenbody::{Family, Posture};
use std::f64::consts::PI;

/// The paper's range of N.
const LAST: usize = 560;
/// Beyond the paper.
const LONG: usize = 100_000;
const MILLION: usize = 1_000_000;

fn zigzags(lab: &Lab<'_>, angles: &[f64], samples: &[usize]) -> Result<Table, StudyError> {
    postures(lab, angles, samples, Posture::Zag)
}

fn postures(
    lab: &Lab<'_>,
    angles: &[f64],
    samples: &[usize],
    posture: fn(f64) -> Posture,
) -> Result<Table, StudyError> {
    let curves: Vec<Curve<'_>> = angles
        .iter()
        .map(|&angle| Curve {
            name: theta(angle),
            parameter: angle,
            member: &planar,
            posture: posture(angle),
            samples: samples.to_vec(),
        })
        .collect();
    kappa_curves(lab, ("theta", "rad"), &curves)
}

/// Figure 6: κ of hydra(N,1,0,1) in zag(θ).
///
/// # Errors
///
/// [`StudyError`], as every experiment.
pub fn fig6(lab: &Lab<'_>) -> Result<Outcome, StudyError> {
    let table = zigzags(lab, &[0.0, 1.5, 2.5, 2.8, 3.0, 3.1, PI], &samples(LAST))?;
    let straight = table.points("curve", "θ = 0", "N", "kappa");
    let folded = table.points("curve", "θ = 3", "N", "kappa");
    let flat = table.points("curve", "θ = π", "N", "kappa");
    let steep = power(&straight, 100.0, 560.0);
    let (early, late) = (power(&folded, 3.0, 8.0), power(&folded, 100.0, 560.0));
    let worst = |n: usize| at(&straight, n) / (4.0 * (n as f64).powi(4));
    let values = [2, 3, 10, 39].map(|n| at(&straight, n));
    let forty = lab.kappa(&planar(40)?, Posture::Zag(0.0))?;
    let crossing = 10f64.powf(early.meets(&late));
    let singular = (1.0 / (4.0 * f64::EPSILON)).powf(0.25);
    let shape = vec![
        Check::slope("slope at θ = 0, N = 100 to 560", steep, 3.9, 4.05),
        Check::slope("slope at θ = 3.0, N = 3 to 8", early, 1.8, 2.2),
        Check::slope("slope at θ = 3.0, N = 100 to 560", late, 3.9, 4.1),
        Check::slope("slope at θ = π, N = 100 to 560", power(&flat, 100.0, 560.0), 1.95, 2.05),
        Check::within("N where the two lines at θ = 3.0 meet (sec(θ/2) = 14.1)", crossing, 11.0, 18.0),
        Check::within("κ/(4 N⁴) at θ = 0, N = 10", worst(10), 0.9, 1.1),
        Check::within("κ/(4 N⁴) at θ = 0, N = 100", worst(100), 0.9, 1.1),
        Check::within("κ/(4 N⁴) at θ = 0, N = 560", worst(560), 0.9, 1.1),
        Check::within("N where 4 N⁴ = 1/ε in double precision (about 6000)", singular, 5500.0, 6500.0),
        Check::within("curves above θ = 0 anywhere", above(&table, &straight), 0.0, 0.0),
    ];
    let computed = vec![values[0], values[1], values[2], forty];
    let readings = vec![Reading::shape("F-fig6", shape), Reading::new("F-fig6-values", computed, Vec::new())];
    Ok(Outcome::new(table, readings))
}

/// How many points of a table lie above a curve of the same samples.
fn above(table: &Table, curve: &[(f64, f64)]) -> f64 {
    let names = table.distinct("curve");
    let points = names.iter().flat_map(|name| table.points("curve", name, "N", "kappa"));
    points.filter(|&(n, kappa)| kappa > at(curve, n as usize) * (1.0 + 1e-12)).count() as f64
}

/// Samples of the figures that go beyond: to a million links, or to a hundred thousand; to ten thousand in a quick run.
fn far(lab: &Lab<'_>, last: usize) -> Vec<usize> {
    let last = if lab.quick { 10_000 } else { last };
    let mut found: Vec<usize> =
        samples(LAST).into_iter().filter(|&n| n <= 8 || n % 10 == 0 || n < 100).collect();
    let beyond = [1000, 1800, 3300, 5600, 10_000, 18_000, 33_000, 56_000, 100_000, MILLION];
    found.extend(beyond.into_iter().filter(|&n| n <= last));
    found
}

/// Curves beyond the paper: those angles that say so go to a million.
fn beyond(
    lab: &Lab<'_>,
    angles: [(f64, usize); 4],
    posture: fn(f64) -> Posture,
) -> Result<Table, StudyError> {
    let curve = |(angle, last): (f64, usize)| Curve {
        name: theta(angle),
        parameter: angle,
        member: &planar,
        posture: posture(angle),
        samples: far(lab, last),
    };
    kappa_curves(lab, ("theta", "rad"), &angles.map(curve))
}

/// Figure 6 continued to N = 10⁶.
///
/// # Errors
///
/// [`StudyError`], as every experiment.
pub fn fig6_beyond(lab: &Lab<'_>) -> Result<Outcome, StudyError> {
    let table = beyond(lab, [(0.0, MILLION), (3.0, LONG), (3.1, MILLION), (PI, LONG)], Posture::Zag)?;
    Ok(straightness(table, "θ = 0"))
}

/// Figure 7: κ of hydra(N,1,0,1) in curl(θ).
///
/// # Errors
///
/// [`StudyError`], as every experiment.
pub fn fig7(lab: &Lab<'_>) -> Result<Outcome, StudyError> {
    let table = postures(lab, &[0.0, 0.03, 0.1, 0.3, 1.0, 2.2], &samples(LAST), Posture::Curl)?;
    let arc = table.points("curve", "θ = 0.1", "N", "kappa");
    let local: Vec<(f64, f64)> =
        arc.windows(2).map(|pair| (pair[1].0, power(pair, 1.0, 1e9).slope)).collect();
    let circle = 2.0 * PI / 0.1;
    let first_rise = local.windows(2).find(|pair| pair[0].0 > circle / 2.0 && pair[1].1 > pair[0].1);
    let minimum = first_rise.map_or((f64::NAN, f64::NAN), |pair| pair[0]);
    let after: Vec<(f64, f64)> = local.iter().copied().filter(|point| point.0 > minimum.0).collect();
    let overshoot = after.iter().map(|point| point.1).fold(f64::NAN, f64::max);
    let wound = table.points("curve", "θ = 1", "N", "kappa");
    let shape = vec![
        Check::slope("slope at θ = 0.1, N = 6 to 18", power(&arc, 6.0, 18.0), 3.5, 4.1),
        Check::within("slope at θ = 0.1 past a semicircle, N = 33 to 39", slope_at(&local, 39), 1.5, 3.3),
        Check::within(
            "N of the first minimum of the slope at θ = 0.1 (circle at 62.8)",
            minimum.0,
            circle,
            1.4 * circle,
        ),
        Check::within("that slope", minimum.1, 0.0, 1.2),
        Check::within("largest slope after it: an undulation about 2", overshoot, 1.9, 2.9),
        Check::slope("slope at θ = 1, N = 100 to 560", power(&wound, 100.0, 560.0), 1.9, 2.1),
    ];
    Ok(Outcome::new(table, vec![Reading::shape("F-fig7", shape)]))
}

/// A remark on the slope at the far end of a curve.
fn straightness(table: Table, name: &str) -> Outcome {
    let points = table.points("curve", name, "N", "kappa");
    let (last, kappa) = points.last().copied().unwrap_or((f64::NAN, f64::NAN));
    let line = power(&points, 0.01 * last, last);
    let remark = format!(
        "{name}: slope {:.4} ± {:.4} over the last two decades, κ = {kappa:.10e} at N = {last}.",
        line.slope, line.half_width
    );
    Outcome::new(table, Vec::new()).remarking(remark)
}

fn slope_at(local: &[(f64, f64)], n: usize) -> f64 {
    at(local, n)
}

/// Figure 7 continued to N = 10⁶.
///
/// # Errors
///
/// [`StudyError`], as every experiment.
pub fn fig7_beyond(lab: &Lab<'_>) -> Result<Outcome, StudyError> {
    let table = beyond(lab, [(0.001, MILLION), (0.01, LONG), (0.1, LONG), (1.0, MILLION)], Posture::Curl)?;
    Ok(straightness(table, "θ = 1"))
}

/// Figure 8: spatial chains beside planar ones in zag(θ).
///
/// # Errors
///
/// [`StudyError`], as every experiment.
pub fn fig8(lab: &Lab<'_>) -> Result<Outcome, StudyError> {
    let spatial = |n: usize| Family::hydra(n, 1.0, 0.5, 1.0);
    let mut curves = Vec::new();
    for angle in [0.0, 2.5, 3.0] {
        for (skew, member) in [("planar", &planar as super::curves::Member<'_>), ("spatial", &spatial)] {
            let posture = Posture::Zag(angle);
            let name = format!("{skew}, {}", theta(angle));
            curves.push(Curve { name, parameter: angle, member, posture, samples: samples(LAST) });
        }
    }
    let table = kappa_curves(lab, ("theta", "rad"), &curves)?;
    let curve =
        |kind: &str, angle: f64| table.points("curve", &format!("{kind}, {}", theta(angle)), "N", "kappa");
    let ratio = |angle: f64, from: f64, to: f64| -> Vec<f64> {
        let both = curve("planar", angle).into_iter().zip(curve("spatial", angle));
        both.filter(|(p, _)| (from..=to).contains(&p.0)).map(|(p, s)| p.1 / s.1).collect()
    };
    let largest = |ratios: &[f64]| ratios.iter().copied().fold(f64::NAN, f64::max);
    let smallest = |ratios: &[f64]| ratios.iter().copied().fold(f64::NAN, f64::min);
    let (steep, folded) = (ratio(0.0, 2.0, 560.0), ratio(3.0, 2.0, 10.0));
    let shape = vec![
        Check::within("largest planar/spatial at θ = 0", largest(&steep), 2.3, 2.55),
        Check::within("smallest planar/spatial at θ = 0", smallest(&steep), 1.0, 2.0),
        Check::within(
            "largest planar/spatial at θ = 3.0, N = 2 to 10 (N² slope)",
            largest(&folded),
            1.0,
            1.3,
        ),
        Check::slope(
            "spatial slope at θ = 0, N = 100 to 560",
            power(&curve("spatial", 0.0), 100.0, 560.0),
            3.9,
            4.05,
        ),
        Check::slope(
            "spatial slope at θ = 3.0, N = 3 to 8",
            power(&curve("spatial", 3.0), 3.0, 8.0),
            1.8,
            2.2,
        ),
    ];
    Ok(Outcome::new(table, vec![Reading::shape("F-fig8", shape)]))
}

/// κ against N·H₁₁/H_NN, the asymptotic formula of §4.4, in several postures.
///
/// # Errors
///
/// [`StudyError`], as every experiment.
pub fn asymptotic(lab: &Lab<'_>) -> Result<Outcome, StudyError> {
    let numbers = [("N", "1"), ("kappa", "1"), ("estimate", "1"), ("ratio", "1")];
    let mut table = Rows::new(&[("curve", "")], &numbers);
    let mut shape = Vec::new();
    for posture in [Posture::Zag(0.0), Posture::Zag(2.5), Posture::Curl(0.3), Posture::Curl(1.0)] {
        let name = posture.to_string();
        for n in samples(LAST) {
            let posed = lab.pose(&planar(n)?, posture)?;
            let (diagonal, kappa) = (posed.diagonal()?, posed.ends()?.kappa());
            let estimate = n as f64 * diagonal[0] / diagonal[n - 1];
            let row = [n as f64, kappa, estimate, kappa / estimate];
            table.push([name.clone()], row.map(Some));
        }
        let points = table.points("curve", &name, "estimate", "kappa");
        let late: Vec<(f64, f64)> = points[points.len().saturating_sub(10)..].to_vec();
        shape.push(Check::slope(
            format!("exponent of κ in N H₁₁/H_NN, {name}, last ten N"),
            power(&late, 0.0, f64::INFINITY),
            0.95,
            1.05,
        ));
    }
    Ok(Outcome::new(table, vec![Reading::shape("F-asymptotic", shape)]))
}

//! Trees: figures 16 and 17.

use super::curves::{Curve, OwnedMember, at, kappa_curves, samples};
use crate::claim::{Check, Reading};
use crate::experiment::Outcome;
use crate::fit::power;
use crate::lab::{Lab, StudyError};
use crate::table::Rows;
use eigenbody::{Family, Posture};

/// Branching factors.
const FACTORS: [f64; 7] = [1.0, 1.125, 1.25, 1.5, 2.0, 3.0, 4.0];
/// The closed form for B = 1, α = 0: eigenvalues 1/(4 sin²((2k−1)π/(4N+2))).
fn circular(n: usize) -> f64 {
    let value = |k: usize| {
        let s = ((2 * k - 1) as f64 * std::f64::consts::PI / (4 * n + 2) as f64).sin();
        1.0 / (4.0 * s * s)
    };
    value(1) / value(n)
}

/// Figure 16: onion(N,B,α,1) for α = 0, where κ does not depend on q, and for α = 1 at q = 0.
///
/// # Errors
///
/// [`StudyError`], as every experiment.
pub fn fig16(lab: &Lab<'_>) -> Result<Outcome, StudyError> {
    let mut members: Vec<(String, f64, OwnedMember)> = Vec::new();
    for skew in [0.0, 1.0] {
        for factor in FACTORS {
            let member = move |n| Family::onion(n, factor, skew, 1.0);
            members.push((format!("α = {skew}, B = {factor}"), factor, Box::new(member)));
        }
    }
    let curves: Vec<Curve<'_>> = members
        .iter()
        .map(|(name, factor, member)| Curve {
            name: name.clone(),
            parameter: *factor,
            member: &**member,
            posture: Posture::Zero,
            samples: samples(560),
        })
        .collect();
    let table = kappa_curves(lab, ("B", "1"), &curves)?;
    let curve =
        |skew: f64, factor: f64| table.points("curve", &format!("α = {skew}, B = {factor}"), "N", "kappa");
    let value = |skew: f64, factor: f64, n: usize| at(&curve(skew, factor), n);
    let lowest = |skew: f64, n: usize| -> f64 {
        FACTORS
            .into_iter()
            .min_by(|&a, &b| value(skew, a, n).total_cmp(&value(skew, b, n)))
            .unwrap_or(f64::NAN)
    };
    let slope = |factor: f64| power(&curve(0.0, factor), 100.0, 560.0);
    let spread = value(0.0, 4.0, 560) / value(0.0, 2.0, 560);
    let shape = vec![
        Check::slope("slope for B = 1, α = 0, N = 100 to 560", slope(1.0), 1.98, 2.01),
        Check::within(
            "κ for B = 1, α = 0, N = 560 over its closed form",
            value(0.0, 1.0, 560) / circular(560),
            1.0 - 1e-12,
            1.0 + 1e-12,
        ),
        Check::slope("slope for B = 1.5", slope(1.5), 0.9, 1.2),
        Check::slope("slope for B = 2", slope(2.0), 0.9, 1.15),
        Check::slope("slope for B = 4", slope(4.0), 0.9, 1.15),
        Check::within("B of the lowest curve at N = 220, α = 0", lowest(0.0, 220), 2.0, 2.0),
        Check::within("κ for B = 4 over B = 2 at N = 560", spread, 1.0, 1.2),
        Check::within(
            "κ for α = 1 over α = 0, B = 1, N = 220",
            value(1.0, 1.0, 220) / value(0.0, 1.0, 220),
            0.2,
            0.95,
        ),
        Check::within(
            "κ for α = 1 over α = 0, B = 2, N = 220",
            value(1.0, 2.0, 220) / value(0.0, 2.0, 220),
            0.2,
            0.95,
        ),
        Check::within("B of the lowest curve at N = 220, α = 1, q = 0", lowest(1.0, 220), 2.0, 3.0),
        Check::within(
            "κ for B = 3 over B = 2 at N = 220, α = 1",
            value(1.0, 3.0, 220) / value(1.0, 2.0, 220),
            0.9,
            1.1,
        ),
    ];
    // Up to N = 3 trees of different B are the same.
    let sizes: Vec<usize> = samples(560).into_iter().filter(|&n| n > 3).collect();
    let lowest_at = |factor: f64| -> String {
        let here = sizes.iter().filter(|&&n| value(1.0, factor, n) <= value(1.0, lowest(1.0, n), n));
        here.map(ToString::to_string).collect::<Vec<_>>().join(", ")
    };
    let over_two: Vec<f64> = sizes.iter().map(|&n| value(1.0, 3.0, n) / value(1.0, 2.0, n)).collect();
    let note = format!(
        "for α = 1 the paper finds the lowest curve at B = 3 and names no configuration; at q = 0, of the N drawn from 4 on, it is B = 4 for N = {}, B = 3 for N = {}, B = 2 for N = {}; κ for B = 3 is {:.2} to {:.2} of that for B = 2",
        lowest_at(4.0),
        lowest_at(3.0),
        lowest_at(2.0),
        over_two.iter().copied().fold(f64::INFINITY, f64::min),
        over_two.iter().copied().fold(0.0, f64::max)
    );
    Ok(Outcome::new(table, vec![Reading::shape("F-fig16", shape).noting(note)]))
}

/// Figure 17: the largest eigenvectors of onion(33,B,0,1), beside the number of links that each joint carries.
///
/// # Errors
///
/// [`StudyError`], as every experiment.
pub fn fig17(lab: &Lab<'_>) -> Result<Outcome, StudyError> {
    let n = 33;
    let numbers = [("B", "1"), ("joint", "1"), ("coordinate", "1"), ("carried", "1")];
    let mut table = Rows::new(&[("curve", "")], &numbers);
    let mut shape = Vec::new();
    let mut gathered = Vec::new();
    for factor in [1.0, 1.125] {
        let family = Family::onion(n, factor, 0.0, 1.0)?;
        let mut carried = vec![1.0; n + 1];
        (2..=n).rev().for_each(|i| carried[family.parent(i)] += carried[i]);
        let x = lab.pose(&family, Posture::Zero)?.ends()?.stiffest;
        let sign = x[0].signum();
        for i in 1..=n {
            table.push([format!("B = {factor}")], [factor, i as f64, sign * x[i - 1], carried[i]].map(Some));
        }
        // Concordance of coordinates and numbers of links carried, over pairs that differ in the latter.
        let (mut agree, mut pairs) = (0.0, 0.0);
        for i in 1..=n {
            for j in i + 1..=n {
                if carried[i] != carried[j] {
                    pairs += 1.0;
                    agree +=
                        f64::from(u8::from((x[i - 1].abs() > x[j - 1].abs()) == (carried[i] > carried[j])));
                }
            }
        }
        let what = format!("B = {factor}: pairs of joints where the one that carries more links moves more");
        shape.push(Check::within(what, agree / pairs, 0.9, 1.0));
        gathered.push(1.0 / x.iter().map(|x| x.powi(4)).sum::<f64>());
        if factor > 1.0 {
            let branches: Vec<usize> =
                (1..=n).filter(|&i| (1..=n).filter(|&j| family.parent(j) == i).count() > 1).collect();
            shape.push(Check::truth("branch points at links 8, 16 and 24", branches == [8, 16, 24]));
        }
    }
    shape.push(Check::within(
        "number of joints that share the motion, 1/Σx⁴: B = 1.125 over B = 1",
        gathered[1] / gathered[0],
        0.1,
        0.8,
    ));
    Ok(Outcome::new(table, vec![Reading::shape("F-fig17", shape)]))
}

//! Figures 2 to 5: chains that swing from rest.

use super::example::hanging;
use crate::claim::{Check, Reading};
use crate::estimators::{Estimates, correlation, estimates, median};
use crate::experiment::Outcome;
use crate::lab::{Lab, StudyError};
use crate::simulate::{DORMAND_PRINCE, Method, Schedule, State, Steps, simulate};
use crate::table::Rows;
use eigenbody::spectrum::eigenvalues;
use eigenbody::{Matrix, Model, mass_matrix};
use rayon::prelude::*;

const SPAN_S: f64 = 10.0;
const TOLERANCE: f64 = 1e-9;

/// The motion from rest at q = 0, sampled every 20 ms.
pub(super) fn released(model: &Model<f64>, lab: &Lab<'_>) -> Result<Vec<State>, StudyError> {
    let (intervals, tolerance) = if lab.quick { (200, 1e-7) } else { (500, TOLERANCE) };
    let schedule = Schedule {
        method: Method::RungeKutta(DORMAND_PRINCE),
        steps: Steps::Adaptive(tolerance),
        span_s: SPAN_S,
        intervals,
    };
    Ok(simulate(model, &vec![0.0; model.nq()], &vec![0.0; model.nv()], &schedule)?)
}

/// H along a motion, and the times.
pub(super) fn matrices(model: &Model<f64>, lab: &Lab<'_>) -> Result<Vec<(f64, Matrix<f64>)>, StudyError> {
    released(model, lab)?.iter().map(|state| Ok((state.t, mass_matrix(model, &state.q)?))).collect()
}

/// κ and its estimates, and when.
type Swing = Vec<(f64, Estimates)>;

/// κ and its estimates along the motion of n links.
fn along(lab: &Lab<'_>, n: usize) -> Result<Swing, StudyError> {
    let matrices = matrices(&hanging(lab, n)?, lab)?;
    matrices.into_par_iter().map(|(t, H)| Ok((t, estimates(&H)?))).collect()
}

/// Several lengths at once.
fn lengths<const K: usize>(lab: &Lab<'_>, links: [usize; K]) -> Result<Vec<(usize, Swing)>, StudyError> {
    links.into_par_iter().map(|n| Ok((n, along(lab, n)?))).collect()
}

fn log(values: impl Iterator<Item = f64>) -> Vec<f64> {
    values.map(f64::log10).collect()
}

/// Correlation of log κ with the log of an estimate.
fn follows(motion: &[(f64, Estimates)], estimate: impl Fn(&Estimates) -> f64) -> f64 {
    let kappa = log(motion.iter().map(|(_, found)| found.kappa));
    correlation(&kappa, &log(motion.iter().map(|(_, found)| estimate(found))))
}

/// Figure 2: eigenvalues, diagonal elements, κ and diagonal ratio of four links over time.
///
/// # Errors
///
/// [`StudyError`], as every experiment.
pub fn fig2(lab: &Lab<'_>) -> Result<Outcome, StudyError> {
    let numbers = [
        ("t", "s"),
        ("lambda_1", "kg m^2"),
        ("lambda_2", "kg m^2"),
        ("lambda_3", "kg m^2"),
        ("lambda_4", "kg m^2"),
        ("I_11", "kg m^2"),
        ("I_22", "kg m^2"),
        ("I_33", "kg m^2"),
        ("I_44", "kg m^2"),
        ("kappa", "1"),
        ("delta", "1"),
    ];
    let mut table = Rows::new(&[], &numbers);
    let mut motion = Vec::new();
    let (mut first, mut largest, mut is_ordered) = (Vec::new(), Vec::new(), true);
    for (t, H) in matrices(&hanging(lab, 4)?, lab)? {
        let found = estimates(&H)?;
        let mut lambda = eigenvalues(&H, &[1.0; 4])?;
        lambda.reverse();
        let I = [0, 1, 2, 3].map(|i| H[(i, i)]);
        is_ordered &= I[0] >= I[1].max(I[2]).max(I[3]);
        first.push(I[0]);
        largest.push(lambda[0]);
        let cells = [
            t,
            lambda[0],
            lambda[1],
            lambda[2],
            lambda[3],
            I[0],
            I[1],
            I[2],
            I[3],
            found.kappa,
            found.diagonal_ratio,
        ];
        table.push([], cells.map(Some));
        motion.push((t, found));
    }
    let part: Vec<f64> = first.iter().zip(&largest).map(|(i, l)| i / l).collect();
    let shape = vec![
        Check::within("correlation of I₁₁ with λ₁", correlation(&first, &largest), 0.95, 1.0),
        Check::within("median of I₁₁/λ₁", median(&part), 0.5, 1.0),
        Check::within(
            "correlation of log I₁₁/I₄₄ with log κ",
            follows(&motion, |found| found.diagonal_ratio),
            0.5,
            1.0,
        ),
        Check::within("largest |δ_s/κ − 1|", apart(&motion).1, 0.0, 0.15),
        Check::truth("I₁₁ is the largest diagonal element throughout", is_ordered),
    ];
    Ok(Outcome::new(table, vec![Reading::shape("S-fig2", shape)]))
}

/// Figure 3: κ and diagonal ratio of 10 and 20 links.
///
/// # Errors
///
/// [`StudyError`], as every experiment.
pub fn fig3(lab: &Lab<'_>) -> Result<Outcome, StudyError> {
    let mut table = Rows::new(&[("curve", "")], &[("n", "1"), ("t", "s"), ("kappa", "1"), ("delta", "1")]);
    let mut shape = Vec::new();
    for (n, motion) in lengths(lab, [10, 20])? {
        for (t, found) in &motion {
            table.push([format!("n = {n}")], [n as f64, *t, found.kappa, found.diagonal_ratio].map(Some));
        }
        let worst = motion.iter().fold(0.0f64, |worst, (_, found)| worst.max(found.kappa))
            / (4.0 * (n as f64).powi(4));
        shape.push(Check::within(
            format!("n = {n}: correlation of log I₁₁/I_nn with log κ"),
            follows(&motion, |found| found.diagonal_ratio),
            0.8,
            1.0,
        ));
        shape.push(Check::within(format!("n = {n}: largest κ over 4 n⁴"), worst, 0.5, 1.3));
    }
    Ok(Outcome::new(table, vec![Reading::shape("S-fig3", shape)]))
}

/// Figure 4: pivot ratios of 10 and 20 links, with κ beside them.
///
/// # Errors
///
/// [`StudyError`], as every experiment.
pub fn fig4(lab: &Lab<'_>) -> Result<Outcome, StudyError> {
    let mut table =
        Rows::new(&[("curve", "")], &[("n", "1"), ("t", "s"), ("pivot_ratio", "1"), ("kappa", "1")]);
    let mut shape = Vec::new();
    for (n, motion) in lengths(lab, [10, 20])? {
        for (t, found) in &motion {
            table.push([format!("n = {n}")], [n as f64, *t, found.pivot_ratio, found.kappa].map(Some));
        }
        let (pivot, diagonal) =
            (follows(&motion, |found| found.pivot_ratio), follows(&motion, |found| found.diagonal_ratio));
        shape.push(Check::within(
            format!("n = {n}: correlation of log pivot ratio with log κ"),
            pivot,
            -1.0,
            0.6,
        ));
        shape.push(Check::within(
            format!("n = {n}: how much closer the diagonal ratio follows"),
            diagonal - pivot,
            0.2,
            2.0,
        ));
    }
    Ok(Outcome::new(table, vec![Reading::shape("S-fig4", shape)]))
}

/// Figure 5: κ and scaled diagonal ratio of 4, 10 and 20 links.
///
/// # Errors
///
/// [`StudyError`], as every experiment.
pub fn fig5(lab: &Lab<'_>) -> Result<Outcome, StudyError> {
    let numbers = [("n", "1"), ("t", "s"), ("kappa", "1"), ("delta_scaled", "1")];
    let mut table = Rows::new(&[("curve", "")], &numbers);
    let mut shape = Vec::new();
    let mut words = Vec::new();
    for (n, motion) in lengths(lab, [4, 10, 20])? {
        for ((t, found), scaled) in motion.iter().zip(scaled(&motion)) {
            table.push([format!("n = {n}")], [n as f64, *t, found.kappa, scaled].map(Some));
        }
        let (middle, worst) = apart(&motion);
        words.push(format!(
            "n = {n}: off by {:.1}% in the median, {:.1}% at worst",
            100.0 * middle,
            100.0 * worst
        ));
        shape.push(Check::within(
            format!("n = {n}: correlation of log δ_s with log κ"),
            follows(&motion, |found| found.diagonal_ratio),
            0.5,
            1.0,
        ));
        shape.push(Check::within(format!("n = {n}: largest |δ_s/κ − 1|"), worst, 0.0, 0.15));
    }
    Ok(Outcome::new(table, vec![Reading::shape("S-fig5", shape).noting(words.join("; "))]))
}

/// |δ_s/κ − 1| along a motion: median and largest.
pub(super) fn apart(motion: &[(f64, Estimates)]) -> (f64, f64) {
    let missed: Vec<f64> = motion
        .iter()
        .zip(scaled(motion))
        .map(|((_, found), scaled)| (scaled / found.kappa - 1.0).abs())
        .collect();
    (median(&missed), missed.iter().copied().fold(0.0, f64::max))
}

/// δ_s = δ κ(0)/δ(0) along a motion (Eq. 15).
pub(super) fn scaled(motion: &[(f64, Estimates)]) -> Vec<f64> {
    let scale = motion.first().map_or(f64::NAN, |(_, start)| start.kappa / start.diagonal_ratio);
    motion.iter().map(|(_, found)| scale * found.diagonal_ratio).collect()
}

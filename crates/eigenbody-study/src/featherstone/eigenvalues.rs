//! All eigenvalues: figures 11, 12 and 13.

use super::curves::planar;
use super::sizes::decimal;
use crate::claim::{Check, Reading};
use crate::experiment::Outcome;
use crate::fit::power;
use crate::lab::{Lab, StudyError};
use crate::table::Rows;
use eigenbody::{Family, Posture};
use std::f64::consts::PI;

/// Numbers of links whose spectra are drawn.
const LINKS: [usize; 8] = [2, 4, 6, 10, 20, 50, 100, 200];
/// Rotational inertia of a link about its centre of mass, in the plane (kg m²).
const SINGLE: f64 = 1.015 / 12.0;

fn straight(lab: &Lab<'_>, n: usize) -> Result<Vec<f64>, StudyError> {
    lab.pose(&planar(n)?, Posture::Zag(0.0))?.eigenvalues()
}

/// Part of the eigenvalues above the geometric mean of the smallest and the largest.
fn share_above_mean(ascending: &[f64]) -> f64 {
    let (min, max) = (ascending[0], ascending[ascending.len() - 1]);
    let mean = (min * max).sqrt();
    ascending.iter().filter(|&&value| value > mean).count() as f64 / ascending.len() as f64
}

/// λmin of a long chain in zag(θ).
fn smallest_at(lab: &Lab<'_>, n: usize, theta: f64) -> Result<f64, StudyError> {
    Ok(lab.pose(&planar(n)?, Posture::Zag(theta))?.ends()?.min)
}

/// Figure 11: all eigenvalues at zag(0), spread along x from 0 to 1.
///
/// # Errors
///
/// [`StudyError`], as every experiment.
pub fn fig11(lab: &Lab<'_>) -> Result<Outcome, StudyError> {
    let numbers = [("N", "1"), ("i", "1"), ("x", "1"), ("lambda", "kg m^2")];
    let mut table = Rows::new(&[("curve", "")], &numbers);
    let mut shares = Vec::new();
    for n in LINKS {
        let ascending = straight(lab, n)?;
        shares.push(share_above_mean(&ascending));
        for (i, &lambda) in ascending.iter().enumerate() {
            let row = [n as f64, i as f64 + 1.0, i as f64 / (n as f64 - 1.0), lambda];
            table.push([format!("N = {n}")], row.map(Some));
        }
    }
    let (least, most) = (smallest_at(lab, 1000, 0.0)?, smallest_at(lab, 220, 2.45)?);
    let share = shares[LINKS.len() - 1];
    let mut theta = (0.0, 0.0);
    for step in 0..=62 {
        let angle = 0.05 * f64::from(step);
        let value = smallest_at(lab, 100, angle)?;
        if value > theta.1 {
            theta = (angle, value);
        }
    }
    let checks = vec![
        Check::within("part of the eigenvalues above the mean at N = 2", shares[0], 0.5, 0.5),
        Check::within(
            "λmin/(I_min/4), I_min = 0.08458 kg m², zag(0), N = 1000",
            least / (SINGLE / 4.0),
            1.0,
            1.001,
        ),
        Check::within("θ of the largest λmin over zag(θ), N = 100 (rad)", theta.0, 2.4, 2.5),
        Check::within("λmin at N = 10 against N = 1000", smallest_at(lab, 10, 0.0)? / least, 1.0, 1.1),
    ];
    Ok(Outcome::new(table, vec![Reading::new("F-fig11", vec![least, most, share], checks)]))
}

/// λmin of a hundred links in zag(θ) against θ: the range that §4.4 names.
///
/// # Errors
///
/// [`StudyError`], as every experiment.
pub fn smallest(lab: &Lab<'_>) -> Result<Outcome, StudyError> {
    let mut table = Rows::new(&[("curve", "")], &[("theta", "rad"), ("lambda_min", "kg m^2")]);
    for n in [10, 100] {
        for step in 0..=60 {
            let angle = PI * f64::from(step) / 60.0;
            table.push([format!("N = {n}")], [Some(angle), Some(smallest_at(lab, n, angle)?)]);
        }
    }
    Ok(Outcome::new(table, Vec::new()))
}

/// Figure 12: the same eigenvalues against normalised period, the i-th largest at 1/i.
///
/// # Errors
///
/// [`StudyError`], as every experiment.
pub fn fig12(lab: &Lab<'_>) -> Result<Outcome, StudyError> {
    let numbers = [("N", "1"), ("i", "1"), ("period", "1"), ("lambda", "kg m^2")];
    let mut table = Rows::new(&[("curve", "")], &numbers);
    for n in LINKS {
        for (i, lambda) in straight(lab, n)?.into_iter().rev().enumerate() {
            let harmonic = i as f64 + 1.0;
            table.push([format!("N = {n}")], [n as f64, harmonic, 1.0 / harmonic, lambda].map(Some));
        }
    }
    let line = |n: usize, first: f64, last: f64| {
        power(&table.points("curve", &format!("N = {n}"), "period", "lambda"), 0.999 / last, 1.001 / first)
    };
    let apart = |x: f64| {
        let value = |n: usize| {
            let points = table.points("curve", &format!("N = {n}"), "period", "lambda");
            points.iter().find(|point| (point.0 - x).abs() < 1e-12).map_or(f64::NAN, |point| point.1)
        };
        (value(200) / value(100)).log10()
    };
    let shape = vec![
        Check::slope("slope at N = 100, harmonics 2 to 20", line(100, 2.0, 20.0), 3.8, 4.8),
        Check::slope("slope at N = 200, harmonics 2 to 20", line(200, 2.0, 20.0), 3.8, 4.8),
        Check::slope("slope at N = 200, harmonics 10 to 40", line(200, 10.0, 40.0), 3.8, 4.3),
        Check::within(
            "lines for N = 100 and 200 apart at i = 1, over their distance at i = 10",
            apart(1.0) / apart(0.1),
            0.95,
            1.05,
        ),
    ];
    Ok(Outcome::new(table, vec![Reading::shape("F-fig12", shape)]))
}

/// Figure 13: eigenvalues of hydra(50,1,0,ρ) at curl(2.2) for several ratios of sizes.
///
/// # Errors
///
/// [`StudyError`], as every experiment.
pub fn fig13(lab: &Lab<'_>) -> Result<Outcome, StudyError> {
    let numbers = [("R", "1"), ("i", "1"), ("x", "1"), ("lambda", "kg m^2")];
    let mut table = Rows::new(&[("curve", "")], &numbers);
    let (mut least, mut pace, mut roughness) = (Vec::new(), Vec::new(), Vec::new());
    for ratio in [1.0, 0.5, 0.2, 0.1] {
        let family = Family::hydra(50, 1.0, 0.0, 1.0)?.with_size_ratio(decimal(ratio))?;
        let posed = lab.pose(&family, Posture::Curl(2.2))?;
        let (ascending, H11) = (posed.eigenvalues()?, posed.diagonal()?[0]);
        for (i, &lambda) in ascending.iter().enumerate() {
            table.push([format!("R = {ratio}")], [ratio, i as f64 + 1.0, i as f64 / 49.0, lambda].map(Some));
        }
        least.push(ascending[0] / ratio.powi(5));
        pace.push(ascending[49] / H11);
        roughness.push(staircase(&ascending));
    }
    let shape = vec![
        Check::within("λmin/R⁵ at R = 0.5 over R = 1", least[1] / least[0], 0.8, 1.25),
        Check::within("λmin/R⁵ at R = 0.1 over R = 1", least[3] / least[0], 0.8, 1.25),
        Check::within("λmax/H₁₁ at R = 0.1 over R = 1: falls slightly faster", pace[3] / pace[0], 0.2, 0.999),
        Check::within("λmax/H₁₁ at R = 0.5 over R = 1", pace[1] / pace[0], 0.2, 0.999),
        Check::within("staircase: a large step over a middling one, R = 1", roughness[0], 5.0, f64::INFINITY),
        Check::within(
            "the same at R = 0.1, over that at R = 1: smoother",
            roughness[3] / roughness[0],
            0.0,
            0.6,
        ),
    ];
    Ok(Outcome::new(table, vec![Reading::shape("F-fig13", shape)]))
}

/// Steps of log λ between neighbours, without the five largest eigenvalues: ninth decile over median.
fn staircase(ascending: &[f64]) -> f64 {
    let inner = &ascending[..ascending.len() - 5];
    let mut steps: Vec<f64> = inner.windows(2).map(|pair| (pair[1] / pair[0]).ln()).collect();
    steps.sort_by(f64::total_cmp);
    steps[steps.len() * 9 / 10] / steps[steps.len() / 2]
}

//! Links of different sizes: figures 9 and 10.

use super::curves::{Curve, OwnedMember, kappa_curves, samples};
use crate::claim::{Check, Reading};
use crate::experiment::Outcome;
use crate::lab::{Lab, StudyError};
use crate::table::{Rows, Subject, Table};
use eigenbody::model::Random;
use eigenbody::scalar::Dd;
use eigenbody::spectrum::eigenvalues;
use eigenbody::{Family, Matrix, Posture, family::FamilyError};
use rayon::prelude::*;
use std::f64::consts::FRAC_PI_2;

/// The two postures of both figures.
const POSTURES: [(&str, Posture); 2] =
    [("curl(0)", Posture::Curl(0.0)), ("curl(π/2)", Posture::Curl(FRAC_PI_2))];
/// Where a matrix is singular in double precision.
const SINGULAR: f64 = 1.0 / f64::EPSILON;

/// Enough to spread every row over all.
const REFLECTIONS: usize = 12;

/// A decimal of at most six places, exact to 32 digits.
pub(super) fn decimal(x: f64) -> Dd {
    Dd::from((x * 1e6).round()) / Dd::from(1e6)
}

fn tapered(n: usize, taper: f64) -> Result<Family, FamilyError> {
    Family::hydra(n, 1.0, 0.0, decimal(taper))
}

fn taper_curves(lab: &Lab<'_>, tapers: &[f64], last: impl Fn(f64) -> usize) -> Result<Table, StudyError> {
    let members: Vec<(f64, OwnedMember)> =
        tapers.iter().map(|&taper| (taper, Box::new(move |n| tapered(n, taper)) as OwnedMember)).collect();
    let mut curves = Vec::new();
    for (name, posture) in POSTURES {
        for (taper, member) in &members {
            let samples = samples(last(*taper));
            curves.push(Curve {
                name: format!("{name}, ρ = {taper}"),
                parameter: *taper,
                member: &**member,
                posture,
                samples,
            });
        }
    }
    kappa_curves(lab, ("rho", "1"), &curves)
}

/// Figure 9: fixed taper. Every curve stops at the last sample whose matrix is not singular in double precision.
///
/// # Errors
///
/// [`StudyError`], as every experiment.
pub fn fig9(lab: &Lab<'_>) -> Result<Outcome, StudyError> {
    let all =
        taper_curves(lab, &[0.7, 0.8, 0.9, 0.95, 0.99, 1.0], |taper| if taper < 0.9 { 100 } else { 560 })?;
    let mut table = Rows::new(&[("curve", "")], &[("rho", "1"), ("N", "1"), ("kappa", "1")]);
    let [rho, n, kappa] = ["rho", "N", "kappa"].map(|column| all.number(column));
    for (row, name) in all.text("curve").iter().enumerate() {
        if kappa[row].is_some_and(|kappa| kappa < SINGULAR) {
            table.push([name.clone()], [rho[row], n[row], kappa[row]]);
            if let Some(Subject { robot, posture }) = all.subject(row) {
                table.about(robot.clone(), *posture);
            }
        }
    }
    // The paper's own ends: the last N of its sample set, or of all N, that a dense solver resolves.
    let end = |name: &str, taper: f64| -> f64 {
        let last = table.points("curve", name, "N", "kappa").last().map_or(f64::NAN, |point| point.0);
        taper.powf(1.0 - last)
    };
    let mut dense = 0;
    for n in 1..40 {
        if lab.kappa(&tapered(n, 0.7)?, Posture::Curl(0.0))? < SINGULAR {
            dense = n;
        }
    }
    let shape = vec![
        Check::within(
            "ρ = 0.7, curl(0): size ratio at the last N below 1/ε (600)",
            0.7f64.powf(1.0 - dense as f64),
            570.0,
            650.0,
        ),
        Check::within(
            "ρ = 0.99, curl(0): size ratio at the last sample (28)",
            end("curl(0), ρ = 0.99", 0.99),
            26.0,
            29.0,
        ),
        Check::within(
            "ρ = 0.99, curl(π/2): size ratio at the last sample (280)",
            end("curl(π/2), ρ = 0.99", 0.99),
            270.0,
            285.0,
        ),
    ];
    let note = format!("a dense κ for ρ = 0.7 stays below 1/ε = 4.5·10¹⁵ up to N = {dense}");
    Ok(Outcome::new(table, vec![Reading::shape("F-fig9", shape).noting(note)]))
}

/// Figure 9 past double precision: to κ of about 10⁹⁰.
///
/// # Errors
///
/// [`StudyError`], as every experiment.
pub fn fig9_beyond(lab: &Lab<'_>) -> Result<Outcome, StudyError> {
    let last = |taper: f64| (45.0 / -taper.log10() / 2.5) as usize;
    let table = taper_curves(lab, &[0.7, 0.8, 0.9, 0.95, 0.99], last)?;
    Ok(Outcome::new(table, Vec::new()))
}

/// κ as far as double precision guarantees it to a dense method; none if λmin comes out negative.
///
/// The matrix of a tapered chain is graded, and a solver that starts at the right end keeps its small eigenvalues. Reflections
/// P H P, P = 1 − 2vvᵀ at random v, hide the grading: what is left is the accuracy that every dense method has, ε·λmax.
fn plain_kappa(H: &Matrix<f64>) -> Result<Option<f64>, StudyError> {
    let n = H.rows();
    let mut random = Random::new(1);
    let mut A = H.clone();
    for _ in 0..REFLECTIONS {
        let mut v: Vec<f64> = (0..n).map(|_| random.between(-1.0, 1.0)).collect();
        let norm = v.iter().map(|v| v * v).sum::<f64>().sqrt();
        v.iter_mut().for_each(|v| *v /= norm);
        // P A P = A − v wᵀ − w vᵀ,  w = 2 (A v − v vᵀA v)
        let Av = A.times(&v);
        let vAv: f64 = v.iter().zip(&Av).map(|(v, a)| v * a).sum();
        let w: Vec<f64> = v.iter().zip(&Av).map(|(v, a)| 2.0 * (a - v * vAv)).collect();
        A = Matrix::from_fn(n, n, |i, j| A[(i, j)] - (v[i] * w[j] + w[i] * v[j]));
    }
    let values = eigenvalues(&A, &vec![1.0; n])?;
    Ok(values.first().zip(values.last()).map(|(min, max)| max / min).filter(|kappa| *kappa > 0.0))
}

/// Figure 10: fixed ratio R of the last link's size to the first's; the dense double-precision κ stands beside the exact one.
///
/// # Errors
///
/// [`StudyError`], as every experiment.
pub fn fig10(lab: &Lab<'_>) -> Result<Outcome, StudyError> {
    let last = 390;
    let mut points = Vec::new();
    for (name, posture) in POSTURES {
        for ratio in [1.0, 0.5, 0.2, 0.1] {
            points.extend(samples(last).into_iter().skip(1).map(|n| (name, posture, ratio, n)));
        }
    }
    let rows: Result<Vec<_>, StudyError> = points
        .into_par_iter()
        .with_max_len(1)
        .map(|(name, posture, ratio, n)| {
            let family = Family::hydra(n, 1.0, 0.0, 1.0)?.with_size_ratio(decimal(ratio))?;
            let posed = lab.pose(&family, posture)?;
            let kappa = posed.ends()?.kappa();
            // A dense solver takes its time: only where the paper prints numbers, and for small robots.
            let dense = if n <= 100 || n == last { plain_kappa(&posed.mass_matrix()?)? } else { None };
            let numbers = [Some(ratio), Some(n as f64), Some(kappa), dense];
            Ok((format!("{name}, R = {ratio}"), numbers, family, posture))
        })
        .collect();
    let mut table =
        Rows::new(&[("curve", "")], &[("R", "1"), ("N", "1"), ("kappa", "1"), ("kappa_dense", "1")]);
    for (name, numbers, family, posture) in rows? {
        table.push([name], numbers);
        table.about(family, posture);
    }
    let value = |column: &str, posture: &str, ratio: f64, n: usize| {
        let points = table.points("curve", &format!("{posture}, R = {ratio}"), "N", column);
        super::curves::at(&points, n)
    };
    let ratios = |column: &str| -> Vec<f64> {
        [("curl(0)", 1.0), ("curl(π/2)", 1.0), ("curl(0)", 0.2), ("curl(π/2)", 0.2)]
            .map(|(posture, other)| value(column, posture, 0.1, last) / value(column, posture, other, last))
            .to_vec()
    };
    let dense = ratios("kappa_dense");
    let at_two = |posture| value("kappa", posture, 0.1, 2) * 1e-5;
    let checks = vec![
        Check::within("κ R⁵ at N = 2, R = 0.1, curl(0)", at_two("curl(0)"), 0.9, 1.1),
        Check::within("κ R⁵ at N = 2, R = 0.1, curl(π/2)", at_two("curl(π/2)"), 0.9, 1.1),
        Check::within("the first ratio by a plain dense solver in double precision", dense[0], 223.0, 233.0),
    ];
    let found: Vec<String> = dense.iter().map(|ratio| format!("{ratio:.4}")).collect();
    let guaranteed = 100.0 * f64::EPSILON * value("kappa", "curl(0)", 0.1, last);
    let note = format!(
        "a dense method in double precision knows λmin to ε·λmax: here the curl(0) ratios to ±ε·κ = {guaranteed:.2}%; one such gives {}",
        found.join(", ")
    );
    let reading = Reading::new("F-fig10", ratios("kappa"), checks).noting(note);
    Ok(Outcome::new(table, vec![reading]))
}

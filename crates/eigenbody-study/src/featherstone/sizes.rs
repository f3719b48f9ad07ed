//! Links of different sizes: figures 9 and 10.

use super::curves::{Curve, kappa_curves, samples};
use crate::claim::{Check, Reading};
use crate::experiment::Outcome;
use crate::lab::{Lab, StudyError};
use crate::table::Table;
use eigenbody::scalar::Dd;
use eigenbody::spectrum::eigenvalues;
use eigenbody::{Family, Posture, family::FamilyError};
use rayon::prelude::*;
use std::f64::consts::FRAC_PI_2;

/// The two postures of both figures.
const POSTURES: [(&str, Posture); 2] = [("curl(0)", Posture::Curl(0.0)), ("curl(π/2)", Posture::Curl(FRAC_PI_2))];
/// Where a matrix is singular in double precision.
const SINGULAR: f64 = 1.0 / f64::EPSILON;

/// A decimal of at most six places, exact to 32 digits.
pub(super) fn decimal(x: f64) -> Dd {
    Dd::from((x * 1e6).round()) / Dd::from(1e6)
}

fn tapered(n: usize, taper: f64) -> Result<Family, FamilyError> {
    Family::hydra(n, 1.0, 0.0, decimal(taper))
}

fn taper_curves(lab: &Lab<'_>, tapers: &[f64], last: impl Fn(f64) -> usize) -> Result<Table, StudyError> {
    let members: Vec<(f64, Box<dyn Fn(usize) -> Result<Family, FamilyError> + Sync>)> = tapers
        .iter()
        .map(|&taper| (taper, Box::new(move |n| tapered(n, taper)) as Box<dyn Fn(usize) -> _ + Sync>))
        .collect();
    let mut curves = Vec::new();
    for (name, posture) in POSTURES {
        for (taper, member) in &members {
            let samples = samples(last(*taper));
            curves.push(Curve { name: format!("{name}, ρ = {taper}"), parameter: *taper, member: &**member, posture, samples });
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
    let all = taper_curves(lab, &[0.7, 0.8, 0.9, 0.95, 0.99, 1.0], |taper| if taper < 0.9 { 100 } else { 560 })?;
    let mut table = Table::new(&[("curve", "")], &[("rho", "1"), ("N", "1"), ("kappa", "1")]);
    for name in all.distinct("curve") {
        let rho = all.points("curve", name, "rho", "N").first().map(|point| point.0);
        for (n, kappa) in all.points("curve", name, "N", "kappa") {
            if kappa < SINGULAR {
                table.push([name.to_owned()], [rho, Some(n), Some(kappa)]);
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
        Check::within("ρ = 0.7, curl(0): size ratio at the last N below 1/ε (600)", 0.7f64.powf(1.0 - dense as f64), 570.0, 650.0),
        Check::within("ρ = 0.99, curl(0): size ratio at the last sample (28)", end("curl(0), ρ = 0.99", 0.99), 26.0, 29.0),
        Check::within("ρ = 0.99, curl(π/2): size ratio at the last sample (280)", end("curl(π/2), ρ = 0.99", 0.99), 270.0, 285.0),
    ];
    let note = format!("a dense κ for ρ = 0.7 stays below 1/ε = 4.5·10¹⁵ up to N = {dense}");
    Ok(Outcome::new(table, vec![Reading::shape("F-fig9", shape).noting(note)]))
}

/// Figure 9 past double precision: to κ of about 10¹⁰⁰.
///
/// # Errors
///
/// [`StudyError`], as every experiment.
pub fn fig9_beyond(lab: &Lab<'_>) -> Result<Outcome, StudyError> {
    let last = |taper: f64| (45.0 / -taper.log10() / 2.5) as usize;
    let table = taper_curves(lab, &[0.7, 0.8, 0.9, 0.95, 0.99], last)?;
    Ok(Outcome::new(table, Vec::new()))
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
            let posed = lab.pose(&Family::hydra(n, 1.0, 0.0, 1.0)?.with_size_ratio(decimal(ratio))?, posture)?;
            let kappa = posed.ends()?.kappa();
            // A dense solver takes its time: only where the paper prints numbers, and for small robots.
            let dense = match n <= 100 || n == last {
                true => {
                    let values = eigenvalues(&posed.mass_matrix()?, &vec![1.0; n])?;
                    values.first().zip(values.last()).map(|(min, max)| max / min).filter(|kappa| *kappa > 0.0)
                }
                false => None,
            };
            Ok((format!("{name}, R = {ratio}"), [Some(ratio), Some(n as f64), Some(kappa), dense]))
        })
        .collect();
    let mut table = Table::new(&[("curve", "")], &[("R", "1"), ("N", "1"), ("kappa", "1"), ("kappa_dense", "1")]);
    for (name, numbers) in rows? {
        table.push([name], numbers);
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
        Check::within("dense double precision for the first ratio", dense[0], 225.0, 231.0),
    ];
    let found: Vec<String> = dense.iter().map(|ratio| format!("{ratio:.4}")).collect();
    let note = format!("a dense double-precision solver gives {} here", found.join(", "));
    Ok(Outcome::new(table.clone(), vec![Reading::new("F-fig10", ratios("kappa"), checks).noting(note)]))
}

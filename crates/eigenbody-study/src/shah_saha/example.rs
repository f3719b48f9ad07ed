//! The 4-link chain of §2, and the formulation of §3.

use crate::claim::{Check, Reading};
use crate::experiment::Outcome;
use crate::lab::{Lab, StudyError};
use crate::table::Rows;
use eigenbody::dynamics::{Denoc, Udu, gravity_force};
use eigenbody::spatial::Vec3;
use eigenbody::{Family, Model, Posture, forward_dynamics, mass_matrix};

/// The mass that the printed matrix needs; the text rounds it to 2.2 kg.
pub(super) const MASS_KG: f64 = 2.20698;
const LENGTH_M: f64 = 1.0;
/// From the vertical, at q = 0.
const START_DEG: f64 = 30.0;

/// A chain of identical rods that hangs 30° from the vertical at q = 0, where it lies on the x axis.
pub(super) fn hanging(lab: &Lab<'_>, n: usize) -> Result<Model<f64>, StudyError> {
    let (s, c) = START_DEG.to_radians().sin_cos();
    let model = lab.robots.model(&Family::slender_chain(n, MASS_KG, LENGTH_M)?)?;
    Ok(model.with_gravity(Vec3::new(c, -s, 0.0) * 9.81)?)
}

/// Figure 1: the chain, gravity downwards.
///
/// # Errors
///
/// [`StudyError`], as every experiment.
pub fn fig1(_: &Lab<'_>) -> Result<Outcome, StudyError> {
    let numbers = [("link", "1"), ("x0", "m"), ("y0", "m"), ("x1", "m"), ("y1", "m")];
    let mut table = Rows::new(&[("panel", ""), ("robot", "")], &numbers);
    let (s, c) = START_DEG.to_radians().sin_cos();
    for i in 0..4 {
        let at = |k: usize| (k as f64 * LENGTH_M * s, -(k as f64) * LENGTH_M * c);
        let ((x0, y0), (x1, y1)) = (at(i), at(i + 1));
        table.push([String::new(), String::new()], [i as f64 + 1.0, x0, y0, x1, y1].map(Some));
    }
    Ok(Outcome::new(table, Vec::new()))
}

/// Equations 7 to 9: the matrix, φ, accelerations, and accelerations for φ rounded.
///
/// # Errors
///
/// [`StudyError`], as every experiment.
pub fn eq7(lab: &Lab<'_>) -> Result<Outcome, StudyError> {
    let chain = hanging(lab, 4)?;
    let zero = [0.0; 4];
    let H = mass_matrix(&chain, &zero)?;
    let phi: Vec<f64> = gravity_force(&chain, &zero)?.iter().map(|g| -g).collect();
    let exact = forward_dynamics(&chain, &zero, &zero, &zero)?;
    let rounded = [-86.0, -48.7, -21.6, -5.4];
    let still = chain.clone().with_gravity(Vec3::ZERO)?;
    let vdot = forward_dynamics(&still, &zero, &zero, &rounded)?;
    let numbers = [
        ("link", "1"),
        ("I_1", "kg m^2"),
        ("I_2", "kg m^2"),
        ("I_3", "kg m^2"),
        ("I_4", "kg m^2"),
        ("phi", "N m"),
        ("vdot", "rad/s^2"),
        ("phi_rounded", "N m"),
        ("vdot_rounded", "rad/s^2"),
    ];
    let mut table = Rows::new(&[], &numbers);
    for i in 0..4 {
        let row = H.row(i);
        let cells = [row[0], row[1], row[2], row[3], phi[i], exact[i], rounded[i], vdot[i]];
        let mut numbers = [0.0; 9];
        numbers[0] = i as f64 + 1.0;
        numbers[1..].copy_from_slice(&cells);
        table.push([], numbers.map(Some));
    }
    let changes = vdot.iter().zip(&exact).zip([7.0, 14.0, 42.0, 55.0]).map(|((a, b), percent)| {
        let what = format!("change of an acceleration ({percent}%)");
        Check::within(what, 100.0 * (1.0 - a / b).abs(), percent - 1.0, percent + 1.0)
    });
    let kappa = crate::estimators::estimates(&H)?.kappa;
    let worst = Check::within("κ/(4 n⁴)", kappa / 1024.0, 0.9, 1.1);
    let readings = vec![
        Reading::new("S-eq7", H.as_slice().to_vec(), Vec::new()),
        Reading::new("S-eq7-phi", phi, Vec::new()),
        Reading::new("S-eq8", exact.clone(), Vec::new()),
        Reading::new("S-eq9", vdot.clone(), changes.collect()),
        Reading::new("S-kappa", vec![kappa], vec![worst]),
    ];
    Ok(Outcome::new(table, readings))
}

/// Equations 11 and 12: DeNOC beside composite rigid bodies, and UDUᵀ beside articulated bodies, on serial robots of up to 100 links.
///
/// # Errors
///
/// [`StudyError`], as every experiment.
pub fn eq11(lab: &Lab<'_>) -> Result<Outcome, StudyError> {
    let numbers = [("N", "1"), ("entries_apart", "1"), ("reconstruction_apart", "1"), ("solve_apart", "1")];
    let mut table = Rows::new(&[("robot", "")], &numbers);
    let (mut entries, mut solves) = (0.0f64, 0.0f64);
    for n in [1, 2, 4, 10, 20, 50, 100] {
        let robots = [
            ("chain", Family::slender_chain(n, MASS_KG, LENGTH_M)?),
            ("hydra, α = 0", Family::hydra(n, 1.0, 0.0, 1.0)?),
            ("hydra, α = 0.5", Family::hydra(n, 1.0, 0.5, 1.0)?),
        ];
        for (name, family) in robots {
            let model = lab.robots.model(&family)?.with_gravity(Vec3::ZERO)?;
            for q in [Posture::Zero.configuration(&model), model.random(n as u64)] {
                let H = mass_matrix(&model, &q)?;
                let mut denoc = Denoc::new(&model);
                denoc.update(&q)?;
                let mut udu = Udu::new(&denoc);
                udu.factor(&denoc)?;
                let apart = |other: &eigenbody::Matrix<f64>| {
                    let pairs = H.as_slice().iter().zip(other.as_slice());
                    pairs.fold(0.0f64, |worst, (a, b)| worst.max((a - b).abs())) / H.max_abs()
                };
                // Compared as forces: H times the difference of the accelerations.
                let force = vec![1.0; n];
                let mut found = force.clone();
                udu.solve(&denoc, &mut found)?;
                let expected = forward_dynamics(&model, &q, &vec![0.0; n], &force)?;
                let largest = expected.iter().fold(0.0f64, |m, x| m.max(x.abs()));
                let difference: Vec<f64> = found.iter().zip(&expected).map(|(a, b)| a - b).collect();
                let residual = H.times(&difference).iter().fold(0.0f64, |m, x| m.max(x.abs()));
                let row = [
                    apart(&denoc.mass_matrix()?),
                    apart(&udu.reconstruct(&denoc)?),
                    residual / (H.max_abs() * largest),
                ];
                (entries, solves) = (entries.max(row[0]).max(row[1]), solves.max(row[2]));
                table.push([name.into()], [n as f64, row[0], row[1], row[2]].map(Some));
            }
        }
    }
    let shape = vec![
        Check::within("largest difference of an entry, over max|H|", entries, 0.0, 1e-13),
        Check::within(
            "largest difference of UDUᵀ and ABA as a force, over max|H| max|v̇|",
            solves,
            0.0,
            1e-12,
        ),
    ];
    Ok(Outcome::new(table, vec![Reading::shape("S-eq11", shape)]))
}

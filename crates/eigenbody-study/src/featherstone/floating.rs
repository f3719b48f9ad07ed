//! Free-floating robots: figures 18 and 19.

use super::curves::{Curve, Member, at, kappa_curves, planar, samples, theta};
use super::mechanisms::{planar_links, push_links};
use crate::claim::{Check, Reading};
use crate::experiment::Outcome;
use crate::fit::power;
use crate::lab::{Lab, StudyError};
use eigenbody::dynamics::momentum;
use eigenbody::spatial::Vec3;
use eigenbody::spectrum::{Precision, extremes, sturm::Pencil};
use eigenbody::{Family, Model, Posture, family::FamilyError};
use std::f64::consts::FRAC_PI_2;

/// N + 1 links without the first joint: as many joints as the fixed robot of N links.
fn freed(n: usize) -> Result<Family, FamilyError> {
    Ok(planar(n + 1)?.floating())
}

/// Figure 18: fixed and free-floating chains in zag(θ). N counts joints.
///
/// # Errors
///
/// [`StudyError`], as every experiment.
pub fn fig18(lab: &Lab<'_>) -> Result<Outcome, StudyError> {
    let mut curves = Vec::new();
    for angle in [0.0, 2.5, 3.0] {
        for (kind, member) in [("fixed", &planar as Member<'_>), ("floating", &freed)] {
            let name = format!("{kind}, {}", theta(angle));
            curves.push(Curve {
                name,
                parameter: angle,
                member,
                posture: Posture::Zag(angle),
                samples: samples(560),
            });
        }
    }
    let table = kappa_curves(lab, ("theta", "rad"), &curves)?;
    let curve =
        |kind: &str, angle: f64| table.points("curve", &format!("{kind}, {}", theta(angle)), "N", "kappa");
    let ratio = |angle: f64, n: usize| at(&curve("fixed", angle), n) / at(&curve("floating", angle), n);
    let crossing = |kind: &str, first: f64, last: f64| {
        let points = curve(kind, 3.0);
        10f64.powf(power(&points, first, last).meets(&power(&points, 270.0, 560.0)))
    };
    let apart = crossing("floating", 5.0, 15.0) / crossing("fixed", 3.0, 8.0);
    let shape = vec![
        Check::within("fixed/floating at θ = 0, N = 100", ratio(0.0, 100), 36.0, 44.0),
        Check::within("fixed/floating at θ = 0, N = 560", ratio(0.0, 560), 36.0, 44.0),
        Check::within("fixed/floating at θ = 3.0, N = 4", ratio(3.0, 4), 2.5, 4.5),
        Check::within("fixed/floating at θ = 3.0, N = 10", ratio(3.0, 10), 3.0, 4.5),
        Check::within("N of the transition at θ = 3.0, floating over fixed", apart, 2.3, 3.8),
        Check::slope(
            "floating slope at θ = 0, N = 100 to 560",
            power(&curve("floating", 0.0), 100.0, 560.0),
            3.9,
            4.05,
        ),
    ];
    let small_base = lab.kappa(&Family::hydra(3, 1.0, 0.0, 10.0)?.floating(), Posture::Zag(FRAC_PI_2))?;
    let fixed = lab.kappa(&Family::hydra(2, 1.0, 0.0, 10.0)?, Posture::Zag(FRAC_PI_2))?;
    let readings = vec![
        Reading::shape("F-fig18", shape),
        Reading::new("F-fig18-extreme", vec![small_base, fixed], Vec::new()),
    ];
    Ok(Outcome::new(table, readings))
}

fn centre_of_mass(model: &Model<f64>, q: &[f64]) -> Result<Vec3<f64>, StudyError> {
    let total = momentum(model, q, &vec![0.0; model.nv()])?;
    Ok(total.moment * (1.0 / total.mass))
}

/// Figure 19: both robots in 0.2 times their largest eigenvectors; the base of the free one moves along.
///
/// # Errors
///
/// [`StudyError`], as every experiment.
pub fn fig19(lab: &Lab<'_>) -> Result<Outcome, StudyError> {
    let mut table = planar_links();
    let fixed = lab.pose(&planar(10)?, Posture::Zag(0.0))?;
    let ends = fixed.ends()?;
    let sign = ends.stiffest[0].signum();
    let q: Vec<f64> = ends.stiffest.iter().map(|x| 0.2 * sign * x).collect();
    push_links(&mut table, "", "fixed, N = 10", &fixed.model, &q, 1.0)?;

    let free = lab.pose(&freed(10)?, Posture::Zag(0.0))?;
    let pencil = Pencil::euclidean(&free.model, &free.q, true)?;
    let stiffest = extremes(&pencil, Precision::Auto)?.max;
    let x = &stiffest.vector;
    let sign = x[6].signum();
    let joints = &x[6..];
    let step = |amount: f64| -> Vec<f64> { x.iter().map(|x| amount * sign * x).collect() };
    // The mode tells how the base moves at first; beyond that the centre of mass is held where it was.
    let mut q = free.model.integrate(&free.q, &step(0.2))?;
    let before = centre_of_mass(&free.model, &free.q)?;
    let drift = centre_of_mass(&free.model, &q)? - before;
    for (q, drift) in q.iter_mut().zip(drift.to_array()) {
        *q -= drift;
    }
    push_links(&mut table, "", "floating, N = 11", &free.model, &q, 1.0)?;

    let lopsided = (0..10).map(|i| (joints[i] - joints[9 - i]).abs()).fold(0.0, f64::max);
    let moved = free.model.integrate(&free.q, &step(1e-4))?;
    let still = (centre_of_mass(&free.model, &moved)? - before).norm().abs() / 1e-4;
    let shape = vec![
        Check::within("largest difference between mirrored joints of the free robot", lopsided, 0.0, 1e-9),
        Check::within("speed of its centre of mass along the mode (m)", still, 0.0, 1e-2),
        Check::within("λmax, fixed over floating: less mass moves", ends.max / stiffest.value, 20.0, 60.0),
        Check::truth("all joints of the free robot turn the same way", joints.iter().all(|x| x * sign > 0.0)),
    ];
    Ok(Outcome::new(table, vec![Reading::shape("F-fig19", shape)]))
}

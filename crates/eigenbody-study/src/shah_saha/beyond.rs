//! The question that the paper leaves open: the estimators on wide swings, on trees and on a real arm.

use super::example::MASS_KG;
use super::swing::{apart, matrices, scaled};
use crate::estimators::{Estimates, estimates, median};
use crate::experiment::Outcome;
use crate::lab::{Lab, StudyError};
use crate::table::Rows;
use eigenbody::family::puma560;
use eigenbody::{Family, Model, mass_matrix};
use rayon::prelude::*;

/// Four links released horizontally: κ, δ_s and the bracket over time.
///
/// # Errors
///
/// [`StudyError`], as every experiment.
pub fn wide_swing(lab: &Lab<'_>) -> Result<Outcome, StudyError> {
    let numbers = [
        ("t", "s"),
        ("kappa", "1"),
        ("delta_scaled", "1"),
        ("lower", "1"),
        ("upper", "1"),
        ("pivot_ratio", "1"),
    ];
    let mut table = Rows::new(&[], &numbers);
    // A family's gravity is along −y, its links along x.
    let chain = lab.robots.model(&Family::slender_chain(4, MASS_KG, 1.0)?)?;
    let motion: Result<Vec<_>, StudyError> =
        matrices(&chain, lab)?.into_iter().map(|(t, H)| Ok((t, estimates(&H)?))).collect();
    let motion = motion?;
    for ((t, found), scaled) in motion.iter().zip(scaled(&motion)) {
        let (lower, upper) = found.bracket;
        table.push([], [*t, found.kappa, scaled, lower, upper, found.pivot_ratio].map(Some));
    }
    let (middle, worst) = apart(&motion);
    let outside = motion.iter().filter(|(_, found)| !holds(found)).count();
    Ok(Outcome::new(table, Vec::new()).remarking(format!(
        "δ_s misses κ by {:.0}% in the median and by {:.0}% at worst; κ lay outside the bracket {outside} times in {}.",
        100.0 * middle,
        100.0 * worst,
        motion.len()
    )))
}

/// r ≤ κ ≤ r κ′, but for rounding of κ: n·ε of it, and κ of κ′ times n ε.
fn holds(found: &Estimates) -> bool {
    let (lower, upper) = found.bracket;
    let slack = 1.0 + 1e-9;
    lower <= found.kappa * slack && found.kappa <= upper * slack
}

/// Trees and the PUMA 560 in random configurations, in ascending order of κ; δ_s is scaled at q = 0.
///
/// # Errors
///
/// [`StudyError`], as every experiment.
pub fn robots(lab: &Lab<'_>) -> Result<Outcome, StudyError> {
    let family = |family: Family| lab.robots.model(&family);
    let arm = puma560::<f64>()?;
    let bare = arm.clone().with_armature(vec![0.0; arm.nv()])?;
    let members: [(&str, Model<f64>); 6] = [
        ("hydra(20,1,0,1)", family(Family::hydra(20, 1.0, 0.0, 1.0)?)?),
        ("hydra(20,1.5,0.5,1)", family(Family::hydra(20, 1.5, 0.5, 1.0)?)?),
        ("onion(20,2,1,0.9)", family(Family::onion(20, 2.0, 1.0, 0.9)?)?),
        ("auto_tree(16,1.5,0.3,0.9)", family(Family::auto_tree(16, 1.5, 0.3, 0.9)?)?),
        ("PUMA 560", arm),
        ("PUMA 560 without motors", bare),
    ];
    let numbers = [
        ("rank", "1"),
        ("kappa", "1"),
        ("delta_scaled", "1"),
        ("lower", "1"),
        ("upper", "1"),
        ("pivot_ratio", "1"),
    ];
    let mut table = Rows::new(&[("robot", "")], &numbers);
    let count = if lab.quick { 40 } else { 120 };
    let (mut words, mut outside) = (Vec::new(), 0);
    for (name, model) in members {
        let start = estimates(&mass_matrix(&model, &model.neutral())?)?;
        let found: Result<Vec<_>, StudyError> = (0..count)
            .into_par_iter()
            .map(|seed| Ok(estimates(&mass_matrix(&model, &model.random(seed))?)?))
            .collect();
        let mut found = found?;
        found.sort_by(|a, b| a.kappa.total_cmp(&b.kappa));
        let mut missed = Vec::new();
        for (rank, found) in (1..).zip(found) {
            let scaled = found.diagonal_ratio * start.kappa / start.diagonal_ratio;
            missed.push((scaled / found.kappa - 1.0).abs());
            outside += usize::from(!holds(&found));
            let (lower, upper) = found.bracket;
            let row = [f64::from(rank), found.kappa, scaled, lower, upper, found.pivot_ratio];
            table.push([name.into()], row.map(Some));
        }
        let worst = missed.iter().copied().fold(0.0, f64::max);
        words.push(format!("{name} {:.0}% and {:.0}%", 100.0 * median(&missed), 100.0 * worst));
    }
    Ok(Outcome::new(table, Vec::new()).remarking(format!(
        "δ_s misses κ, in the median and at worst, by: {}. κ lay outside the bracket {outside} times.",
        words.join("; ")
    )))
}

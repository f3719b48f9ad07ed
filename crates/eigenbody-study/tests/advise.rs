//! Least armature: feasible where it was not looked at, and near the optimum where that can be had by force.

use eigenbody::search::Effort;
use eigenbody::{Family, Model, Question, Reduction, conditioning_at, mass_matrix};
use eigenbody_study::diagnosis::{Advice, Goal, least_armature};

fn advice(model: &Model<f64>, goal: Goal) -> Option<Advice> {
    let effort = Effort { samples: 128, ..Effort::default() };
    least_armature(model, Reduction::default(), goal, effort).unwrap()
}

/// λmin and κ with other armature.
fn at(model: &Model<f64>, armature: &[f64], q: &[f64]) -> (f64, f64) {
    let mended = model.clone().with_armature(armature.to_vec()).unwrap();
    let verdict = conditioning_at(&mended, q, &Question::default()).unwrap();
    (verdict.lambda_min.unwrap(), verdict.kappa.unwrap())
}

fn chain(n: usize, taper: f64) -> Model<f64> {
    Family::hydra(n, 1.0, 0.0, taper).unwrap().model().unwrap()
}

#[test]
fn goals_hold_at_fresh_configurations() {
    for (model, goal) in [
        (chain(4, 0.7), Goal::LambdaMin(0.05)),
        (chain(4, 0.7), Goal::Kappa(300.0)),
        (chain(7, 0.8), Goal::Kappa(1000.0)),
    ] {
        let found = advice(&model, goal).unwrap();
        for seed in 0..500 {
            let (least, kappa) = at(&model, &found.armature, &model.random(1000 + seed));
            match goal {
                Goal::LambdaMin(wanted) => assert!(least >= wanted, "{goal:?}: {least}"),
                Goal::Kappa(wanted) => assert!(kappa <= wanted, "{goal:?}: {kappa}"),
            }
        }
    }
}

/// Two joints: every pair of armatures on a grid of one percent, every configuration on a fine grid.
#[test]
fn within_five_percent_of_brute_force() {
    let model = chain(2, 0.6);
    for goal in [Goal::LambdaMin(0.03), Goal::Kappa(25.0)] {
        let found = advice(&model, goal).unwrap();
        let size: Vec<f64> = found
            .added
            .iter()
            .enumerate()
            .map(
                |(d, added)| {
                    if added.added > 0.0 { added.added / added.inflation } else { typical(&model, d) }
                },
            )
            .collect();
        let cost = |a: &[f64]| a.iter().zip(&size).map(|(a, s)| a / s).sum::<f64>();
        let spent = cost(&found.added.iter().map(|added| added.added).collect::<Vec<_>>());
        let holds = |a: [f64; 2]| {
            (0..48).all(|k| {
                let (least, kappa) = at(&model, &a, &[0.0, std::f64::consts::TAU * f64::from(k) / 48.0]);
                match goal {
                    Goal::LambdaMin(wanted) => least >= wanted,
                    Goal::Kappa(wanted) => kappa <= wanted,
                }
            })
        };
        // Along every direction of the plane, the least length that holds.
        let mut best = f64::INFINITY;
        for k in 0..=40 {
            let part = f64::from(k) / 40.0;
            let along = |t: f64| [t * part * size[0], t * (1.0 - part) * size[1]];
            let (mut low, mut high) = (0.0, 20.0);
            if !holds(along(high)) {
                continue;
            }
            for _ in 0..30 {
                let middle = 0.5 * (low + high);
                if holds(along(middle)) { high = middle } else { low = middle }
            }
            best = best.min(cost(&along(high)));
        }
        assert!(spent <= 1.05 * best, "{goal:?}: {spent} {best}");
    }
}

/// Median of H_dd over a turn.
fn typical(model: &Model<f64>, d: usize) -> f64 {
    let mut own: Vec<f64> = (0..48)
        .map(|k| mass_matrix(model, &[0.0, std::f64::consts::TAU * f64::from(k) / 48.0]).unwrap()[(d, d)])
        .collect();
    own.sort_by(f64::total_cmp);
    own[24]
}

#[test]
fn nothing_is_added_where_nothing_is_needed() {
    let found = advice(&chain(3, 1.0), Goal::Kappa(1e4)).unwrap();
    assert!(found.added.iter().all(|added| added.added == 0.0), "{found:?}");
}

#[test]
fn what_armature_cannot_do_is_said() {
    // κ of at least one always, and never below.
    assert_eq!(advice(&chain(3, 1.0), Goal::Kappa(0.5)), None);
}

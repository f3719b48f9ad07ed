//! Least armature: feasible where it was not looked at, and near the optimum where that can be had by force.

use eigenbody::model::JointSpec;
use eigenbody::search::Effort;
use eigenbody::spatial::{RigidInertia, Sym3, Vec3};
use eigenbody::stability::{Impedance, Integrator, Spring, SpringSource, largest_step};
use eigenbody::{
    Base, Family, Joint, Model, ModelBuilder, Question, Reduction, conditioning_at, mass_matrix,
};
use eigenbody_study::diagnosis::{Advice, Goal, Wish, least_armature, remedies};

fn advice(model: &Model<f64>, goal: Goal) -> Option<Advice> {
    let effort = Effort { samples: 128, ..Effort::default() };
    let wish = Wish { reduction: Reduction::default(), goal, effort, springs: &[] };
    least_armature(model, &wish).unwrap()
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
                Goal::Kappa(wanted) | Goal::Step(wanted, _) => assert!(kappa <= wanted, "{goal:?}: {kappa}"),
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
                    Goal::Kappa(wanted) | Goal::Step(wanted, _) => kappa <= wanted,
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

/// A spring and a damper on every joint.
fn driven(model: &Model<f64>, kp: f64, kd: f64) -> Vec<Spring> {
    let spring = |d: usize| Spring {
        name: model.dof_name(d),
        source: SpringSource::Actuator,
        arms: vec![(d, 1.0)],
        stiffness: kp,
        damping: kd,
    };
    (0..model.nv()).map(spring).collect()
}

fn wish(goal: Goal, springs: &[Spring]) -> Wish<'_> {
    let effort = Effort { samples: 128, ..Effort::default() };
    Wish { reduction: Reduction::default(), goal, effort, springs }
}

/// A step is stable with the armature wherever the robot is, and not with nine tenths of it in the worst place.
#[test]
fn a_step_is_made_stable() {
    for (model, kp, kd, step) in
        [(chain(3, 0.6), 50.0, 1.0, 0.02), (chain(5, 0.8), 0.0, 2.0, 0.01), (chain(4, 0.7), 200.0, 0.0, 0.01)]
    {
        let springs = driven(&model, kp, kd);
        let goal = Goal::Step(step, Integrator::SemiImplicitEuler);
        let found = least_armature(&model, &wish(goal, &springs)).unwrap().unwrap();
        assert!(found.added.iter().any(|added| added.added > 0.0));
        let impedance = Impedance::new(&model, Reduction::default(), &springs).unwrap();
        let bears = |part: f64, q: &[f64]| {
            let armature = found.armature.iter().map(|a| part * a).collect();
            let mended = model.clone().with_armature(armature).unwrap();
            let H = mass_matrix(&mended, q).unwrap();
            largest_step(&H, &impedance, Integrator::SemiImplicitEuler).unwrap().step
        };
        let mut least = f64::INFINITY;
        for seed in 0..300 {
            let q = model.random(seed);
            assert!(bears(1.0, &q) >= step, "{seed}");
            least = least.min(bears(0.9, &q));
        }
        assert!(least < step, "nine tenths would do: {least}");
    }
}

/// The second link of a planar pair: only its mass and its moment about z count, so all changes are a plane.
#[test]
fn matter_within_five_percent_of_brute_force() {
    let model = chain(2, 0.6);
    for goal in [Goal::LambdaMin(0.03), Goal::Kappa(25.0)] {
        let found = remedies(&model, &wish(goal, &[])).unwrap();
        let link = found.links.iter().find(|link| link.link == model.links().last().unwrap().name()).unwrap();
        let inertia = link.mended;
        let (m, c, I) = inertia.central();
        let [before, added] = link.inertia;
        let trace = |I: eigenbody::spatial::Sym3<f64>| I.xx + I.yy + I.zz;
        let least_moment = 0.5 * (trace(added) - 2.0 * added.zz).min(0.0);
        assert!(least_moment.abs() < 1e-6 * trace(added).max(1e-12), "what is added is matter");
        let holds = |mass: f64, moment: f64| {
            let mut heavier = I - added;
            heavier.zz += moment;
            heavier.xx += moment;
            let own = eigenbody::spatial::RigidInertia::from_com(link.mass[0] + mass, c, heavier);
            let mended = model.clone().with_inertia(link.index, own).unwrap();
            (0..48).all(|k| {
                let q = [0.0, std::f64::consts::TAU * f64::from(k) / 48.0];
                let verdict = conditioning_at(&mended, &q, &Question::default()).unwrap();
                match goal {
                    Goal::LambdaMin(wanted) => verdict.lambda_min.unwrap() >= wanted,
                    Goal::Kappa(wanted) | Goal::Step(wanted, _) => verdict.kappa.unwrap() <= wanted,
                }
            })
        };
        assert!((m - link.mass[0] - link.mass[1]).abs() < 1e-12);
        assert!(holds(link.mass[1], added.zz), "{goal:?}");
        // tr Σ = ½ tr I; a moment about z alone is a second moment of the same size.
        let spread = 0.5 * trace(before);
        let mut best = f64::INFINITY;
        for k in 0..=20 {
            let part = f64::from(k) / 20.0;
            let at = |t: f64| (t * part * link.mass[0], t * (1.0 - part) * spread);
            let (mut low, mut high) = (0.0, 1e3);
            if !holds(at(high).0, at(high).1) {
                continue;
            }
            for _ in 0..40 {
                let middle = 0.5 * (low + high);
                if holds(at(middle).0, at(middle).1) { high = middle } else { low = middle }
            }
            best = best.min(high);
        }
        assert!(link.cost <= 1.05 * best, "{goal:?}: {} {best}", link.cost);
    }
}

/// A neck whose outer axes align at roll = 0: how far roll must stay away is known by a fine grid.
#[test]
fn a_limit_avoids_the_alignment() {
    let mut robot = ModelBuilder::new("neck");
    let head = RigidInertia::from_com(1.0, Vec3::new(0.2, 0.0, 0.1), Sym3::diagonal(0.01, 0.02, 0.025));
    let light = RigidInertia::from_com(1e-6, Vec3::ZERO, Sym3::diagonal(1e-9, 1e-9, 1e-9));
    let links = [("base", light), ("first", light), ("second", light), ("head", head)];
    let [base, first, second, last] = links.map(|(name, inertia)| robot.link(name, inertia));
    robot.joint(JointSpec::new("yaw", Joint::Revolute, base, first).about(Vec3::Z));
    let roll = JointSpec::new("roll", Joint::Revolute, first, second).about(Vec3::X);
    robot.joint(JointSpec { limits: Some((-0.4, 1.2)), ..roll });
    robot.joint(JointSpec::new("twist", Joint::Revolute, second, last).about(Vec3::Z));
    let neck = robot.build(Base::Fixed).unwrap();
    let most = 2000.0;
    let found = remedies(&neck, &wish(Goal::Kappa(most), &[])).unwrap();
    let limit = &found.limits[0];
    assert_eq!((limit.joint.as_str(), limit.kept.1), ("roll", 1.2));
    assert!(limit.reached <= most);
    let worst = |roll: f64| {
        (0..720).fold(0.0f64, |worst, k| {
            let q = [0.0, roll, std::f64::consts::TAU * f64::from(k) / 720.0];
            worst.max(conditioning_at(&neck, &q, &Question::default()).unwrap().kappa.unwrap())
        })
    };
    let needed = (0..1200)
        .map(|k| f64::from(k) * 1e-3)
        .find(|&roll| (0..5).all(|j| worst(roll + 0.2 * f64::from(j)) <= most));
    let needed = needed.unwrap();
    // To 5% of what is given away, and the bisection's last step.
    assert!((limit.kept.0 - needed).abs() <= 0.05 * (needed + 0.4) + 0.8 / 128.0, "{limit:?} {needed}");
    assert!(
        found.links.iter().any(|link| link.link == "second" || link.link == "first"),
        "{:?}",
        found.links
    );
}

#[test]
fn authored_armature_is_held_against_what_is_needed() {
    let model = chain(3, 0.6).with_armature(vec![0.0, 5.0, 0.0]).unwrap();
    let found = advice(&model, Goal::LambdaMin(0.02)).unwrap();
    let added = &found.added[1];
    // Much more than anything that could be needed there.
    assert!(
        added.authored == 5.0 && added.needed.unwrap() < 0.1 && found.added[2].needed.unwrap() > 0.0,
        "{found:?}"
    );
    assert!(advice(&chain(3, 0.6), Goal::LambdaMin(0.02)).unwrap().added.iter().all(|a| a.needed.is_none()));
    let sum: f64 = found.added.iter().map(|a| a.added).sum();
    assert!(found.energy > 0.0 && found.energy < sum);
}

//! Extremes along motions: exact at every step, at about one factorisation an end, lost ends found again.

use crate::robots::plan;
use eigenbody::spectrum::sturm::Pencil;
use eigenbody::spectrum::{Metric, Precision, Reading, Tracker, extremes};
use eigenbody::{Base, Family, Model, ModelBuilder, forward_dynamics};

/// λmin and λmax without memory.
fn cold(model: &Model<f64>, q: &[f64], metric: &Metric<f64>, free_floating: bool) -> [f64; 2] {
    let pencil = Pencil::euclidean(model, q, free_floating).unwrap();
    let B = pencil.weights(metric, &pencil.diagonal()).unwrap();
    let ends = extremes(&pencil.with_metric(B).unwrap(), Precision::Auto).unwrap();
    [ends.min.unwrap().value, ends.max.value]
}

#[track_caller]
fn assert_agree(readings: [Reading; 2], expected: [f64; 2], at: &str) {
    for (reading, expected) in readings.iter().zip(expected) {
        // the residual's square over the gap, and what the cold value itself is known to
        let error = (reading.value / expected - 1.0).abs();
        assert!(error <= 1e-12, "{at}: {reading:?}, expected {expected}");
    }
}

/// A chain let go from 30 degrees below the horizontal, 1 ms steps.
fn swing(n: usize, steps: usize, metric: &Metric<f64>) {
    let chain: Model<f64> = Family::slender_chain(n, 1.0, 1.0).unwrap().model().unwrap();
    let (mut q, mut v) = (vec![0.0; n], vec![0.0; n]);
    q[0] = -0.5;
    let mut tracker = Tracker::new(&chain, &q, metric, false).unwrap();
    let mut spent = 0;
    for step in 0..steps {
        let vdot = forward_dynamics(&chain, &q, &v, &vec![0.0; n]).unwrap();
        for d in 0..n {
            v[d] += 1e-3 * vdot[d];
            q[d] += 1e-3 * v[d];
        }
        let readings = tracker.update(&q).unwrap();
        spent += readings.iter().map(|reading| reading.factorisations).sum::<usize>();
        if step % (n / 4).max(1) == 0 {
            assert_agree(readings, cold(&chain, &q, metric, false), &format!("{n} links, step {step}"));
        }
    }
    let mean = spent as f64 / (2 * steps) as f64;
    assert!(mean <= 1.1, "{n} links: {mean} factorisations a step and end");
}

#[test]
fn swinging_chains() {
    swing(1, 300, &Metric::Euclidean);
    swing(4, 1000, &Metric::Euclidean);
    swing(10, 600, &Metric::Euclidean);
    swing(20, 400, &Metric::UnitDiagonal);
    swing(100, 200, &Metric::Euclidean);
    swing(1000, 60, &Metric::Euclidean);
}

/// Trees of every joint kind, fixed and floating, full and reduced, moved along a constant velocity.
#[test]
fn trees_with_every_joint() {
    for (seed, base, free_floating) in
        [(1, Base::Fixed, false), (2, Base::Floating, false), (3, Base::Floating, true)]
    {
        let robot: Model<f64> = plan(seed, 15).build(base);
        let mut q = robot.random(seed);
        let v: Vec<f64> = (0..robot.nv()).map(|d| 1e-3 * ((d * 7 % 11) as f64 - 5.0) / 5.0).collect();
        let metric = Metric::Length(0.3);
        let mut tracker = Tracker::new(&robot, &q, &metric, free_floating).unwrap();
        for step in 0..200 {
            q = robot.integrate(&q, &v).unwrap();
            let readings = tracker.update(&q).unwrap();
            assert_agree(
                readings,
                cold(&robot, &q, &metric, free_floating),
                &format!("seed {seed}, step {step}"),
            );
        }
    }
}

/// Two arms on one base share no inertia, so their eigenvalues cross exactly as one folds and the other unfolds. The iteration
/// stays on its own arm; the count says that this is no longer the end.
#[test]
fn a_crossing_is_noticed() {
    let arms = two_arms();
    let pose = |s: f64| [0.0, 2.5 * s, 0.0, 2.5 * (1.0 - s)];
    let mut tracker = Tracker::new(&arms, &pose(0.0), &Metric::Euclidean, false).unwrap();
    let mut restarts = 0;
    for step in 1..=400 {
        let q = pose(f64::from(step) / 400.0);
        let readings = tracker.update(&q).unwrap();
        restarts += readings.iter().filter(|reading| reading.restarted).count();
        assert_agree(readings, cold(&arms, &q, &Metric::Euclidean, false), &format!("step {step}"));
    }
    assert!((1..=6).contains(&restarts), "{restarts} restarts");
}

fn two_arms() -> Model<f64> {
    use eigenbody::Joint;
    use eigenbody::model::JointSpec;
    use eigenbody::spatial::{RigidInertia, Sym3, Transform, Vec3};
    let mut robot = ModelBuilder::new("two arms");
    let base = robot.link("base", RigidInertia::ZERO);
    for side in ["left", "right"] {
        let mut parent = base;
        for (k, offset) in [0.0, 1.0].into_iter().enumerate() {
            let rod = RigidInertia::from_com(1.0, Vec3::new(0.5, 0.0, 0.0), Sym3::diagonal(0.01, 0.08, 0.08));
            let link = robot.link(format!("{side} {k}"), rod);
            let placement = Transform::translation(Vec3::X * offset);
            robot.joint(JointSpec::new(format!("{side} {k}"), Joint::Revolute, parent, link).at(placement));
            parent = link;
        }
    }
    robot.build(Base::Fixed).unwrap()
}

/// A jump across configuration space: however far, the values are those of the new place.
#[test]
fn a_jump_is_survived() {
    let robot: Model<f64> = Family::hydra(12, 1.5, 0.4, 0.9).unwrap().model().unwrap();
    let mut tracker = Tracker::new(&robot, &robot.random(1), &Metric::Euclidean, false).unwrap();
    for seed in 2..60 {
        let q = robot.random(seed);
        let readings = tracker.update(&q).unwrap();
        assert_agree(readings, cold(&robot, &q, &Metric::Euclidean, false), &format!("jump to {seed}"));
    }
}

/// Nothing is allocated: in step, where ends are lost, and in trees, moving metrics included.
#[test]
fn updates_allocate_nothing() {
    let chain: Model<f64> = Family::slender_chain(10, 1.0, 1.0).unwrap().model().unwrap();
    let tree: Model<f64> = plan(3, 15).build(Base::Floating);
    for (robot, free_floating) in [(&chain, false), (&tree, false), (&tree, true)] {
        for metric in [Metric::Euclidean, Metric::UnitDiagonal] {
            let mut q = robot.random(1);
            let mut tracker = Tracker::new(robot, &q, &metric, free_floating).unwrap();
            let (mut in_step, mut restarted) = (0, 0);
            for step in 0..20 {
                if step % 5 == 4 {
                    q = robot.random(step);
                } else {
                    q = robot.integrate(&q, &vec![1e-5; robot.nv()]).unwrap();
                }
                let mut lost = 0;
                let counted = allocation_counter::measure(|| {
                    lost = tracker.update(&q).unwrap().iter().filter(|reading| reading.restarted).count();
                });
                assert_eq!(counted.count_total, 0, "step {step}");
                restarted += lost;
                in_step += 2 - lost;
            }
            assert!(in_step > 0 && restarted > 0, "{in_step} in step, {restarted} restarted");
        }
    }
}

/// Two arms that move alike: every eigenvalue is double, at every step, and no step costs more than one count besides.
#[test]
fn double_eigenvalues_are_certified() {
    let arms = two_arms();
    let mut tracker = Tracker::new(&arms, &[0.0; 4], &Metric::Euclidean, false).unwrap();
    let mut spent = 0;
    for step in 1..=200 {
        let bend = 2e-3 * f64::from(step);
        let q = [0.0, bend, 0.0, bend];
        let readings = tracker.update(&q).unwrap();
        spent += readings.iter().map(|reading| reading.factorisations).sum::<usize>();
        assert_agree(readings, cold(&arms, &q, &Metric::Euclidean, false), &format!("step {step}"));
    }
    let mean = f64::from(u32::try_from(spent).unwrap()) / 400.0;
    assert!(mean < 2.5, "{mean} factorisations a step and end");
}

#[test]
fn what_does_not_fit_is_refused() {
    let robot: Model<f64> = Family::hydra(3, 1.0, 0.0, 1.0).unwrap().model().unwrap();
    assert!(Tracker::new(&robot, &[0.0; 2], &Metric::Euclidean, false).is_err());
    assert!(Tracker::new(&robot, &[0.0; 3], &Metric::Euclidean, true).is_err());
    assert!(Tracker::new(&robot, &[0.0; 3], &Metric::Diagonal(vec![1.0; 2]), false).is_err());
    let mut tracker = Tracker::new(&robot, &[0.0; 3], &Metric::Euclidean, false).unwrap();
    assert!(tracker.update(&[f64::NAN, 0.0, 0.0]).is_err());
    // and goes on from where it was
    assert!(!tracker.update(&[1e-4, 0.0, 0.0]).unwrap()[0].restarted);
}

/// An eigenvalue may lie between the shift and the one that iteration found, and then a count at the shift alone is no proof: jumps
/// between random configurations of a chain of twenty skew links meet such cases.
#[test]
fn nothing_hides_between_shift_and_value() {
    let robot: Model<f64> = Family::hydra(20, 1.0, 0.5, 1.0).unwrap().model().unwrap();
    let mut tracker = Tracker::new(&robot, &robot.random(0), &Metric::Euclidean, false).unwrap();
    for seed in 1..300 {
        let q = robot.random(seed);
        assert_agree(
            tracker.update(&q).unwrap(),
            cold(&robot, &q, &Metric::Euclidean, false),
            &format!("{seed}"),
        );
    }
}

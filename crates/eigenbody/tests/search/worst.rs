use crate::robots::plan;
use eigenbody::search::{Effort, Evaluator, Measure, survey};
use eigenbody::{Base, Error, Family, Joint, Metric, Model, Reduction};
use std::ops::ControlFlow::{Break, Continue};
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

fn quick(samples: u32) -> Effort {
    Effort { samples, starts: 6, ..Effort::default() }
}

#[test]
fn a_chain_is_worst_stretched_out() {
    let chain: Model<f64> = Family::hydra(10, 1.0, 0.0, 1.0).unwrap().model().unwrap();
    let found =
        survey(&chain, Reduction::default(), &Metric::Euclidean, quick(256), |_| Continue(())).unwrap();
    let [kappa, _, least] = &found.spreads;
    // The last digits of 1/κ at a smooth minimum: descent stops where it falls by 1e-9.
    assert!((kappa.worst / 42907.972749 - 1.0).abs() < 1e-6, "{kappa:?}");
    assert!(kappa.median < kappa.tenth && kappa.tenth < kappa.worst, "{kappa:?}");
    assert!(least.worst < least.tenth && least.tenth < least.median, "{least:?}");
}

/// At least 99% of the best of a fine grid, on random robots of three joints.
#[test]
fn no_grid_finds_much_worse() {
    for seed in 0..6 {
        let mut plan = plan::<f64>(900 + seed, 3);
        for joint in &mut plan.joints {
            (joint.kind, joint.armature) = (Joint::Revolute, Vec::new());
        }
        let model: Model<f64> = plan.build(Base::Fixed);
        let found =
            survey(&model, Reduction::default(), &Metric::Euclidean, quick(256), |_| Continue(())).unwrap();
        let mut evaluator = Evaluator::new(&model, Reduction::default(), Metric::Euclidean).unwrap();
        const STEPS: usize = 16;
        let angle = |k: usize| std::f64::consts::TAU * (k % STEPS) as f64 / STEPS as f64;
        let mut best = [f64::INFINITY; 3];
        for k in 0..STEPS.pow(3) {
            let q = [k, k / STEPS, k / STEPS / STEPS].map(angle);
            let values = evaluator.values(&q).unwrap();
            for (best, measure) in best.iter_mut().zip(Measure::ALL) {
                *best = best.min(values.cost(measure));
            }
        }
        for ((grid, measure), spread) in best.into_iter().zip(Measure::ALL).zip(&found.spreads) {
            let reached = evaluator.values(&spread.at).unwrap().cost(measure);
            assert!(reached <= grid / 0.99, "seed {seed} {measure:?}: {reached} {grid}");
        }
    }
}

#[test]
fn the_same_by_seed_and_threads() {
    let chain: Model<f64> = Family::hydra(5, 1.5, 0.5, 0.8).unwrap().model().unwrap();
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            survey(&chain, Reduction::default(), &Metric::Euclidean, quick(64), |_| Continue(())).unwrap()
        })
    };
    assert_eq!(run(1), run(2));
}

#[test]
fn a_singular_configuration_is_found() {
    // Two axes that align across a massless link where the second joint is at zero.
    use eigenbody::ModelBuilder;
    use eigenbody::model::JointSpec;
    use eigenbody::spatial::{RigidInertia, Sym3, Vec3};
    let mut robot = ModelBuilder::new("neck");
    let frame = robot.link("base", RigidInertia::ZERO);
    let light = robot.link("light", RigidInertia::ZERO);
    let lighter = robot.link("lighter", RigidInertia::ZERO);
    let head = RigidInertia::from_com(1.0, Vec3::new(0.0, 0.0, 0.1), Sym3::diagonal(0.01, 0.02, 0.03));
    let head = robot.link("head", head);
    robot.joint(JointSpec::new("pitch", Joint::Revolute, frame, light).about(Vec3::Z));
    robot.joint(JointSpec::new("roll", Joint::Revolute, light, lighter).about(Vec3::X));
    robot.joint(JointSpec::new("yaw", Joint::Revolute, lighter, head).about(Vec3::Z));
    let neck: Model<f64> = robot.build(Base::Fixed).unwrap();
    let found =
        survey(&neck, Reduction::default(), &Metric::Euclidean, quick(128), |_| Continue(())).unwrap();
    for spread in &found.spreads {
        let roll = spread.at[1];
        assert!(roll.sin().abs() < 1e-4, "{spread:?}");
    }
    assert!(found.spreads[0].worst > 1e8 && found.spreads[2].worst < 1e-9, "{found:?}");
}

/// A sample in lanes, on the tree, and along mimic joints: the same values as one by one.
#[test]
fn many_values_are_those_of_each() {
    let tree: Model<f64> = Family::auto_tree(12, 1.5, 0.3, 0.9).unwrap().floating().model().unwrap();
    for (base, metric) in
        [(false, Metric::Euclidean), (false, Metric::UnitDiagonal), (true, Metric::Euclidean)]
    {
        let reduction = Reduction { base, ..Reduction::default() };
        let mut evaluator = Evaluator::new(&tree, reduction, metric).unwrap();
        let all: Vec<Vec<f64>> = (0..70).map(|seed| tree.random(seed)).collect();
        let told = AtomicUsize::new(0);
        let count = |n| {
            told.fetch_add(n, Relaxed);
            Continue(())
        };
        let found = evaluator.values_of_all(&all, &count).unwrap();
        assert_eq!(told.into_inner(), 70);
        for (q, found) in all.iter().zip(found) {
            let one = evaluator.values(q).unwrap();
            for measure in Measure::ALL {
                let (found, one) = (found.of(measure), one.of(measure));
                assert!((found / one - 1.0).abs() < 1e-8, "{base} {measure:?}: {found:e} {one:e}");
            }
        }
        let mut bad = all.clone();
        bad[3][0] = f64::NAN;
        assert!(evaluator.values_of_all(&bad, &|_| Continue(())).is_err());
    }
}

/// Among the samples of a small robot, of one without lanes, and among the descents.
#[test]
fn a_search_ends_when_it_is_told_to() {
    let chain: Model<f64> = Family::hydra(10, 1.0, 0.0, 1.0).unwrap().model().unwrap();
    let large: Model<f64> = Family::hydra(100, 1.0, 0.0, 1.0).unwrap().model().unwrap();
    for (model, after) in [(&chain, 0), (&large, 5), (&chain, 300)] {
        let told = AtomicUsize::new(0);
        let few = |n| match told.fetch_add(n, Relaxed) + n > after {
            true => Break(()),
            false => Continue(()),
        };
        let found = survey(model, Reduction::default(), &Metric::Euclidean, quick(256), few);
        assert_eq!(found, Err(Error::Interrupted));
        // A descent asks a few times more before it gives up.
        assert!(told.into_inner() < after + 512, "{after}");
    }
}

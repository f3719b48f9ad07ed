use eigenbody::error::InputError;
use eigenbody::model::{JointSpec, Random};
use eigenbody::spatial::{RigidInertia, Sym3, Vec3};
use eigenbody::{Base, Family, Joint, Model, ModelBuilder};

fn everything() -> Model<f64> {
    Family::auto_tree(8, 1.0, 0.2, 0.9).unwrap().model().unwrap()
}

#[test]
fn random_configurations_are_valid_and_repeat() {
    let model = everything();
    for seed in 0..50 {
        let q = model.random(seed);
        assert_eq!(q, model.random(seed));
        assert_ne!(q, model.random(seed + 1));
        model.check_q(&q).unwrap();
    }
}

/// The stream is part of the interface: SplitMix64 of seed 0 starts as its authors print it.
#[test]
fn stream_never_changes() {
    let mut random = Random::new(0);
    let expected = [0xe220_a839_7b1d_cdaf, 0x6e78_9e6a_a1b9_65f4, 0x06c4_5d18_8009_454f];
    assert_eq!([0; 3].map(|_| random.bits()), expected);
    let uniform = Random::new(0).uniform();
    assert_eq!(uniform, (0xe220_a839_7b1d_cdaf_u64 >> 11) as f64 / (1u64 << 53) as f64);
}

/// Rotations are uniform: the second moments of a uniform unit quaternion are 1/4 each.
#[test]
fn random_rotations_are_uniform() {
    let mut random = Random::new(5);
    let rounds = 20_000;
    let mut moments = [[0.0; 4]; 4];
    for _ in 0..rounds {
        let p = random.quaternion();
        for (row, a) in moments.iter_mut().zip(p) {
            row.iter_mut().zip(p).for_each(|(m, b)| *m += a * b / f64::from(rounds));
        }
    }
    for (i, row) in moments.iter().enumerate() {
        for (j, m) in row.iter().enumerate() {
            // Five standard deviations, each below 1/(3 √rounds)
            let expected = if i == j { 0.25 } else { 0.0 };
            assert!((m - expected).abs() < 5.0 / 3.0 / f64::from(rounds).sqrt(), "{moments:?}");
        }
    }
}

#[test]
fn limits_are_kept() {
    let mut robot = ModelBuilder::<f64>::new("limits");
    let base = robot.link("base", RigidInertia::ZERO);
    let unit = Sym3::diagonal(1.0, 1.0, 1.0);
    let mut parent = base;
    for (j, limits) in [Some((0.5, 0.75)), Some((f64::NEG_INFINITY, 1.0)), None].into_iter().enumerate() {
        let link = robot.link(format!("l{j}"), RigidInertia::from_com(1.0, Vec3::ZERO, unit));
        robot.joint(JointSpec { limits, ..JointSpec::new(format!("j{j}"), Joint::Revolute, parent, link) });
        parent = link;
    }
    let model = robot.build(Base::Fixed).unwrap();
    let mut beyond = [0; 2];
    for seed in 0..200 {
        let q = model.random(seed);
        assert!((0.5..0.75).contains(&q[0]), "{q:?}");
        for k in 0..2 {
            beyond[k] += usize::from(q[k + 1].abs() > 2.0);
        }
    }
    // Uniform over a whole turn: a third of them beyond 2 rad
    assert!(beyond.iter().all(|&n| (30..120).contains(&n)), "{beyond:?}");
}

#[test]
fn configurations_that_do_not_fit() {
    let model = everything();
    let q = model.neutral();
    let length = InputError::Length { what: "q", expected: 21, found: 20 };
    assert_eq!(model.check_q(&q[..20]), Err(length));
    let mut bad = q.clone();
    bad[3] = f64::NAN;
    assert_eq!(model.check_q(&bad), Err(InputError::NotFinite { what: "q", index: 3 }));
    // joint_7 is a ball at q[10..14]; joint_8 floats, its quaternion stands at q[17..21]
    for (index, joint) in [(10, "joint_7"), (17, "joint_8")] {
        let mut bad = q.clone();
        bad[index] = 1.1;
        let refused = InputError::NotUnitQuaternion { joint: joint.into(), index, norm: 1.1 };
        assert_eq!(model.check_q(&bad), Err(refused));
        bad[index] = 1.0 + 0.9e-6;
        assert_eq!(model.check_q(&bad), Ok(()));
    }
    let text = model.check_q(&[q[..17].to_vec(), vec![0.0; 4]].concat()).unwrap_err().to_string();
    assert_eq!(text, "q[17..21] of joint 'joint_8' has norm 0, expected a unit quaternion w, x, y, z");
}

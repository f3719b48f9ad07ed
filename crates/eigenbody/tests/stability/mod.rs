//! The largest stable step against the spectral radius of the step's own map, by another library's eigenvalues.

use eigenbody::model::Random;
use eigenbody::stability::{
    IMAGINARY_LIMIT, Impedance, Integrator, REAL_LIMIT, Spring, SpringSource, is_stable, largest_step,
};
use eigenbody::{Base, Error, Family, InputError, Joint, Matrix, ModelBuilder, Reduction, mass_matrix};
use nalgebra::DMatrix;

/// A Aᵀ with some rank, spread over some decades.
fn positive(random: &mut Random, n: usize, rank: usize, decades: f64) -> Matrix<f64> {
    let scale: Vec<f64> = (0..n).map(|_| 10f64.powf(random.between(-decades, 0.0))).collect();
    let A: Vec<f64> = (0..n * rank).map(|_| random.between(-1.0, 1.0)).collect();
    Matrix::from_fn(n, n, |i, j| {
        scale[i] * scale[j] * (0..rank).map(|k| A[i * rank + k] * A[j * rank + k]).sum::<f64>()
    })
}

/// H, and springs that do not commute with it.
fn system(seed: u64) -> (Matrix<f64>, Impedance) {
    let mut random = Random::new(seed);
    let n = 1 + (seed % 9) as usize;
    let H = positive(&mut random, n, n + 2, 1.5);
    let own: Vec<f64> = (0..n).map(|_| random.between(0.0, 0.5)).collect();
    let joint_damping = Matrix::from_fn(n, n, |i, j| if i == j { own[i] } else { 0.0 });
    let actuators = positive(&mut random, n, n, 1.0);
    let strength = 10f64.powf(random.between(-2.0, 2.0));
    let damping = Matrix::from_fn(n, n, |i, j| strength * (joint_damping[(i, j)] + actuators[(i, j)]));
    let joint_damping = Matrix::from_fn(n, n, |i, j| strength * joint_damping[(i, j)]);
    let stiffness = positive(&mut random, n, n, 2.0);
    let stiffness = Matrix::from_fn(n, n, |i, j| 100.0 * stiffness[(i, j)]);
    (H, Impedance { stiffness, damping, joint_damping })
}

fn dense(A: &Matrix<f64>) -> DMatrix<f64> {
    DMatrix::from_row_slice(A.rows(), A.cols(), A.as_slice())
}

/// [q; v] after a step as a matrix, by the method's definition.
fn map(H: &Matrix<f64>, impedance: &Impedance, integrator: Integrator, h: f64) -> DMatrix<f64> {
    let n = H.rows();
    let (M, K, D) = (dense(H), dense(&impedance.stiffness), dense(&impedance.damping));
    let implicit = match integrator {
        Integrator::SemiImplicitEuler => DMatrix::zeros(n, n),
        Integrator::DampedEuler => dense(&impedance.joint_damping),
        Integrator::ImplicitVelocity => D.clone(),
        Integrator::RungeKutta4 => {
            let inverse = M.try_inverse().unwrap();
            let mut A = DMatrix::zeros(2 * n, 2 * n);
            A.view_mut((0, n), (n, n)).copy_from(&DMatrix::identity(n, n));
            A.view_mut((n, 0), (n, n)).copy_from(&(-&inverse * K));
            A.view_mut((n, n), (n, n)).copy_from(&(-inverse * D));
            let z = A * h;
            let one = DMatrix::identity(2 * n, 2 * n);
            return &one + &z * (&one + &z / 2.0 * (&one + &z / 3.0 * (&one + &z / 4.0)));
        }
    };
    let inverse = (M + implicit * h).try_inverse().unwrap();
    let from_q = -&inverse * K * h;
    let from_v = DMatrix::identity(n, n) - inverse * D * h;
    let mut step = DMatrix::zeros(2 * n, 2 * n);
    step.view_mut((0, 0), (n, n)).copy_from(&(DMatrix::identity(n, n) + &from_q * h));
    step.view_mut((0, n), (n, n)).copy_from(&(&from_v * h));
    step.view_mut((n, 0), (n, n)).copy_from(&from_q);
    step.view_mut((n, n), (n, n)).copy_from(&from_v);
    step
}

fn spectral_radius(A: &DMatrix<f64>) -> f64 {
    A.complex_eigenvalues().iter().fold(0.0, |m, z| z.re.hypot(z.im).max(m))
}

/// 1e-3 to each side: spectral radii near one are known to about √ε where two eigenvalues meet.
#[test]
fn a_step_is_stable_up_to_the_limit_and_not_beyond() {
    let mut finite = 0;
    for seed in 0..200 {
        let (H, impedance) = system(seed);
        for integrator in Integrator::ALL {
            let limit = largest_step(&H, &impedance, integrator).unwrap();
            if limit.step.is_infinite() {
                let far = spectral_radius(&map(&H, &impedance, integrator, 1e4));
                assert!(far <= 1.0 + 1e-6, "{seed} {integrator:?} {far}");
                continue;
            }
            finite += 1;
            let radius = |part: f64| spectral_radius(&map(&H, &impedance, integrator, part * limit.step));
            let (below, above) = (radius(0.999), radius(1.001));
            assert!(below <= 1.0 + 1e-7, "{seed} {integrator:?} h = {} below: {below}", limit.step);
            assert!(above > 1.0, "{seed} {integrator:?} h = {} above: {above}", limit.step);
        }
    }
    assert!(finite > 700, "{finite}");
}

/// The mode is the motion on which the bound is attained: its Rayleigh quotient gives the step back.
#[test]
fn the_mode_sets_the_step() {
    for seed in 0..50 {
        let (H, impedance) = system(seed);
        let limit = largest_step(&H, &impedance, Integrator::SemiImplicitEuler).unwrap();
        let along = |A: &Matrix<f64>| -> f64 {
            limit.mode.iter().zip(A.times(&limit.mode)).map(|(x, y)| x * y).sum()
        };
        let h = limit.step;
        let found = (h * h * along(&impedance.stiffness) + 2.0 * h * along(&impedance.damping)) / along(&H);
        assert!((found - 4.0).abs() < 1e-6, "{seed}: {found}");
    }
}

#[test]
fn two_pencils_bracket_the_step() {
    let without = |n: usize| Matrix::zeros(n, n);
    for seed in 0..50 {
        let (H, impedance) = system(seed);
        let n = H.rows();
        let step =
            |impedance: &Impedance| largest_step(&H, impedance, Integrator::SemiImplicitEuler).unwrap().step;
        let stiff = step(&Impedance { damping: without(n), ..impedance.clone() });
        let damped = step(&Impedance { stiffness: without(n), ..impedance.clone() });
        let (k, d) = (4.0 / (stiff * stiff), 2.0 / damped);
        let (low, found) = (4.0 / (d + (d * d + 4.0 * k).sqrt()), step(&impedance));
        assert!(low * (1.0 - 1e-9) <= found && found <= stiff.min(damped) * (1.0 + 1e-9), "{seed}");
    }
}

#[test]
fn one_spring_or_one_damper_alone() {
    let H = Matrix::from_fn(1, 1, |_, _| 2.0);
    let spring = Impedance::diagonal(&[50.0], &[0.0]).unwrap();
    let damper = Impedance::diagonal(&[0.0], &[8.0]).unwrap();
    let step = |impedance: &Impedance, integrator| largest_step(&H, impedance, integrator).unwrap().step;
    // ω = 5/s, d = 4/s.
    for (integrator, of_spring, of_damper) in [
        (Integrator::SemiImplicitEuler, 2.0, 2.0),
        (Integrator::DampedEuler, 2.0, 2.0),
        (Integrator::ImplicitVelocity, 2.0, f64::INFINITY),
        (Integrator::RungeKutta4, IMAGINARY_LIMIT, REAL_LIMIT),
    ] {
        let (a, b) = (step(&spring, integrator) * 5.0, step(&damper, integrator) * 4.0);
        assert!((a - of_spring).abs() < 1e-8, "{integrator:?} {a}");
        assert!(b == of_damper || (b - of_damper).abs() < 1e-8, "{integrator:?} {b}");
    }
}

/// A tendon across two joints pulls on their sum; a mimic joint's spring is felt by its leader.
#[test]
fn springs_become_matrices() {
    let arm = Family::hydra(2, 1.0, 0.0, 1.0).unwrap().model::<f64>().unwrap();
    let tendon = Spring {
        name: "t".into(),
        source: SpringSource::Tendon,
        arms: vec![(0, 1.0), (1, -2.0)],
        stiffness: 3.0,
        damping: 0.5,
    };
    let own = Spring {
        name: "j".into(),
        source: SpringSource::Joint,
        arms: vec![(1, 1.0)],
        stiffness: 0.0,
        damping: 7.0,
    };
    let all = Impedance::new(&arm, Reduction::default(), &[tendon, own]).unwrap();
    assert_eq!(all.stiffness.as_slice(), [3.0, -6.0, -6.0, 12.0]);
    assert_eq!(all.damping.as_slice(), [0.5, -1.0, -1.0, 9.0]);
    assert_eq!(all.joint_damping.as_slice(), [0.0, 0.0, 0.0, 7.0]);
    assert!(all.is_passive().unwrap() && !all.is_zero());
    let H = mass_matrix(&arm, &[0.3, 0.4]).unwrap();
    assert!(largest_step(&H, &all, Integrator::RungeKutta4).unwrap().step > 0.0);
}

#[test]
fn a_spring_that_pushes_is_not_passive() {
    assert!(!Impedance::diagonal(&[1.0, -1.0], &[0.0; 2]).unwrap().is_passive().unwrap());
}

#[test]
fn a_follower_is_felt_by_its_leader() {
    use eigenbody::model::{JointSpec, MimicSpec};
    use eigenbody::spatial::{RigidInertia, Sym3, Vec3};
    let solid = RigidInertia::from_com(1.0, Vec3::X, Sym3::diagonal(0.1, 0.1, 0.1));
    let mut robot = ModelBuilder::new("pair");
    let [base, a, b] = ["base", "a", "b"].map(|name| robot.link(name, solid));
    robot.joint(JointSpec::new("first", Joint::Revolute, base, a));
    let mimic = Some(MimicSpec { joint: "first".into(), multiplier: -3.0, offset: 0.1 });
    robot.joint(JointSpec { mimic, ..JointSpec::new("second", Joint::Revolute, a, b) });
    let pair = robot.build(Base::Fixed).unwrap();
    let spring = Spring {
        name: "s".into(),
        source: SpringSource::Actuator,
        arms: vec![(1, 1.0)],
        stiffness: 2.0,
        damping: 0.0,
    };
    let reduction = Reduction { mimic: true, base: false };
    assert_eq!(Impedance::new(&pair, reduction, &[spring]).unwrap().stiffness.as_slice(), [18.0]);
}

/// 1e-3 to each side of the limit, as above.
#[test]
fn a_step_is_called_stable_up_to_the_limit() {
    for seed in 0..50 {
        let (H, impedance) = system(seed);
        for integrator in Integrator::ALL {
            let limit = largest_step(&H, &impedance, integrator).unwrap().step;
            let stable = |step| is_stable(&H, &impedance, integrator, step).unwrap();
            if limit.is_finite() {
                assert!(stable(0.999 * limit) && !stable(1.001 * limit), "{seed} {integrator:?}");
            }
        }
    }
    // Nothing is sure where H is singular.
    let (H, spring) = (Matrix::zeros(1, 1), Impedance::diagonal(&[1.0], &[0.0]).unwrap());
    for integrator in Integrator::ALL {
        assert_eq!(is_stable(&H, &spring, integrator, 1e-3), Ok(false));
    }
}

#[test]
fn matrices_that_do_not_fit_are_refused() {
    let H = Matrix::from_fn(2, 2, |i, j| if i == j { 1.0 } else { 0.0 });
    let good = Impedance::diagonal(&[1.0, 2.0], &[0.1, 0.2]).unwrap();
    let (nan, wide) = (Matrix::from_fn(2, 2, |i, _| [1.0, f64::NAN][i]), Matrix::zeros(2, 3));
    let refused =
        |what| [InputError::NotFinite { what, index: 2 }, InputError::Length { what, expected: 2, found: 3 }];
    let mut cases = Vec::new();
    for (k, bad) in [nan, wide].into_iter().enumerate() {
        let stiffness = Impedance { stiffness: bad.clone(), ..good.clone() };
        let damping = Impedance { damping: bad.clone(), ..good.clone() };
        let joints = Impedance { joint_damping: bad.clone(), ..good.clone() };
        cases.push((H.clone(), stiffness, refused("stiffness")[k].clone()));
        cases.push((H.clone(), damping, refused("damping")[k].clone()));
        cases.push((H.clone(), joints, refused("damping of joints")[k].clone()));
        cases.push((bad, good.clone(), refused("H")[k].clone()));
    }
    for (H, impedance, refused) in cases {
        for integrator in Integrator::ALL {
            let refused = Error::Input(refused.clone());
            assert_eq!(largest_step(&H, &impedance, integrator), Err(refused.clone()));
            assert_eq!(is_stable(&H, &impedance, integrator, 0.1), Err(refused));
        }
    }
    for (step, refused) in [
        (f64::NAN, InputError::NotFinite { what: "step", index: 0 }),
        (f64::INFINITY, InputError::NotFinite { what: "step", index: 0 }),
        (0.0, InputError::NotPositive { what: "step", index: 0, value: 0.0 }),
        (-1.0, InputError::NotPositive { what: "step", index: 0, value: -1.0 }),
    ] {
        assert_eq!(is_stable(&H, &good, Integrator::RungeKutta4, step), Err(Error::Input(refused)));
    }
}

#[test]
fn springs_that_do_not_fit_are_refused() {
    let length = |found| Err(InputError::Length { what: "damping", expected: 2, found });
    assert_eq!(Impedance::diagonal(&[1.0, 2.0], &[0.0]), length(1));
    assert_eq!(Impedance::diagonal(&[1.0, 2.0], &[0.0; 3]), length(3));
    let nan = InputError::NotFinite { what: "stiffness", index: 1 };
    assert_eq!(Impedance::diagonal(&[1.0, f64::NAN], &[0.0; 2]), Err(nan));

    let arm = Family::hydra(2, 1.0, 0.0, 1.0).unwrap().model::<f64>().unwrap();
    let spring = |d: usize, a: f64, stiffness: f64, damping: f64| {
        let (name, source) = ("s".into(), SpringSource::Joint);
        Spring { name, source, arms: vec![(d, a)], stiffness, damping }
    };
    let of = |second| Impedance::new(&arm, Reduction::default(), &[spring(0, 1.0, 1.0, 1.0), second]);
    assert_eq!(
        of(spring(2, 1.0, 1.0, 0.0)),
        Err(InputError::NoSuch { what: "degree of freedom", index: 2, count: 2 })
    );
    let refused = |what| Err(InputError::NotFinite { what, index: 1 });
    assert_eq!(of(spring(1, f64::NAN, 1.0, 0.0)), refused("arms of springs"));
    assert_eq!(of(spring(1, 1.0, f64::INFINITY, 0.0)), refused("stiffness of springs"));
    assert_eq!(of(spring(1, 1.0, 1.0, f64::NAN)), refused("damping of springs"));
    assert!(of(spring(1, 1.0, 1.0, 0.0)).is_ok());
}

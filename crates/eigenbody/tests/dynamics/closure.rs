//! Loops: Jacobians against differences, and the mass matrix of a four-bar against its loop equation.

use crate::robots::{configuration, numbers, plan};
use eigenbody::conditioning::{allowed_motions, close_loops, conditioning_closed};
use eigenbody::dynamics::{Anchor, Closure, Tie, closure_jacobian, closure_residual, link_pose};
use eigenbody::model::Random;
use eigenbody::spatial::{Mat3, Transform, Vec3};
use eigenbody::spectrum::null_space;
use eigenbody::{Base, Error, Family, InputError, Matrix, Metric, Model, Question, Reduction, mass_matrix};

/// A chain whose last link is pinned to a point of the world.
fn pinned(links: usize, at: Vec3<f64>, tie: Tie) -> (Model<f64>, Closure) {
    let model: Model<f64> = Family::hydra(links, 1.0, 0.0, 1.0).unwrap().model().unwrap();
    let tip = Anchor { link: Some(links), pose: Transform::translation(Vec3::X) };
    let world = Anchor { link: None, pose: Transform::translation(at) };
    (model, Closure { name: "tip".into(), tie, anchors: [world, tip] })
}

/// Every kind of tie on robots of every kind of joint, closed where it is: rows are derivatives of the residual.
#[test]
fn jacobian_is_the_derivative_of_the_residual() {
    let mut seen = 0;
    for seed in 0..40 {
        let base = if seed % 2 == 0 { Base::Fixed } else { Base::Floating };
        let model = plan::<f64>(seed, 2 + seed as usize / 3).build(base);
        let q = configuration(&model, seed);
        let mut random = Random::new(seed);
        let mut pick = |n: usize| random.between(0.0, n as f64) as usize;
        let links = [Some(pick(model.links().len())), (seed % 5 > 0).then(|| pick(model.links().len()))];
        let [w, x, y, z] = Random::new(seed + 99).quaternion();
        let place =
            Transform::new(Mat3::rotation_quaternion(w, Vec3::new(x, y, z)), Vec3::new(0.3, -0.2, 0.5));
        let anchor = |link: Option<usize>| {
            let from_world = link.map_or(Transform::IDENTITY, |l| link_pose(&model, &q, l).unwrap());
            Anchor { link, pose: place * from_world.inverse() }
        };
        let axis = Vec3::new(0.6, 0.0, 0.8);
        let universal = Tie::Universal { first: axis, second: Vec3::new(0.0, 0.6, 0.8) };
        for tie in [Tie::Weld, Tie::Ball, Tie::Hinge(axis), Tie::Slide(axis), universal] {
            let closure = [Closure { name: "c".into(), tie, anchors: links.map(anchor) }];
            let residual = |q: &[f64]| closure_residual(&model, q, &closure).unwrap();
            // A depth of up to 14 transforms of lengths near 1.
            let rounding = 100.0 * f64::EPSILON * model.bodies().len() as f64;
            assert!(residual(&q).iter().all(|x| x.abs() < rounding), "{tie:?}");
            let A = closure_jacobian(&model, &q, &closure).unwrap();
            let v = numbers::<f64>(model.nv(), seed);
            let step = 1e-5;
            let moved = |h: f64| model.integrate(&q, &v.iter().map(|v| v * h).collect::<Vec<_>>()).unwrap();
            let (after, before) = (residual(&moved(step)), residual(&moved(-step)));
            for (k, rate) in A.times(&v).into_iter().enumerate() {
                let difference = (after[k] - before[k]) / (2.0 * step);
                // step² of the third derivative, and rounding over the step
                assert!(
                    (rate - difference).abs() < 1e-7 * (1.0 + rate.abs()),
                    "{tie:?}: {rate} {difference}"
                );
                seen += usize::from(rate != 0.0);
            }
        }
    }
    assert!(seen > 300, "{seen}");
}

/// Three links and the ground: ω₂ = −ω₁ sin(θ₁−θ₃)/sin(θ₂−θ₃), ω₃ = −ω₁ sin(θ₁−θ₂)/sin(θ₃−θ₂), and λ = 2T/|q̇|².
#[test]
fn four_bar() {
    for tie in [Tie::Ball, Tie::Hinge(Vec3::Z), Tie::Universal { first: Vec3::Z, second: Vec3::X }] {
        let (model, tip) = pinned(3, Vec3::new(1.7, 0.0, 0.0), tie);
        let closures = [tip];
        let start = [1.2, -0.9, -1.0];
        let closed = close_loops(&model, &start, &closures, Reduction::default()).unwrap();
        assert!(closed.before > 1e-3 && closed.after <= 1e-11, "{closed:?}");
        let q = &closed.q;
        let theta = [q[0], q[0] + q[1], q[0] + q[1] + q[2]];
        let sine = |i: usize, j: usize| (theta[i] - theta[j]).sin();
        let w = [1.0, -sine(0, 2) / sine(1, 2), -sine(0, 1) / sine(2, 1)];
        let rates = [w[0], w[1] - w[0], w[2] - w[1]];
        // Thin tubes of 1 kg and 1 m, 1.015/12 kg m² about the centre.
        let (mut end, mut twice_energy) = ((0.0, 0.0), 0.0);
        for i in 0..3 {
            let (s, c) = theta[i].sin_cos();
            let centre = (end.0 - 0.5 * w[i] * s, end.1 + 0.5 * w[i] * c);
            twice_energy += centre.0 * centre.0 + centre.1 * centre.1 + 1.015 / 12.0 * w[i] * w[i];
            end = (end.0 - w[i] * s, end.1 + w[i] * c);
        }
        assert!(end.0.hypot(end.1) < 1e-10, "{end:?}");
        let expected = twice_energy / rates.iter().map(|r| r * r).sum::<f64>();
        let (verdict, allowed) = conditioning_closed(&model, q, &closures, &Question::default()).unwrap();
        assert_eq!((allowed.rank, allowed.H.rows(), verdict.kappa), (2, 1, Some(1.0)));
        let found = verdict.lambda_max.unwrap();
        // The loop is closed to 1e-11.
        assert!((found / expected - 1.0).abs() < 1e-10, "{found} {expected}");
        let mode = verdict.stiffest.unwrap();
        let size = rates.iter().map(|r| r * r).sum::<f64>().sqrt();
        let mismatch =
            mode.iter().zip(rates).map(|(x, r)| (x.abs() - (r / size).abs()).abs()).fold(0.0, f64::max);
        assert!(mismatch < 1e-10, "{mode:?} {rates:?}");
    }
}

/// Against nalgebra's singular vectors and eigenvalues, in a metric with lengths, with every row written twice.
#[test]
fn allowed_motions_against_another_library() {
    for seed in 0..20 {
        // A floating base moves both ends alike: its columns of A are zero, and reflections commute.
        let base = if seed % 2 == 0 { Base::Fixed } else { Base::Floating };
        let model = plan::<f64>(seed, 8).build(base);
        let q = configuration(&model, seed);
        let links = model.links().len();
        let [a, b] = [links - 1, links / 2];
        let anchor =
            |link: usize| Anchor { link: Some(link), pose: link_pose(&model, &q, link).unwrap().inverse() };
        let tie = Closure { name: "c".into(), tie: Tie::Ball, anchors: [anchor(a), anchor(b)] };
        let closures = [tie.clone(), tie];
        let metric = Metric::Length(0.4);
        let allowed = allowed_motions(&model, &q, &closures, Reduction::default(), &metric).unwrap();
        let H = mass_matrix(&model, &q).unwrap();
        let B = metric.weights(&model, &H).unwrap();
        let A = closure_jacobian(&model, &q, &closures).unwrap();
        let n = model.nv();
        let units = nalgebra::DMatrix::from_diagonal(&nalgebra::DVector::from_iterator(
            n,
            B.iter().map(|b| b.powf(-0.5)),
        ));
        let dense = |M: &Matrix<f64>| nalgebra::DMatrix::from_row_slice(M.rows(), M.cols(), M.as_slice());
        let scaled = dense(&A) * &units;
        let pairs = (scaled.transpose() * &scaled).symmetric_eigen();
        // Squared singular values: rank by half the digits.
        let cut = 1e-10 * pairs.eigenvalues.max();
        let free: Vec<usize> = (0..n).filter(|&k| pairs.eigenvalues[k] <= cut).collect();
        assert_eq!((allowed.H.rows(), allowed.rank), (free.len(), n - free.len()), "{seed}");
        let N = &units * pairs.eigenvectors.select_columns(&free);
        let forbidden = dense(&A) * dense(&allowed.basis);
        // n ε of the entries, and the rank tolerance
        assert!(forbidden.iter().all(|x| x.abs() < 1e-8 * A.max_abs()), "{seed}: {}", forbidden.amax());
        let mut expected: Vec<f64> =
            (N.transpose() * dense(&H) * &N).symmetric_eigenvalues().iter().copied().collect();
        let mut found: Vec<f64> = dense(&allowed.H).symmetric_eigenvalues().iter().copied().collect();
        expected.sort_by(f64::total_cmp);
        found.sort_by(f64::total_cmp);
        let scale = expected.last().copied().unwrap_or(1.0);
        for (x, y) in expected.iter().zip(&found) {
            // √ε-accurate null vectors of the normal equations, squared in a Rayleigh quotient
            assert!((x - y).abs() < 1e-9 * scale, "{seed}: {x} {y}");
        }
    }
}

/// N spans what A leaves and is orthonormal.
#[test]
fn null_spaces_are_orthonormal() {
    for seed in 0..30 {
        let (m, n) = (1 + seed as usize % 7, 2 + seed as usize % 11);
        let entries = numbers::<f64>(m * n, seed);
        // Every third row repeats the first.
        let A = Matrix::from_fn(m, n, |i, j| entries[if i % 3 == 2 { 0 } else { i } * n + j]);
        let found = null_space(&A, 1e-12).unwrap();
        let N = &found.basis;
        assert_eq!(found.rank, (m - m / 3).min(n));
        assert_eq!((N.rows(), N.cols()), (n, n - found.rank));
        let column = |j: usize| (0..n).map(|i| N[(i, j)]).collect::<Vec<_>>();
        let tolerance = 30.0 * n as f64 * f64::EPSILON;
        for j in 0..N.cols() {
            assert!(A.times(&column(j)).iter().all(|x| x.abs() < tolerance * A.max_abs()));
            for k in 0..N.cols() {
                let dot: f64 = column(j).iter().zip(column(k)).map(|(a, b)| a * b).sum();
                assert!((dot - f64::from(u8::from(j == k))).abs() < tolerance);
            }
        }
    }
}

#[test]
fn loops_out_of_reach_are_an_error() {
    let (model, tip) = pinned(2, Vec3::new(2.5, 0.0, 0.0), Tie::Ball);
    let error = close_loops(&model, &[0.3, 0.4], &[tip], Reduction::default()).unwrap_err();
    assert!(
        matches!(&error, Error::Open { closure, after, .. } if closure == "tip" && *after > 0.4),
        "{error}"
    );
}

#[test]
fn anchors_are_frames() {
    for E in [Mat3::IDENTITY * 2.0, Mat3::from_rows(Vec3::X, Vec3::Y, -Vec3::Z), Mat3::IDENTITY * f64::NAN] {
        for k in 0..2 {
            let (model, mut tip) = pinned(2, Vec3::X, Tie::Weld);
            tip.anchors[k].pose.E = E;
            let refused = InputError::NotARotation { closure: "tip".into() };
            let closures = [tip];
            assert_eq!(closure_residual(&model, &[0.1, 0.2], &closures), Err(refused.clone()));
            assert_eq!(closure_jacobian(&model, &[0.1, 0.2], &closures), Err(refused));
        }
    }
    let (model, tip) = pinned(2, Vec3::new(0.0, f64::NAN, 0.0), Tie::Ball);
    let refused = InputError::NotFinite { what: "origin of an anchor", index: 1 };
    assert_eq!(closure_residual(&model, &[0.1, 0.2], &[tip]), Err(refused));
}

/// A weld that is off by nearly half a turn says so to rounding: the angle is π − δ about the axis, whatever δ.
#[test]
fn welds_near_half_a_turn() {
    use std::f64::consts::PI;
    let axis = Vec3::new(0.48, -0.6, 0.64);
    for k in 0..18 {
        let angle = PI - 10f64.powi(-k);
        let (model, mut weld) = pinned(1, Vec3::ZERO, Tie::Weld);
        weld.anchors[0].link = Some(0);
        weld.anchors[0].pose = Transform::IDENTITY;
        weld.anchors[1] = Anchor {
            link: Some(0),
            pose: Transform::new(Mat3::rotation_about(axis, angle.sin_cos()), Vec3::ZERO),
        };
        let found = closure_residual(&model, &[0.0], &[weld]).unwrap();
        let sign = (found[4] * axis.y).signum();
        let expected = (axis * (angle * sign)).to_array();
        for (found, expected) in found[3..].iter().zip(expected) {
            // 10 ε of the half turn: entries of the rotation, and the root of their sum
            assert!((found - expected).abs() < 10.0 * f64::EPSILON * PI, "{k}: {found} {expected}");
        }
        // At half a turn both ways round are the same.
        assert!(sign > 0.0 || k > 14, "{k}");
    }
}

#[test]
fn links_and_axes_of_loops_are_checked() {
    let (model, tip) = pinned(2, Vec3::X, Tie::Ball);
    let q = [0.1, 0.2];
    for k in 0..2 {
        let mut far = tip.clone();
        far.anchors[k].link = Some(3);
        let refused = InputError::NoSuch { what: "link", index: 3, count: 3 };
        assert_eq!(closure_residual(&model, &q, &[far.clone()]), Err(refused.clone()));
        assert_eq!(closure_jacobian(&model, &q, &[far]), Err(refused));
    }
    let long = Vec3::new(0.0, 0.0, 2.0);
    for (tie, length) in [
        (Tie::Hinge(Vec3::ZERO), 0.0),
        (Tie::Slide(long), 2.0),
        (Tie::Universal { first: long, second: Vec3::Z }, 2.0),
        (Tie::Universal { first: Vec3::Z, second: Vec3::ZERO }, 0.0),
    ] {
        let refused = InputError::NotAUnitVector { closure: "tip".into(), length };
        let closures = [Closure { tie, ..tip.clone() }];
        assert_eq!(closure_residual(&model, &q, &closures), Err(refused.clone()));
        assert_eq!(closure_jacobian(&model, &q, &closures), Err(refused));
    }
    let nan = Closure { tie: Tie::Hinge(Vec3::new(f64::NAN, 0.0, 0.0)), ..tip };
    let refused = closure_residual(&model, &q, &[nan]);
    assert!(matches!(refused, Err(InputError::NotAUnitVector { .. })), "{refused:?}");
}

/// A loop a thousand kilometres from the origin closes as far as numbers there go, in as few steps as elsewhere.
#[test]
fn far_loops_close() {
    use eigenbody::model::JointSpec;
    use eigenbody::spatial::{RigidInertia, Sym3};
    use eigenbody::{Joint, ModelBuilder};
    let solid = RigidInertia::from_com(1.0, Vec3::X, Sym3::diagonal(0.1, 0.1, 0.1));
    let mut robot = ModelBuilder::new("far");
    let mut last = robot.link("base", solid);
    for (name, at) in [("a", Vec3::ZERO), ("b", Vec3::X), ("c", Vec3::X)] {
        let link = robot.link(name, solid);
        robot.joint(JointSpec::new(name, Joint::Revolute, last, link).at(Transform::translation(at)));
        last = link;
    }
    let model = robot.build(Base::Floating).unwrap();
    let on = |link, x| Anchor { link: Some(link), pose: Transform::translation(Vec3::X * x) };
    let pin = [Closure { name: "pin".into(), tie: Tie::Ball, anchors: [on(0, 1.7), on(3, 1.0)] }];
    for seed in 0..10 {
        let q = [&[1e6, -3e5, 2e5], Random::new(seed).quaternion().as_slice(), &[1.2, -0.9, -1.0]].concat();
        let closed = close_loops(&model, &q, &pin, Reduction::default()).unwrap();
        // 1e-11 of the distance, 1.06e6 m
        assert!(closed.before > 0.1 && closed.after <= 1.1e-5 && closed.steps < 10, "{closed:?}");
    }
}

#[test]
fn null_spaces_of_no_numbers_and_of_large_ones() {
    for bad in [f64::NAN, f64::INFINITY] {
        let A = Matrix::from_fn(2, 3, |i, j| if (i, j) == (1, 0) { bad } else { 1.0 });
        assert_eq!(null_space(&A, 1e-12), Err(InputError::NotFinite { what: "A", index: 3 }));
    }
    let of = |unit: f64| null_space(&Matrix::from_fn(2, 3, |i, j| unit * f64::from((i + j) as u8)), 1e-12);
    for power in [-1060, -600, 600, 1020] {
        assert_eq!(of(f64::from(power).exp2()), of(1.0), "{power}");
    }
    assert_eq!(of(0.0).unwrap().rank, 0);
}

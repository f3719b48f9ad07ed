//! Both ends of the spectrum against references of 20 digits, and against their own error estimates.

use super::systems::{System, exact, metrics, systems};
use crate::reference::{Row, families, further, number, relative_error};
use eigenbody::error::InputError;
use eigenbody::model::JointSpec;
use eigenbody::scalar::{Dd, Real, Scalar};
use eigenbody::spatial::{RigidInertia, Sym3, Transform, Vec3};
use eigenbody::spectrum::sturm::Pencil;
use eigenbody::spectrum::{Extreme, Extremes, Precision, Unresolved, extremes};
use eigenbody::{Base, Family, Joint, Metric, Model, ModelBuilder};
use std::f64::consts::PI;

const PRECISIONS: [Precision; 3] = [Precision::F64, Precision::Auto, Precision::Dd];

/// What a value is good to whatever κ, where double-double may be used.
const GOOD: f64 = 2e-13;

/// Sweeps of eight counts that any row may take.
const PASSES: usize = 20;

/// Inverse iteration stops at a residual of 10⁻¹² λ.
const RESIDUAL: f64 = 1e-12;

fn ends(system: &System, metric: &Metric<f64>, precision: Precision) -> Extremes {
    extremes(&system.pencil_in(metric), precision).unwrap()
}

fn straight(family: &Family) -> System {
    let model: Model<f64> = family.model().unwrap();
    let q = model.neutral();
    System::new(family.name(), model, q, false)
}

impl Row {
    fn system(&self) -> System {
        let model: Model<f64> = self.family().model().unwrap();
        let q = self.posture().configuration(&model);
        System::new(self.family().name(), model, q, self.floating)
    }
}

/// λmax/λmin, and the estimate of its error.
fn kappa(ends: &Extremes) -> (f64, f64) {
    let min = ends.min.as_ref().unwrap();
    (ends.max.value / min.value, ends.max.error_estimate + min.error_estimate)
}

/// λmin, λmax, κ and κ′ of every row, in every precision, are as good as they say, and with double-double they are good.
#[test]
fn reference_rows() {
    let rows = [families(), further()].concat();
    assert!(rows.len() >= 143 + 28);
    let mut unresolved = 0;
    for row in &rows {
        let system = row.system();
        // Where links grow so that κ > 10²⁰, what the first feels of the last may hang on the last digits of lengths and angles.
        let good = if number(&row.kappa) < 1e20 { GOOD } else { f64::INFINITY };
        for precision in PRECISIONS {
            let assert_good = |what: &str, (value, estimate): (f64, f64), expected: &str| {
                let (error, limit) = (relative_error(value, expected), estimate.min(good));
                assert!(error <= limit, "{precision:?} {what} off by {error:e}, at most {limit:e}: {row:?}");
            };
            let [euclidean, own] =
                [Metric::Euclidean, Metric::UnitDiagonal].map(|metric| ends(&system, &metric, precision));
            let of = |end: &Extreme| (end.value, end.error_estimate);
            assert_good("λmin", of(euclidean.min.as_ref().unwrap()), &row.lambda_min);
            assert_good("λmax", of(&euclidean.max), &row.lambda_max);
            assert_good("κ", kappa(&euclidean), &row.kappa);
            match (&row.kappa_weighted, &own.min) {
                (Some(expected), Ok(_)) => assert_good("κ′", kappa(&own), expected),
                (Some(expected), Err(Unresolved { below })) => {
                    // All that is known is a bound, and it is a true one.
                    assert!(own.max.value / below < number(expected), "{row:?}");
                    unresolved += 1;
                }
                (None, own) => assert!(own.is_ok(), "{row:?}"),
            }
            assert!(euclidean.passes <= PASSES || number(&row.kappa) > 1e20, "{} {row:?}", euclidean.passes);
            // κ′ of a free chain takes longer, its stiffest modes lie close together; and what rounding nearly hides.
            assert!(euclidean.passes.max(own.passes) <= PASSES + 4, "{} {row:?}", own.passes);
        }
    }
    // Two branched robots with κ′ > 10¹⁸, in three precisions.
    assert!(unresolved <= 6, "{unresolved}");
}

/// Every joint kind, fixed, floating and free, in every metric: against the dense path in double-double of the same numbers.
#[test]
fn estimates_cover_what_rounding_does() {
    for system in systems(45) {
        let H = system.matrix();
        for metric in metrics(system.model.nv()) {
            let values = exact(&H, &system.pencil_in(&metric));
            for precision in PRECISIONS {
                let Extremes { min, max, .. } = ends(&system, &metric, precision);
                for (end, exact) in [(min.unwrap(), values[0]), (max, values[values.len() - 1])] {
                    let error = ((Dd::from_f64(end.value) - exact) / exact).abs().hi();
                    let estimate = end.error_estimate;
                    let what = format!("{}: {metric}, {precision:?}", system.name);
                    assert!(error <= estimate, "{what}: off by {error:e}, {estimate:e} estimated");
                    assert!(estimate <= end.counted_error, "{what}");
                    // Double-double leaves what the robot's own numbers leave open.
                    assert!(precision == Precision::F64 || estimate <= GOOD, "{what}: {estimate:e}");
                }
            }
        }
    }
}

/// H x = λ B x, xᵀBx = 1, and a removed base moves so that momentum stays zero.
#[test]
fn modes_solve_the_problem() {
    for system in systems(30) {
        let H = system.full_matrix();
        for metric in metrics(system.model.nv()) {
            let pencil = system.pencil_in(&metric);
            let (B, Extremes { min, max, .. }) = (pencil.metric(), ends(&system, &metric, Precision::Auto));
            let (n, largest) = (B.len() as f64, max.value);
            for Extreme { value, vector, .. } in [min.unwrap(), max] {
                let x: Vec<Dd> = vector.iter().copied().map(Dd::from_f64).collect();
                let (mut norm, mut residual) = (0.0, 0.0);
                for (d, &Hx) in H.times(&x).iter().enumerate() {
                    let rest = (Hx - Dd::from_product(value, B[d]) * x[d]).hi();
                    if B[d] > 0.0 {
                        norm += B[d] * vector[d] * vector[d];
                        residual += rest * rest / B[d];
                    } else {
                        // Of √(H_dd λ), the momentum of a mode of energy λ
                        let allowed = (RESIDUAL + 4.0 * n * f64::EPSILON) * (H[(d, d)].hi() * value).sqrt();
                        assert!(
                            rest.abs() <= allowed,
                            "{}: {metric}: momentum {rest:e}, {allowed:e}",
                            system.name
                        );
                    }
                }
                // n ε: a sum of squares
                assert!(
                    (norm - 1.0f64).abs() <= n * f64::EPSILON,
                    "{}: {metric}: |x|² = {norm}",
                    system.name
                );
                // 16 n ε √(λ λmax) besides: every x_d is rounded, and H maps that to √λmax times the root of its energy
                let allowed = RESIDUAL * value + 16.0 * n * f64::EPSILON * (value * largest).sqrt();
                let residual = f64::sqrt(residual);
                assert!(residual <= allowed, "{}: {metric}: residual {residual:e}, {allowed:e}", system.name);
            }
        }
    }
}

/// A chain of a thousand links, to the last digits.
#[test]
fn thousand_links() {
    let system = straight(&Family::hydra(1000, 1.0, 0.0, 1.0).unwrap());
    for precision in [Precision::Auto, Precision::Dd] {
        let ends = ends(&system, &Metric::Euclidean, precision);
        let errors = [
            relative_error(ends.min.as_ref().unwrap().value, "0.021146039167710279588"),
            relative_error(ends.max.value, "81052547734.423965589"),
            relative_error(kappa(&ends).0, "3832989577461.3965242"),
        ];
        assert!(errors.iter().all(|&error| error <= 5e-15), "{precision:?}: {errors:?}");
        assert!(ends.passes <= PASSES, "{}", ends.passes);
    }
}

/// Closed form of the circular onion, λ_k = 1/(4 sin²((2k−1)π/(4N+2))), at 100,000 links.
#[test]
fn hundred_thousand_links() {
    let n = 100_000;
    let ends =
        ends(&straight(&Family::onion(n, 1.0, 0.0, 1.0).unwrap()), &Metric::Euclidean, Precision::Auto);
    let exact = |k: usize| 0.25 / ((2 * k - 1) as f64 * PI / (4 * n + 2) as f64).sin().powi(2);
    for (end, exact) in [(ends.min.as_ref().unwrap(), exact(n)), (&ends.max, exact(1))] {
        let error = (end.value / exact - 1.0).abs();
        // 4 ε: the closed form in f64
        assert!(
            error <= end.error_estimate + 4.0 * f64::EPSILON,
            "{error:e}, {:e} estimated",
            end.error_estimate
        );
        assert!(error <= 1e-12, "{error:e}");
    }
    assert!(ends.passes <= PASSES, "{}", ends.passes);
}

/// A DoF without weight takes no part; a pencil of none has no ends.
#[test]
fn weights_choose_what_takes_part() {
    let system = straight(&Family::hydra(3, 1.0, 0.0, 1.0).unwrap());
    let pencil = |B: &[f64]| Pencil::new(&system.model, &system.q, B.to_vec()).unwrap();
    let none = extremes(&pencil(&[0.0; 3]), Precision::Auto);
    assert_eq!(none, Err(InputError::NotPositive { what: "B", index: 0, value: 0.0 }));
    // One DoF left: λ = 1/(H⁻¹)_dd, the inertia that it feels with the others free
    let one = extremes(&pencil(&[0.0, 1.0, 0.0]), Precision::Auto).unwrap();
    let tau = eigenbody::forward_dynamics(&system.model, &system.q, &[0.0; 3], &[0.0, 1.0, 0.0]).unwrap();
    let rest = eigenbody::forward_dynamics(&system.model, &system.q, &[0.0; 3], &[0.0; 3]).unwrap();
    let felt = 1.0 / (tau[1] - rest[1]);
    for end in [one.min.unwrap(), one.max] {
        // 100 ε: gravity's part cancels
        assert!((end.value / felt - 1.0).abs() <= 100.0 * f64::EPSILON, "{} {felt}", end.value);
    }
}

/// Where there is no inertia at all, both ends are zero.
#[test]
fn nothing_to_move() {
    let mut robot = ModelBuilder::new("nothing");
    let [base, link] = ["base", "link"].map(|name| robot.link(name, RigidInertia::ZERO));
    robot.joint(JointSpec::new("hinge", Joint::Revolute, base, link).about(Vec3::Z));
    let model: Model<f64> = robot.build(Base::Fixed).unwrap();
    let Extremes { min, max, .. } =
        extremes(&Pencil::euclidean(&model, &[0.3], false).unwrap(), Precision::Auto).unwrap();
    assert_eq!((min, max.value, max.error_estimate), (Err(Unresolved { below: 0.0 }), 0.0, 0.0));
}

/// A ball, a light body, a universal joint at which its axes are no unit vectors of one frame, a heavy body: what the light one feels is
/// left of what cancels, and the estimate knows it.
#[test]
fn behind_a_universal_joint() {
    for light in [1e-3, 1e-5, 1e-7] {
        let mut robot = ModelBuilder::new("universal");
        let body = |m: f64, com: Vec3<f64>, [x, y, z]: [f64; 3]| {
            RigidInertia::from_com(m, com, Sym3::diagonal(m * x, m * y, m * z))
        };
        let base = robot.link("base", RigidInertia::ZERO);
        let ball = robot.link("light", body(light, Vec3::ZERO, [1.0, 1.1, 1.2]));
        let tip = robot.link("heavy", body(1.0, Vec3::new(0.2, 0.1, 0.3), [0.4, 0.5, 0.6]));
        robot.joint(JointSpec::new("ball", Joint::Spherical, base, ball));
        let universal = JointSpec::new("universal", Joint::Universal { first: Vec3::X }, ball, tip);
        robot.joint(universal.at(Transform::translation(Vec3::new(0.1, 0.2, 0.3))));
        let model: Model<f64> = robot.build(Base::Fixed).unwrap();
        let q = vec![1.0, 0.0, 0.0, 0.0, 0.0, 0.0];
        let system = System::new("universal", model, q, false);
        for precision in PRECISIONS {
            let pencil = system.pencil();
            let min = extremes(&pencil, precision).unwrap().min.unwrap();
            let expected = exact(&system.matrix(), &pencil)[0].to_f64();
            let error = (min.value / expected - 1.0).abs();
            let at = format!("{light:e} {precision:?}: {error:e} of {:e}", min.error_estimate);
            assert!(error <= min.error_estimate, "{at}");
            assert!(min.error_estimate <= if precision == Precision::F64 { 1e-7 } else { 1e-12 }, "{at}");
        }
    }
}

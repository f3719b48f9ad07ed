//! Batches against one configuration at a time.

mod ends;

use crate::robots::{Case, cases, configuration, numbers, tree};
use eigenbody::batch::{Batch, BatchError, Lanes};
use eigenbody::conditioning::Values;
use eigenbody::dynamics::plain;
use eigenbody::scalar::{Real, Unit};
use eigenbody::spectrum::{eigenvalues, extreme_eigenvalues};
use eigenbody::{Base, Error, Family, InputError, Metric, Model, mass_matrix};

const UNITS: [Unit; 3] = [Unit::Plain, Unit::Avx2, Unit::Avx512];
/// No multiple of any number of lanes, and more than a chunk.
const COUNT: usize = 77;

struct States<T> {
    q: Vec<T>,
    v: Vec<T>,
    x: Vec<T>,
}

fn states<T: Real>(model: &Model<T>) -> States<T> {
    let q = (0..COUNT as u64).flat_map(|seed| configuration(model, seed)).collect();
    States { q, v: numbers(COUNT * model.nv(), 1), x: numbers(COUNT * model.nv(), 2) }
}

/// Largest difference, against the largest of `exact`.
#[track_caller]
fn assert_close<T: Real>(what: &str, found: &[T], exact: &[T], bound: f64) {
    let size = exact.iter().fold(0.0, |m: f64, x| m.max(x.to_f64().abs()));
    for (x, y) in found.iter().zip(exact) {
        let apart = (*x - *y).to_f64().abs();
        assert!(apart <= bound * size, "{what}: {x:?} and {y:?}, of {size:e}");
    }
}

/// Every lane holds its own configuration; roundings for every body on the way.
fn lanes_are_configurations<T: Lanes>() {
    for case in cases::<T>(14) {
        let (model, name) = (case.model, case.name);
        let States { q, v, x } = states(&model);
        let (nq, nv) = (model.nq(), model.nv());
        let bound = 20.0 * (4 + nv) as f64 * T::EPSILON;
        for unit in UNITS {
            let batch = Batch::new(&model).on(unit);
            let (mut H, mut tau) = (vec![T::ONE; COUNT * nv * nv], vec![T::ONE; COUNT * nv]);
            batch.mass_matrices(&q, &mut H).unwrap();
            batch.inverse_dynamics(&q, &v, &x, &mut tau).unwrap();
            let mut vdot = vec![T::ONE; COUNT * nv];
            batch.forward_dynamics(&q, &v, &tau, &mut vdot).unwrap();
            for k in 0..COUNT {
                let (q, of) = (&q[k * nq..][..nq], |a: &[T]| a[k * nv..][..nv].to_vec());
                let exact = plain::mass_matrix(&model, q).unwrap();
                let what = |which: &str| format!("{which} of {k}, {unit:?}, {name}");
                assert_close(&what("H"), &H[k * nv * nv..][..nv * nv], exact.as_slice(), bound);
                let exact = plain::inverse_dynamics(&model, q, &of(&v), &of(&x)).unwrap();
                assert_close(&what("τ"), &of(&tau), &exact, bound);
                // v̇ is as good as the forces that it gives.
                let back = plain::inverse_dynamics(&model, q, &of(&v), &of(&vdot)).unwrap();
                let size = plain::mass_matrix(&model, q).unwrap().max_abs();
                let largest = of(&vdot).iter().fold(1.0, |m: f64, x| m.max(x.to_f64().abs()));
                for (x, y) in back.iter().zip(&of(&tau)) {
                    let scale = y
                        .to_f64()
                        .abs()
                        .max(size * largest)
                        .max(exact.iter().fold(0.0, |m, x| x.to_f64().abs().max(m)));
                    assert!((*x - *y).to_f64().abs() <= 10.0 * bound * scale, "{}: {x:?} {y:?}", what("v̇"));
                }
            }
        }
    }
}

#[test]
fn single() {
    lanes_are_configurations::<f32>();
}

#[test]
fn double() {
    lanes_are_configurations::<f64>();
}

/// Trees of large and small limbs, whose entries are done one limb after the other.
fn limbs<T: Real>() -> Vec<Case<T>> {
    let chain = |on: usize, from: usize, n: usize| {
        let mut chain: Vec<usize> = (from..from + n).collect();
        chain[0] = on;
        chain
    };
    // Two legs of six, three joints of a waist, on it two arms of seven and a neck of two.
    let humanoid = [(0, 0, 6), (0, 6, 6), (0, 12, 3), (15, 15, 7), (15, 22, 7), (15, 29, 2)];
    let humanoid = humanoid.map(|(on, from, n)| chain(on, from, n)).concat();
    let hand: Vec<usize> = [vec![0, 1, 2], [0; 5].map(|_| 3).to_vec(), (4..=18).collect()].concat();
    let wheels = vec![0; 40];
    let beside = [chain(0, 0, 20), vec![0], chain(0, 21, 9), vec![0; 3]].concat();
    let trees = [("humanoid", humanoid), ("hand", hand), ("wheels", wheels), ("beside", beside)];
    let mut cases = Vec::new();
    for (name, parents) in &trees {
        for (seed, base) in [(1, Base::Fixed), (2, Base::Floating), (3, Base::Floating)] {
            cases.push(Case::new(format!("{name} {seed}"), tree(seed, parents).build(base), seed));
        }
    }
    cases
}

/// The entries and their mirror images make up H, and nothing else in it differs from zero.
fn entries_make_up_the_matrix<T: Lanes>() {
    for Case { model, name, .. } in cases::<T>(14).into_iter().chain(limbs()) {
        let States { q, .. } = states(&model);
        let nv = model.nv();
        let order: Vec<usize> = model.dofs().order().collect();
        let place = |d: usize| order.iter().position(|&other| other == d);
        for unit in UNITS {
            let batch = Batch::new(&model).on(unit);
            let pairs = batch.entries();
            let mut once = std::collections::BTreeSet::new();
            for &(d, e) in &pairs {
                assert!(place(e) <= place(d), "{name}: the one further in comes last");
                assert!(once.insert((d, e)), "{name}: ({d}, {e}) stands twice");
            }
            let (mut H, mut entries) = (vec![T::ONE; COUNT * nv * nv], vec![T::ONE; COUNT * pairs.len()]);
            batch.mass_matrices(&q, &mut H).unwrap();
            batch.mass_matrix_entries(&q, &mut entries).unwrap();
            for (k, H) in H.chunks_exact(nv * nv).enumerate() {
                let mut made = vec![T::ZERO; nv * nv];
                for (&(d, e), &H_de) in pairs.iter().zip(&entries[k * pairs.len()..]) {
                    (made[d * nv + e], made[e * nv + d]) = (H_de, H_de);
                }
                assert_eq!(H, made, "{k}, {unit:?}, {name}");
            }
        }
    }
}

#[test]
fn single_entries() {
    entries_make_up_the_matrix::<f32>();
}

#[test]
fn double_entries() {
    entries_make_up_the_matrix::<f64>();
}

/// A number that is not finite is found wherever it stands, whatever unit looks for it.
#[test]
fn what_is_not_finite_is_found_everywhere() {
    let model: Model<f64> = Family::hydra(3, 1.0, 0.3, 1.0).unwrap().model().unwrap();
    let (good, mut tau) = (vec![0.25; 3 * COUNT], vec![0.0; 3 * COUNT]);
    for unit in UNITS {
        let batch = Batch::new(&model).on(unit);
        assert_eq!(batch.inverse_dynamics(&good, &good, &good, &mut tau), Ok(()));
        for at in 0..good.len() {
            for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
                let mut v = good.clone();
                v[at] = bad;
                let error = batch.inverse_dynamics(&good, &v, &good, &mut tau).unwrap_err();
                let expected = format!("configuration {}: v[{}] is not a finite number", at / 3, at % 3);
                assert_eq!(error.to_string(), expected, "{unit:?}");
            }
        }
    }
}

/// A quaternion that is no unit one is found wherever it stands; one that is near enough is not taken for one.
#[test]
fn quaternions_are_looked_at_everywhere() {
    let model: Model<f64> = Family::hydra(3, 1.0, 0.3, 1.0).unwrap().floating().model().unwrap();
    let (nq, nv) = (model.nq(), model.nv());
    let good: Vec<f64> = (0..COUNT as u64).flat_map(|seed| configuration(&model, seed)).collect();
    let mut H = vec![0.0; COUNT * nv * nv];
    let mut values = vec![Values { lambda_min: 0.0, lambda_max: 0.0, kappa_weighted: 0.0 }; COUNT];
    for unit in UNITS {
        let batch = Batch::new(&model).on(unit);
        for k in [0, 3, 8, 63, COUNT - 1] {
            for (scale, is_unit) in
                [(1.0 + 9e-7, true), (1.0 - 9e-7, true), (1.0 + 2e-6, false), (0.0, false)]
            {
                let mut q = good.clone();
                q[k * nq + 3..k * nq + 7].iter_mut().for_each(|x| *x *= scale);
                let found = [
                    batch.mass_matrices(&q, &mut H),
                    batch.conditioning(&q, &Metric::Euclidean, 1e-8, &mut values),
                ];
                for found in found {
                    match found {
                        Ok(()) => assert!(is_unit, "{k}, {scale}, {unit:?}"),
                        Err(BatchError::Configuration { index, error: Error::Input(error) }) => {
                            assert!(matches!(error, InputError::NotUnitQuaternion { .. }), "{error}");
                            assert!(!is_unit && index == k, "{k}, {scale}, {unit:?}: {index}");
                        }
                        Err(error) => panic!("{error}"),
                    }
                }
            }
        }
    }
}

/// Both ends of every kind of matrix to a few n·ε·λmax.
#[test]
fn ends_are_those_of_the_spectrum() {
    for case in cases::<f64>(45) {
        let H = mass_matrix(&case.model, &case.q).unwrap();
        let diagonal: Vec<f64> = (0..H.rows()).map(|d| H[(d, d)]).collect();
        for weights in [vec![1.0; H.rows()], diagonal] {
            let all = eigenvalues(&H, &weights).unwrap();
            let (Some(&least), Some(&largest)) = (all.first(), all.last()) else { continue };
            let [min, max] = extreme_eigenvalues(&H, &weights).unwrap();
            let bound = 8.0 * H.rows() as f64 * f64::EPSILON * largest;
            assert!((min - least).abs() <= bound, "{}: {min:e} {least:e}, of {largest:e}", case.name);
            assert!((max - largest).abs() <= bound, "{}: {max:e} {largest:e}", case.name);
        }
    }
}

/// The matrix where it is good enough, the tree where it is not: both within the accuracy asked for.
#[test]
fn conditioning_is_as_accurate_as_asked() {
    for (family, accuracy) in [
        (Family::hydra(6, 1.0, 0.3, 1.0).unwrap(), 1e-8),
        (Family::auto_tree(9, 1.5, 0.3, 0.9).unwrap(), 1e-6),
        (Family::hydra(30, 1.0, 0.0, 1.0).unwrap(), 1e-13),
    ] {
        let model: Model<f64> = family.model().unwrap();
        let States { q, .. } = states(&model);
        let mut values = vec![Values { lambda_min: 0.0, lambda_max: 0.0, kappa_weighted: 0.0 }; COUNT];
        let mut ends = vec![0.0; 2 * COUNT];
        let batch = Batch::new(&model);
        batch.conditioning(&q, &Metric::Euclidean, accuracy, &mut values).unwrap();
        batch.extremes(&q, &Metric::Euclidean, accuracy, &mut ends).unwrap();
        let mut own = vec![0.0; 2 * COUNT];
        batch.extremes(&q, &Metric::UnitDiagonal, accuracy, &mut own).unwrap();
        for (k, values) in values.iter().enumerate() {
            let q = &q[k * model.nq()..][..model.nq()];
            let exact = eigenbody::conditioning_at(&model, q, &eigenbody::Question::default()).unwrap();
            let known = [
                (values.lambda_min, exact.lambda_min),
                (values.lambda_max, exact.lambda_max),
                (values.kappa(), exact.kappa),
                (values.kappa_weighted, exact.kappa_weighted),
                (ends[2 * k], exact.lambda_min),
                (ends[2 * k + 1], exact.lambda_max),
                (own[2 * k + 1] / own[2 * k], exact.kappa_weighted),
            ];
            for (found, exact) in known {
                let exact = exact.unwrap();
                // Both λ of κ may be off.
                assert!((found / exact - 1.0).abs() <= 2.0 * accuracy + 1e-12, "{k}: {found:e} {exact:e}");
            }
        }
    }
}

#[test]
fn numbers_do_not_depend_on_threads() {
    let model: Model<f64> = Family::auto_tree(12, 1.5, 0.3, 0.9).unwrap().model().unwrap();
    let count = 1000;
    let q: Vec<f64> = (0..count).flat_map(|seed| model.random(seed)).collect();
    let (v, x) = (numbers(1000 * model.nv(), 3), numbers(1000 * model.nv(), 4));
    let of = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let mut vdot = vec![0.0; v.len()];
            let mut values = vec![Values { lambda_min: 0.0, lambda_max: 0.0, kappa_weighted: 0.0 }; 1000];
            Batch::new(&model).forward_dynamics(&q, &v, &x, &mut vdot).unwrap();
            Batch::new(&model).conditioning(&q, &Metric::Euclidean, 1e-6, &mut values).unwrap();
            (vdot, values)
        })
    };
    assert_eq!(of(1), of(3));
}

/// What a call has left in a batch is nothing to the next one, whatever that asks, and of however many.
#[test]
fn numbers_do_not_depend_on_calls_before() {
    let model: Model<f64> = Family::auto_tree(12, 1.5, 0.3, 0.9).unwrap().floating().model().unwrap();
    let nv = model.nv();
    let weights = Metric::Diagonal((1..=nv).map(|d| d as f64).collect());
    type Call<'a> = &'a dyn Fn(&Batch<'_, f64>, &[f64], &[f64], &mut [f64]) -> Result<(), BatchError>;
    let entries = Batch::new(&model).entries().len();
    let calls: [(&str, usize, Call<'_>); 7] = [
        ("entries", entries, &|batch, q, _, out| batch.mass_matrix_entries(q, out)),
        ("H", nv * nv, &|batch, q, _, out| batch.mass_matrices(q, out)),
        ("τ", nv, &|batch, q, x, out| batch.inverse_dynamics(q, x, x, out)),
        ("v̇", nv, &|batch, q, x, out| batch.forward_dynamics(q, x, x, out)),
        ("ends", 2, &|batch, q, _, out| batch.extremes(q, &Metric::Euclidean, 1e-6, out)),
        ("weighted", 2, &|batch, q, _, out| batch.extremes(q, &weights, 1e-6, out)),
        ("own units", 2, &|batch, q, _, out| batch.extremes(q, &Metric::UnitDiagonal, 1e-6, out)),
    ];
    for unit in UNITS {
        let kept = Batch::new(&model).on(unit);
        for count in [30, 7, 30, 16] {
            let q: Vec<f64> = (0..count as u64).flat_map(|seed| model.random(seed)).collect();
            let x = numbers(count * nv, 5);
            for (what, size, call) in calls {
                let of = |batch: &Batch<'_, f64>| {
                    let mut out = vec![0.0; count * size];
                    call(batch, &q, &x, &mut out).map(|()| out)
                };
                assert_eq!(of(&kept), of(&Batch::new(&model).on(unit)), "{what}, {count}, {unit:?}");
            }
        }
    }
}

#[test]
fn what_does_not_fit_is_refused() {
    let model: Model<f64> = Family::auto_tree(8, 1.0, 0.3, 1.0).unwrap().model().unwrap();
    let (nq, nv) = (model.nq(), model.nv());
    let q: Vec<f64> = (0..20).flat_map(|seed| model.random(seed)).collect();
    let batch = Batch::new(&model);
    let length = |what, expected, found| BatchError::Shape(InputError::Length { what, expected, found });
    let mut H = vec![0.0; 20 * nv * nv];
    assert_eq!(batch.mass_matrices(&q[1..], &mut H), Err(length("q", 20 * nq, 20 * nq - 1)));
    assert_eq!(batch.mass_matrices(&q, &mut H[1..]), Err(length("H", 20 * nv * nv, 20 * nv * nv - 1)));
    let (v, mut out) = (vec![0.0; 20 * nv], vec![0.0; 20 * nv]);
    assert_eq!(batch.inverse_dynamics(&q, &v[1..], &v, &mut out), Err(length("v", 20 * nv, 20 * nv - 1)));
    let mut bad = q.clone();
    bad[13 * nq + 2] = f64::NAN;
    let error = batch.mass_matrices(&bad, &mut H).unwrap_err();
    assert_eq!(error.to_string(), "configuration 13: q[2] is not a finite number");
    let mut bad = v.clone();
    bad[7 * nv + 1] = f64::INFINITY;
    let error = batch.inverse_dynamics(&q, &v, &bad, &mut out).unwrap_err();
    assert_eq!(error.to_string(), "configuration 7: vdot[1] is not a finite number");
    assert_eq!(batch.mass_matrices(&[], &mut []), Ok(()));
}

/// A body without mass on a hinge has no pivot: the first configuration is named, whichever lane and thread finds it.
#[test]
fn a_pivot_of_zero_is_refused() {
    use eigenbody::model::{JointSpec, ModelBuilder};
    use eigenbody::spatial::{RigidInertia, Vec3};
    use eigenbody::{Base, Joint};
    let mut robot = ModelBuilder::new("massless");
    let links = [robot.link("base", RigidInertia::ZERO), robot.link("tip", RigidInertia::<f64>::ZERO)];
    robot.joint(JointSpec::new("hinge", Joint::Revolute, links[0], links[1]).about(Vec3::Z));
    let model = robot.build(Base::Fixed).unwrap();
    let (q, mut vdot) = (vec![0.5; 40], vec![0.0; 40]);
    match Batch::new(&model).forward_dynamics(&q, &q, &q, &mut vdot) {
        Err(BatchError::Configuration { index: 0, error: Error::NotPositiveDefinite(error) }) => {
            assert_eq!((error.dof, error.pivot), (0, 0.0));
        }
        other => panic!("{other:?}"),
    }
}

/// A mass on a slide across a hinge: the hinge has no pivot where it comes to stand on the axis. Of all such configurations the first is
/// named, however many threads share them.
#[test]
fn the_first_pivot_of_zero_is_named() {
    use eigenbody::model::{JointSpec, ModelBuilder};
    use eigenbody::spatial::{RigidInertia, Sym3, Vec3};
    use eigenbody::{Base, Joint};
    let mut robot = ModelBuilder::new("sling");
    let mass = RigidInertia::from_com(2.0, Vec3::ZERO, Sym3::ZERO);
    let [base, arm, tip] = [("base", RigidInertia::ZERO), ("arm", RigidInertia::ZERO), ("tip", mass)]
        .map(|(name, I)| robot.link(name, I));
    robot.joint(JointSpec::new("turn", Joint::Revolute, base, arm).about(Vec3::Z));
    robot.joint(JointSpec::new("slide", Joint::Prismatic, arm, tip).about(Vec3::X));
    let model: Model<f64> = robot.build(Base::Fixed).unwrap();
    let count = 5000;
    let mut q = [0.3, 0.5].repeat(count);
    for k in [4170, 1233, 4999] {
        q[2 * k + 1] = 0.0;
    }
    let (zero, mut vdot) = (vec![0.0; 2 * count], vec![0.0; 2 * count]);
    for threads in [1, 2, 3, 8] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let found = pool.install(|| Batch::new(&model).forward_dynamics(&q, &zero, &zero, &mut vdot));
        match found {
            Err(BatchError::Configuration { index: 1233, error: Error::NotPositiveDefinite(error) }) => {
                assert_eq!(error.dof, 0);
            }
            other => panic!("{threads} threads: {other:?}"),
        }
    }
}

//! Both ends of dense spectra against the whole of them.

use crate::robots::cases;
use eigenbody::model::{JointSpec, Random};
use eigenbody::scalar::Real;
use eigenbody::spatial::{RigidInertia, Sym3, Vec3};
use eigenbody::spectrum::{
    EndsAtWorkspace, EndsWorkspace, Metric, eigenvalues, extreme_eigenvalues, extreme_eigenvalues_at,
    extreme_eigenvalues_into,
};
use eigenbody::{Base, Family, InputError, Joint, Matrix, Model, ModelBuilder, mass_matrix};

/// Qᵀ diag(λ) Q, Q a product of reflections.
fn with_spectrum(values: &[f64], seed: u64) -> Vec<Vec<f64>> {
    let (n, mut random) = (values.len(), Random::new(seed));
    let mut A: Vec<Vec<f64>> =
        (0..n).map(|i| (0..n).map(|j| if i == j { values[i] } else { 0.0 }).collect()).collect();
    for _ in 0..3 {
        let v: Vec<f64> = (0..n).map(|_| random.between(-1.0, 1.0)).collect();
        let scale = 2.0 / v.iter().map(|x| x * x).sum::<f64>();
        let Av: Vec<f64> = A.iter().map(|row| row.iter().zip(&v).map(|(a, v)| a * v).sum()).collect();
        let K = scale * Av.iter().zip(&v).map(|(a, v)| a * v).sum::<f64>();
        for i in 0..n {
            for j in 0..n {
                A[i][j] -= scale * (Av[i] * v[j] + v[i] * Av[j]) - scale * K * v[i] * v[j];
            }
        }
    }
    (0..n).map(|i| (0..n).map(|j| 0.5 * (A[i][j] + A[j][i])).collect()).collect()
}

/// Spread over many decades, equal, in clusters, with zeros, and of every size about those of whole registers.
fn spectra() -> Vec<Vec<f64>> {
    let mut spectra = Vec::new();
    for n in (1..=13).chain([31, 32, 33, 64, 65]) {
        let graded = |decades: f64| (0..n).map(|k| 10f64.powf(-decades * k as f64 / n as f64)).collect();
        spectra.extend([graded(0.0), graded(1.0), graded(5.0), graded(12.0)]);
        spectra.push((0..n).map(|k| if k % 2 == 0 { 1.0 } else { 1e-4 }).collect());
        spectra.push((0..n).map(|k| if k == 0 { 1e6 } else { 1.0 + 1e-9 * k as f64 }).collect());
        spectra.push((0..n).map(|k| (k / 2) as f64).collect());
    }
    spectra
}

fn ends_of_known_spectra<T: Real>() {
    for (seed, values) in spectra().into_iter().enumerate() {
        let (n, A) = (values.len(), with_spectrum(&values, seed as u64));
        let H = Matrix::from_fn(n, n, |i, j| T::from_f64(A[i][j]));
        let B: Vec<T> = (0..n).map(|d| T::from_f64(1.0 + (seed % 2 * d) as f64)).collect();
        let scaled = Matrix::from_fn(n, n, |i, j| H[(i, j)] / (B[i] * B[j]).sqrt());
        let all = eigenvalues(&scaled, &vec![T::ONE; n]).unwrap();
        let mut room = EndsWorkspace::new(n);
        // Nothing of another matrix is left in the workspace.
        extreme_eigenvalues_into(&Matrix::from_fn(n, n, |_, _| T::ONE), &B, &mut room).unwrap();
        let [min, max] = extreme_eigenvalues_into(&H, &B, &mut room).unwrap();
        assert_eq!([min, max], extreme_eigenvalues(&H, &B).unwrap());
        let size = all[n - 1].to_f64();
        let bound = 20.0 * n as f64 * T::EPSILON * size;
        let apart = [(min - all[0]).to_f64().abs(), (max - all[n - 1]).to_f64().abs()];
        // Where rounding has made λmin negative, it is found as zero.
        let below = all[0].to_f64().min(0.0).abs();
        assert!(apart[0] <= bound + below, "λmin, n = {n}, {seed}: {:e} of {bound:e}", apart[0]);
        assert!(apart[1] <= bound, "λmax, n = {n}, {seed}: {:e} of {bound:e}", apart[1]);
    }
}

/// Whatever the unit: squares of its entries may lie beyond the range of numbers.
#[test]
fn ends_of_any_size() {
    for size in [1e-300, 1e-200, 1e-40, 1e40, 1e200, 1e300] {
        for n in [1, 2, 5, 9] {
            let H = Matrix::from_fn(n, n, |i, j| size * if i == j { 2.0 } else { 1.0 });
            let [min, max] = extreme_eigenvalues(&H, &vec![1.0; n]).unwrap();
            let expected = [if n == 1 { 2.0 } else { 1.0 }, (n + 1) as f64];
            let bound = 4.0 * n as f64 * f64::EPSILON * expected[1];
            let apart = [min / size - expected[0], max / size - expected[1]];
            assert!(apart.iter().all(|x| x.abs() <= bound), "{n}, {size:e}: {apart:?}");
        }
    }
}

#[test]
fn a_matrix_of_zeros_has_none_but_zeros() {
    for n in [0, 1, 3, 4, 9] {
        let zeros: Matrix<f64> = Matrix::zeros(n, n);
        assert_eq!(extreme_eigenvalues(&zeros, &vec![1.0; n]).unwrap(), [0.0, 0.0], "{n}");
    }
}

#[test]
fn ends_of_known_spectra_in_single_precision() {
    ends_of_known_spectra::<f32>();
}

#[test]
fn ends_of_known_spectra_in_double_precision() {
    ends_of_known_spectra::<f64>();
}

/// Of robots of every shape, in every metric: the ends of H as a matrix.
fn ends_at_a_configuration<T: Real>() {
    for case in cases::<T>(60).into_iter().filter(|case| case.nv() > 0) {
        let (n, model) = (case.nv(), &case.model);
        let given = (0..n).map(|d| T::from_f64(1.0 + d as f64)).collect();
        let metrics = [
            Metric::Euclidean,
            Metric::UnitDiagonal,
            Metric::Length(T::from_f64(0.5)),
            Metric::Diagonal(given),
        ];
        for metric in metrics {
            let mut room = EndsAtWorkspace::new(model, &metric).unwrap();
            for q in [model.neutral(), case.q.clone()] {
                let H = mass_matrix(model, &q).unwrap();
                let expected = extreme_eigenvalues(&H, &metric.weights(model, &H).unwrap()).unwrap();
                let found = extreme_eigenvalues_at(model, &q, &mut room).unwrap();
                // 4 n ε λmax: the same steps, but for how W H W is rounded
                let tolerance = 4.0 * n as f64 * T::EPSILON * expected[1].to_f64();
                for (found, expected) in found.into_iter().zip(expected) {
                    let error = (found - expected).abs().to_f64();
                    assert!(error <= tolerance, "{}, {metric}: {error:e}, {tolerance:e}", case.name);
                }
            }
        }
    }
}

#[test]
fn ends_at_a_configuration_in_single_precision() {
    ends_at_a_configuration::<f32>();
}

#[test]
fn ends_at_a_configuration_in_double_precision() {
    ends_at_a_configuration::<f64>();
}

/// A hinge that carries a slide: far out, its inertia is beyond single precision.
fn polar() -> Model<f32> {
    let mut robot = ModelBuilder::new("polar");
    let rod = RigidInertia::from_com(1.0, Vec3::new(0.1, 0.0, 0.0), Sym3::diagonal(0.01, 0.02, 0.02));
    let [base, arm, hand] = ["base", "arm", "hand"].map(|name| robot.link(name, rod));
    robot.joint(JointSpec::new("turn", Joint::Revolute, base, arm).about(Vec3::Z));
    robot.joint(JointSpec::new("reach", Joint::Prismatic, arm, hand).about(Vec3::X));
    robot.build(Base::Fixed).unwrap()
}

/// One configuration whose H overflows leaves nothing behind for the next.
#[test]
fn ends_after_an_overflow() {
    let model = polar();
    let mut room = EndsAtWorkspace::new(&model, &Metric::Euclidean).unwrap();
    let before = extreme_eigenvalues_at(&model, &[0.0, 0.5], &mut room).unwrap();
    let refused = extreme_eigenvalues_at(&model, &[0.0, 1e30], &mut room);
    assert!(matches!(refused, Err(InputError::NotFinite { what: "H", .. })), "{refused:?}");
    assert_eq!(extreme_eigenvalues_at(&model, &[0.0, 0.5], &mut room).unwrap(), before);
}

#[test]
fn workspaces_for_something_else_are_refused() {
    let [small, large]: [Model<f32>; 2] =
        [4, 5].map(|n| Family::hydra(n, 1.0, 0.4, 1.0).unwrap().model().unwrap());
    let mut room = EndsAtWorkspace::new(&large, &Metric::Euclidean).unwrap();
    let wrong = extreme_eigenvalues_at(&small, &small.neutral(), &mut room);
    assert_eq!(wrong, Err(InputError::OtherModel { what: "workspace" }));
    let negative = EndsAtWorkspace::new(&large, &Metric::Diagonal(vec![-1.0; 5])).map(|_| ());
    assert!(matches!(negative, Err(InputError::NotPositive { what: "B", index: 0, .. })), "{negative:?}");
}

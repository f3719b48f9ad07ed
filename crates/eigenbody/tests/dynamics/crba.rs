use super::largest;
use crate::robots::cases;
use eigenbody::dynamics::{CrbaWorkspace, mass_matrix_into, mass_matrix_upper_into};
use eigenbody::scalar::Real;
use eigenbody::{Matrix, inverse_dynamics, mass_matrix};

scalars!(columns_are_inverse_dynamics, both_triangles_and_branch_zeros, upper_triangle_alone);

/// Column d of H is RNEA(e_d) − RNEA(0) at rest.
fn columns_are_inverse_dynamics<T: Real>() {
    for case in cases::<T>(30) {
        let n = case.nv();
        let H = mass_matrix(&case.model, &case.q).unwrap();
        let zeros = vec![T::ZERO; n];
        let at_rest = inverse_dynamics(&case.model, &case.q, &zeros, &zeros).unwrap();
        // 4 n ε: rounding of the forces, which are as large as the largest of H and of gravity
        let tolerance = 4.0 * n as f64 * T::EPSILON * (H.max_abs() + largest(&at_rest));
        for d in 0..n {
            let mut unit = zeros.clone();
            unit[d] = T::ONE;
            let tau = inverse_dynamics(&case.model, &case.q, &zeros, &unit).unwrap();
            for e in 0..n {
                let error = (tau[e] - at_rest[e] - H[(e, d)]).abs().to_f64();
                assert!(error <= tolerance, "{}: H[{e}, {d}] off by {error:e}, {tolerance:e}", case.name);
            }
        }
    }
}

/// H is symmetric to the bit, and zero to the bit where neither DoF is an ancestor of the other.
fn both_triangles_and_branch_zeros<T: Real>() {
    let mut zeros = 0;
    for case in cases::<T>(60) {
        let H = mass_matrix(&case.model, &case.q).unwrap();
        let tree = case.model.dofs();
        for d in 0..case.nv() {
            for e in 0..d {
                assert_eq!(H[(d, e)], H[(e, d)], "{}", case.name);
                let related = tree.ancestors(d).any(|a| a == e) || tree.ancestors(e).any(|a| a == d);
                if !related {
                    assert_eq!(H[(d, e)], T::ZERO, "{}: {d}, {e}", case.name);
                    zeros += 1;
                }
            }
        }
    }
    assert!(zeros > 1000, "{zeros}");
}

/// The same numbers, zeros between branches too, whatever stood there before.
fn upper_triangle_alone<T: Real>() {
    for case in cases::<T>(60) {
        let (n, model) = (case.nv(), &case.model);
        let expected = mass_matrix(model, &case.q).unwrap();
        let mut workspace = CrbaWorkspace::new(model);
        let mut H = Matrix::zeros(n, n);
        for _ in 0..2 {
            H.fill(T::from_f64(f64::NAN));
            mass_matrix_upper_into(model, &case.q, &mut workspace, &mut H).unwrap();
            for d in 0..n {
                assert_eq!(H.row(d)[d..], expected.row(d)[d..], "{}: row {d}", case.name);
            }
            H.fill(T::from_f64(f64::NAN));
            mass_matrix_into(model, &case.q, &mut workspace, &mut H).unwrap();
            assert_eq!(H, expected, "{}", case.name);
        }
    }
}

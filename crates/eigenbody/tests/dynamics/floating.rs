use crate::robots::cases;
use eigenbody::error::{Error, InputError};
use eigenbody::{Family, floating_mass_matrix, mass_matrix};
use nalgebra::DMatrix;

/// H* is the inverse of the joints' block of H⁻¹, by an independent dense inverse.
#[test]
fn reduced_matrix_is_the_schur_complement() {
    for case in cases::<f64>(20).into_iter().filter(|case| case.model.has_floating_base()) {
        let n = case.nv();
        let H = mass_matrix(&case.model, &case.q).unwrap();
        let reduced = floating_mass_matrix(&case.model, &case.q).unwrap();
        let dense = DMatrix::from_fn(n, n, |d, e| H[(d, e)]);
        let (base, joints) = (dense.view((0, 0), (6, 6)), dense.view((6, 6), (n - 6, n - 6)));
        let coupling = dense.view((6, 0), (n - 6, 6));
        let expected = joints - coupling * base.clone_owned().try_inverse().unwrap() * coupling.transpose();
        // 64 n ε κ(H_bb) max H: the explicit inverse of the base's block is the weaker of the two
        let singular = base.clone_owned().singular_values();
        let tolerance = 64.0 * n as f64 * f64::EPSILON * singular[0] / singular[5] * H.max_abs();
        for d in 0..n - 6 {
            for e in 0..n - 6 {
                let error = (reduced[(d, e)] - expected[(d, e)]).abs();
                assert!(error <= tolerance, "{}: H*[{d}, {e}] off by {error:e}, {tolerance:e}", case.name);
                assert_eq!(reduced[(d, e)], reduced[(e, d)], "{}", case.name);
            }
        }
    }
}

/// Nothing pulls at a floating robot: H* does not know where the base is or how it is turned.
#[test]
fn reduced_matrix_does_not_depend_on_the_base() {
    for case in cases::<f64>(30).into_iter().filter(|case| case.model.has_floating_base()) {
        let here = floating_mass_matrix(&case.model, &case.q).unwrap();
        let mut moved = case.q.clone();
        moved[..7].copy_from_slice(&[10.0, -20.0, 5.0, 0.5, -0.5, 0.5, 0.5]);
        let there = floating_mass_matrix(&case.model, &moved).unwrap();
        // H is written in the base's own frame: not one operation changes
        assert_eq!(here, there, "{}", case.name);
    }
}

#[test]
fn fixed_base_has_no_reduced_matrix() {
    let fixed = Family::hydra(3, 1.0, 0.0, 1.0).unwrap().model::<f64>().unwrap();
    let expected = Err(Error::Input(InputError::NoFloatingBase));
    assert_eq!(floating_mass_matrix(&fixed, &[0.0; 3]), expected);
}

/// One free body: no joints, a matrix of no rows.
#[test]
fn single_body_has_an_empty_reduced_matrix() {
    let body = Family::hydra(1, 1.0, 0.0, 1.0).unwrap().floating().model::<f64>().unwrap();
    let H = floating_mass_matrix(&body, &body.neutral()).unwrap();
    assert_eq!((H.rows(), H.cols()), (0, 0));
}

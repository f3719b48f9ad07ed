mod cholesky;
pub mod coupled;
mod ltdl;
mod ltl;

use eigenbody::Matrix;
use eigenbody::scalar::Real;

/// κ′ of the largest robots is beyond single precision: they have no factor there.
fn size<T: Real>() -> usize {
    if T::EPSILON > 1e-10 { 14 } else { 60 }
}

/// √H_dd of every DoF: LᵀL is backward stable entry by entry, |δH_de| ≤ 2 n ε √(H_dd H_ee).
fn roots<T: Real>(H: &Matrix<T>) -> Vec<f64> {
    (0..H.rows()).map(|d| H[(d, d)].to_f64().sqrt()).collect()
}

/// The same checks for a factorisation, by its doors.
macro_rules! doors {
    ($Factor:ident) => {
        use super::{roots, size};
        use crate::robots::{cases, numbers};
        use eigenbody::error::{Error, InputError};
        use eigenbody::factor::$Factor;
        use eigenbody::model::DofTree;
        use eigenbody::scalar::Real;
        use eigenbody::{Matrix, mass_matrix};

        scalars!(reconstructs_H, solves, inverts);

        fn reconstructs_H<T: Real>() {
            for case in cases::<T>(size::<T>()) {
                let H = mass_matrix(&case.model, &case.q).unwrap();
                let mut factor = $Factor::new(case.model.dofs());
                factor.factor(&H).unwrap();
                let mut again = Matrix::from_fn(case.nv(), case.nv(), |_, _| T::ONE);
                factor.reconstruct_into(&mut again).unwrap();
                let root = roots(&H);
                for d in 0..case.nv() {
                    for e in 0..case.nv() {
                        let tolerance = 2.0 * case.nv() as f64 * T::EPSILON * root[d] * root[e];
                        let error = (H[(d, e)] - again[(d, e)]).abs().to_f64();
                        assert!(error <= tolerance, "{}: H[{d}, {e}] {error:e}, {tolerance:e}", case.name);
                    }
                }
            }
        }

        fn solves<T: Real>() {
            for case in cases::<T>(size::<T>()) {
                let n = case.nv();
                let H = mass_matrix(&case.model, &case.q).unwrap();
                let mut factor = $Factor::new(case.model.dofs());
                factor.factor(&H).unwrap();
                let b: Vec<T> = numbers(n, 7);
                let mut x = b.clone();
                factor.solve(&mut x).unwrap();
                // residual: 2 n ε √H_dd Σ √H_ee |x_e|, whatever κ
                let root = roots(&H);
                let reach = x.iter().zip(&root).fold(0.0, |sum, (x, root)| sum + root * x.abs().to_f64());
                for (d, Hx) in H.times(&x).into_iter().enumerate() {
                    let tolerance = 2.0 * n as f64 * T::EPSILON * root[d] * reach;
                    let error = (Hx - b[d]).abs().to_f64();
                    assert!(error <= tolerance, "{}: row {d} {error:e} {tolerance:e}", case.name);
                }
            }
        }

        /// H⁻¹ H = 1, both triangles to the bit.
        fn inverts<T: Real>() {
            for case in cases::<T>(size::<T>().min(30)) {
                let n = case.nv();
                let H = mass_matrix(&case.model, &case.q).unwrap();
                let mut factor = $Factor::new(case.model.dofs());
                factor.factor(&H).unwrap();
                let mut inverse = Matrix::from_fn(n, n, |_, _| T::ONE);
                factor.inverse_into(&mut inverse).unwrap();
                // 8 n ε max H max H⁻¹
                let tolerance = 8.0 * n as f64 * T::EPSILON * H.max_abs() * inverse.max_abs();
                for d in 0..n {
                    let row = H.times(inverse.row(d));
                    for e in 0..n {
                        assert_eq!(inverse[(d, e)], inverse[(e, d)], "{}", case.name);
                        let error = row[e].to_f64() - if d == e { 1.0 } else { 0.0 };
                        assert!(error.abs() <= tolerance, "{}: {error:e} {tolerance:e}", case.name);
                    }
                }
            }
        }

        /// A matrix that is not positive definite is refused at the DoF where elimination meets it: DoF 1 of three, tips first.
        #[test]
        fn pivot_that_is_not_positive_is_located() {
            let tree = DofTree::chain(3);
            for (pivot, expected) in
                [(0.0, 0.0), (-2.0, -2.0), (f64::NAN, f64::NAN), (f64::INFINITY, f64::INFINITY)]
            {
                let H = Matrix::from_fn(3, 3, |i, j| if i != j { 0.0 } else { [1.0, pivot, 1.0][i] });
                let Err(Error::NotPositiveDefinite(refused)) = $Factor::new(&tree).factor(&H) else {
                    panic!("pivot {pivot} was taken");
                };
                assert_eq!(refused.dof, 1);
                assert!(refused.pivot == expected || refused.pivot.is_nan() && expected.is_nan());
            }
        }

        #[test]
        fn pivots_are_reported() {
            let tree = DofTree::chain(3);
            let H = Matrix::from_fn(3, 3, |i, j| if i != j { 0.0 } else { [4.0, 9.0, 2.0][i] });
            let info = $Factor::new(&tree).factor(&H).unwrap();
            assert_eq!((info.smallest, info.largest), ((2, 2.0), (1, 9.0)));
            assert_eq!(info.pivot_ratio(), 4.5);
        }

        #[test]
        fn wrong_sizes_are_refused() {
            let tree = DofTree::chain(2);
            let mut factor = $Factor::<f64>::new(&tree);
            let wrong = |what, found| Err(Error::Input(InputError::Length { what, expected: 2, found }));
            assert_eq!(factor.factor(&Matrix::zeros(3, 2)).map(|_| ()), wrong("H", 3));
            assert_eq!(factor.factor(&Matrix::zeros(2, 1)).map(|_| ()), wrong("H", 1));
            factor.factor(&Matrix::identity(2)).unwrap();
            assert_eq!(factor.solve(&mut [1.0]), wrong("x", 1));
            assert_eq!(factor.inverse_into(&mut Matrix::zeros(2, 3)), wrong("inverse", 3));
            assert_eq!(factor.reconstruct_into(&mut Matrix::zeros(1, 2)), wrong("H", 1));
        }
    };
}
use doors;

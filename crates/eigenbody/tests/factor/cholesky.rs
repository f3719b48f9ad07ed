use super::{roots, size};
use crate::robots::{cases, numbers};
use eigenbody::error::{Error, InputError};
use eigenbody::factor::{Cholesky, Ltl};
use eigenbody::scalar::Real;
use eigenbody::{Matrix, mass_matrix};

scalars!(reconstructs_A, solves_as_ltl_does);

fn reconstructs_A<T: Real>() {
    for case in cases::<T>(size::<T>()) {
        let H = mass_matrix(&case.model, &case.q).unwrap();
        let mut factor = Cholesky::new(case.nv());
        factor.factor(&H).unwrap();
        let mut again = Matrix::from_fn(case.nv(), case.nv(), |_, _| T::ONE);
        factor.reconstruct_into(&mut again).unwrap();
        let root = roots(&H);
        for d in 0..case.nv() {
            for e in 0..case.nv() {
                let off = (again[(d, e)] - H[(d, e)]).to_f64().abs();
                // Backward stable entry by entry: 2 n ε √(H_dd H_ee).
                assert!(off <= 2.0 * case.nv() as f64 * T::EPSILON * root[d] * root[e], "{d} {e} {off:e}");
            }
        }
    }
}

/// Two backward stable solves: residuals of a few n ε |H||x| each.
fn solves_as_ltl_does<T: Real>() {
    for case in cases::<T>(size::<T>()) {
        let H = mass_matrix(&case.model, &case.q).unwrap();
        let (mut dense, mut sparse) = (Cholesky::new(case.nv()), Ltl::new(case.model.dofs()));
        dense.factor(&H).unwrap();
        sparse.factor(&H).unwrap();
        let b: Vec<T> = numbers(case.nv(), 3);
        let (mut x, mut y) = (b.clone(), b);
        dense.solve(&mut x).unwrap();
        sparse.solve(&mut y).unwrap();
        let apart: Vec<T> = x.iter().zip(&y).map(|(&x, &y)| x - y).collect();
        let residual = H.times(&apart);
        let largest = x.iter().chain(&y).fold(0.0f64, |m, x| m.max(x.to_f64().abs()));
        let n = case.nv() as f64;
        for off in residual {
            assert!(off.to_f64().abs() <= 20.0 * n * n * T::EPSILON * H.max_abs() * largest);
        }
    }
}

#[test]
fn what_is_not_positive_definite_is_refused_with_its_place() {
    let A = Matrix::from_fn(3, 3, |i, j| if i == j { [1.0, 2.0, -1.0][i] } else { 0.0 });
    let refused = Cholesky::new(3).factor(&A);
    assert!(matches!(&refused, Err(Error::NotPositiveDefinite(at)) if at.dof == 2), "{refused:?}");
    let refused = Cholesky::<f64>::new(2).factor(&A);
    assert!(matches!(refused, Err(Error::Input(InputError::Length { .. }))));
}

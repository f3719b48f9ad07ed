use super::{definite, symmetric, weights};
use eigenbody::error::{Error, InputError};
use eigenbody::scalar::{Dd, Real, Scalar};
use eigenbody::spectrum::{eigen, eigenvalues};
use eigenbody::{Matrix, mass_matrix};
use nalgebra::{DMatrix, SymmetricEigen};

fn ones<T: Real>(n: usize) -> Vec<T> {
    vec![T::ONE; n]
}

fn largest<T: Real>(values: &[T]) -> f64 {
    values.iter().fold(0.0, |m, x| m.max(x.to_f64().abs()))
}

const SIZES: [usize; 9] = [1, 2, 3, 4, 5, 8, 13, 30, 60];

/// An independent solver finds the same eigenvalues, of definite and indefinite matrices.
#[test]
fn eigenvalues_agree_with_nalgebra() {
    for n in SIZES {
        for H in [symmetric::<f64>(n, n as u64), definite(n, n as u64)] {
            let dense = DMatrix::from_fn(n, n, |i, j| H[(i, j)]);
            let mut expected = SymmetricEigen::new(dense).eigenvalues.as_slice().to_vec();
            expected.sort_by(f64::total_cmp);
            // 4 n ε λmax: two backward stable solvers
            let tolerance = 4.0 * n as f64 * f64::EPSILON * largest(&expected);
            for found in [eigen(&H, &ones(n)).unwrap().values, eigenvalues(&H, &ones(n)).unwrap()] {
                assert!(found.is_sorted());
                for (a, b) in found.iter().zip(&expected) {
                    assert!((a - b).abs() <= tolerance, "n = {n}: {a} {b}");
                }
            }
        }
    }
}

scalars!(pairs_solve_the_problem, known_spectra);

/// H x = λ B x, XᵀBX = 1, and the largest entry, weighed by √B, is positive.
fn pairs_solve_the_problem<T: Real>() {
    for n in SIZES {
        let n = if T::EPSILON < 1e-30 { n.min(30) } else { n };
        for (H, B) in [
            (symmetric::<T>(n, 1), ones(n)),
            (definite(n, 2), weights::<T>(n, 3)),
            (symmetric(n, 4), weights(n, 5)),
        ] {
            let spectrum = eigen(&H, &B).unwrap();
            let size = largest(&spectrum.values);
            for k in 0..n {
                let x = spectrum.vectors.row(k);
                let Hx = H.times(x);
                let root: Vec<f64> = B.iter().map(|b| b.to_f64().sqrt()).collect();
                for d in 0..n {
                    // 4 n ε λmax √B_dd: in the scaled problem all errors are n ε λmax
                    let residual = (Hx[d] - spectrum.values[k] * B[d] * x[d]).abs().to_f64();
                    let tolerance = 4.0 * n as f64 * T::EPSILON * size * root[d];
                    assert!(residual <= tolerance, "n = {n}, λ {k}: {residual:e} {tolerance:e}");
                }
                for other in 0..n {
                    let y = spectrum.vectors.row(other);
                    let product = (0..n).fold(T::ZERO, |sum, d| sum + x[d] * B[d] * y[d]).to_f64();
                    let expected = if other == k { 1.0 } else { 0.0 };
                    // 4 n ε: a product of rotations and reflections
                    assert!(
                        (product - expected).abs() <= 4.0 * n as f64 * T::EPSILON,
                        "n = {n}: {k}, {other}"
                    );
                }
                let weighed: Vec<f64> = (0..n).map(|d| x[d].to_f64() * root[d]).collect();
                let (low, high) = weighed.iter().fold((0.0f64, 0.0f64), |(l, h), &a| (l.min(a), h.max(a)));
                // Two entries of equal size may differ by rounding
                assert!(high >= -low * (1.0 - 16.0 * T::EPSILON), "n = {n}: {weighed:?}");
            }
        }
    }
}

/// Matrices whose eigenvalues are known: `(name, matrix, eigenvalues)`.
fn known<T: Real>() -> Vec<(&'static str, Matrix<T>, Vec<T>)> {
    let number = T::from_f64;
    let n = 12;
    let integer = |i: usize| number(i as f64);
    // eigenvalues 2 cos(kπ/(n+1)): nothing on the diagonal. For n = 5: ±√3, ±1, 0
    let path = Matrix::from_fn(5, 5, |i, j| if i.abs_diff(j) == 1 { T::ONE } else { T::ZERO });
    let root = number(3.0).sqrt();
    let mut repeated = vec![T::ONE; n - 1];
    repeated.push(integer(n + 1));
    let mut rank_one = vec![T::ZERO; n - 1];
    rank_one.push((0..n).fold(T::ZERO, |sum, i| sum + integer(i * i)));
    let counter = |i: usize, j: usize| if i + j == n - 1 { T::ONE } else { T::ZERO };
    let half = n / 2;
    vec![
        ("none", Matrix::zeros(0, 0), vec![]),
        ("one", Matrix::from_fn(1, 1, |_, _| number(-3.5)), vec![number(-3.5)]),
        ("zero", Matrix::zeros(n, n), vec![T::ZERO; n]),
        ("identity", Matrix::identity(n), vec![T::ONE; n]),
        (
            "diagonal",
            Matrix::from_fn(n, n, |i, j| if i == j { integer((7 * i) % n) } else { T::ZERO }),
            (0..n).map(integer).collect(),
        ),
        (
            "two",
            Matrix::from_fn(2, 2, |i, j| number([[2.0, 2.0], [2.0, -1.0]][i][j])),
            vec![number(-2.0), number(3.0)],
        ),
        ("swap", Matrix::from_fn(2, 2, |i, j| if i == j { T::ZERO } else { T::ONE }), vec![-T::ONE, T::ONE]),
        ("path", path, vec![-root, -T::ONE, T::ZERO, T::ONE, root]),
        ("repeated", Matrix::from_fn(n, n, |i, j| if i == j { number(2.0) } else { T::ONE }), repeated),
        ("rank one", Matrix::from_fn(n, n, |i, j| integer(i * j)), rank_one),
        (
            "counter-identity",
            Matrix::from_fn(n, n, counter),
            [vec![-T::ONE; half], vec![T::ONE; half]].concat(),
        ),
    ]
}

/// The same at any scale. Products of two diagonal entries once overflowed in the test for negligible entries: beyond 10¹⁵⁴,
/// in f32 beyond 10¹⁹, the diagonal was returned for the eigenvalues; below 10⁻¹⁵⁴ there was no convergence.
fn known_spectra<T: Real>() {
    // Products of two entries would leave the range of each scalar
    let far = if T::EPSILON > 1e-10 { 1e25 } else { 1e170 };
    for scale in [1.0, far, 1.0 / far] {
        let s = T::from_f64(scale);
        for (name, H, expected) in known::<T>() {
            let n = H.rows();
            let H = Matrix::from_fn(n, n, |i, j| H[(i, j)] * s);
            let spectrum = eigen(&H, &ones(n)).unwrap();
            let alone = eigenvalues(&H, &ones(n)).unwrap();
            // 4 n ε λmax
            let tolerance = 4.0 * n as f64 * T::EPSILON * largest(&expected) * scale;
            for found in [&spectrum.values, &alone] {
                assert_eq!(found.len(), n);
                for (a, &b) in found.iter().zip(&expected) {
                    let error = (*a - b * s).abs().to_f64();
                    assert!(error <= tolerance, "{name} at scale {scale:e}: {found:?}");
                }
            }
        }
    }
}

/// Diagonal matrices come back to the bit, with unit vectors.
#[test]
fn diagonal_matrices_are_exact() {
    let diagonal = [3.0, 1e-300, -7.0, 1e300, 0.0, 3.0];
    let H = Matrix::from_fn(6, 6, |i, j| if i == j { diagonal[i] } else { 0.0 });
    let spectrum = eigen(&H, &[1.0; 6]).unwrap();
    assert_eq!(spectrum.values, [-7.0, 0.0, 1e-300, 3.0, 3.0, 1e300]);
    for k in 0..6 {
        let x = spectrum.vectors.row(k);
        assert_eq!(x.iter().filter(|&&x| x == 1.0).count(), 1);
        assert_eq!(x.iter().filter(|&&x| x == 0.0).count(), 5);
    }
}

/// |λ − λ_exact| ≤ c n ε λmax with double-double as the exact one: mass matrices and random ones.
#[test]
fn eigenvalues_are_good_to_rounding_of_the_largest() {
    let mut matrices: Vec<Matrix<f64>> = [10, 30, 60].into_iter().map(|n| definite(n, 11)).collect();
    for case in crate::robots::cases::<f64>(30) {
        matrices.push(mass_matrix(&case.model, &case.q).unwrap());
    }
    for H in matrices {
        let n = H.rows();
        let exact = Matrix::from_fn(n, n, |i, j| Dd::from_f64(H[(i, j)]));
        let exact = eigenvalues(&exact, &ones(n)).unwrap();
        let found = eigenvalues(&H, &ones(n)).unwrap();
        for (a, b) in found.iter().zip(&exact) {
            let error = (Dd::from_f64(*a) - *b).abs().to_f64();
            let tolerance = n as f64 * f64::EPSILON * largest(&exact);
            assert!(error <= tolerance, "n = {n}: {a} {b:?} {error:e} {tolerance:e}");
        }
    }
}

/// A graded matrix, H_ij = s_i s_j C_ij with κ(C) = 2.2: small eigenvalues keep their digits in whatever order the rows come,
/// where a solver that takes them as they come would lose all below ε λmax.
#[test]
fn graded_matrices_keep_their_small_eigenvalues() {
    let n = 12;
    for order in 0..4 {
        let place = |i: usize| [i, n - 1 - i, (5 * i) % n, (7 * i + 3) % n][order];
        let entry = |i: usize, j: usize| {
            let size = 0.01f64.powi((place(i) + place(j)) as i32);
            size * if i == j { 1.0 } else { 0.3 / (1.0 + i.abs_diff(j) as f64) }
        };
        let H = Matrix::from_fn(n, n, entry);
        let exact = eigenvalues(&Matrix::from_fn(n, n, |i, j| Dd::from_f64(entry(i, j))), &ones(n)).unwrap();
        for found in [eigenvalues(&H, &ones(n)).unwrap(), eigen(&H, &ones(n)).unwrap().values] {
            for (a, b) in found.iter().zip(&exact) {
                let error = (a / b.to_f64() - 1.0).abs();
                // 1000 n ε of the eigenvalue itself, and λmin is 10⁻⁴⁴ λmax: reflections mix rows of unlike size a little
                assert!(error <= 1000.0 * n as f64 * f64::EPSILON, "order {order}: {a:e} {b:?} {error:e}");
            }
        }
    }
}

scalars!(nothing_on_the_diagonal, low_rank);

/// Adjacency matrices have a zero diagonal, by which no off-diagonal entry can be called negligible.
/// A path of n has the eigenvalues 2 cos(kπ/(n+1)), a star ±√(n−1) and zeros.
fn nothing_on_the_diagonal<T: Real>() {
    for n in [2, 3, 10, 31, 50] {
        let one_if = |yes| if yes { T::ONE } else { T::ZERO };
        let path = eigenvalues(&Matrix::from_fn(n, n, |i, j| one_if(i.abs_diff(j) == 1)), &ones(n)).unwrap();
        let star =
            eigenvalues(&Matrix::from_fn(n, n, |i, j| one_if((i == 0) != (j == 0))), &ones(n)).unwrap();
        let root = (n as f64 - 1.0).sqrt();
        // 4 n ε λmax, and the expected value's own rounding in f64
        let tolerance = 4.0 * n as f64 * T::EPSILON.max(f64::EPSILON);
        for k in 0..n {
            let expected = -2.0 * ((k + 1) as f64 * std::f64::consts::PI / (n + 1) as f64).cos();
            assert!((path[k].to_f64() - expected).abs() <= 2.0 * tolerance, "path of {n}: {path:?}");
            let expected = if k == 0 {
                -root
            } else if k + 1 == n {
                root
            } else {
                0.0
            };
            assert!((star[k].to_f64() - expected).abs() <= root * tolerance, "star of {n}: {star:?}");
        }
    }
}

/// Many eigenvalues zero to rounding: of rank 3, two positive and one negative.
fn low_rank<T: Real>() {
    for n in [4, 10, 40] {
        let A = symmetric::<T>(n, n as u64);
        let entry =
            |i: usize, j: usize| A[(i, 0)] * A[(j, 0)] + A[(i, 1)] * A[(j, 1)] - A[(i, 2)] * A[(j, 2)];
        let found = eigenvalues(&Matrix::from_fn(n, n, entry), &ones(n)).unwrap();
        // 4 n ε λmax
        let tolerance = 4.0 * n as f64 * T::EPSILON * largest(&found);
        let signs: Vec<i32> = found
            .iter()
            .map(|x| if x.abs().to_f64() <= tolerance { 0 } else { x.to_f64().signum() as i32 })
            .collect();
        assert_eq!((signs[0], &signs[n - 2..]), (-1, [1, 1].as_slice()), "{found:?}");
        assert!(signs[1..n - 2].iter().all(|&sign| sign == 0), "{found:?}");
    }
}

#[test]
fn inputs_that_do_not_fit() {
    let length = |what, expected, found| Err(Error::Input(InputError::Length { what, expected, found }));
    assert_eq!(eigenvalues(&Matrix::<f64>::zeros(3, 2), &[1.0; 3]), length("columns of H", 3, 2));
    assert_eq!(eigenvalues(&Matrix::<f64>::zeros(3, 3), &[1.0; 2]), length("B", 3, 2));
    assert_eq!(eigen(&Matrix::<f64>::zeros(2, 3), &[1.0; 2]).map(|_| vec![]), length("columns of H", 2, 3));
    for bad in [f64::NAN, f64::INFINITY] {
        let H = Matrix::from_fn(3, 3, |i, j| if i == j { [1.0, 2.0, bad][i] } else { 0.0 });
        let refused = Err(Error::Input(InputError::NotFinite { what: "H", index: 2 }));
        assert_eq!(eigenvalues(&H, &[1.0; 3]), refused);
    }
}

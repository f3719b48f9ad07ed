use super::largest;
use crate::robots::{Case, cases};
use eigenbody::dynamics::{Denoc, Udu};
use eigenbody::scalar::Real;
use eigenbody::spatial::Vec3;
use eigenbody::{Error, Family, InputError, Matrix, Model, forward_dynamics, mass_matrix};

scalars!(entries_are_those_of_crba, factors_multiply_to_the_matrix, solve_is_that_of_aba);

fn at<'m, T: Real>(model: &'m Model<T>, q: &[T]) -> Denoc<'m, T> {
    let mut denoc = Denoc::new(model);
    denoc.update(q).unwrap();
    denoc
}

fn difference<T: Real>(A: &Matrix<T>, B: &Matrix<T>) -> f64 {
    A.as_slice().iter().zip(B.as_slice()).fold(0.0, |worst, (&a, &b)| worst.max((a - b).abs().to_f64()))
}

/// Serial robots of the two papers, 1 to 100 links, in random configurations.
fn serial<T: Real>() -> Vec<Case<T>> {
    let mut found = Vec::new();
    for n in [1, 2, 4, 10, 33, 100] {
        let members = [
            Family::slender_chain(n, 2.20698, 1.0),
            Family::hydra(n, 1.0, 0.0, 1.0),
            Family::hydra(n, 1.0, 0.5, 1.0),
            Family::hydra(n, 1.0, 0.3, 0.97),
        ];
        for (seed, member) in (1..).zip(members) {
            let family = member.unwrap();
            found.push(Case::new(family.name(), family.model().unwrap(), seed));
        }
    }
    found
}

/// Two formulations, one in the bodies' frames, one in the world's axes: 8·depth·ε of max|H|, depth the number of shifts in a row.
fn entries_are_those_of_crba<T: Real>() {
    for case in cases::<T>(60).into_iter().chain(serial()) {
        let H = mass_matrix(&case.model, &case.q).unwrap();
        let found = at(&case.model, &case.q).mass_matrix().unwrap();
        let error = difference(&found, &H);
        let tolerance = 8.0 * case.nv() as f64 * T::EPSILON * H.max_abs();
        assert!(error <= tolerance, "{}: {error:e}, {tolerance:e}", case.name);
    }
}

/// On serial robots of up to 100 links in f64: 1e-13 of max|H|, 450 ε.
#[test]
fn serial_robots_to_thirteen_digits() {
    for case in serial::<f64>() {
        let H = mass_matrix(&case.model, &case.q).unwrap();
        let error = difference(&at(&case.model, &case.q).mass_matrix().unwrap(), &H) / H.max_abs();
        assert!(error <= 1e-13, "{}: {error:e}", case.name);
    }
}

/// U D Uᵀ = I to 8·depth·ε of max|H|.
fn factors_multiply_to_the_matrix<T: Real>() {
    for case in cases::<T>(60).into_iter().chain(serial()) {
        let denoc = at(&case.model, &case.q);
        let mut udu = Udu::new(&denoc);
        udu.factor(&denoc).unwrap();
        let H = mass_matrix(&case.model, &case.q).unwrap();
        let error = difference(&udu.reconstruct(&denoc).unwrap(), &H);
        let tolerance = 8.0 * case.nv() as f64 * T::EPSILON * H.max_abs();
        assert!(error <= tolerance, "{}: {error:e}, {tolerance:e}", case.name);
    }
}

/// I⁻¹ φ by UDUᵀ and by ABA, at rest without gravity, compared as forces: H (a − b) within 32 n ε of what the two solves round.
fn solve_is_that_of_aba<T: Real>() {
    for case in cases::<T>(60).into_iter().chain(serial()) {
        let n = case.nv();
        let still = case.model.clone().with_gravity(Vec3::ZERO).unwrap();
        let expected = forward_dynamics(&still, &case.q, &vec![T::ZERO; n], &case.vdot).unwrap();
        let denoc = at(&still, &case.q);
        let mut udu = Udu::new(&denoc);
        udu.factor(&denoc).unwrap();
        let mut found = case.vdot.clone();
        udu.solve(&denoc, &mut found).unwrap();
        let H = mass_matrix(&still, &case.q).unwrap();
        let apart: Vec<T> = found.iter().zip(&expected).map(|(&a, &b)| a - b).collect();
        let error = largest(&H.times(&apart));
        let tolerance =
            32.0 * n as f64 * T::EPSILON * (H.max_abs() * largest(&expected) + largest(&case.vdot));
        assert!(error <= tolerance, "{}: {error:e}, {tolerance:e}", case.name);
    }
}

/// p, A and M̃ of the four rods in line: axes along z, shifts along x, the composite of all rods.
#[test]
fn factors_of_the_papers_chain() {
    let chain = Family::slender_chain(4, 2.0, 1.0).unwrap().model::<f64>().unwrap();
    let denoc = at(&chain, &[0.0; 4]);
    assert_eq!(denoc.motion_propagation(3).to_array(), [0.0, 0.0, 1.0, 0.0, 0.0, 0.0]);
    let carried = denoc.twist_propagation(3, 0).motion(denoc.motion_propagation(0));
    assert_eq!(carried.to_array(), [0.0, 0.0, 1.0, 0.0, 3.0, 0.0]);
    let whole = denoc.composite_mass(0);
    assert_eq!((whole.m, whole.h.x), (8.0, 16.0));
    // (4 m)(4 l)²/3 of one rod four times as long and heavy, to 4 ε
    assert!((whole.I.zz - 128.0 / 3.0).abs() <= 4.0 * f64::EPSILON * whole.I.zz);
}

#[test]
fn bad_inputs_are_refused() {
    let (chain, other) =
        [3, 4].map(|n| Family::slender_chain(n, 2.0, 1.0).unwrap().model::<f64>().unwrap()).into();
    let mut denoc = Denoc::new(&chain);
    assert!(matches!(denoc.update(&[0.0; 2]), Err(InputError::Length { what: "q", .. })));
    denoc.update(&[0.0; 3]).unwrap();
    let mut udu = Udu::new(&denoc);
    udu.factor(&denoc).unwrap();
    assert!(matches!(udu.solve(&denoc, &mut [0.0; 2]), Err(InputError::Length { what: "phi", .. })));
    assert!(matches!(
        udu.factor(&Denoc::new(&other)),
        Err(Error::Input(InputError::OtherModel { what: "denoc" }))
    ));
    // Never updated: no mass anywhere.
    let empty = Denoc::new(&chain);
    assert!(matches!(udu.factor(&empty), Err(Error::NotPositiveDefinite(_))));
}

use super::largest;
use crate::robots::cases;
use eigenbody::scalar::Real;
use eigenbody::{forward_dynamics, inverse_dynamics, mass_matrix};

scalars!(forward_undoes_inverse, inverse_undoes_forward);

/// RNEA ∘ ABA = 1 on forces: the residual of a solve is small whatever κ.
fn inverse_undoes_forward<T: Real>() {
    for case in cases::<T>(60) {
        let n = case.nv();
        let tau = &case.vdot;
        let vdot = forward_dynamics(&case.model, &case.q, &case.v, tau).unwrap();
        let again = inverse_dynamics(&case.model, &case.q, &case.v, &vdot).unwrap();
        let H = mass_matrix(&case.model, &case.q).unwrap();
        let C = inverse_dynamics(&case.model, &case.q, &case.v, &vec![T::ZERO; n]).unwrap();
        // 32 n ε of the forces that cancel: H v̇, C
        let forces = n as f64 * H.max_abs() * largest(&vdot) + largest(&C) + largest(tau);
        let tolerance = 32.0 * T::EPSILON * forces;
        for d in 0..n {
            let error = (again[d] - tau[d]).abs().to_f64();
            assert!(error <= tolerance, "{}: τ[{d}] off by {error:e}, {tolerance:e}", case.name);
        }
    }
}

/// ABA ∘ RNEA = 1 on accelerations, in the norm of H, where the error does not grow with κ.
fn forward_undoes_inverse<T: Real>() {
    for case in cases::<T>(60) {
        let n = case.nv();
        let tau = inverse_dynamics(&case.model, &case.q, &case.v, &case.vdot).unwrap();
        let again = forward_dynamics(&case.model, &case.q, &case.v, &tau).unwrap();
        let difference: Vec<T> = again.iter().zip(&case.vdot).map(|(&a, &b)| a - b).collect();
        let H = mass_matrix(&case.model, &case.q).unwrap();
        // 32 n ε of the forces: H (v̇' − v̇) is what RNEA's and ABA's rounding comes to
        let error = largest(&H.times(&difference));
        let tolerance = 32.0 * n as f64 * T::EPSILON * (H.max_abs() * largest(&case.vdot) + largest(&tau));
        assert!(error <= tolerance, "{}: H (v̇' − v̇) = {error:e}, {tolerance:e}", case.name);
    }
}

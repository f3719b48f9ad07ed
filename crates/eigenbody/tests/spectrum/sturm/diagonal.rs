use crate::spectrum::systems::systems;
use eigenbody::scalar::{Dd, Scalar};

/// The diagonal of H, and of H* with the base removed, without either matrix.
#[test]
fn diagonal_is_that_of_the_matrix() {
    for system in systems(30) {
        let (H, full, diagonal) = (system.matrix(), system.full_matrix(), system.pencil().diagonal());
        let base = full.rows() - H.rows();
        for d in 0..H.rows() {
            let error = (Dd::from_f64(diagonal[base + d]) - H[(d, d)]).abs().hi();
            // 2 n ε H_dd: inertias of all bodies are turned and summed. For H*, the larger of what the joint carries and what it
            // feels; eight times that, because levers to the heaviest body cancel.
            let governs = H[(d, d)].max(full[(base + d, base + d)]).hi();
            let c = if system.is_free { 16.0 } else { 2.0 };
            let allowed = c * diagonal.len() as f64 * f64::EPSILON * governs;
            assert!(error <= allowed, "{}: row {d} off by {error:e}, {allowed:e} allowed", system.name);
        }
    }
}

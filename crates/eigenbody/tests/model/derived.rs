//! What follows from a model and is made when it is first asked for.

use eigenbody::spatial::{RigidInertia, Sym3, Vec3};
use eigenbody::{Family, Model, mass_matrix};

/// What kernels have made of a model for themselves is no part of it, and goes with the inertia that it was made of.
#[test]
fn a_model_that_has_been_used_is_still_the_same() {
    let fresh: Model<f64> = Family::hydra(4, 1.0, 0.4, 1.0).unwrap().model().unwrap();
    let (used, q) = (fresh.clone(), [0.3; 4]);
    let H = mass_matrix(&used, &q).unwrap();
    assert_eq!(used, fresh);
    let rod = RigidInertia::from_com(3.0, Vec3::X, Sym3::diagonal(0.1, 0.2, 0.3));
    let [used, fresh] = [used, fresh].map(|model| {
        let link = model.bodies()[3].link();
        mass_matrix(&model.with_inertia(link, rod).unwrap(), &q).unwrap()
    });
    assert_eq!(used, fresh);
    assert_ne!(used, H);
}

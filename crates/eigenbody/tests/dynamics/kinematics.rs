use super::largest;
use crate::robots::{configuration, numbers, plan};
use eigenbody::Base;
use eigenbody::dynamics::{link_pose, link_poses, momentum};
use eigenbody::scalar::Real;
use eigenbody::spatial::Vec3;

scalars!(poses_place_the_mass);

/// Every link's mass, at the pose of the link itself, adds up to the first moment of the whole: merged links included.
fn poses_place_the_mass<T: Real>() {
    for seed in 0..40 {
        let base = if seed % 2 == 0 { Base::Fixed } else { Base::Floating };
        let plan = plan::<T>(seed, 1 + seed as usize / 2);
        let model = plan.build(base);
        let q = configuration(&model, seed);
        let total = momentum(&model, &q, &numbers(model.nv(), seed)).unwrap();
        let all = link_poses(&model, &q).unwrap();
        let (mut mass, mut moment) = (T::ZERO, Vec3::ZERO);
        for (i, link) in model.links().iter().enumerate() {
            if link.body().is_some() {
                let inertia = plan.links[i].inertia;
                let (X, one) = (all[i], link_pose(&model, &q, i).unwrap());
                // 8 n ε of the reach
                let apart = largest(&[(X.r - one.r).to_array(), (X.E.x - one.E.x).to_array()].concat());
                assert!(
                    apart <= 8.0 * (plan.links.len() as f64).powi(2) * T::EPSILON,
                    "seed {seed}: {apart:e}"
                );
                mass += inertia.m;
                moment += X.E.transpose_times(inertia.h) + X.r * inertia.m;
            }
        }
        // 16 n ε of the mass times its reach
        let n = plan.links.len() as f64;
        let tolerance = 16.0 * n * T::EPSILON * (total.mass.to_f64() * n);
        let error = largest(&[(moment - total.moment).to_array().as_slice(), &[mass - total.mass]].concat());
        assert!(error <= tolerance, "seed {seed}: {error:e} {tolerance:e}");
    }
}

//! The inertial gradient against differences, on trees of all joints with fixed links turned against their bodies.

use crate::robots::plan;
use eigenbody::dynamics::{energy, inertial_gradient};
use eigenbody::model::Random;
use eigenbody::scalar::{Dd, Real, Scalar};
use eigenbody::spatial::{RigidInertia, Sym3, Vec3};
use eigenbody::{Base, Model};

/// 2T with body `i` of mass m, centre c and inertia I.
fn twice(model: &Model<Dd>, q: &[Dd], v: &[Dd], i: usize, (m, c, I): (Dd, Vec3<Dd>, Sym3<Dd>)) -> Dd {
    let changed = model.clone().with_inertia(model.bodies()[i].link(), RigidInertia::from_com(m, c, I));
    energy(&changed.unwrap(), q, v).unwrap().kinetic * Dd::from_f64(2.0)
}

#[test]
fn as_differences_have_it() {
    for seed in 0..6 {
        let model: Model<Dd> = plan::<Dd>(seed, 7).build(Base::Fixed);
        let q = model.random(seed);
        let mut random = Random::new(seed);
        let v: Vec<Dd> = (0..model.nv()).map(|_| Dd::from_f64(random.between(-1.0, 1.0))).collect();
        let all = inertial_gradient(&model, &q, &v).unwrap();
        let whole = energy(&model, &q, &v).unwrap().kinetic.to_f64() * 2.0;
        let d = Dd::from_f64(1e-9);
        for (i, of) in all.iter().enumerate() {
            let now = twice(&model, &q, &v, i, (of.m, of.c, of.I)).to_f64();
            assert!((now - whole).abs() < 1e-13 * whole, "{seed} {i}");
            let near = |parameter: (Dd, Vec3<Dd>, Sym3<Dd>), expected: Dd| {
                let base = twice(&model, &q, &v, i, (of.m, of.c, of.I));
                let rate = ((twice(&model, &q, &v, i, parameter) - base) / d).to_f64();
                // Truncation: d times the second derivative, |ω|² m.
                assert!(
                    (rate - expected.to_f64()).abs() <= 1e-7 * (1.0 + whole),
                    "{seed} {i}: {rate} {expected:?}"
                );
            };
            near((of.m + d, of.c, of.I), of.of_m);
            let mut c = of.c;
            c.y += d;
            near((of.m, c, of.I), of.of_c.y);
            for (entry, expected) in [(0, of.of_I.xx), (1, of.of_I.xy), (2, of.of_I.yz)] {
                let mut I = of.I;
                match entry {
                    0 => I.xx += d,
                    1 => I.xy += d,
                    _ => I.yz += d,
                }
                near((of.m, of.c, I), expected);
            }
        }
    }
}

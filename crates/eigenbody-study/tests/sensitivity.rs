//! Rates of log κ against differences in double-double.

use eigenbody::scalar::{Dd, Real, Scalar};
use eigenbody::search::{Effort, Measure};
use eigenbody::spatial::RigidInertia;
use eigenbody::spectrum::eigenvalues;
use eigenbody::{Family, Model, mass_matrix};
use eigenbody_study::diagnosis::{Diagnosis, Parameter, Question, Sensitivity, diagnose};
use std::ops::ControlFlow::Continue;

fn found(model: &Model<f64>) -> Diagnosis {
    let effort = Effort { samples: 64, starts: 4, ..Effort::default() };
    diagnose(model, &Question { effort, ..Question::default() }, |_| Continue(())).unwrap()
}

/// λmax and λmin in double-double of a robot with one parameter changed by `part` of what it is measured against.
fn ends(model: &Model<f64>, q: &[f64], of: &Sensitivity, part: Dd) -> (Dd, Dd) {
    let mut wide: Model<Dd> = model.cast();
    let delta = Dd::from_f64(of.against) * part;
    if of.parameter == Parameter::Armature {
        let d = (0..model.nv()).find(|&d| model.dof_name(d) == of.of).unwrap();
        let mut armature = wide.armature().to_vec();
        armature[d] += delta;
        wide = wide.with_armature(armature).unwrap();
    } else {
        let link = model.links().iter().position(|link| link.name() == of.of).unwrap();
        let body = model.links()[link].body().unwrap();
        let X = wide.links()[link].link_from_body();
        let (mut m, mut c, mut I) = X.inverse().transpose_rigid(*wide.bodies()[body].inertia()).central();
        match of.parameter {
            Parameter::Mass => m += delta,
            Parameter::Centre(0) => c.x += delta,
            Parameter::Centre(1) => c.y += delta,
            Parameter::Centre(_) => c.z += delta,
            Parameter::Inertia(0) => I.xx += delta,
            Parameter::Inertia(1) => I.yy += delta,
            Parameter::Inertia(2) => I.zz += delta,
            Parameter::Inertia(3) => I.xy += delta,
            Parameter::Inertia(4) => I.xz += delta,
            Parameter::Inertia(_) => I.yz += delta,
            Parameter::Armature => {}
        }
        wide = wide.with_inertia(link, RigidInertia::from_com(m, c, I)).unwrap();
    }
    let q: Vec<Dd> = q.iter().map(|&q| Dd::from_f64(q)).collect();
    let values = eigenvalues(&mass_matrix(&wide, &q).unwrap(), &vec![Dd::ONE; model.nv()]).unwrap();
    (values[values.len() - 1], values[0])
}

/// Central differences at a step h err by h² of the third derivative; 1e-8 of the rate, or of what κ itself is known to.
#[test]
fn as_double_double_differences_have_them() {
    for (n, skew, taper) in [(3, 0.3, 0.8), (5, 0.5, 0.7), (7, 0.2, 0.9)] {
        let model: Model<f64> = Family::hydra(n, 1.0, skew, taper).unwrap().model().unwrap();
        let armature = (0..n).map(|d| 0.01 * (1.0 + d as f64)).collect();
        let model = model.with_armature(armature).unwrap();
        let found = found(&model);
        let q = &found.by(Measure::Kappa).unwrap().spread.at;
        assert!(found.sensitivities.len() > 10, "{}", found.sensitivities.len());
        for of in &found.sensitivities {
            let h = 1e-7;
            let (up, down) = (ends(&model, q, of, Dd::from_f64(h)), ends(&model, q, of, Dd::from_f64(-h)));
            // log(a/b) = log1p(a/b − 1), a/b − 1 in double-double.
            let log = |a: Dd, b: Dd| ((a - b) / b).to_f64().ln_1p();
            let rate = (log(up.0, down.0) - log(up.1, down.1)) / (2.0 * h);
            assert!((rate - of.rate).abs() <= 1e-8 * of.rate.abs().max(1.0), "{n} {of:?}: {rate}");
        }
        let sizes: Vec<f64> = found.sensitivities.iter().map(|of| of.rate.abs()).collect();
        assert!(sizes.is_sorted_by(|a, b| a >= b));
    }
}

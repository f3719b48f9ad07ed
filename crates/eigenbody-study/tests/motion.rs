//! The studies along motions, and the monitors, on small robots.

use eigenbody::dynamics::energy;
use eigenbody::model::{JointSpec, MimicSpec};
use eigenbody::spatial::{RigidInertia, Sym3, Transform, Vec3};
use eigenbody::{Base, Family, Joint, Model, ModelBuilder, Question, Reduction, conditioning_at};
use eigenbody_study::monitor::{Monitors, Quantity};
use eigenbody_study::motion::judged::{Motion, judge};
use eigenbody_study::motion::{Group, Subject, cost, quantile, rank_correlation};
use eigenbody_study::simulate::State;
use eigenbody_study::{Cell, Shape};

fn subject(family: &Family) -> Subject {
    Subject { name: "test".into(), group: Group::Chain, model: family.model().unwrap() }
}

/// Along every kind of motion the tracker is exact to 1e-12, the bracket holds, and δ_s starts at κ.
#[test]
fn estimators_are_judged_against_an_exact_tracker() {
    for family in [Family::slender_chain(5, 1.0, 1.0), Family::hydra(9, 1.5, 0.4, 0.9)] {
        for motion in Motion::ALL {
            let found = judge(&subject(&family.clone().unwrap()), motion).unwrap();
            assert!(found.ended.is_none() && found.rows.len() >= 300, "{:?}", found.ended);
            assert!(found.tracker_error <= 1e-12, "{motion:?}: {:e}", found.tracker_error);
            let first = found.rows[0];
            assert!((first.estimates[1] / first.kappa - 1.0).abs() < 1e-12);
            // rounding of r and κ′: n ε κ′
            let holds = |row: &eigenbody_study::motion::judged::Row| {
                row.estimates[0] <= row.kappa * (1.0 + 1e-9) && row.kappa <= row.estimates[3] * (1.0 + 1e-9)
            };
            assert!(found.rows.iter().all(holds), "{motion:?}");
            if motion != Motion::Random {
                assert!(found.factorisations <= 2.5, "{motion:?}: {}", found.factorisations);
            }
        }
    }
}

/// Errors of four ways in two precisions are of the order that κ′ predicts: between ε and 100 ε κ′.
#[test]
fn digits_are_lost_as_predicted() {
    let found = cost::digits(&subject(&Family::hydra(8, 1.0, 0.3, 1.0).unwrap())).unwrap();
    assert_eq!(found.len(), 8);
    for one in &found {
        for way in one.errors {
            for error in [way[0][1], way[1][1]] {
                assert!(error > 0.01 && error < 100.0 * one.kappa_weighted, "{one:?}");
            }
        }
    }
    let effort = cost::effort(&subject(&Family::hydra(3, 1.0, 0.3, 1.0).unwrap())).unwrap();
    let (Some(steps), [Some(aba), Some(crba)]) = (effort.steps, effort.tight) else { panic!("{effort:?}") };
    assert!(steps < aba && (crba / aba - 1.0).abs() < 0.2 && effort.drift.unwrap() < 1e-3, "{effort:?}");
}

#[test]
fn ranks_and_quantiles() {
    assert_eq!(rank_correlation(&[1.0, 2.0, 3.0], &[3.0, 2.0, 1.0]), -1.0);
    // ties: ranks 0.5, 0.5, 2 against 0, 1, 2
    assert!((rank_correlation(&[1.0, 1.0, 5.0], &[1.0, 2.0, 3.0]) - 0.75f64.sqrt()).abs() < 1e-15);
    assert_eq!(quantile(&[3.0, 1.0, 2.0, f64::NAN], 0.5), 2.0);
    assert!(quantile(&[], 0.5).is_nan());
}

/// Three links, the last of which mirrors the first.
fn mirrored() -> Model<f64> {
    let mut robot = ModelBuilder::new("mirrored");
    let mut parent = robot.link("base", RigidInertia::ZERO);
    for k in 0..3 {
        let rod = RigidInertia::from_com(1.0, Vec3::new(0.5, 0.0, 0.0), Sym3::diagonal(0.01, 0.08, 0.08));
        let link = robot.link(format!("link {k}"), rod);
        let place = Transform::translation(Vec3::X * if k == 0 { 0.0 } else { 1.0 });
        let mut joint = JointSpec::new(format!("joint {k}"), Joint::Revolute, parent, link).at(place);
        if k == 2 {
            joint.mimic = Some(MimicSpec { joint: "joint 0".into(), multiplier: -1.0, offset: 0.0 });
        }
        robot.joint(joint);
        parent = link;
    }
    robot.build(Base::Fixed).unwrap()
}

/// Every quantity, in every reduction, is what the core says of that configuration.
#[test]
fn monitors_say_what_the_core_says() {
    let floating: Model<f64> = Family::auto_tree(8, 1.5, 0.3, 1.0).unwrap().floating().model().unwrap();
    let coupled = mirrored();
    for (model, reduction) in [
        (&floating, Reduction::default()),
        (&floating, Reduction { base: true, mimic: false }),
        (&coupled, Reduction::default()),
        (&coupled, Reduction { base: false, mimic: true }),
    ] {
        let mut monitors = Monitors::new(model, reduction, &Quantity::ALL).unwrap();
        let fields = monitors.fields();
        for seed in 1..6 {
            let mut q = model.random(seed);
            if let Some(coupling) = model.coupling().filter(|_| reduction.mimic) {
                let free: Vec<f64> = coupling.independent_coordinates().iter().map(|&k| q[k]).collect();
                q = coupling.expand(&free);
            }
            let v = vec![0.3; model.nv()];
            let row = monitors.observe(&State { t: 0.0, q: q.clone(), v: v.clone() }).unwrap();
            assert_eq!(row.len(), fields.len());
            let number = |name: &str| {
                let place = fields.iter().position(|field| field.name == name).unwrap();
                let Cell::Number(Some(x)) = row[place] else { panic!("{name}: {:?}", row[place]) };
                x
            };
            let all = true;
            let core =
                conditioning_at(model, &q, &Question { reduction, all, ..Question::default() }).unwrap();
            let bracket = core.bracket.unwrap();
            for (name, expected) in [
                ("kappa", core.kappa.unwrap()),
                ("kappa_weighted", core.kappa_weighted.unwrap()),
                ("lambda_min", core.lambda_min.unwrap()),
                ("lambda_max", core.lambda_max.unwrap()),
                ("diagonal_ratio", core.diagonal_ratio.unwrap()),
                ("bracket_lo", bracket.0),
                ("bracket_hi", bracket.1),
            ] {
                // the dense method's own error is n ε κ′, κ′ here below 10⁴
                assert!((number(name) / expected - 1.0).abs() < 1e-10, "{name}: {} {expected}", number(name));
            }
            let kinetic = energy(model, &q, &v).unwrap().kinetic;
            assert!((number("kinetic_energy") / kinetic - 1.0).abs() < 1e-14);
            for (field, cell) in fields.iter().zip(&row).filter(|(field, _)| field.shape == Shape::List) {
                let Cell::List(all) = cell else { panic!("{cell:?}") };
                let expected = if field.name == "momentum" { 6 } else { reduction.dofs(model).len() };
                assert_eq!(all.len(), expected, "{}", field.name);
            }
        }
    }
    assert!(Monitors::new(&coupled, Reduction { base: true, mimic: false }, &[]).is_err());
}

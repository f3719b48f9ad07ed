//! Largest steps over the joint limits, and gains: against simulation of the whole robot, and by force.

use eigenbody::dynamics::forward_dynamics;
use eigenbody::search::Effort;
use eigenbody::spatial::Vec3;
use eigenbody::stability::{Impedance, Integrator, Spring, SpringSource, largest_step};
use eigenbody::{Family, Model, Reduction, mass_matrix};
use eigenbody_study::diagnosis::{Diagnosis, Drive, Question, Stepping, diagnose};
use std::ops::ControlFlow::Continue;

/// A spring and a damper on every joint, not the same on all.
fn springs(model: &Model<f64>, kp: f64, kd: f64) -> Vec<Spring> {
    let spring = |d: usize| Spring {
        name: model.dof_name(d),
        source: if d.is_multiple_of(2) { SpringSource::Actuator } else { SpringSource::Joint },
        arms: vec![(d, 1.0)],
        stiffness: kp * (1.0 + d as f64),
        damping: kd / (1.0 + d as f64),
    };
    (0..model.nv()).map(spring).collect()
}

fn check(model: &Model<f64>, drive: Drive) -> Diagnosis {
    let effort = Effort { samples: 128, starts: 4, ..Effort::default() };
    diagnose(model, &Question { effort, drive, ..Question::default() }, |_| Continue(())).unwrap()
}

fn stepping(model: &Model<f64>, drive: Drive) -> Stepping {
    check(model, drive).stepping.unwrap()
}

fn robots() -> Vec<Model<f64>> {
    let family = |family: Result<Family, _>| family.unwrap().model().unwrap();
    let mut all = vec![eigenbody::family::puma560().unwrap(), family(Family::hydra(6, 1.5, 0.4, 0.8))];
    all.extend(
        [(3, 0.0, 1.0), (5, 0.3, 0.7)].map(|(n, skew, taper)| family(Family::hydra(n, 1.0, skew, taper))),
    );
    all.into_iter().map(|model| model.with_gravity(Vec3::ZERO).unwrap()).collect()
}

/// v⁺ and q⁺ of a method, the whole robot: H, C and the springs as they are at q, v.
fn step(
    model: &Model<f64>,
    springs: &Impedance,
    rest: &[f64],
    integrator: Integrator,
    h: f64,
    (q, v): (&mut Vec<f64>, &mut Vec<f64>),
) {
    let force = |q: &[f64], v: &[f64]| -> Vec<f64> {
        let away: Vec<f64> = q.iter().zip(rest).map(|(q, rest)| q - rest).collect();
        let (k, d) = (springs.stiffness.times(&away), springs.damping.times(v));
        k.iter().zip(d).map(|(k, d)| -k - d).collect()
    };
    let rate = |q: &[f64], v: &[f64]| forward_dynamics(model, q, v, &force(q, v)).unwrap();
    let along =
        |x: &[f64], h: f64, v: &[f64]| -> Vec<f64> { x.iter().zip(v).map(|(x, v)| x + h * v).collect() };
    if integrator == Integrator::RungeKutta4 {
        let a1 = rate(q, v);
        let v2 = along(v, 0.5 * h, &a1);
        let a2 = rate(&along(q, 0.5 * h, v), &v2);
        let v3 = along(v, 0.5 * h, &a2);
        let a3 = rate(&along(q, 0.5 * h, &v2), &v3);
        let v4 = along(v, h, &a3);
        let a4 = rate(&along(q, h, &v3), &v4);
        for d in 0..q.len() {
            q[d] += h / 6.0 * (v[d] + 2.0 * v2[d] + 2.0 * v3[d] + v4[d]);
            v[d] += h / 6.0 * (a1[d] + 2.0 * a2[d] + 2.0 * a3[d] + a4[d]);
        }
        return;
    }
    // (H + hD_i) a = H v̇: dampers are all diagonal here, an inertia more.
    let armature: Vec<f64> = (0..model.nv())
        .map(|d| match integrator {
            Integrator::DampedEuler => h * springs.joint_damping[(d, d)],
            Integrator::ImplicitVelocity => h * springs.damping[(d, d)],
            _ => 0.0,
        })
        .zip(model.armature())
        .map(|(more, own)| more + own)
        .collect();
    let heavier = model.clone().with_armature(armature).unwrap();
    let vdot = forward_dynamics(&heavier, q, v, &force(q, v)).unwrap();
    *v = along(v, h, &vdot);
    *q = along(q, h, v);
}

/// How much a push has grown after some steps.
fn growth(model: &Model<f64>, springs: &Impedance, rest: &[f64], integrator: Integrator, h: f64) -> f64 {
    let (mut q, mut v) = (rest.to_vec(), vec![0.0; model.nv()]);
    v.iter_mut().enumerate().for_each(|(d, v)| *v = 1e-9 * (1.0 + 0.3 * d as f64));
    let size = |q: &[f64], v: &[f64]| {
        let away = q.iter().zip(rest).fold(0.0f64, |m, (q, rest)| m.max((q - rest).abs()));
        v.iter().fold(away, |m, v| m.max(h * v.abs()))
    };
    let first = size(&q, &v);
    let mut largest = 0.0f64;
    for _ in 0..800 {
        step(model, springs, rest, integrator, h, (&mut q, &mut v));
        largest = largest.max(size(&q, &v));
        if largest >= 1e-3 || largest.is_nan() {
            break;
        }
    }
    largest / first
}

/// The whole robot, not a linear one, pushed a little where its largest step is least. A free motion drifts by as many pushes as steps.
#[test]
fn ninety_five_percent_of_the_step_is_stable_and_a_hundred_and_five_is_not() {
    let mut tried = 0;
    for model in robots() {
        for (kp, kd) in [(100.0, 1.0), (0.0, 3.0), (500.0, 0.0)] {
            let springs = springs(&model, kp, kd);
            let integrator = Integrator::DampedEuler;
            let found = stepping(&model, Drive { springs: springs.clone(), step: None, integrator });
            let impedance = Impedance::new(&model, Reduction::default(), &springs).unwrap();
            for limit in found.limits.iter().filter(|limit| limit.step.is_finite()) {
                let grown =
                    |part: f64| growth(&model, &impedance, &limit.at, limit.integrator, part * limit.step);
                let (below, above) = (grown(0.95), grown(1.05));
                let what = format!("{} {kp} {kd} {:?} {}", model.name(), limit.integrator, limit.step);
                assert!(below < 2e4 && (above >= 3e4 || above.is_nan()), "{what}: {below} {above}");
                tried += 1;
            }
        }
    }
    assert!(tried >= 36, "{tried}");
}

/// No configuration of many bears much less than what was found.
#[test]
fn the_worst_step_is_the_worst() {
    for model in robots() {
        let springs = springs(&model, 100.0, 1.0);
        let integrator = Integrator::SemiImplicitEuler;
        let found = stepping(&model, Drive { springs: springs.clone(), step: None, integrator });
        let impedance = Impedance::new(&model, Reduction::default(), &springs).unwrap();
        for limit in &found.limits {
            let at = |q: &[f64]| {
                largest_step(&mass_matrix(&model, q).unwrap(), &impedance, limit.integrator).unwrap().step
            };
            assert!((at(&limit.at) / limit.step - 1.0).abs() < 1e-9);
            let domain = eigenbody::search::Domain::new(&model, false);
            let mut random = eigenbody::model::Random::new(7);
            let mut least = f64::INFINITY;
            for _ in 0..2000 {
                let u: Vec<f64> = (0..domain.dimensions()).map(|_| random.uniform()).collect();
                least = least.min(at(&domain.configuration(&domain.point(&u))));
            }
            // Runge-Kutta's is looked for among the worst of the others.
            let slack = if limit.integrator == Integrator::RungeKutta4 { 0.98 } else { 1.0 };
            assert!(
                least >= slack * limit.step,
                "{} {:?} {least} {}",
                model.name(),
                limit.integrator,
                limit.step
            );
            if limit.integrator == Integrator::SemiImplicitEuler {
                let [low, high] = limit.bracket();
                assert!(low <= limit.step * (1.0 + 1e-9) && limit.step <= high * (1.0 + 1e-9));
            }
        }
    }
}

/// The gains that a joint bears alone, and all joints together, put the step at the edge of stability.
#[test]
fn gains_are_those_that_the_step_just_bears() {
    for model in robots() {
        for integrator in [Integrator::SemiImplicitEuler, Integrator::RungeKutta4] {
            let step = 1e-3;
            let found = stepping(&model, Drive { springs: Vec::new(), step: Some(step), integrator });
            let alone = |q: &[f64], kp: &[f64], kd: &[f64]| {
                let H = mass_matrix(&model, q).unwrap();
                largest_step(&H, &Impedance::diagonal(kp, kd).unwrap(), integrator).unwrap().step
            };
            let zero = vec![0.0; model.nv()];
            for (d, joint) in found.joints.iter().enumerate() {
                let only =
                    |gain: f64| (0..model.nv()).map(|e| if e == d { gain } else { 0.0 }).collect::<Vec<_>>();
                let [kp, kd] = joint.bears.unwrap();
                for edge in [alone(&joint.at, &only(kp), &zero), alone(&joint.at, &zero, &only(kd))] {
                    assert!((edge / step - 1.0).abs() < 1e-6, "{} {edge}", joint.joint);
                }
            }
            let [kp, kd] = found.modes[0].bears.unwrap();
            let diagnosis = check(&model, Drive::default());
            let q = &diagnosis.by(eigenbody::search::Measure::LambdaMin).unwrap().spread.at;
            for edge in [alone(q, &vec![kp; model.nv()], &zero), alone(q, &zero, &vec![kd; model.nv()])] {
                assert!((edge / step - 1.0).abs() < 1e-6, "{edge}");
            }
        }
    }
}

#[test]
fn a_step_that_is_too_long_is_a_finding() {
    let model = robots().remove(0);
    let integrator = Integrator::SemiImplicitEuler;
    let drive = |step: Option<f64>| Drive { springs: springs(&model, 100.0, 1.0), step, integrator };
    let limit = stepping(&model, drive(None)).limits[0].step;
    let findings = check(&model, drive(Some(1.01 * limit))).findings;
    assert_eq!(findings.iter().map(|f| f.id).collect::<Vec<_>>(), ["time-step"]);
    assert!((findings[0].limit / limit - 1.0).abs() < 1e-9 && !findings[0].joints.is_empty());
    assert!(check(&model, drive(Some(0.99 * limit))).findings.is_empty());
    assert!(check(&model, Drive::default()).stepping.is_none());
}

#[test]
fn a_spring_that_pushes_is_a_finding() {
    let model = robots().remove(0);
    let mut springs = springs(&model, 100.0, 1.0);
    springs[2].stiffness = -1.0;
    let found = check(&model, Drive { springs, step: Some(1e-3), integrator: Integrator::SemiImplicitEuler });
    assert_eq!((found.findings[0].id, found.findings[0].limit), ("time-step", 0.0));
}

/// The same on one thread as on many.
#[test]
fn threads_make_no_difference() {
    let model = robots().remove(1);
    let drive = || Drive {
        springs: springs(&model, 100.0, 1.0),
        step: Some(1e-3),
        integrator: Integrator::DampedEuler,
    };
    let pool = |threads: usize| rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    assert_eq!(pool(1).install(|| stepping(&model, drive())), pool(3).install(|| stepping(&model, drive())));
}

use crate::robots::plan;
use eigenbody::dynamics::Reduction;
use eigenbody::model::JointSpec;
use eigenbody::scalar::{Dd, Real, Scalar};
use eigenbody::search::{Domain, Evaluator, Measure};
use eigenbody::spatial::{RigidInertia, Sym3, Vec3};
use eigenbody::{Base, Error, Joint, Metric, Model, ModelBuilder, conditioning};

/// The cost in double-double, from the matrix.
fn cost(model: &Model<Dd>, q: &[Dd], reduction: Reduction, (metric, measure): (&Metric<f64>, Measure)) -> Dd {
    let H = reduction.mass_matrix(model, q).unwrap();
    let n = H.rows();
    let own_units = measure == Measure::KappaWeighted || *metric == Metric::UnitDiagonal;
    let weights: Vec<Dd> = if own_units { (0..n).map(|d| H[(d, d)]).collect() } else { vec![Dd::ONE; n] };
    let verdict = conditioning(&H, &weights).unwrap();
    let (min, max) = (verdict.lambda_min.unwrap(), verdict.lambda_max.unwrap());
    if measure == Measure::LambdaMin { min } else { min / max }
}

/// Against central differences in double-double, every joint kind, fixed and free-floating.
#[test]
fn gradients_are_the_rates_of_costs() {
    for seed in 0..24 {
        let base = if seed % 2 == 0 { Base::Fixed } else { Base::Floating };
        let reduction = Reduction { base: base == Base::Floating, mimic: false };
        let links = 2 + seed as usize % 5;
        let model: Model<f64> = plan::<f64>(700 + seed, links).build(base);
        let wide: Model<Dd> = plan::<Dd>(700 + seed, links).build(base);
        if Domain::new(&model, false).dimensions() == 0 {
            continue;
        }
        let q = model.random(seed);
        let metric = if seed % 3 == 0 { Metric::UnitDiagonal } else { Metric::Euclidean };
        let mut evaluator = Evaluator::new(&model, reduction, metric.clone()).unwrap();
        for measure in Measure::ALL {
            let what = (&metric, measure);
            let (value, gradient) = evaluator.cost_gradient(&q, measure).unwrap().unwrap();
            let wide_q: Vec<Dd> = q.iter().map(|&x| Dd::from_f64(x)).collect();
            let exact = cost(&wide, &wide_q, reduction, what).to_f64();
            assert!((value / exact - 1.0).abs() < 1e-9, "seed {seed} {measure:?}: {value} {exact}");
            let size = gradient.iter().fold(exact, |m, g| m.max(g.abs()));
            for d in 0..model.nv() {
                let at = |t: f64| {
                    let mut step = vec![Dd::ZERO; model.nv()];
                    step[d] = Dd::from_f64(t);
                    cost(&wide, &wide.integrate(&wide_q, &step).unwrap(), reduction, what)
                };
                let h = 1e-8;
                let found = ((at(h) - at(-h)) / Dd::from_f64(2.0 * h)).to_f64();
                assert!(
                    (found - gradient[d]).abs() <= 1e-8 * size,
                    "seed {seed} {measure:?} DoF {d}: {} {found}",
                    gradient[d]
                );
            }
        }
    }
}

/// A free-floating motion has no momentum; without inertia of the whole there is none to speak of.
#[test]
fn motions_of_a_floating_base() {
    let reduction = Reduction { base: true, mimic: false };
    for seed in 0..12 {
        let model: Model<f64> = plan::<f64>(900 + seed, 4).build(Base::Floating);
        let x: Vec<f64> = (0..model.nv() - 6).map(|k| 1.0 - 0.3 * k as f64).collect();
        let q = model.random(seed);
        let evaluator = Evaluator::new(&model, reduction, Metric::Euclidean).unwrap();
        let v = evaluator.motion(&q, &x).unwrap();
        let H = eigenbody::mass_matrix(&model, &q).unwrap();
        let momentum = H.times(&v);
        // 200 ε κ(H_bb) at most; κ is below 1e3 on these
        let largest = momentum.iter().chain(&v).fold(H.max_abs(), |m, x| m.max(x.abs()));
        assert!(momentum[..6].iter().all(|p| p.abs() <= 2e5 * f64::EPSILON * largest), "{seed} {momentum:?}");
    }
    let mut builder = ModelBuilder::new("point");
    let point = RigidInertia::from_com(1.0, Vec3::ZERO, Sym3::ZERO);
    let [base, tip] = [builder.link("base", point), builder.frame("tip")];
    builder.joint(JointSpec::new("turn", Joint::Revolute, base, tip));
    let model: Model<f64> = builder.build(Base::Floating).unwrap();
    let evaluator = Evaluator::new(&model, reduction, Metric::Euclidean).unwrap();
    let error = evaluator.motion(&model.neutral(), &[1.0]).unwrap_err();
    assert!(matches!(error, Error::NotPositiveDefinite(_)), "{error}");
}

//! Proof that what promises not to allocate does not: an allocator that counts.

use crate::robots::{Case, plan};
use allocation_counter::measure;
use eigenbody::batch::Batch;
use eigenbody::dynamics::{
    AbaWorkspace, CrbaWorkspace, Denoc, FloatingWorkspace, MomentumWorkspace, RneaWorkspace, Udu,
    bias_force_into, energy_into, floating_mass_matrix_into, forward_dynamics_into, gravity_force_into,
    inverse_dynamics_into, link_pose, mass_matrix_into, mass_matrix_upper_into, momentum_into,
};
use eigenbody::factor::{
    CoupledWorkspace, Ltdl, Ltl, coupled_bias_force_into, coupled_forward_dynamics_into,
    coupled_inverse_dynamics_into,
};
use eigenbody::scalar::{Dd, Real};
use eigenbody::spectrum::{EndsAtWorkspace, Metric, extreme_eigenvalues_at};
use eigenbody::{Base, Family, Matrix, Method, Model, Posture, Question, conditioning_at};
use std::collections::BTreeSet;

/// Fixed and floating robots whose joints are, together, of every kind.
fn robots<T: Real>() -> Vec<Case<T>> {
    let auto = Family::auto_tree(16, 1.5, 0.3, 0.9).unwrap();
    let models: Vec<Model<T>> = vec![
        auto.model().unwrap(),
        auto.floating().model().unwrap(),
        plan(5, 30).build(Base::Fixed),
        plan(5, 30).build(Base::Floating),
    ];
    let kinds: BTreeSet<&str> = models.iter().flat_map(Model::joints).map(|j| j.kind().kind()).collect();
    assert_eq!(kinds.len(), 9, "{kinds:?}");
    models.into_iter().map(|model| Case::new(String::new(), model, 3)).collect()
}

#[track_caller]
fn assert_none(what: &str, run: impl FnOnce()) {
    let counted = measure(run);
    assert_eq!((counted.count_total, counted.bytes_total), (0, 0), "{what} allocates");
}

fn dynamics_allocate_nothing<T: Real>() {
    for Case { model, q, v, vdot, .. } in robots::<T>() {
        let nv = model.nv();
        let mut out = vec![T::ZERO; nv];
        let mut H = Matrix::zeros(nv, nv);

        let mut rnea = RneaWorkspace::new(&model);
        assert_none("RNEA", || inverse_dynamics_into(&model, &q, &v, &vdot, &mut rnea, &mut out).unwrap());
        assert_none("bias force", || bias_force_into(&model, &q, &v, &mut rnea, &mut out).unwrap());
        assert_none("gravity force", || gravity_force_into(&model, &q, &mut rnea, &mut out).unwrap());

        let mut aba = AbaWorkspace::new(&model);
        assert_none("ABA", || forward_dynamics_into(&model, &q, &v, &vdot, &mut aba, &mut out).unwrap());

        let mut crba = CrbaWorkspace::new(&model);
        assert_none("CRBA", || mass_matrix_into(&model, &q, &mut crba, &mut H).unwrap());
        assert_none("upper CRBA", || mass_matrix_upper_into(&model, &q, &mut crba, &mut H).unwrap());
        let mut ends = EndsAtWorkspace::new(&model, &Metric::Euclidean).unwrap();
        assert_none("ends", || {
            extreme_eigenvalues_at(&model, &q, &mut ends).unwrap();
        });
        let mut denoc = Denoc::new(&model);
        assert_none("DeNOC", || denoc.update(&q).unwrap());
        assert_none("DeNOC matrix", || denoc.mass_matrix_into(&mut H).unwrap());
        let mut udu = Udu::new(&denoc);
        assert_none("UDUᵀ factor", || udu.factor(&denoc).unwrap());
        assert_none("UDUᵀ solve", || udu.solve(&denoc, &mut out).unwrap());

        if model.has_floating_base() {
            let (mut reduced, mut room) =
                (Matrix::zeros(nv - 6, nv - 6), FloatingWorkspace::new(&model).unwrap());
            assert_none("H*", || floating_mass_matrix_into(&model, &q, &mut room, &mut reduced).unwrap());
        }

        let mut sweep = MomentumWorkspace::new(&model);
        assert_none("momentum", || _ = momentum_into(&model, &q, &v, &mut sweep).unwrap());
        assert_none("energy", || _ = energy_into(&model, &q, &v, &mut sweep).unwrap());
        assert_none("pose", || _ = link_pose(&model, &q, model.links().len() - 1).unwrap());
    }
}

/// From the family to κ, κ′ and both modes: what only kernels use is not made.
#[test]
fn a_spectrum_by_counts_takes_less_than_a_kilobyte_a_body() {
    let n = 20_000;
    let counted = measure(|| {
        let model: Model<f64> = Family::hydra(n, 1.0, 0.0, 1.0).unwrap().model().unwrap();
        let q = Posture::Zag(0.0).configuration(&model);
        let question = Question { method: Method::Sturm, ..Question::default() };
        assert!(conditioning_at(&model, &q, &question).unwrap().kappa.is_some());
    });
    let a_body = counted.bytes_max / n as u64;
    assert!((600..1000).contains(&a_body), "{a_body} bytes a body");
}

/// The second call of a batch finds what the first one left; a thread alone counts.
#[test]
fn batches_allocate_once() {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    for Case { model, .. } in robots::<f64>() {
        let (nv, count) = (model.nv(), 21);
        let q: Vec<f64> = (0..count).flat_map(|seed| model.random(seed)).collect();
        let x = vec![0.5; 21 * nv];
        let (mut H, mut out) = (vec![0.0; 21 * nv * nv], vec![0.0; 21 * nv]);
        let batch = Batch::new(&model);
        let entries = 21 * batch.entries().len();
        let mut all = || {
            batch.mass_matrices(&q, &mut H).unwrap();
            batch.mass_matrix_entries(&q, &mut H[..entries]).unwrap();
            batch.inverse_dynamics(&q, &x, &x, &mut out).unwrap();
            batch.forward_dynamics(&q, &x, &x, &mut out).unwrap();
        };
        pool.install(|| {
            all();
            assert_none("a batch", all);
        });
    }
}

#[test]
fn coupled_dynamics_allocate_nothing() {
    let model = crate::factor::coupled::hand(Base::Floating);
    let coupling = model.coupling().unwrap();
    let mut room = CoupledWorkspace::new(&model, coupling).unwrap();
    let (q, rate) = (coupling.expand(&coupling_start(&model)), vec![0.3; coupling.nv()]);
    let mut out = vec![0.0; coupling.nv()];
    assert_none("coupled RNEA", || {
        coupled_inverse_dynamics_into(&model, coupling, &q, &rate, &rate, &mut room, &mut out).unwrap();
    });
    assert_none("coupled bias force", || {
        coupled_bias_force_into(&model, coupling, &q, &rate, &mut room, &mut out).unwrap();
    });
    assert_none("coupled forward dynamics", || {
        coupled_forward_dynamics_into(&model, coupling, &q, &rate, &rate, &mut room, &mut out).unwrap();
    });
}

/// The independent coordinates of a random configuration.
fn coupling_start(model: &Model<f64>) -> Vec<f64> {
    let q = model.random(4);
    model.coupling().unwrap().independent_coordinates().iter().map(|&k| q[k]).collect()
}

fn factors_allocate_nothing<T: Real>() {
    for Case { model, q, v, .. } in robots::<T>() {
        let nv = model.nv();
        let H = eigenbody::mass_matrix(&model, &q).unwrap();
        let mut out = Matrix::zeros(nv, nv);
        let mut x = v;

        let mut ltl = Ltl::new(model.dofs());
        assert_none("LTL factor", || _ = ltl.factor(&H).unwrap());
        assert_none("LTL solve", || ltl.solve(&mut x).unwrap());
        assert_none("LTL inverse", || ltl.inverse_into(&mut out).unwrap());
        assert_none("LTL reconstruct", || ltl.reconstruct_into(&mut out).unwrap());

        let mut ltdl = Ltdl::new(model.dofs());
        assert_none("LTDL factor", || _ = ltdl.factor(&H).unwrap());
        assert_none("LTDL solve", || ltdl.solve(&mut x).unwrap());
        assert_none("LTDL inverse", || ltdl.inverse_into(&mut out).unwrap());
        assert_none("LTDL reconstruct", || ltdl.reconstruct_into(&mut out).unwrap());
    }
}

scalars!(dynamics_allocate_nothing, factors_allocate_nothing);

/// The counter counts: the allocating doors are seen.
#[test]
fn counter_sees_an_allocation() {
    let Case { model, q, .. } = &robots::<Dd>()[0];
    let counted = measure(|| _ = eigenbody::mass_matrix(model, q).unwrap());
    assert!(counted.count_total > 0);
}

//! The three dynamics kernels without allocation, on an arm, a chain and a tree with every kind of joint.

#![allow(clippy::unwrap_used, missing_docs, non_snake_case)]

use criterion::{Criterion, criterion_group, criterion_main};
use eigenbody::dynamics::{
    AbaWorkspace, CrbaWorkspace, RneaWorkspace, forward_dynamics_into, inverse_dynamics_into,
    mass_matrix_into,
};
use eigenbody::family::puma560;
use eigenbody::model::Random;
use eigenbody::{Family, Matrix, Model};

fn robots() -> [(&'static str, Model<f64>); 3] {
    let built = |family: Family| family.model().unwrap();
    [
        ("puma560", puma560().unwrap()),
        ("hydra30", built(Family::hydra(30, 1.0, 0.0, 1.0).unwrap())),
        ("auto_tree30", built(Family::auto_tree(30, 2.0, 0.5, 1.0).unwrap())),
    ]
}

/// Numbers in [−1, 1).
fn numbers(count: usize, seed: u64) -> Vec<f64> {
    let mut random = Random::new(seed);
    (0..count).map(|_| random.between(-1.0, 1.0)).collect()
}

fn dynamics(c: &mut Criterion) {
    for (name, model) in robots() {
        let q = model.random(1);
        let (v, last) = (numbers(model.nv(), 2), numbers(model.nv(), 3));
        let mut out = vec![0.0; model.nv()];

        let mut workspace = CrbaWorkspace::new(&model);
        let mut H = Matrix::zeros(model.nv(), model.nv());
        c.bench_function(&format!("mass_matrix/{name}"), |b| {
            b.iter(|| mass_matrix_into(&model, &q, &mut workspace, &mut H));
        });
        let mut workspace = RneaWorkspace::new(&model);
        c.bench_function(&format!("inverse_dynamics/{name}"), |b| {
            b.iter(|| inverse_dynamics_into(&model, &q, &v, &last, &mut workspace, &mut out));
        });
        let mut workspace = AbaWorkspace::new(&model);
        c.bench_function(&format!("forward_dynamics/{name}"), |b| {
            b.iter(|| forward_dynamics_into(&model, &q, &v, &last, &mut workspace, &mut out));
        });
    }
}

criterion_group!(benches, dynamics);
criterion_main!(benches);

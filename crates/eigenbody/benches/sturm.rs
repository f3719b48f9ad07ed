//! The O(N) engine: one counting sweep, both extremes from a cold start, all eigenvalues.
//!
//! `cargo bench --bench sturm`; throughput counts bodies, so that 1/throughput is the time a body.

#![allow(clippy::unwrap_used, missing_docs)]

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use eigenbody::spectrum::sturm::{Pencil, counts};
use eigenbody::spectrum::{Precision, extremes, slice};
use eigenbody::{Family, Model, Posture};
use std::cell::LazyCell;
use std::hint::black_box;

/// A robot at zag(0).
struct Robot {
    model: Model<f64>,
    q: Vec<f64>,
}

impl Robot {
    fn new(n: usize, branching: f64, skew: f64) -> Self {
        let model: Model<f64> = Family::hydra(n, branching, skew, 1.0).unwrap().model().unwrap();
        let q = Posture::Zag(0.0).configuration(&model);
        Self { model, q }
    }

    fn pencil(&self) -> Pencil<'_, f64> {
        Pencil::euclidean(&self.model, &self.q, false).unwrap()
    }
}

/// Eight shifts from far below the spectrum to its middle.
const SHIFTS: [f64; 8] = [1e-3, 1e-2, 0.1, 1.0, 10.0, 1e2, 1e3, 1e4];

/// One sweep with eight shifts.
fn sweep(c: &mut Criterion) {
    let mut group = c.benchmark_group("sweep");
    for (name, branching, skew) in [("chain", 1.0, 0.0), ("tree", 2.0, 0.5)] {
        for n in [100, 10_000, 1_000_000] {
            let robot = LazyCell::new(|| Robot::new(n, branching, skew));
            let pencil = LazyCell::new(|| robot.pencil());
            group.throughput(Throughput::Elements(n as u64)).sample_size(20);
            group.bench_function(BenchmarkId::new(name, n), |b| {
                let pencil = &*pencil;
                b.iter(|| counts(pencil, black_box(SHIFTS)));
            });
        }
    }
}

/// λmin and λmax with their modes, from model and q.
fn both_extremes(c: &mut Criterion) {
    let mut group = c.benchmark_group("extremes");
    for n in [10, 100, 1000, 10_000, 100_000] {
        let robot = LazyCell::new(|| Robot::new(n, 1.0, 0.0));
        group.throughput(Throughput::Elements(n as u64)).sample_size(10);
        group.bench_function(BenchmarkId::from_parameter(n), |b| {
            let robot = &*robot;
            b.iter(|| extremes(&robot.pencil(), Precision::Auto).unwrap());
        });
    }
}

/// All eigenvalues.
fn all_eigenvalues(c: &mut Criterion) {
    let mut group = c.benchmark_group("slice");
    for n in [100, 1000] {
        let robot = LazyCell::new(|| Robot::new(n, 1.0, 0.0));
        let pencil = LazyCell::new(|| robot.pencil());
        group.throughput(Throughput::Elements(n as u64)).sample_size(10);
        group.bench_function(BenchmarkId::from_parameter(n), |b| {
            let pencil = &*pencil;
            b.iter(|| slice(pencil));
        });
    }
}

criterion_group!(benches, sweep, both_extremes, all_eigenvalues);
criterion_main!(benches);

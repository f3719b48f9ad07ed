//! Instructions executed, counted by Valgrind: the same on every run, so that a regression shows.
//!
//! Needs valgrind and `gungraun-runner`; `cargo xtask bench` brings the runner and runs this. Fails where a count exceeds its
//! limit, about a tenth above what it was when the limit was set (x86-64 with AVX2: Valgrind has no wider unit), or is more
//! than a fiftieth above that of the run before. A change that means to cost more raises the limit and says why.

#![allow(clippy::unwrap_used, missing_docs)]

use eigenbody::spectrum::sturm::{Count, Pencil, counts};
use eigenbody::spectrum::{Extremes, Precision, extremes};
use eigenbody::{Family, Model, Posture};
use gungraun::{
    Callgrind, EventKind, LibraryBenchmarkConfig, library_benchmark, library_benchmark_group, main,
};
use std::hint::black_box;

/// hydra(N, B, α, 1) at zag(0).
fn robot(n: usize, branching: f64, skew: f64) -> (Model<f64>, Vec<f64>) {
    let model: Model<f64> = Family::hydra(n, branching, skew, 1.0).unwrap().model().unwrap();
    let q = Posture::Zag(0.0).configuration(&model);
    (model, q)
}

fn pencil(n: usize, branching: f64, skew: f64) -> Pencil<f64> {
    let (model, q) = robot(n, branching, skew);
    Pencil::new(&model, &q, vec![1.0; n]).unwrap()
}

const SHIFTS: [f64; 8] = [1e-3, 1e-2, 0.1, 1.0, 10.0, 1e2, 1e3, 1e4];

fn at_most(instructions: u64) -> LibraryBenchmarkConfig {
    let mut callgrind = Callgrind::default();
    callgrind.hard_limits([(EventKind::Ir, instructions)]).soft_limits([(EventKind::Ir, 2.0)]);
    LibraryBenchmarkConfig::default().tool(callgrind).clone()
}

// One sweep of eight shifts over 1000 bodies.
#[library_benchmark]
#[bench::chain(args = (1000, 1.0, 0.0), setup = pencil, config = at_most(860_000))]
#[bench::tree(args = (1000, 2.0, 0.5), setup = pencil, config = at_most(1_480_000))]
fn sweep(pencil: Pencil<f64>) -> [Count; 8] {
    counts(&pencil, black_box(SHIFTS))
}

// Both extremes with modes, from model and q.
#[library_benchmark]
#[bench::chain(args = (100, 1.0, 0.0), setup = robot, config = at_most(1_640_000))]
#[bench::tree(args = (100, 2.0, 0.5), setup = robot, config = at_most(2_760_000))]
fn cold((model, q): (Model<f64>, Vec<f64>)) -> Extremes {
    let pencil = Pencil::new(&model, &q, vec![1.0; model.nv()]).unwrap();
    extremes(&model, &q, &pencil, Precision::Auto).unwrap()
}

library_benchmark_group!(name = engine, benchmarks = [sweep, cold]);
main!(library_benchmark_groups = engine);

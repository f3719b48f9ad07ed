//! Instructions executed, counted by Valgrind: the same on every run, so that a regression shows.
//!
//! Needs valgrind and `gungraun-runner`; `cargo xtask bench` brings the runner and runs this. Fails where a count exceeds its
//! limit, about a tenth above what it was when the limit was set (x86-64 with AVX2: Valgrind has no wider unit), or is more
//! than a fiftieth above that of the run before. A change that means to cost more raises the limit and says why.

#![allow(clippy::unwrap_used, missing_docs, non_snake_case)]

use eigenbody::batch::Batch;
use eigenbody::dynamics::{
    AbaWorkspace, CrbaWorkspace, RneaWorkspace, forward_dynamics_into, inverse_dynamics_into,
    mass_matrix_into,
};
use eigenbody::family::puma560;
use eigenbody::model::JointSpec;
use eigenbody::spatial::{Mat3, RigidInertia, Sym3, Transform, Vec3};
use eigenbody::spectrum::sturm::{Count, Pencil, counts};
use eigenbody::spectrum::{
    EndsAtWorkspace, EndsWorkspace, Extremes, Metric, Precision, extreme_eigenvalues_at,
    extreme_eigenvalues_into, extremes,
};
use eigenbody::{Base, Family, Joint, Matrix, Model, ModelBuilder, Posture};
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

fn pencil(n: usize, branching: f64, skew: f64) -> Pencil<'static, f64> {
    let (model, q) = robot(n, branching, skew);
    Pencil::euclidean(Box::leak(Box::new(model)), &q, false).unwrap()
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
fn sweep(pencil: Pencil<'static, f64>) -> [Count; 8] {
    counts(&pencil, black_box(SHIFTS))
}

// Both extremes with modes, from model and q.
#[library_benchmark]
#[bench::chain(args = (100, 1.0, 0.0), setup = robot, config = at_most(1_640_000))]
#[bench::tree(args = (100, 2.0, 0.5), setup = robot, config = at_most(2_760_000))]
fn cold((model, q): (Model<f64>, Vec<f64>)) -> Extremes {
    extremes(&Pencil::euclidean(&model, &q, false).unwrap(), Precision::Auto).unwrap()
}

/// A robot with a state and everything that a kernel asks for.
struct Bench {
    model: Model<f64>,
    q: Vec<f64>,
    v: Vec<f64>,
    out: Vec<f64>,
    H: Matrix<f64>,
    rnea: RneaWorkspace<f64>,
    crba: CrbaWorkspace<f64>,
    aba: AbaWorkspace<f64>,
    ends: EndsWorkspace<f64>,
}

fn bench(model: Model<f64>) -> Bench {
    let (q, nv) = (model.random(1), model.nv());
    let numbers = |seed: f64| (0..nv).map(|d| (seed + d as f64).sin()).collect::<Vec<f64>>();
    Bench {
        q,
        v: numbers(1.0),
        out: numbers(2.0),
        H: Matrix::zeros(nv, nv),
        rnea: RneaWorkspace::new(&model),
        crba: CrbaWorkspace::new(&model),
        aba: AbaWorkspace::new(&model),
        ends: EndsWorkspace::new(nv),
        model,
    }
}

/// PUMA 560: a serial arm of six.
fn arm() -> Bench {
    bench(puma560().unwrap())
}

/// Four limbs of seven hinges, axes in turn along x, y and z, on a free torso.
fn humanoid() -> Bench {
    let mut robot = ModelBuilder::new("humanoid");
    let rod = RigidInertia::from_com(1.0, Vec3::new(0.0, 0.01, 0.1), Sym3::diagonal(0.02, 0.02, 0.01));
    let torso = robot.link("torso", rod);
    for limb in 0..4 {
        let mut parent = torso;
        for k in 0..7 {
            let link = robot.link(format!("link{limb}{k}"), rod);
            let axis = [Vec3::X, Vec3::Y, Vec3::Z][k % 3];
            let placement = Transform::new(Mat3::IDENTITY, Vec3::new(0.02, 0.0, 0.2));
            let joint = JointSpec::new(format!("joint{limb}{k}"), Joint::Revolute, parent, link);
            robot.joint(joint.at(placement).about(axis));
            parent = link;
        }
    }
    bench(robot.build(Base::Floating).unwrap())
}

/// Every kind of joint on a free base.
fn tree() -> Bench {
    bench(Family::auto_tree(30, 2.0, 0.5, 1.0).unwrap().floating().model().unwrap())
}

// τ, one state.
#[library_benchmark]
#[bench::arm(setup = arm, config = at_most(INVERSE[0]))]
#[bench::humanoid(setup = humanoid, config = at_most(INVERSE[1]))]
#[bench::tree(setup = tree, config = at_most(INVERSE[2]))]
fn inverse(mut b: Bench) -> Bench {
    let given = b.out.clone();
    inverse_dynamics_into(&b.model, black_box(&b.q), &b.v, &given, &mut b.rnea, &mut b.out).unwrap();
    b
}

// v̇, one state.
#[library_benchmark]
#[bench::arm(setup = arm, config = at_most(FORWARD[0]))]
#[bench::humanoid(setup = humanoid, config = at_most(FORWARD[1]))]
#[bench::tree(setup = tree, config = at_most(FORWARD[2]))]
fn forward(mut b: Bench) -> Bench {
    let given = b.out.clone();
    forward_dynamics_into(&b.model, black_box(&b.q), &b.v, &given, &mut b.aba, &mut b.out).unwrap();
    b
}

// H, one configuration.
#[library_benchmark]
#[bench::arm(setup = arm, config = at_most(MASS[0]))]
#[bench::humanoid(setup = humanoid, config = at_most(MASS[1]))]
#[bench::tree(setup = tree, config = at_most(MASS[2]))]
fn mass(mut b: Bench) -> Bench {
    mass_matrix_into(&b.model, black_box(&b.q), &mut b.crba, &mut b.H).unwrap();
    b
}

// H and both ends of its spectrum.
#[library_benchmark]
#[bench::arm(setup = arm, config = at_most(ENDS[0]))]
#[bench::humanoid(setup = humanoid, config = at_most(ENDS[1]))]
#[bench::tree(setup = tree, config = at_most(ENDS[2]))]
fn ends(mut b: Bench) -> Bench {
    mass_matrix_into(&b.model, black_box(&b.q), &mut b.crba, &mut b.H).unwrap();
    black_box(extreme_eigenvalues_into(&b.H, &vec![1.0; b.model.nv()], &mut b.ends).unwrap());
    b
}

// Both ends alone.
#[library_benchmark]
#[bench::arm(setup = arm_alone, config = at_most(AT[0]))]
#[bench::humanoid(setup = humanoid_alone, config = at_most(AT[1]))]
fn at((b, mut room): (Bench, EndsAtWorkspace<f64>)) -> Bench {
    black_box(extreme_eigenvalues_at(&b.model, black_box(&b.q), &mut room).unwrap());
    b
}

fn alone(b: Bench) -> (Bench, EndsAtWorkspace<f64>) {
    let room = EndsAtWorkspace::new(&b.model, &Metric::Euclidean).unwrap();
    (b, room)
}

fn arm_alone() -> (Bench, EndsAtWorkspace<f64>) {
    alone(arm())
}

fn humanoid_alone() -> (Bench, EndsAtWorkspace<f64>) {
    alone(humanoid())
}

// Sixty-four states, one thread: H and v̇ in lanes.
#[library_benchmark]
#[bench::arm(setup = arm, config = at_most(BATCH))]
fn batch(b: Bench) -> (Vec<f64>, Vec<f64>) {
    let (nq, nv, count) = (b.model.nq(), b.model.nv(), 64);
    let (q, v) = (b.q.repeat(count), b.v.repeat(count));
    let (mut H, mut vdot) = (vec![0.0; count * nv * nv], vec![0.0; count * nv]);
    Batch::new(&b.model).mass_matrices(black_box(&q[..count * nq]), &mut H).unwrap();
    Batch::new(&b.model).forward_dynamics(&q, &v, &v, &mut vdot).unwrap();
    (H, vdot)
}

// Limits of the kernels: arm, humanoid, tree.
const INVERSE: [u64; 3] = [3_290, 12_450, 30_800];
const FORWARD: [u64; 3] = [4_990, 21_550, 64_600];
const MASS: [u64; 3] = [3_020, 23_000, 110_600];
const ENDS: [u64; 3] = [8_920, 97_000, 460_000];
const AT: [u64; 2] = [9_900, 85_200];
const BATCH: u64 = 254_700;

library_benchmark_group!(name = engine, benchmarks = [sweep, cold]);
library_benchmark_group!(name = kernels, benchmarks = [inverse, forward, mass, ends, at, batch]);
main!(library_benchmark_groups = engine, kernels);

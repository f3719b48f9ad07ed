//! The spectral engine beside dense eigensolvers, on chains and trees.

use std::error::Error;
use std::hint::black_box;

use eigenbody::spectrum::sturm::{Pencil, counts};
use eigenbody::spectrum::{Extremes, Precision, extremes, slice};
use eigenbody::{Family, Matrix, Method, Model, Posture, Question, conditioning_at, mass_matrix};

use crate::Outcome;
use crate::clock::Clock;

/// Robots on which both extremes are compared.
const LARGE: [usize; 2] = [1000, 2000];
/// Robots on which the methods of `conditioning_at` are compared.
const SMALL: [usize; 12] = [6, 8, 12, 16, 20, 24, 28, 32, 40, 48, 56, 64];
/// Robots over which a sweep is timed.
const SWEPT: [usize; 4] = [100, 1000, 10_000, 1_000_000];
/// Of hydra(1000, 1, 0, 1) at zag(0), in arithmetic of many digits.
const EXACT: [f64; 2] = [0.021_146_039_167_710_28, 81_052_547_734.423_97];

/// hydra(N, B, α, 1) at zag(0).
struct Robot {
    model: Model<f64>,
    q: Vec<f64>,
}

impl Robot {
    fn new(n: usize, branching: f64, skew: f64) -> Result<Self, Box<dyn Error>> {
        let model: Model<f64> = Family::hydra(n, branching, skew, 1.0)?.model()?;
        let q = Posture::Zag(0.0).configuration(&model);
        Ok(Self { model, q })
    }

    fn pencil(&self) -> Pencil<'_, f64> {
        Pencil::new(&self.model, &self.q, vec![1.0; self.model.nv()]).expect("q fits")
    }

    fn extremes(&self) -> Extremes {
        extremes(&self.pencil(), Precision::Auto).expect("the pencil fits")
    }

    fn mass_matrix(&self) -> Matrix<f64> {
        mass_matrix(&self.model, &self.q).expect("q fits")
    }
}

/// Writes H of hydra(N, 1, 0, 1) at zag(0) to `DIR/N.f64`, row by row.
pub fn matrices(directory: &str) -> Outcome {
    std::fs::create_dir_all(directory)?;
    for n in LARGE {
        let H = Robot::new(n, 1.0, 0.0)?.mass_matrix();
        let bytes: Vec<u8> = (0..n).flat_map(|i| H.row(i).iter().flat_map(|x| x.to_le_bytes())).collect();
        std::fs::write(format!("{directory}/{n}.f64"), bytes)?;
    }
    Ok(())
}

/// Times everything, one line a measurement.
pub fn time() -> Outcome {
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build()?;
    let large = LARGE.map(|n| Robot::new(n, 1.0, 0.0)).into_iter().collect::<Result<Vec<_>, _>>()?;
    let small = SMALL.map(|n| Robot::new(n, 1.0, 0.0)).into_iter().collect::<Result<Vec<_>, _>>()?;
    let first = &large[0];
    let dense = dense(&first.mass_matrix());

    let ends = first.extremes();
    let found = [ends.min.map_err(|_| "λmin is not resolved")?.value, ends.max.value];
    for (name, found, exact) in [("min", found[0], EXACT[0]), ("max", found[1], EXACT[1])] {
        println!("error {name} eigenbody\t{:e}", (found / exact - 1.0).abs());
    }
    println!("passes\t{}", ends.passes);
    onion_errors()?;

    let pencil = first.pencil();
    let mut pencils = Vec::new();
    for (name, branching, skew) in [("chain", 1.0, 0.0), ("tree", 2.0, 0.5)] {
        for n in SWEPT {
            pencils.push((format!("sweep {name} {n}"), Robot::new(n, branching, skew)?));
        }
    }
    let pencils: Vec<_> = pencils.iter().map(|(name, robot)| (name.clone(), robot.pencil())).collect();

    let mut clock = Clock::default();
    for (n, robot) in LARGE.iter().zip(&large) {
        clock.add(format!("extremes {n}"), || black_box(robot.extremes()).passes);
        clock.add(format!("crba {n}"), || black_box(robot.mass_matrix()).rows());
    }
    clock.add("slice 1000".into(), || black_box(slice(&pencil)).len());
    clock.add("slice 1000 one thread".into(), || one.install(|| black_box(slice(&pencil)).len()));
    clock.add("faer 1000".into(), || faer_eigenvalues(&dense, faer::Par::rayon(0)).len());
    clock.add("faer 1000 one thread".into(), || faer_eigenvalues(&dense, faer::Par::Seq).len());
    for robot in &small {
        for (name, method) in [("dense", Method::Dense), ("sturm", Method::Sturm)] {
            clock.add(format!("{name} {}", robot.q.len()), move || {
                let question = Question { method, ..Question::default() };
                black_box(conditioning_at(&robot.model, &robot.q, &question)).is_ok().into()
            });
        }
    }
    for (name, pencil) in &pencils {
        let shifts = [1e-3, 1e-2, 0.1, 1.0, 10.0, 1e2, 1e3, 1e4];
        clock.add(name.clone(), move || counts(pencil, black_box(shifts))[0].below);
    }
    clock.run();
    Ok(())
}

/// Worst relative error over all eigenvalues of onion(1000, 1, 0, 1) at zero: 1/(4 sin²((2k − 1)π/(4N + 2))).
fn onion_errors() -> Outcome {
    let n = 1000;
    let model: Model<f64> = Family::onion(n, 1.0, 0.0, 1.0)?.model()?;
    let q = vec![0.0; n];
    let exact = |index: usize| {
        let angle = (2 * (n - index) - 1) as f64 * std::f64::consts::PI / (4 * n + 2) as f64;
        0.25 / angle.sin().powi(2)
    };
    let worst = |values: &[f64]| {
        let error = |(index, value): (usize, &f64)| (value / exact(index) - 1.0).abs();
        values.iter().enumerate().map(error).fold(0.0, f64::max)
    };
    let sliced = slice(&Pencil::new(&model, &q, vec![1.0; n])?);
    println!("error all eigenbody\t{:e}", worst(&sliced));
    let solved = faer_eigenvalues(&dense(&mass_matrix(&model, &q)?), faer::Par::Seq);
    println!("error all faer\t{:e}", worst(&solved));
    Ok(())
}

/// For faer.
pub fn dense(H: &Matrix<f64>) -> faer::Mat<f64> {
    faer::Mat::from_fn(H.rows(), H.cols(), |i, j| H[(i, j)])
}

/// By faer, ascending.
pub fn faer_eigenvalues(H: &faer::Mat<f64>, threads: faer::Par) -> Vec<f64> {
    faer::set_global_parallelism(threads);
    H.self_adjoint_eigenvalues(faer::Side::Lower).expect("the iteration converges")
}

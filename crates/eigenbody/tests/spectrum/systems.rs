//! Pencils (H, B) over robots of every joint kind, with the eigenvalues of the very numbers of the model: dense, in double-double.

use crate::robots::{Case, cases};
use eigenbody::factor::Ltl;
use eigenbody::model::{DofTree, Random};
use eigenbody::scalar::{Dd, Scalar};
use eigenbody::spatial::Vec3;
use eigenbody::spectrum::sturm::Pencil;
use eigenbody::spectrum::{SymmetricEigen, eigen, eigenvalues};
use eigenbody::{Matrix, Metric, Model, inverse_dynamics};

/// A robot in a configuration, as it is or free-floating.
pub struct System {
    pub name: String,
    pub model: Model<f64>,
    pub q: Vec<f64>,
    pub is_free: bool,
}

impl System {
    pub fn new(name: impl Into<String>, model: Model<f64>, q: Vec<f64>, is_free: bool) -> Self {
        Self { name: name.into(), model, q, is_free }
    }

    /// The pencil in the Euclidean metric.
    pub fn pencil(&self) -> Pencil<'_, f64> {
        Pencil::euclidean(&self.model, &self.q, self.is_free).unwrap()
    }

    /// H or H* of the same numbers in double-double, column by column from the motion of every body.
    ///
    /// Composite inertias would not do: a rotation matrix of f64 is orthogonal to ε only, and what they then take for H is H in
    /// entries off by ε, its λmin by ε·κ′. H = Σ JᵀIJ of the very numbers is what counts and energies see.
    pub fn matrix(&self) -> Matrix<Dd> {
        let H = self.full_matrix();
        if self.is_free { without_base(H) } else { H }
    }

    /// H with all its DoFs.
    pub fn full_matrix(&self) -> Matrix<Dd> {
        let model = self.model.cast::<Dd>().with_gravity(Vec3::ZERO).unwrap();
        let (n, q) = (model.nv(), self.wide_q());
        let mut unit = vec![Dd::ZERO; n];
        let mut H = Matrix::zeros(n, n);
        for d in 0..n {
            unit[d] = Dd::ONE;
            let column = inverse_dynamics(&model, &q, &vec![Dd::ZERO; n], &unit).unwrap();
            H.row_mut(d).copy_from_slice(&column);
            unit[d] = Dd::ZERO;
        }
        H
    }

    pub fn wide_q(&self) -> Vec<Dd> {
        self.q.iter().copied().map(Dd::from_f64).collect()
    }

    /// The pencil in a metric.
    pub fn pencil_in(&self, metric: &Metric<f64>) -> Pencil<'_, f64> {
        let pencil = self.pencil();
        let B = metric.weights_for(&pencil.diagonal(), |d| self.model.is_translation(d)).unwrap();
        pencil.with_metric(B).unwrap()
    }
}

/// Eigenvalues of H in the metric of a pencil, ascending.
pub fn exact(H: &Matrix<Dd>, pencil: &Pencil<'_, f64>) -> Vec<Dd> {
    let B: Vec<Dd> = pencil.metric().iter().filter(|&&b| b > 0.0).map(|&b| Dd::from_f64(b)).collect();
    eigenvalues(H, &B).unwrap()
}

/// Random trees and auto_tree, up to `largest` links: fixed, floating, and the floating ones free.
pub fn systems(largest: usize) -> Vec<System> {
    let mut systems = Vec::new();
    for Case { name, model, q, .. } in cases::<f64>(largest) {
        if model.has_floating_base() && model.nv() > 6 {
            systems.push(System::new(format!("{name}, free"), model.clone(), q.clone(), true));
        }
        if model.nv() > 0 {
            systems.push(System::new(name, model, q, false));
        }
    }
    systems
}

/// Euclidean, unit-diagonal, length, and arbitrary weights over four decades.
pub fn metrics(nv: usize) -> [Metric<f64>; 4] {
    let mut random = Random::new(nv as u64);
    let weights = (0..nv).map(|_| 10f64.powf(random.between(-2.0, 2.0))).collect();
    [Metric::Euclidean, Metric::UnitDiagonal, Metric::Length(0.3), Metric::Diagonal(weights)]
}

/// Schur's complement of the first six rows, one by one.
fn without_base(mut H: Matrix<Dd>) -> Matrix<Dd> {
    let n = H.rows();
    for k in 0..6 {
        for i in k + 1..n {
            let ratio = H[(i, k)] / H[(k, k)];
            for j in k + 1..n {
                let product = ratio * H[(k, j)];
                H[(i, j)] -= product;
            }
        }
    }
    Matrix::from_fn(n - 6, n - 6, |i, j| H[(i + 6, j + 6)])
}

/// Eigenvalues and modes over all DoFs: a removed base moves so that momentum stays zero, H_bb x_b = −H_bj x_j.
pub fn exact_modes(system: &System, pencil: &Pencil<'_, f64>) -> (Vec<Dd>, Vec<Vec<Dd>>) {
    let B: Vec<Dd> = pencil.metric().iter().filter(|&&b| b > 0.0).map(|&b| Dd::from_f64(b)).collect();
    let SymmetricEigen { values, vectors } = eigen(&system.matrix(), &B).unwrap();
    let H = system.full_matrix();
    let base = H.rows() - B.len();
    let tree = DofTree::chain(base);
    let mut base_factors = Ltl::new(&tree);
    base_factors.factor(&Matrix::from_fn(base, base, |i, j| H[(i, j)])).unwrap();
    let mode = |k: usize| {
        let x = vectors.row(k);
        let momentum = |i: usize| (0..x.len()).fold(Dd::ZERO, |sum, d| sum - H[(i, base + d)] * x[d]);
        let mut x_b: Vec<Dd> = (0..base).map(momentum).collect();
        base_factors.solve(&mut x_b).unwrap();
        [x_b, x.to_vec()].concat()
    };
    let modes = (0..values.len()).map(mode).collect();
    (values, modes)
}

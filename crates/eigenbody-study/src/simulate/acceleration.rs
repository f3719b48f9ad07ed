//! Accelerations by one of several algorithms.

use eigenbody::dynamics::{
    AbaWorkspace, CrbaWorkspace, RneaWorkspace, bias_force_into, forward_dynamics_into, mass_matrix_into,
};
use eigenbody::factor::{CoupledWorkspace, Ltl, coupled_forward_dynamics_into};
use eigenbody::model::Coupling;
use eigenbody::{Error, Matrix, Model, Reduction};

/// How accelerations are found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Algorithm {
    /// The articulated-body algorithm, O(N).
    #[default]
    Aba,
    /// H by composite rigid bodies, the bias force by RNEA, and the branch-sparse LᵀL factorisation.
    CrbaLtl,
    /// Mimic joints follow: v̇ = G (GᵀHG)⁻¹ Gᵀ (τ − C), with v = G ṗ of the independent joints' rates.
    Coupled,
}

impl Algorithm {
    /// This one, or the one that mimic joints need where they follow.
    pub fn of(self, model: &Model<f64>, reduction: Reduction) -> Self {
        if reduction.mimic && model.coupling().is_some() { Self::Coupled } else { self }
    }
}

/// An algorithm with its room.
#[derive(Debug)]
pub(super) enum Accelerator<'m> {
    Aba { model: &'m Model<f64>, room: Box<AbaWorkspace<f64>> },
    Crba { matrix: Box<Bias<'m>>, ltl: Ltl<'m, f64> },
    Coupled { model: &'m Model<f64>, coupling: &'m Coupling<f64>, room: Box<CoupledWorkspace<f64>> },
}

/// H and C.
#[derive(Debug)]
pub(super) struct Bias<'m> {
    model: &'m Model<f64>,
    crba: CrbaWorkspace<f64>,
    rnea: RneaWorkspace<f64>,
    H: Matrix<f64>,
}

impl<'m> Bias<'m> {
    fn new(model: &'m Model<f64>) -> Result<Self, Error> {
        model.check_dense()?;
        let H = Matrix::zeros(model.nv(), model.nv());
        Ok(Self { model, crba: CrbaWorkspace::new(model), rnea: RneaWorkspace::new(model), H })
    }

    /// H, and τ − C into `out`.
    fn update(&mut self, q: &[f64], v: &[f64], tau: &[f64], out: &mut [f64]) -> Result<(), Error> {
        mass_matrix_into(self.model, q, &mut self.crba, &mut self.H)?;
        bias_force_into(self.model, q, v, &mut self.rnea, out)?;
        for (out, tau) in out.iter_mut().zip(tau) {
            *out = tau - *out;
        }
        Ok(())
    }
}

impl<'m> Accelerator<'m> {
    pub fn new(model: &'m Model<f64>, algorithm: Algorithm) -> Result<Self, Error> {
        Ok(match (algorithm, model.coupling()) {
            (Algorithm::Aba, _) | (Algorithm::Coupled, None) => {
                Self::Aba { model, room: Box::new(AbaWorkspace::new(model)) }
            }
            (Algorithm::CrbaLtl, _) => {
                Self::Crba { matrix: Box::new(Bias::new(model)?), ltl: Ltl::new(model.dofs()) }
            }
            (Algorithm::Coupled, Some(coupling)) => {
                let room = Box::new(CoupledWorkspace::new(model, coupling)?);
                Self::Coupled { model, coupling, room }
            }
        })
    }

    /// v̇ at (q, v) under τ.
    pub fn accelerate(&mut self, q: &[f64], v: &[f64], tau: &[f64], vdot: &mut [f64]) -> Result<(), Error> {
        match self {
            Self::Aba { model, room } => forward_dynamics_into(model, q, v, tau, room, vdot),
            Self::Crba { matrix, ltl } => {
                matrix.update(q, v, tau, vdot)?;
                ltl.factor(&matrix.H)?;
                ltl.solve(vdot)
            }
            Self::Coupled { model, coupling, room } => {
                let rate: Vec<f64> = coupling.independent_dofs().iter().map(|&d| v[d]).collect();
                let mut x = vec![0.0; coupling.nv()];
                coupled_forward_dynamics_into(
                    model,
                    coupling,
                    q,
                    &rate,
                    &coupling.pull_back(tau),
                    room,
                    &mut x,
                )?;
                coupling.push_forward_into(&x, vdot);
                Ok(())
            }
        }
    }
}

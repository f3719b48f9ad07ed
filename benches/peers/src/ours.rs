//! eigenbody itself: one configuration at a time, one thread, caller's workspaces.

use std::error::Error;

use eigenbody::dynamics::{
    AbaWorkspace, CrbaWorkspace, RneaWorkspace, bias_force_into, forward_dynamics_into,
    inverse_dynamics_into, mass_matrix_into, mass_matrix_upper_into,
};
use eigenbody::spectrum::{
    EndsAtWorkspace, EndsWorkspace, Metric, extreme_eigenvalues_at, extreme_eigenvalues_into,
};
use eigenbody::{Matrix, Model};

use crate::Outcome;
use crate::contest::Contestant;
use crate::eigen::matrices;
use crate::quantity::Quantity;
use crate::robot::{Robot, Sample};

/// All quantities of one robot.
pub struct Ours<'a> {
    model: &'a Model<f64>,
    crba: CrbaWorkspace<f64>,
    rnea: RneaWorkspace<f64>,
    aba: AbaWorkspace<f64>,
    H: Matrix<f64>,
    /// H of every sample.
    given: Vec<Matrix<f64>>,
    /// B = 1, and room for both ends of the spectrum.
    ones: Vec<f64>,
    room: EndsWorkspace<f64>,
    /// Both ends without H.
    at: EndsAtWorkspace<f64>,
    ends: [f64; 2],
    out: Vec<f64>,
}

impl<'a> Ours<'a> {
    pub fn new(robot: &'a Robot) -> Result<Self, Box<dyn Error>> {
        let model = &robot.model;
        let nv = model.nv();
        Ok(Self {
            model,
            crba: CrbaWorkspace::new(model),
            rnea: RneaWorkspace::new(model),
            aba: AbaWorkspace::new(model),
            H: Matrix::zeros(nv, nv),
            given: matrices(robot)?,
            ones: vec![1.0; nv],
            room: EndsWorkspace::new(nv),
            at: EndsAtWorkspace::new(model, &Metric::Euclidean)?,
            ends: [0.0; 2],
            out: vec![0.0; nv],
        })
    }
}

impl Contestant for Ours<'_> {
    fn quantities(&self) -> &'static [Quantity] {
        &[
            Quantity::Upper,
            Quantity::Crba,
            Quantity::Rnea,
            Quantity::Aba,
            Quantity::Bias,
            Quantity::Extremes,
            Quantity::Conditioning,
            Quantity::Eigenvalues,
        ]
    }

    fn compute(&mut self, quantity: Quantity, sample: usize, Sample { q, v, x }: &Sample) -> Outcome {
        let Self { model, crba, rnea, aba, H, given, out, ones, room, at, ends } = self;
        match quantity {
            Quantity::Upper => mass_matrix_upper_into(model, q, crba, H)?,
            Quantity::Crba => mass_matrix_into(model, q, crba, H)?,
            Quantity::Rnea => inverse_dynamics_into(model, q, v, x, rnea, out)?,
            Quantity::Aba => forward_dynamics_into(model, q, v, x, aba, out)?,
            Quantity::Bias => bias_force_into(model, q, v, rnea, out)?,
            Quantity::Extremes => *ends = extreme_eigenvalues_at(model, q, at)?,
            Quantity::Conditioning => {
                mass_matrix_into(model, q, crba, H)?;
                let [min, max] = extreme_eigenvalues_into(H, ones, room)?;
                for (d, B) in out.iter_mut().enumerate() {
                    *B = H[(d, d)];
                }
                let [own_min, own_max] = extreme_eigenvalues_into(H, out, room)?;
                *ends = [max / min, own_max / own_min];
            }
            _ => *ends = extreme_eigenvalues_into(&given[sample], ones, room)?,
        }
        Ok(())
    }

    fn value(&mut self, quantity: Quantity) -> Vec<f64> {
        match quantity {
            Quantity::Upper => {
                let nv = self.H.rows();
                Matrix::from_fn(nv, nv, |d, e| self.H[(d.min(e), d.max(e))]).as_slice().to_vec()
            }
            Quantity::Crba => self.H.as_slice().to_vec(),
            Quantity::Extremes | Quantity::Conditioning | Quantity::Eigenvalues => self.ends.to_vec(),
            _ => self.out.clone(),
        }
    }
}

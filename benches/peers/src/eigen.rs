//! Eigenvalues of given matrices by dense solvers.

use std::error::Error;

use eigenbody::{Matrix, mass_matrix};
use nalgebra::DMatrix;

use crate::Outcome;
use crate::contest::Contestant;
use crate::dense::{dense, faer_eigenvalues};
use crate::quantity::Quantity;
use crate::robot::{Robot, Sample};

/// H of every sample.
pub fn matrices(robot: &Robot) -> Result<Vec<Matrix<f64>>, Box<dyn Error>> {
    robot.samples.iter().map(|sample| Ok(mass_matrix(&robot.model, &sample.q)?)).collect()
}

/// nalgebra's solver, eigenvalues only.
pub struct Nalgebra {
    matrices: Vec<DMatrix<f64>>,
    ends: [f64; 2],
}

impl Nalgebra {
    pub fn new(robot: &Robot) -> Result<Self, Box<dyn Error>> {
        let given = |H: &Matrix<f64>| DMatrix::from_row_slice(H.rows(), H.cols(), H.as_slice());
        Ok(Self { matrices: matrices(robot)?.iter().map(given).collect(), ends: [0.0; 2] })
    }
}

impl Contestant for Nalgebra {
    fn quantities(&self) -> &'static [Quantity] {
        &[Quantity::Eigenvalues]
    }

    fn compute(&mut self, _: Quantity, sample: usize, _: &Sample) -> Outcome {
        let values = self.matrices[sample].symmetric_eigenvalues();
        self.ends = [values.min(), values.max()];
        Ok(())
    }

    fn value(&mut self, _: Quantity) -> Vec<f64> {
        self.ends.to_vec()
    }
}

/// faer's solver, eigenvalues only, one thread.
pub struct Faer {
    matrices: Vec<faer::Mat<f64>>,
    ends: [f64; 2],
}

impl Faer {
    pub fn new(robot: &Robot) -> Result<Self, Box<dyn Error>> {
        Ok(Self { matrices: matrices(robot)?.iter().map(dense).collect(), ends: [0.0; 2] })
    }
}

impl Contestant for Faer {
    fn quantities(&self) -> &'static [Quantity] {
        &[Quantity::Eigenvalues]
    }

    fn compute(&mut self, _: Quantity, sample: usize, _: &Sample) -> Outcome {
        let values = faer_eigenvalues(&self.matrices[sample], faer::Par::Seq);
        self.ends = [values[0], values[values.len() - 1]];
        Ok(())
    }

    fn value(&mut self, _: Quantity) -> Vec<f64> {
        self.ends.to_vec()
    }
}

//! What gains joints and modes bear at a step.

use super::field::Field;
use super::{JointGains, ModeGains, parts};
use crate::StudyError;
use crate::diagnosis::{Drive, Worst};
use eigenbody::factor::Cholesky;
use eigenbody::search::{Effort, Measure};
use eigenbody::stability::{Integrator, REAL_LIMIT};
use eigenbody::{Matrix, Model, Reduction};
use rayon::prelude::*;

impl Field<'_> {
    pub fn joints(
        &self,
        drive: &Drive,
        effort: Effort,
        known: &[Vec<f64>],
    ) -> Result<Vec<JointGains>, StudyError> {
        let points = self.points(effort, known);
        let n = self.dofs.len();
        let mobility: Vec<Option<Vec<f64>>> = points
            .par_iter()
            .map(|point| {
                let H = self.mass_matrix(&self.domain.configuration(point))?;
                let (mut factor, mut inverse) = (Cholesky::new(n), Matrix::zeros(n, n));
                match factor.factor(&H) {
                    // Pivots of rounding size have no inverse to speak of.
                    Ok(info)
                        if info.smallest.1
                            > 4.0 * n as f64 * f64::EPSILON * H[(info.smallest.0, info.smallest.0)] =>
                    {
                        factor.inverse_into(&mut inverse)?;
                    }
                    _ => return Ok(None),
                }
                Ok(Some((0..n).map(|d| inverse[(d, d)]).collect()))
            })
            .collect::<Result<_, StudyError>>()?;
        let of = |d: usize| {
            let own = mobility.iter().zip(&points);
            let all = own.filter_map(|(mobility, point)| Some((mobility.as_ref()?[d], point)));
            let (most, point) = all.max_by(|a, b| a.0.total_cmp(&b.0))?;
            let inertia = 1.0 / most;
            Some(JointGains {
                joint: self.dofs[d].clone(),
                has: [self.impedance.stiffness[(d, d)], self.impedance.damping[(d, d)]],
                inertia,
                at: self.domain.configuration(point),
                bears: bears(drive, inertia),
            })
        };
        Ok((0..n).filter_map(of).collect())
    }
}

/// kp h²/m and kd h/m at the edge of stability, each alone.
fn edge(integrator: Integrator) -> [f64; 2] {
    match integrator {
        Integrator::SemiImplicitEuler | Integrator::DampedEuler => [4.0, 2.0],
        Integrator::ImplicitVelocity => [4.0, f64::INFINITY],
        Integrator::RungeKutta4 => [8.0, REAL_LIMIT],
    }
}

fn bears(drive: &Drive, inertia: f64) -> Option<[f64; 2]> {
    let [c, d] = edge(drive.integrator);
    drive.step.map(|h| [c * inertia / (h * h), d * inertia / h])
}

/// The modes of H where λmin is least.
pub fn modes(
    model: &Model<f64>,
    reduction: Reduction,
    drive: &Drive,
    worst: &[Worst],
) -> Result<Vec<ModeGains>, StudyError> {
    let Some(worst) = worst.iter().find(|worst| worst.spread.measure == Measure::LambdaMin) else {
        return Ok(Vec::new());
    };
    let names: Vec<String> = reduction.dofs(model).into_iter().map(|d| model.dof_name(d)).collect();
    let H = reduction.mass_matrix(model, &worst.spread.at)?;
    let pairs = eigenbody::spectrum::eigen(&H, &vec![1.0; H.rows()])?;
    let mode = |k: usize| {
        let x = pairs.vectors.row(k);
        let squares: Vec<f64> = x.iter().map(|x| x * x).collect();
        // The search knows λmin to more digits than the matrix has.
        let lambda = if k == 0 { worst.spread.worst } else { pairs.values[k] };
        ModeGains { lambda, bears: bears(drive, lambda), dofs: parts(&names, x, &squares) }
    };
    Ok((0..H.rows()).map(mode).collect())
}

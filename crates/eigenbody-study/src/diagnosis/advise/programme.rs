//! The linear programme and its rows.

use super::remedy::Remedy;
use super::{Goal, Judge};
use crate::StudyError;
use eigenbody::search::Evaluator;
use eigenbody::spectrum::eigen;
use eigenbody::stability::{Integrator, largest_step};
use eigenbody::{Matrix, Metric, Model, Question, conditioning_at};
use microlp::{ComparisonOp, OptimizationDirection, Problem};
use rayon::prelude::*;

/// What is asked for is asked for a little more strictly, so that what is found holds it.
const MARGIN: f64 = 2e-3;
/// How far a configuration may fall short of the stricter goal.
const TOLERANCE: f64 = 1e-3;
/// Rows added a round.
const CUTS: usize = 16;
/// Rounds of cuts.
const ROUNDS: usize = 400;

/// A row: Σ c_k z_k ≥ b.
pub(super) struct Cut {
    pub c: Vec<f64>,
    pub b: f64,
}

/// The rows so far.
pub(super) struct Programme<'a> {
    judge: &'a Judge<'a>,
    remedy: &'a Remedy,
    cuts: Vec<Cut>,
}

impl<'a> Programme<'a> {
    pub fn new(judge: &'a Judge<'a>, remedy: &'a Remedy) -> Self {
        Self { judge, remedy, cuts: remedy.first_cuts() }
    }

    /// The least change for all rows and these configurations; none if there is none.
    pub fn mend(
        &mut self,
        model: &Model<f64>,
        configurations: &[Vec<f64>],
    ) -> Result<Option<Vec<f64>>, StudyError> {
        let mut change = self.solve();
        for _ in 0..ROUNDS {
            let Some(z) = &change else { return Ok(None) };
            if let Some(cut) = self.remedy.cone_cut(z) {
                self.cuts.push(cut);
                change = self.solve();
                continue;
            }
            let mended = self.remedy.applied(model, z)?;
            let found: Result<Vec<_>, StudyError> =
                configurations.par_iter().map(|q| self.cut(&mended, q, z)).collect();
            let mut cuts: Vec<(f64, Cut)> = found?.into_iter().flatten().collect();
            if cuts.is_empty() {
                return Ok(change);
            }
            cuts.sort_by(|x, y| y.0.total_cmp(&x.0));
            self.cuts.extend(cuts.into_iter().take(CUTS).map(|(_, cut)| cut));
            change = self.solve();
        }
        Ok(None)
    }

    /// The row that a configuration violates, and by how much. With s(x) = xᵀ∂H x by each unknown and g = Σ w xᵀHx the goal's
    /// left-hand side on the robot as mended: g + Σ w s(x)·(z' − z) ≥ wanted.
    fn cut(&self, mended: &Model<f64>, q: &[f64], z: &[f64]) -> Result<Option<(f64, Cut)>, StudyError> {
        let Some(Missed { shortfall, modes, missing }) = self.missed(mended, q)? else { return Ok(None) };
        let evaluator = Evaluator::new(mended, self.judge.wish.reduction, Metric::Euclidean)?;
        let mut c = vec![0.0; z.len()];
        for (weight, x) in &modes {
            let response = self.remedy.response(mended, &evaluator, q, x)?;
            c.iter_mut().zip(response).for_each(|(c, r)| *c += weight * r);
        }
        let already: f64 = c.iter().zip(z).map(|(c, z)| c * z).sum();
        Ok(Some((shortfall, Cut { c, b: missing + already })))
    }

    /// How a configuration misses the goal; none if it does not.
    fn missed(&self, mended: &Model<f64>, q: &[f64]) -> Result<Option<Missed>, StudyError> {
        let reduction = self.judge.wish.reduction;
        if let Goal::Step(step, integrator) = self.judge.wish.goal {
            let H = reduction.mass_matrix(mended, q)?;
            return self.unstable(&H, step * (1.0 + MARGIN), integrator);
        }
        let verdict = conditioning_at(mended, q, &Question { reduction, ..Question::default() })?;
        let (min, max) = (verdict.lambda_min.unwrap_or(0.0), verdict.lambda_max.unwrap_or(0.0));
        let (shortfall, missing) = match self.judge.wish.goal {
            Goal::LambdaMin(least) => {
                let wanted = least * (1.0 + MARGIN);
                (1.0 - min / wanted, wanted - min)
            }
            Goal::Kappa(most) | Goal::Step(most, _) => {
                let K = most / (1.0 + MARGIN);
                (1.0 - min * K / max, max - K * min)
            }
        };
        if shortfall <= TOLERANCE {
            return Ok(None);
        }
        let softest = match verdict.softest.filter(|_| verdict.lambda_min.is_some()) {
            Some(x) => x,
            None => self.judge.softest(mended, q)?,
        };
        let modes = match self.judge.wish.goal {
            Goal::Kappa(most) => {
                vec![(most / (1.0 + MARGIN), softest), (-1.0, verdict.stiffest.unwrap_or_default())]
            }
            _ => vec![(1.0, softest)],
        };
        Ok(Some(Missed { shortfall, modes, missing }))
    }

    /// A motion that a step does not bear: 4xᵀHx < xᵀ(h²K + 2hΔ)x.
    fn unstable(
        &self,
        H: &Matrix<f64>,
        step: f64,
        integrator: Integrator,
    ) -> Result<Option<Missed>, StudyError> {
        let impedance = &self.judge.impedance;
        let (K, D) = (&impedance.stiffness, &impedance.damping);
        let pull = Matrix::from_fn(H.rows(), H.rows(), |i, j| {
            let implicit = match integrator {
                Integrator::DampedEuler => impedance.joint_damping[(i, j)],
                Integrator::ImplicitVelocity => D[(i, j)],
                Integrator::SemiImplicitEuler | Integrator::RungeKutta4 => 0.0,
            };
            step * step * K[(i, j)] + 2.0 * step * (D[(i, j)] - 2.0 * implicit)
        });
        let along =
            |A: &Matrix<f64>, x: &[f64]| -> f64 { x.iter().zip(A.times(x)).map(|(x, y)| x * y).sum() };
        let (shortfall, mode) = match largest_step(H, impedance, integrator) {
            Ok(limit) => (1.0 - limit.step / step, limit.mode),
            // Without inertia to speak of, the motion that is pulled hardest for what it has.
            Err(_) => {
                let C = Matrix::from_fn(H.rows(), H.rows(), |i, j| 4.0 * H[(i, j)] - pull[(i, j)]);
                (1.0, eigen(&C, &vec![1.0; H.rows()])?.vectors.row(0).to_vec())
            }
        };
        let missing = along(&pull, &mode) - 4.0 * along(H, &mode);
        // What the mode of the limit bears at a longer step is linear to first order: it misses by at least the tolerance.
        let is_missed = shortfall > TOLERANCE && missing > 0.0;
        Ok(is_missed.then(|| Missed { shortfall, modes: vec![(4.0, mode)], missing }))
    }

    /// The optimum of the rows so far, in units of each unknown's own cost.
    fn solve(&self) -> Option<Vec<f64>> {
        let costs = self.remedy.costs();
        // Unknowns near one: the solver's tolerances are absolute.
        let reach = |Cut { c, b }: &Cut| {
            let scales = self.remedy.scales();
            b / c.iter().zip(scales).fold(0.0f64, |m, (c, s)| m.max((c * s).abs()))
        };
        let unit = self.cuts.iter().map(reach).filter(|x| x.is_finite()).fold(0.0, f64::max);
        let unit = if unit > 0.0 { unit } else { 1.0 };
        let scale: Vec<f64> = self.remedy.scales().iter().map(|scale| scale * unit).collect();
        let mut problem = Problem::new(OptimizationDirection::Minimize);
        let variables: Vec<_> = (0..costs.len())
            .map(|k| {
                let lowest = if self.remedy.is_free(k) { f64::NEG_INFINITY } else { 0.0 };
                problem.add_var(costs[k] * scale[k] / unit, (lowest, f64::INFINITY))
            })
            .collect();
        for Cut { c, b } in &self.cuts {
            let scaled: Vec<f64> = c.iter().zip(&scale).map(|(c, s)| c * s).collect();
            let largest = scaled.iter().fold(0.0f64, |m, c| m.max(c.abs()));
            if largest == 0.0 {
                return None;
            }
            let entries: Vec<_> = variables
                .iter()
                .zip(&scaled)
                .map(|(&variable, c)| (variable, c / largest))
                .filter(|(_, c)| c.abs() > 1e-9)
                .collect();
            problem.add_constraint(entries, ComparisonOp::Ge, b / largest);
        }
        let solution = problem.solve().ok()?.into_solution().ok()?;
        let value = |k: usize| {
            let z = solution.var_value(variables[k]);
            if self.remedy.is_free(k) { z * scale[k] } else { z.max(0.0) * scale[k] }
        };
        // Changes without bound are none.
        let change: Vec<f64> = (0..scale.len()).map(value).collect();
        change.iter().all(|z| z.is_finite()).then_some(change)
    }
}

/// How a configuration misses the goal: Σ weight · xᵀHx is `missing` less than wanted.
struct Missed {
    shortfall: f64,
    modes: Vec<(f64, Vec<f64>)>,
    missing: f64,
}

//! The search for the largest stable step.

use super::{Progress, WorstStep, parts};
use crate::StudyError;
use crate::diagnosis::{Part, proceed};
use eigenbody::dynamics::kinetic_energy_gradient;
use eigenbody::search::{Domain, Effort, Evaluator, Landscape, Point, descend, sample_points};
use eigenbody::stability::{Impedance, Integrator, StepLimit, is_stable, largest_step};
use eigenbody::{Error, Matrix, Metric, Model, Reduction};
use rayon::prelude::*;

/// Samples that see the same bound: the result does not depend on the number of threads.
const CHUNK: usize = 64;
/// Descents an integrator, and evaluations each.
const STARTS: usize = 3;
const LOOKS: usize = 40;
/// Configurations at which Runge-Kutta's limit is computed.
const CANDIDATES: usize = 8;

/// A robot held by springs, over its joint limits.
pub struct Field<'m> {
    model: &'m Model<f64>,
    reduction: Reduction,
    pub impedance: &'m Impedance,
    pub domain: Domain<'m>,
    evaluator: Evaluator<'m>,
    pub dofs: Vec<String>,
    progress: &'m Progress<'m>,
}

/// A step and the point where no larger one is stable.
pub type Record = (f64, Point);

impl<'m> Field<'m> {
    pub fn new(
        model: &'m Model<f64>,
        reduction: Reduction,
        impedance: &'m Impedance,
        progress: &'m Progress<'m>,
    ) -> Result<Self, StudyError> {
        let domain = Domain::new(model, reduction.mimic);
        let evaluator = Evaluator::new(model, reduction, Metric::Euclidean)?;
        let dofs = reduction.dofs(model).into_iter().map(|d| model.dof_name(d)).collect();
        Ok(Self { model, reduction, impedance, domain, evaluator, dofs, progress })
    }

    pub fn mass_matrix(&self, q: &[f64]) -> Result<Matrix<f64>, Error> {
        proceed(self.progress)?;
        self.reduction.mass_matrix(self.model, q)
    }

    pub fn points(&self, effort: Effort, known: &[Vec<f64>]) -> Vec<Point> {
        let mut points = sample_points(&self.domain, effort.samples, effort.seed);
        points.extend(known.iter().map(|q| self.domain.nearest(q)));
        points
    }

    /// For each integrator of Euler's kind, points of ever smaller steps; the last are the worst.
    pub fn records(
        &self,
        integrators: &[Integrator],
        effort: Effort,
        known: &[Vec<f64>],
    ) -> Result<Vec<Vec<Record>>, StudyError> {
        let points = self.points(effort, known);
        let mut records: Vec<Vec<Record>> = vec![Vec::new(); integrators.len()];
        for chunk in points.chunks(CHUNK) {
            let best: Vec<f64> =
                records.iter().map(|all| all.last().map_or(f64::INFINITY, |r| r.0)).collect();
            let suspects: Vec<(usize, usize)> = chunk
                .par_iter()
                .enumerate()
                .map(|(k, point)| {
                    let H = self.mass_matrix(&self.domain.configuration(point))?;
                    let mut suspects = Vec::new();
                    for (i, &integrator) in integrators.iter().enumerate() {
                        if !self.bears(&H, integrator, best[i])? {
                            suspects.push((k, i));
                        }
                    }
                    Ok(suspects)
                })
                .collect::<Result<Vec<Vec<_>>, Error>>()?
                .concat();
            for (k, i) in suspects {
                let best = records[i].last().map_or(f64::INFINITY, |r| r.0);
                let H = self.mass_matrix(&self.domain.configuration(&chunk[k]))?;
                if self.bears(&H, integrators[i], best)? {
                    continue;
                }
                if let Some(limit) = self.limit(&H, integrators[i])?.filter(|limit| limit.step < best) {
                    records[i].push((limit.step, chunk[k].clone()));
                }
            }
        }
        for (records, &integrator) in records.iter_mut().zip(integrators) {
            let starts: Vec<&Point> = records.iter().rev().take(STARTS).map(|(_, point)| point).collect();
            let ends: Vec<Option<Record>> = starts
                .into_par_iter()
                .map(|start| {
                    let mut ground = Ground { field: self, integrator, error: None };
                    let found = descend(&mut ground, start, LOOKS);
                    match ground.error {
                        Some(error) => Err(error),
                        None => Ok(found.map(|(point, step)| (step, point))),
                    }
                })
                .collect::<Result<_, StudyError>>()?;
            records.extend(ends.into_iter().flatten());
            records.sort_by(|a, b| b.0.total_cmp(&a.0));
        }
        Ok(records)
    }

    /// Whether a step is stable at H; none is as long as it is infinite.
    fn bears(&self, H: &Matrix<f64>, integrator: Integrator, step: f64) -> Result<bool, Error> {
        Ok(step.is_finite() && is_stable(H, self.impedance, integrator, step)?)
    }

    /// None where H is singular to working precision.
    fn limit(&self, H: &Matrix<f64>, integrator: Integrator) -> Result<Option<StepLimit>, Error> {
        match largest_step(H, self.impedance, integrator) {
            Ok(limit) => Ok(Some(limit)),
            Err(Error::NotPositiveDefinite(_)) => Ok(None),
            Err(error) => Err(error),
        }
    }

    pub fn limits(
        &self,
        own: Integrator,
        effort: Effort,
        known: &[Vec<f64>],
    ) -> Result<Vec<WorstStep>, StudyError> {
        let mut integrators = vec![Integrator::SemiImplicitEuler, Integrator::ImplicitVelocity];
        if own == Integrator::DampedEuler {
            integrators.insert(1, own);
        }
        let records = self.records(&integrators, effort, known)?;
        let mut limits = Vec::new();
        for (&integrator, records) in integrators.iter().zip(&records) {
            limits.push(self.worst(integrator, records.last())?);
        }
        let mut candidates: Vec<&Record> =
            records.iter().flat_map(|all| all.iter().rev().take(CANDIDATES / integrators.len())).collect();
        candidates.dedup_by(|a, b| a.1 == b.1);
        let steps: Vec<Option<f64>> = candidates
            .par_iter()
            .map(|(_, point)| {
                let H = self.mass_matrix(&self.domain.configuration(point))?;
                Ok(self.limit(&H, Integrator::RungeKutta4)?.map(|limit| limit.step))
            })
            .collect::<Result<_, StudyError>>()?;
        let pairs = steps.iter().zip(&candidates).filter_map(|(step, (_, point))| Some(((*step)?, point)));
        let worst = pairs.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(step, point)| (step, point.clone()));
        limits.push(self.worst(Integrator::RungeKutta4, worst.as_ref())?);
        Ok(limits)
    }

    fn worst(&self, integrator: Integrator, record: Option<&Record>) -> Result<WorstStep, StudyError> {
        let none = WorstStep {
            integrator,
            step: f64::INFINITY,
            at: Vec::new(),
            pencils: [0.0; 2],
            dofs: Vec::new(),
        };
        let Some((step, point)) = record else { return Ok(none) };
        let at = self.domain.configuration(point);
        let H = self.mass_matrix(&at)?;
        let Some(limit) = self.limit(&H, integrator)?.filter(|limit| limit.step.is_finite()) else {
            return Ok(none);
        };
        let zero = || Matrix::zeros(H.rows(), H.rows());
        let alone = |impedance: &Impedance| {
            largest_step(&H, impedance, Integrator::SemiImplicitEuler).map(|limit| limit.step)
        };
        let stiff = alone(&Impedance { damping: zero(), ..self.impedance.clone() })?;
        let damped = alone(&Impedance { stiffness: zero(), ..self.impedance.clone() })?;
        let pencils = [4.0 / (stiff * stiff), 2.0 / damped];
        let dofs = self.parts(&limit.mode, *step);
        Ok(WorstStep { integrator, step: limit.step, at, pencils, dofs })
    }

    /// Who pulls in a motion: x_d (h²K x + 2hD x)_d, in parts of the whole.
    fn parts(&self, x: &[f64], h: f64) -> Vec<Part> {
        let (Kx, Dx) = (self.impedance.stiffness.times(x), self.impedance.damping.times(x));
        let pull: Vec<f64> = (0..x.len()).map(|d| x[d] * (h * h * Kx[d] + 2.0 * h * Dx[d])).collect();
        parts(&self.dofs, x, &pull)
    }
}

/// The largest stable step over the domain.
struct Ground<'a, 'm> {
    field: &'a Field<'m>,
    integrator: Integrator,
    error: Option<StudyError>,
}

impl Ground<'_, '_> {
    fn value(&self, at: &Point) -> Result<Option<(f64, Vec<f64>)>, StudyError> {
        let Field { model, reduction, impedance, domain, evaluator, .. } = self.field;
        let q = domain.configuration(at);
        let H = self.field.mass_matrix(&q)?;
        let Some(StepLimit { step, mode: x }) = self.field.limit(&H, self.integrator)? else {
            return Ok(None);
        };
        if step.is_infinite() {
            return Ok(None);
        }
        let along = |A: &Matrix<f64>| -> f64 { x.iter().zip(A.times(&x)).map(|(x, y)| x * y).sum() };
        let implicit = match self.integrator {
            Integrator::DampedEuler => along(&impedance.joint_damping),
            Integrator::ImplicitVelocity => along(&impedance.damping),
            _ => 0.0,
        };
        let slope = along(&impedance.damping) - 2.0 * implicit + step * along(&impedance.stiffness);
        let motion = evaluator.motion(&q, &x)?;
        // Twice the gradient of the kinetic energy is xᵀ dH x.
        let energy = kinetic_energy_gradient(model, &q, &motion)?;
        let mut gradient: Vec<f64> = energy.into_iter().map(|g| 4.0 * g / slope).collect();
        if let Some(coupling) = model.coupling().filter(|_| reduction.mimic) {
            gradient = coupling.pull_back(&gradient);
        }
        domain.pull_back(at, &mut gradient);
        Ok(Some((step, gradient)))
    }
}

impl Landscape for Ground<'_, '_> {
    type Point = Point;

    fn look(&mut self, at: &Point) -> Option<(f64, Vec<f64>)> {
        match self.value(at) {
            Ok(found) => found,
            Err(error) => {
                self.error = Some(error);
                None
            }
        }
    }

    fn moved(&self, from: &Point, step: &[f64]) -> Point {
        self.field.domain.moved(from, step)
    }
}

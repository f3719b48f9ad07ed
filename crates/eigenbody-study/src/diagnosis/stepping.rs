//! The largest stable step over the joint limits, and the largest gains at a step.
//!
//! ```text
//! samples  ->  those at which the best bound so far is not stable (one Cholesky each)  ->  the bound there, exactly
//! the worst of them  ->  descent of h:  dh = 2 xᵀdH x / (xᵀΔx + h xᵀKx),  x the motion that sets h
//! one joint alone    kp ≤ c m/h²,  kd ≤ d m/h,  m = 1/(H⁻¹)_dd: its inertia with the others free
//! a mode             the same with m = λ: gains that are equal on all joints
//! ```
//! c = 4, d = 2 for Euler's methods, 8 and 2.785 for Runge-Kutta 4; kd is without bound where damping is implicit. Runge-Kutta's own
//! worst is looked for among the worst of the others.

use super::{Drive, Part, Worst, proceed};
use crate::StudyError;
use eigenbody::dynamics::kinetic_energy_gradient;
use eigenbody::factor::Cholesky;
use eigenbody::search::{Domain, Effort, Evaluator, Landscape, Measure, Point, descend, sample_points};
use eigenbody::stability::{Impedance, Integrator, REAL_LIMIT, StepLimit, is_stable, largest_step};
use eigenbody::{Error, Matrix, Metric, Model, Reduction};
use rayon::prelude::*;
use std::ops::ControlFlow;

/// Configurations sampled at most.
const SAMPLES: u32 = 512;
/// Samples that see the same bound: the result does not depend on the number of threads.
const CHUNK: usize = 64;
/// Descents an integrator, and evaluations each.
const STARTS: usize = 3;
const LOOKS: usize = 40;
/// Configurations at which Runge-Kutta's limit is computed.
const CANDIDATES: usize = 8;

/// What steps and gains are stable.
#[derive(Debug, Clone, PartialEq)]
pub struct Stepping {
    /// The step that is wanted (s), and how it is made.
    pub step: Option<f64>,
    /// How a step is made.
    pub integrator: Integrator,
    /// False if springs or dampers give energy away: then no step is stable, and nothing else is said.
    pub passive: bool,
    /// The largest stable step of each integrator, with the springs as they are; none without springs.
    pub limits: Vec<WorstStep>,
    /// What each joint bears at the step.
    pub joints: Vec<JointGains>,
    /// What the modes bear at the step, where λmin is least: the softest first.
    pub modes: Vec<ModeGains>,
}

/// The largest step that is stable everywhere.
#[derive(Debug, Clone, PartialEq)]
pub struct WorstStep {
    /// The integrator.
    pub integrator: Integrator,
    /// The step (s); infinite if every step is stable.
    pub step: f64,
    /// The configuration that bears no larger one; empty for an infinite step.
    pub at: Vec<f64>,
    /// Largest eigenvalues there of (K, H) (1/s²) and (D, H) (1/s).
    pub pencils: [f64; 2],
    /// The joints whose springs pull in the motion that grows, the largest part first.
    pub dofs: Vec<Part>,
}

impl WorstStep {
    /// What the two pencils alone say of semi-implicit Euler's step: at least, and at most.
    pub fn bracket(&self) -> [f64; 2] {
        let [k, d] = self.pencils;
        [4.0 / (d + d.mul_add(d, 4.0 * k).sqrt()), (2.0 / k.sqrt()).min(2.0 / d)]
    }
}

/// What a joint has and what it bears.
#[derive(Debug, Clone, PartialEq)]
pub struct JointGains {
    /// The degree of freedom.
    pub joint: String,
    /// Stiffness and damping that it has, all springs together (K_dd, D_dd).
    pub has: [f64; 2],
    /// 1/(H⁻¹)_dd, the least found: its inertia with all others free (kg m², kg).
    pub inertia: f64,
    /// Where.
    pub at: Vec<f64>,
    /// The largest kp and kd alone at the step, nothing else pulling.
    pub bears: Option<[f64; 2]>,
}

/// What gains that are equal on all joints a mode bears.
#[derive(Debug, Clone, PartialEq)]
pub struct ModeGains {
    /// The mode's inertia.
    pub lambda: f64,
    /// The largest kp and kd at the step; none without a step.
    pub bears: Option<[f64; 2]>,
    /// Joints, the largest share first.
    pub dofs: Vec<Part>,
}

/// kp h²/m and kd h/m at the edge of stability, each alone.
pub(super) fn edge(integrator: Integrator) -> [f64; 2] {
    match integrator {
        Integrator::SemiImplicitEuler | Integrator::DampedEuler => [4.0, 2.0],
        Integrator::ImplicitVelocity => [4.0, f64::INFINITY],
        Integrator::RungeKutta4 => [8.0, REAL_LIMIT],
    }
}

/// None where there is nothing to say: neither springs nor a step.
pub(super) fn stepping(
    model: &Model<f64>,
    reduction: Reduction,
    drive: &Drive,
    effort: Effort,
    worst: &[Worst],
    progress: &Progress<'_>,
) -> Result<Option<Stepping>, StudyError> {
    let impedance = Impedance::new(model, reduction, &drive.springs);
    if impedance.is_zero() && drive.step.is_none() {
        return Ok(None);
    }
    let (step, integrator) = (drive.step, drive.integrator);
    let nothing = Stepping {
        step,
        integrator,
        passive: false,
        limits: Vec::new(),
        joints: Vec::new(),
        modes: Vec::new(),
    };
    if !impedance.is_passive()? {
        return Ok(Some(nothing));
    }
    let known: Vec<Vec<f64>> = worst.iter().map(|worst| worst.spread.at.clone()).collect();
    let field = Field::new(model, reduction, &impedance, progress)?;
    let effort = Effort { samples: effort.samples.min(SAMPLES), ..effort };
    let limits = if impedance.is_zero() { Vec::new() } else { field.limits(integrator, effort, &known)? };
    let joints = field.joints(drive, effort, &known)?;
    let modes = modes(model, reduction, drive, worst)?;
    Ok(Some(Stepping { passive: true, limits, joints, modes, ..nothing }))
}

/// The largest stable step of one integrator over the joint limits, and where.
pub(super) fn worst_step(
    model: &Model<f64>,
    reduction: Reduction,
    impedance: &Impedance,
    integrator: Integrator,
    effort: Effort,
    known: &[Vec<f64>],
) -> Result<(f64, Vec<f64>), StudyError> {
    let field = Field::new(model, reduction, impedance, &|_| ControlFlow::Continue(()))?;
    let found = field.records(&[integrator], effort, known)?;
    let worst = found[0].iter().min_by(|a, b| a.0.total_cmp(&b.0));
    Ok(worst.map_or((f64::INFINITY, Vec::new()), |(step, point)| (*step, field.domain.configuration(point))))
}

/// Who may end a search, asked before each configuration.
type Progress<'a> = dyn Fn(usize) -> ControlFlow<()> + Sync + 'a;

/// A robot held by springs, over its joint limits.
struct Field<'m> {
    model: &'m Model<f64>,
    reduction: Reduction,
    impedance: &'m Impedance,
    domain: Domain<'m>,
    evaluator: Evaluator<'m>,
    dofs: Vec<String>,
    progress: &'m Progress<'m>,
}

/// A step and the point where no larger one is stable.
type Record = (f64, Point);

impl<'m> Field<'m> {
    fn new(
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

    fn mass_matrix(&self, q: &[f64]) -> Result<Matrix<f64>, Error> {
        proceed(self.progress)?;
        self.reduction.mass_matrix(self.model, q)
    }

    fn points(&self, effort: Effort, known: &[Vec<f64>]) -> Vec<Point> {
        let mut points = sample_points(&self.domain, effort.samples, effort.seed);
        points.extend(known.iter().map(|q| self.domain.nearest(q)));
        points
    }

    /// For each integrator of Euler's kind, points of ever smaller steps; the last are the worst.
    fn records(
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
                    let fails = |i: usize| {
                        best[i].is_infinite() || !is_stable(&H, self.impedance, integrators[i], best[i])
                    };
                    Ok((0..integrators.len()).filter(|&i| fails(i)).map(|i| (k, i)).collect())
                })
                .collect::<Result<Vec<Vec<_>>, Error>>()?
                .concat();
            for (k, i) in suspects {
                let best = records[i].last().map_or(f64::INFINITY, |r| r.0);
                let H = self.mass_matrix(&self.domain.configuration(&chunk[k]))?;
                if best.is_finite() && is_stable(&H, self.impedance, integrators[i], best) {
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

    /// None where H is singular to working precision.
    fn limit(&self, H: &Matrix<f64>, integrator: Integrator) -> Result<Option<StepLimit>, Error> {
        match largest_step(H, self.impedance, integrator) {
            Ok(limit) => Ok(Some(limit)),
            Err(Error::NotPositiveDefinite(_)) => Ok(None),
            Err(error) => Err(error),
        }
    }

    fn limits(
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

    fn joints(
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

fn bears(drive: &Drive, inertia: f64) -> Option<[f64; 2]> {
    let [c, d] = edge(drive.integrator);
    drive.step.map(|h| [c * inertia / (h * h), d * inertia / h])
}

/// Names with their rates and shares, the largest share first.
fn parts(names: &[String], x: &[f64], weight: &[f64]) -> Vec<Part> {
    let total: f64 = weight.iter().sum();
    let of = |d: usize| Part { name: names[d].clone(), rate: x[d], share: weight[d] / total };
    let mut parts: Vec<Part> = (0..x.len()).map(of).collect();
    parts.sort_by(|a, b| b.share.total_cmp(&a.share));
    parts
}

/// The modes of H where λmin is least.
fn modes(
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

//! The least armature that mends a robot: a linear programme with eigenvector cuts.
//!
//! ```text
//! least Σ a_d/s_d,  a ≥ 0,  s_d the median of H_dd         so that at every configuration, for every x with xᵀx = 1
//! λmin ≥ ℓ:    Σ a_d x_d² ≥ ℓ − xᵀHx
//! κ ≤ K:       Σ a_d (K x_d² − y_d²) ≥ yᵀHy − K xᵀHx           for every y with yᵀy = 1 besides
//! ```
//! Both are linear in a, one row for each mode. Rows are added for the softest and stiffest modes of configurations that fail, until
//! none fails; then the worst configurations of the mended robot are searched for, and the loop goes on with those (Kelley's cutting
//! planes). The optimum is that of all configurations that were looked at.

use crate::StudyError;
use eigenbody::search::{Domain, Effort, Measure, survey};
use eigenbody::{Metric, Model, Reduction, conditioning_at};
use microlp::{ComparisonOp, OptimizationDirection, Problem};
use rayon::prelude::*;

/// What is asked for is asked for a little more strictly, so that what is found holds it.
const MARGIN: f64 = 2e-3;
/// How far a configuration may fall short of the stricter goal.
const TOLERANCE: f64 = 1e-3;
/// Rows added a round.
const CUTS: usize = 16;
/// Rounds of cuts, and of searches.
const ROUNDS: usize = 400;
const SEARCHES: usize = 8;

/// What a robot should fulfil in every configuration, in the Euclidean metric.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Goal {
    /// λmin of at least this (kg m²).
    LambdaMin(f64),
    /// κ of at most this.
    Kappa(f64),
}

/// Armature that fulfils a goal.
#[derive(Debug, Clone, PartialEq)]
pub struct Advice {
    /// What was asked for.
    pub goal: Goal,
    /// What to add, one entry a degree of freedom of the study.
    pub added: Vec<Added>,
    /// Configurations in which the mended robot was looked at, the worst found among them.
    pub checked: usize,
    /// The worst value of the goal's measure on the mended robot.
    pub reached: f64,
    /// The mended robot's armature, one number a DoF of the model.
    pub armature: Vec<f64>,
}

/// Armature for one degree of freedom.
#[derive(Debug, Clone, PartialEq)]
pub struct Added {
    /// Its name.
    pub joint: String,
    /// What the model has already (kg m², kg).
    pub authored: f64,
    /// What to add (kg m², kg).
    pub added: f64,
    /// The same against the median of H_dd over the joint limits.
    pub inflation: f64,
}

/// The least armature that fulfils a goal over the joint limits; none if no armature does.
///
/// Errors: [`StudyError`] if the study does not fit the model.
///
/// ```
/// use eigenbody::{Family, Reduction};
/// use eigenbody::search::Effort;
/// use eigenbody_study::diagnosis::{Goal, least_armature};
/// let arm = Family::hydra(2, 1.0, 0.0, 1.0)?.model::<f64>()?;
/// let effort = Effort { samples: 64, ..Effort::default() };
/// let advice = least_armature(&arm, Reduction::default(), Goal::Kappa(20.0), effort)?.unwrap();
/// assert!(advice.reached <= 20.0 && advice.added[1].added > 0.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn least_armature(
    model: &Model<f64>,
    reduction: Reduction,
    goal: Goal,
    effort: Effort,
) -> Result<Option<Advice>, StudyError> {
    let rows = reduction.dofs(model);
    let domain = Domain::new(model, reduction.mimic);
    let effort = Effort { samples: effort.samples.min(512), starts: effort.starts.min(6), ..effort };
    let mut configurations: Vec<Vec<f64>> = vec![model.neutral()];
    configurations.push(domain.configuration(&domain.point(&vec![0.5; domain.dimensions()])));
    let search = |model: &Model<f64>, seed: u32| -> Result<(Vec<f64>, f64), StudyError> {
        let effort = Effort { seed: effort.seed.wrapping_add(seed), ..effort };
        let found = survey(model, reduction, &Metric::Euclidean, effort, |_| ())?;
        let measure = if matches!(goal, Goal::Kappa(_)) { Measure::Kappa } else { Measure::LambdaMin };
        let spread = found.spreads.into_iter().find(|spread| spread.measure == measure);
        Ok(spread.map_or_else(|| (model.neutral(), f64::NAN), |spread| (spread.at, spread.worst)))
    };
    let mut programme = Programme::new(model, reduction, &domain, effort.seed)?;
    let mut checked = 0;
    for round in 0..SEARCHES {
        let Some(added) = programme.mend(model, &rows, goal, &configurations)? else { return Ok(None) };
        let mut armature = model.armature().to_vec();
        rows.iter().zip(&added).for_each(|(&d, a)| armature[d] += a);
        let mended = model.clone().with_armature(armature.clone())?;
        let (at, reached) = search(&mended, round as u32)?;
        checked += effort.samples as usize;
        if goal.holds(reached) || round + 1 == SEARCHES {
            let entry = |k: usize| Added {
                joint: model.dof_name(rows[k]),
                authored: model.armature()[rows[k]],
                added: added[k],
                inflation: added[k] / programme.size[k],
            };
            let added = (0..rows.len()).map(entry).collect();
            return Ok(goal.holds(reached).then_some(Advice { goal, added, checked, reached, armature }));
        }
        configurations.push(at);
    }
    Ok(None)
}

impl Goal {
    fn holds(self, reached: f64) -> bool {
        match self {
            Self::LambdaMin(least) => reached >= least,
            Self::Kappa(most) => reached <= most,
        }
    }

    /// How far a configuration falls short; not above zero if it does not.
    fn shortfall(self, lambda_min: f64, lambda_max: f64) -> f64 {
        match self {
            Self::LambdaMin(least) => 1.0 - lambda_min / (least * (1.0 + MARGIN)),
            Self::Kappa(most) => 1.0 - lambda_min * most / ((1.0 + MARGIN) * lambda_max),
        }
    }
}

/// A row: Σ c_d a_d ≥ b.
struct Cut {
    c: Vec<f64>,
    b: f64,
}

/// The rows so far.
struct Programme {
    reduction: Reduction,
    /// Median of H_dd.
    size: Vec<f64>,
    cuts: Vec<Cut>,
}

impl Programme {
    fn new(
        model: &Model<f64>,
        reduction: Reduction,
        domain: &Domain<'_>,
        seed: u32,
    ) -> Result<Self, StudyError> {
        let n = reduction.dofs(model).len();
        let mut diagonals: Vec<Vec<f64>> = vec![Vec::new(); n];
        let mut random = eigenbody::model::Random::new(u64::from(seed));
        for _ in 0..33 {
            let u: Vec<f64> = (0..domain.dimensions()).map(|_| random.uniform()).collect();
            let H = reduction.mass_matrix(model, &domain.configuration(&domain.point(&u)))?;
            diagonals.iter_mut().enumerate().for_each(|(d, own)| own.push(H[(d, d)]));
        }
        let largest = diagonals.iter().flatten().fold(0.0f64, |m, &h| m.max(h));
        let median = |mut own: Vec<f64>| {
            own.sort_by(f64::total_cmp);
            // A joint without inertia has no size of its own.
            own[own.len() / 2].max(1e-9 * largest)
        };
        Ok(Self { reduction, size: diagonals.into_iter().map(median).collect(), cuts: Vec::new() })
    }

    /// The least armature for all rows and these configurations; none if there is none.
    fn mend(
        &mut self,
        model: &Model<f64>,
        rows: &[usize],
        goal: Goal,
        configurations: &[Vec<f64>],
    ) -> Result<Option<Vec<f64>>, StudyError> {
        let mut added = self.solve();
        for _ in 0..ROUNDS {
            let Some(a) = &added else { return Ok(None) };
            let mut armature = model.armature().to_vec();
            rows.iter().zip(a).for_each(|(&d, a)| armature[d] += a);
            let mended = model.clone().with_armature(armature)?;
            let found: Result<Vec<_>, StudyError> =
                configurations.par_iter().map(|q| self.cut(&mended, goal, q, a)).collect();
            let mut cuts: Vec<(f64, Cut)> = found?.into_iter().flatten().collect();
            if cuts.is_empty() {
                return Ok(added);
            }
            cuts.sort_by(|x, y| y.0.total_cmp(&x.0));
            self.cuts.extend(cuts.into_iter().take(CUTS).map(|(_, cut)| cut));
            added = self.solve();
        }
        Ok(None)
    }

    /// The row that a configuration violates, and by how much.
    fn cut(
        &self,
        mended: &Model<f64>,
        goal: Goal,
        q: &[f64],
        a: &[f64],
    ) -> Result<Option<(f64, Cut)>, StudyError> {
        let question = eigenbody::Question { reduction: self.reduction, ..eigenbody::Question::default() };
        let verdict = conditioning_at(mended, q, &question)?;
        let (min, max) = (verdict.lambda_min.unwrap_or(0.0), verdict.lambda_max.unwrap_or(0.0));
        let shortfall = goal.shortfall(min, max);
        if shortfall <= TOLERANCE {
            return Ok(None);
        }
        let H = self.reduction.mass_matrix(mended, q)?;
        let softest = match verdict.softest.filter(|_| verdict.lambda_min.is_some()) {
            Some(x) => x,
            None => {
                let pairs = eigenbody::spectrum::eigen(&H, &vec![1.0; a.len()])?;
                pairs.vectors.row(0).to_vec()
            }
        };
        let stiffest = verdict.stiffest.unwrap_or_default();
        let already = |x: &[f64]| a.iter().zip(x).map(|(a, x)| a * x * x).sum::<f64>();
        let cut = match goal {
            Goal::LambdaMin(least) => {
                let wanted = least * (1.0 + MARGIN);
                Cut { c: softest.iter().map(|x| x * x).collect(), b: wanted - min + already(&softest) }
            }
            Goal::Kappa(most) => {
                let K = most / (1.0 + MARGIN);
                let pairs = softest.iter().zip(&stiffest);
                let c = pairs.map(|(x, y)| K * x * x - y * y).collect();
                Cut { c, b: max - already(&stiffest) - K * (min - already(&softest)) }
            }
        };
        Ok(Some((shortfall, cut)))
    }

    /// The optimum of the rows so far, in units of each joint's own inertia.
    fn solve(&self) -> Option<Vec<f64>> {
        let mut problem = Problem::new(OptimizationDirection::Minimize);
        let variables: Vec<_> =
            self.size.iter().map(|_| problem.add_var(1.0, (0.0, f64::INFINITY))).collect();
        for Cut { c, b } in &self.cuts {
            let scaled: Vec<f64> = c.iter().zip(&self.size).map(|(c, s)| c * s).collect();
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
        Some(variables.iter().zip(&self.size).map(|(&v, s)| solution.var_value(v).max(0.0) * s).collect())
    }
}

//! The least change that mends a robot: armature, one link's inertia, or a limit.
//!
//! ```text
//! least cost · z,  z in a cone                          so that at every configuration, for every x
//! λmin ≥ ℓ:          xᵀ ∂H(z) x ≥ ℓ − xᵀHx                                                       xᵀx = 1
//! κ ≤ K:             K xᵀ∂H(z)x − yᵀ∂H(z)y ≥ yᵀHy − K xᵀHx                      for every y with yᵀy = 1 besides
//! step h is stable:  4 xᵀ∂H(z)x ≥ xᵀ(h²K + 2hΔ)x − 4xᵀHx
//! ```
//! H is linear in armature and in every link's inertia, so each is a row of a linear programme, one for each mode. Rows are added for the
//! modes of configurations that fail, until none fails; then the worst configurations of the mended robot are searched for, and the
//! loop goes on with those (Kelley's cutting planes). The optimum is that of all configurations that were looked at. Without a
//! floating base xᵀHx is concave in a link's inertia, not linear; the same rows then still cut off nothing that is allowed.

mod limit;
mod programme;
mod remedy;

pub use limit::LimitAdvice;
pub use remedy::LinkAdvice;

use super::stepping::worst_step;
use crate::StudyError;
use eigenbody::search::{Domain, Effort, Measure, sample_points, survey};
use eigenbody::stability::{Impedance, Integrator, Spring};
use eigenbody::{InputError, Metric, Model, Question, Reduction, conditioning_at};
use programme::Programme;
use remedy::Remedy;
use std::ops::ControlFlow;

/// Searches for the worst of the mended robot.
const SEARCHES: usize = 40;
/// The same where a single link is to do what all joints may: it does soon or not at all.
const SEARCHES_OF_A_LINK: usize = 6;
/// Configurations to begin with.
const FIRST: u32 = 30;
/// Links whose inertia is tried.
const LINKS: usize = 4;

/// What a robot should fulfil in every configuration, in the Euclidean metric.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Goal {
    /// λmin of at least this (kg m²).
    LambdaMin(f64),
    /// κ of at most this.
    Kappa(f64),
    /// A stable step of this length (s) by a method of Euler's kind.
    Step(f64, Integrator),
}

/// A goal, and how to look whether it is fulfilled.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wish<'a> {
    /// Which degrees of freedom.
    pub reduction: Reduction,
    /// What is wanted.
    pub goal: Goal,
    /// How hard to search.
    pub effort: Effort,
    /// What steps have to bear.
    pub springs: &'a [Spring],
}

/// Armature that fulfils a goal.
#[derive(Debug, Clone, PartialEq)]
pub struct Advice {
    /// What was asked for.
    pub goal: Goal,
    /// What to add, one entry a degree of freedom of the study.
    pub added: Vec<Added>,
    /// What is added against H_dd, over all joints together: the kinetic energy of equal joint rates grows by this part.
    pub energy: f64,
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
    /// The least that would do if no joint had any; none where the model has none, or no armature does.
    pub needed: Option<f64>,
    /// What to add (kg m², kg).
    pub added: f64,
    /// The same against the median of H_dd over the joint limits.
    pub inflation: f64,
}

/// All ways that were found.
#[derive(Debug, Clone, PartialEq)]
pub struct Remedies {
    /// The least armature; none if no armature does.
    pub armature: Option<Advice>,
    /// Single links whose inertia does, the smallest change first.
    pub links: Vec<LinkAdvice>,
    /// Single limits that do, the smallest loss first.
    pub limits: Vec<LimitAdvice>,
}

/// What is changed on a robot.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Change {
    /// Armature on its joints.
    #[default]
    Armature,
    /// Inertia of a single link.
    Link,
    /// The limits of a single joint.
    Limit,
}

impl Remedies {
    /// True if nothing does what is wanted.
    pub fn is_empty(&self) -> bool {
        self.armature.is_none() && self.links.is_empty() && self.limits.is_empty()
    }

    /// The robot with the smallest change of a kind; none if no such change does. Errors: none for the robot that was examined.
    pub fn mend(&self, model: &Model<f64>, change: Change) -> Result<Option<Model<f64>>, InputError> {
        let model = model.clone();
        let mended = match change {
            Change::Armature => {
                self.armature.as_ref().map(|advice| model.with_armature(advice.armature.clone()))
            }
            Change::Link => self.links.first().map(|link| model.with_inertia(link.index, link.mended)),
            Change::Limit => {
                self.limits.first().map(|limit| model.with_limits(limit.index, Some(limit.kept)))
            }
        };
        mended.transpose()
    }
}

/// The least armature that fulfils a goal over the joint limits; none if no armature does.
///
/// Errors: [`StudyError`] if the study does not fit the model.
///
/// ```
/// use eigenbody::{Family, Reduction};
/// use eigenbody::search::Effort;
/// use eigenbody_study::diagnosis::{Goal, Wish, least_armature};
/// let arm = Family::hydra(2, 1.0, 0.0, 1.0)?.model::<f64>()?;
/// let effort = Effort { samples: 64, ..Effort::default() };
/// let wish = Wish { reduction: Reduction::default(), goal: Goal::Kappa(20.0), effort, springs: &[] };
/// let advice = least_armature(&arm, &wish)?.unwrap();
/// assert!(advice.reached <= 20.0 && advice.added[1].added > 0.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn least_armature(model: &Model<f64>, wish: &Wish<'_>) -> Result<Option<Advice>, StudyError> {
    let judge = Judge::new(model, wish)?;
    let remedy = Remedy::armature(model, &judge)?;
    let Some(found) = least(model, &judge, &remedy)? else { return Ok(None) };
    let rows = wish.reduction.dofs(model);
    let bare = rows.iter().any(|&d| model.armature()[d] > 0.0);
    let needed = match bare {
        true => {
            let bare = model.clone().with_armature(vec![0.0; model.nv()])?;
            least(&bare, &judge, &Remedy::armature(&bare, &judge)?)?
        }
        false => None,
    };
    let size: Vec<f64> = remedy.costs().iter().map(|cost| 1.0 / cost).collect();
    let entry = |k: usize| Added {
        joint: model.dof_name(rows[k]),
        authored: model.armature()[rows[k]],
        needed: needed.as_ref().map(|needed| needed.change[k]),
        added: found.change[k],
        inflation: found.change[k] / size[k],
    };
    let mended = remedy.applied(model, &found.change)?;
    Ok(Some(Advice {
        goal: wish.goal,
        added: (0..rows.len()).map(entry).collect(),
        energy: found.change.iter().sum::<f64>() / size.iter().sum::<f64>(),
        checked: found.checked,
        reached: found.reached,
        armature: mended.armature().to_vec(),
    }))
}

/// The least armature, and what else would do: more inertia of a single link, a limit on a single joint.
///
/// Links are those that carry the softest motion where the goal is missed most; joints those between the two that move most there.
///
/// Errors: [`StudyError`] if the study does not fit the model.
pub fn remedies(model: &Model<f64>, wish: &Wish<'_>) -> Result<Remedies, StudyError> {
    let judge = Judge::new(model, wish)?;
    let armature = least_armature(model, wish)?;
    let (at, reached) = judge.worst(model, 0)?;
    if wish.goal.holds(reached) || at.len() != model.nq() {
        return Ok(Remedies { armature, links: Vec::new(), limits: Vec::new() });
    }
    let soft = judge.softest(model, &at)?;
    let mut links = Vec::new();
    for body in remedy::carriers(model, wish.reduction, &at, &soft)?.into_iter().take(LINKS) {
        let remedy = Remedy::matter(model, body);
        if let Some(found) = least(model, &judge, &remedy)? {
            links.push(LinkAdvice::new(model, &remedy, body, &found)?);
        }
    }
    links.sort_by(|a, b| a.cost.total_cmp(&b.cost));
    let limits = limit::limits(model, &judge, &at, &soft)?;
    Ok(Remedies { armature, links, limits })
}

/// A change that does what is wanted.
struct Found {
    change: Vec<f64>,
    reached: f64,
    checked: usize,
}

/// The least change of one kind; none if there is none.
fn least(model: &Model<f64>, judge: &Judge<'_>, remedy: &Remedy) -> Result<Option<Found>, StudyError> {
    let domain = Domain::new(model, judge.wish.reduction.mimic);
    let points = sample_points(&domain, FIRST, judge.effort.seed);
    let mut configurations: Vec<Vec<f64>> = points.iter().map(|point| domain.configuration(point)).collect();
    let mut programme = Programme::new(judge, remedy);
    let mut checked = 0;
    let searches = if remedy.is_of_one_link() { SEARCHES_OF_A_LINK } else { SEARCHES };
    for round in 0..searches {
        let Some(change) = programme.mend(model, &configurations)? else { return Ok(None) };
        let mended = remedy.applied(model, &change)?;
        let (at, reached) = judge.worst(&mended, round as u32)?;
        checked += judge.effort.samples as usize;
        if judge.wish.goal.holds(reached) {
            return Ok(Some(Found { change, reached, checked }));
        }
        configurations.push(at);
    }
    Ok(None)
}

/// Says whether a robot fulfils a wish.
pub(super) struct Judge<'a> {
    wish: &'a Wish<'a>,
    /// A little less than for a diagnosis: many robots are looked at.
    effort: Effort,
    impedance: Impedance,
}

impl<'a> Judge<'a> {
    fn new(model: &Model<f64>, wish: &'a Wish<'a>) -> Result<Self, StudyError> {
        let effort = wish.effort;
        let effort = Effort { samples: effort.samples.min(512), starts: effort.starts.min(6), ..effort };
        Ok(Self { wish, effort, impedance: Impedance::new(model, wish.reduction, wish.springs)? })
    }

    /// The configuration in which a robot is farthest from the goal, and the goal's measure there.
    fn worst(&self, model: &Model<f64>, seed: u32) -> Result<(Vec<f64>, f64), StudyError> {
        let effort = Effort { seed: self.effort.seed.wrapping_add(seed), ..self.effort };
        let reduction = self.wish.reduction;
        let measure = match self.wish.goal {
            Goal::Step(_, integrator) => {
                let found =
                    survey(model, reduction, &Metric::Euclidean, effort, |_| ControlFlow::Continue(()))?;
                let known: Vec<Vec<f64>> = found.spreads.into_iter().map(|spread| spread.at).collect();
                let (step, at) = worst_step(model, reduction, &self.impedance, integrator, effort, &known)?;
                return Ok((if at.is_empty() { model.neutral() } else { at }, step));
            }
            Goal::Kappa(_) => Measure::Kappa,
            Goal::LambdaMin(_) => Measure::LambdaMin,
        };
        let found = survey(model, reduction, &Metric::Euclidean, effort, |_| ControlFlow::Continue(()))?;
        let spread = found.spreads.into_iter().find(|spread| spread.measure == measure);
        Ok(spread.map_or_else(|| (model.neutral(), f64::NAN), |spread| (spread.at, spread.worst)))
    }

    /// The softest mode, xᵀx = 1, of H in the degrees of freedom of the study.
    fn softest(&self, model: &Model<f64>, q: &[f64]) -> Result<Vec<f64>, StudyError> {
        let question = Question { reduction: self.wish.reduction, ..Question::default() };
        let verdict = conditioning_at(model, q, &question)?;
        match verdict.softest.filter(|_| verdict.lambda_min.is_some()) {
            Some(x) => Ok(x),
            None => {
                let H = self.wish.reduction.mass_matrix(model, q)?;
                let pairs = eigenbody::spectrum::eigen(&H, &vec![1.0; H.rows()])?;
                Ok(pairs.vectors.row(0).to_vec())
            }
        }
    }
}

impl Goal {
    fn holds(self, reached: f64) -> bool {
        match self {
            Self::LambdaMin(least) | Self::Step(least, _) => reached >= least,
            Self::Kappa(most) => reached <= most,
        }
    }
}

//! The worst of all configurations, by samples and descent.

use super::descent::{Landscape, descend};
use super::domain::{Domain, Point};
use super::evaluate::{Evaluator, tell};
use crate::conditioning::{Measure, Values};
use crate::dynamics::Reduction;
use crate::error::Error;
use crate::model::{Model, Random};
use crate::spectrum::Metric;
use rayon::prelude::*;
use std::ops::ControlFlow;

/// How hard to search.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Effort {
    /// Configurations sampled, at most 65,536.
    pub samples: u32,
    /// Descents for each measure.
    pub starts: usize,
    /// Evaluations that a descent may take.
    pub looks: usize,
    /// Another seed, another sample.
    pub seed: u32,
}

impl Default for Effort {
    fn default() -> Self {
        Self { samples: 2048, starts: 12, looks: 120, seed: 1 }
    }
}

/// A measure over all configurations.
#[derive(Debug, Clone, PartialEq)]
pub struct Spread {
    /// What is measured.
    pub measure: Measure,
    /// The worst value found; κ and κ′ are infinite where λmin cannot be told from zero.
    pub worst: f64,
    /// Where: all coordinates.
    pub at: Vec<f64>,
    /// Median over the samples.
    pub median: f64,
    /// The value that nine of ten samples do not exceed in badness.
    pub tenth: f64,
}

/// What a search found.
#[derive(Debug, Clone, PartialEq)]
pub struct Survey {
    /// One for each of [`Measure::ALL`], in that order.
    pub spreads: [Spread; 3],
    /// Configurations evaluated, descents included.
    pub evaluations: usize,
}

/// The worst configurations of a robot within its joint limits, by κ, κ′ and λmin.
///
/// ```text
/// Sobol sequence with Owen scrambling -> the worst few by each measure, the neutral configuration, the middle of all limits
/// -> BFGS descent of 1/κ, 1/κ′, λmin with exact gradients
/// ```
/// A measure of a robot is a lower bound on how bad it gets: searches are not proofs. Deterministic by seed and the same on any
/// number of threads. Cost about samples · 25 sweeps, and as much for the descents. `progress` is told of configurations as they are
/// evaluated, from any thread.
///
/// Errors: [`Error`] if the metric does not fit or a floating base is missing; [`Error::Interrupted`] soon after `progress` breaks.
///
/// ```
/// use eigenbody::search::{Effort, survey};
/// use eigenbody::{Family, Metric, Reduction};
/// use std::ops::ControlFlow::Continue;
/// let robot = Family::hydra(3, 1.0, 0.0, 1.0)?.model::<f64>()?;
/// let effort = Effort { samples: 256, ..Effort::default() };
/// let found = survey(&robot, Reduction::default(), &Metric::Euclidean, effort, |_| Continue(()))?;
/// // Worst stretched out.
/// assert!((found.spreads[0].worst / 306.059931290818 - 1.0).abs() < 1e-9);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn survey(
    model: &Model<f64>,
    reduction: Reduction,
    metric: &Metric<f64>,
    effort: Effort,
    progress: impl Fn(usize) -> ControlFlow<()> + Sync,
) -> Result<Survey, Error> {
    let domain = Domain::new(model, reduction.mimic);
    let evaluator = Evaluator::new(model, reduction, metric.clone())?;
    let samples = sample(&domain, &evaluator, effort, &progress)?;
    let mut evaluations = samples.len();
    let mut of = |measure| {
        let (spread, looks) = worst(&domain, &evaluator, &samples, measure, effort, &progress)?;
        evaluations += looks;
        Ok::<_, Error>(spread)
    };
    let spreads = [of(Measure::ALL[0])?, of(Measure::ALL[1])?, of(Measure::ALL[2])?];
    Ok(Survey { spreads, evaluations })
}

type Sampled = (Point, Values);

fn sample(
    domain: &Domain<'_>,
    evaluator: &Evaluator<'_>,
    effort: Effort,
    progress: &(impl Fn(usize) -> ControlFlow<()> + Sync),
) -> Result<Vec<Sampled>, Error> {
    let points = sample_points(domain, effort.samples, effort.seed);
    let all: Vec<Vec<f64>> = points.par_iter().map(|point| domain.configuration(point)).collect();
    let values = evaluator.values_of_all(&all, progress)?;
    Ok(points.into_iter().zip(values).collect())
}

/// The neutral configuration, the middle of all limits, and so many points of a scrambled Sobol sequence (1 to 65,536).
pub fn sample_points(domain: &Domain<'_>, samples: u32, seed: u32) -> Vec<Point> {
    // The first two are configurations that people use.
    let first = [domain.nearest(&domain.model().neutral()), domain.point(&vec![0.5; domain.dimensions()])];
    let drawn =
        (0..samples.clamp(1, 65_536)).map(|index| domain.point(&cube(index, domain.dimensions(), seed)));
    first.into_iter().chain(drawn).collect()
}

/// A point of the unit cube: Sobol's sequence, scrambled; beyond its 256 dimensions, random.
fn cube(index: u32, dimensions: usize, seed: u32) -> Vec<f64> {
    let mut random = Random::new(u64::from(seed) << 32 | u64::from(index));
    let coordinate = |k: usize| match u32::try_from(k) {
        Ok(k) if k < sobol_burley::NUM_DIMENSIONS => f64::from(sobol_burley::sample(index, k, seed)),
        _ => random.uniform(),
    };
    (0..dimensions).map(coordinate).collect()
}

/// The worst by one measure, and the evaluations it took.
fn worst(
    domain: &Domain<'_>,
    evaluator: &Evaluator<'_>,
    samples: &[Sampled],
    measure: Measure,
    effort: Effort,
    progress: &(impl Fn(usize) -> ControlFlow<()> + Sync),
) -> Result<(Spread, usize), Error> {
    let mut order: Vec<usize> = (0..samples.len()).collect();
    order.sort_by(|&a, &b| samples[a].1.cost(measure).total_cmp(&samples[b].1.cost(measure)));
    // The neutral and the middle configuration always, then the worst.
    let mut starts = vec![0, 1];
    starts.extend(order.iter().copied().filter(|&k| k > 1).take(effort.starts));
    let ends: Vec<(Point, f64, usize)> = starts
        .into_par_iter()
        .map(|start| {
            let evaluator = evaluator.clone();
            let mut land = Ground { domain, evaluator, measure, progress, looks: 0, error: None };
            let (point, values) = &samples[start];
            let found = descend(&mut land, point, effort.looks);
            match land.error {
                Some(error) => Err(error),
                None => {
                    let (point, cost) = found.unwrap_or((point.clone(), values.cost(measure)));
                    Ok((point, cost, land.looks))
                }
            }
        })
        .collect::<Result<_, Error>>()?;
    let looks = ends.iter().map(|end| end.2).sum();
    // A descent may end where λmin is no longer resolved; the sample it came from may be worse by its own count.
    let best_sample = &samples[order[0]];
    let best = ends.iter().min_by(|a, b| a.1.total_cmp(&b.1));
    let at = match best {
        Some((point, cost, _)) if *cost <= best_sample.1.cost(measure) => point,
        _ => &best_sample.0,
    };
    let q = domain.configuration(at);
    let worst = evaluator.measure(&q, measure)?;
    let middle = |part: f64| {
        let place = ((samples.len() - 1) as f64 * part).round() as usize;
        samples[order[place]].1.of(measure)
    };
    Ok((Spread { measure, worst, at: q, median: middle(0.5), tenth: middle(0.1) }, looks))
}

/// The cost of a measure over the domain.
struct Ground<'a, 'm, P> {
    domain: &'a Domain<'m>,
    evaluator: Evaluator<'m>,
    measure: Measure,
    progress: &'a P,
    looks: usize,
    error: Option<Error>,
}

impl<P: Fn(usize) -> ControlFlow<()>> Landscape for Ground<'_, '_, P> {
    type Point = Point;

    fn look(&mut self, at: &Point) -> Option<(f64, Vec<f64>)> {
        self.looks += 1;
        let q = self.domain.configuration(at);
        let found = tell(self.progress, 1).and_then(|()| self.evaluator.cost_gradient(&q, self.measure));
        match found {
            Ok(found) => found.map(|(cost, mut gradient)| {
                self.domain.pull_back(at, &mut gradient);
                (cost, gradient)
            }),
            Err(error) => {
                self.error = Some(error);
                None
            }
        }
    }

    fn moved(&self, from: &Point, step: &[f64]) -> Point {
        self.domain.moved(from, step)
    }
}

//! The measures of a configuration, and their gradients.
//!
//! ```text
//! dλ = vᵀ dH v − λ Σ x_d² dB_dd        x the mode, xᵀBx = 1;  v = G x, with the base's own motion where it is removed
//! dB_dd = e_dᵀ dH e_d                   where B = diag(H), else zero;  e_d moved along in the same way
//! d(λmin/λmax) = (dλmin − λmin/λmax dλmax)/λmax
//! ```
//! Every vᵀ dH v is twice a gradient of the kinetic energy, O(N). The base needs no term of its own: its motion makes the energy
//! stationary.

use crate::batch::{Batch, BatchError};
use crate::conditioning::{Measure, Values};
use crate::conditioning::{Method, Question, conditioning_at};
use crate::dynamics::{BASE, GradientWorkspace, Reduction, kinetic_energy_gradient_into, mass_matrix};
use crate::error::{Error, InputError};
use crate::factor::Cholesky;
use crate::matrix::Matrix;
use crate::model::Model;
use crate::spectrum::sturm::{Diagonal, Pencil};
use crate::spectrum::{Metric, Precision, extreme_values};
use rayon::prelude::*;
use std::ops::ControlFlow;

/// Up to so many degrees of freedom a dense matrix in lanes is faster than counts on the tree.
const LARGEST_DENSE: usize = 96;
/// Relative error of κ that a sample may have.
const ACCURACY: f64 = 1e-9;
/// Samples between two reports of progress.
const AT_ONCE: usize = 512;

/// Tells of configurations that are evaluated; an error where no more are wanted.
pub(super) fn tell(progress: &impl Fn(usize) -> ControlFlow<()>, evaluated: usize) -> Result<(), Error> {
    match progress(evaluated) {
        ControlFlow::Continue(()) => Ok(()),
        ControlFlow::Break(()) => Err(Error::Interrupted),
    }
}

/// Measures a robot in one configuration after another.
#[derive(Debug, Clone)]
pub struct Evaluator<'m> {
    model: &'m Model<f64>,
    reduction: Reduction,
    metric: Metric<f64>,
    tree: Option<(Pencil<'m, f64>, Diagonal<f64>)>,
    workspace: GradientWorkspace<f64>,
    one: Vec<f64>,
}

impl<'m> Evaluator<'m> {
    /// For a robot, the degrees of freedom that are studied, and the metric of κ.
    ///
    /// Errors: [`InputError`] if there is no floating base to remove.
    pub fn new(model: &'m Model<f64>, reduction: Reduction, metric: Metric<f64>) -> Result<Self, InputError> {
        let coupled = reduction.mimic && model.coupling().is_some();
        let tree = if coupled || model.nv() == 0 {
            None
        } else {
            let pencil = Pencil::euclidean(model, &model.neutral(), reduction.base)?;
            let diagonal = Diagonal::new(&pencil);
            Some((pencil, diagonal))
        };
        let (workspace, one) = (GradientWorkspace::new(model), vec![0.0; model.nv()]);
        Ok(Self { model, reduction, metric, tree, workspace, one })
    }

    /// The measures at q.
    ///
    /// Method: counts alone, about 12 sweeps each for κ and κ′; from the matrix where mimic joints follow.
    ///
    /// Errors: [`Error`] if q or the metric does not fit.
    pub fn values(&mut self, q: &[f64]) -> Result<Values, Error> {
        let Self { metric, tree, .. } = self;
        let Some((pencil, diagonal)) = tree else {
            let question = Question { method: Method::Dense, ..self.question(self.metric.clone()) };
            let verdict = conditioning_at(self.model, q, &question)?;
            return Ok(Values {
                lambda_min: verdict.lambda_min.unwrap_or(0.0),
                lambda_max: verdict.lambda_max.unwrap_or(0.0),
                kappa_weighted: verdict.kappa_weighted.unwrap_or(f64::INFINITY),
            });
        };
        pencil.update(q)?;
        let own = diagonal.update(pencil);
        let has_zero = own[pencil.removed()..].iter().any(|&h| h <= 0.0);
        pencil.set_metric(&pencil.weights(metric, own)?)?;
        let (least, lambda_max) = extreme_values(pencil, own);
        if has_zero {
            return Ok(Values { lambda_min: 0.0, lambda_max, kappa_weighted: f64::INFINITY });
        }
        pencil.set_metric(own)?;
        let (least_weighted, weighted) = extreme_values(pencil, own);
        Ok(Values {
            lambda_min: least.unwrap_or(0.0),
            lambda_max,
            kappa_weighted: least_weighted.map_or(f64::INFINITY, |least| weighted / least),
        })
    }

    /// The measures at each of many q, on all cores; tells `progress` how many more are done, and ends if it breaks.
    ///
    /// Method: [`Batch::conditioning`] where all degrees of freedom take part and H is small; else [`values`](Self::values), one by one.
    ///
    /// Errors: as [`values`](Self::values), of the first q that does not fit; [`Error::Interrupted`].
    pub fn values_of_all(
        &self,
        all: &[Vec<f64>],
        progress: &(impl Fn(usize) -> ControlFlow<()> + Sync),
    ) -> Result<Vec<Values>, Error> {
        // Without a tree of counts, mimic joints follow.
        if self.reduction.base || self.tree.is_none() || self.model.nv() > LARGEST_DENSE {
            let one = |evaluator: &mut Self, q: &Vec<f64>| {
                tell(progress, 1)?;
                evaluator.values(q)
            };
            return all.par_iter().map_init(|| self.clone(), one).collect();
        }
        let (batch, mut values) = (Batch::new(self.model), Vec::with_capacity(all.len()));
        for some in all.chunks(AT_ONCE) {
            let mut found =
                vec![Values { lambda_min: 0.0, lambda_max: 0.0, kappa_weighted: 0.0 }; some.len()];
            let done = batch.conditioning(&some.concat(), &self.metric, ACCURACY, &mut found);
            done.map_err(|error| match error {
                BatchError::Shape(error) => error.into(),
                BatchError::Configuration { error, .. } => error,
            })?;
            tell(progress, some.len())?;
            values.extend(found);
        }
        Ok(values)
    }

    /// A measure at q with all the care there is: infinite κ or κ′, or zero λmin, where the error estimate says that nothing is known.
    ///
    /// Method: [`conditioning_at`]; [`values`](Self::values) counts alone and does not ask what its counts are worth.
    ///
    /// Errors: as [`values`](Self::values).
    pub fn measure(&self, q: &[f64], measure: Measure) -> Result<f64, Error> {
        let own_units = measure == Measure::KappaWeighted;
        let metric = if own_units { Metric::UnitDiagonal } else { self.metric.clone() };
        let question = Question { precision: Precision::Auto, ..self.question(metric) };
        let verdict = match conditioning_at(self.model, q, &question) {
            Ok(verdict) => verdict,
            Err(Error::Input(InputError::NotPositive { .. })) if own_units => return Ok(f64::INFINITY),
            Err(error) => return Err(error),
        };
        Ok(match measure {
            Measure::LambdaMin => verdict.lambda_min.unwrap_or(0.0),
            Measure::Kappa | Measure::KappaWeighted => verdict.kappa.unwrap_or(f64::INFINITY),
        })
    }

    /// [`Values::cost`] of a measure at q, and its gradient along the independent DoFs, a floating base's included (as zeros).
    ///
    /// None where λmin is not resolved. Errors: as [`values`](Self::values).
    pub fn cost_gradient(&mut self, q: &[f64], measure: Measure) -> Result<Option<(f64, Vec<f64>)>, Error> {
        let own_units = measure == Measure::KappaWeighted;
        let metric = if own_units { Metric::UnitDiagonal } else { self.metric.clone() };
        let verdict = match conditioning_at(self.model, q, &self.question(metric)) {
            Ok(verdict) => verdict,
            // A DoF without inertia has no unit of its own.
            Err(Error::Input(InputError::NotPositive { .. })) if own_units => return Ok(None),
            Err(error) => return Err(error),
        };
        let (Some(min), Some(max)) = (verdict.lambda_min, verdict.lambda_max) else { return Ok(None) };
        let (Some(softest), Some(stiffest)) = (&verdict.softest, &verdict.stiffest) else { return Ok(None) };
        let H = mass_matrix(self.model, q)?;
        let mut gradient = vec![0.0; self.model.nv()];
        let (down, up, cost) = match measure {
            Measure::LambdaMin => (1.0, 0.0, min),
            Measure::Kappa | Measure::KappaWeighted => (1.0 / max, min / (max * max), min / max),
        };
        self.add(q, &self.lifted(&H, softest)?, down, &mut gradient)?;
        self.add(q, &self.lifted(&H, stiffest)?, -up, &mut gradient)?;
        if own_units || self.metric == Metric::UnitDiagonal {
            for d in 0..softest.len() {
                let weight = up * max * stiffest[d].powi(2) - down * min * softest[d].powi(2);
                let mut one = vec![0.0; softest.len()];
                one[d] = 1.0;
                self.add(q, &self.lifted(&H, &one)?, weight, &mut gradient)?;
            }
        }
        let gradient = match self.model.coupling().filter(|_| self.reduction.mimic) {
            Some(coupling) => coupling.pull_back(&gradient),
            None => gradient,
        };
        Ok(Some((cost, gradient)))
    }

    /// The motion of all DoFs when those of the study move by `x`: mimic joints follow, a removed base floats along.
    ///
    /// Errors: [`Error`] if q or x does not fit, or the base has no inertia.
    pub fn motion(&self, q: &[f64], x: &[f64]) -> Result<Vec<f64>, Error> {
        let expected = self.reduction.dofs(self.model).len();
        if x.len() != expected {
            return Err(InputError::Length { what: "x", expected, found: x.len() }.into());
        }
        // The matrix is needed only where a base floats along.
        let H = if self.reduction.base { mass_matrix(self.model, q)? } else { Matrix::zeros(0, 0) };
        self.lifted(&H, x)
    }

    fn question(&self, metric: Metric<f64>) -> Question {
        let method = if self.tree.is_some() { Method::Sturm } else { Method::Dense };
        Question { metric, reduction: self.reduction, method, precision: Precision::F64, all: false }
    }

    /// gradient += weight · vᵀ (∂H/∂q) v.
    fn add(&mut self, q: &[f64], v: &[f64], weight: f64, gradient: &mut [f64]) -> Result<(), InputError> {
        if weight != 0.0 {
            let Self { model, workspace, one, .. } = self;
            kinetic_energy_gradient_into(model, q, v, workspace, one)?;
            gradient.iter_mut().zip(one).for_each(|(sum, one)| *sum += 2.0 * weight * *one);
        }
        Ok(())
    }

    /// The motion of all DoFs when those of the study move by x.
    fn lifted(&self, H: &Matrix<f64>, x: &[f64]) -> Result<Vec<f64>, Error> {
        let mut v = if self.reduction.base { vec![0.0; BASE] } else { Vec::new() };
        v.extend(x);
        if let Some(coupling) = self.model.coupling().filter(|_| self.reduction.mimic) {
            v = coupling.push_forward(&v);
        }
        if self.reduction.base {
            let momentum = H.times(&v);
            let base = solve_base(H, momentum)?;
            v.iter_mut().zip(base).for_each(|(v, base)| *v -= base);
        }
        Ok(v)
    }
}

/// H_bb⁻¹ b.
fn solve_base(H: &Matrix<f64>, mut b: Vec<f64>) -> Result<Vec<f64>, Error> {
    let mut H_bb = Cholesky::new(BASE);
    H_bb.factor(&Matrix::from_fn(BASE, BASE, |i, j| H[(i, j)]))?;
    b.truncate(BASE);
    H_bb.solve(&mut b)?;
    Ok(b)
}

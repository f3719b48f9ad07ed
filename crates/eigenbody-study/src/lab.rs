//! What an experiment works with: where robots come from, and how much effort to spend.

use eigenbody::spectrum::sturm::Pencil;
use eigenbody::spectrum::{Extremes, Metric, Precision, extremes, slice};
use eigenbody::{BuildError, Error, Family, Matrix, Model, Posture, Reduction, family::FamilyError};
use thiserror::Error;

/// Why an experiment has no result.
#[derive(Debug, Error)]
pub enum StudyError {
    /// A parameter outside a family's range.
    #[error(transparent)]
    Family(#[from] FamilyError),
    /// The robot could not be built.
    #[error(transparent)]
    Build(#[from] BuildError),
    /// An algorithm failed.
    #[error(transparent)]
    Numbers(#[from] Error),
    /// A simulation failed.
    #[error(transparent)]
    Simulation(#[from] crate::simulate::SimulationError),
    /// λmin could not be told from zero.
    #[error("{robot}: λmin is not resolved")]
    Unresolved {
        /// The robot.
        robot: String,
    },
}

impl From<eigenbody::InputError> for StudyError {
    fn from(error: eigenbody::InputError) -> Self {
        Self::Numbers(error.into())
    }
}

/// Where models come from. A test may hand out robots that are a little wrong, to see claims fail.
pub trait Robots: Sync {
    /// The member of a family.
    ///
    /// # Errors
    ///
    /// If the member cannot be built.
    fn model(&self, family: &Family) -> Result<Model<f64>, BuildError>;
}

/// The families as they are.
#[derive(Debug, Clone, Copy, Default)]
pub struct Bench;

impl Robots for Bench {
    fn model(&self, family: &Family) -> Result<Model<f64>, BuildError> {
        family.model()
    }
}

/// The surroundings of an experiment.
#[derive(Clone, Copy)]
pub struct Lab<'a> {
    /// Where robots come from.
    pub robots: &'a dyn Robots,
    /// Fewer points and smaller robots: every claim is still tested.
    pub quick: bool,
}

impl Default for Lab<'_> {
    fn default() -> Self {
        Self { robots: &Bench, quick: false }
    }
}

/// A robot in a posture.
pub(crate) struct Posed {
    pub model: Model<f64>,
    pub q: Vec<f64>,
    pub reduction: Reduction,
}

impl Lab<'_> {
    /// A family's member in a posture. On a floating base the base is removed: H*.
    pub(crate) fn pose(&self, family: &Family, posture: Posture) -> Result<Posed, StudyError> {
        let model = self.robots.model(family)?;
        let q = posture.configuration(&model);
        let reduction = Reduction { base: model.has_floating_base(), mimic: false };
        Ok(Posed { model, q, reduction })
    }

    /// κ of a family's member in a posture.
    pub(crate) fn kappa(&self, family: &Family, posture: Posture) -> Result<f64, StudyError> {
        let posed = self.pose(family, posture)?;
        Ok(posed.ends()?.kappa())
    }
}

/// λmin and λmax with the stiffest mode.
pub(crate) struct Ends {
    pub min: f64,
    pub max: f64,
    /// Of λmax, one number a DoF.
    pub stiffest: Vec<f64>,
}

impl Ends {
    pub fn kappa(&self) -> f64 {
        self.max / self.min
    }
}

impl Posed {
    /// H, or H* on a floating base.
    pub fn mass_matrix(&self) -> Result<Matrix<f64>, StudyError> {
        Ok(self.reduction.mass_matrix(&self.model, &self.q)?)
    }

    fn pencil(&self, metric: &Metric<f64>) -> Result<Pencil<'_, f64>, StudyError> {
        let Self { model, q, reduction } = self;
        let pencil = Pencil::euclidean(model, q, reduction.base)?;
        let B = pencil.weights(metric, &pencil.diagonal())?;
        Ok(pencil.with_metric(B)?)
    }

    /// Both ends of the spectrum, in O(N).
    pub fn ends_in(&self, metric: &Metric<f64>) -> Result<Ends, StudyError> {
        let pencil = self.pencil(metric)?;
        let Extremes { min, max, .. } = extremes(&pencil, Precision::Auto)?;
        let min = min.map_err(|_| StudyError::Unresolved { robot: self.model.name().to_owned() })?.value;
        let stiffest = self.reduction.dofs(&self.model).into_iter().map(|d| max.vector[d]).collect();
        Ok(Ends { min, max: max.value, stiffest })
    }

    /// [`ends_in`](Self::ends_in) the Euclidean metric.
    pub fn ends(&self) -> Result<Ends, StudyError> {
        self.ends_in(&Metric::Euclidean)
    }

    /// κ′.
    pub fn kappa_weighted(&self) -> Result<f64, StudyError> {
        Ok(self.ends_in(&Metric::UnitDiagonal)?.kappa())
    }

    /// All eigenvalues, ascending.
    pub fn eigenvalues(&self) -> Result<Vec<f64>, StudyError> {
        Ok(slice(&self.pencil(&Metric::Euclidean)?))
    }

    /// Diagonal of H, in O(N).
    pub fn diagonal(&self) -> Result<Vec<f64>, StudyError> {
        let own = self.pencil(&Metric::Euclidean)?.diagonal();
        Ok(self.reduction.dofs(&self.model).into_iter().map(|d| own[d]).collect())
    }
}

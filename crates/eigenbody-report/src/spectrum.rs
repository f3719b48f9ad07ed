//! The spectrum of a robot in one configuration: what `eigenbody spectrum` answers.

use eigenbody::{Conditioning, Method, Metric};
use serde::Serialize;
use std::sync::Arc;

/// One mode: a vector over the DoFs, and the DoFs' names in the same order.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ModeReport {
    /// Components in DoF order, xᵀBx = 1, the largest positive.
    pub vector: Vec<f64>,
    /// Name of each DoF.
    pub joints: Arc<[String]>,
    /// Part of each DoF in the mode, B_dd x_d²; they sum to one.
    pub share: Vec<f64>,
}

/// What a result is about: one robot in one configuration.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Subject {
    /// The model as it was asked for.
    pub model: String,
    /// Number of moving bodies.
    pub bodies: usize,
    /// `fixed`, `floating`, or `free-floating` with the base removed.
    pub base: String,
    /// The configuration as it was asked for.
    pub configuration: String,
    /// Its coordinates.
    pub q: Vec<f64>,
}

/// Estimated relative errors.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ErrorEstimate {
    /// Of λmin.
    pub lambda_min: Option<f64>,
    /// Of λmax.
    pub lambda_max: Option<f64>,
}

/// How many eigenvalues lie below a shift.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct CountReport {
    /// The shift σ.
    pub sigma: f64,
    /// Number of eigenvalues below it.
    pub count: usize,
}

/// Loops that were closed, and what they leave.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LoopsReport {
    /// What closes them.
    pub closures: Vec<String>,
    /// Independent conditions on the velocities.
    pub rank: usize,
    /// Degrees of freedom that are left.
    pub freedom: usize,
    /// How far the loops were open in the configuration that was asked for (m, rad).
    pub opened: f64,
    /// How far they are open now.
    pub residual: f64,
    /// Gauss-Newton steps between the two.
    pub steps: usize,
}

/// Everything that `eigenbody spectrum --json` prints. A number that does not exist is `null` and `note` says why.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SpectrumReport {
    /// Which robot, where.
    #[serde(flatten)]
    pub subject: Subject,
    /// Number of degrees of freedom.
    pub dofs: usize,
    /// Metric B.
    pub metric: String,
    /// Unit of the eigenvalues.
    pub unit: &'static str,
    /// How the eigenvalues were computed.
    pub method: &'static str,
    /// Sweeps of eight counts that κ took, by the method `sturm`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub passes: Option<usize>,
    /// Smallest eigenvalue.
    pub lambda_min: Option<f64>,
    /// Largest eigenvalue.
    pub lambda_max: Option<f64>,
    /// Estimated relative errors of both.
    pub error_estimate: ErrorEstimate,
    /// κ.
    pub kappa: Option<f64>,
    /// κ′.
    pub kappa_weighted: Option<f64>,
    /// r.
    pub diagonal_ratio: Option<f64>,
    /// [r, r κ′].
    pub bracket: Option<[f64; 2]>,
    /// All eigenvalues, ascending, if asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub eigenvalues: Option<Vec<f64>>,
    /// The count that was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub count_below: Option<CountReport>,
    /// The mode of the smallest eigenvalue.
    pub softest: Option<ModeReport>,
    /// The mode of the largest eigenvalue.
    pub stiffest: Option<ModeReport>,
    /// Why a number is `null`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub note: Option<String>,
    /// The loops, if they are closed: the numbers are then those of the motions that they allow.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub loops: Option<LoopsReport>,
    /// What is suspicious about the model.
    pub findings: Vec<String>,
}

impl SpectrumReport {
    /// What a [`Conditioning`] says about `subject`; `names` are the DoFs'.
    pub fn new(
        subject: Subject,
        metric: &Metric<f64>,
        unit: &'static str,
        result: &Conditioning<f64>,
        names: Vec<String>,
    ) -> Self {
        let names: Arc<[String]> = names.into();
        let finite = |x: Option<f64>| x.filter(|x| x.is_finite());
        let mut notes = result.notes.clone();
        let ends = result.bracket.map(|(lo, hi)| [lo, hi]);
        let too_large = [result.lambda_max, result.kappa, result.kappa_weighted, ends.map(|[_, hi]| hi)];
        if too_large.into_iter().flatten().any(|x| !x.is_finite()) {
            notes.push("a value exceeds the range of f64".into());
        }
        let mode = |vector: &Vec<f64>| ModeReport {
            vector: vector.clone(),
            joints: Arc::clone(&names),
            share: vector.iter().zip(&result.weights).map(|(x, b)| b * x * x).collect(),
        };
        Self {
            subject,
            dofs: names.len(),
            metric: metric.to_string(),
            unit,
            method: match result.method {
                Method::Sturm => "sturm",
                Method::Dense | Method::Auto => "dense",
            },
            passes: result.passes,
            error_estimate: ErrorEstimate {
                lambda_min: finite(result.error_estimate[0]),
                lambda_max: finite(result.error_estimate[1]),
            },
            lambda_min: finite(result.lambda_min),
            lambda_max: finite(result.lambda_max),
            kappa: finite(result.kappa),
            kappa_weighted: finite(result.kappa_weighted),
            diagonal_ratio: finite(result.diagonal_ratio),
            bracket: ends.filter(|ends| ends.iter().all(|x| x.is_finite())),
            eigenvalues: result.eigenvalues.clone(),
            count_below: None,
            softest: result.softest.as_ref().map(mode),
            stiffest: result.stiffest.as_ref().map(mode),
            note: (!notes.is_empty()).then(|| notes.join("; ")),
            loops: None,
            findings: Vec::new(),
        }
    }

    /// The report as JSON; floats parse back to the same bits.
    ///
    /// # Errors
    ///
    /// Only if the serialiser fails, which plain numbers and strings do not make it do.
    pub fn to_json(&self) -> Result<String, serde_json::Error> {
        serde_json::to_string_pretty(self)
    }
}

//! The spectrum of a robot in one configuration: what `eigenbody spectrum` answers.

use eigenbody::{Conditioning, Metric};
use serde::Serialize;

/// One mode: a vector over the DoFs, and the DoFs' names in the same order.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ModeReport {
    /// Components in DoF order, xᵀBx = 1, the largest positive.
    pub vector: Vec<f64>,
    /// Name of each DoF.
    pub joints: Vec<String>,
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
    pub method: String,
    /// Smallest eigenvalue.
    pub lambda_min: Option<f64>,
    /// Largest eigenvalue.
    pub lambda_max: Option<f64>,
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
    /// The mode of the smallest eigenvalue.
    pub softest: Option<ModeReport>,
    /// The mode of the largest eigenvalue.
    pub stiffest: Option<ModeReport>,
    /// Why a number is `null`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub note: Option<String>,
    /// What is suspicious about the model.
    pub findings: Vec<String>,
}

impl SpectrumReport {
    /// What a [`Conditioning`] says about `subject`. `weights` is the diagonal of B, `names` the DoFs.
    pub fn new(
        subject: Subject,
        metric: &Metric<f64>,
        unit: &'static str,
        result: &Conditioning<f64>,
        weights: &[f64],
        names: &[String],
    ) -> Self {
        let finite = |x: Option<f64>| x.filter(|x| x.is_finite());
        let mode = |vector: &[f64]| ModeReport {
            vector: vector.to_vec(),
            joints: names.to_vec(),
            share: vector.iter().zip(weights).map(|(x, b)| b * x * x).collect(),
        };
        Self {
            subject,
            dofs: names.len(),
            metric: metric.to_string(),
            unit,
            method: "dense".into(),
            lambda_min: finite(result.lambda_min),
            lambda_max: finite(result.lambda_max),
            kappa: finite(result.kappa),
            kappa_weighted: finite(result.kappa_weighted),
            diagonal_ratio: finite(result.diagonal_ratio),
            bracket: result.bracket.map(|(lo, hi)| [lo, hi]).filter(|b| b.iter().all(|x| x.is_finite())),
            eigenvalues: None,
            softest: result.softest().map(mode),
            stiffest: result.stiffest().map(mode),
            note: (!result.notes.is_empty()).then(|| result.notes.join("; ")),
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

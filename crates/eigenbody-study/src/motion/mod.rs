//! Two studies along motions: how good estimators of κ are, and what ill-conditioning costs.

pub mod cost;
pub mod judged;

use eigenbody::{Family, Model, Reduction};

/// A robot of a study.
#[derive(Debug, Clone)]
pub struct Subject {
    /// Its name.
    pub name: String,
    /// What kind of robot it is.
    pub group: Group,
    /// The robot.
    pub model: Model<f64>,
}

/// Kinds of robots.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Group {
    /// A serial chain.
    Chain,
    /// A branched tree.
    Tree,
    /// A robot that exists.
    Robot,
}

impl Group {
    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Chain => "chains",
            Self::Tree => "trees",
            Self::Robot => "robots",
        }
    }
}

impl Subject {
    /// A member of a family.
    pub(crate) fn family(name: String, group: Group, family: &Family) -> Result<Self, crate::StudyError> {
        Ok(Self { name, group, model: family.model()? })
    }

    /// Free-floating robots are studied without their base: H*.
    pub fn reduction(&self) -> Reduction {
        Reduction { base: self.model.has_floating_base(), mimic: false }
    }

    /// Degrees of freedom of H or H*.
    pub fn dofs(&self) -> usize {
        self.reduction().dofs(&self.model).len()
    }
}

/// Spearman's rank correlation; ties share their mean rank.
///
/// ```
/// let found = eigenbody_study::motion::rank_correlation(&[1.0, 2.0, 10.0, 3.0], &[0.1, 0.2, 0.9, 0.5]);
/// assert_eq!(found, 1.0);
/// ```
pub fn rank_correlation(x: &[f64], y: &[f64]) -> f64 {
    crate::estimators::correlation(&ranks(x), &ranks(y))
}

fn ranks(values: &[f64]) -> Vec<f64> {
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.sort_by(|&a, &b| values[a].total_cmp(&values[b]));
    let mut ranks = vec![0.0; values.len()];
    let mut first = 0;
    while first < order.len() {
        let same = order[first..].iter().take_while(|&&k| values[k] == values[order[first]]).count();
        order[first..first + same].iter().for_each(|&k| ranks[k] = first as f64 + 0.5 * (same - 1) as f64);
        first += same;
    }
    ranks
}

/// The p-quantile of some numbers, by the nearest rank; not a number for none.
pub fn quantile(values: &[f64], p: f64) -> f64 {
    let mut sorted: Vec<f64> = values.iter().copied().filter(|x| !x.is_nan()).collect();
    sorted.sort_by(f64::total_cmp);
    match sorted.len() {
        0 => f64::NAN,
        n => sorted[((p * n as f64) as usize).min(n - 1)],
    }
}

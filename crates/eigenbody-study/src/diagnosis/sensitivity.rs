//! Which mass, centre of mass, inertia or armature moves κ most.
//!
//! ```text
//! d log κ = yᵀdH y/λmax − xᵀdH x/λmin          x the softest, y the stiffest mode; dH linear in the parameters
//! ```
//! Parameters of different kinds are compared by what is large for each: a rate is d log κ for a change of
//!
//! | parameter | as large as |
//! |---|---|
//! | mass, its centre and the inertia about it held | the mass |
//! | an entry of the inertia about the centre of mass, on the link's axes | the mean principal moment, tr(I)/3 |
//! | a coordinate of the centre of mass | the radius of gyration, √(tr(I)/2m) |
//! | armature | H_dd of the joint there, what it has of it or not |
//!
//! The rates are exact for small changes only: where a robot is nearly singular, a little armature does more than they can say.

use crate::StudyError;
use eigenbody::dynamics::{InertialGradient, inertial_gradient};
use eigenbody::search::Evaluator;
use eigenbody::{Metric, Model, Question, Reduction, conditioning_at};

/// Most parameters of links, and of joints, that are kept.
const KEPT: usize = 20;

/// What can be changed about a robot.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Parameter {
    /// A link's mass.
    Mass,
    /// A coordinate of its centre of mass: x, y, z.
    Centre(usize),
    /// An entry of its inertia about it: xx, yy, zz, xy, xz, yz.
    Inertia(usize),
    /// A joint's armature.
    Armature,
}

impl Parameter {
    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Mass => "mass",
            Self::Centre(k) => ["com x", "com y", "com z"][k.min(2)],
            Self::Inertia(k) => ["ixx", "iyy", "izz", "ixy", "ixz", "iyz"][k.min(5)],
            Self::Armature => "armature",
        }
    }
}

/// How much a parameter moves κ.
#[derive(Debug, Clone, PartialEq)]
pub struct Sensitivity {
    /// The parameter.
    pub parameter: Parameter,
    /// The link, with what is fixed to it, or the joint.
    pub of: String,
    /// What it is (kg, m, kg m²).
    pub value: f64,
    /// What a change is measured against.
    pub against: f64,
    /// d log κ for a change of that size.
    pub rate: f64,
}

/// The parameters that move κ most at q, the first of them most; none where λmin is not resolved.
pub(super) fn sensitivities(
    model: &Model<f64>,
    reduction: Reduction,
    metric: &Metric<f64>,
    evaluator: &Evaluator<'_>,
    q: &[f64],
) -> Result<Vec<Sensitivity>, StudyError> {
    let question = Question { reduction, metric: metric.clone(), ..Question::default() };
    let verdict = conditioning_at(model, q, &question)?;
    let ends = verdict.lambda_min.zip(verdict.lambda_max);
    let (Some((min, max)), Some(x), Some(y)) = (ends, verdict.softest, verdict.stiffest) else {
        return Ok(Vec::new());
    };
    let soft = inertial_gradient(model, q, &evaluator.motion(q, &x)?)?;
    let stiff = inertial_gradient(model, q, &evaluator.motion(q, &y)?)?;
    let mut all = Vec::new();
    for (body, (soft, stiff)) in model.bodies().iter().zip(soft.iter().zip(&stiff)) {
        let of = model.links()[body.link()].name();
        let (soft, stiff) = (flat(soft), flat(stiff));
        for ((parameter, value, against, s), (.., t)) in soft.into_iter().zip(stiff) {
            let rate = (t / max - s / min) * against;
            all.push(Sensitivity { parameter, of: of.to_owned(), value, against, rate });
        }
    }
    let H = reduction.mass_matrix(model, q)?;
    for (k, &d) in reduction.dofs(model).iter().enumerate() {
        let against = H[(k, k)];
        let rate = (y[k] * y[k] / max - x[k] * x[k] / min) * against;
        let (of, value) = (model.dof_name(d), model.armature()[d]);
        all.push(Sensitivity { parameter: Parameter::Armature, of, value, against, rate });
    }
    all.retain(|one| one.rate != 0.0 && one.rate.is_finite());
    all.sort_by(|a, b| b.rate.abs().total_cmp(&a.rate.abs()));
    // Of joints and of links each: where a robot is nearly singular, armature outdoes all else.
    let mut kept = [0; 2];
    all.retain(|one| {
        let kind = usize::from(one.parameter == Parameter::Armature);
        kept[kind] += 1;
        kept[kind] <= KEPT
    });
    Ok(all)
}

/// The ten parameters of a body: value, what a change is measured against, gradient.
fn flat(of: &InertialGradient<f64>) -> Vec<(Parameter, f64, f64, f64)> {
    let I = of.I;
    let trace = I.xx + I.yy + I.zz;
    let gyration = if of.m > 0.0 { (0.5 * trace / of.m).max(0.0).sqrt() } else { 0.0 };
    let mut all = vec![(Parameter::Mass, of.m, of.m, of.of_m)];
    for (k, (c, d)) in of.c.to_array().into_iter().zip(of.of_c.to_array()).enumerate() {
        all.push((Parameter::Centre(k), c, gyration, d));
    }
    let g = of.of_I;
    let entries = [(I.xx, g.xx), (I.yy, g.yy), (I.zz, g.zz), (I.xy, g.xy), (I.xz, g.xz), (I.yz, g.yz)];
    for (k, (i, d)) in entries.into_iter().enumerate() {
        all.push((Parameter::Inertia(k), i, trace / 3.0, d));
    }
    all
}

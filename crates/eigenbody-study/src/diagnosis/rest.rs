//! Motions that move no mass in any configuration.
//!
//! ```text
//! H(q) x = 0 at configurations in general position: x holds as many motions as eigenvalues below n ε² λmax in double-double
//! ```
//! A configuration in general position is as regular as the robot ever is: a massless universal joint, singular only where its axes
//! align, raises no alarm.

use crate::StudyError;
use eigenbody::scalar::{Dd, Real, Scalar};
use eigenbody::spectrum::eigen;
use eigenbody::{Model, Reduction};

/// Configurations tried; one is enough unless luck is bad.
const TRIES: u64 = 3;
/// Up to so many degrees of freedom the matrix is formed in double-double.
const LARGEST: usize = 400;

/// Joint rates that move no mass, the largest of them one.
#[derive(Debug, Clone, PartialEq)]
pub struct NullMotion {
    /// DoF and rate, those that move at all.
    pub rates: Vec<(String, f64)>,
}

/// A basis of the motions that move no mass, at the configuration that leaves the fewest.
pub(super) fn null_motions(model: &Model<f64>, reduction: Reduction) -> Result<Vec<NullMotion>, StudyError> {
    let names: Vec<String> = reduction.dofs(model).iter().map(|&d| model.dof_name(d)).collect();
    if names.len() > LARGEST {
        return Ok(Vec::new());
    }
    let wide: Model<Dd> = model.cast();
    let mut fewest: Option<Vec<NullMotion>> = None;
    for seed in 0..TRIES {
        let q: Vec<f64> = model.random(seed);
        let q = match model.coupling().filter(|_| reduction.mimic) {
            Some(coupling) => {
                coupling.expand(&coupling.independent_coordinates().iter().map(|&k| q[k]).collect::<Vec<_>>())
            }
            None => q,
        };
        let q: Vec<Dd> = q.into_iter().map(Dd::from_f64).collect();
        let motions = at(&wide, &q, reduction, &names)?;
        if fewest.as_ref().is_none_or(|fewest| motions.len() < fewest.len()) {
            fewest = Some(motions);
        }
        if fewest.as_ref().is_some_and(Vec::is_empty) {
            break;
        }
    }
    Ok(fewest.unwrap_or_default())
}

fn at(
    model: &Model<Dd>,
    q: &[Dd],
    reduction: Reduction,
    names: &[String],
) -> Result<Vec<NullMotion>, StudyError> {
    let H = reduction.mass_matrix(model, q)?;
    let n = H.rows();
    // In units of each DoF's own inertia, where it has any: light fingers are not rest.
    let weights: Vec<Dd> = (0..n).map(|d| if H[(d, d)] > Dd::ZERO { H[(d, d)] } else { Dd::ONE }).collect();
    let pairs = eigen(&H, &weights)?;
    let largest = pairs.values.last().map_or(0.0, |max| max.to_f64());
    let below = n as f64 * Dd::EPSILON * largest.max(1.0);
    let count = pairs.values.iter().take_while(|value| value.to_f64() <= below).count();
    let motion = |row: usize| {
        let x: Vec<f64> = pairs.vectors.row(row).iter().map(|x| x.to_f64()).collect();
        let largest = x.iter().fold(0.0f64, |best, &x| if x.abs() > best.abs() { x } else { best });
        let rates = names.iter().cloned().zip(x.iter().map(|x| x / largest));
        NullMotion { rates: rates.filter(|(_, rate)| rate.abs() > 1e-12).collect() }
    };
    Ok((0..count).map(motion).collect())
}

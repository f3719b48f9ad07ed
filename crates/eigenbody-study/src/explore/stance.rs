//! Where everything stands.

use super::edit::link_inertia;
use eigenbody::dynamics::{axes, link_poses};
use eigenbody::spatial::{Motion, Transform, Vec3};
use eigenbody::{InputError, Model, Reduction};

/// Bodies and axes in the world.
#[derive(Debug, Clone, PartialEq)]
pub struct Stance {
    /// From the world's frame to each moving body's link.
    pub links: Vec<Transform<f64>>,
    /// Of every DoF: a point on its axis, nearest to its link's origin (m), and the axis' direction, a unit vector.
    pub axes: Vec<[[f64; 3]; 2]>,
}

/// The robot at q.
///
/// Cost O(N). Errors: [`InputError`] if q does not fit.
///
/// ```
/// use eigenbody_study::explore::stance;
/// let arm = eigenbody::Family::hydra(2, 1.0, 0.0, 1.0)?.model::<f64>()?;
/// let stance = stance(&arm, &[0.0, 0.3])?;
/// assert_eq!(stance.axes[1], [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn stance(model: &Model<f64>, q: &[f64]) -> Result<Stance, InputError> {
    let (poses, S) = (link_poses(model, q)?, axes(model, q)?);
    let mut lines = vec![[[0.0; 3]; 2]; model.nv()];
    for body in model.bodies() {
        for d in body.dofs() {
            lines[d] = axis(&S[d], poses[body.link()].r);
        }
    }
    Ok(Stance { links: model.bodies().iter().map(|body| poses[body.link()]).collect(), axes: lines })
}

/// The line that a column of S turns about or slides along, by its point nearest to `origin`.
fn axis(S: &Motion<f64>, origin: Vec3<f64>) -> [[f64; 3]; 2] {
    let turns = S.ang.dot(S.ang);
    if turns == 0.0 {
        let speed = S.lin.norm();
        let along = if speed > 0.0 { S.lin * (1.0 / speed) } else { Vec3::ZERO };
        return [origin.to_array(), along.to_array()];
    }
    // v = S.lin + ω × o at the origin o; the axis passes through o + ω × v/ω².
    let velocity = S.lin + S.ang.cross(origin);
    let nearest = origin + S.ang.cross(velocity) * (1.0 / turns);
    [nearest.to_array(), (S.ang * (1.0 / turns.sqrt())).to_array()]
}

/// A frame in the world as x, y, z, w, x, y, z, from the transform that goes from the world to it.
pub fn pose(X: &Transform<f64>) -> [f64; 7] {
    let ([x, y, z], [w, a, b, c]) = (X.r.to_array(), X.E.quaternion());
    [x, y, z, w, a, b, c]
}

/// q with the joints that follow others where these put them.
///
/// Errors: [`InputError`] if q does not fit.
pub fn settled(model: &Model<f64>, reduction: Reduction, q: &[f64]) -> Result<Vec<f64>, InputError> {
    model.check_q(q)?;
    let Some(coupling) = model.coupling().filter(|_| reduction.mimic) else { return Ok(q.to_vec()) };
    let p: Vec<f64> = coupling.independent_coordinates().iter().map(|&k| q[k]).collect();
    let q = coupling.expand(&p);
    model.check_q(&q)?;
    Ok(q)
}

/// Radius about the world's origin that holds all links' origins and centres of mass (m).
pub fn extent(model: &Model<f64>, stance: &Stance) -> f64 {
    let mut radius: f64 = 0.0;
    for (body, X) in model.bodies().iter().zip(&stance.links) {
        radius = radius.max(X.r.norm());
        if let Some(inertia) = link_inertia(model, body.link()) {
            radius = radius.max(X.inverse_point(inertia.central().1).norm());
        }
    }
    radius
}

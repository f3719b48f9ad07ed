//! The position pass that every algorithm starts with.
//!
//! ```text
//! for i = 1..N:   [X_J, S_i] = joint_i(q_i)      X_up_i = X_J X_tree_i
//! ```
//! Featherstone (2008), §4.4. Cost O(N): one sine-cosine pair an angle and one product of rotations.

use crate::error::InputError;
use crate::model::{LinkInfo, Model};
use crate::scalar::{Real, Scalar};
use crate::spatial::{Motion, Transform};

/// Where every body stands against its parent, and along which columns it moves.
#[derive(Debug, Clone)]
pub struct Kinematics<T> {
    /// N: from the parent's frame to the body's. Written by [`update`](Self::update).
    pub(crate) X_up: Vec<Transform<T>>,
    /// nv: motion subspace columns, each in its body's frame. Written by [`update`](Self::update).
    pub(crate) S: Vec<Motion<T>>,
}

impl<T: Scalar> Kinematics<T> {
    /// Room for a model.
    pub fn new(model: &Model<T>) -> Self {
        Self { X_up: vec![Transform::IDENTITY; model.bodies.len()], S: vec![Motion::ZERO; model.nv()] }
    }

    /// Both at q. The caller has checked q.
    pub(crate) fn at(model: &Model<T>, q: &[T]) -> Self {
        let mut kinematics = Self::new(model);
        kinematics.update(model, q);
        kinematics
    }

    /// X_up and S at q. The caller has checked q.
    #[inline(always)]
    pub(crate) fn update(&mut self, model: &Model<T>, q: &[T]) {
        for (body, X_up) in model.bodies.iter().zip(&mut self.X_up) {
            let X_J = body.joint.kinematics(&q[body.coordinates()], &mut self.S[body.dofs()]);
            *X_up = X_J * body.X_tree;
        }
    }
}

/// Pose of a link in the world: the transform from the world's frame to the link's own.
///
/// | name | shape | unit |
/// |------|-------|------|
/// | `q` | `nq` | rad, m, unit quaternion |
/// | `link` | index into [`Model::links`] | – |
///
/// `E` turns world coordinates into the link's, `r` is the link's origin in the world (m). Cost O(depth).
///
/// Errors: [`InputError`] if q does not fit the model.
///
/// # Panics
///
/// If `link` is not below `model.links().len()`.
///
/// ```
/// use eigenbody::{Family, dynamics::link_pose};
/// let robot = Family::hydra(2, 1.0, 0.0, 1.0)?.model::<f64>()?;
/// let tip = link_pose(&robot, &[0.0, std::f64::consts::FRAC_PI_2], 2)?;
/// assert!((tip.r.x - 1.0).abs() < 1e-15 && tip.r.y.abs() < 1e-15);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn link_pose<T: Real>(model: &Model<T>, q: &[T], link: usize) -> Result<Transform<T>, InputError> {
    model.check_q(q)?;
    let info = &model.links[link];
    let mut X = info.link_from_body();
    let mut i = info.body();
    let mut S = [Motion::ZERO; 6];
    while let Some(b) = i {
        let body = &model.bodies[b];
        let X_J = body.joint.kinematics(&q[body.coordinates()], &mut S[..body.joint.nv()]);
        X = X * X_J * body.X_tree;
        i = body.parent();
    }
    Ok(X)
}

/// Poses of all links in the world, in the order of [`Model::links`]: each as [`link_pose`] has it, all of them in O(N).
///
/// | name | shape | unit |
/// |------|-------|------|
/// | `q` | `nq` | rad, m, unit quaternion |
/// | returned | one transform a link, from the world's frame to the link's | m |
///
/// Allocates. Errors: [`InputError`] if q does not fit the model.
///
/// ```
/// use eigenbody::{Family, dynamics::{link_pose, link_poses}};
/// let robot = Family::hydra(2, 1.0, 0.0, 1.0)?.model::<f64>()?;
/// let poses = link_poses(&robot, &[0.3, -0.2])?;
/// assert!((poses[2].r.x - link_pose(&robot, &[0.3, -0.2], 2)?.r.x).abs() < 1e-15);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn link_poses<T: Real>(model: &Model<T>, q: &[T]) -> Result<Vec<Transform<T>>, InputError> {
    model.check_q(q)?;
    let from_world = from_world(model, &Kinematics::at(model, q).X_up);
    let pose = |link: &LinkInfo<T>| match link.body() {
        Some(i) => link.link_from_body() * from_world[i],
        None => link.link_from_body(),
    };
    Ok(model.links.iter().map(pose).collect())
}

/// From the world's frame to every body's.
fn from_world<T: Scalar>(model: &Model<T>, X_up: &[Transform<T>]) -> Vec<Transform<T>> {
    let mut found: Vec<Transform<T>> = Vec::with_capacity(X_up.len());
    for (body, &X_up) in model.bodies.iter().zip(X_up) {
        found.push(body.parent().map_or(X_up, |p| X_up * found[p]));
    }
    found
}

/// Every column of S in the world's coordinates: the motion of the world's origin, as part of the body, at unit rate.
///
/// | name | shape | unit |
/// |------|-------|------|
/// | `q` | `nq` | rad, m, unit quaternion |
/// | returned | `nv` | angular part: unit axis, or zero; linear part: m/s at the world's origin |
///
/// Cost O(N); allocates. Errors: [`InputError`] if q does not fit the model.
///
/// ```
/// use eigenbody::{Family, dynamics::axes, spatial::Vec3};
/// let arm = Family::hydra(2, 1.0, 0.0, 1.0)?.model::<f64>()?;
/// let second = axes(&arm, &[0.0, 0.0])?[1];
/// // About z through (1, 0, 0): the origin would move along −y.
/// assert_eq!((second.ang, second.lin.y), (Vec3::Z, -1.0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn axes<T: Real>(model: &Model<T>, q: &[T]) -> Result<Vec<Motion<T>>, InputError> {
    model.check_q(q)?;
    let Kinematics { X_up, mut S } = Kinematics::at(model, q);
    for (body, X) in model.bodies.iter().zip(from_world(model, &X_up)) {
        for S in &mut S[body.dofs()] {
            *S = X.inverse_motion(*S);
        }
    }
    Ok(S)
}

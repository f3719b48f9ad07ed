//! The tree at q seen from another body.
//!
//! ```text
//! path from the new root k up to the old one:   k = p₀, p₁, .., p_m
//! for j = 1..m:   parent'(p_j) = p_(j−1)      X_up'(p_j) = X_up(p_(j−1))⁻¹      S'_d = −X_up(p_(j−1))⁻¹ S_d
//! ```
//! The joint between p_j and p_(j−1) is the same one, walked the other way: its velocity keeps its meaning, so the joints'
//! inertia is the same from whichever body it is seen. All other bodies stay as they are. Cost O(N).

use super::kinematics::Kinematics;
use crate::joint::{Column, Joint};
use crate::model::{Body, Model};
use crate::scalar::{Real, Scalar};
use crate::spatial::{Motion, RigidInertia, Transform};
use std::ops::Range;

/// What a sweep asks of a body.
pub(crate) trait TreeBody<T> {
    /// The body before it, of smaller index.
    fn parent(&self) -> Option<usize>;
    /// Its degrees of freedom.
    fn dofs(&self) -> Range<usize>;
    /// Its inertia in its own frame.
    fn inertia(&self) -> RigidInertia<T>;
}

impl<T: Scalar> TreeBody<T> for crate::model::Body<T> {
    #[inline(always)]
    fn parent(&self) -> Option<usize> {
        self.parent()
    }
    #[inline(always)]
    fn dofs(&self) -> Range<usize> {
        self.dofs()
    }
    #[inline(always)]
    fn inertia(&self) -> RigidInertia<T> {
        self.I
    }
}

/// A body of a re-rooted tree.
#[derive(Debug, Clone)]
pub(crate) struct Rebody<T> {
    parent: Option<usize>,
    dofs: Range<usize>,
    I: RigidInertia<T>,
}

impl<T: Scalar> TreeBody<T> for Rebody<T> {
    fn parent(&self) -> Option<usize> {
        self.parent
    }
    fn dofs(&self) -> Range<usize> {
        self.dofs.clone()
    }
    fn inertia(&self) -> RigidInertia<T> {
        self.I
    }
}

/// A floating tree on another base, in pre-order: the path from the new root, then what hangs from the path's end, from the
/// body before it, and so on back to the root.
#[derive(Debug, Clone)]
pub(crate) struct Rerooted<T> {
    /// N: fixed with the root.
    pub bodies: Vec<Rebody<T>>,
    /// N and nv: as in [`Kinematics`], for the new tree.
    pub kinematics: Kinematics<T>,
    /// N: old body at each new place, and new place of each old body; fixed with the root.
    old: Vec<usize>,
    new: Vec<usize>,
    /// Length of the path.
    path: usize,
}

impl<T: Real> Rerooted<T> {
    /// Room for a model with a floating base, seen from its central body.
    pub fn new(model: &Model<T>) -> Self {
        let central = central_body(model);
        let mut old: Vec<usize> =
            std::iter::successors(Some(central), |&i| model.bodies[i].parent()).collect();
        let path = old.len();
        // Place on the path that a body's branch hangs from.
        let mut branch = vec![usize::MAX; model.bodies.len()];
        old.iter().enumerate().for_each(|(place, &i)| branch[i] = place);
        let mut others = Vec::with_capacity(model.bodies.len() - path);
        for (i, body) in model.bodies.iter().enumerate() {
            if let (usize::MAX, Some(p)) = (branch[i], body.parent()) {
                branch[i] = branch[p];
                others.push(i);
            }
        }
        others.sort_by_key(|&i| std::cmp::Reverse(branch[i]));
        old.extend(others);
        let mut new = vec![0; old.len()];
        old.iter().enumerate().for_each(|(place, &i)| new[i] = place);
        let mut bodies = Vec::with_capacity(old.len());
        for (place, &i) in old.iter().enumerate() {
            let body = &model.bodies[i];
            let (parent, dofs) = match place {
                0 => (None, model.bodies[0].dofs()),
                _ if place < path => (Some(place - 1), model.bodies[old[place - 1]].dofs()),
                _ => (body.parent().map(|p| new[p]), body.dofs()),
            };
            bodies.push(Rebody { parent, dofs, I: body.I });
        }
        Self { bodies, kinematics: Kinematics::new(model), old, new, path }
    }

    /// The inertias of a model of the same shape. The root stays where it is.
    pub fn weigh(&mut self, model: &Model<T>) {
        for (body, &i) in self.bodies.iter_mut().zip(&self.old) {
            body.I = model.bodies[i].I;
        }
    }

    /// The new tree at the configuration of `from`. The base's six columns are unit vectors at the new root.
    pub fn update(&mut self, model: &Model<T>, from: &Kinematics<T>) {
        let Self { kinematics: Kinematics { X_up, S }, old, path, .. } = self;
        S.copy_from_slice(&from.S);
        for (place, &i) in old.iter().enumerate() {
            X_up[place] = match place {
                0 => Transform::IDENTITY,
                _ if place < *path => {
                    let reversed = old[place - 1];
                    let X = from.X_up[reversed].inverse();
                    for d in model.bodies[reversed].dofs() {
                        S[d] = -X.motion(from.S[d]);
                    }
                    X
                }
                _ => from.X_up[i],
            };
        }
        for (column, d) in unit_columns().into_iter().zip(model.bodies[0].dofs()) {
            S[d] = column;
        }
    }

    /// Where the model's own base stands.
    pub fn place_of_base(&self) -> usize {
        self.new[0]
    }

    /// What is known of the columns of the body at a new place. A joint walked the other way has any columns.
    pub fn columns(&self, model: &Model<T>, place: usize) -> &'static [Column] {
        match place {
            0 => Joint::<T>::Floating.columns(),
            _ if place < self.path => &[Column::General; 6][..self.bodies[place].dofs.len()],
            _ => model.bodies[self.old[place]].joint.columns(),
        }
    }
}

/// The body from which no branch carries more than half of the robot: then every joint is felt from its lighter side.
///
/// Bodies are weighed by what resists turning and moving at the scale of the whole: tr I + m R², I about the body's centre of mass,
/// m R² = Σ tr I over all bodies.
fn central_body<T: Real>(model: &Model<T>) -> usize {
    let own = |body: &Body<T>| {
        let (m, h, I) = (body.I.m.to_f64(), body.I.h.map(T::to_f64), body.I.I.map(T::to_f64));
        let about_origin = I.xx + I.yy + I.zz;
        let shift = if m > 0.0 { 2.0 * h.dot(h) / m } else { 0.0 };
        (m, (about_origin - shift).max(0.0))
    };
    let (mass, inertia) = model.bodies.iter().map(own).fold((0.0, 0.0), |(m, I), (dm, dI)| (m + dm, I + dI));
    let R2 = if mass > 0.0 { inertia / mass } else { 0.0 };
    let mut weight: Vec<f64> = model.bodies.iter().map(own).map(|(m, I)| I + m * R2).collect();
    for i in (0..weight.len()).rev() {
        if let Some(p) = model.bodies[i].parent() {
            weight[p] += weight[i];
        }
    }
    // In pre-order the last body whose subtree weighs more than half lies at the end of the only such path.
    let half = 0.5 * weight.first().copied().unwrap_or(0.0);
    weight.iter().rposition(|&w| w > half).unwrap_or(0)
}

fn unit_columns<T: Scalar>() -> [Motion<T>; 6] {
    use crate::spatial::Vec3;
    [
        Motion::new(Vec3::X, Vec3::ZERO),
        Motion::new(Vec3::Y, Vec3::ZERO),
        Motion::new(Vec3::Z, Vec3::ZERO),
        Motion::new(Vec3::ZERO, Vec3::X),
        Motion::new(Vec3::ZERO, Vec3::Y),
        Motion::new(Vec3::ZERO, Vec3::Z),
    ]
}

//! In what two models of one file differ, and whether two others differ by the same.

use eigenbody::Model;
use eigenbody::model::{Body, JointInfo};
use eigenbody::spatial::RigidInertia;

/// What rounds: degrees to radians and back, an inertia about the centre of mass and the origin, sums of two.
const ROUNDED: f64 = 100.0 * f64::EPSILON;

/// One difference.
pub(super) enum Change<'m> {
    /// Armature of a joint, by degree of freedom.
    Armature { joint: &'m JointInfo<f64>, was: &'m [f64], is: &'m [f64] },
    /// Matter on a link, about its origin on its axes.
    Matter { link: usize, name: &'m str, added: RigidInertia<f64> },
    /// Limits of a joint.
    Limits { joint: &'m JointInfo<f64>, is: Option<(f64, f64)> },
}

impl Change<'_> {
    /// What is changed, in words.
    pub fn what(&self) -> String {
        match self {
            Self::Armature { joint, .. } | Self::Limits { joint, .. } => format!("joint '{}'", joint.name()),
            Self::Matter { name, .. } => format!("link '{name}'"),
        }
    }
}

/// All differences between two models with the same joints and links.
pub(super) fn changes<'m>(model: &'m Model<f64>, mended: &'m Model<f64>) -> Vec<Change<'m>> {
    let mut found = Vec::new();
    for (joint, is) in model.joints().iter().zip(mended.joints()) {
        let (was, new) = (&model.armature()[joint.dofs()], &mended.armature()[joint.dofs()]);
        if was != new {
            found.push(Change::Armature { joint, was, is: new });
        }
        if joint.limits() != is.limits() {
            found.push(Change::Limits { joint, is: is.limits() });
        }
    }
    for (body, is) in model.bodies().iter().zip(mended.bodies()) {
        if body.inertia() != is.inertia() {
            let link = &model.links()[body.link()];
            let added = difference(is.inertia(), body.inertia());
            let added = link.link_from_body().inverse().transpose_rigid(added);
            found.push(Change::Matter { link: body.link(), name: link.name(), added });
        }
    }
    found
}

/// Whether two models have the same joints and bodies, armature and limits apart.
pub(super) fn same(one: &Model<f64>, other: &Model<f64>) -> bool {
    let joints = |model: &Model<f64>| model.joints().iter().map(|j| j.name().to_owned()).collect::<Vec<_>>();
    let body = |(a, b): (&Body<f64>, &Body<f64>)| {
        (a.parent(), a.inertia(), a.tree_transform()) == (b.parent(), b.inertia(), b.tree_transform())
    };
    let (bodies, others) = (one.bodies(), other.bodies());
    joints(one) == joints(other) && bodies.len() == others.len() && bodies.iter().zip(others).all(body)
}

/// Whether `before` became `after` as `model` became `mended`.
pub(super) fn alike(
    before: &Model<f64>,
    after: &Model<f64>,
    model: &Model<f64>,
    mended: &Model<f64>,
) -> bool {
    let same_shape = [before, after, mended].iter().all(|other| {
        (other.nv(), other.joints().len(), other.bodies().len())
            == (model.nv(), model.joints().len(), model.bodies().len())
    });
    let near = |a: f64, b: f64, size: f64| (a - b).abs() <= ROUNDED * size.abs();
    let armature = || {
        (0..model.nv()).all(|d| {
            let (was, is) = (before.armature()[d], after.armature()[d]);
            near(is - was, mended.armature()[d] - model.armature()[d], is.max(mended.armature()[d]))
        })
    };
    let limits = || {
        after.joints().iter().zip(mended.joints()).all(|(after, mended)| {
            match (after.limits(), mended.limits()) {
                (Some((a, b)), Some((c, d))) => {
                    let size = c.abs().max(d.abs());
                    (a == c || near(a, c, size)) && (b == d || near(b, d, size))
                }
                (one, other) => one.is_none() && other.is_none(),
            }
        })
    };
    let inertia = || {
        let bodies = before.bodies().iter().zip(after.bodies());
        bodies.zip(model.bodies().iter().zip(mended.bodies())).all(|((a, b), (c, d))| {
            let same = a.parent() == b.parent() && a.tree_transform() == b.tree_transform();
            let added = difference(b.inertia(), a.inertia());
            let wanted = difference(d.inertia(), c.inertia());
            let (apart, size) = (sizes(&difference(&added, &wanted)), sizes(d.inertia()));
            same && apart.iter().zip(size).all(|(&apart, size)| near(apart, 0.0, size))
        })
    };
    same_shape && armature() && limits() && inertia()
}

fn difference(a: &RigidInertia<f64>, b: &RigidInertia<f64>) -> RigidInertia<f64> {
    RigidInertia { m: a.m - b.m, h: a.h - b.h, I: a.I - b.I }
}

/// Sizes of mass, first and second moment.
fn sizes(body: &RigidInertia<f64>) -> [f64; 3] {
    let largest = |x: &[f64]| x.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    let I = body.I;
    [body.m.abs(), largest(&body.h.to_array()), largest(&[I.xx, I.yy, I.zz, I.xy, I.xz, I.yz])]
}

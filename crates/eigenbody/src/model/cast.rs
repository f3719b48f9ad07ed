//! The same model in another scalar.

use super::body::{Body, JointInfo, LinkInfo};
use super::coupling::Coupling;
use super::{Deferred, Model};
use crate::scalar::Real;

impl Model<f64> {
    /// The model with every number converted; exact towards wider scalars.
    pub fn cast<U: Real>(&self) -> Model<U> {
        let f = U::from_f64;
        let body = |b: &Body<f64>| Body {
            parent: b.parent,
            q0: b.q0,
            v0: b.v0,
            link: b.link,
            joint: b.joint.map(f),
            X_tree: b.X_tree.map(f),
            I: b.I.map(f),
        };
        let link = |l: &LinkInfo<f64>| LinkInfo {
            name: l.name.clone(),
            body: l.body,
            X_link: l.X_link.as_ref().map(|X| Box::new(X.map(f))),
        };
        let joint = |j: &JointInfo<f64>| JointInfo {
            name: j.name.clone(),
            kind: j.kind.map(f),
            q0: j.q0,
            v0: j.v0,
            limits: j.limits.map(|(lower, upper)| (f(lower), f(upper))),
        };
        Model {
            name: self.name.clone(),
            bodies: self.bodies.iter().map(body).collect(),
            shape: self.shape,
            mechanism: Deferred::default(),
            links: self.links.iter().map(link).collect(),
            joints: self.joints.iter().map(joint).collect(),
            quaternions: self.quaternions.clone(),
            dofs: self.dofs.clone(),
            dof_joint: self.dof_joint.clone(),
            armature: self.armature.iter().copied().map(f).collect(),
            nq: self.nq,
            floating_base: self.floating_base,
            gravity: self.gravity.map(f),
            coupling: self.coupling.as_ref().map(Coupling::cast),
            findings: self.findings.clone(),
        }
    }
}

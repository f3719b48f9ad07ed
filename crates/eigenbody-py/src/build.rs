//! `eigenbody.Parts`: a robot given link by link, as live models of other libraries are.

use crate::error::Failure;
use eigenbody::model::{JointSpec, LinkId};
use eigenbody::spatial::{Mat3, RigidInertia, Sym3, Transform, Vec3};
use eigenbody::stability::{Spring, SpringSource};
use eigenbody::{Base, InputError, Joint, ModelBuilder};
use pyo3::prelude::*;
use std::sync::{Mutex, PoisonError};

/// A robot given link by link, joints in the order of their degrees of freedom: `Model(parts)` builds it.
#[pyclass(module = "eigenbody", frozen)]
pub struct Parts {
    pub name: String,
    gravity: [f64; 3],
    lists: Mutex<Lists>,
}

#[derive(Default)]
struct Lists {
    links: Vec<Link>,
    joints: Vec<Moving>,
    notes: Vec<String>,
}

struct Link {
    name: String,
    inertia: RigidInertia<f64>,
}

struct Moving {
    name: String,
    kind: Joint<f64>,
    parent: usize,
    child: usize,
    placement: Transform<f64>,
    axis: Vec3<f64>,
    armature: Vec<f64>,
    limits: Option<(f64, f64)>,
    stiffness: f64,
    damping: Vec<f64>,
}

/// How far an inertia may be from symmetric, in parts of its largest entry, and a rotation from orthonormal.
const SLACK: f64 = 1e-6;

fn is_symmetric(I: &[[f64; 3]; 3]) -> bool {
    let size = I.iter().flatten().fold(0.0, |size: f64, x| size.max(x.abs()));
    // What is not finite is refused with the link.
    let differs = |i: usize, j: usize| (I[i][j] - I[j][i]).abs() > SLACK * size;
    !(differs(0, 1) || differs(0, 2) || differs(1, 2))
}

/// R Rᵀ = 1 and det R = 1: each row is the cross product of the other two.
fn is_rotation([x, y, z]: [Vec3<f64>; 3]) -> bool {
    let is_one = |row: Vec3<f64>, other: Vec3<f64>| {
        row.to_array().into_iter().zip(other.to_array()).all(|(a, b)| (a - b).abs() <= SLACK)
    };
    is_one(x, y.cross(z)) && is_one(y, z.cross(x)) && is_one(z, x.cross(y)) && (x.dot(x) - 1.0).abs() <= SLACK
}

fn symmetric(I: [[f64; 3]; 3]) -> Sym3<f64> {
    Sym3 { xx: I[0][0], yy: I[1][1], zz: I[2][2], xy: I[0][1], xz: I[0][2], yz: I[1][2] }
}

impl Parts {
    pub fn build(&self, base: Base) -> Result<eigenbody::Model<f64>, Failure> {
        let lists = self.lists();
        let mut builder = ModelBuilder::new(self.name.clone());
        builder.gravity(Vec3::from_f64(self.gravity));
        let links: Vec<LinkId> =
            lists.links.iter().map(|link| builder.link(link.name.clone(), link.inertia)).collect();
        for joint in &lists.joints {
            let spec =
                JointSpec::new(joint.name.clone(), joint.kind, links[joint.parent], links[joint.child])
                    .at(joint.placement)
                    .about(joint.axis)
                    .with_armature(joint.armature.clone());
            builder.joint(JointSpec { limits: joint.limits, ..spec });
        }
        builder.build(base).map_err(Failure::Build)
    }

    /// Springs and dampers of the joints, on the model that was built.
    pub fn springs(&self, model: &eigenbody::Model<f64>) -> Vec<Spring> {
        let mut springs = Vec::new();
        for Moving { name, stiffness, damping, .. } in &self.lists().joints {
            let Some(joint) = model.joints().iter().find(|joint| joint.name() == name) else { continue };
            for (k, d) in joint.dofs().enumerate() {
                let damping = damping.get(k).copied().unwrap_or(0.0);
                if *stiffness != 0.0 || damping != 0.0 {
                    let (name, arms, source) = (model.dof_name(d), vec![(d, 1.0)], SpringSource::Joint);
                    springs.push(Spring { name, source, arms, stiffness: *stiffness, damping });
                }
            }
        }
        springs
    }

    pub fn notes(&self) -> Vec<String> {
        self.lists().notes.clone()
    }

    fn lists(&self) -> std::sync::MutexGuard<'_, Lists> {
        self.lists.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[pymethods]
impl Parts {
    #[new]
    #[pyo3(signature = (name, /, *, gravity=[0.0, 0.0, -9.81]))]
    fn new(name: String, gravity: [f64; 3]) -> Self {
        Self { name, gravity, lists: Mutex::default() }
    }

    /// Adds a link; its number. Mass in kg, centre of mass in m, inertia (3, 3), symmetric, about it in kg m², in the link's axes.
    #[pyo3(signature = (name, /, *, mass=0.0, com=[0.0; 3], inertia=[[0.0; 3]; 3]))]
    fn link(&self, name: String, mass: f64, com: [f64; 3], inertia: [[f64; 3]; 3]) -> Result<usize, Failure> {
        if !is_symmetric(&inertia) {
            return Err(Failure::input("inertia", format!("{inertia:?} of link '{name}' is not symmetric")));
        }
        let inertia = RigidInertia::from_com(mass, Vec3::from_f64(com), symmetric(inertia));
        let mut lists = self.lists();
        lists.links.push(Link { name, inertia });
        Ok(lists.links.len() - 1)
    }

    /// Adds a joint between two links; its number.
    ///
    /// `kind`: fixed, revolute, continuous, prismatic, cylindrical, planar, spherical or floating. `rotation` (3, 3) and `position`
    /// (m) place the joint's frame, which is the child's, in the parent's. `armature` and `damping` have one number a degree of
    /// freedom; `stiffness` is that of each, slack at zero. Springs and dampers count in `check` and `simulate`.
    #[pyo3(signature = (name, kind, /, *, parent, child, rotation=[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        position=[0.0; 3], axis=[0.0, 0.0, 1.0], armature=Vec::new(), limits=None, stiffness=0.0, damping=Vec::new()))]
    #[allow(clippy::too_many_arguments)] // each a named option in Python
    fn joint(
        &self,
        name: String,
        kind: &str,
        parent: usize,
        child: usize,
        rotation: [[f64; 3]; 3],
        position: [f64; 3],
        axis: [f64; 3],
        armature: Vec<f64>,
        limits: Option<(f64, f64)>,
        stiffness: f64,
        damping: Vec<f64>,
    ) -> Result<usize, Failure> {
        let kind = match kind {
            "fixed" => Joint::Fixed,
            "revolute" => Joint::Revolute,
            "continuous" => Joint::Continuous,
            "prismatic" => Joint::Prismatic,
            "spherical" => Joint::Spherical,
            "floating" => Joint::Floating,
            "planar" => Joint::Planar,
            "cylindrical" => Joint::Cylindrical,
            _ => return Err(Failure::input("kind", format!("'{kind}' is no kind of joint"))),
        };
        for (what, numbers) in [("stiffness", &[stiffness][..]), ("damping", &damping[..])] {
            if let Some(index) = numbers.iter().position(|x| !x.is_finite()) {
                return Err(InputError::NotFinite { what, index }.into());
            }
        }
        if !damping.is_empty() && damping.len() != kind.nv() {
            let found = eigenbody_report::count(damping.len(), "number", "numbers");
            let problem = format!("has {found}, expected {}", kind.nv());
            return Err(Failure::input("damping", problem));
        }
        let mut lists = self.lists();
        for (what, link) in [("parent", parent), ("child", child)] {
            if link >= lists.links.len() {
                return Err(Failure::input(what, format!("no link has number {link}")));
            }
        }
        let [x, y, z] = rotation.map(Vec3::from_f64);
        if !is_rotation([x, y, z]) {
            let problem = format!(
                "{rotation:?} of joint '{name}' is none: its rows are not orthonormal and right-handed"
            );
            return Err(Failure::input("rotation", problem));
        }
        // The rotation takes the child's coordinates to the parent's; E goes the other way.
        let placement = Transform::new(Mat3::from_rows(x, y, z).transpose(), Vec3::from_f64(position));
        let axis = Vec3::from_f64(axis);
        let joint =
            Moving { name, kind, parent, child, placement, axis, armature, limits, stiffness, damping };
        lists.joints.push(joint);
        Ok(lists.joints.len() - 1)
    }

    /// Adds a remark to the model's `findings`.
    #[pyo3(signature = (text, /))]
    fn note(&self, text: String) {
        self.lists().notes.push(text);
    }
}

//! Bodies as they are read, before they become links: the world is body 0.

use super::compiler::Compiler;
use super::geom::Geom;
use super::spring::JointSpring;
use crate::looks::Form;
use crate::xml::Spot;
use eigenbody::spatial::{Sym3, Transform, Vec3};
use std::collections::HashSet;
use std::rc::Rc;

/// How a joint moves, in MuJoCo's words.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Motion {
    Free,
    Ball,
    Slide,
    Hinge,
}

/// Whether a lone free joint moves its body's centre of mass along its principal axes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Align {
    Never,
    Always,
    /// As `<compiler alignfree>` says.
    Auto,
}

/// A joint, in its body's frame.
#[derive(Debug, Clone)]
pub(super) struct Joint {
    pub name: Option<String>,
    /// What other sections call it: its name before it was replicated.
    pub called: Option<String>,
    pub at: Spot,
    pub motion: Motion,
    pub pos: Vec3<f64>,
    pub axis: Vec3<f64>,
    /// The coordinate in the pose that the file describes (rad, m).
    pub reference: f64,
    pub armature: f64,
    pub spring: JointSpring,
    pub limits: Option<(f64, f64)>,
    pub align: Align,
}

/// `<inertial>`: mass, centre and inertia about it, in the body's frame.
#[derive(Debug, Clone)]
pub(super) struct Inertial {
    pub mass: f64,
    pub pose: Transform<f64>,
    pub inertia: Moments,
}

/// Moments on the inertial frame's axes, or in full.
#[derive(Debug, Clone)]
pub(super) enum Moments {
    Diagonal([f64; 3]),
    Full(Sym3<f64>),
}

/// A geom, site, camera, light or frame by its name.
#[derive(Debug, Clone)]
pub(super) struct Named {
    pub kind: &'static str,
    pub name: String,
    pub at: Spot,
}

/// A body.
#[derive(Debug, Clone)]
pub(super) struct Body {
    pub name: Option<String>,
    pub at: Spot,
    /// Its frame in its parent's.
    pub pose: Transform<f64>,
    /// Its frame in the `<frame>` around it.
    pub own_pose: Transform<f64>,
    pub joints: Vec<Joint>,
    pub inertial: Option<Inertial>,
    pub geoms: Vec<Geom>,
    /// What is drawn of it, each from the body's frame to the shape's.
    pub looks: Vec<(Transform<f64>, Form)>,
    /// Sites that loops may be fastened to, by name, each from the body's frame to its own.
    pub sites: Vec<(String, Transform<f64>)>,
    /// What else in it bears a name.
    pub named: Vec<Named>,
    pub children: Vec<usize>,
    pub settings: Rc<Compiler>,
}

/// All bodies of a document; the children of a body are in the order of the file.
#[derive(Debug)]
pub(super) struct Tree {
    pub bodies: Vec<Body>,
    /// Kinds and names of what was replicated: other sections speak of all copies by them.
    pub replicated: HashSet<(&'static str, String)>,
}

/// How copies are named.
#[derive(Debug, Clone, Copy)]
pub(super) enum Rename<'a> {
    /// Attached: the other sections of the attached model get the prefix too.
    Prefix(&'a str),
    /// Replicated: the other sections speak of all copies by the first name.
    Suffix(&'a str),
}

impl Rename<'_> {
    fn name(self, name: &str) -> String {
        match self {
            Self::Prefix(prefix) => format!("{prefix}{name}"),
            Self::Suffix(suffix) => format!("{name}{suffix}"),
        }
    }

    fn called(self, name: &str) -> String {
        match self {
            Self::Prefix(prefix) => format!("{prefix}{name}"),
            Self::Suffix(_) => name.to_owned(),
        }
    }
}

/// Some bodies, numbered from the first.
#[derive(Debug, Clone)]
pub(super) struct Part {
    pub first: usize,
    pub bodies: Vec<Body>,
}

impl Part {
    /// A body by its number.
    pub fn body(&self, id: usize) -> &Body {
        &self.bodies[id - self.first]
    }

    /// How many bodies, and geoms or what else has a name, stand in a body.
    pub fn size(&self, of: usize) -> (usize, usize) {
        let (mut bodies, mut geoms, mut stack) = (0, 0, vec![of]);
        while let Some(id) = stack.pop() {
            let body = self.body(id);
            geoms += (body.geoms.len() + body.looks.len()).max(body.named.len());
            bodies += self.body(id).children.len();
            stack.extend(&self.body(id).children);
        }
        (bodies, geoms)
    }
}

/// The world body.
pub(super) const WORLD: usize = 0;

impl Tree {
    /// The world alone.
    pub fn new(at: Spot, settings: &Rc<Compiler>) -> Self {
        Self { bodies: vec![Body::new(at, settings)], replicated: HashSet::new() }
    }

    /// Adds a body below another one.
    pub fn add(&mut self, parent: usize, body: Body) -> usize {
        let id = self.add_loose(body);
        self.bodies[parent].children.push(id);
        id
    }

    /// Adds a body that hangs nowhere yet.
    pub fn add_loose(&mut self, body: Body) -> usize {
        self.bodies.push(body);
        self.bodies.len() - 1
    }

    /// Notes what a part bears by name as replicated.
    pub fn replicate(&mut self, part: &Part) {
        for body in &part.bodies {
            self.replicated.extend(body.name.clone().map(|name| ("body", name)));
            self.replicated.extend(body.joints.iter().filter_map(|j| Some(("joint", j.name.clone()?))));
            self.replicated.extend(body.named.iter().map(|n| (n.kind, n.name.clone())));
        }
    }

    /// Takes away the last bodies, from one on.
    pub fn split_off(&mut self, first: usize) -> Part {
        Part { first, bodies: self.bodies.split_off(first) }
    }

    /// A copy of a body and all that it carries, and the body's number in it.
    pub fn part(&self, of: usize) -> (Part, usize) {
        let mut bodies: Vec<Body> = Vec::new();
        let mut stack = vec![(of, None)];
        while let Some((id, parent)) = stack.pop() {
            let number = bodies.len();
            let mut copy = self.bodies[id].clone();
            stack.extend(copy.children.drain(..).rev().map(|child| (child, Some(number))));
            bodies.push(copy);
            if let Some(parent) = parent {
                bodies[parent].children.push(number);
            }
        }
        (Part { first: 0, bodies }, 0)
    }

    /// Copies what stands in a body into a body of this tree, displaced and renamed.
    pub fn copy_contents(
        &mut self,
        part: &Part,
        from: usize,
        to: usize,
        place: Transform<f64>,
        rename: &Rename<'_>,
    ) {
        let geoms = part.body(from).geoms.iter().map(|g| Geom { pose: g.pose * place, ..*g });
        self.bodies[to].geoms.extend(geoms);
        let looks = part.body(from).looks.iter().map(|(pose, form)| (*pose * place, form.clone()));
        self.bodies[to].looks.extend(looks);
        let sites = part.body(from).sites.iter().map(|(name, pose)| (rename.name(name), *pose * place));
        self.bodies[to].sites.extend(sites);
        let named = part.body(from).named.iter().map(|n| Named { name: rename.name(&n.name), ..*n });
        self.bodies[to].named.extend(named);
        for &child in &part.body(from).children {
            self.copy_body(part, child, to, part.body(child).pose * place, rename);
        }
    }

    /// Copies a body with all that it carries to a pose in its new parent.
    pub fn copy_body(
        &mut self,
        part: &Part,
        from: usize,
        parent: usize,
        pose: Transform<f64>,
        rename: &Rename<'_>,
    ) {
        let mut stack = vec![(from, parent, Some(pose))];
        while let Some((from, parent, pose)) = stack.pop() {
            let mut copy = part.body(from).clone();
            let children = std::mem::take(&mut copy.children);
            copy.name = copy.name.as_deref().map(|name| rename.name(name));
            copy.sites.iter_mut().for_each(|(name, _)| *name = rename.name(name));
            copy.named.iter_mut().for_each(|named| named.name = rename.name(&named.name));
            copy.joints.iter_mut().for_each(|joint| {
                joint.name = joint.name.as_deref().map(|name| rename.name(name));
                joint.called = joint.called.as_deref().map(|name| rename.called(name));
            });
            copy.pose = pose.unwrap_or(copy.pose);
            let id = self.add(parent, copy);
            stack.extend(children.into_iter().rev().map(|child| (child, id, None)));
        }
    }

    /// The bodies below the world, a body before its subtree, in the order of the file, each with its parent.
    pub fn pre_order(&self) -> Vec<(usize, usize)> {
        let mut order = Vec::new();
        let mut stack = vec![(WORLD, WORLD)];
        while let Some((id, parent)) = stack.pop() {
            if id != WORLD {
                order.push((id, parent));
            }
            stack.extend(self.bodies[id].children.iter().rev().map(|&child| (child, id)));
        }
        order
    }
}

impl Body {
    /// A body without anything.
    pub fn new(at: Spot, settings: &Rc<Compiler>) -> Self {
        Self {
            name: None,
            at,
            pose: Transform::IDENTITY,
            own_pose: Transform::IDENTITY,
            joints: Vec::new(),
            inertial: None,
            geoms: Vec::new(),
            looks: Vec::new(),
            sites: Vec::new(),
            named: Vec::new(),
            children: Vec::new(),
            settings: Rc::clone(settings),
        }
    }
}

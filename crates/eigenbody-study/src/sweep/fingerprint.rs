//! Hashes of a plan and of a robot, over an encoding that is written out here.
//!
//! ```text
//! number       its 64 bits
//! text, list   its length, then its bytes or entries
//! choice       the text or number that names it, then what it holds
//! ```
//! Two that differ have different encodings; neither how a type is printed nor where a file stands is part of one.

use eigenbody::joint::Joint;
use eigenbody::spatial::{RigidInertia, Transform, Vec3};
use eigenbody_formats::Loaded;

use super::spec::{Axis, Group, Robots, Spec};

/// The hash of Fowler, Noll and Vo, byte by byte.
struct Hash(u64);

impl Hash {
    fn new() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }

    fn bytes(&mut self, bytes: &[u8]) {
        for &byte in bytes {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x100_0000_01b3);
        }
    }

    fn whole(&mut self, whole: u64) {
        self.bytes(&whole.to_le_bytes());
    }

    fn flag(&mut self, flag: bool) {
        self.whole(u64::from(flag));
    }

    fn number(&mut self, number: f64) {
        self.whole(number.to_bits());
    }

    fn text(&mut self, text: &str) {
        self.whole(text.len() as u64);
        self.bytes(text.as_bytes());
    }

    fn list<I: ExactSizeIterator>(&mut self, entries: I, mut each: impl FnMut(&mut Self, I::Item)) {
        self.whole(entries.len() as u64);
        entries.for_each(|entry| each(self, entry));
    }

    fn numbers(&mut self, numbers: &[f64]) {
        self.list(numbers.iter(), |hash, &number| hash.number(number));
    }

    fn option<T>(&mut self, option: Option<T>, each: impl FnMut(&mut Self, T)) {
        self.list(option.into_iter(), each);
    }

    fn vector(&mut self, vector: Vec3<f64>) {
        vector.to_array().into_iter().for_each(|number| self.number(number));
    }

    fn joint(&mut self, joint: &Joint<f64>) {
        self.text(joint.kind());
        match *joint {
            Joint::Helical { pitch } => self.number(pitch),
            Joint::Universal { first } => self.vector(first),
            Joint::Fixed
            | Joint::Revolute
            | Joint::Continuous
            | Joint::Prismatic
            | Joint::Cylindrical
            | Joint::Planar
            | Joint::Spherical
            | Joint::Floating => {}
        }
    }

    fn axis(&mut self, axis: &Axis) {
        match axis {
            Axis::Values(values) => {
                self.text("values");
                self.numbers(values);
            }
            Axis::Range { from, to, count, log } => {
                self.text("range");
                self.number(*from);
                self.number(*to);
                self.option(*count, Self::whole);
                self.flag(*log);
            }
        }
    }

    fn group(&mut self, group: &Group) {
        let Group { robots, floating, mimic, reduced, at, random, places: _ } = group;
        match robots {
            Robots::Models(models) => {
                self.text("models");
                self.list(models.iter(), |hash, model| hash.text(model));
            }
            Robots::Family { name, axes, sample } => {
                self.text("family");
                self.text(name);
                axes.iter().for_each(|axis| self.axis(axis));
                self.option(*sample, Self::whole);
            }
        }
        self.list(floating.iter(), |hash, &floating| hash.flag(floating));
        self.option(*mimic, Self::flag);
        self.flag(*reduced);
        self.list(at.iter(), |hash, at| hash.text(at));
        self.whole(*random);
    }
}

/// Of a plan: the version, the spec, and the robots that are no family's, by name and hash.
pub(super) fn of_plan(version: &str, spec: &Spec, robots: &[(String, u64)]) -> u64 {
    let Spec { seed, metric, quantities, groups } = spec;
    let mut hash = Hash::new();
    hash.text(version);
    hash.whole(*seed);
    hash.text(metric);
    hash.list(quantities.iter(), |hash, quantity| hash.text(&quantity.field("").name));
    hash.list(groups.iter(), Hash::group);
    hash.list(robots.iter(), |hash, (name, robot)| {
        hash.text(name);
        hash.whole(*robot);
    });
    hash.0
}

/// Of a robot: bodies, joints, armature, gravity, mimic joints, keyframes, and what is removed from H unless the spec says otherwise.
pub(super) fn of_robot(robot: &Loaded) -> u64 {
    let model = &robot.model;
    let mut hash = Hash::new();
    hash.flag(robot.mimic);
    hash.flag(robot.is_family());
    hash.flag(model.has_floating_base());
    hash.list(model.bodies().iter(), |hash, body| {
        hash.option(body.parent(), |hash, parent| hash.whole(parent as u64));
        hash.whole(body.coordinates().start as u64);
        hash.whole(body.dofs().start as u64);
        hash.joint(body.joint());
        let Transform { E, r } = *body.tree_transform();
        [E.x, E.y, E.z, r].into_iter().for_each(|vector| hash.vector(vector));
        let RigidInertia { m, h, I } = *body.inertia();
        hash.number(m);
        hash.vector(h);
        [I.xx, I.yy, I.zz, I.xy, I.xz, I.yz].into_iter().for_each(|number| hash.number(number));
    });
    hash.list(model.joints().iter(), |hash, joint| {
        hash.text(joint.name());
        hash.joint(joint.kind());
        hash.whole(joint.coordinates().start as u64);
        hash.whole(joint.dofs().start as u64);
        hash.option(joint.limits(), |hash, (lower, upper)| {
            hash.number(lower);
            hash.number(upper);
        });
    });
    hash.numbers(model.armature());
    hash.vector(model.gravity());
    hash.option(model.coupling(), |hash, coupling| {
        hash.list(0..model.nq(), |hash, k| {
            let (leader, multiplier, offset) = coupling.follows(k);
            hash.whole(leader as u64);
            hash.number(multiplier);
            hash.number(offset);
        });
    });
    hash.list(robot.keyframes().iter(), |hash, keyframe| {
        hash.text(&keyframe.name);
        hash.numbers(&keyframe.q);
    });
    hash.0
}

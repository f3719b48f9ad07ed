//! Robots from seeds: what every identity is tried on.
//!
//! A [`Plan`] is a description in f64 that can be built in any scalar, with axes and quaternions made unit there, and that
//! can be described anew: in other frames, in another order, with fixed joints merged by hand.

use eigenbody::model::{JointSpec, LinkId, Random};
use eigenbody::scalar::Real;
use eigenbody::spatial::{Mat3, RigidInertia, Sym3, Transform, Vec3};
use eigenbody::{Base, Family, Joint, Model, ModelBuilder};

#[derive(Debug, Clone)]
pub struct PlanLink<T> {
    pub name: String,
    pub inertia: RigidInertia<T>,
}

/// Links and joints, in the order in which they are given to the builder.
#[derive(Debug, Clone)]
pub struct Plan<T> {
    pub links: Vec<PlanLink<T>>,
    pub joints: Vec<PlanJoint<T>>,
}

#[derive(Debug, Clone)]
pub struct PlanJoint<T> {
    pub name: String,
    pub kind: Joint<T>,
    /// Names of links.
    pub parent: String,
    pub child: String,
    pub placement: Transform<T>,
    pub axis: Vec3<T>,
    pub armature: Vec<T>,
}

/// A random tree of `links` moving links on a base, joints and links in random order.
pub fn plan<T: Real>(seed: u64, links: usize) -> Plan<T> {
    let mut random = Random::new(seed);
    let bushiness = random.uniform();
    let above = |random: &mut Random, i: usize| {
        if random.uniform() < bushiness { random.uniform() * i as f64 } else { (i - 1) as f64 }
    };
    hung(random, links, |random, i| above(random, i) as usize).shuffled(seed)
}

/// Random links on random joints, link i > 0 on link `parents[i - 1]`.
pub fn tree<T: Real>(seed: u64, parents: &[usize]) -> Plan<T> {
    hung(Random::new(seed), parents.len(), |_, i| parents[i - 1])
}

fn hung<T: Real>(mut random: Random, links: usize, above: impl Fn(&mut Random, usize) -> usize) -> Plan<T> {
    let base = PlanLink { name: "base".into(), inertia: inertia(&mut random) };
    let mut plan = Plan { links: vec![base], joints: Vec::new() };
    for i in 1..=links {
        let above = above(&mut random, i);
        let kind = kind(&mut random);
        let armed = random.uniform() < 0.3;
        let armature = (0..kind.nv()).map(|_| T::from_f64(random.between(0.0, 0.2))).collect();
        plan.joints.push(PlanJoint {
            name: format!("joint_{i}"),
            kind,
            parent: plan.links[above].name.clone(),
            child: format!("link_{i}"),
            placement: Transform::new(rotation(&mut random), vector(&mut random) * T::from_f64(0.5)),
            axis: vector(&mut random),
            armature: if armed { armature } else { Vec::new() },
        });
        plan.links.push(PlanLink { name: format!("link_{i}"), inertia: inertia(&mut random) });
    }
    plan
}

/// Every kind; first axes of universal joints are not perpendicular to the second.
fn kind<T: Real>(random: &mut Random) -> Joint<T> {
    match (random.uniform() * 12.0) as u32 {
        0 | 1 => Joint::Fixed,
        2 => Joint::Prismatic,
        3 => Joint::Helical { pitch: T::from_f64(random.between(-0.3, 0.3)) },
        4 => Joint::Cylindrical,
        5 => Joint::Universal { first: vector(random) },
        6 => Joint::Planar,
        7 => Joint::Spherical,
        8 => Joint::Floating,
        9 => Joint::Continuous,
        _ => Joint::Revolute,
    }
}

pub fn vector<T: Real>(random: &mut Random) -> Vec3<T> {
    Vec3::from_f64([0; 3].map(|_| random.between(-1.0, 1.0)))
}

pub fn rotation<T: Real>(random: &mut Random) -> Mat3<T> {
    let [w, x, y, z] = random.quaternion().map(T::from_f64);
    Mat3::rotation_quaternion(w, Vec3::new(x, y, z))
}

/// A solid ellipsoid with semi-axes of 5 to 40 cm, turned and shifted: principal moments m (b² + c²)/5.
fn inertia<T: Real>(random: &mut Random) -> RigidInertia<T> {
    let m = random.between(0.1, 5.0);
    let [a, b, c] = [0; 3].map(|_| random.between(0.05, 0.4).powi(2));
    let moments = [b + c, a + c, a + b].map(|x| T::from_f64(m * x / 5.0));
    let I = Sym3::diagonal(moments[0], moments[1], moments[2]).congruence(rotation(random));
    RigidInertia::from_com(T::from_f64(m), vector(random) * T::from_f64(0.3), I)
}

impl<T: Real> Plan<T> {
    /// The same robot described in another order.
    pub fn shuffled(mut self, seed: u64) -> Self {
        let mut random = Random::new(!seed);
        shuffle(&mut self.links, &mut random);
        shuffle(&mut self.joints, &mut random);
        self
    }

    /// The same robot with the frame of one link turned and shifted: `new` goes from the old frame to the new one.
    pub fn turn(&mut self, name: &str, new: Transform<T>) {
        let link = self.links.iter_mut().find(|link| link.name == name).unwrap();
        link.inertia = new.inverse().transpose_rigid(link.inertia);
        for joint in &mut self.joints {
            if joint.parent == name {
                joint.placement = joint.placement * new.inverse();
            }
            if joint.child == name {
                joint.placement = new * joint.placement;
                joint.axis = new.E * joint.axis;
                if let Joint::Universal { first } = &mut joint.kind {
                    *first = new.E * *first;
                }
            }
        }
    }

    /// One fixed joint less: its child made part of its parent. False if there is none.
    pub fn merge_one(&mut self) -> bool {
        let Some(j) = self.joints.iter().position(|joint| joint.kind == Joint::Fixed) else { return false };
        let fixed = self.joints.remove(j);
        let child = self.links.iter().position(|link| link.name == fixed.child).unwrap();
        let child = self.links.remove(child);
        let parent = self.links.iter_mut().find(|link| link.name == fixed.parent).unwrap();
        parent.inertia += fixed.placement.transpose_rigid(child.inertia);
        for joint in self.joints.iter_mut().filter(|joint| joint.parent == fixed.child) {
            joint.parent = fixed.parent.clone();
            joint.placement = joint.placement * fixed.placement;
        }
        true
    }

    pub fn build(&self, base: Base) -> Model<T> {
        let mut robot = ModelBuilder::new("random");
        robot.gravity(Vec3::from_f64([1.0, -3.0, -9.0]));
        let ids: Vec<LinkId> =
            self.links.iter().map(|link| robot.link(link.name.as_str(), link.inertia)).collect();
        let id = |name: &str| ids[self.links.iter().position(|link| link.name == name).unwrap()];
        for joint in &self.joints {
            let (parent, child) = (id(&joint.parent), id(&joint.child));
            let spec = JointSpec::new(joint.name.as_str(), joint.kind, parent, child);
            robot.joint(spec.at(joint.placement).about(joint.axis).with_armature(joint.armature.as_slice()));
        }
        robot.build(base).unwrap()
    }
}

fn shuffle<X>(items: &mut [X], random: &mut Random) {
    for i in (1..items.len()).rev() {
        items.swap(i, (random.uniform() * (i + 1) as f64) as usize);
    }
}

/// A robot at a random state.
pub struct Case<T> {
    pub name: String,
    pub model: Model<T>,
    pub q: Vec<T>,
    pub v: Vec<T>,
    pub vdot: Vec<T>,
}

impl<T: Real> Case<T> {
    pub fn new(name: String, model: Model<T>, seed: u64) -> Self {
        let q = configuration(&model, seed);
        let (v, vdot) = (numbers(model.nv(), seed + 1), numbers(model.nv(), seed + 2));
        Self { name, model, q, v, vdot }
    }

    pub fn nv(&self) -> usize {
        self.model.nv()
    }
}

/// n random numbers in [−1, 1).
pub fn numbers<T: Real>(n: usize, seed: u64) -> Vec<T> {
    let mut random = Random::new(seed.wrapping_mul(77));
    (0..n).map(|_| T::from_f64(random.between(-1.0, 1.0))).collect()
}

/// A random configuration, its quaternions drawn in f64 and made unit in T.
pub fn configuration<T: Real>(model: &Model<T>, seed: u64) -> Vec<T> {
    let mut q = model.random(seed);
    for joint in model.joints() {
        if let Some(at) = joint.kind().quaternion() {
            let at = joint.coordinates().start + at;
            let norm = q[at..at + 4].iter().fold(T::ZERO, |sum, &x| sum + x * x).sqrt();
            q[at..at + 4].iter_mut().for_each(|x| *x = *x / norm);
        }
    }
    q
}

/// Random trees of 1 to `largest` links, fixed and floating, and auto_tree robots up to the same size.
pub fn cases<T: Real>(largest: usize) -> Vec<Case<T>> {
    let sizes = [1, 2, 3, 4, 6, 9, 14, 20, 30, 45, 60].into_iter().filter(|&n| n <= largest);
    let mut cases = Vec::new();
    for (links, base) in sizes.flat_map(|n| [(n, Base::Fixed), (n, Base::Floating)]) {
        for round in 0..2 {
            let seed = 1000 * links as u64 + 10 * round + u64::from(base == Base::Floating);
            let name = format!("random tree {seed} of {links} links, {base:?}");
            cases.push(Case::new(name, plan(seed, links).build(base), seed));
        }
        let branching = 1.0 + (links % 3) as f64 / 2.0;
        let family = Family::auto_tree(links, branching, 0.3, 0.9).unwrap();
        let family = if base == Base::Floating { family.floating() } else { family };
        cases.push(Case::new(format!("{}, {base:?}", family.name()), family.model().unwrap(), links as u64));
    }
    cases
}

//! Bodies to links and joints.
//!
//! A body with several joints is a chain of links, massless but for the last. A joint's link has its origin at the joint; a
//! joint's reference coordinate is turned (or shifted) out of its placement, so that q is MuJoCo's qpos.

use super::body::{Body, Joint, Motion, Tree, WORLD};
use super::closure::Frames;
use super::coupling::Known;
use super::fault::{Fault, MjcfFault, fault, unsupported};
use super::mass::{self, Mass};
use super::spring::JointSpring;
use crate::looks::{Form, Look};
use crate::write::quaternion;
use crate::xml::{Element, Spot};
use eigenbody::dynamics::Anchor;
use eigenbody::model::{JointSpec, LinkId};
use eigenbody::spatial::{Mat3, RigidInertia, Transform, Vec3};
use eigenbody::{Base, Joint as Kind, ModelBuilder};
use std::collections::{HashMap, HashSet};

/// Links and joints, ready to be coupled and built.
pub(super) struct Parts {
    pub builder: ModelBuilder<f64>,
    /// The moving joints and welds, in the order in which the builder is to get them.
    pub joints: Vec<JointSpec<f64>>,
    pub link_names: Vec<String>,
    pub link_spots: Vec<Spot>,
    pub joint_spots: Vec<Spot>,
    /// The pose that the file describes.
    pub reference: Vec<f64>,
    /// Joints by what other sections call them: several if they were replicated.
    pub known: HashMap<String, Vec<Known>>,
    /// The root's own free joint that became the floating base, if there is one: where it stands, and its armature.
    pub base_armature: Option<(Spot, f64)>,
    /// Bodies and sites by name.
    pub frames: Frames,
    /// What is drawn of links.
    pub looks: Vec<Look>,
    /// Springs of joints, by the joint's position.
    pub springs: Vec<(usize, JointSpring)>,
    names: Names,
}

/// Names that are given out once.
#[derive(Default)]
struct Names {
    links: HashSet<String>,
    joints: HashSet<String>,
}

/// Where a body's link is: its id, and its origin in the body's frame.
#[derive(Clone, Copy)]
pub(super) struct Placed {
    pub link: LinkId,
    pub origin: Vec3<f64>,
}

/// The links and joints of a tree. `settled` is the mass that all bodies together are to have.
pub(super) fn parts(tree: &mut Tree, root: &Element, name: &str, base: Base) -> Result<Parts, Fault> {
    let order = tree.pre_order();
    check(tree, &order)?;
    let mut masses: HashMap<usize, Mass> = HashMap::with_capacity(order.len());
    for &(id, _) in &order {
        let body = &mut tree.bodies[id];
        let mut found = mass::of(body)?;
        mass::align(body, &mut found);
        masses.insert(id, found);
    }
    let scale = scale(tree, &order, &masses, root)?;

    let mut parts = Parts {
        builder: ModelBuilder::new(name),
        joints: Vec::new(),
        link_names: Vec::new(),
        link_spots: Vec::new(),
        joint_spots: Vec::new(),
        reference: Vec::new(),
        known: HashMap::new(),
        base_armature: None,
        frames: Frames::default(),
        looks: Vec::new(),
        springs: Vec::new(),
        names: Names::reserving(tree, &order),
    };
    let mut placed: HashMap<usize, Placed> = HashMap::with_capacity(order.len() + 1);
    if base == Base::Fixed {
        let link = parts.link("world", RigidInertia::ZERO, tree.bodies[WORLD].at);
        placed.insert(WORLD, Placed { link, origin: Vec3::ZERO });
    }
    for (number, &(id, parent)) in order.iter().enumerate() {
        let (body, mass) = (&tree.bodies[id], &masses[&id]);
        let name = body.name.clone().unwrap_or_else(|| parts.names.link(&format!("body_{}", number + 1)));
        let here = match placed.get(&parent) {
            Some(&on) => parts.body(body, &name, mass, scale, on),
            // The root of a floating base.
            None => {
                let link = parts.link(&name, mass.about(Vec3::ZERO, scale), body.at);
                parts.base_armature = body.joints.first().map(|joint| (joint.at, joint.armature));
                parts.reference.extend(pose_coordinates(&body.pose));
                Placed { link, origin: Vec3::ZERO }
            }
        };
        placed.insert(id, here);
        let shift = Transform::translation(-here.origin);
        parts.draw(body, here);
        parts.frames.bodies.insert(name, here);
        for (site, pose) in &body.sites {
            let pose = *pose * shift;
            parts.frames.sites.insert(site.clone(), Anchor { link: Some(here.link.index()), pose });
        }
    }
    if let Some(&world) = placed.get(&WORLD) {
        parts.draw(&tree.bodies[WORLD], world);
    }
    for (site, pose) in &tree.bodies[WORLD].sites {
        parts.frames.sites.insert(site.clone(), Anchor { link: None, pose: *pose });
    }
    Ok(parts)
}

/// The root body if a floating base can be put under it: the only tree, welded to the world or free already.
pub(super) fn can_float(tree: &Tree) -> bool {
    match tree.bodies[WORLD].children.as_slice() {
        [root] => match tree.bodies[*root].joints.as_slice() {
            [] => true,
            [joint] => joint.motion == Motion::Free,
            _ => false,
        },
        _ => false,
    }
}

fn check(tree: &Tree, order: &[(usize, usize)]) -> Result<(), Fault> {
    for &(id, parent) in order {
        let body = &tree.bodies[id];
        let name = || body.name.clone().unwrap_or_else(|| "without a name".to_owned());
        let mut dofs = 0;
        let mut ball = false;
        for joint in &body.joints {
            let joint_name = || joint.name.clone().map_or("<joint>".to_owned(), |n| format!("joint '{n}'"));
            if joint.motion == Motion::Free && parent != WORLD {
                return Err(fault(joint.at, MjcfFault::FreeBelow { joint: joint_name() }));
            }
            if ball && matches!(joint.motion, Motion::Ball | Motion::Hinge) {
                return Err(fault(joint.at, MjcfFault::RotationAfterBall { body: name() }));
            }
            ball |= joint.motion == Motion::Ball;
            dofs += kind(joint.motion).nv();
            if dofs > 6 {
                return Err(fault(joint.at, MjcfFault::TooManyDofs { body: name() }));
            }
        }
    }
    Ok(())
}

/// What all masses are multiplied by, so that their sum is `settotalmass`.
fn scale(
    tree: &Tree,
    order: &[(usize, usize)],
    masses: &HashMap<usize, Mass>,
    root: &Element,
) -> Result<f64, Fault> {
    let settings = &tree.bodies[WORLD].settings;
    let Some(wanted) = settings.settotalmass.filter(|&m| m > 0.0) else { return Ok(1.0) };
    let total: f64 = order.iter().map(|(id, _)| masses[id].m).sum();
    if settings.fusestatic {
        let mut fixed = HashSet::from([WORLD]);
        for &(id, parent) in order {
            if fixed.contains(&parent) && tree.bodies[id].joints.is_empty() {
                fixed.insert(id);
                if masses[&id].m > 0.0 {
                    let compiler = root.children_named("compiler").last().unwrap_or(root);
                    let why = "settotalmass with fusestatic depends on which fixed bodies MuJoCo keeps";
                    return Err(unsupported(compiler, why));
                }
            }
        }
    }
    Ok(if total > 0.0 { wanted / total } else { 1.0 })
}

fn kind(motion: Motion) -> Kind<f64> {
    match motion {
        Motion::Free => Kind::Floating,
        Motion::Ball => Kind::Spherical,
        Motion::Slide => Kind::Prismatic,
        Motion::Hinge => Kind::Revolute,
    }
}

/// x, y, z, w, x, y, z of a pose.
fn pose_coordinates(pose: &Transform<f64>) -> impl Iterator<Item = f64> {
    pose.r.to_array().into_iter().chain(quaternion(&pose.E))
}

impl Names {
    /// All names that the file gives are taken.
    fn reserving(tree: &Tree, order: &[(usize, usize)]) -> Self {
        let mut names = Self::default();
        for &(id, _) in order {
            let body = &tree.bodies[id];
            names.links.extend(body.name.clone());
            names.joints.extend(body.joints.iter().filter_map(|j| j.name.clone()));
        }
        names
    }

    fn link(&mut self, wish: &str) -> String {
        take(&mut self.links, wish)
    }

    fn joint(&mut self, wish: &str) -> String {
        take(&mut self.joints, wish)
    }
}

/// The name wished for, with underscores until nobody has it.
fn take(taken: &mut HashSet<String>, wish: &str) -> String {
    let mut name = wish.to_owned();
    while !taken.insert(name.clone()) {
        name.push('_');
    }
    name
}

impl Parts {
    /// What is drawn of a body, as of its link.
    fn draw(&mut self, body: &Body, here: Placed) {
        let Some(link) = self.link_names.get(here.link.index()) else { return };
        let look = |(pose, form): &(Transform<f64>, Form)| Look {
            link: link.clone(),
            pose: *pose * Transform::translation(-here.origin),
            form: form.clone(),
        };
        self.looks.extend(body.looks.iter().map(look));
    }

    fn link(&mut self, name: &str, inertia: RigidInertia<f64>, at: Spot) -> LinkId {
        self.link_spots.push(at);
        self.link_names.push(name.to_owned());
        self.builder.link(name, inertia)
    }

    /// A body's links and joints on its parent's link.
    fn body(&mut self, body: &Body, name: &str, mass: &Mass, scale: f64, on: Placed) -> Placed {
        // From the carrier's link to this body's frame.
        let mut frame = body.pose * Transform::translation(-on.origin);
        let mut carrier = on.link;
        let Some(last) = body.joints.len().checked_sub(1) else {
            let link = self.link(name, mass.about(Vec3::ZERO, scale), body.at);
            let weld = self.names.joint(&format!("{name} weld"));
            self.joints.push(JointSpec::new(weld, Kind::Fixed, carrier, link).at(frame));
            self.joint_spots.push(body.at);
            return Placed { link, origin: Vec3::ZERO };
        };
        for (k, joint) in body.joints.iter().enumerate() {
            let link = match k == last {
                true => self.link(name, mass.about(joint.pos, scale), body.at),
                false => {
                    let between = self.names.link(&format!("{name} {}", k + 1));
                    self.link_spots.push(body.at);
                    self.link_names.push(between.clone());
                    self.builder.frame(between)
                }
            };
            self.joint(joint, body, carrier, link, &frame);
            frame = Transform::translation(-joint.pos);
            carrier = link;
        }
        Placed { link: carrier, origin: body.joints[last].pos }
    }

    fn joint(&mut self, joint: &Joint, body: &Body, carrier: LinkId, link: LinkId, frame: &Transform<f64>) {
        let number = self.joints.len();
        let name = joint.name.clone().unwrap_or_else(|| self.names.joint(&format!("joint_{number}")));
        let kind = kind(joint.motion);
        let back = match joint.motion {
            Motion::Hinge => {
                Transform::new(Mat3::rotation_about(joint.axis, (-joint.reference).sin_cos()), Vec3::ZERO)
            }
            Motion::Slide => Transform::translation(joint.axis * -joint.reference),
            Motion::Ball | Motion::Free => Transform::IDENTITY,
        };
        let placement = match joint.motion {
            // qpos is the pose in the world, whatever the body's own.
            Motion::Free => Transform::IDENTITY,
            _ => back * Transform::translation(joint.pos) * *frame,
        };
        match joint.motion {
            Motion::Free => self.reference.extend(pose_coordinates(&body.pose)),
            Motion::Ball => self.reference.extend([1.0, 0.0, 0.0, 0.0]),
            Motion::Slide | Motion::Hinge => self.reference.push(joint.reference),
        }
        let single = matches!(joint.motion, Motion::Slide | Motion::Hinge);
        let known = Known { joint: self.joints.len(), single, reference: joint.reference };
        let names =
            [joint.called.as_ref(), joint.name.as_ref().filter(|name| joint.called.as_ref() != Some(name))];
        for name in names.into_iter().flatten() {
            self.known.entry(name.clone()).or_default().push(known);
        }
        self.springs.push((number, joint.spring));
        let armature = if joint.armature == 0.0 { Vec::new() } else { vec![joint.armature; kind.nv()] };
        self.joint_spots.push(joint.at);
        self.joints.push(JointSpec {
            placement,
            axis: joint.axis,
            armature,
            limits: joint.limits,
            ..JointSpec::new(name, kind, carrier, link)
        });
    }
}

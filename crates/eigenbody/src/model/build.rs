//! From a description to a model: order, frames, merged inertias, derived tables.

use super::body::{Body, JointInfo, LinkInfo, WORLD};
use super::builder::{Base, JointId, JointSpec, LinkId, MimicSpec, ModelBuilder};
use super::error::BuildError;
use super::number::{Fault, check_armature, check_inertia, crossed_limits};
use super::topology::{Node, pre_order};
use super::{Deferred, DofTree, MAX_BODIES, Model, ROTATION_TOLERANCE, Shape, canonical, coupling, finding};
use crate::joint::Joint;
use crate::scalar::Real;
use crate::spatial::{Mat3, RigidInertia, Transform, Vec3};

const BASE_JOINT: &str = "floating_base";

pub(super) fn build<T: Real>(mut robot: ModelBuilder<T>, base: Base) -> Result<Model<T>, BuildError> {
    if robot.links.len() > MAX_BODIES {
        return Err(BuildError::TooManyBodies { count: robot.links.len(), limit: MAX_BODIES });
    }
    if !robot.gravity.to_array().iter().all(|x| x.is_finite()) {
        return Err(BuildError::GravityNotFinite);
    }
    let mut nodes = pre_order(&robot)?;
    check_links(&robot)?;
    robot.joints.iter_mut().enumerate().try_for_each(|(j, spec)| check_joint(JointId(j as u32), spec))?;
    let mut findings = finding::of_links(&robot);

    if base == Base::Floating {
        // Fixed joints leave no name behind.
        let taken = |spec: &JointSpec<T>| spec.name == BASE_JOINT && spec.kind.nv() > 0;
        if let Some(j) = robot.joints.iter().position(taken) {
            return Err(BuildError::DuplicateJoint { joint: JointId(j as u32), name: BASE_JOINT.into() });
        }
        nodes[0].joint = Some(robot.joints.len());
        let root = LinkId(nodes[0].link as u32);
        robot.joints.push(JointSpec::new(BASE_JOINT, Joint::Floating, root, root));
    }

    let slots = slots(&robot.joints, base);
    let (mut links, inertias): (Vec<LinkInfo<T>>, Vec<RigidInertia<T>>) =
        robot.links.into_iter().map(|(name, I)| (LinkInfo { name, body: WORLD, X_link: None }, I)).unzip();
    let bodies = place_bodies(&nodes, &robot.joints, &slots, &inertias, &mut links);
    drop((nodes, inertias));
    let dofs = dof_tree(&bodies);
    findings.extend(finding::of_bodies(&links, &bodies, &robot.frames));

    // The coordinates of a floating base, the last joint of the description, come first.
    let mut described: Vec<_> = slots.into_iter().zip((0..).map(JointId)).collect();
    let first = usize::from(base == Base::Floating);
    described.rotate_right(first);
    robot.joints.rotate_right(first);

    let mut joints = Vec::with_capacity(dofs.len());
    let mut mimics: Vec<(JointId, MimicSpec<T>, usize)> = Vec::new();
    let mut dof_joint = Vec::with_capacity(dofs.len());
    let mut armature = Vec::with_capacity(dofs.len());
    for ((slot, id), spec) in described.into_iter().zip(robot.joints) {
        let Some(Slot { q0, v0 }) = slot else { continue };
        let nv = spec.kind.nv();
        dof_joint.extend(std::iter::repeat_n(joints.len() as u32, nv));
        armature.extend((0..nv).map(|k| spec.armature.get(k).copied().unwrap_or(T::ZERO)));
        mimics.extend(spec.mimic.map(|mimic| (id, mimic, joints.len())));
        joints.push(JointInfo { name: spec.name.into(), kind: spec.kind, q0, v0, limits: spec.limits });
    }
    let coupling = coupling::resolve(&joints, mimics, &mut findings)?;
    Ok(Model {
        name: robot.name,
        nq: joints.iter().map(|j| j.kind.nq()).sum(),
        floating_base: base == Base::Floating,
        gravity: robot.gravity,
        shape: Shape::of(&bodies),
        bodies,
        mechanism: Deferred::default(),
        links,
        quaternions: quaternions(&joints),
        joints,
        dofs,
        dof_joint,
        armature,
        coupling,
        findings,
    })
}

/// The joints whose coordinates hold a quaternion, and where it begins in q.
fn quaternions<T: Real>(joints: &[JointInfo<T>]) -> Vec<(u32, u32)> {
    let start = |joint: &JointInfo<T>| joint.kind.quaternion().map(|at| joint.q0 + at as u32);
    (0..).zip(joints).filter_map(|(index, joint)| Some((index, start(joint)?))).collect()
}

fn check_links<T: Real>(robot: &ModelBuilder<T>) -> Result<(), BuildError> {
    for (i, (name, inertia)) in robot.links.iter().enumerate() {
        let (link, name) = (LinkId(i as u32), || name.to_string());
        check_inertia(inertia).map_err(|fault| match fault {
            Fault::Negative { value: mass, .. } => BuildError::NegativeMass { link, name: name(), mass },
            Fault::NotFinite { what, .. } => BuildError::LinkNotFinite { link, name: name(), what },
        })?;
    }
    Ok(())
}

/// Checks a joint's numbers and makes its axis a unit vector.
fn check_joint<T: Real>(joint: JointId, spec: &mut JointSpec<T>) -> Result<(), BuildError> {
    let name = || spec.name.clone();
    let finite = |numbers: &[T], what| match numbers.iter().all(|x| x.is_finite()) {
        true => Ok(()),
        false => Err(BuildError::JointNotFinite { joint, name: name(), what }),
    };
    finite(&spec.axis.to_array(), "axis")?;
    finite(&spec.placement.r.to_array(), "origin")?;
    let E = spec.placement.E;
    finite([E.x, E.y, E.z].map(Vec3::to_array).as_flattened(), "orientation")?;
    if !E.is_rotation(ROTATION_TOLERANCE) {
        return Err(BuildError::NotARotation { joint, name: name() });
    }
    if let Joint::Helical { pitch } = spec.kind {
        finite(&[pitch], "pitch")?;
    }
    if let Some(mimic) = &spec.mimic {
        finite(&[mimic.multiplier, mimic.offset], "mimic")?;
        if spec.kind.nq() > 1 {
            return Err(BuildError::MimicKind { joint, name: name(), kind: spec.kind.kind() });
        }
    }
    let nv = spec.kind.nv();
    if !spec.armature.is_empty() && spec.armature.len() != nv {
        return Err(BuildError::ArmatureLength {
            joint,
            name: name(),
            expected: nv,
            found: spec.armature.len(),
        });
    }
    let located = |fault| match fault {
        Fault::NotFinite { what, .. } => BuildError::JointNotFinite { joint, name: name(), what },
        Fault::Negative { value: armature, .. } => {
            BuildError::NegativeArmature { joint, name: name(), armature }
        }
    };
    check_armature(&spec.armature).map_err(located)?;
    if let Some((lower, upper)) = crossed_limits(spec.limits).map_err(located)? {
        return Err(BuildError::CrossedLimits { joint, name: name(), lower, upper });
    }
    let unit = |a: Vec3<T>| match a.x.abs().max(a.y.abs()).max(a.z.abs()) {
        largest if largest > T::ZERO => {
            // Scaled first: the squares of an axis of any length neither overflow nor vanish.
            let a = a.map(|x| x / largest);
            Ok(a * (T::ONE / a.norm()))
        }
        _ => Err(BuildError::ZeroAxis { joint, name: name() }),
    };
    if !matches!(spec.kind, Joint::Fixed | Joint::Spherical | Joint::Floating) {
        spec.axis = unit(spec.axis)?;
    }
    if let Joint::Universal { first } = &mut spec.kind {
        finite(&first.to_array(), "first axis")?;
        *first = unit(*first)?;
    }
    Ok(())
}

/// Where a joint's coordinates and degrees of freedom stand.
#[derive(Clone, Copy)]
struct Slot {
    q0: u32,
    v0: u32,
}

/// Joints in the order given, a floating base (the last of the list) before them all; none for a fixed joint.
fn slots<T: Real>(joints: &[JointSpec<T>], base: Base) -> Vec<Option<Slot>> {
    let (given, base) = joints.split_at(joints.len() - usize::from(base == Base::Floating));
    let mut next = Slot { q0: 0, v0: 0 };
    let mut take = |spec: &JointSpec<T>| {
        let slot = next;
        next.q0 += spec.kind.nq() as u32;
        next.v0 += spec.kind.nv() as u32;
        (spec.kind.nv() > 0).then_some(slot)
    };
    let first: Vec<_> = base.iter().map(&mut take).collect();
    let mut slots: Vec<_> = given.iter().map(&mut take).collect();
    slots.extend(first);
    slots
}

/// Bodies in pre-order, in internal frames, with merged inertias; each link is told its body and its place on it.
fn place_bodies<T: Real>(
    nodes: &[Node],
    joints: &[JointSpec<T>],
    slots: &[Option<Slot>],
    inertias: &[RigidInertia<T>],
    links: &mut [LinkInfo<T>],
) -> Vec<Body<T>> {
    let mut bodies: Vec<Body<T>> = Vec::with_capacity(nodes.len());
    for node in nodes {
        let I = inertias[node.link];
        let Some(j) = node.joint else { continue };
        let spec = &joints[j];
        let carrier = &links[spec.parent.index()];
        let (parent, X_joint) = (carrier.body, spec.placement * carrier.link_from_body());
        let (body, X_link) = match slots[j] {
            None => {
                if parent != WORLD {
                    bodies[parent as usize].I += X_joint.transpose_rigid(I);
                }
                (parent, X_joint)
            }
            Some(Slot { q0, v0 }) => {
                let turn = Transform::new(axis_to_z(spec), Vec3::ZERO);
                let joint = match spec.kind {
                    Joint::Universal { first } => Joint::Universal { first: turn.E * first },
                    kind => kind,
                };
                let (X_tree, I) = (turn * X_joint, turn.inverse().transpose_rigid(I));
                bodies.push(Body { parent, q0, v0, link: node.link as u32, joint, X_tree, I });
                (bodies.len() as u32 - 1, turn.inverse())
            }
        };
        links[node.link].body = body;
        links[node.link].X_link = (X_link != Transform::IDENTITY).then(|| Box::new(X_link));
    }
    bodies
}

fn axis_to_z<T: Real>(spec: &JointSpec<T>) -> Mat3<T> {
    match spec.kind {
        Joint::Fixed | Joint::Spherical | Joint::Floating => Mat3::IDENTITY,
        _ => canonical::z_from_axis(spec.axis),
    }
}

fn dof_tree<T: Real>(bodies: &[Body<T>]) -> DofTree {
    let nv = bodies.iter().map(|b| b.joint.nv()).sum();
    let mut parent = vec![None; nv];
    let mut order = Vec::with_capacity(nv);
    for body in bodies {
        let mut above = body.parent().map(|p| bodies[p].dofs().end - 1);
        for d in body.dofs() {
            parent[d] = above.replace(d);
            order.push(d as u32);
        }
    }
    DofTree::new(parent, order)
}

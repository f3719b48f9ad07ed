//! From links and joints in any order to a tree in pre-order.

use super::builder::{JointId, JointSpec, LinkId, ModelBuilder};
use super::error::BuildError;
use std::hash::{DefaultHasher, Hash, Hasher};

/// A link with the joint that carries it; none for the root.
pub(super) struct Node {
    pub link: usize,
    pub joint: Option<usize>,
}

/// Every link once, a link before those it carries, subtrees contiguous, the largest subtree of siblings last.
///
/// With the largest last, a sweep from the end keeps at most log₂ N subtrees waiting.
pub(super) fn pre_order<T>(robot: &ModelBuilder<T>) -> Result<Vec<Node>, BuildError> {
    known_links(robot)?;
    unique_names(robot)?;
    let inbound = inbound_joints(robot)?;
    let root = single_root(robot, &inbound)?;
    let children = Children::new(robot);
    let nodes = children.descend(root, &vec![0; robot.links.len()]);
    if nodes.len() < robot.links.len() {
        return Err(find_loop(robot, &inbound, &nodes));
    }
    let mut size = vec![1u32; robot.links.len()];
    for node in nodes.iter().rev() {
        if let Some(j) = node.joint {
            size[children.joints[j].parent.index()] += size[node.link];
        }
    }
    Ok(children.descend(root, &size))
}

/// The joints that each link carries, as linked lists in the order of the joints.
struct Children {
    first: Vec<Option<JointId>>,
    joints: Vec<Edge>,
}

/// What the tree knows of a joint.
struct Edge {
    parent: LinkId,
    child: LinkId,
    /// The next joint that the same link carries.
    next: Option<JointId>,
}

impl Children {
    fn new<T>(robot: &ModelBuilder<T>) -> Self {
        let mut first = vec![None; robot.links.len()];
        let edge = |joint: &JointSpec<T>| Edge { parent: joint.parent, child: joint.child, next: None };
        let mut joints: Vec<Edge> = robot.joints.iter().map(edge).collect();
        for (j, joint) in joints.iter_mut().enumerate().rev() {
            joint.next = first[joint.parent.index()].replace(JointId(j as u32));
        }
        Self { first, joints }
    }

    /// Pre-order from `root`, siblings by ascending size.
    fn descend(&self, root: usize, size: &[u32]) -> Vec<Node> {
        let edge = |j: JointId| &self.joints[j.index()];
        let mut nodes = Vec::with_capacity(self.first.len());
        let mut stack = Vec::new();
        let mut visit = Some(Node { link: root, joint: None });
        while let Some(node) = visit {
            let waiting = stack.len();
            stack.extend(std::iter::successors(self.first[node.link], |&j| edge(j).next));
            stack[waiting..].reverse();
            stack[waiting..].sort_by_key(|&j| std::cmp::Reverse(size[edge(j).child.index()]));
            nodes.push(node);
            visit = stack.pop().map(|j| Node { link: edge(j).child.index(), joint: Some(j.index()) });
        }
        nodes
    }
}

/// A [`LinkId`] may be another builder's.
fn known_links<T>(robot: &ModelBuilder<T>) -> Result<(), BuildError> {
    for (j, joint) in robot.joints.iter().enumerate() {
        let mut ends = [joint.parent, joint.child].into_iter();
        if let Some(link) = ends.find(|link| link.index() >= robot.links.len()) {
            let (joint, name) = (JointId(j as u32), joint.name.clone());
            return Err(BuildError::UnknownLink { joint, name, link, count: robot.links.len() });
        }
    }
    Ok(())
}

fn unique_names<T>(robot: &ModelBuilder<T>) -> Result<(), BuildError> {
    if let Some(i) = second_of_a_name(robot.links.len(), |i| &robot.links[i].0) {
        return Err(BuildError::DuplicateLink { link: LinkId(i as u32), name: robot.links[i].0.to_string() });
    }
    if let Some(j) = second_of_a_name(robot.joints.len(), |j| &robot.joints[j].name) {
        return Err(BuildError::DuplicateJoint {
            joint: JointId(j as u32),
            name: robot.joints[j].name.clone(),
        });
    }
    Ok(())
}

/// The first of `n` names that was there before. By sorted hashes: a table of a million names would wait for memory at each.
fn second_of_a_name<'a>(n: usize, name: impl Fn(usize) -> &'a str) -> Option<usize> {
    let hash = |i: usize| {
        let mut hasher = DefaultHasher::new();
        name(i).hash(&mut hasher);
        (hasher.finish(), i as u32)
    };
    let mut hashes: Vec<(u64, u32)> = (0..n).map(hash).collect();
    hashes.sort_unstable();
    let same = |group: &[(u64, u32)]| {
        let seconds = group.iter().enumerate().skip(1);
        let mut again = seconds.filter(|(k, (_, i))| {
            group[..*k].iter().any(|(_, before)| name(*before as usize) == name(*i as usize))
        });
        again.next().map(|(_, (_, i))| *i as usize)
    };
    hashes.chunk_by(|a, b| a.0 == b.0).filter_map(same).min()
}

/// The joint that carries each link.
fn inbound_joints<T>(robot: &ModelBuilder<T>) -> Result<Vec<Option<usize>>, BuildError> {
    let mut inbound: Vec<Option<usize>> = vec![None; robot.links.len()];
    for (j, joint) in robot.joints.iter().enumerate() {
        if let Some(first) = inbound[joint.child.index()].replace(j) {
            return Err(BuildError::TwoParents {
                second: JointId(j as u32),
                link_name: link_name(robot, joint.child.index()),
                first: robot.joints[first].name.clone(),
                second_name: joint.name.clone(),
            });
        }
    }
    Ok(inbound)
}

fn single_root<T>(robot: &ModelBuilder<T>, inbound: &[Option<usize>]) -> Result<usize, BuildError> {
    let mut roots = (0..robot.links.len()).filter(|&i| inbound[i].is_none());
    match (roots.next(), roots.next()) {
        (Some(root), None) => Ok(root),
        (Some(first), Some(second)) => Err(BuildError::TwoRoots {
            second: LinkId(second as u32),
            first: link_name(robot, first),
            second_name: link_name(robot, second),
        }),
        (None, _) if robot.links.is_empty() => Err(BuildError::NoLinks),
        (None, _) => Err(find_loop(robot, inbound, &[])),
    }
}

/// A joint on a cycle: from any link not reached, walk up until a link repeats.
fn find_loop<T>(robot: &ModelBuilder<T>, inbound: &[Option<usize>], reached: &[Node]) -> BuildError {
    let mut seen = vec![false; robot.links.len()];
    reached.iter().for_each(|node| seen[node.link] = true);
    let Some(mut link) = seen.iter().position(|&s| !s) else { return BuildError::NoLinks };
    let mut on_path = vec![false; robot.links.len()];
    while let (false, Some(j)) = (on_path[link], inbound[link]) {
        on_path[link] = true;
        link = robot.joints[j].parent.index();
    }
    // The cycle runs through `link`; its last joint in the file is the one that closes it.
    let start = link;
    let mut closing = 0;
    while let Some(j) = inbound[link] {
        closing = closing.max(j);
        link = robot.joints[j].parent.index();
        if link == start {
            break;
        }
    }
    let joint = &robot.joints[closing];
    BuildError::Loop {
        joint: JointId(closing as u32),
        name: joint.name.clone(),
        child: link_name(robot, joint.child.index()),
    }
}

fn link_name<T>(robot: &ModelBuilder<T>, link: usize) -> String {
    robot.links[link].0.to_string()
}

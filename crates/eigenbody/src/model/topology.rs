//! From links and joints in any order to a tree in pre-order.

use super::builder::{JointId, LinkId, ModelBuilder};
use super::error::BuildError;
use std::collections::HashMap;

/// A link with the joint that carries it; none for the root.
pub(super) struct Node {
    pub link: usize,
    pub joint: Option<usize>,
}

/// Every link once, a link before those it carries, subtrees contiguous, the largest subtree of siblings last.
///
/// With the largest last, a sweep from the end keeps at most log₂ N subtrees waiting.
pub(super) fn pre_order<T>(robot: &ModelBuilder<T>) -> Result<Vec<Node>, BuildError> {
    unique_names(robot)?;
    let inbound = inbound_joints(robot)?;
    let root = single_root(robot, &inbound)?;
    let children = Children::new(robot);
    let nodes = children.descend(robot, root, &vec![0; robot.links.len()]);
    if nodes.len() < robot.links.len() {
        return Err(find_loop(robot, &inbound, &nodes));
    }
    let mut size = vec![1; robot.links.len()];
    for node in nodes.iter().rev() {
        if let Some(j) = node.joint {
            size[robot.joints[j].parent.index()] += size[node.link];
        }
    }
    Ok(children.descend(robot, root, &size))
}

/// The joints that each link carries, as linked lists in the order of the joints.
struct Children {
    first: Vec<Option<usize>>,
    next: Vec<Option<usize>>,
}

impl Children {
    fn new<T>(robot: &ModelBuilder<T>) -> Self {
        let mut first = vec![None; robot.links.len()];
        let mut next = vec![None; robot.joints.len()];
        for (j, joint) in robot.joints.iter().enumerate().rev() {
            next[j] = first[joint.parent.index()].replace(j);
        }
        Self { first, next }
    }

    /// Pre-order from `root`, siblings by ascending size.
    fn descend<T>(&self, robot: &ModelBuilder<T>, root: usize, size: &[usize]) -> Vec<Node> {
        let child = |j: usize| robot.joints[j].child.index();
        let mut nodes = Vec::with_capacity(robot.links.len());
        let mut stack = Vec::new();
        let mut visit = Some(Node { link: root, joint: None });
        while let Some(node) = visit {
            let waiting = stack.len();
            stack.extend(std::iter::successors(self.first[node.link], |&j| self.next[j]));
            stack[waiting..].reverse();
            stack[waiting..].sort_by_key(|&j| std::cmp::Reverse(size[child(j)]));
            nodes.push(node);
            visit = stack.pop().map(|j| Node { link: child(j), joint: Some(j) });
        }
        nodes
    }
}

fn unique_names<T>(robot: &ModelBuilder<T>) -> Result<(), BuildError> {
    let mut seen = HashMap::with_capacity(robot.links.len());
    for (i, (name, _)) in robot.links.iter().enumerate() {
        if seen.insert(name.as_ref(), i).is_some() {
            return Err(BuildError::DuplicateLink { link: LinkId(i as u32), name: name.to_string() });
        }
    }
    seen.clear();
    for (j, joint) in robot.joints.iter().enumerate() {
        if seen.insert(joint.name.as_str(), j).is_some() {
            return Err(BuildError::DuplicateJoint { joint: JointId(j as u32), name: joint.name.clone() });
        }
    }
    Ok(())
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

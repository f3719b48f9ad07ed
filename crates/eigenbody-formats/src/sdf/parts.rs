//! Links and joints: found by their names, connected to a spanning tree, built.

use super::fault::{
    Fault, SdfFault, array, boolean_in, child, fault, minor_version, name, required, unsupported,
};
use super::scope::{Kind, Scopes, WORLD};
use super::{joint, link, look, pose};
use crate::looks::Look;
use crate::xml::{Element, Files, Spot};
use eigenbody::dynamics::{Anchor, Closure};
use eigenbody::model::{JointSpec, LinkId, Place};
use eigenbody::spatial::{RigidInertia, Transform, Vec3};
use eigenbody::{Base, Joint, Model, ModelBuilder};
use std::collections::{HashMap, HashSet};

/// Links and joints of a document, in its order.
pub(super) struct Parts<'a> {
    scopes: Scopes<'a>,
    name: String,
    gravity: Option<Vec3<f64>>,
    links: Vec<usize>,
    /// A joint's frame, its parent and child link, none for the world.
    joints: Vec<(usize, Option<usize>, usize)>,
    /// Links of static models, which the world carries.
    fixed: Vec<usize>,
    /// As `joints`, of those that close loops.
    cut: Vec<(usize, Option<usize>, usize)>,
    axes_in_model: bool,
}

/// A model, and where its parts stand in the files.
pub(super) struct Built {
    pub model: Model<f64>,
    pub link_spots: Vec<Spot>,
    pub joint_spots: Vec<Spot>,
    pub joint_names: Vec<String>,
    /// Joints that close loops, with their places.
    pub cut: Vec<(Spot, Closure)>,
    pub looks: Vec<Look>,
}

impl<'a> Parts<'a> {
    /// The parts of a document.
    pub fn read(root: &'a Element, files: &Files) -> Result<Self, Fault> {
        let mut parts = Self {
            scopes: Scopes::new(root.at),
            name: String::new(),
            gravity: None,
            links: Vec::new(),
            joints: Vec::new(),
            fixed: Vec::new(),
            cut: Vec::new(),
            // Up to version 1.4 axes are given in the model's frame.
            axes_in_model: minor_version(root)? < 5,
        };
        let world = child(root, "world")?;
        let holder = world.unwrap_or(root);
        let mut models = holder.children_named("model").peekable();
        let Some(first) = models.peek() else {
            return Err(fault(root.at, SdfFault::NoModel));
        };
        parts.name = name(world.unwrap_or(first))?.to_owned();
        if let Some(gravity) = world.map(|w| child(w, "gravity")).transpose()?.flatten() {
            parts.gravity = Some(Vec3::from_f64(array(gravity)?));
        }
        // A lone model's names need no prefix.
        let lone = world.is_none();
        let mut firsts = HashMap::new();
        for model in models {
            let own = name(model)?;
            if let Some(first) = firsts.insert(own, model.at).filter(|_| lone) {
                let first = files.locate(first).1;
                return Err(fault(model.at, SdfFault::SecondName { name: own.to_owned(), first }));
            }
            parts.model(model, "", lone, false, files)?;
        }
        parts.scopes.check()?;
        parts.connect()?;
        Ok(parts)
    }

    /// Adds a model's frames. The names in a lone model are its own; elsewhere they begin with the model's.
    fn model(
        &mut self,
        model: &'a Element,
        scope: &str,
        lone: bool,
        fixed: bool,
        files: &Files,
    ) -> Result<(), Fault> {
        let own = name(model)?;
        let inner = if lone { String::new() } else { format!("{scope}{own}::") };
        let fixed = fixed || boolean_in(model, "static", false)?;
        let first = model.children_named("link").next();
        let canonical = model.get("canonical_link").filter(|name| !name.is_empty());
        let canonical = canonical.or(first.and_then(|link| link.get("name"))).map(str::to_owned);
        let placement = model.get("placement_frame").filter(|name| !name.is_empty()).map(str::to_owned);
        let (X, relative_to) = pose::pose(model)?;
        if !lone {
            let (canonical, placement) = (canonical.clone(), placement.clone());
            let kind = Kind::Model { canonical, placement };
            self.scopes.add(own, scope, kind, model, (X, relative_to.unwrap_or_default()), files)?;
        }
        // A lone model's own pose moves the whole; H does not depend on it.
        for element in &model.children {
            let (X, relative_to) = match element.tag.as_str() {
                "link" | "joint" | "frame" => pose::pose(element)?,
                "model" => {
                    self.model(element, &inner, false, fixed, files)?;
                    continue;
                }
                _ => continue,
            };
            let at = (X, relative_to.unwrap_or_default());
            let element_name = name(element)?;
            match element.tag.as_str() {
                "link" => {
                    let id = self.scopes.add(element_name, &inner, Kind::Link, element, at, files)?;
                    self.links.push(id);
                    if fixed {
                        self.fixed.push(id);
                    }
                }
                "joint" => {
                    let child = required(element, "child")?.text.clone();
                    let id =
                        self.scopes.add(element_name, &inner, Kind::Joint { child }, element, at, files)?;
                    self.joints.push((id, None, id));
                }
                _ => {
                    let attached_to = element.get("attached_to").unwrap_or_default().to_owned();
                    self.scopes.add(element_name, &inner, Kind::Frame { attached_to }, element, at, files)?;
                }
            }
        }
        if lone {
            self.scopes.check_model(model, &inner, canonical.as_deref(), placement.as_deref())?;
            // Around a lone model there is the world and nothing else.
            if let (Some(name), Some(pose)) =
                (relative_to.filter(|name| *name != "world"), child(model, "pose")?)
            {
                let unknown = SdfFault::UnknownName { name: name.to_owned(), suggestion: String::new() };
                return Err(fault(pose::relative_spot(pose), unknown));
            }
        }
        Ok(())
    }

    /// Finds the links of every joint, and cuts those that close a loop.
    fn connect(&mut self) -> Result<(), Fault> {
        let mut group: HashMap<usize, usize> = HashMap::new();
        let find = |group: &HashMap<usize, usize>, mut id: usize| {
            while let Some(&up) = group.get(&id) {
                id = up;
            }
            id
        };
        let mut carried = vec![false; self.scopes.frames.len()];
        for &link in &self.fixed {
            carried[link] = true;
            group.insert(link, WORLD);
        }
        let mut kept = Vec::new();
        for &(joint, _, _) in &self.joints {
            let frame = &self.scopes.frames[joint];
            let Some(element) = frame.element else { continue };
            let end = |tag: &'static str| -> Result<Option<usize>, Fault> {
                let end = required(element, tag)?;
                let id = self.scopes.find(&end.text, &frame.scope, end.at)?;
                self.scopes.link(id)
            };
            let (parent, child) = (end("parent")?, end("child")?);
            let Some(child) = child else {
                return Err(fault(element.at, SdfFault::WorldChild { joint: frame.name.clone() }));
            };
            let (a, b) = (find(&group, parent.unwrap_or(WORLD)), find(&group, child));
            if carried[child] || a == b {
                self.cut.push((joint, parent, child));
                continue;
            }
            carried[child] = true;
            // The child's group hangs below the parent's: the world stays a root.
            group.insert(b, a);
            kept.push((joint, parent, child));
        }
        self.joints = kept;
        Ok(())
    }

    /// How many links no joint carries.
    pub fn roots(&self) -> usize {
        let carried: HashSet<usize> = self.joints.iter().map(|&(_, _, child)| child).collect();
        let on_world = self.joints.iter().filter(|(_, parent, _)| parent.is_none()).count();
        let loose = self.links.iter().filter(|link| !carried.contains(link)).count();
        // A joint on the world leaves nothing to float.
        if on_world + self.fixed.len() > 0 { usize::MAX } else { loose }
    }

    /// The model of the parts.
    pub fn build(self, base: Base) -> Result<Built, Fault> {
        let mut builder = ModelBuilder::new(self.name.clone());
        if let Some(gravity) = self.gravity {
            builder.gravity(gravity);
        }
        let (mut link_spots, mut joint_spots) = (Vec::new(), Vec::new());
        let mut ids: HashMap<usize, LinkId> = HashMap::new();
        // Where the frame of each built link stands: a joint's, of the link it carries; else the link's own.
        let mut frames: HashMap<usize, Transform<f64>> = HashMap::new();
        let mut specs: Vec<(JointSpec<f64>, Spot)> = Vec::new();
        let mut looks = Vec::new();
        let carrier: HashMap<usize, usize> = self.joints.iter().map(|&(j, _, child)| (child, j)).collect();
        let world = (base == Base::Fixed).then(|| {
            link_spots.push(self.scopes.frames[WORLD].at);
            builder.link("world", RigidInertia::ZERO)
        });
        for &link in &self.links {
            let frame = &self.scopes.frames[link];
            let Some(element) = frame.element else { continue };
            let own = self.scopes.pose(link)?;
            let at = match carrier.get(&link) {
                Some(&joint) => self.scopes.pose(joint)?,
                None => own,
            };
            let own_from_link = own * at.inverse();
            let I = own_from_link.transpose_rigid(link::inertia(element)?);
            let seen = look::looks(element).into_iter();
            looks.extend(seen.map(|(X, form)| Look {
                link: frame.name.clone(),
                pose: X * own_from_link,
                form,
            }));
            let id = builder.link(frame.name.clone(), I);
            link_spots.push(frame.at);
            ids.insert(link, id);
            frames.insert(link, at);
            if let (None, Some(world)) = (carrier.get(&link), world) {
                let weld = JointSpec::new(format!("world to {}", frame.name), Joint::Fixed, world, id).at(at);
                specs.push((weld, frame.at));
            }
        }
        for &(joint, parent, child) in &self.joints {
            let frame = &self.scopes.frames[joint];
            let Some(element) = frame.element else { continue };
            let at = self.scopes.pose(joint)?;
            let (parent_id, from) = match parent {
                Some(parent) => (ids[&parent], frames[&parent]),
                None => match world {
                    Some(world) => (world, Transform::IDENTITY),
                    None => {
                        return Err(unsupported(element, "on a floating base nothing hangs on the world"));
                    }
                },
            };
            let motion =
                joint::read(element, &frame.name, &frame.scope, &self.scopes, &at.E, self.axes_in_model)?;
            let spec = JointSpec {
                placement: at * from.inverse(),
                axis: motion.axis,
                limits: motion.limits,
                mimic: motion.mimic,
                ..JointSpec::new(frame.name.clone(), motion.kind, parent_id, ids[&child])
            };
            specs.push((spec, frame.at));
        }
        let joint_names = specs.iter().map(|(spec, _)| spec.name.clone()).collect();
        for (spec, at) in specs {
            builder.joint(spec);
            joint_spots.push(at);
        }
        let root = self.scopes.frames[WORLD].at;
        let model = builder.build(base).map_err(|error| {
            let at = match error.place() {
                Place::Model => None,
                Place::Link(link) => link_spots.get(link.index()),
                Place::Joint(joint) => joint_spots.get(joint.index()),
            };
            fault(at.copied().unwrap_or(root), SdfFault::Build(error))
        })?;
        let mut cut = Vec::new();
        for &(joint, parent, child) in &self.cut {
            let frame = &self.scopes.frames[joint];
            let Some(element) = frame.element else { continue };
            let at = self.scopes.pose(joint)?;
            let motion =
                joint::read(element, &frame.name, &frame.scope, &self.scopes, &at.E, self.axes_in_model)?;
            let anchor = |link: Option<usize>| match link {
                Some(link) => Anchor { link: Some(ids[&link].index()), pose: at * frames[&link].inverse() },
                None => Anchor { link: None, pose: at },
            };
            let anchors = [anchor(parent), anchor(Some(child))];
            let name = format!("joint '{}'", frame.name);
            cut.push((frame.at, Closure { name, tie: motion.tie(), anchors }));
        }
        Ok(Built { model, link_spots, joint_spots, joint_names, cut, looks })
    }
}

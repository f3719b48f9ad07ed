//! Names of models in models, and where everything stands: the graph of poses.

use super::fault::{Fault, SdfFault, fault};
use super::pose;
use crate::suggest::did_you_mean;
use crate::xml::{Element, Files, Spot};
use eigenbody::spatial::Transform;
use std::collections::HashMap;

/// What has a name and a frame.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Kind {
    World,
    /// With the name of its canonical link in its own scope, if it has a link.
    Model {
        canonical: Option<String>,
        placement: Option<String>,
    },
    Link,
    /// With its child's name.
    Joint {
        child: String,
    },
    /// With what it is attached to.
    Frame {
        attached_to: String,
    },
}

/// A named frame. Names are full: `outer::inner::link`.
#[derive(Debug)]
pub(super) struct Frame<'a> {
    pub name: String,
    /// The name of the model around it, with `::`, or nothing.
    pub scope: String,
    pub kind: Kind,
    pub element: Option<&'a Element>,
    pub at: Spot,
    pose: Transform<f64>,
    relative_to: String,
}

impl Frame<'_> {
    /// Where it says what its pose is relative to.
    fn relative_spot(&self) -> Spot {
        let pose = self.element.and_then(|element| element.children_named("pose").next());
        pose.map_or(self.at, pose::relative_spot)
    }
}

/// The names and poses of a document.
pub(super) struct Scopes<'a> {
    pub frames: Vec<Frame<'a>>,
    by_name: HashMap<String, usize>,
}

/// The frame of everything.
pub(super) const WORLD: usize = 0;

/// How deep poses may be relative to each other.
const MAX_CHAIN: usize = 10_000;

impl<'a> Scopes<'a> {
    /// The world alone.
    pub fn new(at: Spot) -> Self {
        let world = Frame {
            name: "world".to_owned(),
            scope: String::new(),
            kind: Kind::World,
            element: None,
            at,
            pose: Transform::IDENTITY,
            relative_to: String::new(),
        };
        Self { frames: vec![world], by_name: HashMap::from([("world".to_owned(), WORLD)]) }
    }

    /// Adds a frame at a pose relative to a name in its scope; an empty one is the model's own frame.
    pub fn add(
        &mut self,
        name: &str,
        scope: &str,
        kind: Kind,
        element: &'a Element,
        (pose, relative_to): (Transform<f64>, &str),
        files: &Files,
    ) -> Result<usize, Fault> {
        let full = format!("{scope}{name}");
        let id = self.frames.len();
        if let Some(&first) = self.by_name.get(&full) {
            let first = files.locate(self.frames[first].at).1;
            return Err(fault(element.at, SdfFault::SecondName { name: full, first }));
        }
        self.by_name.insert(full.clone(), id);
        self.frames.push(Frame {
            name: full,
            scope: scope.to_owned(),
            kind,
            element: Some(element),
            at: element.at,
            pose,
            relative_to: relative_to.to_owned(),
        });
        Ok(id)
    }

    /// The frame that a name in a scope means.
    pub fn find(&self, name: &str, scope: &str, at: Spot) -> Result<usize, Fault> {
        let own = || scope.strip_suffix("::").map_or("world", |model| model);
        let full = match name {
            "" | "__model__" => own().to_owned(),
            "world" => "world".to_owned(),
            _ => format!("{scope}{}", name.strip_suffix("::__model__").unwrap_or(name)),
        };
        self.by_name.get(&full).copied().ok_or_else(|| {
            let names = self.frames.iter().filter_map(|f| f.name.strip_prefix(scope));
            let suggestion = did_you_mean(name, names);
            fault(at, SdfFault::UnknownName { name: name.to_owned(), suggestion })
        })
    }

    /// The link that a name in a scope means.
    pub fn find_link(&self, name: &str, scope: &str, at: Spot) -> Result<usize, Fault> {
        let found = self.find(name, scope, at).ok().filter(|&id| self.frames[id].kind == Kind::Link);
        found.ok_or_else(|| {
            let links = self.frames.iter().filter(|f| f.kind == Kind::Link);
            let suggestion = did_you_mean(name, links.filter_map(|f| f.name.strip_prefix(scope)));
            fault(at, SdfFault::UnknownLink { name: name.to_owned(), suggestion })
        })
    }

    /// The frame in a model's own scope that a name means: not the world.
    pub fn find_inside(&self, name: &str, scope: &str, at: Spot) -> Result<usize, Fault> {
        let found = self.find(name, scope, at)?;
        let unknown = || SdfFault::UnknownName { name: name.to_owned(), suggestion: String::new() };
        if found == WORLD { Err(fault(at, unknown())) } else { Ok(found) }
    }

    /// What frames name is there, whether or not anything stands on it.
    pub fn check(&self) -> Result<(), Fault> {
        for f in &self.frames {
            self.find(&f.relative_to, &f.scope, f.relative_spot())?;
            match (&f.kind, f.element) {
                (Kind::Frame { attached_to }, Some(element)) => {
                    self.find(attached_to, &f.scope, element.spot_of("attached_to"))?;
                }
                (Kind::Model { canonical, placement }, Some(element)) => {
                    let scope = format!("{}::", f.name);
                    self.check_model(element, &scope, canonical.as_deref(), placement.as_deref())?;
                }
                _ => {}
            }
        }
        Ok(())
    }

    /// What a model names in its own scope is there.
    pub fn check_model(
        &self,
        model: &Element,
        scope: &str,
        canonical: Option<&str>,
        placement: Option<&str>,
    ) -> Result<(), Fault> {
        if let Some(name) = canonical {
            self.find_link(name, scope, model.spot_of("canonical_link"))?;
        }
        if let Some(name) = placement {
            self.find_inside(name, scope, model.spot_of("placement_frame"))?;
        }
        Ok(())
    }

    /// Where a frame stands in the world.
    pub fn pose(&self, frame: usize) -> Result<Transform<f64>, Fault> {
        self.relative(frame, WORLD, 0)
    }

    /// Where a frame stands in one of the frames that its pose is relative to.
    fn relative(&self, frame: usize, until: usize, depth: usize) -> Result<Transform<f64>, Fault> {
        let (mut X, mut id, mut steps) = (Transform::IDENTITY, frame, 0);
        while id != until && id != WORLD {
            let f = &self.frames[id];
            steps += 1;
            if steps > MAX_CHAIN || depth > 50 {
                let name = self.frames[frame].name.clone();
                return Err(fault(self.frames[frame].at, SdfFault::PoseLoop { name }));
            }
            let (mut pose, mut scope) = (f.pose, f.scope.as_str());
            let own_scope;
            match &f.kind {
                Kind::Model { placement: Some(placement), .. } => {
                    // The pose is that of a frame inside: the model stands where that puts it.
                    own_scope = format!("{}::", f.name);
                    let inside = self.find(placement, &own_scope, f.at)?;
                    pose = self.relative(inside, id, depth + 1)?.inverse() * pose;
                    scope = f.scope.as_str();
                }
                Kind::Joint { child } if f.relative_to.is_empty() => {
                    X = X * pose;
                    id = self.find(child, scope, f.at)?;
                    continue;
                }
                Kind::Frame { attached_to } if f.relative_to.is_empty() => {
                    X = X * pose;
                    id = self.find(attached_to, scope, f.at)?;
                    continue;
                }
                _ => {}
            }
            X = X * pose;
            id = self.find(&f.relative_to, scope, f.relative_spot())?;
        }
        Ok(X)
    }

    /// The link that a frame moves with; none for the world.
    pub fn link(&self, frame: usize) -> Result<Option<usize>, Fault> {
        let mut id = frame;
        for _ in 0..MAX_CHAIN {
            let f = &self.frames[id];
            let no_link = || fault(f.at, SdfFault::NoLink { name: f.name.clone() });
            let (next, scope) = match &f.kind {
                Kind::World => return Ok(None),
                Kind::Link => return Ok(Some(id)),
                Kind::Joint { child } => (child, f.scope.clone()),
                Kind::Frame { attached_to } => (attached_to, f.scope.clone()),
                Kind::Model { canonical, .. } => {
                    (canonical.as_ref().ok_or_else(no_link)?, format!("{}::", f.name))
                }
            };
            id = match next.is_empty() {
                // Attached to the model itself.
                true => self.find("", &scope, f.at)?,
                false => self.find(next, &scope, f.at)?,
            };
        }
        Err(fault(self.frames[frame].at, SdfFault::NoLink { name: self.frames[frame].name.clone() }))
    }
}

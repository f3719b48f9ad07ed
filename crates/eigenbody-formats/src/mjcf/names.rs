//! Names: each is borne once among its kind, and what names something finds it.
//!
//! An attached model's sections are copied as far as what they name is there; only those of the main file must find everything.

use super::attribute::required;
use super::body::{Tree, WORLD};
use super::defaults::Defaults;
use super::document::Model;
use super::fault::{Fault, MjcfFault, fault};
use crate::suggest::did_you_mean;
use crate::xml::{Element, Files, Spot};
use std::collections::HashMap;

/// Sections whose elements name others.
const NAMING: [&str; 5] = ["contact", "tendon", "equality", "actuator", "sensor"];

/// What an actuator may act on.
const TARGETS: [&str; 6] = ["joint", "jointinparent", "tendon", "site", "body", "cranksite"];

/// What bears a name, kind by kind, and where.
#[derive(Default)]
struct Names<'a>(HashMap<&'a str, HashMap<String, Spot>>);

/// What an attribute of a naming section names.
fn named_by(attribute: &str) -> Option<&'static str> {
    match attribute {
        "joint" | "joint1" | "joint2" | "jointinparent" => Some("joint"),
        "body" | "body1" | "body2" | "subtree1" | "subtree2" => Some("body"),
        "geom" | "geom1" | "geom2" => Some("geom"),
        "site" | "site1" | "site2" | "slidersite" | "cranksite" | "refsite" | "sidesite" => Some("site"),
        "tendon" | "tendon1" | "tendon2" => Some("tendon"),
        "actuator" => Some("actuator"),
        "camera" => Some("camera"),
        "flex" => Some("flex"),
        _ => None,
    }
}

/// What a sensor's `objtype` or `reftype` names.
fn named_as(kind: &str) -> Option<&str> {
    match kind {
        "xbody" => Some("body"),
        "body" | "joint" | "geom" | "site" | "camera" | "light" | "tendon" | "actuator" | "sensor"
        | "equality" | "key" => Some(kind),
        _ => None,
    }
}

/// Elements outside the bodies with their kinds: in some sections all are of one kind. Assets have names of their files, and are
/// looked after by [`super::asset`].
fn outside_bodies(root: &Element) -> Vec<(&str, &Element)> {
    let mut found = Vec::new();
    for section in &root.children {
        let alike = match section.tag.as_str() {
            "tendon" | "equality" | "actuator" | "sensor" => true,
            "contact" | "custom" | "keyframe" | "deformable" => false,
            _ => continue,
        };
        found.extend(
            section.children.iter().map(|e| (if alike { section.tag.as_str() } else { e.tag.as_str() }, e)),
        );
    }
    found
}

/// A name that is one: an empty text is none.
pub(super) fn name(element: &Element) -> Option<&str> {
    element.get("name").filter(|name| !name.is_empty())
}

impl<'a> Names<'a> {
    fn bear(&mut self, kind: &'a str, name: &str, at: Spot, files: &Files) -> Result<(), Fault> {
        match self.0.entry(kind).or_default().insert(name.to_owned(), at) {
            None => Ok(()),
            Some(first) => {
                let (kind, name, first) = (kind.to_owned(), name.to_owned(), files.locate(first).1);
                Err(fault(at, MjcfFault::Second { kind, name, first }))
            }
        }
    }

    /// The attribute of an element names something of a kind.
    fn find(&self, kind: &str, element: &Element, attribute: &str) -> Result<(), Fault> {
        let Some(name) = element.get(attribute).filter(|name| !name.is_empty()) else { return Ok(()) };
        let known = self.0.get(kind);
        if known.is_some_and(|known| known.contains_key(name)) {
            return Ok(());
        }
        let suggestion =
            did_you_mean(name, known.into_iter().flat_map(|known| known.keys().map(String::as_str)));
        let (kind, name) = (kind.to_owned(), name.to_owned());
        Err(fault(element.spot_of(attribute), MjcfFault::Unknown { kind, name, suggestion }))
    }
}

/// Sections by themselves: no name twice, and nothing left open that must be named.
pub(super) fn check(root: &Element, files: &Files) -> Result<(), Fault> {
    let mut names = Names::default();
    for (kind, element) in outside_bodies(root) {
        if let Some(name) = name(element) {
            names.bear(kind, name, element.at, files)?;
        }
        complete(kind, element)?;
    }
    Ok(())
}

/// An element names what its kind must name.
fn complete(kind: &str, element: &Element) -> Result<(), Fault> {
    let all = |names: &[&'static str]| names.iter().try_for_each(|name| required(element, name).map(drop));
    match (kind, element.tag.as_str()) {
        ("exclude", _) => all(&["body1", "body2"]),
        ("equality", "joint") => all(&["joint1"]),
        ("equality", "tendon") => all(&["tendon1"]),
        ("equality", "connect" | "weld") if element.find("site1").or(element.find("site2")).is_some() => {
            all(&["site1", "site2"])
        }
        ("equality", "connect") => all(&["body1", "anchor"]),
        ("equality", "weld") => all(&["body1"]),
        ("tendon", "fixed") => element.children_named("joint").try_for_each(|wrap| {
            required(wrap, "joint")?;
            required(wrap, "coef").map(drop)
        }),
        ("actuator", _) if element.find("cranksite").is_some() => all(&["slidersite"]),
        ("actuator", _) => {
            match TARGETS.iter().any(|t| element.get(t).is_some_and(|name| !name.is_empty())) {
                true => Ok(()),
                false => Err(fault(element.at, MjcfFault::NoTarget { element: element.described() })),
            }
        }
        _ => Ok(()),
    }
}

/// The classes that elements outside the bodies name are there.
pub(super) fn classes(root: &Element, defaults: &Defaults<'_>) -> Result<(), Fault> {
    let sections = root.children.iter().filter(|s| s.tag == "asset" || NAMING.contains(&s.tag.as_str()));
    let mut elements = sections.flat_map(|section| &section.children);
    elements.try_for_each(|element| defaults.named(element, "class").map(drop))
}

/// No two bodies, joints, geoms, sites, cameras, lights or frames of a tree have one name, and the main file names only what is
/// there. `attached` are models with their prefixes.
pub(super) fn resolve(
    tree: &Tree,
    root: &Element,
    attached: &[(&Model, String)],
    files: &Files,
) -> Result<(), Fault> {
    let mut names = Names::default();
    names.bear("body", "world", tree.bodies[WORLD].at, files)?;
    for id in std::iter::once(WORLD).chain(tree.pre_order().into_iter().map(|(id, _)| id)) {
        let body = &tree.bodies[id];
        if let Some(name) = &body.name {
            names.bear("body", name, body.at, files)?;
        }
        for joint in &body.joints {
            if let Some(name) = &joint.name {
                names.bear("joint", name, joint.at, files)?;
            }
        }
        for other in &body.named {
            names.bear(other.kind, &other.name, other.at, files)?;
        }
    }
    // What speaks of something replicated speaks of every copy.
    for (kind, name) in &tree.replicated {
        names.0.entry(kind).or_default().entry(name.clone()).or_insert(root.at);
    }
    let sections = std::iter::once((root, "")).chain(attached.iter().map(|(m, prefix)| (&m.root, &**prefix)));
    for (root, prefix) in sections {
        for (kind, element) in outside_bodies(root) {
            if let Some(name) = name(element) {
                names.0.entry(kind).or_default().insert(format!("{prefix}{name}"), element.at);
            }
        }
    }
    let naming = root.children.iter().filter(|section| NAMING.contains(&section.tag.as_str()));
    for element in naming.flat_map(|section| &section.children) {
        for element in std::iter::once(element).chain(&element.children) {
            for attribute in &element.attributes {
                if let Some(kind) = named_by(&attribute.name) {
                    names.find(kind, element, &attribute.name)?;
                }
            }
            for (kind, attribute) in [("objtype", "objname"), ("reftype", "refname")] {
                if let Some(kind) = element.get(kind).and_then(named_as) {
                    names.find(kind, element, attribute)?;
                }
            }
        }
    }
    Ok(())
}

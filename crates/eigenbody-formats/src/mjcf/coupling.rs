//! What lies across the tree: joint equalities, loops, and armature of tendons and actuators.

use super::attribute::{array, boolean, number, numbers};
use super::closure::{self, Loop};
use super::defaults::{Defaults, MAIN};
use super::fault::Fault;
use crate::note::Note;
use crate::xml::{Element, Spot};
use std::collections::HashMap;

/// The actuators of a class are one and the same, whatever their kind.
pub(super) const ACTUATORS: [&str; 12] = [
    "general",
    "motor",
    "position",
    "velocity",
    "intvelocity",
    "orientation",
    "pid",
    "damper",
    "cylinder",
    "muscle",
    "adhesion",
    "dcmotor",
];

/// What is known of a joint by its name.
#[derive(Debug, Clone, Copy)]
pub(super) struct Known {
    /// Position among the joints that were built.
    pub joint: usize,
    /// True for hinges and slides, which have one coordinate.
    pub single: bool,
    /// Its coordinate in the pose that the file describes.
    pub reference: f64,
}

/// One coordinate as multiplier · another + offset.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Follow {
    pub joint: usize,
    pub leader: usize,
    pub multiplier: f64,
    pub offset: f64,
}

/// What couplings add to the tree.
#[derive(Debug, Default)]
pub(super) struct Couplings {
    pub follow: Vec<Follow>,
    /// Armature on each DoF of a joint.
    pub armature: Vec<(usize, f64)>,
    pub loops: Vec<Loop>,
    pub notes: Vec<(Spot, Note)>,
}

/// The sections of one document, the names in it prefixed.
pub(super) struct Sections<'a> {
    pub root: &'a Element,
    pub defaults: &'a Defaults<'a>,
    pub prefix: &'a str,
    pub joints: &'a HashMap<String, Vec<Known>>,
}

impl Couplings {
    /// Adds what a document says.
    pub fn add(&mut self, sections: &Sections<'_>) -> Result<(), Fault> {
        for element in sections.all("equality") {
            self.equality(element, sections)?;
        }
        let mut tendons = HashMap::new();
        for element in sections.all("tendon") {
            let tendon = sections.tendon(element)?;
            self.tendon(element, &tendon);
            if let Some(name) = element.get("name") {
                tendons.insert(name, tendon);
            }
        }
        for element in sections.all("actuator") {
            self.actuator(element, sections, &tendons)?;
        }
        Ok(())
    }

    fn note(&mut self, element: &Element, note: Note) {
        self.notes.push((element.at, note));
    }

    fn equality(&mut self, element: &Element, sections: &Sections<'_>) -> Result<(), Fault> {
        let styled = sections.defaults.styled_as(element, MAIN, &["equality"])?;
        if boolean(styled.find("active"), &element.tag)? == Some(false) {
            return Ok(());
        }
        match element.tag.as_str() {
            "connect" | "weld" => {
                self.note(element, Note::Loop { element: element.described() });
                self.loops.push(closure::read(element, sections.prefix)?);
            }
            "joint" => {
                let (first, second) =
                    (sections.joint(element.get("joint1")), sections.joint(element.get("joint2")));
                let c = numbers(element.find("polycoef"), "joint", 1..=5)?.unwrap_or(vec![0.0, 1.0]);
                let c = |k: usize| c.get(k).copied().unwrap_or(if k == 1 { 1.0 } else { 0.0 });
                let linear = (2..5).all(|k| c(k) == 0.0);
                match (first, second) {
                    (Some(a), Some(b)) if a.single && b.single && linear && a.joint != b.joint => {
                        let offset = a.reference + c(0) - c(1) * b.reference;
                        let (joint, leader) = (a.joint, b.joint);
                        if self.can_follow(joint, leader) {
                            self.follow.push(Follow { joint, leader, multiplier: c(1), offset });
                            return Ok(());
                        }
                    }
                    _ => {}
                }
                self.note(element, Note::EqualityIgnored { element: element.described() });
            }
            _ => self.note(element, Note::EqualityIgnored { element: element.described() }),
        }
        Ok(())
    }

    /// True unless the joint follows another one already, or its leader follows it.
    fn can_follow(&self, joint: usize, leader: usize) -> bool {
        let leader_of = |j: usize| self.follow.iter().find(|f| f.joint == j).map(|f| f.leader);
        leader_of(joint).is_none()
            && std::iter::successors(Some(leader), |&j| leader_of(j)).all(|j| j != joint)
    }

    fn tendon(&mut self, element: &Element, tendon: &Tendon) {
        self.lay(element, tendon, tendon.armature);
    }

    /// Adds an inertia along a tendon: a c² on a single joint; what couples several joints is noted.
    fn lay(&mut self, element: &Element, tendon: &Tendon, armature: f64) {
        if armature == 0.0 {
            return;
        }
        match tendon.joints.as_deref() {
            Some([(joint, coefficient)]) => {
                self.armature.push((*joint, armature * coefficient * coefficient));
            }
            _ => self.note(element, Note::ArmatureIgnored { element: element.described() }),
        }
    }

    fn actuator(
        &mut self,
        element: &Element,
        sections: &Sections<'_>,
        tendons: &HashMap<&str, Tendon>,
    ) -> Result<(), Fault> {
        let styled = sections.defaults.styled_as(element, MAIN, &ACTUATORS)?;
        let armature = number(styled.find("armature"), &element.tag)?.unwrap_or(0.0);
        if armature == 0.0 {
            return Ok(());
        }
        let gear = numbers(styled.find("gear"), &element.tag, 1..=6)?.unwrap_or(vec![1.0]);
        let reflected = armature * gear[0] * gear[0];
        let joint = element.get("joint").or(element.get("jointinparent"));
        let joints = sections.joints(joint);
        if !joints.is_empty() {
            self.armature.extend(joints.iter().map(|known| (known.joint, reflected)));
        } else if let Some(tendon) = element.get("tendon").and_then(|name| tendons.get(name)) {
            self.lay(element, tendon, reflected);
        } else {
            self.note(element, Note::ArmatureIgnored { element: element.described() });
        }
        Ok(())
    }
}

/// A tendon: its armature, and the joints of a fixed one with their coefficients.
#[derive(Debug)]
pub(super) struct Tendon {
    armature: f64,
    pub joints: Option<Vec<(usize, f64)>>,
}

impl<'a> Sections<'a> {
    pub fn all(&self, section: &'a str) -> impl Iterator<Item = &'a Element> + use<'a> {
        self.root.children_named(section).flat_map(|s| &s.children)
    }

    /// All joints that a name means.
    pub fn joints(&self, name: Option<&str>) -> &[Known] {
        let found = name.and_then(|name| self.joints.get(&format!("{}{name}", self.prefix)));
        found.map_or(&[], Vec::as_slice)
    }

    /// The joint that a name means, if it is one.
    fn joint(&self, name: Option<&str>) -> Option<Known> {
        match self.joints(name) {
            [one] => Some(*one),
            _ => None,
        }
    }

    pub fn tendon(&self, element: &Element) -> Result<Tendon, Fault> {
        let styled = self.defaults.styled_as(element, MAIN, &["tendon"])?;
        let armature = number(styled.find("armature"), &element.tag)?.unwrap_or(0.0);
        let mut joints = Vec::new();
        for wrap in element.children_named("joint") {
            let [coefficient] = array(wrap.find("coef"), "joint")?.unwrap_or([1.0]);
            match self.joint(wrap.get("joint")).filter(|known| known.single) {
                Some(known) => joints.push((known.joint, coefficient)),
                None => return Ok(Tendon { armature, joints: None }),
            }
        }
        let joints = (element.tag == "fixed").then_some(joints);
        Ok(Tendon { armature, joints })
    }
}

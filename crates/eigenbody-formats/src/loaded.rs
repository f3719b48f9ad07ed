//! A model with where it came from.

use crate::configuration::configuration;
use crate::error::{FormatError, OneLine};
use crate::location::Location;
use crate::looks::Look;
use crate::note::Note;
use crate::urdf::Rotor;
use eigenbody::dynamics::Closure;
use eigenbody::model::{Finding, JointInfo, Place};
use eigenbody::spatial::Vec3;
use eigenbody::stability::{Integrator, Spring};
use eigenbody::{Base, Family, Model};
use std::path::PathBuf;

/// A model, and what its text said about it.
#[derive(Debug, Clone)]
pub struct Loaded {
    /// The model.
    pub model: Model<f64>,
    /// How to call it: a file's path as it was given, a family's expression.
    pub name: String,
    /// What kind of text it came from.
    pub kind: Kind,
    /// The format of the file that it came from, if it did.
    pub format: Option<Format>,
    /// True if joints that follow others do so unless asked otherwise: URDF's mimic joints. False for MJCF, whose equalities
    /// are no part of MuJoCo's mass matrix.
    pub mimic: bool,
    /// Rotor inertias that the file gives; [`with_rotors`](Self::with_rotors) adds them.
    pub rotors: Vec<Rotor>,
    /// Springs, dampers and feedback of actuators that the file gives.
    pub springs: Vec<Spring>,
    /// How its links look: visuals of URDF, geoms of MJCF.
    pub looks: Vec<Look>,
    /// How the file's own engine steps.
    pub stepping: Option<Stepping>,
    /// What its root was put on.
    pub(crate) base: Base,
    /// Files of meshes and height fields, where they were looked for.
    pub(crate) assets: Vec<PathBuf>,
    /// Meshes as a URDF file names them.
    pub(crate) meshes: Vec<String>,
    pub(crate) keyframes: Vec<Keyframe>,
    /// Loops of the file; the element's name where an end of it is not known.
    pub(crate) closures: Vec<Result<Closure, String>>,
    pub(crate) notes: Vec<(String, Location, Note)>,
    pub(crate) places: Places,
}

/// What kind of text a model came from.
#[derive(Debug, Clone, PartialEq)]
pub enum Kind {
    /// A parametric family.
    Family(Family),
    /// A robot that is built in.
    BuiltIn,
    /// A file.
    File(PathBuf),
}

/// A format of files that describe robots.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// URDF, also what xacro expands to.
    Urdf,
    /// MuJoCo's MJCF.
    Mjcf,
    /// SDFormat.
    Sdf,
}

/// A time step and an integrator.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stepping {
    /// Length of a step (s).
    pub step: f64,
    /// How it is made.
    pub integrator: Integrator,
}

impl Default for Stepping {
    /// MuJoCo's own: 2 ms, joint damping implicit.
    fn default() -> Self {
        Self { step: 0.002, integrator: Integrator::DampedEuler }
    }
}

/// A configuration with a name.
#[derive(Debug, Clone, PartialEq)]
pub struct Keyframe {
    /// Its name.
    pub name: String,
    /// All coordinates.
    pub q: Vec<f64>,
}

/// A finding or a note, with its place.
#[derive(Debug, Clone, PartialEq)]
pub struct Remark {
    /// A stable name of its kind.
    pub code: &'static str,
    /// The link, joint or element that it is about; empty for the whole model.
    pub subject: String,
    /// Its file and place, if there is one.
    pub place: Option<(String, Location)>,
    /// In words.
    pub text: String,
}

/// Where links and joints stand, by file and place; empty without a file.
#[derive(Debug, Clone, Default)]
pub(crate) struct Places {
    pub files: Vec<String>,
    pub links: Vec<(u32, Location)>,
    /// Where MJCF's links have their origins in the frames of their bodies.
    pub origins: Vec<Vec3<f64>>,
    pub joints: Vec<(u32, Location)>,
    /// Names of `joints`.
    pub joint_names: Vec<String>,
}

impl Loaded {
    pub(crate) fn new(model: Model<f64>, name: String, kind: Kind, places: Places) -> Self {
        Self {
            model,
            name,
            kind,
            format: None,
            mimic: true,
            rotors: Vec::new(),
            springs: Vec::new(),
            looks: Vec::new(),
            stepping: None,
            base: Base::Fixed,
            assets: Vec::new(),
            meshes: Vec::new(),
            keyframes: Vec::new(),
            closures: Vec::new(),
            notes: Vec::new(),
            places,
        }
    }

    /// Where a link or joint stands in its file, if there is one.
    pub fn location(&self, place: Place) -> Option<Location> {
        self.place(place).map(|(_, at)| at)
    }

    /// The file and the place of a link or joint, if there is one.
    pub fn place(&self, place: Place) -> Option<(&str, Location)> {
        let (file, at) = match place {
            Place::Model => None,
            Place::Link(link) => self.places.links.get(link.index()).copied(),
            Place::Joint(joint) => self.places.joints.get(joint.index()).copied(),
        }?;
        Some((self.places.files.get(file as usize)?, at))
    }

    /// The same with the reflected inertia of its rotors added to the armature of their joints.
    ///
    /// Errors: [`FormatError::Unsuitable`] if a rotor's joint is not there or does not move, or an inertia is negative.
    pub fn with_rotors(mut self) -> Result<Self, FormatError> {
        let unsuitable = |problem: String| FormatError::Unsuitable { text: self.name.clone(), problem };
        let mut armature = self.model.armature().to_vec();
        for rotor in &self.rotors {
            let joint = self.model.joints().iter().find(|joint| joint.name() == rotor.joint);
            let joint = joint.ok_or_else(|| {
                unsuitable(format!("a rotor is on joint '{}', which is no moving joint", rotor.joint))
            })?;
            joint.dofs().for_each(|d| armature[d] += rotor.reflected);
        }
        let model = self.model.clone().with_armature(armature);
        self.model = model.map_err(|error| unsuitable(error.to_string()))?;
        self.notes.retain(|(.., note)| !matches!(note, Note::Rotor { .. }));
        Ok(self)
    }

    /// The loops that the file closes.
    ///
    /// Errors: [`FormatError::Unsuitable`] if one of them is fastened to something that is not known.
    pub fn closures(&self) -> Result<Vec<Closure>, FormatError> {
        let known = |closure: &Result<Closure, String>| {
            closure.clone().map_err(|element| FormatError::Unsuitable {
                text: self.name.clone(),
                problem: format!(
                    "{element} cannot be closed: an end of it names not one body or site of the model"
                ),
            })
        };
        self.closures.iter().map(known).collect()
    }

    /// True for a parametric family.
    pub fn is_family(&self) -> bool {
        matches!(self.kind, Kind::Family(_))
    }

    /// Configurations that the file names.
    pub fn keyframes(&self) -> &[Keyframe] {
        &self.keyframes
    }

    /// All coordinates of the configuration that a text names: a keyframe, as `home` or `key:home`, or what
    /// [`configuration`](crate::configuration()) reads.
    ///
    /// Errors: [`FormatError::Expression`].
    pub fn configuration(&self, text: &str, coupling: bool) -> Result<Vec<f64>, FormatError> {
        let name = text.trim();
        let plain = name.strip_prefix("key:").unwrap_or(name);
        match self.keyframes.iter().find(|key| key.name == plain) {
            Some(key) => Ok(key.q.clone()),
            None => configuration(text, &self.model, coupling),
        }
    }

    /// What is suspicious about the model, and what its text says and it does not.
    pub fn remarks(&self) -> Vec<Remark> {
        let of_model = self.model.findings().iter().map(|finding| Remark {
            code: finding.code(),
            subject: finding.subject().to_owned(),
            place: self.place(finding.place()).map(|(file, at)| (file.to_owned(), at)),
            text: finding.to_string(),
        });
        let of_text = self.notes.iter().map(|(file, at, note)| Remark {
            code: note.code(),
            subject: note.subject().to_owned(),
            place: Some((file.clone(), *at)),
            text: note.to_string(),
        });
        of_model.chain(of_text).collect()
    }

    /// The same, each as [`warning`](Self::warning) prints it.
    pub fn findings(&self) -> Vec<String> {
        let line = |remark: Remark| {
            let at = match remark.place {
                Some((file, at)) => format!("{file}:{at}"),
                None => self.name.clone(),
            };
            OneLine(format!("{at}: warning: {}", remark.text)).to_string()
        };
        self.remarks().into_iter().map(line).collect()
    }

    /// The file and the place of the joint that a degree of freedom belongs to, if there is one.
    pub fn place_of_dof(&self, dof: &str) -> Option<(&str, Location)> {
        let has = |joint: &&JointInfo<f64>| {
            dof.starts_with(joint.name()) && joint.dofs().any(|d| self.model.dof_name(d) == dof)
        };
        let joint = self.model.joints().iter().find(has)?;
        let k = self.places.joint_names.iter().position(|name| name == joint.name())?;
        let (file, at) = *self.places.joints.get(k)?;
        Some((self.places.files.get(file as usize)?, at))
    }

    /// `file:line:column: warning: text`, on one line.
    pub fn warning(&self, finding: &Finding) -> String {
        let at = match self.place(finding.place()) {
            Some((file, at)) => format!("{file}:{at}"),
            None => self.name.clone(),
        };
        OneLine(format!("{at}: warning: {finding}")).to_string()
    }
}

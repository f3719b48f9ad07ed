//! A robot as the page asked for it.

use crate::refusal::Refusal;
use eigenbody::model::Base as ModelBase;
use eigenbody::{Model, Reduction};
use eigenbody_formats::{FormatError, Kind, LoadOptions, Loaded, family, load, load_text};
use eigenbody_study::explore::{self, edited};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::Path;

/// Most degrees of freedom, and most links of a family. A page draws them all; the command line has no such limit.
pub const MOST: usize = 2048;
/// Up to so many rows the matrix and all eigenvalues are shown.
pub const WHOLE: usize = 1000;
/// Up to so many rows a robot is examined over its joint limits.
pub const EXAMINED: usize = 256;
/// Names of robots that are built in, and what they are.
pub const BUILT_IN: [(&str, &str); 1] = [("puma560", "PUMA 560, an industrial arm")];
/// Longest text that is sent back to be shown (bytes).
const SHOWN: usize = 512 * 1024;
/// Longest name of a text or a family.
const NAME: usize = 200;

/// What carries the root link.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Base {
    /// The world.
    #[default]
    Fixed,
    /// Nothing.
    Floating,
}

impl From<Base> for ModelBase {
    fn from(base: Base) -> Self {
        match base {
            Base::Fixed => Self::Fixed,
            Base::Floating => Self::Floating,
        }
    }
}

/// How a model is made and studied: the options of the command line.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Options {
    /// What carries the root link.
    pub base: Base,
    /// A floating base is removed.
    pub reduced: bool,
    /// Followers follow; as the format has it if it is not said.
    pub mimic: Option<bool>,
    /// Rotors count.
    pub rotors: bool,
}

/// Where a robot comes from: one of the four.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Source {
    #[serde(skip_serializing_if = "Option::is_none")]
    family: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    builtin: Option<String>,
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    opened: bool,
    #[serde(skip_serializing)]
    text: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    name: Option<String>,
}

impl Source {
    /// A family's member.
    pub fn family(text: &str) -> Self {
        Self { family: Some(text.to_owned()), ..Self::default() }
    }

    /// A built-in robot.
    pub fn builtin(name: &str) -> Self {
        Self { builtin: Some(name.to_owned()), ..Self::default() }
    }

    /// The file named when the server was started.
    pub fn opened() -> Self {
        Self { opened: true, ..Self::default() }
    }
}

/// Changes, by names of DoFs and links.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Edits {
    armature: BTreeMap<String, f64>,
    mass: BTreeMap<String, f64>,
}

/// A robot asked for.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Request {
    /// From where.
    pub source: Source,
    /// How.
    #[serde(default)]
    pub options: Options,
    /// With what changes.
    #[serde(default)]
    pub edits: Edits,
}

impl Request {
    /// Whether the same request means the same robot: a file may have changed.
    pub fn is_lasting(&self) -> bool {
        !self.source.opened
    }
}

/// A robot, ready to be asked.
pub struct Robot {
    /// What it is called in requests.
    pub id: String,
    /// How it came to be.
    pub request: Request,
    /// The model, edits made, and what its text says.
    pub loaded: Loaded,
    /// What it was read from, if that is a text that is short enough to be shown.
    pub text: Option<String>,
    /// Which degrees of freedom are studied.
    pub reduction: Reduction,
    /// The model's DoF that each row stands for.
    pub rows: Vec<usize>,
}

impl Robot {
    /// Reads, changes and measures. `file` is the one that the server was started with.
    pub fn new(id: String, request: Request, file: Option<&str>) -> Result<Self, Refusal> {
        let Options { base, reduced, mimic, rotors } = request.options;
        let options = LoadOptions { base: base.into(), size_ratio: None };
        let mut loaded = read(&request.source, file, &options)?;
        if rotors {
            loaded = loaded.with_rotors().map_err(|error| Refusal::model(&error, |_| None))?;
        }
        if reduced && base == Base::Fixed {
            return Err(Refusal::input("there is no floating base to remove"));
        }
        let is_floating = loaded.model.has_floating_base();
        let reduction = Reduction {
            mimic: mimic.unwrap_or(loaded.mimic),
            base: is_floating && base == Base::Floating && (reduced || loaded.is_family()),
        };
        let nv = loaded.model.nv();
        if nv > MOST || loaded.model.bodies().len() > MOST {
            return Err(too_large(&loaded.name, nv.max(loaded.model.bodies().len())));
        }
        let Edits { armature, mass } = request.edits.clone();
        loaded.model = edited(loaded.model, &explore::Edits { armature, mass })?;
        let rows = reduction.dofs(&loaded.model);
        let text = match &request.source {
            Source { opened: true, .. } => file.and_then(|file| std::fs::read_to_string(file).ok()),
            Source { text, .. } => text.clone(),
        };
        let text = text.filter(|text| text.len() <= SHOWN);
        Ok(Self { id, request, loaded, text, reduction, rows })
    }

    /// The model.
    pub fn model(&self) -> &Model<f64> {
        &self.loaded.model
    }

    /// The coordinate that a coordinate follows, if it does.
    pub fn leader(&self, k: usize) -> Option<usize> {
        let coupling = self.model().coupling().filter(|_| self.reduction.mimic)?;
        let (leader, ..) = coupling.follows(k);
        (leader != k).then_some(leader)
    }

    /// Memory that it takes, roughly.
    pub fn bytes(&self) -> usize {
        let size = |text: &Option<String>| text.as_ref().map_or(0, String::len);
        size(&self.text)
            + size(&self.request.source.text)
            + 2048 * (self.loaded.model.links().len() + self.loaded.model.nv())
    }

    /// Where it comes from, in a word.
    pub fn format(&self) -> &'static str {
        match &self.loaded.kind {
            Kind::Family(_) => "family",
            Kind::BuiltIn => "builtin",
            Kind::File(path) => match path.extension().and_then(|e| e.to_str()) {
                Some("urdf" | "xacro") => "urdf",
                Some("sdf") => "sdf",
                // What decides is the root element: MJCF alone steps as its file says.
                _ if self.loaded.stepping.is_some() => "mjcf",
                _ => "urdf",
            },
        }
    }
}

fn read(source: &Source, file: Option<&str>, options: &LoadOptions) -> Result<Loaded, Refusal> {
    let no_text = |_: &str| None;
    match source {
        Source { family: Some(text), builtin: None, opened: false, text: None, name: None } => {
            if text.len() > NAME {
                return Err(Refusal::input(format!("a family's name of more than {NAME} characters")));
            }
            let refuse = |error: &FormatError| Refusal::model(error, no_text);
            // Size first: a member is not built to be refused.
            match family(text, None).map_err(|error| refuse(&error))? {
                Some(family) if family.links() > MOST => Err(too_large(&family.name(), family.links())),
                Some(_) => load(text, options).map_err(|error| refuse(&error)),
                None => Err(Refusal::input(
                    "no family; expected hydra, onion, auto_tree or chain with their parameters",
                )),
            }
        }
        Source { family: None, builtin: Some(name), opened: false, text: None, name: None } => {
            match BUILT_IN.iter().find(|known| known.0 == name) {
                Some((name, _)) => load(name, options).map_err(|error| Refusal::model(&error, no_text)),
                None => Err(Refusal::input("no built-in robot has this name")),
            }
        }
        Source { family: None, builtin: None, opened: true, text: None, name: None } => match file {
            Some(file) => {
                let text_of = |file: &str| std::fs::read_to_string(file).ok();
                let mut loaded = load(file, options).map_err(|error| Refusal::model(&error, text_of))?;
                // What it is called on the page; where it stands is nobody's business there.
                if let Some(name) = Path::new(file).file_name() {
                    loaded.name = name.to_string_lossy().into_owned();
                }
                Ok(loaded)
            }
            None => Err(Refusal::input("the server was started without a file")),
        },
        Source { family: None, builtin: None, opened: false, text: Some(text), name: Some(name) } => {
            if name.is_empty() || name.len() > NAME || name.contains(['/', '\\', '\0']) {
                return Err(Refusal::input("a text has a name: a file's, without folders"));
            }
            let text_of = |file: &str| (file == name).then(|| text.clone());
            load_text(text, name, options).map_err(|error| Refusal::model(&error, text_of))
        }
        _ => Err(Refusal::input("a source is one of family, builtin, opened, or text with its name")),
    }
}

fn too_large(name: &str, size: usize) -> Refusal {
    Refusal::too_large(format!(
        "{name}: {size} links or degrees of freedom; the explorer takes up to {MOST}, `eigenbody spectrum` any number"
    ))
}

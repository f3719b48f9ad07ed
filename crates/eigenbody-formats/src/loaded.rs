//! A model with where it came from.

use crate::location::Location;
use eigenbody::model::{Finding, Place};
use eigenbody::{Family, Model};
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

/// Where links and joints stand in the file; empty without a file.
#[derive(Debug, Clone, Default)]
pub(crate) struct Places {
    pub links: Vec<Location>,
    pub joints: Vec<Location>,
}

impl Loaded {
    /// Where a link or joint stands in the file, if there is one.
    pub fn location(&self, place: Place) -> Option<Location> {
        match place {
            Place::Model => None,
            Place::Link(link) => self.places.links.get(link.index()).copied(),
            Place::Joint(joint) => self.places.joints.get(joint.index()).copied(),
        }
    }

    /// True for a parametric family.
    pub fn is_family(&self) -> bool {
        matches!(self.kind, Kind::Family(_))
    }

    /// What is suspicious about the model, each as [`warning`](Self::warning) prints it.
    pub fn findings(&self) -> Vec<String> {
        self.model.findings().iter().map(|finding| self.warning(finding)).collect()
    }

    /// `file:line:column: warning: text`, on one line.
    pub fn warning(&self, finding: &Finding) -> String {
        let at = self.location(finding.place()).map(|at| format!(":{at}")).unwrap_or_default();
        crate::error::OneLine(format!("{}{at}: warning: {finding}", self.name)).to_string()
    }
}

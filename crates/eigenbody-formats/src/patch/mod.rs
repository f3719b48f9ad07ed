//! A model's own file with other numbers in it: what is not changed stays byte for byte.
//!
//! ```text
//! changes ← what differs: armature of joints, matter on links, limits
//! text ← file with each change at the element that its joint or link was read from
//! text, read again, is the file's model with the same changes
//! ```
//! Geometry, meshes, actuators and comments are then where they were, which [`write_mjcf`](crate::write_mjcf) and
//! [`write_urdf`](crate::write_urdf) know nothing of.

mod changes;
mod mjcf;
mod text;
mod urdf;

use crate::error::FormatError;
use crate::file::Shelf;
use crate::loaded::{Format, Kind, Loaded};
use crate::location::Location;
use crate::urdf::UrdfOptions;
use crate::{MjcfOptions, mjcf as mjcf_reader, read_urdf_str};
use changes::{Change, alike, changes, same};
use eigenbody::Model;
use eigenbody::spatial::RigidInertia;
use roxmltree::{Document, Node, ParsingOptions};
use std::path::Path;
use text::Text;
use thiserror::Error;

/// Why a file cannot be changed where it stands.
#[derive(Debug, Clone, PartialEq, Error)]
#[allow(missing_docs)] // the messages say it all
#[non_exhaustive]
pub enum PatchError {
    #[error("{name} is no URDF or MJCF file that could be changed")]
    NoFile { name: String },
    #[error("{name} is no longer the file that was read")]
    Changed { name: String },
    #[error(transparent)]
    Read(#[from] FormatError),
    #[error("{what} stands in '{file}', which is included: that file would have to change")]
    Included { what: String, file: String },
    #[error("{what} is one of several that one element makes: they would all change")]
    Several { what: String },
    #[error("{what}: {problem}")]
    NoPlace { what: String, problem: &'static str },
    #[error("with {what} changed where it stands the file would read as another model")]
    Differs { what: String },
}

/// The text of the file that a model came from, with all in which `mended` differs from it: armature, inertia of links, limits.
///
/// URDF has no armature: it is added as rotors of `<transmission>`, which [`Loaded::with_rotors`] reads. Matter is added to the
/// `<inertial>` of a link of URDF, and to MJCF as a body that is welded to the link's, whose inertia may be that of its geoms.
///
/// Errors: [`PatchError`] if an element cannot be changed alone, or the text would not read as the file's model with these changes.
///
/// ```
/// use eigenbody_formats::{LoadOptions, load, patched};
/// # let path = std::env::temp_dir().join(format!("eigenbody-patched-{}.xml", std::process::id()));
/// # let path = path.to_str().ok_or("path")?;
/// let file = r#"<mujoco><worldbody><body><joint name="hinge"/><geom size="0.1"/></body></worldbody></mujoco>"#;
/// std::fs::write(path, file)?;
/// let loaded = load(path, &LoadOptions::default())?;
/// let mended = loaded.model.clone().with_armature(vec![0.25])?;
/// let text = patched(&loaded, &mended)?;
/// assert_eq!(text, file.replace("\"hinge\"", "\"hinge\" armature=\"0.25\""));
/// # std::fs::remove_file(path)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn patched(loaded: &Loaded, mended: &Model<f64>) -> Result<String, PatchError> {
    let no_file = || PatchError::NoFile { name: loaded.name.clone() };
    let (Kind::File(path), Some(format)) = (&loaded.kind, loaded.format) else { return Err(no_file()) };
    let read = |text: &str| -> Result<Loaded, PatchError> {
        let base = loaded.base;
        Ok(match format {
            Format::Urdf => read_urdf_str(text, &loaded.name, &UrdfOptions { base })?.with_rotors()?,
            Format::Mjcf => {
                mjcf_reader::read_text(text.to_owned(), path, &MjcfOptions { base }, Shelf::Disk)?
            }
            Format::Sdf => return Err(no_file()),
        })
    };
    let own = text_of(path)?;
    let before = read(&own)?;
    if !same(&before.model, &loaded.model) {
        return Err(PatchError::Changed { name: loaded.name.clone() });
    }
    let whole = crate::xml::lenient(&own);
    let parsing = ParsingOptions { allow_dtd: false, ..Default::default() };
    let document = Document::parse_with_options(&whole, parsing).map_err(|_| no_file())?;
    let changes = changes(&loaded.model, mended);
    let mut text = Text::new(&own);
    let source = Source { loaded, document: &document };
    for change in &changes {
        match format {
            Format::Urdf => urdf::apply(change, &source, &mut text)?,
            _ => mjcf::apply(change, &source, &mut text)?,
        }
    }
    let text = text.changed();
    let after = read(&text).map_err(|_| differs(&changes))?;
    match alike(&before.model, &after.model, &loaded.model, mended) {
        true => Ok(text),
        false => Err(differs(&changes)),
    }
}

fn differs(changes: &[Change<'_>]) -> PatchError {
    let what: Vec<String> = changes.iter().map(Change::what).collect();
    PatchError::Differs { what: what.join(", ") }
}

/// The text that a file's places are places in.
fn text_of(path: &Path) -> Result<String, FormatError> {
    #[cfg(feature = "xacro")]
    if path.extension().is_some_and(|e| e.eq_ignore_ascii_case("xacro")) {
        return crate::xacro::expanded(path);
    }
    Ok(String::from_utf8_lossy(&crate::file::read(path)?).into_owned())
}

/// A place in one of the files.
type Placed = (u32, Location);

/// A model and the elements of its main file.
struct Source<'a, 'd> {
    loaded: &'a Loaded,
    document: &'d Document<'d>,
}

impl<'d> Source<'_, 'd> {
    /// The element of a joint, or of a link, that no other is read from.
    fn element(&self, change: &Change<'_>) -> Result<Node<'d, 'd>, PatchError> {
        let (places, model) = (&self.loaded.places, &self.loaded.model);
        let (found, all): (Option<Placed>, Vec<Placed>) = match *change {
            Change::Matter { link, .. } => {
                // A body with several joints is a chain of links without inertia but for the last.
                let bodies = model.bodies().iter().filter(|body| *body.inertia() != RigidInertia::ZERO);
                let links = bodies.filter_map(|body| places.links.get(body.link()).copied());
                (places.links.get(link).copied(), links.collect())
            }
            Change::Armature { joint, .. } | Change::Limits { joint, .. } => {
                let k = places.joint_names.iter().position(|name| name == joint.name());
                (k.and_then(|k| places.joints.get(k).copied()), places.joints.clone())
            }
        };
        let no_place =
            || PatchError::NoPlace { what: change.what(), problem: "no element of the file is it" };
        let place = found.ok_or_else(no_place)?;
        let (file, at) = place;
        if file != 0 {
            let file = places.files.get(file as usize).cloned().unwrap_or_default();
            return Err(PatchError::Included { what: change.what(), file });
        }
        if all.into_iter().filter(|&other| other == place).count() > 1 {
            return Err(PatchError::Several { what: change.what() });
        }
        let offset = at.offset(self.document.input_text());
        let mut elements = self.document.descendants().filter(Node::is_element);
        elements.find(|element| element.range().start == offset).ok_or_else(no_place)
    }
}

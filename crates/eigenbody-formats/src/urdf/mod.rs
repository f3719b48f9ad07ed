//! URDF: the links, inertias and joints of a robot description file.
//!
//! Read are `<link>` with `<inertial>` and `<joint>` with `<origin>`, `<axis>`, `<limit>` and `<mimic>`, as children of
//! `<robot>`, rotor inertia in `<transmission>` for those who ask, and `<dynamics damping>` for time steps; all else leaves H as it is and is passed over. Coordinates follow the order of the `<joint>` elements.
//! A link without `<inertial>` is a frame without mass; a planar joint moves in the plane normal to its axis; units are SI.

mod element;
mod fault;
mod joint;
mod link;
mod look;
mod pose;
mod rotor;
mod spring;
mod words;

pub(crate) use element::Element;
pub use fault::UrdfFault;
pub(crate) use link::inertia;
pub use rotor::Rotor;

use crate::error::FormatError;
use crate::loaded::{Format, Kind, Loaded, Places};
use crate::location::Location;
use crate::note::Note;
use crate::slips::slips;
use crate::suggest::did_you_mean;
use eigenbody::model::{LinkId, Place};
use eigenbody::{Base, BuildError, Model, ModelBuilder};
use element::Fault;
use roxmltree::{Document, ParsingOptions};
use std::collections::HashMap;
use std::path::Path;

/// How to read a URDF file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct UrdfOptions {
    /// What the root link is fastened to.
    pub base: Base,
}

/// Reads a URDF file.
///
/// Errors: [`FormatError::File`] if it cannot be read, [`FormatError::Urdf`] if it is no URDF of a kinematic tree.
pub fn read_urdf(path: &Path, options: &UrdfOptions) -> Result<Loaded, FormatError> {
    let file = path.display().to_string();
    let bytes = crate::file::read(path)?;
    let text = std::str::from_utf8(&bytes).map_err(|error| {
        let offset = error.valid_up_to();
        let byte = bytes.get(offset).copied().unwrap_or_default();
        let (at, fault) = (Location::at(&bytes, offset), Box::new(UrdfFault::NotUtf8 { byte }));
        FormatError::Urdf { file: file.clone(), at, fault }
    })?;
    read_urdf_str(text, &file, options)
}

/// Reads the text of a URDF file; `file_name` is what errors call it.
///
/// ```
/// use eigenbody_formats::{UrdfOptions, read_urdf_str};
/// let text = r#"<robot name="point"> <link name="body"/> <joint name="hinge" type="hinge"/> </robot>"#;
/// let error = read_urdf_str(text, "point.urdf", &UrdfOptions::default()).unwrap_err();
/// assert!(error.to_string().starts_with("point.urdf:1:62: joint 'hinge' has type 'hinge', expected"));
/// ```
pub fn read_urdf_str(text: &str, file_name: &str, options: &UrdfOptions) -> Result<Loaded, FormatError> {
    let located_at = |at: Location, fault: UrdfFault| FormatError::Urdf {
        file: file_name.to_owned(),
        at,
        fault: Box::new(fault),
    };
    // No document type declarations: no entities to expand.
    let whole = crate::xml::lenient(text);
    let text = whole.as_ref();
    let xml = Document::parse_with_options(text, ParsingOptions { allow_dtd: false, ..Default::default() })
        .map_err(|error| {
        let at = error.pos();
        located_at(Location { line: at.row, column: at.col }, UrdfFault::from(error))
    })?;
    let robot = Element(xml.root_element());
    let stem = || Path::new(file_name).file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let (robot_name, mut notes) = match robot.attribute("name") {
        Ok(name) => (name.to_owned(), Vec::new()),
        Err(_) => (stem(), vec![(file_name.to_owned(), robot.location(), Note::NoName)]),
    };
    let (model, mut offsets) = model(robot, &robot_name, options.base)
        .map_err(|Fault { offset, fault }| located_at(Location::at(text.as_bytes(), offset), fault))?;
    let located =
        |offsets: &[usize]| Location::all(text.as_bytes(), offsets).into_iter().map(|at| (0, at)).collect();
    let places = Places {
        files: vec![file_name.to_owned()],
        links: located(&offsets.links),
        origins: Vec::new(),
        joints: located(&offsets.joints),
        joint_names: std::mem::take(&mut offsets.joint_names),
    };
    let rotors = rotor::rotors(robot)
        .map_err(|Fault { offset, fault }| located_at(Location::at(text.as_bytes(), offset), fault))?;
    let noted = rotors.iter().map(|(rotor, offset)| {
        let at = Location::at(text.as_bytes(), *offset);
        (file_name.to_owned(), at, Note::Rotor { joint: rotor.joint.clone() })
    });
    notes.extend(noted);
    offsets.notes.extend(slips(&robot, words::VOCABULARY));
    notes.extend(offsets.notes.into_iter().map(|(offset, note)| {
        let at = Location::at(text.as_bytes(), offset);
        (file_name.to_owned(), at, note)
    }));
    let springs = spring::springs(robot, &model)
        .map_err(|Fault { offset, fault }| located_at(Location::at(text.as_bytes(), offset), fault))?;
    let (rotors, looks) = (rotors.into_iter().map(|(rotor, _)| rotor).collect(), look::looks(robot));
    let kind = Kind::File(file_name.into());
    let meshes = look::meshes(robot);
    let (format, base) = (Some(Format::Urdf), options.base);
    let loaded = Loaded::new(model, file_name.to_owned(), kind, places);
    Ok(Loaded { format, rotors, springs, looks, base, meshes, notes, ..loaded })
}

/// Byte offsets of links and joints, in the order of their ids.
#[derive(Default)]
struct Offsets {
    links: Vec<usize>,
    joints: Vec<usize>,
    joint_names: Vec<String>,
    notes: Vec<(usize, Note)>,
}

fn model(robot: Element<'_, '_>, name: &str, base: Base) -> Result<(Model<f64>, Offsets), Fault> {
    fault::check_root(robot)?;
    let mut builder = ModelBuilder::new(name);
    let mut offsets = Offsets::default();
    let mut links: HashMap<&str, LinkId> = HashMap::new();
    for element in robot.children("link") {
        let name = element.attribute("name")?;
        let (inertia, note) = link::inertia(element)?;
        let id = builder.link(name, inertia);
        offsets.notes.extend(note.map(|note| (element.offset(), note)));
        // Of two links with one name either will do: the builder refuses them.
        links.insert(name, id);
        offsets.links.push(element.offset());
    }
    let find = |name: &str| match links.get(name) {
        Some(&id) => Ok(id),
        None => Err(did_you_mean(name, links.keys().copied())),
    };
    for element in robot.children("joint") {
        let mut spec = joint::read(element, find)?;
        if let Some((lower, upper)) = spec.limits.take_if(|(lower, upper)| *lower > *upper) {
            let joint = spec.name.clone();
            offsets.notes.push((element.offset(), Note::CrossedLimits { joint, lower, upper }));
        }
        offsets.joint_names.push(spec.name.clone());
        builder.joint(spec);
        offsets.joints.push(element.offset());
    }
    match builder.build(base) {
        Ok(model) => Ok((model, offsets)),
        Err(error) => Err(located(robot, &offsets, error)),
    }
}

/// The builder's error at the element that it is about.
fn located(robot: Element<'_, '_>, offsets: &Offsets, error: BuildError) -> Fault {
    let at = |offsets: &[usize], index: usize| offsets.get(index).copied().unwrap_or(robot.offset());
    let (offset, found) = match error.place() {
        Place::Model => (robot.offset(), None),
        Place::Link(id) => (at(&offsets.links, id.index()), robot.children("link").nth(id.index())),
        Place::Joint(id) => (at(&offsets.joints, id.index()), robot.children("joint").nth(id.index())),
    };
    let duplicate = matches!(error, BuildError::DuplicateLink { .. } | BuildError::DuplicateJoint { .. });
    let fault = match found.filter(|_| duplicate) {
        None => UrdfFault::Build(error),
        Some(second) => {
            let name = second.attribute("name").unwrap_or_default();
            let mut same =
                robot.children(second.tag()).filter(|e| e.attribute("name").is_ok_and(|n| n == name));
            match same.next() {
                Some(first) if first.offset() < offset => {
                    UrdfFault::Duplicate { error, first: first.location() }
                }
                _ => UrdfFault::ReservedName { name: name.to_owned() },
            }
        }
    };
    Fault { offset, fault }
}

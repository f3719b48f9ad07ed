//! SDF: the kinematic subset, as libsdformat reads it.
//!
//! ```text
//! text -> spliced elements -> named frames -> poses in the world -> spanning tree -> model
//! ```
//! Read are models, nested and included, links with their inertia (given, or from primitive collision shapes), frames, and
//! revolute, continuous, prismatic, revolute2, universal, ball and fixed joints. All else leaves H as it is and is passed
//! over. Names are full: `outer::inner::link`. Coordinates follow the order of the `<joint>` elements. A link that no joint
//! carries stands on the world, or on the floating base. A joint that closes a loop is cut, with a note.

mod fault;
mod include;
mod joint;
mod link;
mod look;
mod parts;
mod pose;
mod scope;
mod words;

pub use fault::SdfFault;

use crate::error::FormatError;
use crate::file::Shelf;
use crate::loaded::{Format, Kind as Source, Loaded, Places};
use crate::note::Note;
use crate::slips::slips;
use crate::xml::{Files, Spot, XmlFault};
use eigenbody::Base;
use eigenbody::dynamics::{Closure, Tie};
use fault::Fault;
use include::Splicer;
use parts::{Built, Parts};
use std::path::Path;

/// How to read an SDF file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct SdfOptions {
    /// What a link that no joint carries is fastened to.
    pub base: Base,
}

/// Reads an SDF file with all that it includes.
///
/// Errors: [`FormatError::File`] if it cannot be read, [`FormatError::Sdf`] if it is no SDF of rigid bodies,
/// [`FormatError::Unsuitable`] if a floating base is asked for and there is not one link to put it under.
pub fn read_sdf(path: &Path, options: &SdfOptions) -> Result<Loaded, FormatError> {
    let bytes = crate::file::read(path)?;
    let text = String::from_utf8(bytes).map_err(|error| {
        let offset = error.utf8_error().valid_up_to();
        let byte = error.as_bytes().get(offset).copied().unwrap_or_default();
        let at = crate::location::Location::at(error.as_bytes(), offset);
        let fault = Box::new(SdfFault::Xml(XmlFault::NotUtf8 { byte }));
        FormatError::Sdf { file: path.display().to_string(), at, fault }
    })?;
    read_text(text, path, options, Shelf::Disk)
}

/// Reads the text of an SDF file; `file_name` is what errors call it, and included files are looked for beside it.
///
/// ```
/// use eigenbody_formats::{SdfOptions, read_sdf_str};
/// let text = r#"<sdf version="1.9"><model name="m"><link name="a"/><joint name="j" type="revolute">
///     <parent>world</parent><child>a</child><axis><xyz>0 0 1</xyz></axis></joint></model></sdf>"#;
/// let model = read_sdf_str(text, "m.sdf", &SdfOptions::default())?.model;
/// // A link that says nothing has 1 kg m².
/// assert_eq!(eigenbody::mass_matrix(&model, &[0.3])?[(0, 0)], 1.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn read_sdf_str(text: &str, file_name: &str, options: &SdfOptions) -> Result<Loaded, FormatError> {
    read_text(text.to_owned(), Path::new(file_name), options, Shelf::Disk)
}

/// Reads a text whose files stand on a shelf.
pub(crate) fn read_text(
    text: String,
    path: &Path,
    options: &SdfOptions,
    shelf: Shelf,
) -> Result<Loaded, FormatError> {
    let file_name = path.display().to_string();
    let mut files = Files { shelf, ..Files::default() };
    let located = |Fault { at, fault }: Fault, files: &Files| {
        let (file, at) = files.locate(at);
        FormatError::Sdf { file: file.to_owned(), at, fault: Box::new(fault) }
    };
    let mut splicer = Splicer { files: &mut files, open: Vec::new() };
    let root = splicer.root(text, path, &file_name).map_err(|problem| located(problem, &files))?;
    let parts = Parts::read(&root, &files).map_err(|problem| located(problem, &files))?;
    if options.base == Base::Floating && parts.roots() != 1 {
        let problem = "a floating base needs exactly one link that no joint carries".to_owned();
        return Err(FormatError::Unsuitable { text: file_name, problem });
    }
    let Built { model, link_spots, joint_spots, joint_names, cut, looks } =
        parts.build(options.base).map_err(|problem| located(problem, &files))?;
    let places = Places {
        files: files.all.iter().map(|file| file.name.clone()).collect(),
        links: files.locate_all(&link_spots),
        origins: Vec::new(),
        joints: files.locate_all(&joint_spots),
        joint_names,
    };
    let note = |(at, closure): &(Spot, Closure)| {
        let (file, at) = files.locate(*at);
        (file.to_owned(), at, Note::Loop { element: closure.name.clone() })
    };
    let loops: Vec<_> = cut.iter().map(note).collect();
    let slips = slips(&&root, words::VOCABULARY).into_iter().map(|(at, note)| {
        let (file, at) = files.locate(at);
        (file.to_owned(), at, note)
    });
    let notes = loops.into_iter().chain(slips).collect();
    let closures = cut.into_iter().map(|(_, closure)| has_axes(closure)).collect();
    let kind = Source::File(path.to_owned());
    let (format, base) = (Some(Format::Sdf), options.base);
    Ok(Loaded { format, looks, base, closures, notes, ..Loaded::new(model, file_name, kind, places) })
}

/// A closure, unless its joint has an axis without a direction.
fn has_axes(closure: Closure) -> Result<Closure, String> {
    let axes = match closure.tie {
        Tie::Weld | Tie::Ball => vec![],
        Tie::Hinge(axis) | Tie::Slide(axis) => vec![axis],
        Tie::Universal { first, second } => vec![first, second],
    };
    match axes.iter().all(|axis| axis.norm().is_finite()) {
        true => Ok(closure),
        false => Err(closure.name),
    }
}

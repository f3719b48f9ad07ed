//! MJCF, as MuJoCo's compiler reads it, for everything that touches mass or joints.
//!
//! ```text
//! text -> spliced elements -> schema -> defaults, compiler, assets -> bodies -> masses -> links and joints -> model
//! ```
//! What only touches sight, contact, sensing or actuation is known by name and passed over. What is not known is an error
//! with its place, and so is what is known but not understood and could touch mass or joints. q is MuJoCo's qpos. v is
//! MuJoCo's qvel but for free joints: [angular; linear] in the body's frame here, [linear in the world; angular in the body] there.

mod asset;
mod attach;
mod attribute;
mod body;
mod build;
mod closure;
mod compiler;
mod coupling;
mod defaults;
mod document;
mod fault;
mod geom;
mod include;
mod joint;
mod keyframe;
mod mass;
mod mesh;
mod names;
mod orientation;
mod principal;
mod schema;
mod spring;
mod world;

pub use fault::MjcfFault;
pub use mesh::{Mesh, MeshFault};

use crate::error::FormatError;
use crate::file::Shelf;
use crate::loaded::{Format, Kind, Loaded, Places, Stepping};
use crate::looks::Look;
use crate::note::Note;
use crate::xml::{Files, Spot};
use asset::{Assets, Folders};
use attribute::{array, keyword};
use build::{Parts, can_float, parts};
use closure::Loop;
use compiler::Compiler;
use coupling::{Couplings, Sections};
use defaults::Defaults;
use document::{Document, Model as Source};
use eigenbody::dynamics::Closure;
use eigenbody::model::{MimicSpec, Place};
use eigenbody::spatial::Vec3;
use eigenbody::stability::Spring;
use eigenbody::{Base, Model};
use fault::{Fault, fault};
use spring::{Options, Springs};
use std::path::{Path, PathBuf};
use std::rc::Rc;
use world::Reader;

/// How to read an MJCF file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct MjcfOptions {
    /// Fixed: free joints are where the file has them. Floating: the one body that stands in the world floats.
    pub base: Base,
}

/// Reads an MJCF file with all that it includes and names.
///
/// Errors: [`FormatError::File`] if it cannot be read, [`FormatError::Mjcf`] if it is no MJCF or means more than is understood,
/// [`FormatError::Unsuitable`] if a floating base is asked for and there is not one body to put it under.
pub fn read_mjcf(path: &Path, options: &MjcfOptions) -> Result<Loaded, FormatError> {
    let bytes = crate::file::read(path)?;
    let mut files = Files::default();
    let text = include::text(bytes, 0, path, &mut files).map_err(|problem| located(problem, &files))?;
    read_text(text, path, options, Shelf::Disk)
}

/// Reads the text of an MJCF file; `file_name` is what errors call it, and included files are looked for beside it.
///
/// ```
/// use eigenbody_formats::{MjcfOptions, read_mjcf_str};
/// let text = r#"<mujoco><worldbody><body><joint/><geom size="0.1"/></body></worldbody></mujoco>"#;
/// let loaded = read_mjcf_str(text, "ball.xml", &MjcfOptions::default())?;
/// let H = eigenbody::mass_matrix(&loaded.model, &[0.3])?;
/// // A ball of water's density: 2/5 m r².
/// assert!((H[(0, 0)] - 0.4 * 4.0 / 3.0 * std::f64::consts::PI * 1000.0 * 1e-5).abs() < 1e-15);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn read_mjcf_str(text: &str, file_name: &str, options: &MjcfOptions) -> Result<Loaded, FormatError> {
    read_text(text.to_owned(), Path::new(file_name), options, Shelf::Disk)
}

/// Reads a text whose files stand on a shelf.
pub(crate) fn read_text(
    text: String,
    path: &Path,
    options: &MjcfOptions,
    shelf: Shelf,
) -> Result<Loaded, FormatError> {
    let name = path.display().to_string();
    let mut files = Files { shelf, ..Files::default() };
    let source = Source::load(text, path, &name, &mut files).map_err(|problem| located(problem, &files))?;
    let built = build(&source, &files, path, options).map_err(|problem| match problem {
        Problem::Fault(problem) => located(*problem, &files),
        Problem::NoBase => {
            let problem =
                "a floating base needs exactly one body in the world, welded to it or free".to_owned();
            FormatError::Unsuitable { text: name.clone(), problem }
        }
    })?;
    let Built {
        model,
        springs,
        stepping,
        notes,
        reference,
        link_spots,
        link_origins,
        joint_spots,
        joint_names,
        closures,
        looks,
        assets,
    } = built;
    let keyframes =
        keyframe::read(&source.root, &model, &reference).map_err(|problem| located(problem, &files))?;
    let places = Places {
        files: files.all.iter().map(|file| file.name.clone()).collect(),
        links: files.locate_all(&link_spots),
        origins: link_origins,
        joints: files.locate_all(&joint_spots),
        joint_names,
    };
    let notes = notes.into_iter().map(|(at, note)| {
        let (file, at) = files.locate(at);
        (file.to_owned(), at, note)
    });
    let kind = Kind::File(path.to_owned());
    let loaded = Loaded::new(model, name, kind, places);
    let (format, notes, stepping) = (Some(Format::Mjcf), notes.collect(), Some(stepping));
    let base = options.base;
    Ok(Loaded {
        format,
        base,
        notes,
        keyframes,
        closures,
        springs,
        looks,
        stepping,
        assets,
        mimic: false,
        ..loaded
    })
}

/// A fault with its place as text.
fn located(Fault { at, fault }: Fault, files: &Files) -> FormatError {
    let (file, at) = files.locate(at);
    FormatError::Mjcf { file: file.to_owned(), at, fault: Box::new(fault) }
}

enum Problem {
    Fault(Box<Fault>),
    NoBase,
}

impl From<Fault> for Problem {
    fn from(fault: Fault) -> Self {
        Self::Fault(Box::new(fault))
    }
}

struct Built {
    model: Model<f64>,
    springs: Vec<Spring>,
    stepping: Stepping,
    notes: Vec<(Spot, Note)>,
    reference: Vec<f64>,
    link_spots: Vec<Spot>,
    link_origins: Vec<Vec3<f64>>,
    joint_spots: Vec<Spot>,
    joint_names: Vec<String>,
    closures: Vec<Result<Closure, String>>,
    looks: Vec<Look>,
    assets: Vec<PathBuf>,
}

fn build(source: &Source, files: &Files, path: &Path, options: &MjcfOptions) -> Result<Built, Problem> {
    let root = &source.root;
    let document = Document::new(source, files);
    let settings = Rc::new(Compiler::read(root)?);
    let defaults = Defaults::read(root, files)?;
    names::classes(root, &defaults)?;
    let assets = Assets::read(root, &defaults, files)?;
    let mut reader = Reader::new(&document, &defaults, &settings, &assets);
    reader.read(true)?;
    let Reader { mut tree, attached, .. } = reader;
    if options.base == Base::Floating && !can_float(&tree) {
        return Err(Problem::NoBase);
    }
    names::resolve(&tree, root, &attached, files)?;
    let stem = path.file_stem().map(|stem| stem.to_string_lossy().into_owned());
    let name = root.get("model").map(str::to_owned).or(stem).unwrap_or_default();
    let mut parts = parts(&mut tree, root, &name, options.base)?;
    if let Some(gravity) = gravity(root)? {
        parts.builder.gravity(gravity);
    }

    let mut couplings = Couplings::default();
    let outside = root.children.iter().filter(|c| matches!(c.tag.as_str(), "body" | "frame" | "replicate"));
    couplings.notes.extend(outside.map(|c| (c.at, Note::OutsideWorld { element: c.described() })));
    let mut springs = Springs::of_joints(&parts.springs, &parts.joints);
    let mut add = |sections: &Sections<'_>| -> Result<(), Fault> {
        couplings.add(sections)?;
        springs.add(sections, &parts.joints)
    };
    add(&Sections { root, defaults: &defaults, prefix: "", joints: &parts.known })?;
    for (model, prefix) in &attached {
        let defaults = Defaults::read(&model.root, files)?;
        add(&Sections { root: &model.root, defaults: &defaults, prefix, joints: &parts.known })?;
    }
    let Couplings { follow, armature, loops, mut notes } = couplings;
    notes.append(&mut springs.notes);
    for (joint, extra) in armature {
        let spec = &mut parts.joints[joint];
        spec.armature.resize(spec.kind.nv(), 0.0);
        spec.armature.iter_mut().for_each(|a| *a += extra);
    }
    for f in follow {
        let leader = parts.joints[f.leader].name.clone();
        parts.joints[f.joint].mimic =
            Some(MimicSpec { joint: leader, multiplier: f.multiplier, offset: f.offset });
    }
    let specs = parts.joints.clone();
    let built = finish(parts, notes, &loops, root.at, options.base)?;
    let settings = Options::read(root)?;
    let springs = settings.applied(springs.resolve(&built.model, &specs, &built.reference));
    let mut assets = Vec::new();
    asset_files(source, files, &mut assets)?;
    Ok(Built { springs, stepping: settings.stepping, assets, ..built })
}

/// The model of the parts.
fn finish(
    parts: Parts,
    notes: Vec<(Spot, Note)>,
    loops: &[Loop],
    root: Spot,
    base: Base,
) -> Result<Built, Problem> {
    let Parts {
        mut builder, joints, link_spots, joint_spots, reference, base_armature, frames, looks, ..
    } = parts;
    let joint_names: Vec<String> = joints.iter().map(|joint| joint.name.clone()).collect();
    let mut link_origins = vec![Vec3::ZERO; link_spots.len()];
    for placed in frames.bodies.values() {
        link_origins[placed.link.index()] = placed.origin;
    }
    joints.into_iter().for_each(|joint| {
        builder.joint(joint);
    });
    let mut model = builder.build(base).map_err(|error| {
        let (spots, index) = match error.place() {
            Place::Model => (&[][..], 0),
            Place::Link(link) => (link_spots.as_slice(), link.index()),
            Place::Joint(joint) => (joint_spots.as_slice(), joint.index()),
        };
        let at = spots.get(index).copied().unwrap_or(root);
        fault(at, MjcfFault::Build(error))
    })?;
    if let Some((at, base)) = base_armature {
        let mut armature = model.armature().to_vec();
        armature[..6].fill(base);
        model = model.with_armature(armature).map_err(|error| fault(at, MjcfFault::Base(error)))?;
    }
    let close = |l: &Loop| closure::closure(l, &frames, &model, &reference).ok_or_else(|| l.name.clone());
    let closures = loops.iter().map(close).collect();
    let (springs, stepping, assets) = (Vec::new(), Stepping::default(), Vec::new());
    Ok(Built {
        model,
        springs,
        stepping,
        notes,
        reference,
        link_spots,
        link_origins,
        joint_spots,
        joint_names,
        closures,
        looks,
        assets,
    })
}

/// Files of assets of a model and of the models that it names.
fn asset_files(model: &Source, files: &Files, found: &mut Vec<PathBuf>) -> Result<(), Fault> {
    let settings = Compiler::read(&model.root)?;
    let folders = Folders { files, main: model.folder.clone(), settings: &settings };
    found.extend(asset::files(&model.root, &folders));
    model.models.iter().try_for_each(|(_, inner)| asset_files(inner, files, found))
}

/// What `<option>` says of gravity, if anything.
fn gravity(root: &crate::xml::Element) -> Result<Option<Vec3<f64>>, Fault> {
    let mut found = None;
    for option in root.children_named("option") {
        if let Some(gravity) = array(option.find("gravity"), "option")? {
            found = Some(Vec3::from_f64(gravity));
        }
    }
    for flag in root.children_named("option").flat_map(|o| o.children_named("flag")) {
        if keyword(flag.find("gravity"), "flag", &["disable", "enable"])? == Some(0) {
            found = Some(Vec3::ZERO);
        }
    }
    Ok(found)
}

//! Published robots with states to evaluate them at, and their description for the peers.

use std::error::Error;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use eigenbody::model::Random;
use eigenbody::spatial::{Mat3, RigidInertia, Vec3};
use eigenbody::{Base, Joint, Model, mass_matrix};
use eigenbody_formats::{LoadOptions, load, write_mjcf, write_urdf};

use crate::Outcome;

/// States of each robot: so many that no two calls in a row find the same numbers.
pub const SAMPLES: usize = 64;

/// A robot's name, base and file, as `peers dump` is told: `NAME=fixed:PATH` or `NAME=floating:PATH`.
struct Source<'a> {
    name: &'a str,
    base: Base,
    path: &'a str,
}

impl<'a> Source<'a> {
    fn parse(text: &'a str) -> Result<Self, Box<dyn Error>> {
        let (name, rest) = text.split_once('=').ok_or_else(|| format!("`{text}`: no NAME="))?;
        let (base, path) = rest.split_once(':').ok_or_else(|| format!("`{text}`: no base"))?;
        let base = match base {
            "fixed" => Base::Fixed,
            "floating" => Base::Floating,
            _ => return Err(format!("`{base}`: fixed or floating").into()),
        };
        Ok(Self { name, base, path })
    }
}

/// A model and states.
pub struct Robot {
    /// What tables call it.
    pub name: String,
    /// As eigenbody has it.
    pub model: Model<f64>,
    /// In single precision.
    pub single: Model<f32>,
    /// Its URDF, fixed joints merged.
    pub urdf: PathBuf,
    /// Coordinates, velocities, and accelerations or forces.
    pub samples: Vec<Sample>,
}

/// A state and what is asked of it.
pub struct Sample {
    pub q: Vec<f64>,
    pub v: Vec<f64>,
    /// Accelerations or forces.
    pub x: Vec<f64>,
}

fn samples(model: &Model<f64>) -> Vec<Sample> {
    let mut random = Random::new(7);
    let mut numbers = |n: usize| (0..n).map(|_| random.between(-1.0, 1.0)).collect::<Vec<_>>();
    let sample = |seed| Sample { q: model.random(seed), v: numbers(model.nv()), x: numbers(model.nv()) };
    (0..SAMPLES as u64).map(sample).collect()
}

fn model(path: &Path, base: Base) -> Result<Model<f64>, Box<dyn Error>> {
    let options = LoadOptions { base, ..LoadOptions::default() };
    Ok(load(&path.to_string_lossy(), &options)?.model)
}

/// A URDF without `<mimic .../>`: every joint is free.
fn free(urdf: &str) -> String {
    let mut parts = urdf.split("<mimic ");
    let first = parts.next().unwrap_or_default().to_owned();
    parts.filter_map(|part| part.split_once("/>")).fold(first, |text, (_, rest)| text + rest)
}

/// Writes each robot as `NAME.robot` (numbers only), `NAME.urdf`, `NAME.xml` (MJCF) and `NAME.f64` (H of every sample).
pub fn dump(directory: &str, sources: &[&str]) -> Outcome {
    std::fs::create_dir_all(directory)?;
    let file = |name: &str, extension: &str| Path::new(directory).join(name).with_extension(extension);
    for text in sources {
        let Source { name, base, path } = Source::parse(text)?;
        let urdf = file(name, "urdf");
        std::fs::write(&urdf, free(&write_urdf(&model(Path::new(path), base)?)?))?;
        let model = model(&urdf, base)?;
        std::fs::write(file(name, "xml"), write_mjcf(&model)?)?;
        let samples = samples(&model);
        std::fs::write(file(name, "robot"), numbers(name, &model, &samples))?;
        let mut bytes = Vec::new();
        for sample in &samples {
            bytes.extend(mass_matrix(&model, &sample.q)?.as_slice().iter().flat_map(|x| x.to_le_bytes()));
        }
        std::fs::write(file(name, "f64"), bytes)?;
    }
    Ok(())
}

/// The robots that `dump` wrote, by name.
pub fn read(directory: &str) -> Result<Vec<Robot>, Box<dyn Error>> {
    let mut paths: Vec<PathBuf> = Vec::new();
    for entry in std::fs::read_dir(directory)? {
        paths.push(entry?.path());
    }
    paths.retain(|path| path.extension().is_some_and(|extension| extension == "robot"));
    paths.sort();
    let robot = |path: &PathBuf| -> Result<Robot, Box<dyn Error>> {
        let text = std::fs::read_to_string(path)?;
        let name = text.split_whitespace().next().unwrap_or_default().to_owned();
        let base = if text.contains(" floating ") { Base::Floating } else { Base::Fixed };
        let urdf = path.with_extension("urdf");
        let model = model(&urdf, base)?;
        let samples = samples(&model);
        Ok(Robot { name, single: model.cast(), model, urdf, samples })
    };
    paths.iter().map(robot).collect()
}

/// The robot as numbers: what robot.hpp reads.
fn numbers(name: &str, model: &Model<f64>, samples: &[Sample]) -> String {
    let mut out = String::new();
    let bodies = model.bodies();
    let _ = writeln!(out, "{name} {} {} {} {}", model.nq(), model.nv(), bodies.len(), samples.len());
    let _ = writeln!(out, "{}", line(&model.gravity().to_array()));
    for (body, joint) in bodies.iter().zip(joints(model)) {
        let parent = body.parent().map_or(-1, |p| p as i64);
        let kind = match body.joint() {
            Joint::Floating => "floating",
            Joint::Prismatic => "prismatic",
            _ => "revolute",
        };
        let placement = body.tree_transform();
        let Mat3 { x, y, z } = placement.E.transpose();
        let (m, c, I) = central(body.inertia());
        let _ = writeln!(
            out,
            "{parent} {joint} {kind} {} {} {} {} {m:e} {} {}",
            body.coordinates().start,
            body.dofs().start,
            line(&[x, y, z].map(Vec3::to_array).concat()),
            line(&placement.r.to_array()),
            line(&c.to_array()),
            line(&I),
        );
    }
    for Sample { q, v, x } in samples {
        let _ = writeln!(out, "{}\n{}\n{}", line(q), line(v), line(x));
    }
    out
}

/// The name of the joint that carries each body.
fn joints(model: &Model<f64>) -> Vec<String> {
    let of = |dof: usize| model.joints().iter().find(|joint| joint.dofs().contains(&dof));
    let name = |dof: usize| of(dof).map_or_else(|| "root".to_owned(), |joint| joint.name().to_owned());
    model.bodies().iter().map(|body| name(body.dofs().start)).collect()
}

/// Mass, centre of mass and rotational inertia about it: xx, xy, xz, yy, yz, zz.
fn central(inertia: &RigidInertia<f64>) -> (f64, Vec3<f64>, [f64; 6]) {
    let c = if inertia.m > 0.0 { inertia.h * (1.0 / inertia.m) } else { Vec3::ZERO };
    let I = RigidInertia::from_com(-inertia.m, c, inertia.I).I;
    (inertia.m, c, [I.xx, I.xy, I.xz, I.yy, I.yz, I.zz])
}

fn line(numbers: &[f64]) -> String {
    numbers.iter().map(|x| format!("{x:e}")).collect::<Vec<_>>().join(" ")
}

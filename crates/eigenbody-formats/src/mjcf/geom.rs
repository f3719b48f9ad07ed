//! `<geom>`: a shape that gives its body mass.

use super::asset::{Assets, Folders};
use super::attribute::{array, boolean, keyword, number, numbers};
use super::compiler::Compiler;
use super::defaults::Styled;
use super::fault::{Fault, MjcfFault, fault, unsupported};
use super::mesh::Enclosed;
use super::orientation::{from_z, rotation};
use crate::looks::Form;
use crate::shape::Shape;
use eigenbody::spatial::{Mat3, Transform, Vec3};

/// Kinds of geom, in MuJoCo's words.
const TYPES: [&str; 9] =
    ["plane", "hfield", "sphere", "capsule", "ellipsoid", "cylinder", "box", "mesh", "sdf"];

/// From this group on MuJoCo's viewer does not show geoms at first: collision shapes, as a rule.
const HIDDEN_GROUP: f64 = 3.0;

/// Volumes up to this count as none.
const SMALLEST_VOLUME: f64 = 1e-14;

/// What a geom adds to its body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Geom {
    /// The frame of its principal axes in the body's.
    pub pose: Transform<f64>,
    pub mass: f64,
    /// Moments about its centre.
    pub inertia: [f64; 3],
}

/// Where shapes come from.
pub(super) struct Shapes<'a> {
    pub assets: &'a Assets<'a>,
    pub folders: Folders<'a>,
    pub settings: &'a Compiler,
}

/// True if a geom's group takes part in inertia.
pub(super) fn counts(geom: &Styled<'_>, settings: &Compiler) -> Result<bool, Fault> {
    let group = number(geom.find("group"), "geom")?.unwrap_or(0.0);
    let [first, last] = settings.inertiagrouprange;
    Ok((first..=last).contains(&group))
}

/// A geom's mass and inertia.
pub(super) fn read(geom: &Styled<'_>, shapes: &Shapes<'_>) -> Result<Geom, Fault> {
    let element = geom.element;
    let shape_fault = |problem| fault(element.at, MjcfFault::Shape { element: element.described(), problem });
    let kind = TYPES[keyword(geom.find("type"), "geom", &TYPES)?.unwrap_or(2)];
    let r = Vec3::from_f64(array(geom.find("pos"), "geom")?.unwrap_or_default());
    let mut size = size(geom)?;
    let fromto: Option<[f64; 6]> = array(geom.find("fromto"), "geom")?;
    let mut pose = match fromto {
        Some(fromto) => {
            if r != Vec3::ZERO {
                return Err(shape_fault("pos and fromto exclude each other"));
            }
            let (place, half) = between(fromto).ok_or_else(|| shape_fault("fromto names one point twice"))?;
            match kind {
                "capsule" | "cylinder" => size[1] = half,
                "box" | "ellipsoid" => size = [size[0], size[0], half],
                _ => return Err(shape_fault("fromto is for capsules, cylinders, boxes and ellipsoids")),
            }
            place
        }
        None => {
            let E = rotation(geom.layers(), shapes.settings)?.unwrap_or(Mat3::IDENTITY);
            Transform::new(E, r)
        }
    };
    let shell = boolean(geom.find("shellinertia"), "geom")?.unwrap_or(false);
    let is_mesh = matches!(kind, "mesh" | "sdf");
    let (volume, unit) = match geom.find("mesh") {
        Some(_) if kind == "sdf" => return Err(unsupported(element, "its shape comes from a plugin")),
        None if is_mesh => return Err(shape_fault("it names no mesh")),
        Some(name) => {
            if fromto.is_some() {
                return Err(shape_fault("fromto and mesh exclude each other"));
            }
            let mesh = shapes.assets.mesh(&name.value, element, &shapes.folders)?;
            if is_mesh && shell {
                return Err(shape_fault("of a mesh, inertia=\"shell\" stands in the asset"));
            }
            if is_mesh {
                pose = Transform::new(mesh.E, mesh.com) * pose;
                (mesh.volume, box_inertia(mesh.half))
            } else {
                let scale = number(geom.find("fitscale"), "geom")?.unwrap_or(1.0);
                let (fitted, shift) = fit(&mesh, kind, shapes.settings.fitaabb)
                    .ok_or_else(|| shape_fault("this kind of geom cannot be fitted to a mesh"))?;
                size = fitted.map(|s| s * scale);
                pose = Transform::translation(shift) * Transform::new(mesh.E, mesh.com) * pose;
                primitive(kind, size, shell, geom)?
            }
        }
        None if kind == "hfield" => {
            let name = geom.find("hfield").map(|a| a.value.as_str());
            let name = name.ok_or_else(|| shape_fault("it names no hfield"))?;
            let shape = Shape::Box(shapes.assets.hfield(name, element)?);
            (shape.volume(shell), shape.unit_inertia(shell))
        }
        None => primitive(kind, size, shell, geom)?,
    };
    let (mass, inertia) = weigh(geom, volume, unit)?;
    Ok(Geom { pose, mass, inertia })
}

/// How a geom looks, from its parent's frame to the shape's: for those that MuJoCo's viewer shows at first.
pub(super) fn look(geom: &Styled<'_>, shapes: &Shapes<'_>) -> Option<(Transform<f64>, Form)> {
    if number(geom.find("group"), "geom").ok()?.unwrap_or(0.0) >= HIDDEN_GROUP {
        return None;
    }
    let kind = TYPES[keyword(geom.find("type"), "geom", &TYPES).ok()?.unwrap_or(2)];
    let mut size = size(geom).ok()?;
    let fromto: Option<[f64; 6]> = array(geom.find("fromto"), "geom").ok()?;
    let pose = match fromto {
        Some(fromto) => {
            let (place, half) = between(fromto)?;
            match kind {
                "capsule" | "cylinder" => size[1] = half,
                _ => size = [size[0], size[0], half],
            }
            place
        }
        None => {
            let r = Vec3::from_f64(array(geom.find("pos"), "geom").ok()?.unwrap_or_default());
            Transform::new(rotation(geom.layers(), shapes.settings).ok()?.unwrap_or(Mat3::IDENTITY), r)
        }
    };
    let form = match kind {
        "mesh" => shapes.assets.look(&geom.find("mesh")?.value, &shapes.folders)?,
        // A primitive fitted to a mesh, a height field, a plug-in's shape, a plane without end.
        _ if geom.find("mesh").is_some() || matches!(kind, "hfield" | "sdf" | "plane") => return None,
        _ => Form::Primitive(shape(kind, size).0),
    };
    Some((pose, form))
}

/// Mass from `mass`, or from `density` and volume.
fn weigh(geom: &Styled<'_>, volume: f64, unit: [f64; 3]) -> Result<(f64, [f64; 3]), Fault> {
    let density = number(geom.find("density"), "geom")?.unwrap_or(1000.0);
    let mass = match number(geom.find("mass"), "geom")? {
        Some(_) if volume <= SMALLEST_VOLUME => 0.0,
        Some(mass) => mass,
        None => density * volume,
    };
    let inertia = unit.map(|i| i * mass);
    if mass < 0.0 || density < 0.0 || inertia.iter().any(|&i| i < 0.0) {
        let element = geom.element.described();
        return Err(fault(geom.element.at, MjcfFault::NegativeMass { element, mass, inertia }));
    }
    Ok((mass, inertia))
}

/// Sizes, each from the nearest element that gives it: a class may give three and the geom change the first.
fn size(geom: &Styled<'_>) -> Result<[f64; 3], Fault> {
    let mut size = [0.0; 3];
    let layers: Vec<_> = geom.layers().collect();
    for layer in layers.into_iter().rev() {
        for (slot, x) in size.iter_mut().zip(numbers(layer.find("size"), "geom", 1..=3)?.unwrap_or_default())
        {
            *slot = x;
        }
    }
    Ok(size)
}

/// The frame half-way between two points, z along them, and half their distance.
pub(super) fn between([a, b, c, d, e, f]: [f64; 6]) -> Option<(Transform<f64>, f64)> {
    let (from, to) = (Vec3::new(a, b, c), Vec3::new(d, e, f));
    let along = from - to;
    let length = along.norm();
    let pose = || Transform::new(from_z(along * (1.0 / length)), (from + to) * 0.5);
    (length >= 1e-7).then(|| (pose(), length / 2.0))
}

/// Volume and unit inertia of a primitive, its sizes checked.
fn primitive(
    kind: &'static str,
    size: [f64; 3],
    shell: bool,
    geom: &Styled<'_>,
) -> Result<(f64, [f64; 3]), Fault> {
    let (shape, count) = shape(kind, size);
    if let Some(index) = (0..count).find(|&k| size[k].is_nan() || size[k] <= 0.0 || size[k].is_infinite()) {
        let (element, value) = (geom.element.described(), size[index]);
        return Err(fault(geom.element.at, MjcfFault::Size { element, index: index + 1, value, kind }));
    }
    Ok((shape.volume(shell), shape.unit_inertia(shell)))
}

/// A primitive, and how many sizes it has.
fn shape(kind: &str, size: [f64; 3]) -> (Shape, usize) {
    let [a, b, c] = size;
    match kind {
        "plane" => (Shape::Plane, 0),
        "capsule" => (Shape::Capsule([a, b]), 2),
        "cylinder" => (Shape::Cylinder([a, b]), 2),
        "ellipsoid" => (Shape::Ellipsoid(size), 3),
        "box" => (Shape::Box([a, b, c]), 3),
        _ => (Shape::Sphere([a]), 1),
    }
}

/// Moments per unit of mass of a box of these half-edges.
fn box_inertia(half: [f64; 3]) -> [f64; 3] {
    Shape::Box(half).unit_inertia(false)
}

/// The sizes of a primitive that stands for a mesh, and the shift of its centre in the mesh's principal axes.
fn fit(mesh: &Enclosed, kind: &str, bounding: bool) -> Option<([f64; 3], Vec3<f64>)> {
    let [a, b, c] = mesh.half;
    if !bounding {
        let round = (a + b) / 2.0;
        let size = match kind {
            "sphere" => [(a + b + c) / 3.0, 0.0, 0.0],
            "capsule" => [round, (c - round / 2.0).max(0.0), 0.0],
            "cylinder" => [round, c, 0.0],
            "ellipsoid" | "box" => mesh.half,
            _ => return None,
        };
        return Some((size, Vec3::ZERO));
    }
    let fold = |pick: fn(f64, f64) -> f64| {
        mesh.vertices.iter().copied().reduce(|p, q| Vec3::new(pick(p.x, q.x), pick(p.y, q.y), pick(p.z, q.z)))
    };
    let (low, high) = (fold(f64::min)?, fold(f64::max)?);
    let middle = (low + high) * 0.5;
    let [a, b, c] = ((high - low) * 0.5).to_array();
    let round = a.max(b);
    let size = match kind {
        "sphere" => [round.max(c), 0.0, 0.0],
        "cylinder" => [round, c, 0.0],
        "capsule" => [round, (c - round).max(0.0), 0.0],
        "ellipsoid" | "box" => [a, b, c],
        _ => return None,
    };
    Some((size, middle))
}

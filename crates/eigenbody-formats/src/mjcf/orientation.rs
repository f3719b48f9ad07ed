//! Where a frame stands: `pos`, and one of `quat`, `axisangle`, `xyaxes`, `zaxis`, `euler`.

use super::attribute::array;
use super::compiler::Compiler;
use super::fault::{Fault, MjcfFault, fault};
use crate::xml::{Attribute, Element};
use eigenbody::spatial::{Mat3, Transform, Vec3};

/// The attributes that give an orientation.
const FORMS: [&str; 5] = ["quat", "axisangle", "xyaxes", "zaxis", "euler"];

/// Shortest vector that gives a direction.
const SHORTEST: f64 = 1e-7;

/// The pose of a frame without defaults: the identity if nothing is said.
pub(super) fn pose(element: &Element, settings: &Compiler) -> Result<Transform<f64>, Fault> {
    let r = array(element.find("pos"), &element.tag)?.unwrap_or([0.0; 3]);
    let E = rotation([element].into_iter(), settings)?.unwrap_or(Mat3::IDENTITY);
    Ok(Transform::new(E, Vec3::from_f64(r)))
}

/// The coordinate rotation E, old frame to new, of the first of these elements that gives one.
pub(super) fn rotation<'a>(
    mut layers: impl Iterator<Item = &'a Element>,
    settings: &Compiler,
) -> Result<Option<Mat3<f64>>, Fault> {
    let found = layers.find_map(|element| {
        let mut forms = element.attributes.iter().filter(|a| FORMS.contains(&a.name.as_str()));
        forms.next().map(|form| (element, form, forms.next()))
    });
    let Some((element, form, second)) = found else { return Ok(None) };
    if let Some(second) = second {
        let (first, second_name) = (form.name.clone(), second.name.clone());
        let element = element.described();
        return Err(fault(second.at, MjcfFault::TwoOrientations { element, first, second: second_name }));
    }
    Ok(Some(read(form, &element.tag, settings)?))
}

fn read(form: &Attribute, tag: &str, settings: &Compiler) -> Result<Mat3<f64>, Fault> {
    let short = || fault(form.at, MjcfFault::NoDirection { name: form.name.clone(), tag: tag.to_owned() });
    let unit = |v: Vec3<f64>| match v.norm() {
        norm if norm >= SHORTEST => Ok(v * (1.0 / norm)),
        _ => Err(short()),
    };
    Ok(match form.name.as_str() {
        "quat" => {
            let [w, x, y, z] = array(Some(form), tag)?.unwrap_or([1.0, 0.0, 0.0, 0.0]);
            if w * w + x * x + y * y + z * z < SHORTEST * SHORTEST {
                return Err(short());
            }
            Mat3::rotation_quaternion(w, Vec3::new(x, y, z))
        }
        "axisangle" => {
            let [x, y, z, angle] = array(Some(form), tag)?.unwrap_or_default();
            Mat3::rotation_about(unit(Vec3::new(x, y, z))?, (angle * settings.radians).sin_cos())
        }
        "xyaxes" => {
            let [a, b, c, d, e, f] = array(Some(form), tag)?.unwrap_or_default();
            let x = unit(Vec3::new(a, b, c))?;
            let y = Vec3::new(d, e, f);
            let y = unit(y - x * x.dot(y))?;
            Mat3::from_rows(x, y, x.cross(y))
        }
        "zaxis" => from_z(unit(Vec3::from_f64(array(Some(form), tag)?.unwrap_or_default()))?),
        _ => euler(array(Some(form), tag)?.unwrap_or_default(), settings),
    })
}

/// The smallest turn that takes z to a unit vector.
pub(super) fn from_z(z: Vec3<f64>) -> Mat3<f64> {
    let axis = Vec3::Z.cross(z);
    let s = axis.norm();
    let about = if s < 1e-10 { Vec3::X } else { axis * (1.0 / s) };
    let (s, c) = s.atan2(z.z).sin_cos();
    Mat3::rotation_about(about, (s, c))
}

/// Turns about the axes of `eulerseq` in order: lower case about the turned axes, upper case about the first ones.
pub(super) fn euler(angles: [f64; 3], settings: &Compiler) -> Mat3<f64> {
    let mut E = Mat3::IDENTITY;
    for (angle, axis) in angles.into_iter().zip(settings.eulerseq) {
        let about = match axis.to_ascii_lowercase() {
            b'x' => Vec3::X,
            b'y' => Vec3::Y,
            _ => Vec3::Z,
        };
        let turn = Mat3::rotation_about(about, (angle * settings.radians).sin_cos());
        // R = R turn about own axes, turn R about the first ones; E = Rᵀ.
        E = if axis.is_ascii_lowercase() { turn * E } else { E * turn };
    }
    E
}

//! `<origin xyz rpy>`: where a frame stands in another.

use super::element::{Element, Fault};
use super::fault::UrdfFault;
use eigenbody::spatial::{Mat3, Transform, Vec3};

/// How far the norm of a written quaternion may be from 1: files round to three digits or more.
const QUATERNION_TOLERANCE: f64 = 1e-3;

/// The `<origin>` of a joint or an inertia, the identity if there is none.
///
/// ```text
/// E = Rᵀ,  R = Rz(yaw) Ry(pitch) Rx(roll),  r = xyz
/// ```
pub(super) fn origin(owner: Element<'_, '_>) -> Result<Transform<f64>, Fault> {
    let Some(origin) = owner.child("origin")? else { return Ok(Transform::IDENTITY) };
    let xyz = origin.numbers("xyz")?.unwrap_or([0.0; 3]);
    let E = match (origin.numbers("rpy")?, origin.numbers("quat_xyzw")?) {
        (None, None) => Mat3::IDENTITY,
        (Some([roll, pitch, yaw]), None) => Mat3::rotation_rpy(roll, pitch, yaw),
        (None, Some(xyzw)) => rotation(origin, xyzw)?,
        (Some(_), Some(_)) => return Err(origin.fault_at("quat_xyzw", UrdfFault::TwoOrientations)),
    };
    Ok(Transform::new(E, Vec3::from_f64(xyz)))
}

fn rotation(origin: Element<'_, '_>, [x, y, z, w]: [f64; 4]) -> Result<Mat3<f64>, Fault> {
    let norm = x.hypot(y).hypot(z.hypot(w));
    match (norm - 1.0).abs() <= QUATERNION_TOLERANCE {
        true => Ok(Mat3::rotation_quaternion(w, Vec3::new(x, y, z))),
        false => Err(origin.fault_at("quat_xyzw", UrdfFault::NotUnitQuaternion { norm })),
    }
}

//! The PUMA 560, measured.
//!
//! B. Armstrong, O. Khatib, J. Burdick, "The explicit dynamic model and inertial parameters of the PUMA 560 arm", IEEE
//! International Conference on Robotics and Automation, 1986: modified Denavit-Hartenberg frames (table A2), masses (4),
//! centres of mass (5), inertias about them (6) and the effective motor inertias at the joints (6).

use crate::joint::Joint;
use crate::model::{Base, BuildError, JointSpec, Model, ModelBuilder};
use crate::scalar::Real;
use crate::spatial::{Mat3, RigidInertia, Sym3, Transform, Vec3};
use std::f64::consts::FRAC_PI_2;

/// One row: the frame of link i on link i−1, what the link weighs, the motor behind its joint.
struct Row {
    /// Twist about x of link i−1 in quarter turns, length along it (m), offset along z of link i (m).
    alpha: f64,
    a: f64,
    d: f64,
    /// kg; m in the link's frame; kg m² about the centre of mass.
    mass: f64,
    com: [f64; 3],
    inertia: [f64; 3],
    /// Motor and drive inertia seen at the joint (kg m²).
    motor: f64,
    /// Range of motion (degrees).
    range: [f64; 2],
}

#[rustfmt::skip]
const ROWS: [Row; 6] = [
    Row { alpha:  0.0, a:  0.0,    d:  0.0,    mass:  0.0,  com: [0.0; 3],               inertia: [0.0, 0.0, 0.35],          motor: 1.14,  range: [-160.0, 160.0] },
    Row { alpha: -1.0, a:  0.0,    d:  0.2435, mass: 17.40, com: [0.068, 0.006, -0.016], inertia: [0.130, 0.524, 0.539],     motor: 4.71,  range: [-225.0, 45.0] },
    Row { alpha:  0.0, a:  0.4318, d: -0.0934, mass:  4.80, com: [0.0, -0.070, 0.014],   inertia: [0.066, 0.0125, 0.086],    motor: 0.827, range: [-45.0, 225.0] },
    Row { alpha:  1.0, a: -0.0203, d:  0.4331, mass:  0.82, com: [0.0, 0.0, -0.019],     inertia: [1.8e-3, 1.8e-3, 1.3e-3],  motor: 0.2,   range: [-110.0, 170.0] },
    Row { alpha: -1.0, a:  0.0,    d:  0.0,    mass:  0.34, com: [0.0; 3],               inertia: [0.3e-3, 0.3e-3, 0.4e-3],  motor: 0.179, range: [-100.0, 100.0] },
    Row { alpha:  1.0, a:  0.0,    d:  0.0,    mass:  0.09, com: [0.0, 0.0, 0.032],      inertia: [0.15e-3, 0.15e-3, 0.04e-3], motor: 0.193, range: [-266.0, 266.0] },
];

/// The PUMA 560 arm on a fixed base, z up, with motor inertia as armature.
///
/// Link 1 was measured about its axis only; its mass does not matter, as it turns about the fixed vertical.
///
/// ```
/// let arm = eigenbody::family::puma560::<f64>()?;
/// assert_eq!((arm.nv(), arm.armature()[1]), (6, 4.71));
/// # Ok::<(), eigenbody::BuildError>(())
/// ```
pub fn puma560<T: Real>() -> Result<Model<T>, BuildError> {
    let number = T::from_f64;
    let mut robot = ModelBuilder::new("puma560");
    let mut parent = robot.link("base", RigidInertia::ZERO);
    for (i, row) in (1..).zip(&ROWS) {
        let [xx, yy, zz] = row.inertia.map(number);
        let inertia =
            RigidInertia::from_com(number(row.mass), Vec3::from_f64(row.com), Sym3::diagonal(xx, yy, zz));
        let link = robot.link(format!("link_{i}"), inertia);
        let twist = Mat3::rotation_about(Vec3::X, quarter_turns(row.alpha));
        let twist = Transform::new(twist, Vec3::from_f64([row.a, 0.0, 0.0]));
        let placement = Transform::translation(Vec3::from_f64([0.0, 0.0, row.d])) * twist;
        let limits = row.range.map(|degrees| number(degrees.to_radians()));
        robot.joint(JointSpec {
            limits: Some((limits[0], limits[1])),
            ..JointSpec::new(format!("joint_{i}"), Joint::Revolute, parent, link)
                .at(placement)
                .with_armature([number(row.motor)])
        });
        parent = link;
    }
    robot.build(Base::Fixed)
}

/// (sin, cos) of a number of quarter turns, exact for whole ones.
fn quarter_turns<T: Real>(n: f64) -> (T, T) {
    let (s, c) = (n * FRAC_PI_2).sin_cos();
    (T::from_f64(s.round()), T::from_f64(c.round()))
}

//! The mass of a body: from its `<inertial>` or from its geoms.

use super::body::{Align, Body, Moments, Motion};
use super::compiler::{Compiler, FromGeoms};
use super::fault::{Fault, MjcfFault, fault};
use super::geom::Geom;
use super::principal::{Care, Principal, inertia, principal};
use eigenbody::spatial::{Mat3, RigidInertia, Sym3, Transform, Vec3};

/// Total masses below this have no centre.
const SMALLEST_MASS: f64 = 1e-14;

/// A body's mass, its centre in the body's frame, and its principal axes.
#[derive(Debug)]
pub(super) struct Mass {
    pub m: f64,
    pub com: Vec3<f64>,
    pub axes: Principal,
}

impl Mass {
    /// The same as a spatial inertia about a point of the body, on the body's axes.
    pub fn about(&self, point: Vec3<f64>, scale: f64) -> RigidInertia<f64> {
        RigidInertia::from_com(self.m * scale, self.com - point, inertia(&self.axes) * scale)
    }

    /// The frame of the principal axes in the body's.
    pub fn frame(&self) -> Transform<f64> {
        Transform::new(self.axes.E, self.com)
    }
}

/// The mass of a body, bounds and balance applied.
pub(super) fn of(body: &Body) -> Result<Mass, Fault> {
    let settings = &body.settings;
    let mut mass = match (&body.inertial, settings.inertiafromgeom) {
        (_, FromGeoms::Always) | (None, FromGeoms::Auto) if !body.geoms.is_empty() => from_geoms(body)?,
        (Some(inertial), _) => {
            let axes = match &inertial.inertia {
                Moments::Diagonal(moments) => Principal { moments: *moments, E: inertial.pose.E },
                Moments::Full(I) => {
                    let own = principal(*I, Care::Full);
                    Principal { E: own.E * inertial.pose.E, ..own }
                }
            };
            Mass { m: inertial.mass, com: inertial.pose.r, axes }
        }
        // MuJoCo puts the centre of a body about which nothing is said where the body stands in its parent.
        (None, _) => {
            Mass { m: 0.0, com: body.own_pose.r, axes: Principal { moments: [0.0; 3], E: body.own_pose.E } }
        }
    };
    if mass.m < 0.0 || mass.axes.moments.iter().any(|&i| i < 0.0) {
        let element = named(body);
        let problem = "a negative mass or moment of inertia";
        return Err(fault(body.at, MjcfFault::Inertial { element, problem }));
    }
    bound(&mut mass, settings);
    let moments = &mut mass.axes.moments;
    let [a, b, c] = *moments;
    if settings.balanceinertia && (a + b < c || a + c < b || b + c < a) {
        *moments = [(a + b + c) / 3.0; 3];
    }
    Ok(mass)
}

fn bound(mass: &mut Mass, settings: &Compiler) {
    mass.m = mass.m.max(settings.boundmass);
    mass.axes.moments = mass.axes.moments.map(|i| i.max(settings.boundinertia));
}

/// `body 'arm'`, or `<body>` without a name.
fn named(body: &Body) -> String {
    body.name.as_ref().map_or("<body>".to_owned(), |name| format!("body '{name}'"))
}

/// One geom gives its own axes; several give those of their sum.
fn from_geoms(body: &Body) -> Result<Mass, Fault> {
    if let [one] = body.geoms.as_slice() {
        let Geom { pose, mass, inertia } = *one;
        return Ok(Mass { m: mass, com: pose.r, axes: Principal { moments: inertia, E: pose.E } });
    }
    let m: f64 = body.geoms.iter().map(|g| g.mass).sum();
    if m < SMALLEST_MASS {
        let problem = "several geoms, but no mass";
        return Err(fault(body.at, MjcfFault::Inertial { element: named(body), problem }));
    }
    let moment = body.geoms.iter().fold(Vec3::ZERO, |sum, g| sum + g.pose.r * g.mass);
    let com = moment * (1.0 / m);
    let mut I = Sym3::ZERO;
    for geom in &body.geoms {
        let [a, b, c] = geom.inertia;
        let own = Sym3::diagonal(a, b, c).congruence(geom.pose.E);
        I += RigidInertia::from_com(geom.mass, geom.pose.r - com, own).I;
    }
    Ok(Mass { m, com, axes: principal(I, Care::Full) })
}

/// Moves a body with a lone free joint to its centre of mass and principal axes, if it is to be aligned.
pub(super) fn align(body: &mut Body, mass: &mut Mass) {
    let [joint] = body.joints.as_slice() else { return };
    let wanted = match joint.align {
        Align::Never => false,
        Align::Always => true,
        Align::Auto => body.settings.alignfree,
    };
    if joint.motion != Motion::Free || !body.children.is_empty() || !wanted {
        return;
    }
    let frame = mass.frame();
    body.sites.iter_mut().for_each(|(_, pose)| *pose = *pose * frame.inverse());
    body.pose = frame * body.pose;
    mass.com = Vec3::ZERO;
    mass.axes.E = Mat3::IDENTITY;
}

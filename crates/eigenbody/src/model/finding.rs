//! What is suspicious about a model: recorded, never repaired.

use super::Model;
use super::body::{Body, LinkInfo};
use super::builder::{JointId, LinkId, ModelBuilder};
use super::error::Place;
use super::plausible::{self, Sized};
use crate::scalar::Real;
use crate::spatial::{RigidInertia, Sym3};
use std::fmt;

/// Something that a physical robot would not have.
#[derive(Debug, Clone, PartialEq)]
pub enum Finding {
    /// A principal moment of inertia about the centre of mass is zero or negative.
    InertiaNotPositive {
        /// The link.
        link: LinkId,
        /// Its name.
        name: String,
        /// Principal moments, ascending (kg m²).
        principal: [f64; 3],
    },
    /// The largest principal moment exceeds the sum of the other two: no distribution of mass has it.
    TriangleInequality {
        /// The link.
        link: LinkId,
        /// Its name.
        name: String,
        /// Principal moments, ascending (kg m²).
        principal: [f64; 3],
    },
    /// A moving body without mass.
    ZeroMass {
        /// The link that its joint carries.
        link: LinkId,
        /// Its name.
        name: String,
    },
    /// A link's mass is spread wider than any robot is.
    GyrationRadius {
        /// The link.
        link: LinkId,
        /// Its name.
        name: String,
        /// Largest radius of gyration about the centre of mass (m).
        radius: f64,
    },
    /// Half of the links or more are denser or thinner than any matter: masses in grams, or lengths in millimetres.
    Units {
        /// Median of mass over the volume that the inertia suggests (kg/m³).
        density: f64,
    },
    /// A left and a right link with the same name but for the side have different masses or moments.
    TwinDiffers {
        /// The left link.
        link: LinkId,
        /// Its name.
        name: String,
        /// The right link's name.
        twin: String,
    },
    /// A mimic joint follows a joint that is not there, does not move or has several coordinates: it is left free.
    MimicUnknown {
        /// The mimic joint.
        joint: JointId,
        /// Its name.
        name: String,
        /// The name that it follows.
        follows: String,
        /// Number of coordinates of that joint; zero if no moving joint has the name.
        coordinates: usize,
    },
}

impl Finding {
    /// A stable name of its kind.
    pub fn code(&self) -> &'static str {
        match self {
            Self::InertiaNotPositive { .. } => "inertia-not-positive",
            Self::TriangleInequality { .. } => "triangle-inequality",
            Self::ZeroMass { .. } => "zero-mass",
            Self::GyrationRadius { .. } => "gyration-radius",
            Self::Units { .. } => "units",
            Self::TwinDiffers { .. } => "twin-differs",
            Self::MimicUnknown { .. } => "mimic-unknown",
        }
    }

    /// The name of the link or joint that it is about; empty for the whole model.
    pub fn subject(&self) -> &str {
        match self {
            Self::InertiaNotPositive { name, .. }
            | Self::TriangleInequality { name, .. }
            | Self::ZeroMass { name, .. }
            | Self::GyrationRadius { name, .. }
            | Self::TwinDiffers { name, .. }
            | Self::MimicUnknown { name, .. } => name,
            Self::Units { .. } => "",
        }
    }

    /// The link or joint to point at.
    pub fn place(&self) -> Place {
        match *self {
            Self::InertiaNotPositive { link, .. }
            | Self::TriangleInequality { link, .. }
            | Self::ZeroMass { link, .. }
            | Self::GyrationRadius { link, .. }
            | Self::TwinDiffers { link, .. } => Place::Link(link),
            Self::Units { .. } => Place::Model,
            Self::MimicUnknown { joint, .. } => Place::Joint(joint),
        }
    }
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::InertiaNotPositive { name, principal: [a, b, c], .. } => {
                write!(
                    f,
                    "inertia of link '{name}' is not positive definite: principal moments {a:.3e}, {b:.3e}, {c:.3e} kg m²"
                )
            }
            Self::TriangleInequality { name, principal: [a, b, c], .. } => {
                write!(
                    f,
                    "inertia of link '{name}' is not physical: principal moments {a:.3e} + {b:.3e} < {c:.3e} kg m²"
                )
            }
            Self::GyrationRadius { name, radius, .. } => {
                write!(f, "mass of link '{name}' is spread over {radius:.3e} m (radius of gyration)")
            }
            Self::Units { density } => {
                let guess = if *density > 1.0 { "masses in grams" } else { "lengths in millimetres" };
                write!(
                    f,
                    "links have a density of about {density:.1e} kg/m³: {guess}, where kg and m are expected?"
                )
            }
            Self::TwinDiffers { name, twin, .. } => {
                write!(f, "links '{name}' and '{twin}' have different masses or moments of inertia")
            }
            Self::ZeroMass { name, .. } => write!(f, "moving link '{name}' has no mass"),
            Self::MimicUnknown { name, follows, coordinates: 0, .. } => {
                write!(
                    f,
                    "mimic joint '{name}' follows '{follows}', which is no moving joint; it is left free"
                )
            }
            Self::MimicUnknown { name, follows, coordinates, .. } => {
                write!(
                    f,
                    "mimic joint '{name}' follows '{follows}', which has {coordinates} coordinates; it is left free"
                )
            }
        }
    }
}

/// Findings on the links' inertias as given. A link without any inertia is a frame, not a fault.
pub(super) fn of_links<T: Real>(robot: &ModelBuilder<T>) -> Vec<Finding> {
    let (mut findings, mut plausible) = (Vec::new(), Vec::new());
    for (i, (name, inertia)) in robot.links.iter().enumerate() {
        if *inertia == RigidInertia::ZERO {
            continue;
        }
        let (link, name) = (LinkId(i as u32), || name.to_string());
        let principal = principal_moments(inertia);
        plausible.push(Sized { link, mass: inertia.m.to_f64(), principal });
        findings.extend(of_moments(link, name, principal));
    }
    findings.extend(plausible::of_sizes(&plausible, |link| &robot.links[link.index()].0));
    findings
}

/// What no body has. Files round inertias to a few digits; an excess within 1e-6 of the moments is rounding.
fn of_moments(link: LinkId, name: impl Fn() -> String, principal: [f64; 3]) -> Option<Finding> {
    let [a, b, c] = principal;
    if a <= 0.0 {
        return Some(Finding::InertiaNotPositive { link, name: name(), principal });
    }
    (c > (a + b) * (1.0 + 1e-6)).then(|| Finding::TriangleInequality { link, name: name(), principal })
}

/// The findings of a model after the inertia of a body was changed: those on its links, and on twins of theirs, are made anew.
///
/// `inertia` is what `before` was replaced with, in the frame in which it was given. A twin is compared by its body's inertia.
pub(super) fn of_change<T: Real>(
    model: &Model<T>,
    body: usize,
    before: &RigidInertia<T>,
    inertia: &RigidInertia<T>,
) -> Vec<Finding> {
    let name = |link: LinkId| model.links[link.index()].name();
    let own = |link: LinkId| model.links[link.index()].body() == Some(body);
    let own_twin = |twin: &str| model.links.iter().any(|l| l.body() == Some(body) && l.name() == twin);
    let (mut findings, old): (Vec<Finding>, Vec<Finding>) =
        model.findings.iter().cloned().partition(|finding| {
            let twin = matches!(finding, Finding::TwinDiffers { twin, .. } if own_twin(twin));
            !(twin || matches!(finding.place(), Place::Link(link) if own(link)))
        });
    let link = LinkId(model.bodies[body].link);
    if *inertia != RigidInertia::ZERO {
        let principal = principal_moments(inertia);
        findings.extend(of_moments(link, || name(link).to_owned(), principal));
        let changed = Sized { link, mass: inertia.m.to_f64(), principal };
        let has_units = findings.iter().any(|finding| matches!(finding, Finding::Units { .. }));
        findings.extend(plausible::of_size(&changed, name).filter(|_| !has_units));
        let bodies = model.bodies.iter().map(|b| (LinkId(b.link), &b.I));
        let twin = bodies.filter(|(other, _)| plausible::are_twins(name(link), name(*other)));
        for (link, I) in twin {
            let twin = Sized { link, mass: I.m.to_f64(), principal: principal_moments(I) };
            findings.extend(plausible::of_twins(&[&changed, &twin], name));
        }
    }
    // A frame between two joints is meant to have no mass, and has no finding before.
    let was_meant = before.m == T::ZERO && !old.iter().any(|f| matches!(f, Finding::ZeroMass { .. }));
    if inertia.m == T::ZERO && !was_meant {
        findings.push(Finding::ZeroMass { link, name: name(link).to_owned() });
    }
    findings
}

/// Findings on the bodies as merged; `frames` are links that are meant to have no mass, ascending.
pub(super) fn of_bodies<T: Real>(links: &[LinkInfo<T>], bodies: &[Body<T>], frames: &[u32]) -> Vec<Finding> {
    let massless =
        bodies.iter().filter(|body| body.I.m.to_f64() == 0.0 && frames.binary_search(&body.link).is_err());
    let finding = |body: &Body<T>| Finding::ZeroMass {
        link: LinkId(body.link),
        name: links[body.link()].name.to_string(),
    };
    massless.map(finding).collect()
}

/// Principal moments about the centre of mass, ascending.
pub(super) fn principal_moments<T: Real>(inertia: &RigidInertia<T>) -> [f64; 3] {
    let (m, h) = (inertia.m.to_f64(), inertia.h.map(T::to_f64));
    let mut I = inertia.I.map(T::to_f64);
    if m > 0.0 {
        let about_com = RigidInertia::from_com(m, h * (1.0 / m), Sym3::ZERO).I;
        let before = I;
        I = I - about_com;
        // Moving a moment to the centre of mass cancels: what is below the rounding of the moved numbers is zero.
        let rounding = 8.0 * f64::EPSILON * (before.xx.abs() + before.yy.abs() + before.zz.abs());
        I = I.map(|x| if x.abs() <= rounding { 0.0 } else { x });
    }
    jacobi(I)
}

/// Eigenvalues of a symmetric 3 × 3 matrix by cyclic Jacobi rotations, ascending.
fn jacobi(A: Sym3<f64>) -> [f64; 3] {
    let mut a = [[A.xx, A.xy, A.xz], [A.xy, A.yy, A.yz], [A.xz, A.yz, A.zz]];
    for _ in 0..12 {
        for (p, q, r) in [(0, 1, 2), (0, 2, 1), (1, 2, 0)] {
            if a[p][q] == 0.0 {
                continue;
            }
            let theta = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
            let t = theta.signum() / (theta.abs() + theta.hypot(1.0));
            let t = if theta == 0.0 { 1.0 } else { t };
            let c = 1.0 / t.hypot(1.0);
            let s = t * c;
            let apq = a[p][q];
            a[p][p] -= t * apq;
            a[q][q] += t * apq;
            (a[p][q], a[q][p]) = (0.0, 0.0);
            let (arp, arq) = (a[r][p], a[r][q]);
            (a[r][p], a[p][r]) = (c * arp - s * arq, c * arp - s * arq);
            (a[r][q], a[q][r]) = (s * arp + c * arq, s * arp + c * arq);
        }
    }
    let mut principal = [a[0][0], a[1][1], a[2][2]];
    principal.sort_by(f64::total_cmp);
    principal
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spatial::Vec3;

    #[test]
    fn principal_moments_of_a_turned_and_shifted_box() {
        let E = crate::spatial::Mat3::rotation_rpy(0.3, -1.1, 2.0);
        let I = Sym3::diagonal(0.02, 0.03, 0.04).congruence(E);
        let body = RigidInertia::from_com(3.0, Vec3::new(1.0, -2.0, 0.5), I);
        let found = principal_moments(&body);
        for (found, expected) in found.iter().zip([0.02, 0.03, 0.04]) {
            // 10 ε of what the shift adds, 3·(1 + 4 + 0.25)
            assert!((found - expected).abs() < 10.0 * f64::EPSILON * 16.0, "{found} {expected}");
        }
    }
}

//! Loops: two links that hold on to each other across the tree.
//!
//! ```text
//! φ(q) = 0      φ: where anchor b stands in anchor a, along the directions that are held
//! A = ∂φ/∂q ⊕:  t·E_a (v_b − v_a) at b's origin   for a direction t that does not slide
//!               d·E_a (ω_b − ω_a)                  for a direction d that does not turn
//! ```
//! Featherstone (2008), §8.2: v must satisfy A v = 0. Rows of turning are exact where φ = 0, which is where loops are.

use super::kinematics::{axes, link_pose};
use crate::error::InputError;
use crate::joint::quaternion_log;
use crate::matrix::Matrix;
use crate::model::{Model, ROTATION_TOLERANCE, check};
use crate::spatial::{Mat3, Motion, Transform, Vec3};
use std::f64::consts::PI;

/// A frame that moves with a link.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Anchor {
    /// Index into [`Model::links`]; none for the world.
    pub link: Option<usize>,
    /// From the link's frame, or the world's, to this one; E Eᵀ is 1 to within 1e-6.
    pub pose: Transform<f64>,
}

/// What the two frames of a loop leave each other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Tie {
    /// Nothing: six rows.
    Weld,
    /// All turns about one point: three rows.
    Ball,
    /// Turns about an axis (unit vector, the same in both frames): five rows.
    Hinge(Vec3<f64>),
    /// Slides along an axis: five rows.
    Slide(Vec3<f64>),
    /// Turns about an axis of the first frame, then about one of the second: four rows.
    Universal {
        /// Unit vector in the first frame.
        first: Vec3<f64>,
        /// Unit vector in the second frame.
        second: Vec3<f64>,
    },
}

impl Tie {
    /// Its axes.
    fn axes(&self) -> [Option<Vec3<f64>>; 2] {
        match *self {
            Self::Weld | Self::Ball => [None, None],
            Self::Hinge(axis) | Self::Slide(axis) => [Some(axis), None],
            Self::Universal { first, second } => [Some(first), Some(second)],
        }
    }
}

/// Two frames on two links that must stand in each other.
#[derive(Debug, Clone, PartialEq)]
pub struct Closure {
    /// How to call it.
    pub name: String,
    /// What they leave each other.
    pub tie: Tie,
    /// The frames.
    pub anchors: [Anchor; 2],
}

impl Closure {
    /// Number of rows of φ.
    pub fn rows(&self) -> usize {
        match self.tie {
            Tie::Weld => 6,
            Tie::Ball => 3,
            Tie::Hinge(_) | Tie::Slide(_) => 5,
            Tie::Universal { .. } => 4,
        }
    }

    fn place(&self, model: &Model<f64>, q: &[f64]) -> Result<Place, InputError> {
        self.check(model)?;
        let pose = |anchor: &Anchor| match anchor.link {
            Some(link) => Ok(anchor.pose * link_pose(model, q, link)?),
            None => Ok::<_, InputError>(anchor.pose),
        };
        let [a, b] = [pose(&self.anchors[0])?, pose(&self.anchors[1])?];
        Ok(Place { E: a.E, origin: b.r, shift: a.E * (b.r - a.r), R: a.E * b.E.transpose() })
    }

    fn check(&self, model: &Model<f64>) -> Result<(), InputError> {
        let count = model.links().len();
        for Anchor { pose, link } in &self.anchors {
            if let Some(index) = link.filter(|&link| link >= count) {
                return Err(InputError::NoSuch { what: "link", index, count });
            }
            if !pose.E.is_rotation(ROTATION_TOLERANCE) {
                return Err(InputError::NotARotation { closure: self.name.clone() });
            }
            check("origin of an anchor", &pose.r.to_array(), 3)?;
        }
        let lengths = self.tie.axes().into_iter().flatten().map(Vec3::norm);
        match lengths.into_iter().find(|length| length.is_nan() || (length - 1.0).abs() > ROTATION_TOLERANCE)
        {
            Some(length) => Err(InputError::NotAUnitVector { closure: self.name.clone(), length }),
            None => Ok(()),
        }
    }

    /// Directions in the first frame along which nothing slides, and about which nothing turns.
    fn held(&self, place: &Place) -> (Vec<Vec3<f64>>, Vec<Vec3<f64>>) {
        let all = || vec![Vec3::X, Vec3::Y, Vec3::Z];
        match self.tie {
            Tie::Weld => (all(), all()),
            Tie::Ball => (all(), Vec::new()),
            Tie::Hinge(axis) => (all(), across(axis)),
            Tie::Slide(axis) => (across(axis), all()),
            Tie::Universal { first, second } => (all(), vec![(place.R * second).cross(first)]),
        }
    }

    /// How far anchor b is turned from anchor a, along the directions about which nothing turns.
    fn turn(&self, place: &Place, held: &[Vec3<f64>]) -> Vec<f64> {
        let along = |e: Vec3<f64>| held.iter().map(|d| d.dot(e)).collect();
        match self.tie {
            Tie::Ball => Vec::new(),
            Tie::Weld | Tie::Slide(_) => along(rotation_vector(place.R)),
            Tie::Hinge(axis) => along(swing(axis, place.R * axis)),
            Tie::Universal { first, second } => vec![first.dot(place.R * second) - first.dot(second)],
        }
    }
}

/// Where anchor b stands in anchor a.
struct Place {
    /// From the world's axes to a's.
    E: Mat3<f64>,
    /// b's origin in the world.
    origin: Vec3<f64>,
    /// b's origin in a.
    shift: Vec3<f64>,
    /// From b's axes to a's.
    R: Mat3<f64>,
}

/// Two unit vectors at right angles to an axis and each other.
fn across(axis: Vec3<f64>) -> Vec<Vec3<f64>> {
    let [x, y, z] = axis.to_array().map(f64::abs);
    let other = if x <= y && x <= z {
        Vec3::X
    } else if y <= z {
        Vec3::Y
    } else {
        Vec3::Z
    };
    let first = axis.cross(other);
    let first = first * (1.0 / first.norm());
    vec![first, axis.cross(first)]
}

/// The shortest turn from one unit vector to another: angle times axis.
fn swing(from: Vec3<f64>, to: Vec3<f64>) -> Vec3<f64> {
    let w = from.cross(to);
    match (w.norm(), from.dot(to)) {
        (0.0, c) if c < 0.0 => across(from)[0] * PI,
        (0.0, _) => Vec3::ZERO,
        (s, c) => w * (s.atan2(c) / s),
    }
}

/// Angle times axis of a rotation (columns: the new axes in the old frame).
fn rotation_vector(R: Mat3<f64>) -> Vec3<f64> {
    quaternion_log([1.0, 0.0, 0.0, 0.0], R.transpose().quaternion())
}

/// What rounding is measured by, for every row of φ: for slides the larger distance of the two anchors from the world's origin, and at
/// least a metre; one for turns.
pub(crate) fn closure_sizes(
    model: &Model<f64>,
    q: &[f64],
    closures: &[Closure],
) -> Result<Vec<f64>, InputError> {
    let mut sizes = Vec::new();
    for closure in closures {
        let place = closure.place(model, q)?;
        let slides = closure.held(&place).0.len();
        let far = place.origin.norm().max((place.origin - place.E.transpose_times(place.shift)).norm());
        sizes.extend((0..closure.rows()).map(|row| if row < slides { far.max(1.0) } else { 1.0 }));
    }
    Ok(sizes)
}

/// φ(q): how far loops are from being closed.
///
/// | name | shape | unit |
/// |------|-------|------|
/// | `q` | `nq` | rad, m, unit quaternion |
/// | returned | the rows of every closure in turn, slides before turns | m, rad |
///
/// Cost O(depth) a closure. Errors: [`InputError`] if q does not fit the model; [`InputError::NoSuch`] for a link that is not there;
/// [`InputError::NotARotation`], [`InputError::NotFinite`] or [`InputError::NotAUnitVector`] for an anchor or an axis.
pub fn closure_residual(model: &Model<f64>, q: &[f64], closures: &[Closure]) -> Result<Vec<f64>, InputError> {
    let mut rows = Vec::new();
    for closure in closures {
        let place = closure.place(model, q)?;
        let (slides, turns) = closure.held(&place);
        rows.extend(slides.iter().map(|t| t.dot(place.shift)));
        rows.extend(closure.turn(&place, &turns));
    }
    Ok(rows)
}

/// A(q): what loops forbid, A v = 0.
///
/// | name | shape | unit |
/// |------|-------|------|
/// | `q` | `nq` | rad, m, unit quaternion |
/// | returned | rows of [`closure_residual`] × `nv` | m or rad a unit of v |
///
/// Method: columns of S in the world's axes, of the joints that move one link and not the other. Cost O(N + rows · depth).
///
/// Errors: [`InputError`] if q does not fit the model; [`InputError::NoSuch`] for a link that is not there;
/// [`InputError::NotARotation`], [`InputError::NotFinite`] or [`InputError::NotAUnitVector`] for an anchor or an axis.
///
/// ```
/// use eigenbody::dynamics::{Anchor, Closure, Tie, closure_jacobian};
/// use eigenbody::spatial::{Transform, Vec3};
/// let arm = eigenbody::Family::hydra(2, 1.0, 0.0, 1.0)?.model::<f64>()?;
/// // The tip of the second link is tied to the world.
/// let tip = Anchor { link: Some(2), pose: Transform::translation(Vec3::X) };
/// let there = Anchor { link: None, pose: Transform::translation(Vec3::new(2.0, 0.0, 0.0)) };
/// let tied = Closure { name: "tip".into(), tie: Tie::Ball, anchors: [there, tip] };
/// let A = closure_jacobian(&arm, &[0.0, 0.0], &[tied])?;
/// assert_eq!((A.row(1), A.rows()), ([2.0, 1.0].as_slice(), 3));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn closure_jacobian(
    model: &Model<f64>,
    q: &[f64],
    closures: &[Closure],
) -> Result<Matrix<f64>, InputError> {
    let S = axes(model, q)?;
    let mut A = Matrix::zeros(closures.iter().map(Closure::rows).sum(), model.nv());
    let mut row = 0;
    for closure in closures {
        let place = closure.place(model, q)?;
        let (slides, turns) = closure.held(&place);
        let [a, b] = closure.anchors.map(|anchor| path(model, anchor.link));
        // What moves both leaves them where they are.
        let only = |own: &[usize], other: &[usize]| -> Vec<usize> {
            own.iter().copied().filter(|d| !other.contains(d)).collect()
        };
        for (dofs, sign) in [(only(&b, &a), 1.0), (only(&a, &b), -1.0)] {
            for d in dofs {
                let Motion { ang, lin } = S[d];
                let v = place.E * (lin + ang.cross(place.origin)) * sign;
                let w = place.E * ang * sign;
                let entries = slides.iter().map(|t| t.dot(v)).chain(turns.iter().map(|t| t.dot(w)));
                entries.enumerate().for_each(|(k, entry)| A[(row + k, d)] = entry);
            }
        }
        row += closure.rows();
    }
    Ok(A)
}

/// The degrees of freedom that move a link.
fn path(model: &Model<f64>, link: Option<usize>) -> Vec<usize> {
    let mut dofs = Vec::new();
    let mut body = link.and_then(|link| model.links()[link].body());
    while let Some(i) = body {
        dofs.extend(model.bodies()[i].dofs());
        body = model.bodies()[i].parent();
    }
    dofs
}

//! Joint kinds: one enum, one file a kind, one `match`.
//!
//! In a model the axis of every single-axis joint is z (ARCHITECTURE, invariant 4), so kinds carry no axis. X_J(q) goes
//! from the joint's frame on the parent's side to the body's frame; the columns of S are in the body's frame.

mod column;
mod cylindrical;
mod floating;
mod helical;
mod manifold;
mod planar;
mod prismatic;
mod revolute;
mod spherical;
mod tangent;
mod universal;

pub(crate) use column::Column;
pub(crate) use manifold::quaternion_log;

use crate::scalar::{Real, Scalar};
use crate::spatial::{Force, Motion, Transform, Vec3};

/// How a body moves against its parent.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Joint<T> {
    /// Not at all. Fixed joints are merged when the model is built.
    Fixed,
    /// Rotation about the axis: q angle (rad).
    Revolute,
    /// Rotation without limits; dynamics as revolute.
    Continuous,
    /// Translation along the axis: q displacement (m).
    Prismatic,
    /// Rotation about the axis with `pitch` metres of travel a radian: q angle (rad).
    Helical {
        /// Travel along the axis a radian (m/rad).
        pitch: T,
    },
    /// Rotation about and translation along the axis: q angle (rad), displacement (m).
    Cylindrical,
    /// Rotation about an axis fixed in the parent, then about the axis fixed in the body: q two angles (rad).
    Universal {
        /// First axis, a unit vector in the joint's frame.
        first: Vec3<T>,
    },
    /// Motion in the plane normal to the axis: q = x, y (m), angle (rad); v = vx, vy, ωz in the body's frame.
    Planar,
    /// Any rotation: q unit quaternion w, x, y, z; v = angular velocity in the body's frame.
    Spherical,
    /// Any motion: q = x, y, z (m), w, x, y, z; v = [angular; linear] in the body's frame.
    Floating,
}

impl<T: Scalar> Joint<T> {
    /// Number of coordinates.
    pub fn nq(&self) -> usize {
        match self {
            Self::Fixed => 0,
            Self::Revolute | Self::Continuous | Self::Prismatic | Self::Helical { .. } => 1,
            Self::Cylindrical | Self::Universal { .. } => 2,
            Self::Planar => 3,
            Self::Spherical => 4,
            Self::Floating => 7,
        }
    }

    /// Number of degrees of freedom.
    pub fn nv(&self) -> usize {
        match self {
            Self::Spherical => 3,
            Self::Floating => 6,
            _ => self.nq(),
        }
    }

    /// X_J(q), and the columns S_d into `S`.
    #[inline(always)]
    pub(crate) fn kinematics(&self, q: &[T], S: &mut [Motion<T>]) -> Transform<T> {
        match *self {
            Self::Fixed => Transform::IDENTITY,
            Self::Revolute | Self::Continuous => revolute::kinematics(q, S),
            Self::Prismatic => prismatic::kinematics(q, S),
            Self::Helical { pitch } => helical::kinematics(pitch, q, S),
            Self::Cylindrical => cylindrical::kinematics(q, S),
            Self::Universal { first } => universal::kinematics(first, q, S),
            Self::Planar => planar::kinematics(q, S),
            Self::Spherical => spherical::kinematics(q, S),
            Self::Floating => floating::kinematics(q, S),
        }
    }

    /// c_J = S° v: what the columns' own change adds to the acceleration. Only a universal joint's columns change.
    #[inline(always)]
    pub(crate) fn bias(&self, S: &[Motion<T>], v: &[T]) -> Motion<T> {
        match self {
            Self::Universal { .. } => universal::bias(S, v),
            _ => Motion::ZERO,
        }
    }

    /// Position of the quaternion among the joint's coordinates, if it has one.
    pub fn quaternion(&self) -> Option<usize> {
        match self {
            Self::Spherical => Some(0),
            Self::Floating => Some(3),
            _ => None,
        }
    }

    /// Name of the kind, as in a model file.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Fixed => "fixed",
            Self::Revolute => "revolute",
            Self::Continuous => "continuous",
            Self::Prismatic => "prismatic",
            Self::Helical { .. } => "helical",
            Self::Cylindrical => "cylindrical",
            Self::Universal { .. } => "universal",
            Self::Planar => "planar",
            Self::Spherical => "spherical",
            Self::Floating => "floating",
        }
    }

    /// What DoF names add to the joint's name; nothing for one DoF.
    pub fn dof_suffixes(&self) -> &'static [&'static str] {
        match self {
            Self::Fixed => &[],
            Self::Revolute | Self::Continuous | Self::Prismatic | Self::Helical { .. } => &[""],
            Self::Cylindrical => &["/angle", "/displacement"],
            Self::Universal { .. } => &["/first", "/second"],
            Self::Planar => &["/vx", "/vy", "/wz"],
            Self::Spherical => &["/wx", "/wy", "/wz"],
            Self::Floating => &["/wx", "/wy", "/wz", "/vx", "/vy", "/vz"],
        }
    }

    /// What is known of each column of S without looking at q.
    #[inline(always)]
    pub(crate) fn columns(&self) -> &'static [Column] {
        use Column::{AngX, AngY, AngZ, General, LinX, LinY, LinZ};
        match self {
            Self::Fixed => &[],
            Self::Revolute | Self::Continuous => &[AngZ],
            Self::Prismatic => &[LinZ],
            Self::Helical { .. } => &[General],
            Self::Cylindrical => &[AngZ, LinZ],
            Self::Universal { .. } => &[General, AngZ],
            Self::Planar => &[LinX, LinY, AngZ],
            Self::Spherical => &[AngX, AngY, AngZ],
            Self::Floating => &[AngX, AngY, AngZ, LinX, LinY, LinZ],
        }
    }

    /// Whether each DoF is a translation (true, m) or a rotation (false, rad).
    pub fn translations(&self) -> &'static [bool] {
        match self {
            Self::Fixed => &[],
            Self::Revolute | Self::Continuous | Self::Helical { .. } => &[false],
            Self::Prismatic => &[true],
            Self::Cylindrical => &[false, true],
            Self::Universal { .. } => &[false, false],
            Self::Planar => &[true, true, false],
            Self::Spherical => &[false, false, false],
            Self::Floating => &[false, false, false, true, true, true],
        }
    }

    /// The kind in another scalar.
    #[inline(always)]
    pub(crate) fn map<U: Scalar>(&self, f: impl Fn(T) -> U + Copy) -> Joint<U> {
        match *self {
            Self::Fixed => Joint::Fixed,
            Self::Revolute => Joint::Revolute,
            Self::Continuous => Joint::Continuous,
            Self::Prismatic => Joint::Prismatic,
            Self::Helical { pitch } => Joint::Helical { pitch: f(pitch) },
            Self::Cylindrical => Joint::Cylindrical,
            Self::Universal { first } => Joint::Universal { first: first.map(f) },
            Self::Planar => Joint::Planar,
            Self::Spherical => Joint::Spherical,
            Self::Floating => Joint::Floating,
        }
    }
}

impl<T: Real> Joint<T> {
    /// q moved along a constant body velocity for unit time: q ⊕ v, exact on the joint's own manifold.
    pub fn integrate(&self, q: &[T], v: &[T], out: &mut [T]) {
        match self {
            Self::Planar => planar::integrate(q, v, out),
            Self::Spherical => spherical::integrate(q, v, out),
            Self::Floating => floating::integrate(q, v, out),
            _ => {
                for ((out, &q), &v) in out.iter_mut().zip(q).zip(v) {
                    *out = q + v;
                }
            }
        }
    }

    /// The constant body velocity that moves `from` to `to` in unit time: from ⊕ v = to. Rotations go the shorter way round.
    pub fn difference(&self, from: &[T], to: &[T], out: &mut [T]) {
        match self {
            Self::Planar => planar::difference(from, to, out),
            Self::Spherical => spherical::difference(from, to, out),
            Self::Floating => floating::difference(from, to, out),
            _ => {
                for ((out, &from), &to) in out.iter_mut().zip(from).zip(to) {
                    *out = to - from;
                }
            }
        }
    }

    /// θ̇ of q = q₀ ⊕ θ where q moves with the body velocity v: dexp₋θ⁻¹ v; v itself where q̇ = v.
    ///
    /// For turns θ below 2π.
    pub fn tangent_rate(&self, theta: &[T], v: &[T], out: &mut [T]) {
        match self.twist(v) {
            Some(v) => {
                let u = self.twist(theta).map_or(Motion::ZERO, |theta| -theta);
                self.write(tangent::dexp_inverse(u, v).to_array(), out);
            }
            None => out.copy_from_slice(v),
        }
    }

    /// dexp_uᵀ f: what a force or momentum f of the joint's velocity is against θ; f itself where q̇ = v.
    pub fn dexp_dual(&self, u: &[T], f: &[T], out: &mut [T]) {
        match (self.twist(u), self.wrench(f)) {
            (Some(u), Some(f)) => self.write(tangent::dexp_dual(u, f).to_array(), out),
            _ => out.copy_from_slice(f),
        }
    }

    /// The inverse of [`dexp_dual`](Self::dexp_dual). For turns below 2π.
    pub fn dexp_inverse_dual(&self, u: &[T], f: &[T], out: &mut [T]) {
        match (self.twist(u), self.wrench(f)) {
            (Some(u), Some(f)) => self.write(tangent::dexp_inverse_dual(u, f).to_array(), out),
            _ => out.copy_from_slice(f),
        }
    }

    /// True if q̇ = v: the coordinates are numbers on lines.
    pub fn is_linear(&self) -> bool {
        !matches!(self, Self::Planar | Self::Spherical | Self::Floating)
    }

    /// Where the joint's DoFs stand among the six numbers of a motion; none where q̇ = v.
    fn places(&self) -> Option<&'static [usize]> {
        match self {
            Self::Planar => Some(&[3, 4, 2]),
            Self::Spherical => Some(&[0, 1, 2]),
            Self::Floating => Some(&[0, 1, 2, 3, 4, 5]),
            _ => None,
        }
    }

    fn six(&self, x: &[T]) -> Option<(Vec3<T>, Vec3<T>)> {
        let mut six = [T::ZERO; 6];
        for (&place, &x) in self.places()?.iter().zip(x) {
            six[place] = x;
        }
        Some((Vec3::new(six[0], six[1], six[2]), Vec3::new(six[3], six[4], six[5])))
    }

    fn twist(&self, v: &[T]) -> Option<Motion<T>> {
        self.six(v).map(|(ang, lin)| Motion { ang, lin })
    }

    fn wrench(&self, f: &[T]) -> Option<Force<T>> {
        self.six(f).map(|(ang, lin)| Force { ang, lin })
    }

    fn write(&self, six: [T; 6], out: &mut [T]) {
        for (&place, out) in self.places().unwrap_or(&[]).iter().zip(out) {
            *out = six[place];
        }
    }
}

//! Rotations by what is known of them before the configuration is: each is applied in as few products as it needs.

use super::mat3::turned;
use super::{ArticulatedInertia, Force, Mat3, Motion, Offset, PseudoInertia, Sym3, Vec3, Zero};
use crate::scalar::Scalar;

/// A rotation of coordinates E, old to new.
pub(crate) trait Rotation<T>: Copy {
    /// The coordinate that is zero of the new origin's position in the old frame, where the two frames were chosen so.
    const ZERO: Zero = Zero::None;
    /// E v.
    fn times(self, v: Vec3<T>) -> Vec3<T>;
    /// Eᵀ v.
    fn transpose_times(self, v: Vec3<T>) -> Vec3<T>;
    /// Eᵀ A E.
    fn congruence(self, A: Sym3<T>) -> Sym3<T>;
    /// Eᵀ A E of a matrix that is not symmetric.
    fn similarity(self, A: Mat3<T>) -> Mat3<T>;
}

/// E = 1.
#[derive(Clone, Copy)]
pub(crate) struct Straight;

/// A quarter turn about x, forwards or back: coordinates change places.
#[derive(Clone, Copy)]
pub(crate) struct Quarter<const FORWARDS: bool>;

/// A quarter turn about z, then one about x, forwards or back: coordinates change places.
#[derive(Clone, Copy)]
pub(crate) struct Corner<const FORWARDS: bool>;

/// A turn about x by the angle with this sine and cosine; it is nearer to a quarter turn, or to none.
#[derive(Clone, Copy)]
pub(crate) struct AboutX<T, const STEEP: bool>(pub T, pub T);

/// Another rotation, to an origin that may stand anywhere.
#[derive(Clone, Copy)]
pub(crate) struct Anywhere<C>(pub C);

/// First `first`, then a turn about z by the angle with this sine and cosine.
#[derive(Clone, Copy)]
pub(crate) struct ThenZ<T, C> {
    pub turn: (T, T),
    pub first: C,
}

impl<T: Scalar> Rotation<T> for Straight {
    const ZERO: Zero = Zero::Z;
    #[inline(always)]
    fn times(self, v: Vec3<T>) -> Vec3<T> {
        v
    }
    #[inline(always)]
    fn transpose_times(self, v: Vec3<T>) -> Vec3<T> {
        v
    }
    #[inline(always)]
    fn congruence(self, A: Sym3<T>) -> Sym3<T> {
        A
    }
    #[inline(always)]
    fn similarity(self, A: Mat3<T>) -> Mat3<T> {
        A
    }
}

impl<T: Scalar, const FORWARDS: bool> Rotation<T> for Quarter<FORWARDS> {
    const ZERO: Zero = Zero::Y;
    #[inline(always)]
    fn times(self, v: Vec3<T>) -> Vec3<T> {
        if FORWARDS { Vec3::new(v.x, v.z, -v.y) } else { Vec3::new(v.x, -v.z, v.y) }
    }
    #[inline(always)]
    fn transpose_times(self, v: Vec3<T>) -> Vec3<T> {
        if FORWARDS { Vec3::new(v.x, -v.z, v.y) } else { Vec3::new(v.x, v.z, -v.y) }
    }
    #[inline(always)]
    fn congruence(self, A: Sym3<T>) -> Sym3<T> {
        let (xy, xz) = if FORWARDS { (-A.xz, A.xy) } else { (A.xz, -A.xy) };
        Sym3 { xx: A.xx, yy: A.zz, zz: A.yy, xy, xz, yz: -A.yz }
    }
    #[inline(always)]
    fn similarity(self, A: Mat3<T>) -> Mat3<T> {
        let Mat3 { x, y, z } = A;
        if FORWARDS {
            Mat3 { x: Vec3::new(x.x, -x.z, x.y), y: Vec3::new(-z.x, z.z, -z.y), z: Vec3::new(y.x, -y.z, y.y) }
        } else {
            Mat3 { x: Vec3::new(x.x, x.z, -x.y), y: Vec3::new(z.x, z.z, -z.y), z: Vec3::new(-y.x, -y.z, y.y) }
        }
    }
}

impl<T: Scalar, const FORWARDS: bool> Rotation<T> for Corner<FORWARDS> {
    const ZERO: Zero = Zero::X;
    #[inline(always)]
    fn times(self, v: Vec3<T>) -> Vec3<T> {
        if FORWARDS { Vec3::new(v.y, v.z, v.x) } else { Vec3::new(v.y, -v.z, -v.x) }
    }
    #[inline(always)]
    fn transpose_times(self, v: Vec3<T>) -> Vec3<T> {
        if FORWARDS { Vec3::new(v.z, v.x, v.y) } else { Vec3::new(-v.z, v.x, -v.y) }
    }
    #[inline(always)]
    fn congruence(self, A: Sym3<T>) -> Sym3<T> {
        let (xy, yz) = if FORWARDS { (A.xz, A.xy) } else { (-A.xz, -A.xy) };
        Sym3 { xx: A.zz, yy: A.xx, zz: A.yy, xy, xz: A.yz, yz }
    }
    #[inline(always)]
    fn similarity(self, A: Mat3<T>) -> Mat3<T> {
        let Mat3 { x, y, z } = A;
        if FORWARDS {
            Mat3 { x: Vec3::new(z.z, z.x, z.y), y: Vec3::new(x.z, x.x, x.y), z: Vec3::new(y.z, y.x, y.y) }
        } else {
            Mat3 { x: Vec3::new(z.z, -z.x, z.y), y: Vec3::new(-x.z, x.x, -x.y), z: Vec3::new(y.z, -y.x, y.y) }
        }
    }
}

impl<T: Scalar, const STEEP: bool> Rotation<T> for AboutX<T, STEEP> {
    const ZERO: Zero = if STEEP { Zero::Y } else { Zero::Z };
    #[inline(always)]
    fn times(self, v: Vec3<T>) -> Vec3<T> {
        let Self(s, c) = self;
        Vec3::new(v.x, c.mul_add(v.y, s * v.z), c.mul_add(v.z, -(s * v.y)))
    }
    #[inline(always)]
    fn transpose_times(self, v: Vec3<T>) -> Vec3<T> {
        let Self(s, c) = self;
        Vec3::new(v.x, c.mul_add(v.y, -(s * v.z)), s.mul_add(v.y, c * v.z))
    }
    #[inline(always)]
    fn congruence(self, A: Sym3<T>) -> Sym3<T> {
        let Self(s, c) = self;
        let [[yy, yz], [_, zz]] = turned([[A.yy, A.yz], [A.yz, A.zz]], (s, c));
        let (xy, xz) = (c.mul_add(A.xy, -(s * A.xz)), s.mul_add(A.xy, c * A.xz));
        Sym3 { xx: A.xx, yy, zz, xy, xz, yz }
    }
    #[inline(always)]
    fn similarity(self, A: Mat3<T>) -> Mat3<T> {
        let Self(s, c) = self;
        let Mat3 { x, y, z } = A;
        let [[yy, yz], [zy, zz]] = turned([[y.y, y.z], [z.y, z.z]], (s, c));
        Mat3 {
            x: self.transpose_times(x),
            y: Vec3::new(c.mul_add(y.x, -(s * z.x)), yy, yz),
            z: Vec3::new(s.mul_add(y.x, c * z.x), zy, zz),
        }
    }
}

impl<T: Scalar> Rotation<T> for Mat3<T> {
    #[inline(always)]
    fn times(self, v: Vec3<T>) -> Vec3<T> {
        self * v
    }
    #[inline(always)]
    fn transpose_times(self, v: Vec3<T>) -> Vec3<T> {
        Mat3::transpose_times(self, v)
    }
    #[inline(always)]
    fn congruence(self, A: Sym3<T>) -> Sym3<T> {
        A.congruence(self)
    }
    #[inline(always)]
    fn similarity(self, A: Mat3<T>) -> Mat3<T> {
        self.transpose() * A * self
    }
}

impl<T: Scalar, C: Rotation<T>> Rotation<T> for Anywhere<C> {
    #[inline(always)]
    fn times(self, v: Vec3<T>) -> Vec3<T> {
        self.0.times(v)
    }
    #[inline(always)]
    fn transpose_times(self, v: Vec3<T>) -> Vec3<T> {
        self.0.transpose_times(v)
    }
    #[inline(always)]
    fn congruence(self, A: Sym3<T>) -> Sym3<T> {
        self.0.congruence(A)
    }
    #[inline(always)]
    fn similarity(self, A: Mat3<T>) -> Mat3<T> {
        self.0.similarity(A)
    }
}

impl<T: Scalar, C: Rotation<T>> Rotation<T> for ThenZ<T, C> {
    const ZERO: Zero = C::ZERO;
    #[inline(always)]
    fn times(self, v: Vec3<T>) -> Vec3<T> {
        let ((s, c), v) = (self.turn, self.first.times(v));
        Vec3::new(c.mul_add(v.x, s * v.y), c.mul_add(v.y, -(s * v.x)), v.z)
    }
    #[inline(always)]
    fn transpose_times(self, v: Vec3<T>) -> Vec3<T> {
        self.first.transpose_times(v.turned_about_z(self.turn))
    }
    #[inline(always)]
    fn congruence(self, A: Sym3<T>) -> Sym3<T> {
        self.first.congruence(A.turned_about_z(self.turn))
    }
    #[inline(always)]
    fn similarity(self, A: Mat3<T>) -> Mat3<T> {
        self.first.similarity(A.turned_about_z(self.turn))
    }
}

/// ₙX_o of a rotation of any kind: X = [E 0; −E r× E].
#[derive(Clone, Copy)]
pub(crate) struct Placed<T, R> {
    pub E: R,
    /// Where the new origin stands in the old frame.
    pub r: Vec3<T>,
}

impl<T: Scalar, R: Rotation<T>> Placed<T, R> {
    #[inline(always)]
    pub fn offset(self) -> Offset<T> {
        Offset::new(self.r, R::ZERO)
    }

    /// X m.
    #[inline(always)]
    pub fn motion(self, m: Motion<T>) -> Motion<T> {
        Motion { ang: self.E.times(m.ang), lin: self.E.times(self.offset().cross_add(-m.ang, m.lin)) }
    }

    /// Xᵀ f.
    #[inline(always)]
    pub fn transpose_force(self, f: Force<T>) -> Force<T> {
        let lin = self.E.transpose_times(f.lin);
        Force { ang: self.offset().cross_add(lin, self.E.transpose_times(f.ang)), lin }
    }

    /// A rigid body's inertia back in old coordinates.
    #[inline(always)]
    pub fn transpose_pseudo(self, I: PseudoInertia<T>) -> PseudoInertia<T> {
        let turned = PseudoInertia { m: I.m, h: self.E.transpose_times(I.h), P: self.E.congruence(I.P) };
        turned.shifted(self.offset())
    }

    /// Xᵀ IA X.
    #[inline(always)]
    pub fn transpose_articulated(self, A: ArticulatedInertia<T>) -> ArticulatedInertia<T> {
        let E = self.E;
        ArticulatedInertia { I: E.congruence(A.I), H: E.similarity(A.H), M: E.congruence(A.M) }
            .offset(self.offset())
    }

    /// Xᵀ IA X and Xᵀ f.
    #[inline(always)]
    pub fn transpose_both(self, A: ArticulatedInertia<T>, f: Force<T>) -> (ArticulatedInertia<T>, Force<T>) {
        (self.transpose_articulated(A), self.transpose_force(f))
    }
}

impl<S: Scalar> Placed<S, Mat3<S>> {
    /// The same in every column.
    #[inline(always)]
    pub fn spread(self) -> Placed<S::Columns, Mat3<S::Columns>> {
        Placed { E: self.E.map(S::spread), r: self.r.map(S::spread) }
    }
}

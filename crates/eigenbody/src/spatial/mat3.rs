//! 3 × 3 matrices.

use super::{Sym3, Vec3};
use crate::scalar::{Real, Scalar};
use std::ops::{Add, Mul, Sub};

/// A 3 × 3 matrix, by rows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mat3<T> {
    /// First row.
    pub x: Vec3<T>,
    /// Second row.
    pub y: Vec3<T>,
    /// Third row.
    pub z: Vec3<T>,
}

impl<T: Scalar> Mat3<T> {
    /// All zeros.
    pub const ZERO: Self = Self { x: Vec3::ZERO, y: Vec3::ZERO, z: Vec3::ZERO };
    /// The identity.
    pub const IDENTITY: Self = Self { x: Vec3::X, y: Vec3::Y, z: Vec3::Z };

    /// The matrix with these rows.
    #[inline(always)]
    pub fn from_rows(x: Vec3<T>, y: Vec3<T>, z: Vec3<T>) -> Self {
        Self { x, y, z }
    }

    /// The matrix of b ↦ a × b.
    #[inline(always)]
    pub fn cross(a: Vec3<T>) -> Self {
        Self {
            x: Vec3::new(T::ZERO, -a.z, a.y),
            y: Vec3::new(a.z, T::ZERO, -a.x),
            z: Vec3::new(-a.y, a.x, T::ZERO),
        }
    }

    /// The transpose.
    #[inline(always)]
    pub fn transpose(self) -> Self {
        Self {
            x: Vec3::new(self.x.x, self.y.x, self.z.x),
            y: Vec3::new(self.x.y, self.y.y, self.z.y),
            z: Vec3::new(self.x.z, self.y.z, self.z.z),
        }
    }

    /// Aᵀ b.
    #[inline(always)]
    pub fn transpose_times(self, b: Vec3<T>) -> Vec3<T> {
        self.x.mul_add(b.x, self.y.mul_add(b.y, self.z * b.z))
    }

    /// A b + c.
    #[inline(always)]
    pub fn times_add(self, b: Vec3<T>, c: Vec3<T>) -> Vec3<T> {
        Vec3 { x: self.x.dot_add(b, c.x), y: self.y.dot_add(b, c.y), z: self.z.dot_add(b, c.z) }
    }

    /// The columns of B crossed with a.
    #[inline(always)]
    pub fn cross_times(a: Vec3<T>, B: Self) -> Self {
        Self {
            x: B.z.mul_add(a.y, -(B.y * a.z)),
            y: B.x.mul_add(a.z, -(B.z * a.x)),
            z: B.y.mul_add(a.x, -(B.x * a.y)),
        }
    }

    /// The symmetric part's entries, where the matrix is known to be symmetric: the mean of both triangles.
    #[inline(always)]
    pub fn symmetric(self) -> Sym3<T> {
        let half = T::from_f64(0.5);
        Sym3 {
            xx: self.x.x,
            yy: self.y.y,
            zz: self.z.z,
            xy: (self.x.y + self.y.x) * half,
            xz: (self.x.z + self.z.x) * half,
            yz: (self.y.z + self.z.y) * half,
        }
    }

    /// Eᵀ A E with E a turn about z by the angle with this sine and cosine.
    #[inline(always)]
    pub fn turned_about_z(self, turn: (T, T)) -> Self {
        let (Self { x, y, z }, (s, c)) = (self, turn);
        let [[xx, xy], [yx, yy]] = turned([[x.x, x.y], [y.x, y.y]], turn);
        Self {
            x: Vec3::new(xx, xy, c.mul_add(x.z, -(s * y.z))),
            y: Vec3::new(yx, yy, s.mul_add(x.z, c * y.z)),
            z: z.turned_about_z(turn),
        }
    }

    /// Sine and cosine, if this is the coordinate rotation of a turn about z.
    pub fn about_z(self) -> Option<(T, T)>
    where
        T: Real,
    {
        let turn = (self.x.y, self.x.x);
        (self == Self::rotation_z(turn)).then_some(turn)
    }

    /// The entries in another scalar.
    #[inline(always)]
    pub fn map<U>(self, f: impl Fn(T) -> U + Copy) -> Mat3<U> {
        Mat3 { x: self.x.map(f), y: self.y.map(f), z: self.z.map(f) }
    }

    /// Coordinate rotation E of a turn by θ about z, from sin θ and cos θ.
    #[inline(always)]
    pub fn rotation_z((s, c): (T, T)) -> Self {
        Self { x: Vec3::new(c, s, T::ZERO), y: Vec3::new(-s, c, T::ZERO), z: Vec3::Z }
    }

    /// Coordinate rotation E of a turn by θ about the unit vector `axis`, from sin θ and cos θ (Rodrigues).
    #[inline(always)]
    pub fn rotation_about(axis: Vec3<T>, (s, c): (T, T)) -> Self {
        let K = Self::cross(axis);
        Self::IDENTITY - K * s + K * K * (T::ONE - c)
    }

    /// Coordinate rotation E from the frame before to the frame after the turn of the quaternion w, x, y, z.
    ///
    /// The scale 2/|p|² makes it an exact rotation whatever the norm.
    #[inline(always)]
    pub fn rotation_quaternion(w: T, v: Vec3<T>) -> Self {
        let s = T::from_f64(2.0) / w.mul_add(w, v.dot(v));
        let K = Self::cross(v);
        Self::IDENTITY - K * (s * w) + K * K * s
    }

    /// True if E Eᵀ is 1 to within `tolerance` in every entry, and E no reflection; false for a matrix with a NaN.
    pub fn is_rotation(self, tolerance: f64) -> bool
    where
        T: Real,
    {
        let excess = self * self.transpose() - Self::IDENTITY;
        let small = |row: Vec3<T>| row.to_array().into_iter().all(|x| x.to_f64().abs() <= tolerance);
        [excess.x, excess.y, excess.z].into_iter().all(small) && self.x.dot(self.y.cross(self.z)) > T::ZERO
    }

    /// The unit quaternion w, x, y, z whose [`rotation_quaternion`](Self::rotation_quaternion) this is, w ≥ 0.
    ///
    /// Method: the largest of the four components by a square root, the others by division (Shepperd 1978). Numerics: a few ε.
    pub fn quaternion(self) -> [T; 4]
    where
        T: Real,
    {
        let Self { x, y, z } = self;
        // 4w², 4x², 4y², 4z², and the products 4wx, .. that stand in E = 1 − 2w[v]× + 2[v]×².
        let squares = [
            T::ONE + x.x + y.y + z.z,
            T::ONE + x.x - y.y - z.z,
            T::ONE - x.x + y.y - z.z,
            T::ONE - x.x - y.y + z.z,
        ];
        let (wx, wy, wz) = (y.z - z.y, z.x - x.z, x.y - y.x);
        let (xy, xz, yz) = (x.y + y.x, x.z + z.x, y.z + z.y);
        let rows = [
            [squares[0], wx, wy, wz],
            [wx, squares[1], xy, xz],
            [wy, xy, squares[2], yz],
            [wz, xz, yz, squares[3]],
        ];
        let largest = (1..4).fold(0, |k, i| if squares[i] > squares[k] { i } else { k });
        let twice = squares[largest].sqrt();
        let sign = if rows[largest][0] < T::ZERO { -T::ONE } else { T::ONE };
        let scale = sign * T::from_f64(0.5) / twice;
        rows[largest].map(|row| row * scale)
    }

    /// Coordinate rotation E, old frame to new, of roll-pitch-yaw angles: R = Rz(yaw) Ry(pitch) Rx(roll), E = Rᵀ.
    pub fn rotation_rpy(roll: T, pitch: T, yaw: T) -> Self {
        let ((sr, cr), (sp, cp), (sy, cy)) = (roll.sin_cos(), pitch.sin_cos(), yaw.sin_cos());
        Self {
            x: Vec3::new(cy * cp, sy * cp, -sp),
            y: Vec3::new(cy * sp * sr - sy * cr, sy * sp * sr + cy * cr, cp * sr),
            z: Vec3::new(cy * sp * cr + sy * sr, sy * sp * cr - cy * sr, cp * cr),
        }
    }
}

impl<T: Scalar> Mul<Vec3<T>> for Mat3<T> {
    type Output = Vec3<T>;
    #[inline(always)]
    fn mul(self, b: Vec3<T>) -> Vec3<T> {
        Vec3 { x: self.x.dot(b), y: self.y.dot(b), z: self.z.dot(b) }
    }
}

impl<T: Scalar> Mul for Mat3<T> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, B: Self) -> Self {
        Self { x: B.transpose_times(self.x), y: B.transpose_times(self.y), z: B.transpose_times(self.z) }
    }
}

impl<T: Scalar> Mul<T> for Mat3<T> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, s: T) -> Self {
        Self { x: self.x * s, y: self.y * s, z: self.z * s }
    }
}

impl<T: Scalar> Add for Mat3<T> {
    type Output = Self;
    #[inline(always)]
    fn add(self, B: Self) -> Self {
        Self { x: self.x + B.x, y: self.y + B.y, z: self.z + B.z }
    }
}

impl<T: Scalar> Sub for Mat3<T> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, B: Self) -> Self {
        Self { x: self.x - B.x, y: self.y - B.y, z: self.z - B.z }
    }
}

/// Eᵀ A E of two rows and columns, E = [c s; −s c]: what turns with the double angle is found once.
///
/// ```text
/// w = s (a₂₂ − a₁₁) − c (a₁₂ + a₂₁)      a'₁₁ = a₁₁ + s w    a'₂₂ = a₂₂ − s w    a'₁₂ = −c w − a₂₁    a'₂₁ = −c w − a₁₂
/// ```
#[inline(always)]
pub(super) fn turned<T: Scalar>([[a11, a12], [a21, a22]]: [[T; 2]; 2], (s, c): (T, T)) -> [[T; 2]; 2] {
    let w = s.mul_add(a22 - a11, -(c * (a12 + a21)));
    [[s.mul_add(w, a11), (-c).mul_add(w, -a21)], [(-c).mul_add(w, -a12), (-s).mul_add(w, a22)]]
}

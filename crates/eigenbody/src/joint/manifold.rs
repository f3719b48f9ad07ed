//! Exponentials of rotations and twists, for moving a configuration along a velocity.

use crate::scalar::Real;
use crate::spatial::Vec3;

/// Σ (−x²)ᵏ/(2k+n)!: the entire functions behind sin x/x (n = 1), (1 − cos x)/x² (n = 2) and (x − sin x)/x³ (n = 3).
///
/// The series is used below |x| = 1/2, where the closed forms cancel; 14 terms reach 32 digits there.
fn entire<T: Real>(x: T, n: u32) -> T {
    let xx = x * x;
    if x.abs() < T::from_f64(0.5) {
        let mut sum = T::ZERO;
        for k in (0..14u32).rev() {
            // Horner from the far end: each term is the next one's factor −x²/((m+1)(m+2)), m = 2k + n.
            let m = f64::from(2 * k + n);
            sum = T::ONE - sum * xx / T::from_f64((m + 1.0) * (m + 2.0));
        }
        let factorial = T::from_f64(f64::from((1..=n).product::<u32>()));
        return sum / factorial;
    }
    let (s, c) = x.sin_cos();
    match n {
        1 => s / x,
        2 => (T::ONE - c) / xx,
        _ => (x - s) / (xx * x),
    }
}

/// sin x / x.
pub(super) fn sinc<T: Real>(x: T) -> T {
    entire(x, 1)
}

/// exp(w/2) as a quaternion w, x, y, z: the turn by |w| about w.
pub(super) fn quaternion_exp<T: Real>(w: Vec3<T>) -> [T; 4] {
    let half = T::from_f64(0.5);
    let angle = w.norm() * half;
    let v = w * (half * sinc(angle));
    [angle.sin_cos().1, v.x, v.y, v.z]
}

/// a ⊗ b.
pub(super) fn quaternion_product<T: Real>(a: [T; 4], b: [T; 4]) -> [T; 4] {
    let (av, bv) = (Vec3::new(a[1], a[2], a[3]), Vec3::new(b[1], b[2], b[3]));
    let v = bv * a[0] + av * b[0] + av.cross(bv);
    [a[0] * b[0] - av.dot(bv), v.x, v.y, v.z]
}

/// Where the origin goes, in the frame before, when the body moves with the constant body twist (w, u) for unit time:
/// u + (1−cos θ)/θ² w×u + (θ−sin θ)/θ³ w×(w×u), θ = |w|.
pub(super) fn twist_translation<T: Real>(w: Vec3<T>, u: Vec3<T>) -> Vec3<T> {
    let theta = w.norm();
    let wu = w.cross(u);
    u + wu * entire(theta, 2) + w.cross(wu) * entire(theta, 3)
}

/// conj(a) ⊗ b as the turn w with a ⊗ exp(w/2) = ±b, |w| ≤ π.
pub(crate) fn quaternion_log<T: Real>(a: [T; 4], b: [T; 4]) -> Vec3<T> {
    let [w, x, y, z] = quaternion_product([a[0], -a[1], -a[2], -a[3]], b);
    let v = Vec3::new(x, y, z);
    let (w, v) = if w < T::ZERO { (-w, -v) } else { (w, v) };
    let s = v.norm();
    // Sine and cosine of half the turn: 2φ along v/s.
    let two = T::from_f64(2.0);
    v * (two * arc_over_sine(s, w))
}

/// φ/s for φ = atan2(s, c) in [0, π/2], whatever the length of (s, c).
fn arc_over_sine<T: Real>(s: T, c: T) -> T {
    let norm = (s * s + c * c).sqrt();
    let (s, c) = (s / norm, c / norm);
    if s < T::from_f64(1e-3) {
        // 1 + s²/6 + 3 s⁴/40 + 15 s⁶/336 + ..
        let ss = s * s;
        let mut sum = T::ONE;
        for (odd, even) in [(81.0, 110.0), (49.0, 72.0), (25.0, 42.0), (9.0, 20.0), (1.0, 6.0)] {
            sum = T::ONE + ss * sum * T::from_f64(odd) / T::from_f64(even);
        }
        return sum / norm;
    }
    // Newton's method on the angle; an f64 start makes one step enough for any scalar here, two are taken.
    let mut angle = T::from_f64(s.to_f64().atan2(c.to_f64()));
    for _ in 0..2 {
        let (sin, cos) = angle.sin_cos();
        angle += s * cos - c * sin;
    }
    angle / s / norm
}

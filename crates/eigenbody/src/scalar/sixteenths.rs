//! Sine and cosine from the nearest sixteenth of a turn, where a register looks sixteen numbers up in one instruction.
//!
//! ```text
//! n = round(x · 8/π)      r + y = x − n π/8,  |r| ≤ π/16      S, C = sin, cos of n π/8 by n mod 16, from a table
//! sin x = S + (C r + (C s + S c)),   cos x = C + (−S r + (−S s + C c))      s = sin(r + y) − r,  c = cos r − 1
//! ```
//! Table and short polynomials as Tang (1991) has them: neither signs nor quarters are left to choose, and what is small is summed first.
//! The first product with π/8 is taken away without rounding, and so is the second, in f64, up to the limit. Polynomials by Remez'
//! exchange: s to 5e-18 of r and c to 6e-21 (f64), to 4e-10 and 3e-9 (f32).

use super::Scalar;

/// sin(n π/8), n = 0, .., 15.
pub(super) const SINES: [f64; 16] = {
    const A: f64 = 0.3826834323650898;
    const B: f64 = std::f64::consts::FRAC_1_SQRT_2;
    const C: f64 = 0.9238795325112867;
    [0.0, A, B, C, 1.0, C, B, A, 0.0, -A, -B, -C, -1.0, -C, -B, -A]
};

/// cos(n π/8), n = 0, .., 15.
pub(super) const COSINES: [f64; 16] = {
    let mut cosines = SINES;
    let mut n = 0;
    while n < 16 {
        cosines[n] = SINES[(n + 4) % 16];
        n += 1;
    }
    cosines
};

/// What one precision needs.
#[derive(Debug, Clone, Copy)]
pub struct Sixteenths<T: 'static> {
    /// 8/π.
    pub(super) per_radian: T,
    /// −π/8 as a sum; what it still lacks, and what the sum rounds, where that counts.
    pub(super) minus_one: [T; 2],
    pub(super) tail: Option<T>,
    /// sin r = r + r³ p(r²), highest first.
    pub(super) sin: &'static [T],
    /// cos r = 1 + r² p(r²), highest first.
    pub(super) cos: &'static [T],
}

/// sin x and cos x, x near n sixteenths of a turn, which have sine S and cosine C.
#[inline(always)]
pub(super) fn sin_cos<T: Scalar>(x: T, n: T, (S, C): (T, T), of: &Sixteenths<T::Constant>) -> (T, T) {
    let [p0, p1] = of.minus_one.map(T::constant);
    let first = n.mul_add(p0, x);
    let r = n.mul_add(p1, first);
    let z = r * r;
    let cube = z * r;
    let s = match of.tail {
        Some(p2) => {
            let y = n.mul_add(T::constant(p2), n.mul_add(p1, first - r));
            cube.mul_add(horner(z, of.sin), y)
        }
        None => cube * horner(z, of.sin),
    };
    let c = z * horner(z, of.cos);
    (S + C.mul_add(r, C.mul_add(s, S * c)), C + (-S).mul_add(r, (-S).mul_add(s, C * c)))
}

/// By Horner's rule, the highest power first.
#[inline(always)]
fn horner<T: Scalar>(z: T, coefficients: &[T::Constant]) -> T {
    let mut p = T::constant(coefficients[0]);
    for &c in &coefficients[1..] {
        p = p.mul_add(z, T::constant(c));
    }
    p
}

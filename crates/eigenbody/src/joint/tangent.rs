//! The derivative of the exponential: how a velocity and the coordinates θ of q = q₀ ⊕ θ change with each other.
//!
//! ```text
//! dexp_u = Σ ad_uᵏ/(k+1)!            dexp_u⁻¹ = 1 − ½ ad_u + Σ B_2k/(2k)! ad_u²ᵏ            ad_u m = u × m
//! q = q₀ ⊕ θ moves with the body velocity v  ⇔  θ̇ = dexp₋θ⁻¹ v
//! ```
//! Hairer, Lubich & Wanner, *Geometric Numerical Integration* (2006), §III.4. On rigid motions ad satisfies ad (ad² + θ²)² = 0 with θ the
//! angle of u, so that beyond half a radian the even part is α ad² + β ad⁴, which matches φ(x) = (x/2) coth(x/2) − 1 and its slope
//! at x = iθ. Below, the series: ten terms reach 1e-24.

use crate::scalar::{Real, Scalar};
use crate::spatial::{Force, Motion};
use std::ops::{Add, Mul};

/// Numerators and denominators of B_2k/(2k)!, k = 1, 2, ..
const BERNOULLI: [(f64, f64); 10] = [
    (1.0, 12.0),
    (-1.0, 720.0),
    (1.0, 30_240.0),
    (-1.0, 1_209_600.0),
    (1.0, 47_900_160.0),
    (-691.0, 1_307_674_368_000.0),
    (1.0, 74_724_249_600.0),
    (-3617.0, 10_670_622_842_880_000.0),
    (43_867.0, 5_109_094_217_170_944_000.0),
    (-174_611.0, 802_857_662_698_291_200_000.0),
];

/// Terms of dexp that are summed: those of a turn by π reach 1e-17.
const TERMS: u32 = 30;

/// dexp_u⁻¹ v.
pub(super) fn dexp_inverse<T: Real>(u: Motion<T>, v: Motion<T>) -> Motion<T> {
    inverse(u, v, Motion::cross)
}

/// The transpose of dexp_u, on forces.
pub(super) fn dexp_dual<T: Real>(u: Motion<T>, f: Force<T>) -> Force<T> {
    let (mut term, mut sum) = (f, f);
    for k in 1..TERMS {
        term = coadjoint(u, term) * (T::ONE / T::from_f64(f64::from(k + 1)));
        sum += term;
    }
    sum
}

/// The transpose of dexp_u⁻¹, on forces.
pub(super) fn dexp_inverse_dual<T: Real>(u: Motion<T>, f: Force<T>) -> Force<T> {
    inverse(u, f, coadjoint)
}

/// ad_uᵀ f = −u ×* f.
fn coadjoint<T: Scalar>(u: Motion<T>, f: Force<T>) -> Force<T> {
    -u.cross_force(f)
}

/// dexp_u⁻¹ with ad_u as it acts on what `x` is.
fn inverse<T: Real, V>(u: Motion<T>, x: V, ad: impl Fn(Motion<T>, V) -> V) -> V
where
    V: Copy + Add<Output = V> + Mul<T, Output = V>,
{
    let first = ad(u, x);
    let second = ad(u, first);
    let odd = x + first * T::from_f64(-0.5);
    let theta = u.ang.norm();
    if theta > T::from_f64(0.5) {
        let (alpha, beta) = even_part(theta);
        let fourth = ad(u, ad(u, second));
        return odd + second * alpha + fourth * beta;
    }
    let mut power = second;
    let mut sum = odd;
    for (numerator, denominator) in BERNOULLI {
        sum = sum + power * (T::from_f64(numerator) / T::from_f64(denominator));
        power = ad(u, ad(u, power));
    }
    sum
}

/// α and β of α y + β y² = φ, with its slope, at y = −θ².
fn even_part<T: Real>(theta: T) -> (T, T) {
    let half = T::from_f64(0.5);
    let (s, c) = (theta * half).sin_cos();
    let y = -(theta * theta);
    let phi = theta * half * c / s - T::ONE;
    // dφ/dθ = ½ cot(θ/2) − θ/4 sin⁻²(θ/2), dy = −2θ dθ
    let slope = (half * c / s - theta * half * half / (s * s)) / -(theta + theta);
    let beta = (slope - phi / y) / y;
    (phi / y - beta * y, beta)
}

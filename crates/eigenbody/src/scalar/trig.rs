//! Sine and cosine of many angles, without a branch for any of them.
//!
//! ```text
//! n = round(x · 2/π)      r + y = x − n π/2        π/2 in three parts, of which n times the first two is exact; fused, in f32: two
//! s = sin(r + y), c = cos(r + y)                    polynomials on |r| ≤ π/4
//! turned by n mod 4:  n even: (s, c), odd: (c, −s);  n mod 4 in {2, 3}: both negated
//! ```
//! Reduction after Cody and Waite (1980); polynomials of FreeBSD's msun (f64) and Cephes (f32). Where a register holds many numbers,
//! [`sixteenths`] is shorter. Either way within 1 ulp in f64 up to 800,000 rad; in f32 within 1.5 ulp up to 3000 rad, or 1e-11 where sine
//! or cosine is smaller than 1e-4. Where one of those side by side is larger, they go to [`Scalar::sin_cos`].

use super::sixteenths::{self, Sixteenths};
use super::{MOST_COLUMNS, Real, Scalar};

/// What one precision needs.
#[derive(Debug, Clone, Copy)]
pub struct Trig<T: 'static> {
    /// Largest |x| of the reduction.
    limit: T,
    /// Added and taken away, it rounds to an integer: 1.5 times two to the number of explicit bits.
    integer: T,
    two_over_pi: T,
    /// −π/2 as a sum.
    minus_half_pi: [T; 3],
    /// The same in two parts for those who round once: what the first one leaves is a number without rounding, so that the rounding of the
    /// second is all there is. None where two parts are not enough digits.
    minus_half_pi_fused: Option<[T; 2]>,
    /// Whether the last of its three parts, as often as it is taken at most, is so small that only its first order counts.
    tail_is_rounding: bool,
    /// sin x = x + x³(s₀ + s₁x² + ..), highest first.
    sin: &'static [T],
    /// cos x = 1 − x²/2 + x⁴(c₀ + c₁x² + ..), highest first.
    cos: &'static [T],
    /// For those who look up where a sixteenth of a turn ends.
    sixteenths: Sixteenths<T>,
}

/// Digits as published.
#[allow(clippy::excessive_precision)]
pub(super) const DOUBLE: Trig<f64> = Trig {
    limit: 800_000.0,
    integer: 6_755_399_441_055_744.0,
    two_over_pi: std::f64::consts::FRAC_2_PI,
    minus_half_pi: [-1.57079632673412561417e+00, -6.07710050630396597660e-11, -2.02226624879595063154e-21],
    minus_half_pi_fused: None,
    tail_is_rounding: true,
    sin: &[
        1.58969099521155010221e-10,
        -2.50507602534068634195e-08,
        2.75573137070700676789e-06,
        -1.98412698298579493134e-04,
        8.33333333332248946124e-03,
        -1.66666666666666324348e-01,
    ],
    cos: &[
        -1.13596475577881948265e-11,
        2.08757232129817482790e-09,
        -2.75573143513906633035e-07,
        2.48015872894767294178e-05,
        -1.38888888888741095749e-03,
        4.16666666666666019037e-02,
    ],
    sixteenths: Sixteenths {
        per_radian: 2.546_479_089_470_325_5,
        minus_one: [-std::f64::consts::FRAC_PI_8, -1.530_808_498_523_035e-17],
        tail: Some(-4.111_564_234_081_064_4e-27),
        sin: &[
            2.753_378_851_563_021_593_4e-6,
            -1.984_126_222_031_482_787_7e-4,
            8.333_333_332_360_528_250_6e-3,
            -1.666_666_666_666_628_067_2e-1,
        ],
        cos: &[
            -2.753_550_362_404_399_397_8e-7,
            2.480_157_916_465_252_866_7e-5,
            -1.388_888_888_762_425_409_3e-3,
            4.166_666_666_666_599_149_3e-2,
            -0.5,
        ],
    },
};

/// Digits as published.
#[allow(clippy::excessive_precision)]
pub(super) const SINGLE: Trig<f32> = Trig {
    limit: 3000.0,
    integer: 12_582_912.0,
    two_over_pi: std::f32::consts::FRAC_2_PI,
    minus_half_pi: [-1.570556640625, -0.000_239_670_276_641_845_7, -1.589_325_5e-8],
    minus_half_pi_fused: Some([-std::f32::consts::FRAC_PI_2, 4.371_139e-8]),
    tail_is_rounding: false,
    sin: &[-1.951_529_589_1e-4, 8.332_160_873_6e-3, -1.666_665_461_1e-1],
    cos: &[2.443_315_711_809_948e-5, -1.388_731_625_493_765e-3, 4.166_664_568_298_827e-2],
    sixteenths: Sixteenths {
        per_radian: 2.546_479_1,
        minus_one: [-std::f32::consts::FRAC_PI_8, 1.092_784_7e-8],
        tail: None,
        sin: &[8.322_689_572_191_612e-3, -1.666_665_397_330_896e-1],
        cos: &[4.159_217_354_332_391e-2, -4.999_991_116_818_389e-1],
    },
};

/// Sines and cosines of angles side by side.
#[inline(always)]
pub(crate) fn sin_cos_columns<S: Scalar>(x: S::Columns) -> (S::Columns, S::Columns) {
    match S::Constant::TRIG {
        Some(trig) if !x.abs().any_above(trig.limit) => sin_cos(x, &trig),
        _ => plain::<S>(x),
    }
}

#[cold]
#[inline(never)]
fn plain<S: Scalar>(x: S::Columns) -> (S::Columns, S::Columns) {
    let (mut sin, mut cos) = ([S::Stored::ZERO; MOST_COLUMNS], [S::Stored::ZERO; MOST_COLUMNS]);
    S::store_columns(x, &mut sin);
    for (sin, cos) in sin.iter_mut().zip(&mut cos) {
        (*sin, *cos) = sin.sin_cos();
    }
    (S::load_columns(&sin), S::load_columns(&cos))
}

#[inline(always)]
fn sin_cos<S: Scalar>(x: S, trig: &Trig<S::Constant>) -> (S, S) {
    let integer = S::constant(trig.integer);
    let shifted = x.mul_add(S::constant(trig.sixteenths.per_radian), integer);
    if let Some(turned) = S::sixteenths(shifted) {
        return sixteenths::sin_cos(x, shifted - integer, turned, &trig.sixteenths);
    }
    let shifted = x.mul_add(S::constant(trig.two_over_pi), integer);
    let n = shifted - integer;
    let (r, y) = match trig.minus_half_pi_fused {
        Some([p0, p1]) if S::FUSED => (n.mul_add(S::constant(p1), n.mul_add(S::constant(p0), x)), None),
        _ => {
            let [p0, p1, p2] = trig.minus_half_pi;
            let first = n.mul_add(S::constant(p0), x);
            let t = n.mul_add(S::constant(p1), first);
            // What rounding took from the sum, and the last digits of π/2.
            let tail = n.mul_add(S::constant(p2), n.mul_add(S::constant(p1), first - t));
            match trig.tail_is_rounding {
                true => (t, Some(tail)),
                false => (t + tail, Some((t - (t + tail)) + tail)),
            }
        }
    };

    let half = S::from_f64(0.5);
    let z = r * r;
    let zz = z * z;
    let (p, q) = (polynomial(z, zz, trig.sin), polynomial(z, zz, trig.cos));
    // sin(r + y) = sin r + y cos r,  cos(r + y) = cos r − y r
    let cube = z * r;
    let h = half * z;
    let w = S::ONE - h;
    let lost = (S::ONE - w) - h;
    let (s, c) = match y {
        Some(y) => (r + cube.mul_add(p, y * w), w + (lost + zz.mul_add(q, -(r * y)))),
        None => (cube.mul_add(p, r), w + zz.mul_add(q, lost)),
    };
    n.quarters(shifted, s, c)
}

/// By Horner's rule in z², the highest power first: pairs of terms do not wait for each other.
#[inline(always)]
fn polynomial<S: Scalar>(z: S, zz: S, coefficients: &[S::Constant]) -> S {
    let (first, pairs) = coefficients.split_at(coefficients.len() % 2);
    let mut p = first.first().map(|&c| S::constant(c));
    for pair in pairs.chunks_exact(2) {
        let two = S::constant(pair[0]).mul_add(z, S::constant(pair[1]));
        p = Some(match p {
            Some(p) => p.mul_add(zz, two),
            None => two,
        });
    }
    p.unwrap_or(S::ZERO)
}

/// [`Scalar::quarters`] without a look at bits: j = n mod 4 in {−2, .., 2}.
#[inline(always)]
pub(super) fn quarters<S: Scalar>(n: S, s: S, c: S) -> (S, S) {
    let integer = S::from_f64(1.5 / S::Constant::EPSILON);
    let (half, half_turn) = (S::from_f64(0.5), S::from_f64(1.5));
    let j = (n.mul_add(S::from_f64(0.25), integer) - integer).mul_add(S::from_f64(-4.0), n);
    let odd = (j.abs() - S::ONE).abs();
    let (sine, cosine) = (odd.select_lt(half, c, s), odd.select_lt(half, s, c));
    // sin is negative for j = −1 and ±2, cos for j = 1 and ±2.
    let sine = (j + half).select_lt(S::ZERO, -sine, sine);
    let sine = half_turn.select_lt(j, -sine, sine);
    let cosine = half.select_lt(j, -cosine, cosine);
    let cosine = (j + half_turn).select_lt(S::ZERO, -cosine, cosine);
    (sine, cosine)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scalar::{Algorithm, Array, Batched, Dd, Unit, Wide, WideAlgorithm, dispatch_one};

    /// Angles up to the limit: evenly, near multiples of π/2, in between, and small.
    fn angles<T: Real>(limit: f64) -> Vec<T> {
        let angle = |k: i32| match k % 4 {
            0 => limit * (f64::from(k) / 100_000.0 - 1.0),
            1 => f64::from(k) * std::f64::consts::FRAC_PI_2 % limit,
            2 => f64::from(k - 100_000) * 1e-4,
            _ => (-f64::from(k) / 4000.0).exp(),
        };
        (0..200_000).map(|k| T::from_f64(angle(k))).collect()
    }

    /// The largest error in units of the last place of the result, or of `least`, against double-double.
    fn worst<T: Real>(least: f64, angles: &[T], found: &[[T; 2]]) -> f64 {
        let mut worst: f64 = 0.0;
        for (x, found) in angles.iter().zip(found) {
            let (sin, cos) = Dd::from_f64(x.to_f64()).sin_cos();
            for (found, exact) in found.iter().zip([sin, cos]) {
                let ulp = exact.hi().abs().max(least) * T::EPSILON;
                worst = worst.max((Dd::from_f64(found.to_f64()) - exact).hi().abs() / ulp);
            }
        }
        assert!(angles.len() == found.len() && worst > 0.1, "{worst}");
        worst
    }

    /// The same angle in every column.
    #[inline(always)]
    fn in_columns<S: Scalar<Constant = T>, T: Real>(
        angles: &[T],
        from: fn(T) -> S::Stored,
        to: fn(S::Stored) -> T,
    ) -> Vec<[T; 2]> {
        let both = angles.iter().map(|&x| {
            let x = from(x);
            let (mut s, mut c) = ([x; MOST_COLUMNS], [x; MOST_COLUMNS]);
            let both = sin_cos_columns::<S>(S::load_columns(&[x; MOST_COLUMNS]));
            S::store_columns(both.0, &mut s);
            S::store_columns(both.1, &mut c);
            [to(s[0]), to(c[0])]
        });
        both.collect()
    }

    /// On fused numbers where this processor has them.
    struct Columns<'a, T>(&'a [T]);

    impl<T: Real> Algorithm<T> for Columns<'_, T> {
        type Output = Vec<[T; 2]>;
        #[inline(always)]
        fn run<S: Scalar<Constant = T, Stored = T>>(self) -> Self::Output {
            in_columns::<S, T>(self.0, |x| x, |x| x)
        }
    }

    #[test]
    fn sines_are_good_to_the_last_place() {
        let doubles = angles(800_000.0);
        for found in [
            in_columns::<f64, f64>(&doubles, |x| x, |x| x),
            dispatch_one(Columns(&doubles)),
            in_columns::<Array<2>, f64>(&doubles, |x| Array([x; 2]), |x| x.0[1]),
            f64::dispatch_wide(Unit::Avx2, Sines(&doubles)),
            f64::dispatch_wide(Unit::Avx512, Sines(&doubles)),
        ] {
            let worst = worst(1e-300, &doubles, &found);
            assert!(worst < 1.0, "f64: {worst}");
        }
        let singles = angles(3000.0);
        for found in [
            in_columns::<f32, f32>(&singles, |x| x, |x| x),
            dispatch_one(Columns(&singles)),
            f32::dispatch_wide(Unit::Avx2, Sines(&singles)),
            f32::dispatch_wide(Unit::Avx512, Sines(&singles)),
        ] {
            let worst = worst(1e-4, &singles, &found);
            assert!(worst < 1.5, "f32: {worst}");
        }
    }

    /// Every angle in one lane after the other.
    struct Sines<'a, T>(&'a [T]);

    impl<T: Batched> WideAlgorithm<T> for Sines<'_, T> {
        type Output = Vec<[T; 2]>;
        #[inline(always)]
        fn run<W: Wide<Constant = T>>(self) -> Self::Output {
            let mut out = Vec::new();
            for angles in self.0.chunks_exact(crate::scalar::MOST_LANES) {
                for angles in angles.chunks_exact(W::WIDTH) {
                    let (mut s, mut c) = ([W::ZERO], [W::ZERO]);
                    let both = sin_cos_columns::<W>(W::load_columns(&[W::from_slice(angles)]));
                    W::store_columns(both.0, &mut s);
                    W::store_columns(both.1, &mut c);
                    let mut numbers = [[T::ZERO; crate::scalar::MOST_LANES]; 2];
                    s[0].to_slice(&mut numbers[0]);
                    c[0].to_slice(&mut numbers[1]);
                    out.extend((0..W::WIDTH).map(|lane| [numbers[0][lane], numbers[1][lane]]));
                }
            }
            out
        }
    }

    /// All units agree: quarter turns are counted by bits in registers, and by bits of another kind elsewhere.
    fn units_agree<T: Batched>() {
        let angles: Vec<T> = (-800..800).map(|k| T::from_f64(f64::from(k) * 0.37)).collect();
        let of = |unit| T::dispatch_wide(unit, Sines(&angles));
        for unit in [Unit::Avx2, Unit::Avx512] {
            for ((found, plain), angle) in of(unit).iter().zip(&of(Unit::Plain)).zip(&angles) {
                for k in 0..2 {
                    let apart = (found[k] - plain[k]).to_f64().abs();
                    assert!(apart <= 2.0 * T::EPSILON, "{unit:?}, {angle:?}: {found:?} {plain:?}");
                }
            }
        }
    }

    #[test]
    fn sines_agree_on_all_units() {
        units_agree::<f32>();
        units_agree::<f64>();
    }

    /// By arithmetic as by bits.
    #[test]
    fn quarter_turns_are_counted_alike() {
        for n in -9_i32..=9 {
            let (n, shifted) = (f64::from(n), f64::from(n) + DOUBLE.integer);
            assert_eq!(quarters(n, 0.6, 0.8), Scalar::quarters(n, shifted, 0.6, 0.8));
        }
    }
}

//! The wide units: the one module with `unsafe`.
//!
//! Two promises keep it sound, and both are kept here:
//!
//! 1. A value of a wide type exists only inside [`dispatch`]'s entry functions, which run only after the processor was asked
//!    for their features. The types are private to this module; callers see [`Lane`].
//! 2. Every intrinsic used works on registers: none touches memory, except loads and stores of whole arrays by value.
//!
//! Dispatch happens once, around a whole algorithm: the algorithm is generic over [`Lane`] and inlined whole into the entry
//! function, so that everything in it is compiled for the wide units.

use super::lanes::{Array, LANES, Lane};

/// An algorithm over lanes. `run` must be `#[inline(always)]`, and so must all that it calls per element.
pub trait LaneAlgorithm {
    /// What it computes.
    type Output;
    /// Runs on any lane type.
    fn run<L: Lane>(self) -> Self::Output;
}

/// Runs an algorithm on the widest unit that this processor has. The choice never changes while the program runs.
#[inline]
pub fn dispatch<A: LaneAlgorithm>(algorithm: A) -> A::Output {
    #[cfg(target_arch = "x86_64")]
    {
        if is_x86_feature_detected!("avx512f") && is_x86_feature_detected!("avx512dq") {
            // SAFETY: the processor has the features that the entry function is compiled for.
            return unsafe { x86::run_avx512(algorithm) };
        }
        if is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma") {
            // SAFETY: as above.
            return unsafe { x86::run_avx2(algorithm) };
        }
    }
    algorithm.run::<Array<LANES>>()
}

#[cfg(target_arch = "x86_64")]
mod x86 {
    use super::super::Scalar;
    use super::super::lanes::{LANES, Lane, lane_operators};
    use super::LaneAlgorithm;
    use std::arch::x86_64::*;
    use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

    #[target_feature(enable = "avx512f,avx512dq,avx2,fma")]
    pub(super) fn run_avx512<A: LaneAlgorithm>(algorithm: A) -> A::Output {
        algorithm.run::<Avx512>()
    }

    #[target_feature(enable = "avx2,fma")]
    pub(super) fn run_avx2<A: LaneAlgorithm>(algorithm: A) -> A::Output {
        algorithm.run::<Avx2>()
    }

    /// Eight f64 in one register.
    #[derive(Debug, Clone, Copy)]
    struct Avx512(__m512d);

    /// Eight f64 in two registers.
    #[derive(Debug, Clone, Copy)]
    struct Avx2(__m256d, __m256d);

    // SAFETY of every block below: promise 1 of the module; the type exists only where its features do.

    impl Avx512 {
        #[inline(always)]
        fn plus(self, b: Self) -> Self {
            Self(unsafe { _mm512_add_pd(self.0, b.0) })
        }
        #[inline(always)]
        fn minus(self, b: Self) -> Self {
            Self(unsafe { _mm512_sub_pd(self.0, b.0) })
        }
        #[inline(always)]
        fn times(self, b: Self) -> Self {
            Self(unsafe { _mm512_mul_pd(self.0, b.0) })
        }
        #[inline(always)]
        fn over(self, b: Self) -> Self {
            Self(unsafe { _mm512_div_pd(self.0, b.0) })
        }
        #[inline(always)]
        fn negated(self) -> Self {
            // −0 − x is −x for every x, and is recognised as a negation: it then costs nothing before a product.
            Self(unsafe { _mm512_sub_pd(_mm512_set1_pd(-0.0), self.0) })
        }
    }

    lane_operators!(Avx512);

    impl Scalar for Avx512 {
        type Constant = f64;
        #[inline(always)]
        fn constant(c: f64) -> Self {
            Self::from_f64(c)
        }
        const ZERO: Self = Self(unsafe { std::mem::transmute::<[f64; LANES], __m512d>([0.0; LANES]) });
        const ONE: Self = Self(unsafe { std::mem::transmute::<[f64; LANES], __m512d>([1.0; LANES]) });
        #[inline(always)]
        fn from_f64(x: f64) -> Self {
            Self(unsafe { _mm512_set1_pd(x) })
        }
        #[inline(always)]
        fn mul_add(self, a: Self, b: Self) -> Self {
            Self(unsafe { _mm512_fmadd_pd(self.0, a.0, b.0) })
        }
        #[inline(always)]
        fn sqrt(self) -> Self {
            Self(unsafe { _mm512_sqrt_pd(self.0) })
        }
        fn sin_cos(self) -> (Self, Self) {
            let x = self.to_array();
            (Self::from_array(x.map(f64::sin)), Self::from_array(x.map(f64::cos)))
        }
        #[inline(always)]
        fn abs(self) -> Self {
            Self(unsafe { _mm512_andnot_pd(_mm512_set1_pd(-0.0), self.0) })
        }
        #[inline(always)]
        fn min(self, other: Self) -> Self {
            Self(unsafe { _mm512_min_pd(self.0, other.0) })
        }
        #[inline(always)]
        fn max(self, other: Self) -> Self {
            Self(unsafe { _mm512_max_pd(self.0, other.0) })
        }
        #[inline(always)]
        fn select_lt(self, other: Self, yes: Self, no: Self) -> Self {
            Self(unsafe {
                let mask = _mm512_cmp_pd_mask::<_CMP_LT_OQ>(self.0, other.0);
                _mm512_mask_blend_pd(mask, no.0, yes.0)
            })
        }
    }

    impl Lane for Avx512 {
        #[inline(always)]
        fn from_array(x: [f64; LANES]) -> Self {
            Self(unsafe { std::mem::transmute::<[f64; LANES], __m512d>(x) })
        }
        #[inline(always)]
        fn to_array(self) -> [f64; LANES] {
            unsafe { std::mem::transmute::<__m512d, [f64; LANES]>(self.0) }
        }
        #[inline(always)]
        fn split_exponent(self) -> (Self, Self) {
            unsafe {
                let bits = _mm512_castpd_si512(self.0);
                let mantissa = _mm512_and_si512(bits, _mm512_set1_epi64(0x000f_ffff_ffff_ffff));
                let mantissa = _mm512_or_si512(mantissa, _mm512_set1_epi64(0x3ff0_0000_0000_0000));
                let biased = _mm512_and_si512(_mm512_srli_epi64::<52>(bits), _mm512_set1_epi64(0x7ff));
                let exponent = _mm512_sub_epi64(biased, _mm512_set1_epi64(1023));
                (Self(_mm512_castsi512_pd(mantissa)), Self(_mm512_cvtepi64_pd(exponent)))
            }
        }
    }

    impl Avx2 {
        #[inline(always)]
        fn plus(self, b: Self) -> Self {
            unsafe { Self(_mm256_add_pd(self.0, b.0), _mm256_add_pd(self.1, b.1)) }
        }
        #[inline(always)]
        fn minus(self, b: Self) -> Self {
            unsafe { Self(_mm256_sub_pd(self.0, b.0), _mm256_sub_pd(self.1, b.1)) }
        }
        #[inline(always)]
        fn times(self, b: Self) -> Self {
            unsafe { Self(_mm256_mul_pd(self.0, b.0), _mm256_mul_pd(self.1, b.1)) }
        }
        #[inline(always)]
        fn over(self, b: Self) -> Self {
            unsafe { Self(_mm256_div_pd(self.0, b.0), _mm256_div_pd(self.1, b.1)) }
        }
        #[inline(always)]
        fn negated(self) -> Self {
            unsafe {
                let zero = _mm256_set1_pd(-0.0);
                Self(_mm256_sub_pd(zero, self.0), _mm256_sub_pd(zero, self.1))
            }
        }
    }

    lane_operators!(Avx2);

    impl Scalar for Avx2 {
        type Constant = f64;
        #[inline(always)]
        fn constant(c: f64) -> Self {
            Self::from_f64(c)
        }
        const ZERO: Self = Self::constant(0.0);
        const ONE: Self = Self::constant(1.0);
        #[inline(always)]
        fn from_f64(x: f64) -> Self {
            unsafe { Self(_mm256_set1_pd(x), _mm256_set1_pd(x)) }
        }
        #[inline(always)]
        fn mul_add(self, a: Self, b: Self) -> Self {
            unsafe { Self(_mm256_fmadd_pd(self.0, a.0, b.0), _mm256_fmadd_pd(self.1, a.1, b.1)) }
        }
        #[inline(always)]
        fn sqrt(self) -> Self {
            unsafe { Self(_mm256_sqrt_pd(self.0), _mm256_sqrt_pd(self.1)) }
        }
        fn sin_cos(self) -> (Self, Self) {
            let x = self.to_array();
            (Self::from_array(x.map(f64::sin)), Self::from_array(x.map(f64::cos)))
        }
        #[inline(always)]
        fn abs(self) -> Self {
            unsafe {
                let sign = _mm256_set1_pd(-0.0);
                Self(_mm256_andnot_pd(sign, self.0), _mm256_andnot_pd(sign, self.1))
            }
        }
        #[inline(always)]
        fn min(self, other: Self) -> Self {
            unsafe { Self(_mm256_min_pd(self.0, other.0), _mm256_min_pd(self.1, other.1)) }
        }
        #[inline(always)]
        fn max(self, other: Self) -> Self {
            unsafe { Self(_mm256_max_pd(self.0, other.0), _mm256_max_pd(self.1, other.1)) }
        }
        #[inline(always)]
        fn select_lt(self, other: Self, yes: Self, no: Self) -> Self {
            unsafe {
                let lower = _mm256_cmp_pd::<_CMP_LT_OQ>(self.0, other.0);
                let upper = _mm256_cmp_pd::<_CMP_LT_OQ>(self.1, other.1);
                Self(_mm256_blendv_pd(no.0, yes.0, lower), _mm256_blendv_pd(no.1, yes.1, upper))
            }
        }
    }

    impl Avx2 {
        const fn constant(x: f64) -> Self {
            let half = unsafe { std::mem::transmute::<[f64; 4], __m256d>([x; 4]) };
            Self(half, half)
        }

        #[inline(always)]
        fn split_half(x: __m256d) -> (__m256d, __m256d) {
            unsafe {
                let bits = _mm256_castpd_si256(x);
                let mantissa = _mm256_and_si256(bits, _mm256_set1_epi64x(0x000f_ffff_ffff_ffff));
                let mantissa = _mm256_or_si256(mantissa, _mm256_set1_epi64x(0x3ff0_0000_0000_0000));
                let biased = _mm256_and_si256(_mm256_srli_epi64::<52>(bits), _mm256_set1_epi64x(0x7ff));
                // An integer below 2^52 placed in the mantissa of 2^52 is 2^52 + itself.
                let shifted = _mm256_or_si256(biased, _mm256_set1_epi64x(0x4330_0000_0000_0000));
                let exponent = _mm256_sub_pd(
                    _mm256_castsi256_pd(shifted),
                    _mm256_set1_pd(4_503_599_627_370_496.0 + 1023.0),
                );
                (_mm256_castsi256_pd(mantissa), exponent)
            }
        }
    }

    impl Lane for Avx2 {
        #[inline(always)]
        fn from_array(x: [f64; LANES]) -> Self {
            let [lower, upper] = unsafe { std::mem::transmute::<[f64; LANES], [__m256d; 2]>(x) };
            Self(lower, upper)
        }
        #[inline(always)]
        fn to_array(self) -> [f64; LANES] {
            unsafe { std::mem::transmute::<[__m256d; 2], [f64; LANES]>([self.0, self.1]) }
        }
        #[inline(always)]
        fn split_exponent(self) -> (Self, Self) {
            let ((m0, e0), (m1, e1)) = (Self::split_half(self.0), Self::split_half(self.1));
            (Self(m0, m1), Self(e0, e1))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::lanes::{Array, LANES, Lane};
    use super::{LaneAlgorithm, dispatch};

    /// Every operation of the lane type, on awkward numbers.
    struct Everything;

    impl LaneAlgorithm for Everything {
        type Output = Vec<[f64; LANES]>;
        #[inline(always)]
        fn run<L: Lane>(self) -> Self::Output {
            let a = L::from_array([1.0, -2.5, 3e300, -4e-300, 0.0, 6.25, -7e-310, 1e308]);
            let b = L::from_array([3.0, 2.5, -1e-5, 4e300, -0.0, 6.25, 2.0, -0.5]);
            let (m, e) = a.split_exponent();
            [
                a + b,
                a - b,
                a * b,
                a / (b + L::ONE),
                -a,
                a.abs(),
                a.abs().sqrt(),
                a.min(b),
                a.max(b),
                a.select_lt(b, L::ONE, L::ZERO),
                m,
                e,
                L::from_f64(0.1),
            ]
            .map(L::to_array)
            .to_vec()
        }
    }

    /// The wide unit agrees with plain arrays to the bit in every operation but the fused one.
    #[test]
    fn wide_lanes_agree_with_arrays() {
        let (wide, plain) = (dispatch(Everything), Everything.run::<Array<LANES>>());
        for (operation, (wide, plain)) in wide.iter().zip(&plain).enumerate() {
            for lane in 0..LANES {
                let same = wide[lane].to_bits() == plain[lane].to_bits()
                    || (wide[lane].is_nan() && plain[lane].is_nan());
                assert!(same, "operation {operation}, lane {lane}: {} {}", wide[lane], plain[lane]);
            }
        }
    }
}

//! Eight shifts side by side, and the exponents of their pivots.

// SAFETY of every block below: promise 1 of the module; the types exist only where their features do.

use super::super::super::lanes::{LANES, Lane, Two, Wide};
use super::{F64x4, F64x8};
use std::arch::x86_64::*;

impl Lane for F64x8 {
    #[inline(always)]
    fn from_array(x: [f64; LANES]) -> Self {
        Self::from_slice(&x)
    }
    #[inline(always)]
    fn to_array(self) -> [f64; LANES] {
        self.numbers()
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

impl F64x4 {
    #[inline(always)]
    fn split_exponent(self) -> (Self, Self) {
        unsafe {
            let bits = _mm256_castpd_si256(self.0);
            let mantissa = _mm256_and_si256(bits, _mm256_set1_epi64x(0x000f_ffff_ffff_ffff));
            let mantissa = _mm256_or_si256(mantissa, _mm256_set1_epi64x(0x3ff0_0000_0000_0000));
            let biased = _mm256_and_si256(_mm256_srli_epi64::<52>(bits), _mm256_set1_epi64x(0x7ff));
            // An integer below 2^52 placed in the mantissa of 2^52 is 2^52 + itself.
            let shifted = _mm256_or_si256(biased, _mm256_set1_epi64x(0x4330_0000_0000_0000));
            let exponent =
                _mm256_sub_pd(_mm256_castsi256_pd(shifted), _mm256_set1_pd(4_503_599_627_370_496.0 + 1023.0));
            (Self(_mm256_castsi256_pd(mantissa)), Self(exponent))
        }
    }
}

/// Eight f64 in two registers.
pub(super) type Pair = Two<F64x4>;

impl Lane for Pair {
    #[inline(always)]
    fn from_array(x: [f64; LANES]) -> Self {
        Two(F64x4::from_slice(&x), F64x4::from_slice(&x[4..]))
    }
    #[inline(always)]
    fn to_array(self) -> [f64; LANES] {
        let mut x = [0.0; LANES];
        self.0.to_slice(&mut x);
        self.1.to_slice(&mut x[4..]);
        x
    }
    #[inline(always)]
    fn split_exponent(self) -> (Self, Self) {
        let ((m0, e0), (m1, e1)) = (self.0.split_exponent(), self.1.split_exponent());
        (Two(m0, m1), Two(e0, e1))
    }
}

//! Quarters and sixteenths of a turn, by the last bits of how many there are.

// SAFETY of every block below: promise 1 of the module; the types exist only where their features do.

use super::super::super::lanes::Wide;
use super::super::super::sixteenths::{COSINES, SINES};
use super::{F32x4, F32x8, F32x16, F64x2, F64x4, F64x8};
use std::arch::x86_64::*;

const SINGLE_SINES: [f32; 16] = single(SINES);
const SINGLE_COSINES: [f32; 16] = single(COSINES);

const fn single(x: [f64; 16]) -> [f32; 16] {
    let (mut out, mut k) = ([0.0; 16], 0);
    while k < 16 {
        out[k] = x[k] as f32;
        k += 1;
    }
    out
}

impl F64x8 {
    /// Sine and cosine of as many sixteenths of a turn as the last four bits say.
    #[inline(always)]
    pub(super) fn look_up(self) -> (Self, Self) {
        (self.of_sixteen(&SINES), self.of_sixteen(&COSINES))
    }

    #[inline(always)]
    fn of_sixteen(self, table: &[f64; 16]) -> Self {
        let (low, high) = (Self::from_slice(table), Self::from_slice(&table[8..]));
        Self(unsafe { _mm512_permutex2var_pd(low.0, _mm512_castpd_si512(self.0), high.0) })
    }
}

impl F32x16 {
    /// Sine and cosine of as many sixteenths of a turn as the last four bits say.
    #[inline(always)]
    pub(super) fn look_up(self) -> (Self, Self) {
        (self.of_sixteen(&SINGLE_SINES), self.of_sixteen(&SINGLE_COSINES))
    }

    #[inline(always)]
    fn of_sixteen(self, table: &[f32; 16]) -> Self {
        Self(unsafe { _mm512_permutexvar_ps(_mm512_castps_si512(self.0), Self::from_slice(table).0) })
    }
}

/// Quarter turns by the last two bits of n: the last one exchanges sine and cosine, and the one before it is the sign of a sine.
macro_rules! quarters {
    (
        $Type:ident, |$n:ident, $yes:ident, $no:ident| $choose_odd:expr, $bits:ident, $number:ident, $shift:ident, $last:literal,
        $xor:ident, $and:ident, $plus:ident, $ones:ident
    ) => {
        impl $Type {
            #[inline(always)]
            pub(in super::super) fn quarters_by_bits(shifted: Self, s: Self, c: Self) -> (Self, Self) {
                unsafe {
                    let $n = $bits(shifted.0);
                    let sine = {
                        let ($yes, $no) = (c.0, s.0);
                        $choose_odd
                    };
                    let cosine = {
                        let ($yes, $no) = (s.0, c.0);
                        $choose_odd
                    };
                    let sign = $bits(Self::all(-0.0).0);
                    let turns = $and($shift::<{ $last - 1 }>($n), sign);
                    let turns_on = $and($shift::<{ $last - 1 }>($plus($n, $ones(1))), sign);
                    (Self($number($xor($bits(sine), turns))), Self($number($xor($bits(cosine), turns_on))))
                }
            }
        }
    };
}

quarters!(
    F64x8,
    |n, yes, no| _mm512_mask_blend_pd(_mm512_test_epi64_mask(n, _mm512_set1_epi64(1)), no, yes),
    _mm512_castpd_si512,
    _mm512_castsi512_pd,
    _mm512_slli_epi64,
    63,
    _mm512_xor_si512,
    _mm512_and_si512,
    _mm512_add_epi64,
    _mm512_set1_epi64
);
quarters!(
    F64x4,
    |n, yes, no| _mm256_blendv_pd(no, yes, _mm256_castsi256_pd(_mm256_slli_epi64::<63>(n))),
    _mm256_castpd_si256,
    _mm256_castsi256_pd,
    _mm256_slli_epi64,
    63,
    _mm256_xor_si256,
    _mm256_and_si256,
    _mm256_add_epi64,
    _mm256_set1_epi64x
);
quarters!(
    F64x2,
    |n, yes, no| _mm_blendv_pd(no, yes, _mm_castsi128_pd(_mm_slli_epi64::<63>(n))),
    _mm_castpd_si128,
    _mm_castsi128_pd,
    _mm_slli_epi64,
    63,
    _mm_xor_si128,
    _mm_and_si128,
    _mm_add_epi64,
    _mm_set1_epi64x
);
quarters!(
    F32x16,
    |n, yes, no| _mm512_mask_blend_ps(_mm512_test_epi32_mask(n, _mm512_set1_epi32(1)), no, yes),
    _mm512_castps_si512,
    _mm512_castsi512_ps,
    _mm512_slli_epi32,
    31,
    _mm512_xor_si512,
    _mm512_and_si512,
    _mm512_add_epi32,
    _mm512_set1_epi32
);
quarters!(
    F32x8,
    |n, yes, no| _mm256_blendv_ps(no, yes, _mm256_castsi256_ps(_mm256_slli_epi32::<31>(n))),
    _mm256_castps_si256,
    _mm256_castsi256_ps,
    _mm256_slli_epi32,
    31,
    _mm256_xor_si256,
    _mm256_and_si256,
    _mm256_add_epi32,
    _mm256_set1_epi32
);
quarters!(
    F32x4,
    |n, yes, no| _mm_blendv_ps(no, yes, _mm_castsi128_ps(_mm_slli_epi32::<31>(n))),
    _mm_castps_si128,
    _mm_castsi128_ps,
    _mm_slli_epi32,
    31,
    _mm_xor_si128,
    _mm_and_si128,
    _mm_add_epi32,
    _mm_set1_epi32
);

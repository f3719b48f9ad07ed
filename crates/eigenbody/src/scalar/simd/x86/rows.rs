//! Four numbers of every row at a time, one row a lane.

// SAFETY of every block below: promise 1 of the module; the types exist only where their features do.

use super::super::super::lanes::MOST_LANES;
use super::{F32x4, F32x8, F32x16, F64x4, F64x8};
use std::arch::x86_64::*;
use std::mem::transmute;

/// Some numbers out of a slice, by value.
macro_rules! numbers_at {
    ($name:ident, $T:ident, $N:literal, $Register:ident) => {
        #[inline(always)]
        fn $name(from: &[$T], at: usize) -> $Register {
            let mut numbers = [0.0; $N];
            numbers.copy_from_slice(&from[at..at + $N]);
            unsafe { transmute::<[$T; $N], $Register>(numbers) }
        }
    };
}

numbers_at!(two_f64, f64, 2, __m128d);
numbers_at!(four_f64, f64, 4, __m256d);
numbers_at!(four_f32, f32, 4, __m128);

// Four columns of as many rows as there are lanes. Parts of rows go where the last exchanges, which stay within 128 bits where they can,
// leave them in order.

impl F64x8 {
    #[inline(always)]
    pub(super) fn four(rows: &[&[f64]; MOST_LANES], first: usize) -> [Self; 4] {
        macro_rules! parts {
            ($a:literal, $b:literal) => {
                _mm512_insertf64x4::<1>(
                    _mm512_castpd256_pd512(four_f64(rows[$a], first)),
                    four_f64(rows[$b], first),
                )
            };
        }
        unsafe {
            let (a, b, c, d) = (parts!(0, 2), parts!(1, 3), parts!(4, 6), parts!(5, 7));
            let (ab, cd) = (_mm512_unpacklo_pd(a, b), _mm512_unpacklo_pd(c, d));
            let (ba, dc) = (_mm512_unpackhi_pd(a, b), _mm512_unpackhi_pd(c, d));
            [
                Self(_mm512_shuffle_f64x2::<0x88>(ab, cd)),
                Self(_mm512_shuffle_f64x2::<0x88>(ba, dc)),
                Self(_mm512_shuffle_f64x2::<0xdd>(ab, cd)),
                Self(_mm512_shuffle_f64x2::<0xdd>(ba, dc)),
            ]
        }
    }
}

impl F64x4 {
    #[inline(always)]
    pub(super) fn four(rows: &[&[f64]; MOST_LANES], first: usize) -> [Self; 4] {
        macro_rules! parts {
            ($a:literal, $b:literal, $k:literal) => {
                _mm256_insertf128_pd::<1>(
                    _mm256_castpd128_pd256(two_f64(rows[$a], first + $k)),
                    two_f64(rows[$b], first + $k),
                )
            };
        }
        unsafe {
            let (a, b, c, d) = (parts!(0, 2, 0), parts!(1, 3, 0), parts!(0, 2, 2), parts!(1, 3, 2));
            [
                Self(_mm256_unpacklo_pd(a, b)),
                Self(_mm256_unpackhi_pd(a, b)),
                Self(_mm256_unpacklo_pd(c, d)),
                Self(_mm256_unpackhi_pd(c, d)),
            ]
        }
    }
}

/// Four rows of four in every 128 bits, turned.
macro_rules! turn_fours {
    (
        [$a:expr, $b:expr, $c:expr, $d:expr], $low:ident, $high:ident, $low_pair:ident, $high_pair:ident,
        $pairs:ident, $numbers:ident
    ) => {{
        let (a, b, c, d) = ($a, $b, $c, $d);
        let (ab, cd) = ($pairs($low(a, b)), $pairs($low(c, d)));
        let (ba, dc) = ($pairs($high(a, b)), $pairs($high(c, d)));
        [
            Self($numbers($low_pair(ab, cd))),
            Self($numbers($high_pair(ab, cd))),
            Self($numbers($low_pair(ba, dc))),
            Self($numbers($high_pair(ba, dc))),
        ]
    }};
}

impl F32x16 {
    #[inline(always)]
    pub(super) fn four(rows: &[&[f32]; MOST_LANES], first: usize) -> [Self; 4] {
        macro_rules! parts {
            ($l:literal) => {{
                let x = _mm512_castps128_ps512(four_f32(rows[$l], first));
                let x = _mm512_insertf32x4::<1>(x, four_f32(rows[$l + 4], first));
                let x = _mm512_insertf32x4::<2>(x, four_f32(rows[$l + 8], first));
                _mm512_insertf32x4::<3>(x, four_f32(rows[$l + 12], first))
            }};
        }
        unsafe {
            turn_fours!(
                [parts!(0), parts!(1), parts!(2), parts!(3)],
                _mm512_unpacklo_ps,
                _mm512_unpackhi_ps,
                _mm512_unpacklo_pd,
                _mm512_unpackhi_pd,
                _mm512_castps_pd,
                _mm512_castpd_ps
            )
        }
    }
}

impl F32x8 {
    #[inline(always)]
    pub(super) fn four(rows: &[&[f32]; MOST_LANES], first: usize) -> [Self; 4] {
        macro_rules! parts {
            ($l:literal) => {
                _mm256_insertf128_ps::<1>(
                    _mm256_castps128_ps256(four_f32(rows[$l], first)),
                    four_f32(rows[$l + 4], first),
                )
            };
        }
        unsafe {
            turn_fours!(
                [parts!(0), parts!(1), parts!(2), parts!(3)],
                _mm256_unpacklo_ps,
                _mm256_unpackhi_ps,
                _mm256_unpacklo_pd,
                _mm256_unpackhi_pd,
                _mm256_castps_pd,
                _mm256_castpd_ps
            )
        }
    }
}

impl F32x4 {
    #[inline(always)]
    pub(super) fn four(rows: &[&[f32]; MOST_LANES], first: usize) -> [Self; 4] {
        unsafe {
            turn_fours!(
                [
                    four_f32(rows[0], first),
                    four_f32(rows[1], first),
                    four_f32(rows[2], first),
                    four_f32(rows[3], first)
                ],
                _mm_unpacklo_ps,
                _mm_unpackhi_ps,
                _mm_unpacklo_pd,
                _mm_unpackhi_pd,
                _mm_castps_pd,
                _mm_castpd_ps
            )
        }
    }
}

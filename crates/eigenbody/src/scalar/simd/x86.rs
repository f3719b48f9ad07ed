//! Registers of AVX2 and AVX-512, and the entry functions that are compiled for them.

use super::super::lanes::{LANES, Lane, MOST_LANES, Two, Wide, lane_operators};
use super::super::sixteenths::{COSINES, SINES};
use super::super::{Quad, Real, Scalar, only_itself};
use super::{Algorithm, LaneAlgorithm, WideAlgorithm};
use std::arch::x86_64::*;
use std::mem::transmute;
use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

#[target_feature(enable = "avx512f,avx512dq,avx512vl,avx2,fma")]
pub(super) fn lanes_avx512<A: LaneAlgorithm>(algorithm: A) -> A::Output {
    algorithm.run::<F64x8>()
}

#[target_feature(enable = "avx2,fma")]
pub(super) fn lanes_avx2<A: LaneAlgorithm>(algorithm: A) -> A::Output {
    algorithm.run::<Pair>()
}

#[target_feature(enable = "avx512f,avx512dq,avx512vl,avx2,fma")]
pub(super) fn wide_avx512<W: Wide<Constant = T>, T: Real, A: WideAlgorithm<T>>(algorithm: A) -> A::Output {
    algorithm.run::<W>()
}

#[target_feature(enable = "avx2,fma")]
pub(super) fn wide_avx2<W: Wide<Constant = T>, T: Real, A: WideAlgorithm<T>>(algorithm: A) -> A::Output {
    algorithm.run::<W>()
}

/// Entry of an algorithm over single numbers.
macro_rules! one {
    ($name:ident, $features:literal) => {
        #[target_feature(enable = $features)]
        pub(super) fn $name<F, T, A>(algorithm: A) -> A::Output
        where
            F: Scalar<Constant = T, Stored = T, Columns: Quad<T>>,
            T: Real,
            A: Algorithm<T>,
        {
            algorithm.run_in_fours::<F>()
        }
    };
}

one!(one_avx2, "avx2,fma");
one!(one_avx512, "avx512f,avx512dq,avx512vl,avx2,fma");

// SAFETY of every block below: promise 1 of the module; the types exist only where their features do.

/// One register of `$N` numbers.
macro_rules! register {
    (
        $Type:ident, $T:ident, $N:literal, $Register:ident, $what:literal,
        $add:ident, $sub:ident, $mul:ident, $div:ident, $sqrt:ident, $fmadd:ident, $min:ident, $max:ident,
        $andnot:ident, $set1:ident,
        |$a:ident, $b:ident, $yes:ident, $no:ident| $select:expr,
        |$x:ident, $y:ident| $below:expr
        $(, |$shifted:ident| $sixteenths:expr)?
    ) => {
        #[doc = $what]
        #[derive(Debug, Clone, Copy)]
        #[repr(transparent)]
        pub(in super::super) struct $Type($Register);

        impl $Type {
            #[inline(always)]
            fn plus(self, b: Self) -> Self {
                Self(unsafe { $add(self.0, b.0) })
            }
            #[inline(always)]
            fn minus(self, b: Self) -> Self {
                Self(unsafe { $sub(self.0, b.0) })
            }
            #[inline(always)]
            fn times(self, b: Self) -> Self {
                Self(unsafe { $mul(self.0, b.0) })
            }
            #[inline(always)]
            fn over(self, b: Self) -> Self {
                Self(unsafe { $div(self.0, b.0) })
            }
            #[inline(always)]
            fn negated(self) -> Self {
                // −0 − x is −x for every x, and is recognised as a negation: it then costs nothing before a product.
                Self(unsafe { $sub($set1(-0.0), self.0) })
            }
            #[inline(always)]
            const fn all(x: $T) -> Self {
                Self(unsafe { transmute::<[$T; $N], $Register>([x; $N]) })
            }
            #[inline(always)]
            fn numbers(self) -> [$T; $N] {
                unsafe { transmute::<$Register, [$T; $N]>(self.0) }
            }
        }

        lane_operators!($Type);

        impl Scalar for $Type {
            type Constant = $T;
            #[inline(always)]
            fn constant(c: $T) -> Self {
                Self(unsafe { $set1(c) })
            }
            only_itself!();
            const ZERO: Self = Self::all(0.0);
            const ONE: Self = Self::all(1.0);
            const FUSED: bool = true;
            #[inline(always)]
            fn from_f64(x: f64) -> Self {
                Self::constant(x as $T)
            }
            #[inline(always)]
            fn mul_add(self, a: Self, b: Self) -> Self {
                Self(unsafe { $fmadd(self.0, a.0, b.0) })
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                Self(unsafe { $sqrt(self.0) })
            }
            fn sin_cos(self) -> (Self, Self) {
                let x = self.numbers();
                let (mut sin, mut cos) = (x, x);
                for k in 0..$N {
                    (sin[k], cos[k]) = x[k].sin_cos();
                }
                (Self::from_slice(&sin), Self::from_slice(&cos))
            }
            #[inline(always)]
            fn quarters(self, shifted: Self, s: Self, c: Self) -> (Self, Self) {
                Self::quarters_by_bits(shifted, s, c)
            }
            $(
                #[inline(always)]
                fn sixteenths($shifted: Self) -> Option<(Self, Self)> {
                    Some($sixteenths)
                }
            )?
            #[inline(always)]
            fn abs(self) -> Self {
                Self(unsafe { $andnot($set1(-0.0), self.0) })
            }
            #[inline(always)]
            fn min(self, other: Self) -> Self {
                Self(unsafe { $min(self.0, other.0) })
            }
            #[inline(always)]
            fn max(self, other: Self) -> Self {
                Self(unsafe { $max(self.0, other.0) })
            }
            #[inline(always)]
            fn select_lt(self, other: Self, yes: Self, no: Self) -> Self {
                let ($a, $b, $yes, $no) = (self.0, other.0, yes.0, no.0);
                Self(unsafe { $select })
            }
            #[inline(always)]
            fn any_above(self, bound: $T) -> bool {
                let ($x, $y) = (Self::constant(bound).0, self.0);
                unsafe { $below }
            }
        }

        impl Wide for $Type {
            const WIDTH: usize = $N;
            #[inline(always)]
            fn from_slice(x: &[$T]) -> Self {
                let mut numbers = [0.0; $N];
                numbers.copy_from_slice(&x[..$N]);
                Self(unsafe { transmute::<[$T; $N], $Register>(numbers) })
            }
            #[inline(always)]
            fn to_slice(self, out: &mut [$T]) {
                out[..$N].copy_from_slice(&self.numbers());
            }
            #[inline(always)]
            fn gather(rows: &[&[$T]; MOST_LANES], first: usize) -> [Self; 4] {
                Self::four(rows, first)
            }
            #[inline(always)]
            fn turn(x: &[&Self; MOST_LANES], first: usize) -> [Self; 4] {
                let mut rows: [&[$T]; MOST_LANES] = [&[]; MOST_LANES];
                for j in 0..$N {
                    // SAFETY: promise 2; a register of $N numbers is $N numbers in memory, without gaps.
                    rows[j] =
                        unsafe { std::slice::from_raw_parts(std::ptr::from_ref(x[j]).cast::<$T>(), $N) };
                }
                Self::four(&rows, first)
            }
            #[inline(always)]
            fn announce(out: &[$T], at: usize) {
                // SAFETY: promise 2; a hint about any address reads and writes nothing.
                unsafe { _mm_prefetch::<_MM_HINT_ET0>(out.as_ptr().wrapping_add(at).cast()) };
            }
        }
    };
}

register!(
    F64x8,
    f64,
    8,
    __m512d,
    "Eight f64.",
    _mm512_add_pd,
    _mm512_sub_pd,
    _mm512_mul_pd,
    _mm512_div_pd,
    _mm512_sqrt_pd,
    _mm512_fmadd_pd,
    _mm512_min_pd,
    _mm512_max_pd,
    _mm512_andnot_pd,
    _mm512_set1_pd,
    |a, b, yes, no| _mm512_mask_blend_pd(_mm512_cmp_pd_mask::<_CMP_LT_OQ>(a, b), no, yes),
    |x, y| _mm512_cmp_pd_mask::<_CMP_LT_OQ>(x, y) != 0,
    |n| (n.look_up(&SINES), n.look_up(&COSINES))
);
register!(
    F64x4,
    f64,
    4,
    __m256d,
    "Four f64.",
    _mm256_add_pd,
    _mm256_sub_pd,
    _mm256_mul_pd,
    _mm256_div_pd,
    _mm256_sqrt_pd,
    _mm256_fmadd_pd,
    _mm256_min_pd,
    _mm256_max_pd,
    _mm256_andnot_pd,
    _mm256_set1_pd,
    |a, b, yes, no| _mm256_blendv_pd(no, yes, _mm256_cmp_pd::<_CMP_LT_OQ>(a, b)),
    |x, y| _mm256_movemask_pd(_mm256_cmp_pd::<_CMP_LT_OQ>(x, y)) != 0
);
register!(
    F32x16,
    f32,
    16,
    __m512,
    "Sixteen f32.",
    _mm512_add_ps,
    _mm512_sub_ps,
    _mm512_mul_ps,
    _mm512_div_ps,
    _mm512_sqrt_ps,
    _mm512_fmadd_ps,
    _mm512_min_ps,
    _mm512_max_ps,
    _mm512_andnot_ps,
    _mm512_set1_ps,
    |a, b, yes, no| _mm512_mask_blend_ps(_mm512_cmp_ps_mask::<_CMP_LT_OQ>(a, b), no, yes),
    |x, y| _mm512_cmp_ps_mask::<_CMP_LT_OQ>(x, y) != 0,
    |n| (n.look_up(&SINGLE_SINES), n.look_up(&SINGLE_COSINES))
);
register!(
    F32x8,
    f32,
    8,
    __m256,
    "Eight f32.",
    _mm256_add_ps,
    _mm256_sub_ps,
    _mm256_mul_ps,
    _mm256_div_ps,
    _mm256_sqrt_ps,
    _mm256_fmadd_ps,
    _mm256_min_ps,
    _mm256_max_ps,
    _mm256_andnot_ps,
    _mm256_set1_ps,
    |a, b, yes, no| _mm256_blendv_ps(no, yes, _mm256_cmp_ps::<_CMP_LT_OQ>(a, b)),
    |x, y| _mm256_movemask_ps(_mm256_cmp_ps::<_CMP_LT_OQ>(x, y)) != 0
);

register!(
    F32x4,
    f32,
    4,
    __m128,
    "Four f32.",
    _mm_add_ps,
    _mm_sub_ps,
    _mm_mul_ps,
    _mm_div_ps,
    _mm_sqrt_ps,
    _mm_fmadd_ps,
    _mm_min_ps,
    _mm_max_ps,
    _mm_andnot_ps,
    _mm_set1_ps,
    |a, b, yes, no| _mm_blendv_ps(no, yes, _mm_cmplt_ps(a, b)),
    |x, y| _mm_movemask_ps(_mm_cmplt_ps(x, y)) != 0
);

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
    /// Of sixteen numbers those that the last four bits name.
    #[inline(always)]
    fn look_up(self, table: &[f64; 16]) -> Self {
        let (low, high) = (Self::from_slice(table), Self::from_slice(&table[8..]));
        Self(unsafe { _mm512_permutex2var_pd(low.0, _mm512_castpd_si512(self.0), high.0) })
    }
}

impl F32x16 {
    /// Of sixteen numbers those that the last four bits name.
    #[inline(always)]
    fn look_up(self, table: &[f32; 16]) -> Self {
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
            fn quarters_by_bits(shifted: Self, s: Self, c: Self) -> (Self, Self) {
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
    fn four(rows: &[&[f64]; MOST_LANES], first: usize) -> [Self; 4] {
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
    fn four(rows: &[&[f64]; MOST_LANES], first: usize) -> [Self; 4] {
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
    fn four(rows: &[&[f32]; MOST_LANES], first: usize) -> [Self; 4] {
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
    fn four(rows: &[&[f32]; MOST_LANES], first: usize) -> [Self; 4] {
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
    fn four(rows: &[&[f32]; MOST_LANES], first: usize) -> [Self; 4] {
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
impl Quad<f64> for F64x4 {}
impl Quad<f32> for F32x4 {}

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
type Pair = Two<F64x4>;

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

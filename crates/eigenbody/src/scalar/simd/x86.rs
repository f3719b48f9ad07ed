//! Registers of AVX2 and AVX-512, and the entry functions that are compiled for them.

mod angles;
mod rows;
mod shifts;

use super::super::lanes::{Array, MOST_LANES, Wide, lane_operators};
use super::super::{Quad, Real, Scalar, only_itself};
use super::{Algorithm, LaneAlgorithm, PairAlgorithm, WideAlgorithm};
use shifts::Pair;
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

#[target_feature(enable = "avx2,fma")]
pub(super) fn pair_avx2<A: PairAlgorithm>(algorithm: A) -> A::Output {
    algorithm.run::<F64x2>()
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

/// One register of `$N` numbers, and what it is in memory, if something else.
macro_rules! register {
    (
        $Type:ident $(as $Stored:ty)?, $T:ident, $N:literal, $Register:ident, $what:literal,
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
            fn of(x: [$T; $N]) -> Self {
                Self(unsafe { transmute::<[$T; $N], $Register>(x) })
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
            only_itself!($($Stored, x => Self::of(x.0), x => Array(x.numbers()))?);
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
                (Self::of(sin), Self::of(cos))
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
    };
}

/// A register that holds as many numbers as the unit has.
macro_rules! wide {
    ($Type:ident, $T:ident, $N:literal) => {
        impl Wide for $Type {
            const WIDTH: usize = $N;
            #[inline(always)]
            fn from_slice(x: &[$T]) -> Self {
                let mut numbers = [0.0; $N];
                numbers.copy_from_slice(&x[..$N]);
                Self::of(numbers)
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
    |n| n.look_up()
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
    |n| n.look_up()
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

register!(
    F64x2 as Array<2>,
    f64,
    2,
    __m128d,
    "Two f64.",
    _mm_add_pd,
    _mm_sub_pd,
    _mm_mul_pd,
    _mm_div_pd,
    _mm_sqrt_pd,
    _mm_fmadd_pd,
    _mm_min_pd,
    _mm_max_pd,
    _mm_andnot_pd,
    _mm_set1_pd,
    |a, b, yes, no| _mm_blendv_pd(no, yes, _mm_cmplt_pd(a, b)),
    |x, y| _mm_movemask_pd(_mm_cmplt_pd(x, y)) != 0
);

wide!(F64x8, f64, 8);
wide!(F64x4, f64, 4);
wide!(F32x16, f32, 16);
wide!(F32x8, f32, 8);
wide!(F32x4, f32, 4);

impl Quad<f64> for F64x4 {}
impl Quad<f32> for F32x4 {}

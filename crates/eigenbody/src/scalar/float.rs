//! f32 and f64 as scalars.

use super::{Algorithm, Dd, MOST_LANES, Real, Scalar, Trig, Wide, only_itself};

macro_rules! float {
    ($T:ident, $trig:expr) => {
        impl Scalar for $T {
            type Constant = Self;
            #[inline(always)]
            fn constant(c: Self) -> Self {
                c
            }
            only_itself!();
            const ZERO: Self = 0.0;
            const ONE: Self = 1.0;
            const FUSED: bool = cfg!(target_feature = "fma");
            #[inline(always)]
            fn from_f64(x: f64) -> Self {
                x as $T
            }
            /// Without the instruction a fused multiply-add is a library call: the plain form is used instead.
            #[inline(always)]
            fn mul_add(self, a: Self, b: Self) -> Self {
                if Self::FUSED { $T::mul_add(self, a, b) } else { self * a + b }
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                $T::sqrt(self)
            }
            #[inline(always)]
            fn sin_cos(self) -> (Self, Self) {
                $T::sin_cos(self)
            }
            #[inline(always)]
            fn quarters(self, shifted: Self, s: Self, c: Self) -> (Self, Self) {
                let (n, sign) = (shifted.to_bits(), $T::to_bits(-0.0));
                let (sine, cosine) = if n & 1 == 0 { (s, c) } else { (c, s) };
                let turned =
                    |x: $T, n| $T::from_bits(x.to_bits() ^ (n << (sign.trailing_zeros() - 1) & sign));
                (turned(sine, n), turned(cosine, n + 1))
            }
            #[inline(always)]
            fn abs(self) -> Self {
                $T::abs(self)
            }
            #[inline(always)]
            fn min(self, other: Self) -> Self {
                $T::min(self, other)
            }
            #[inline(always)]
            fn max(self, other: Self) -> Self {
                $T::max(self, other)
            }
            #[inline(always)]
            fn select_lt(self, other: Self, yes: Self, no: Self) -> Self {
                if self < other { yes } else { no }
            }
            #[inline(always)]
            fn any_above(self, bound: Self) -> bool {
                self > bound
            }
        }

        /// One lane.
        impl Wide for $T {
            const WIDTH: usize = 1;
            #[inline(always)]
            fn from_slice(x: &[Self]) -> Self {
                x[0]
            }
            #[inline(always)]
            fn to_slice(self, out: &mut [Self]) {
                out[0] = self;
            }
            #[inline(always)]
            fn gather(rows: &[&[Self]; MOST_LANES], first: usize) -> [Self; 4] {
                let row = &rows[0][first..first + 4];
                [row[0], row[1], row[2], row[3]]
            }
            /// There is one lane: the other three numbers mean nothing.
            #[inline(always)]
            fn turn(x: &[&Self; MOST_LANES], _: usize) -> [Self; 4] {
                [*x[0]; 4]
            }
        }

        impl Real for $T {
            #[inline]
            fn dispatch_one<A: Algorithm<Self>>(algorithm: A) -> A::Output {
                <$T as super::simd::Fusing>::dispatch_fused(algorithm)
            }
            const TRIG: Option<Trig<Self>> = Some($trig);
            const EPSILON: f64 = $T::EPSILON as f64;
            #[inline(always)]
            fn to_f64(self) -> f64 {
                f64::from(self)
            }
            #[inline(always)]
            fn from_dd(x: Dd) -> Self {
                x.hi() as $T
            }
            #[inline(always)]
            fn is_finite(self) -> bool {
                $T::is_finite(self)
            }
        }
    };
}

float!(f32, super::trig::SINGLE);
float!(f64, super::trig::DOUBLE);

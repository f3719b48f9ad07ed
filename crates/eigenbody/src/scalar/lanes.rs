//! Eight f64 side by side: one kernel call, eight shifts or eight configurations.

use super::Scalar;
use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

/// Number of lanes of every [`Lane`] type.
pub const LANES: usize = 8;

/// Several f64 as one scalar.
pub trait Lane: Scalar<Constant = f64> {
    /// One number a lane.
    fn from_array(x: [f64; LANES]) -> Self;
    /// The numbers.
    fn to_array(self) -> [f64; LANES];
    /// Mantissa in [1, 2) and exponent of |self|, lane by lane: |self| = m·2^e. Zero and subnormals give e = −1023.
    fn split_exponent(self) -> (Self, Self);
}

/// N f64 in an array. Eight are the lanes of a machine without wide units, and the reference for those with them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Array<const N: usize>(pub [f64; N]);

impl<const N: usize> Array<N> {
    #[inline(always)]
    fn zip(mut self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        for k in 0..N {
            self.0[k] = f(self.0[k], other.0[k]);
        }
        self
    }

    #[inline(always)]
    fn map(mut self, f: impl Fn(f64) -> f64) -> Self {
        for k in 0..N {
            self.0[k] = f(self.0[k]);
        }
        self
    }
}

/// The operators of a lane type from its four named ones.
macro_rules! lane_operators {
    ($Type:ty $(, $($generic:tt)*)?) => {
        impl$(<$($generic)*>)? Add for $Type {
            type Output = Self;
            #[inline(always)]
            fn add(self, b: Self) -> Self {
                self.plus(b)
            }
        }
        impl$(<$($generic)*>)? Sub for $Type {
            type Output = Self;
            #[inline(always)]
            fn sub(self, b: Self) -> Self {
                self.minus(b)
            }
        }
        impl$(<$($generic)*>)? Mul for $Type {
            type Output = Self;
            #[inline(always)]
            fn mul(self, b: Self) -> Self {
                self.times(b)
            }
        }
        impl$(<$($generic)*>)? Div for $Type {
            type Output = Self;
            #[inline(always)]
            fn div(self, b: Self) -> Self {
                self.over(b)
            }
        }
        impl$(<$($generic)*>)? Neg for $Type {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                self.negated()
            }
        }
        impl$(<$($generic)*>)? AddAssign for $Type {
            #[inline(always)]
            fn add_assign(&mut self, b: Self) {
                *self = self.plus(b);
            }
        }
        impl$(<$($generic)*>)? SubAssign for $Type {
            #[inline(always)]
            fn sub_assign(&mut self, b: Self) {
                *self = self.minus(b);
            }
        }
        impl$(<$($generic)*>)? MulAssign for $Type {
            #[inline(always)]
            fn mul_assign(&mut self, b: Self) {
                *self = self.times(b);
            }
        }
    };
}
pub(super) use lane_operators;

impl<const N: usize> Array<N> {
    #[inline(always)]
    fn plus(self, b: Self) -> Self {
        self.zip(b, |a, b| a + b)
    }
    #[inline(always)]
    fn minus(self, b: Self) -> Self {
        self.zip(b, |a, b| a - b)
    }
    #[inline(always)]
    fn times(self, b: Self) -> Self {
        self.zip(b, |a, b| a * b)
    }
    #[inline(always)]
    fn over(self, b: Self) -> Self {
        self.zip(b, |a, b| a / b)
    }
    #[inline(always)]
    fn negated(self) -> Self {
        self.map(|a| -a)
    }
}

lane_operators!(Array<N>, const N: usize);

impl<const N: usize> Scalar for Array<N> {
    type Constant = f64;
    #[inline(always)]
    fn constant(c: f64) -> Self {
        Self::from_f64(c)
    }
    const ZERO: Self = Self([0.0; N]);
    const ONE: Self = Self([1.0; N]);
    #[inline(always)]
    fn from_f64(x: f64) -> Self {
        Self([x; N])
    }
    #[inline(always)]
    fn mul_add(self, a: Self, b: Self) -> Self {
        self * a + b
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        self.map(f64::sqrt)
    }
    fn sin_cos(self) -> (Self, Self) {
        (self.map(f64::sin), self.map(f64::cos))
    }
    #[inline(always)]
    fn abs(self) -> Self {
        self.map(f64::abs)
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        self.zip(other, |a, b| if a < b { a } else { b })
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        self.zip(other, |a, b| if a > b { a } else { b })
    }
    #[inline(always)]
    fn select_lt(self, other: Self, yes: Self, no: Self) -> Self {
        let mut out = no;
        for k in 0..N {
            if self.0[k] < other.0[k] {
                out.0[k] = yes.0[k];
            }
        }
        out
    }
}

impl Lane for Array<LANES> {
    #[inline(always)]
    fn from_array(x: [f64; LANES]) -> Self {
        Self(x)
    }
    #[inline(always)]
    fn to_array(self) -> [f64; LANES] {
        self.0
    }
    #[inline(always)]
    fn split_exponent(self) -> (Self, Self) {
        let mantissa = |x: f64| f64::from_bits(x.to_bits() & 0x000f_ffff_ffff_ffff | 0x3ff0_0000_0000_0000);
        let exponent = |x: f64| ((x.to_bits() >> 52 & 0x7ff) as i32 - 1023) as f64;
        (self.map(mantissa), self.map(exponent))
    }
}

//! Numbers side by side: one kernel call, several shifts or several configurations.

use super::{Real, Scalar, only_itself};
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

/// As many numbers as the unit holds, as one scalar: lanes of a [`WideAlgorithm`](super::WideAlgorithm).
pub trait Wide: Scalar<Stored = Self> {
    /// Number of lanes.
    const WIDTH: usize;
    /// The first [`WIDTH`](Self::WIDTH) numbers of a slice, one a lane.
    fn from_slice(x: &[Self::Constant]) -> Self;
    /// Into the first [`WIDTH`](Self::WIDTH) places of a slice.
    fn to_slice(self, out: &mut [Self::Constant]);
    /// Four numbers from `first` on of each of [`WIDTH`](Self::WIDTH) rows: lane l of number k is `rows[l][first + k]`.
    fn gather(rows: &[&[Self::Constant]; MOST_LANES], first: usize) -> [Self; 4];
    /// Four lanes from `first` on of each of [`WIDTH`](Self::WIDTH) values: lane j of number k is lane `first + k` of `x[j]`.
    fn turn(x: &[&Self; MOST_LANES], first: usize) -> [Self; 4];
    /// Says that `out[at]` and what follows will be written soon: its line of memory may come closer. Beyond the end it says nothing.
    #[inline(always)]
    fn announce(_out: &[Self::Constant], _at: usize) {}
}

/// Lanes of the widest unit.
pub const MOST_LANES: usize = 16;

/// N numbers in an array: the lanes of a machine without wide units, and the reference for those with them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Array<const N: usize, T = f64>(pub [T; N]);

impl<const N: usize, T: Real> Array<N, T> {
    #[inline(always)]
    fn zip(mut self, other: Self, f: impl Fn(T, T) -> T) -> Self {
        for k in 0..N {
            self.0[k] = f(self.0[k], other.0[k]);
        }
        self
    }

    #[inline(always)]
    fn map(mut self, f: impl Fn(T) -> T) -> Self {
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

impl<const N: usize, T: Real> Array<N, T> {
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

lane_operators!(Array<N, T>, const N: usize, T: Real);

impl<const N: usize, T: Real> Scalar for Array<N, T> {
    type Constant = T;
    #[inline(always)]
    fn constant(c: T) -> Self {
        Self([c; N])
    }
    only_itself!();
    const ZERO: Self = Self([T::ZERO; N]);
    const ONE: Self = Self([T::ONE; N]);
    const FUSED: bool = false;
    #[inline(always)]
    fn from_f64(x: f64) -> Self {
        Self([T::from_f64(x); N])
    }
    #[inline(always)]
    fn mul_add(self, a: Self, b: Self) -> Self {
        self * a + b
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        self.map(T::sqrt)
    }
    fn sin_cos(self) -> (Self, Self) {
        let (mut sin, mut cos) = (self, self);
        for k in 0..N {
            (sin.0[k], cos.0[k]) = self.0[k].sin_cos();
        }
        (sin, cos)
    }
    #[inline(always)]
    fn abs(self) -> Self {
        self.map(T::abs)
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
    #[inline(always)]
    fn any_above(self, bound: T) -> bool {
        self.0.iter().any(|&x| x > bound)
    }
}

/// Two scalars as one: what is done alike to both is done in turns, and neither waits for itself.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Two<S>(pub S, pub S);

impl<S: Scalar> Two<S> {
    #[inline(always)]
    fn plus(self, b: Self) -> Self {
        Self(self.0 + b.0, self.1 + b.1)
    }
    #[inline(always)]
    fn minus(self, b: Self) -> Self {
        Self(self.0 - b.0, self.1 - b.1)
    }
    #[inline(always)]
    fn times(self, b: Self) -> Self {
        Self(self.0 * b.0, self.1 * b.1)
    }
    #[inline(always)]
    fn over(self, b: Self) -> Self {
        Self(self.0 / b.0, self.1 / b.1)
    }
    #[inline(always)]
    fn negated(self) -> Self {
        Self(-self.0, -self.1)
    }
}

lane_operators!(Two<S>, S: Scalar);

impl<S: Scalar> Scalar for Two<S> {
    type Constant = S::Constant;
    #[inline(always)]
    fn constant(c: S::Constant) -> Self {
        Self(S::constant(c), S::constant(c))
    }
    only_itself!();
    const ZERO: Self = Self(S::ZERO, S::ZERO);
    const ONE: Self = Self(S::ONE, S::ONE);
    const FUSED: bool = S::FUSED;
    #[inline(always)]
    fn from_f64(x: f64) -> Self {
        Self(S::from_f64(x), S::from_f64(x))
    }
    #[inline(always)]
    fn mul_add(self, a: Self, b: Self) -> Self {
        Self(self.0.mul_add(a.0, b.0), self.1.mul_add(a.1, b.1))
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(self.0.sqrt(), self.1.sqrt())
    }
    fn sin_cos(self) -> (Self, Self) {
        let ((s0, c0), (s1, c1)) = (self.0.sin_cos(), self.1.sin_cos());
        (Self(s0, s1), Self(c0, c1))
    }
    #[inline(always)]
    fn quarters(self, shifted: Self, s: Self, c: Self) -> (Self, Self) {
        let (s0, c0) = self.0.quarters(shifted.0, s.0, c.0);
        let (s1, c1) = self.1.quarters(shifted.1, s.1, c.1);
        (Self(s0, s1), Self(c0, c1))
    }
    #[inline(always)]
    fn abs(self) -> Self {
        Self(self.0.abs(), self.1.abs())
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        Self(self.0.min(other.0), self.1.min(other.1))
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        Self(self.0.max(other.0), self.1.max(other.1))
    }
    #[inline(always)]
    fn select_lt(self, other: Self, yes: Self, no: Self) -> Self {
        Self(self.0.select_lt(other.0, yes.0, no.0), self.1.select_lt(other.1, yes.1, no.1))
    }
    #[inline(always)]
    fn any_above(self, bound: S::Constant) -> bool {
        self.0.any_above(bound) || self.1.any_above(bound)
    }
}

impl<const N: usize, T: Real> Wide for Array<N, T> {
    const WIDTH: usize = N;
    #[inline(always)]
    fn from_slice(x: &[T]) -> Self {
        let mut lanes = [T::ZERO; N];
        lanes.copy_from_slice(&x[..N]);
        Self(lanes)
    }
    #[inline(always)]
    fn to_slice(self, out: &mut [T]) {
        out[..N].copy_from_slice(&self.0);
    }
    fn gather(rows: &[&[T]; MOST_LANES], first: usize) -> [Self; 4] {
        let mut out = [Self::ZERO; 4];
        for (k, out) in out.iter_mut().enumerate() {
            for l in 0..N {
                out.0[l] = rows[l][first + k];
            }
        }
        out
    }
    fn turn(x: &[&Self; MOST_LANES], first: usize) -> [Self; 4] {
        let mut out = [Self::ZERO; 4];
        for (k, out) in out.iter_mut().enumerate() {
            for j in 0..N {
                out.0[j] = x[j].0[(first + k) % N];
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

//! f32 and f64 on a processor with fused multiply-add.
//!
//! Whether a product and a sum are one instruction is a matter of the type: [`Fused`] always fuses, its number never does on a
//! target without the instruction, where fusing would be a library call. It exists, like the wide types and for its columns' sake,
//! inside the entry functions of this module's parent only.

#[cfg(target_arch = "x86_64")]
use super::x86::{F32x4, F64x4};
use crate::scalar::{Real, Scalar, Wide};
use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

/// A number whose [`mul_add`](Scalar::mul_add) rounds once. In memory it is the plain number.
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd)]
#[repr(transparent)]
pub(super) struct Fused<T>(T);

macro_rules! operator {
    ($Trait:ident, $name:ident, $AssignTrait:ident, $assign:ident) => {
        impl<T: Real> $Trait for Fused<T> {
            type Output = Self;
            #[inline(always)]
            fn $name(self, b: Self) -> Self {
                Self(self.0.$name(b.0))
            }
        }
        operator!(assign $AssignTrait, $assign, $name);
    };
    (assign $AssignTrait:ident, $assign:ident, $name:ident) => {
        impl<T: Real> $AssignTrait for Fused<T> {
            #[inline(always)]
            fn $assign(&mut self, b: Self) {
                self.0 = self.0.$name(b.0);
            }
        }
    };
}

operator!(Add, add, AddAssign, add_assign);
operator!(Sub, sub, SubAssign, sub_assign);
operator!(Mul, mul, MulAssign, mul_assign);

impl<T: Real> Div for Fused<T> {
    type Output = Self;
    #[inline(always)]
    fn div(self, b: Self) -> Self {
        Self(self.0 / b.0)
    }
}

impl<T: Real> Neg for Fused<T> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

macro_rules! fused {
    ($T:ident, $Columns:ty) => {
        impl Scalar for Fused<$T> {
            type Constant = $T;
            #[inline(always)]
            fn constant(c: $T) -> Self {
                Self(c)
            }
            type Stored = $T;
            #[inline(always)]
            fn load(x: $T) -> Self {
                Self(x)
            }
            #[inline(always)]
            fn store(self) -> $T {
                self.0
            }
            type Columns = $Columns;
            const COLUMNS: usize = 4;
            #[inline(always)]
            fn load_columns(x: &[$T]) -> $Columns {
                <$Columns>::from_slice(x)
            }
            #[inline(always)]
            fn constant_columns(x: &[$T]) -> $Columns {
                <$Columns>::from_slice(x)
            }
            #[inline(always)]
            fn store_columns(x: $Columns, out: &mut [$T]) {
                x.to_slice(out);
            }
            #[inline(always)]
            fn spread(self) -> $Columns {
                <$Columns>::constant(self.0)
            }
            const ZERO: Self = Self(0.0);
            const ONE: Self = Self(1.0);
            const FUSED: bool = true;
            #[inline(always)]
            fn from_f64(x: f64) -> Self {
                Self(x as $T)
            }
            #[inline(always)]
            fn mul_add(self, a: Self, b: Self) -> Self {
                Self($T::mul_add(self.0, a.0, b.0))
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                Self($T::sqrt(self.0))
            }
            #[inline(always)]
            fn sin_cos(self) -> (Self, Self) {
                let (s, c) = $T::sin_cos(self.0);
                (Self(s), Self(c))
            }
            #[inline(always)]
            fn quarters(self, shifted: Self, s: Self, c: Self) -> (Self, Self) {
                let (s, c) = self.0.quarters(shifted.0, s.0, c.0);
                (Self(s), Self(c))
            }
            #[inline(always)]
            fn abs(self) -> Self {
                Self($T::abs(self.0))
            }
            #[inline(always)]
            fn min(self, other: Self) -> Self {
                Self(Scalar::min(self.0, other.0))
            }
            #[inline(always)]
            fn max(self, other: Self) -> Self {
                Self(Scalar::max(self.0, other.0))
            }
            #[inline(always)]
            fn select_lt(self, other: Self, yes: Self, no: Self) -> Self {
                if self.0 < other.0 { yes } else { no }
            }
            #[inline(always)]
            fn any_above(self, bound: $T) -> bool {
                self.0 > bound
            }
        }
    };
}

#[cfg(target_arch = "x86_64")]
fused!(f32, F32x4);
#[cfg(target_arch = "x86_64")]
fused!(f64, F64x4);
#[cfg(not(target_arch = "x86_64"))]
fused!(f32, crate::scalar::Array<4, f32>);
#[cfg(not(target_arch = "x86_64"))]
fused!(f64, crate::scalar::Array<4, f64>);

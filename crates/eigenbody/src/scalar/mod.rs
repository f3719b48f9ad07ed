//! What a kernel may ask of a number.
//!
//! [`Scalar`] has arithmetic and a branch-free choice, nothing that looks at a value and jumps: one kernel then serves
//! f32, f64, double-double and, later, several numbers side by side. [`Real`] adds the order and the sizes that an
//! entry point needs to decide: is this pivot positive, has this iteration settled.

mod dd;
mod dd_trig;
mod float;
mod lanes;
#[allow(unsafe_code)] // audited: see the module's two promises
mod simd;

pub use dd::Dd;
pub use lanes::{Array, LANES, Lane};
pub use simd::{LaneAlgorithm, dispatch};

use std::fmt::Debug;
use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

/// A number, or several side by side, as a kernel sees it.
pub trait Scalar:
    Copy
    + Debug
    + Send
    + Sync
    + 'static
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + SubAssign
    + MulAssign
{
    /// What a model's numbers are when a kernel runs on this scalar: the scalar itself, or f64 for lanes.
    type Constant: Real;
    /// A model's number, in every lane.
    fn constant(c: Self::Constant) -> Self;
    /// 0.
    const ZERO: Self;
    /// 1.
    const ONE: Self;
    /// The nearest number to `x`.
    fn from_f64(x: f64) -> Self;
    /// self · a + b, fused where the target has the instruction.
    fn mul_add(self, a: Self, b: Self) -> Self;
    /// √self.
    fn sqrt(self) -> Self;
    /// (sin self, cos self), self in radians.
    fn sin_cos(self) -> (Self, Self);
    /// |self|.
    fn abs(self) -> Self;
    /// The smaller of two numbers.
    fn min(self, other: Self) -> Self;
    /// The larger of two numbers.
    fn max(self, other: Self) -> Self;
    /// `yes` where self < other, `no` elsewhere: a choice without a jump.
    fn select_lt(self, other: Self, yes: Self, no: Self) -> Self;
}

/// One real number that can be compared and measured.
pub trait Real: Scalar<Constant = Self> + PartialOrd {
    /// Unit round-off times two: the distance from 1 to the next number.
    const EPSILON: f64;
    /// The nearest f64.
    fn to_f64(self) -> f64;
    /// The nearest number to a double-double.
    fn from_dd(x: Dd) -> Self;
    /// Neither NaN nor infinite.
    fn is_finite(self) -> bool {
        self.to_f64().is_finite()
    }
}

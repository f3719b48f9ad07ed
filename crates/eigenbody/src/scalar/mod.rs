//! What a kernel may ask of a number.
//!
//! [`Scalar`] has arithmetic and a branch-free choice, nothing that looks at a value and jumps: one kernel then serves
//! f32, f64, double-double, several numbers side by side, and f32 and f64 on processors with fused instructions. [`Real`] adds
//! the order and the sizes that an entry point needs to decide: is this pivot positive, has this iteration settled.

mod dd;
mod dd_trig;
mod float;
mod fused;
mod lanes;
#[allow(unsafe_code)] // audited: see the module's two promises
mod simd;
mod trig;

pub use dd::Dd;
pub use fused::Fused;
pub use lanes::{Array, LANES, Lane, Wide};
pub use simd::{Algorithm, Batched, LaneAlgorithm, Unit, WideAlgorithm, dispatch, dispatch_one};
pub use trig::Trig;
pub(crate) use trig::sin_cos_all;

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
    /// What it is in memory: itself, or the plain number that a [`Fused`] computes with.
    type Stored: Scalar<Constant = Self::Constant, Stored = Self::Stored>;
    /// Out of memory.
    fn load(x: Self::Stored) -> Self;
    /// Into memory.
    fn store(self) -> Self::Stored;
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
    /// Whether any lane is larger than `bound`: the one question that a kernel may ask, of its input.
    fn any_above(self, bound: Self::Constant) -> bool;
}

/// One real number that can be compared and measured.
pub trait Real: Scalar<Constant = Self, Stored = Self> + PartialOrd {
    /// The same numbers, computed with on a processor that has fused multiply-add.
    type Fused: Scalar<Constant = Self, Stored = Self>;
    /// Polynomials for sine and cosine; none if only [`Scalar::sin_cos`] will do.
    const TRIG: Option<Trig<Self>>;
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

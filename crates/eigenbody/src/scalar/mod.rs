//! What a kernel may ask of a number.
//!
//! [`Scalar`] has arithmetic and a branch-free choice, nothing that looks at a value and jumps: one kernel then serves
//! f32, f64, double-double, several numbers side by side, and f32 and f64 on processors with fused instructions. [`Real`] adds
//! the order and the sizes that an entry point needs to decide: is this pivot positive, has this iteration settled.

mod aligned;
mod dd;
mod dd_trig;
mod decimal;
mod float;
mod lanes;
mod quad;
#[allow(unsafe_code)] // audited: see the module's two promises
mod simd;
mod sixteenths;
mod trig;

pub(crate) use aligned::{Aligned, Line};
pub use dd::Dd;
pub(crate) use lanes::Two;
pub use lanes::{Array, LANES, Lane, MOST_LANES, Wide};
pub use quad::Quad;
pub use simd::{
    Algorithm, Batched, LaneAlgorithm, PairAlgorithm, Unit, WideAlgorithm, dispatch, dispatch_one,
    dispatch_pair,
};
pub use trig::Trig;
pub(crate) use trig::sin_cos_columns;

/// What a scalar says of columns and memory that is only itself.
macro_rules! only_itself {
    () => {
        only_itself!(Self, x => x, x => x);
    };
    // But for memory, where it is something else.
    ($Stored:ty, $in_memory:ident => $load:expr, $number:ident => $store:expr) => {
        type Stored = $Stored;
        #[inline(always)]
        fn load($in_memory: $Stored) -> Self {
            $load
        }
        #[inline(always)]
        fn store(self) -> $Stored {
            let $number = self;
            $store
        }
        type Columns = Self;
        const COLUMNS: usize = 1;
        #[inline(always)]
        fn load_columns(x: &[$Stored]) -> Self {
            Self::load(x[0])
        }
        #[inline(always)]
        fn constant_columns(x: &[Self::Constant]) -> Self {
            Self::constant(x[0])
        }
        #[inline(always)]
        fn store_columns(x: Self, out: &mut [$Stored]) {
            out[0] = x.store();
        }
        #[inline(always)]
        fn spread(self) -> Self {
            self
        }
    };
}
pub(crate) use only_itself;

use std::fmt::Debug;
use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

/// The most columns that any scalar has.
pub(crate) const MOST_COLUMNS: usize = 4;

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
    /// What it is in memory: itself, or the plain number where a product and a sum are fused.
    type Stored: Scalar<Constant = Self::Constant, Stored = Self::Stored>;
    /// Out of memory.
    fn load(x: Self::Stored) -> Self;
    /// Into memory.
    fn store(self) -> Self::Stored;
    /// Several of these numbers side by side, for what is done alike to many vectors; where nothing is gained, one.
    type Columns: Scalar<Constant = Self::Constant>;
    /// How many.
    const COLUMNS: usize;
    /// The first [`COLUMNS`](Self::COLUMNS) numbers of a slice.
    fn load_columns(x: &[Self::Stored]) -> Self::Columns;
    /// A model's first [`COLUMNS`](Self::COLUMNS) numbers of a slice, one a column.
    fn constant_columns(x: &[Self::Constant]) -> Self::Columns;
    /// Into the first [`COLUMNS`](Self::COLUMNS) places of a slice.
    fn store_columns(x: Self::Columns, out: &mut [Self::Stored]);
    /// The same number in every column.
    fn spread(self) -> Self::Columns;
    /// 0.
    const ZERO: Self;
    /// 1.
    const ONE: Self;
    /// The nearest number to `x`.
    fn from_f64(x: f64) -> Self;
    /// Whether [`mul_add`](Self::mul_add) rounds once.
    const FUSED: bool;
    /// self · a + b, fused where the target has the instruction.
    fn mul_add(self, a: Self, b: Self) -> Self;
    /// √self.
    fn sqrt(self) -> Self;
    /// (sin self, cos self), self in radians.
    fn sin_cos(self) -> (Self, Self);
    /// Sine and cosine after n = `self` quarter turns of an angle with sine s and cosine c; `shifted` is n and 1.5/ε, whose last bits are
    /// those of n.
    #[inline(always)]
    fn quarters(self, _shifted: Self, s: Self, c: Self) -> (Self, Self) {
        trig::quarters(self, s, c)
    }
    /// Sine and cosine of n sixteenths of a turn, where looking them up is one instruction; `shifted` is n and 1.5/ε.
    #[inline(always)]
    fn sixteenths(_shifted: Self) -> Option<(Self, Self)> {
        None
    }
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
    /// Runs an algorithm on these numbers: fused, and with wide columns, where this processor can.
    #[inline]
    fn dispatch_one<A: Algorithm<Self>>(algorithm: A) -> A::Output {
        algorithm.run::<Self>()
    }
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

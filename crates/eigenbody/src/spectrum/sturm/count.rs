//! Eight counts in one sweep.

use super::hinge::Hinge;
use super::pencil::Pencil;
use super::sweep::{Pivots, sweep};
use crate::joint::Column;
use crate::scalar::{LANES, Lane, LaneAlgorithm, Scalar, dispatch};
use crate::spatial::ArticulatedInertia;

/// What one shift finds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Count {
    /// The shift σ.
    pub shift: f64,
    /// Number of eigenvalues below σ.
    pub below: usize,
    /// log₂|det(H − σB)|.
    pub log2_det: f64,
}

/// Number of eigenvalues of the pencil below each of eight shifts, and log₂|det|, in one O(N) sweep.
///
/// ```text
/// H − σB = L D Lᵀ (articulated-body elimination)     count = #{ D_d < 0 }   (Sylvester)
/// ```
/// Shifts are finite, and so is σB. Runs on the widest unit of the processor. Numerics: a count is exact for some H + δH, see
/// `docs/numerics.md`; two shifts within that error may count in the wrong order.
pub fn counts(pencil: &Pencil<'_, f64>, shifts: [f64; LANES]) -> [Count; LANES] {
    dispatch(Counting { pencil, shifts })
}

struct Counting<'a> {
    pencil: &'a Pencil<'a, f64>,
    shifts: [f64; LANES],
}

impl LaneAlgorithm for Counting<'_> {
    type Output = [Count; LANES];

    #[inline(always)]
    fn run<L: Lane>(self) -> [Count; LANES] {
        let mut tally = Tally { below: L::ZERO, mantissa: L::ONE, exponent: L::ZERO };
        let mut stack = Vec::new();
        sweep(self.pencil, L::from_array(self.shifts), &mut stack, &mut tally);
        let (below, mantissa, exponent) =
            (tally.below.to_array(), tally.mantissa.to_array(), tally.exponent.to_array());
        let mut counts = [Count { shift: 0.0, below: 0, log2_det: 0.0 }; LANES];
        for (k, count) in counts.iter_mut().enumerate() {
            *count = Count {
                shift: self.shifts[k],
                below: below[k] as usize,
                log2_det: exponent[k] + mantissa[k].log2(),
            };
        }
        counts
    }
}

/// Signs and the product of the pivots, as mantissa and exponent.
struct Tally<L> {
    below: L,
    mantissa: L,
    exponent: L,
}

impl<L: Lane + Scalar> Pivots<L> for Tally<L> {
    #[inline(always)]
    fn pivot(&mut self, _: usize, _: Column, hinge: &Hinge<L>) {
        self.below += hinge.D.select_lt(L::ZERO, L::ONE, L::ZERO);
        let (mantissa, exponent) = (self.mantissa * hinge.D).split_exponent();
        self.mantissa = mantissa;
        self.exponent += exponent;
    }
    #[inline(always)]
    fn body(&mut self, _: usize, _: &ArticulatedInertia<L>) {}
}

//! The wide units: the one module with `unsafe`.
//!
//! Two promises keep it sound, and both are kept here:
//!
//! 1. A value of a wide type, or of a fused one, exists only inside the entry functions, which run only after the processor was
//!    asked for their features. The types are private to this module; callers see [`Lane`], [`Wide`] and [`Scalar`].
//! 2. Every intrinsic used works on registers: none touches memory, except loads and stores of whole arrays by value, and
//!    hints of what will be written, which change no memory whatever the address.
//!
//! Dispatch happens once, around a whole algorithm: the algorithm is generic over its scalar and inlined whole into the entry
//! function, so that everything in it is compiled for the unit. One configuration runs on registers of four numbers,
//! both ends of a spectrum on one of two.

mod fused;
#[cfg(target_arch = "x86_64")]
mod x86;

use super::lanes::{Array, LANES, Lane, Wide};
use super::{Quad, Real, Scalar};
use fused::Fused;

/// An algorithm over eight lanes. `run` must be `#[inline(always)]`, and so must all that it calls per element.
pub trait LaneAlgorithm {
    /// What it computes.
    type Output;
    /// Runs on any lane type.
    fn run<L: Lane>(self) -> Self::Output;
}

/// An algorithm over as many lanes as there are. `run` must be `#[inline(always)]`, and so must all that it calls per element.
pub trait WideAlgorithm<T: Real> {
    /// What it computes.
    type Output;
    /// Runs on any lane type.
    fn run<W: Wide<Constant = T>>(self) -> Self::Output;
}

/// An algorithm over single numbers. `run` must be `#[inline(always)]`, and so must all that it calls per element.
pub trait Algorithm<T: Real> {
    /// What it computes.
    type Output;
    /// The unit that it does best on, as measured: registers of four numbers are all that it uses of either.
    const UNIT: Unit = Unit::Avx2;
    /// Runs on plain or fused numbers.
    fn run<S: Scalar<Constant = T, Stored = T>>(self) -> Self::Output;
    /// Runs where four numbers fit into a register, for an algorithm that has a better way there.
    #[inline(always)]
    fn run_in_fours<S: Scalar<Constant = T, Stored = T, Columns: Quad<T>>>(self) -> Self::Output
    where
        Self: Sized,
    {
        self.run::<S>()
    }
}

/// An algorithm over two numbers side by side. `run` must be `#[inline(always)]`, and so must all that it calls per element.
pub trait PairAlgorithm {
    /// What it computes.
    type Output;
    /// Runs on plain numbers, or on a register of two.
    fn run<T: Scalar<Constant = f64, Stored = Array<2>>>(self) -> Self::Output;
}

/// A unit of the processor.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Unit {
    /// What every processor of the target has: one number at a time.
    Plain,
    /// AVX2 with fused multiply-add: four f64.
    Avx2,
    /// AVX-512: eight f64.
    Avx512,
}

impl Unit {
    /// The widest that this processor has. Never changes while the program runs.
    #[inline]
    pub fn widest() -> Self {
        #[cfg(target_arch = "x86_64")]
        {
            if is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma") {
                let wide = is_x86_feature_detected!("avx512f")
                    && is_x86_feature_detected!("avx512dq")
                    && is_x86_feature_detected!("avx512vl");
                return if wide { Self::Avx512 } else { Self::Avx2 };
            }
        }
        Self::Plain
    }
}

/// Runs an algorithm on the widest unit that this processor has.
#[inline]
pub fn dispatch<A: LaneAlgorithm>(algorithm: A) -> A::Output {
    match Unit::widest() {
        // SAFETY: the processor has the features that the entry function is compiled for.
        #[cfg(target_arch = "x86_64")]
        Unit::Avx512 => unsafe { x86::lanes_avx512(algorithm) },
        // SAFETY: as above.
        #[cfg(target_arch = "x86_64")]
        Unit::Avx2 => unsafe { x86::lanes_avx2(algorithm) },
        _ => algorithm.run::<Array<LANES>>(),
    }
}

/// Runs an algorithm on two numbers side by side, on `unit`, or on the widest that this processor has if that is less.
#[inline]
pub fn dispatch_pair<A: PairAlgorithm>(unit: Unit, algorithm: A) -> A::Output {
    match unit.min(Unit::widest()) {
        // SAFETY: the processor has the features that the entry function is compiled for.
        #[cfg(target_arch = "x86_64")]
        Unit::Avx2 | Unit::Avx512 => unsafe { x86::pair_avx2(algorithm) },
        _ => algorithm.run::<Array<2>>(),
    }
}

/// Runs an algorithm on single numbers: fused, and with wide columns, where this processor can.
#[inline]
pub fn dispatch_one<T: Real, A: Algorithm<T>>(algorithm: A) -> A::Output {
    T::dispatch_one(algorithm)
}

/// Runs an algorithm on `F`, or on plain numbers where there is no fused multiply-add.
#[inline]
fn dispatch_fused<F, T, A>(algorithm: A) -> A::Output
where
    F: Scalar<Constant = T, Stored = T, Columns: Quad<T>>,
    T: Real,
    A: Algorithm<T>,
{
    #[cfg(target_arch = "aarch64")]
    return algorithm.run_in_fours::<F>();
    #[cfg(not(target_arch = "aarch64"))]
    match A::UNIT.min(Unit::widest()) {
        // SAFETY: the processor has the features that the entry function is compiled for.
        #[cfg(target_arch = "x86_64")]
        Unit::Avx512 => unsafe { x86::one_avx512::<F, _, _>(algorithm) },
        // SAFETY: as above.
        #[cfg(target_arch = "x86_64")]
        Unit::Avx2 => unsafe { x86::one_avx2::<F, _, _>(algorithm) },
        _ => algorithm.run::<T>(),
    }
}

/// Numbers of which the wide units hold several: f32 and f64.
pub trait Batched: Real {
    /// Runs an algorithm on `unit`, or on the widest that this processor has if that is less.
    fn dispatch_wide<A: WideAlgorithm<Self>>(unit: Unit, algorithm: A) -> A::Output;
}

/// Numbers that have a fused form. It is named here alone.
pub(super) trait Fusing: Real {
    /// Runs an algorithm on the fused form, or on plain numbers where there is none.
    fn dispatch_fused<A: Algorithm<Self>>(algorithm: A) -> A::Output;
}

macro_rules! batched {
    ($T:ident, $avx2:ident, $avx512:ident) => {
        impl Fusing for $T {
            #[inline]
            fn dispatch_fused<A: Algorithm<Self>>(algorithm: A) -> A::Output {
                dispatch_fused::<Fused<$T>, _, _>(algorithm)
            }
        }

        impl Batched for $T {
            #[inline]
            fn dispatch_wide<A: WideAlgorithm<Self>>(unit: Unit, algorithm: A) -> A::Output {
                match unit.min(Unit::widest()) {
                    // SAFETY: the processor has the features that the entry function is compiled for.
                    #[cfg(target_arch = "x86_64")]
                    Unit::Avx512 => unsafe { x86::wide_avx512::<x86::$avx512, _, _>(algorithm) },
                    // SAFETY: as above.
                    #[cfg(target_arch = "x86_64")]
                    Unit::Avx2 => unsafe { x86::wide_avx2::<x86::$avx2, _, _>(algorithm) },
                    _ => algorithm.run::<$T>(),
                }
            }
        }
    };
}

batched!(f64, F64x4, F64x8);
batched!(f32, F32x8, F32x16);

#[cfg(test)]
mod tests {
    use super::super::lanes::{Array, LANES, Lane, MOST_LANES, Wide};
    use super::{
        Batched, LaneAlgorithm, PairAlgorithm, Scalar, Unit, WideAlgorithm, dispatch, dispatch_pair,
    };

    /// Every operation of the lane type, on awkward numbers.
    struct Everything;

    impl LaneAlgorithm for Everything {
        type Output = Vec<[f64; LANES]>;
        #[inline(always)]
        fn run<L: Lane>(self) -> Self::Output {
            let a = L::from_array([1.0, -2.5, 3e300, -4e-300, 0.0, 6.25, -7e-310, 1e308]);
            let b = L::from_array([3.0, 2.5, -1e-5, 4e300, -0.0, 6.25, 2.0, -0.5]);
            let (m, e) = a.split_exponent();
            [
                a + b,
                a - b,
                a * b,
                a / (b + L::ONE),
                -a,
                a.abs(),
                a.abs().sqrt(),
                a.min(b),
                a.max(b),
                a.select_lt(b, L::ONE, L::ZERO),
                m,
                e,
                L::from_f64(0.1),
            ]
            .map(L::to_array)
            .to_vec()
        }
    }

    /// The wide unit agrees with plain arrays to the bit in every operation but the fused one.
    #[test]
    fn wide_lanes_agree_with_arrays() {
        let (wide, plain) = (dispatch(Everything), Everything.run::<Array<LANES>>());
        for (operation, (wide, plain)) in wide.iter().zip(&plain).enumerate() {
            for lane in 0..LANES {
                let same = wide[lane].to_bits() == plain[lane].to_bits()
                    || (wide[lane].is_nan() && plain[lane].is_nan());
                assert!(same, "operation {operation}, lane {lane}: {} {}", wide[lane], plain[lane]);
            }
        }
    }

    /// The same of two numbers, out of memory and back.
    struct EverythingOfTwo;

    impl PairAlgorithm for EverythingOfTwo {
        type Output = Vec<[f64; 2]>;
        #[inline(always)]
        fn run<T: Scalar<Constant = f64, Stored = Array<2>>>(self) -> Self::Output {
            let (a, b) = (T::load(Array([1.0, -2.5e300])), T::load(Array([-0.3, 7.0])));
            let columns = T::load_columns(&[Array([3.0, -4.0])]);
            let mut stored = [Array::ZERO];
            T::store_columns(columns + columns, &mut stored);
            let (sine, cosine) = T::constant(2.0).quarters(T::constant(1.5 / f64::EPSILON + 2.0), a, b);
            let numbers = [
                a + b,
                a - b,
                a * b,
                a / b,
                -a,
                a.abs(),
                a.abs().sqrt(),
                a.min(b),
                a.max(b),
                a.select_lt(b, T::ONE, T::ZERO),
                T::constant(0.1),
                sine,
                cosine,
                T::load(stored[0]),
            ];
            numbers.map(|x| x.store().0).to_vec()
        }
    }

    #[test]
    fn registers_of_two_agree_with_arrays() {
        let (wide, plain) =
            (dispatch_pair(Unit::Avx2, EverythingOfTwo), dispatch_pair(Unit::Plain, EverythingOfTwo));
        assert_eq!(wide, plain);
        assert_eq!(plain[plain.len() - 1], [6.0, -8.0]);
    }

    /// Rows turned into lanes, and lanes into rows.
    struct Turns<'a, T>(&'a [T]);

    impl<T: Batched> WideAlgorithm<T> for Turns<'_, T> {
        /// Lanes, numbers gathered, numbers of the rows that they give.
        type Output = (usize, Vec<T>, Vec<T>);
        #[inline(always)]
        fn run<W: Wide<Constant = T>>(self) -> Self::Output {
            let mut rows: [&[T]; MOST_LANES] = [&[]; MOST_LANES];
            for (lane, row) in rows.iter_mut().enumerate() {
                *row = &self.0[7 * (lane * 5 % MOST_LANES)..];
            }
            let mut numbers = [T::ZERO; MOST_LANES];
            let mut out = [Vec::new(), Vec::new()];
            let gathered = W::gather(&rows, 2);
            for x in gathered {
                x.to_slice(&mut numbers);
                out[0].extend(&numbers[..W::WIDTH]);
            }
            let mut values = [W::ZERO; MOST_LANES];
            for (k, value) in values.iter_mut().enumerate() {
                *value = W::from_slice(&self.0[k * MOST_LANES..]);
            }
            let mut chosen = [&values[0]; MOST_LANES];
            for (k, chosen) in chosen.iter_mut().enumerate() {
                *chosen = &values[k * 3 % MOST_LANES];
            }
            for first in (0..W::WIDTH).step_by(4) {
                for x in W::turn(&chosen, first) {
                    x.to_slice(&mut numbers);
                    out[1].extend(&numbers[..W::WIDTH]);
                }
            }
            let [gathered, turned] = out;
            (W::WIDTH, gathered, turned)
        }
    }

    fn rows_turn_into_lanes<T: Batched>() {
        let numbers: Vec<T> = (0..MOST_LANES * MOST_LANES).map(|k| T::from_f64(k as f64)).collect();
        for unit in [Unit::Plain, Unit::Avx2, Unit::Avx512] {
            let (width, gathered, turned) = T::dispatch_wide(unit, Turns(&numbers));
            for (place, x) in gathered.iter().enumerate() {
                let (k, lane) = (place / width, place % width);
                assert_eq!(x.to_f64(), (7 * (lane * 5 % MOST_LANES) + 2 + k) as f64, "{unit:?}");
            }
            for (place, x) in turned.iter().enumerate().take(width * width) {
                let (lane, j) = (place / width, place % width);
                assert_eq!(x.to_f64(), (MOST_LANES * (j * 3 % MOST_LANES) + lane) as f64, "{unit:?}");
            }
        }
    }

    #[test]
    fn turns_are_exact() {
        rows_turn_into_lanes::<f32>();
        rows_turn_into_lanes::<f64>();
    }
}

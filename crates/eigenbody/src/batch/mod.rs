//! Many configurations at once: lanes of the processor's widest unit, on all cores.
//!
//! ```text
//! on each thread:    for each part that is left:    for each group of W configurations:
//!     x ← one configuration a lane;    y ← kernel(x);    one result a lane ← y
//! ```
//! The kernels are those of [`dynamics`](crate::dynamics) and [`spectrum`](crate::spectrum), over lanes instead of numbers. Arrays
//! are row-major, one configuration after the other, in the caller's memory. Groups are the same however many threads there are, and so
//! are the numbers. What a call has allocated is kept for the next one of the same kind.

mod ends;
mod kernels;
mod layout;
mod limbs;
mod mass;
mod share;
mod turn;

use crate::conditioning::Values;
use crate::dynamics::{AbaWorkspace, RneaWorkspace};
use crate::error::{Error, InputError, check_length};
use crate::model::{Model, check};
use crate::scalar::{Batched, MOST_LANES, Unit};
use crate::spectrum::Metric;
use ends::Spectra;
use kernels::{Entries, Forward, Inverse, Masses};
use layout::Layout;
use rayon::prelude::*;
use share::{Faults, Found, Kernel, Over, Part, Rooms, Shares, threads};
use std::sync::OnceLock;

/// Configurations of the widest group: parts are multiples of it.
const GROUP: usize = MOST_LANES;
/// Entries of H that are worth being written on their own.
const PIECE: usize = 32;

/// What went wrong, and where.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum BatchError {
    /// An array does not fit the model or the other arrays.
    #[error(transparent)]
    Shape(InputError),
    /// One configuration has no answer. It is the first of those that have none.
    #[error("configuration {index}: {error}")]
    Configuration {
        /// Its place in the batch, from 0.
        index: usize,
        /// What is wrong with it.
        error: Error,
    },
}

/// Computes over many configurations of one robot.
///
/// Made once and called often: memory that a call needs beside the caller's is kept, as much as its threads have used at a time.
///
/// ```
/// use eigenbody::{Family, Model, batch::Batch, mass_matrix};
/// let arm: Model<f64> = Family::hydra(3, 1.0, 0.4, 1.0)?.model()?;
/// let q: Vec<f64> = (0..300).map(|k| k as f64 / 100.0).collect();
/// let mut H = vec![0.0; 100 * 9];
/// Batch::new(&arm).mass_matrices(&q, &mut H)?;
/// let last = mass_matrix(&arm, &q[297..])?;
/// assert!(H[891..].iter().zip(last.as_slice()).all(|(a, b)| (a - b).abs() < 1e-14));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Batch<'m, T> {
    model: &'m Model<T>,
    unit: Unit,
    whole: OnceLock<Layout>,
    pieces: OnceLock<Layout>,
    rooms: Rooms,
}

impl Batch<'_, f64> {
    /// λmin and λmax of H x = λ B x in every configuration.
    ///
    /// | name | shape | unit |
    /// |------|-------|------|
    /// | `q` | k × `nq` | rad, m, unit quaternions |
    /// | `metric` | B | see [`Metric`] |
    /// | `accuracy` | relative error allowed in λmin, such as 1e-8 | – |
    /// | `ends` | k × 2: λmin, λmax | unit of H_dd/B_dd |
    ///
    /// Method: [`extreme_eigenvalues`](crate::spectrum::extreme_eigenvalues) side by side; a configuration where n·ε·λmax/λmin exceeds
    /// `accuracy` goes to the Sturm engine, at some forty times the cost. λmin is zero where that cannot tell it from zero. All degrees of
    /// freedom take part: mimic joints move freely, a floating base is kept.
    ///
    /// Errors: [`BatchError`], also where the unit-diagonal metric meets a degree of freedom without inertia; `ends` then holds no result.
    pub fn extremes(
        &self,
        q: &[f64],
        metric: &Metric<f64>,
        accuracy: f64,
        ends: &mut [f64],
    ) -> Result<(), BatchError> {
        let count = self.count(q)?;
        length("ends", ends.len(), 2 * count)?;
        let mut values = vec![Values { lambda_min: 0.0, lambda_max: 0.0, kappa_weighted: 0.0 }; count];
        self.spectra(q, metric, accuracy, false, &mut values)?;
        for (ends, values) in ends.chunks_exact_mut(2).zip(&values) {
            (ends[0], ends[1]) = (values.lambda_min, values.lambda_max);
        }
        Ok(())
    }

    /// λmin, λmax and κ′ of every configuration; κ is [`Values::kappa`].
    ///
    /// Shapes and method: as [`extremes`](Self::extremes), twice; one of [`Values`] a configuration. κ′ is infinite where a degree of
    /// freedom has no inertia. Errors: as there.
    pub fn conditioning(
        &self,
        q: &[f64],
        metric: &Metric<f64>,
        accuracy: f64,
        values: &mut [Values],
    ) -> Result<(), BatchError> {
        let count = self.count(q)?;
        length("values", values.len(), count)?;
        self.spectra(q, metric, accuracy, true, values)
    }

    fn spectra(
        &self,
        q: &[f64],
        metric: &Metric<f64>,
        accuracy: f64,
        weighted: bool,
        values: &mut [Values],
    ) -> Result<(), BatchError> {
        let model = self.model;
        model.check_dense().map_err(BatchError::Shape)?;
        let ones = vec![1.0; model.nv()];
        let weights = metric.weights_for(&ones, |d| model.is_translation(d)).map_err(BatchError::Shape)?;
        let (weights, layout) = (weights.as_slice(), self.whole());
        let units: Vec<f64> = layout.order().map(|d| 1.0 / weights[d].sqrt()).collect();
        let kernel = Spectra { q, layout, metric, weights, units: &units, weighted, accuracy, out: values };
        let found = self.share(q, kernel, |unit, over| f64::dispatch_wide(unit, over));
        self.check(found, q, &[])
    }
}

impl<'m, T: Lanes> Batch<'m, T> {
    /// On the widest unit of this processor.
    pub fn new(model: &'m Model<T>) -> Self {
        Self {
            model,
            unit: Unit::widest(),
            whole: OnceLock::new(),
            pieces: OnceLock::new(),
            rooms: Rooms::default(),
        }
    }

    /// On no wider a unit than this: for comparisons.
    pub fn on(self, unit: Unit) -> Self {
        Self { unit, ..self }
    }

    /// H(q) of every configuration.
    ///
    /// | name | shape | unit |
    /// |------|-------|------|
    /// | `q` | k × `nq` | rad, m, unit quaternions |
    /// | `H` | k × `nv` × `nv`, both triangles | kg m², kg m, kg |
    ///
    /// Method and numerics: as [`mass_matrix`](crate::mass_matrix).
    ///
    /// Errors: [`BatchError`]; `H` then holds no result.
    pub fn mass_matrices(&self, q: &[T], H: &mut [T]) -> Result<(), BatchError> {
        self.model.check_dense().map_err(BatchError::Shape)?;
        let layout = self.whole();
        let places = layout.square();
        length("H", H.len(), self.count(q)? * places.len())?;
        let found = self.share(q, Masses { layout, places, H }, T::masses);
        self.check(found, q, &[])
    }

    /// The entries (d, e) of H that [`mass_matrix_entries`](Self::mass_matrix_entries) gives, in its order: e on the path from the root to
    /// d, or d itself. All others are zero, or mirror these.
    pub fn entries(&self) -> Vec<(usize, usize)> {
        self.pieces().pairs()
    }

    /// H(q) of every configuration, but for zeros between branches and the other triangle.
    ///
    /// | name | shape | unit |
    /// |------|-------|------|
    /// | `q` | k × `nq` | rad, m, unit quaternions |
    /// | `entries` | k × number of [`entries`](Self::entries) | kg m², kg m, kg |
    ///
    /// Method and numerics: as [`mass_matrix`](crate::mass_matrix). A humanoid has 1225 numbers in H and a third of them here: where
    /// matrices are many, memory is what takes the time.
    ///
    /// Errors: [`BatchError`]; `entries` then holds no result.
    ///
    /// ```
    /// use eigenbody::{Family, Model, batch::Batch};
    /// let tree: Model<f64> = Family::hydra(7, 2.0, 0.4, 1.0)?.model()?;
    /// let batch = Batch::new(&tree);
    /// // Of a binary tree of three levels: 7 on the diagonal, 6 with the body next to it, 4 with the root.
    /// assert_eq!(batch.entries().len(), 17);
    /// let mut entries = vec![0.0; 2 * 17];
    /// batch.mass_matrix_entries(&[0.1; 14], &mut entries)?;
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn mass_matrix_entries(&self, q: &[T], entries: &mut [T]) -> Result<(), BatchError> {
        self.model.check_dense().map_err(BatchError::Shape)?;
        let layout = self.pieces();
        length("entries", entries.len(), self.count(q)? * layout.entries())?;
        let found = self.share(q, Entries { layout, entries }, T::entries);
        self.check(found, q, &[])
    }

    /// τ = H(q) v̇ + C(q, v) of every state.
    ///
    /// | name | shape | unit |
    /// |------|-------|------|
    /// | `q` | k × `nq` | rad, m, unit quaternions |
    /// | `v`, `vdot` | k × `nv` | rad/s, m/s; rad/s², m/s² |
    /// | `tau` | k × `nv` | N m, N |
    ///
    /// Method and numerics: as [`inverse_dynamics`](crate::inverse_dynamics).
    ///
    /// Errors: [`BatchError`]; `tau` then holds no result.
    pub fn inverse_dynamics(&self, q: &[T], v: &[T], vdot: &[T], tau: &mut [T]) -> Result<(), BatchError> {
        let (count, nv) = (self.count(q)?, self.model.nv());
        length("v", v.len(), count * nv)?;
        length("vdot", vdot.len(), count * nv)?;
        length("tau", tau.len(), count * nv)?;
        let found = self.share(q, Inverse { v, vdot, tau }, T::inverse);
        self.check(found, q, &[("v", v), ("vdot", vdot)])
    }

    /// v̇ = H(q)⁻¹ (τ − C(q, v)) of every state.
    ///
    /// | name | shape | unit |
    /// |------|-------|------|
    /// | `q` | k × `nq` | rad, m, unit quaternions |
    /// | `v`, `tau` | k × `nv` | rad/s, m/s; N m, N |
    /// | `vdot` | k × `nv` | rad/s², m/s² |
    ///
    /// Method and numerics: as [`forward_dynamics`](crate::forward_dynamics).
    ///
    /// Errors: [`BatchError`], also where a hinge inertia is not positive; `vdot` then holds no result.
    pub fn forward_dynamics(&self, q: &[T], v: &[T], tau: &[T], vdot: &mut [T]) -> Result<(), BatchError> {
        let (count, nv) = (self.count(q)?, self.model.nv());
        length("v", v.len(), count * nv)?;
        length("tau", tau.len(), count * nv)?;
        length("vdot", vdot.len(), count * nv)?;
        let found = self.share(q, Forward { v, tau, vdot }, T::forward);
        self.check(found, q, &[("v", v), ("tau", tau)])
    }

    /// All entries of H together.
    fn whole(&self) -> &Layout {
        self.whole.get_or_init(|| Layout::new(self.model, usize::MAX))
    }

    /// H in pieces.
    fn pieces(&self) -> &Layout {
        self.pieces.get_or_init(|| Layout::new(self.model, PIECE))
    }

    /// Number of configurations in `q`.
    fn count(&self, q: &[T]) -> Result<usize, BatchError> {
        let nq = self.model.nq();
        let count = q.len().checked_div(nq).unwrap_or(0);
        match count * nq == q.len() {
            true => Ok(count),
            false => Err(BatchError::Shape(InputError::Length {
                what: "q",
                expected: (count + 1) * nq,
                found: q.len(),
            })),
        }
    }

    /// Runs a kernel over all configurations, on all threads.
    fn share<K: Kernel<T> + Send>(
        &self,
        q: &[T],
        kernel: K,
        run: impl Fn(Unit, Over<'_, T, K>) -> Found + Sync,
    ) -> Found {
        let Self { model, unit, rooms, .. } = self;
        let threads = threads(q.len().checked_div(model.nq()).unwrap_or(0));
        let shares = &Shares::new(model, threads, Part { first: 0, q, kernel });
        (0..threads)
            .into_par_iter()
            .with_max_len(1)
            .map(|_| run(*unit, Over { model, rooms, shares }))
            .reduce(Found::default, Found::and)
    }

    /// If some of the numbers were not found to be fit: the first configuration with a q, or other numbers, that is not; or else the first
    /// without an answer.
    fn check(&self, found: Found, q: &[T], others: &[(&'static str, &[T])]) -> Result<(), BatchError> {
        let (nq, nv) = (self.model.nq().max(1), self.model.nv().max(1));
        let at = |index| move |error: InputError| BatchError::Configuration { index, error: error.into() };
        if found.unfit {
            for (index, q) in q.chunks_exact(nq).enumerate() {
                self.model.check_q(q).map_err(at(index))?;
            }
            for &(what, x) in others {
                for (index, x) in x.chunks_exact(nv).enumerate() {
                    check(what, x, nv).map_err(at(index))?;
                }
            }
        }
        match found.failed {
            Some((index, error)) => Err(BatchError::Configuration { index, error }),
            None => Ok(()),
        }
    }
}

fn length(what: &'static str, found: usize, expected: usize) -> Result<(), BatchError> {
    check_length(what, found, expected).map_err(BatchError::Shape)
}

/// Numbers that a batch may be of: f32 and f64. The kernels are compiled here, once, not again by each crate that calls them.
pub trait Lanes: Batched {
    #[doc(hidden)]
    fn masses(unit: Unit, over: Over<'_, Self, Masses<'_, Self>>) -> Found;
    #[doc(hidden)]
    fn entries(unit: Unit, over: Over<'_, Self, Entries<'_, Self>>) -> Found;
    #[doc(hidden)]
    fn inverse(unit: Unit, over: Over<'_, Self, Inverse<'_, Self>>) -> Found;
    #[doc(hidden)]
    fn forward(unit: Unit, over: Over<'_, Self, Forward<'_, Self>>) -> Found;
}

macro_rules! lanes {
    ($T:ident) => {
        impl Lanes for $T {
            fn masses(unit: Unit, over: Over<'_, Self, Masses<'_, Self>>) -> Found {
                Self::dispatch_wide(unit, over)
            }
            fn entries(unit: Unit, over: Over<'_, Self, Entries<'_, Self>>) -> Found {
                Self::dispatch_wide(unit, over)
            }
            fn inverse(unit: Unit, over: Over<'_, Self, Inverse<'_, Self>>) -> Found {
                Self::dispatch_wide(unit, over)
            }
            fn forward(unit: Unit, over: Over<'_, Self, Forward<'_, Self>>) -> Found {
                Self::dispatch_wide(unit, over)
            }
        }
    };
}

lanes!(f32);
lanes!(f64);

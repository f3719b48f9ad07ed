//! Many configurations at once: lanes of the processor's widest unit, on all cores.
//!
//! ```text
//! for each chunk of configurations, in parallel:
//!     for each group of W configurations:    x ← one configuration a lane;    y ← kernel(x);    one result a lane ← y
//! ```
//! The kernels are those of [`dynamics`](crate::dynamics) and [`spectrum`](crate::spectrum), over lanes instead of numbers. Arrays
//! are row-major, one configuration after the other, in the caller's memory. Groups are the same however many threads there are, and so
//! are the numbers. Every call allocates its workspaces anew: batches of a hundred configurations and more make up for that.

mod ends;
mod kernels;
mod layout;
mod mass;
mod turn;

use crate::conditioning::Values;
use crate::dynamics::{AbaWorkspace, RneaWorkspace};
use crate::error::{Error, InputError};
use crate::model::{Model, QUATERNION_TOLERANCE, check};
use crate::scalar::{Batched, MOST_LANES, Scalar, Unit, Wide, WideAlgorithm};
use crate::spectrum::Metric;
use ends::Spectra;
use kernels::{Forward, Inverse, Masses};
use layout::Layout;
use rayon::prelude::*;
use std::ops::Range;

/// Configurations of the widest group: chunks are multiples of it.
const GROUP: usize = MOST_LANES;
/// Fewest configurations of a chunk.
const CHUNK: usize = 4 * GROUP;

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
#[derive(Debug, Clone, Copy)]
pub struct Batch<'m, T> {
    model: &'m Model<T>,
    unit: Unit,
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
    /// Errors: [`BatchError`]; `ends` then holds no result.
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
        let Self { model, unit } = *self;
        model.check_dense().map_err(BatchError::Shape)?;
        let ones = vec![1.0; model.nv()];
        let weights = metric.weights_for(&ones, |d| model.is_translation(d)).map_err(BatchError::Shape)?;
        let (nq, chunk, weights, layout) =
            (model.nq(), chunk(values.len()), weights.as_slice(), &Layout::new(model));
        let (fit, failed): (Vec<bool>, Vec<_>) = chunks(q, chunk * nq)
            .zip(chunks_mut(values, chunk))
            .map(|(q, out)| {
                let kernel = Spectra { q, layout, metric, weights, weighted, accuracy, out };
                f64::dispatch_wide(unit, Over { model, q, kernel })
            })
            .unzip();
        self.check(fit, q, &[])?;
        first(failed, chunk)
    }
}

impl<'m, T: Lanes> Batch<'m, T> {
    /// On the widest unit of this processor.
    pub fn new(model: &'m Model<T>) -> Self {
        Self { model, unit: Unit::widest() }
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
        let layout = &Layout::new(self.model);
        self.masses("H", q, layout, Some(&layout.square()), H)
    }

    /// The entries (d, e) of H that [`mass_matrix_entries`](Self::mass_matrix_entries) gives, in its order: e on the path from the root to
    /// d, or d itself. All others are zero, or mirror these.
    pub fn entries(&self) -> Vec<(usize, usize)> {
        Layout::new(self.model).pairs()
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
        let layout = &Layout::new(self.model);
        self.masses("entries", q, layout, None, entries)
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
        let Self { model, unit } = *self;
        let count = self.count(q)?;
        let (nq, nv) = (model.nq(), model.nv());
        length("v", v.len(), count * nv)?;
        length("vdot", vdot.len(), count * nv)?;
        length("tau", tau.len(), count * nv)?;
        let chunk = chunk(count);
        let states = chunks(q, chunk * nq).zip(chunks(v, chunk * nv)).zip(chunks(vdot, chunk * nv));
        let parts = states.zip(chunks_mut(tau, chunk * nv));
        let fit = parts.map(|(((q, v), vdot), tau)| T::inverse(model, unit, q, Inverse { v, vdot, tau }));
        self.check(fit.collect(), q, &[("v", v), ("vdot", vdot)])
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
        let Self { model, unit } = *self;
        let count = self.count(q)?;
        let (nq, nv) = (model.nq(), model.nv());
        length("v", v.len(), count * nv)?;
        length("tau", tau.len(), count * nv)?;
        length("vdot", vdot.len(), count * nv)?;
        let chunk = chunk(count);
        let states = chunks(q, chunk * nq).zip(chunks(v, chunk * nv)).zip(chunks(tau, chunk * nv));
        let (fit, failed): (Vec<bool>, Vec<_>) = states
            .zip(chunks_mut(vdot, chunk * nv))
            .map(|(((q, v), tau), vdot)| T::forward(model, unit, q, Forward { v, tau, vdot }))
            .unzip();
        self.check(fit, q, &[("v", v), ("tau", tau)])?;
        first(failed, chunk)
    }

    /// The entries at these places, or all of them.
    fn masses(
        &self,
        what: &'static str,
        q: &[T],
        layout: &Layout,
        places: Option<&[u32]>,
        H: &mut [T],
    ) -> Result<(), BatchError> {
        let Self { model, unit } = *self;
        model.check_dense().map_err(BatchError::Shape)?;
        let (count, nq, size) = (self.count(q)?, model.nq(), places.map_or(layout.entries, <[u32]>::len));
        length(what, H.len(), count * size)?;
        let chunk = chunk(count);
        let parts = chunks(q, chunk * nq).zip(chunks_mut(H, chunk * size));
        let fit = parts.map(|(q, H)| T::masses(model, unit, q, Masses { layout, places, H })).collect();
        self.check(fit, q, &[])
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

    /// If some part of the numbers was not found to be fit: the first configuration with a q, or other numbers, that is not.
    fn check(&self, fit: Vec<bool>, q: &[T], others: &[(&'static str, &[T])]) -> Result<(), BatchError> {
        if fit.into_iter().all(|fit| fit) {
            return Ok(());
        }
        let (nq, nv) = (self.model.nq().max(1), self.model.nv().max(1));
        let at = |index| move |error: InputError| BatchError::Configuration { index, error: error.into() };
        for (index, q) in q.chunks_exact(nq).enumerate() {
            self.model.check_q(q).map_err(at(index))?;
        }
        for &(what, x) in others {
            for (index, x) in x.chunks_exact(nv).enumerate() {
                check(what, x, nv).map_err(at(index))?;
            }
        }
        Ok(())
    }
}

fn length(what: &'static str, found: usize, expected: usize) -> Result<(), BatchError> {
    match found == expected {
        true => Ok(()),
        false => Err(BatchError::Shape(InputError::Length { what, expected, found })),
    }
}

/// Configurations of a chunk: a few chunks for each thread, whole groups.
fn chunk(count: usize) -> usize {
    let chunks = match rayon::current_num_threads() {
        1 => 1,
        threads => 4 * threads,
    };
    count.div_ceil(chunks).next_multiple_of(GROUP).max(CHUNK)
}

fn chunks<T: Sync>(x: &[T], size: usize) -> rayon::slice::Chunks<'_, T> {
    x.par_chunks(size.max(1))
}

fn chunks_mut<T: Send>(x: &mut [T], size: usize) -> rayon::slice::ChunksMut<'_, T> {
    x.par_chunks_mut(size.max(1))
}

/// The first failure in the order of the configurations.
fn first(failed: Vec<Option<(usize, Error)>>, chunk: usize) -> Result<(), BatchError> {
    let found = failed.into_iter().enumerate().find_map(|(k, failure)| Some((k, failure?)));
    match found {
        Some((k, (index, error))) => Err(BatchError::Configuration { index: k * chunk + index, error }),
        None => Ok(()),
    }
}

/// Numbers that a batch may be of: f32 and f64. The kernels are compiled here, once, not again by each crate that calls them.
pub trait Lanes: Batched {
    #[doc(hidden)]
    fn masses(model: &Model<Self>, unit: Unit, q: &[Self], kernel: Masses<'_, Self>) -> bool;
    #[doc(hidden)]
    fn inverse(model: &Model<Self>, unit: Unit, q: &[Self], kernel: Inverse<'_, Self>) -> bool;
    #[doc(hidden)]
    fn forward(
        model: &Model<Self>,
        unit: Unit,
        q: &[Self],
        kernel: Forward<'_, Self>,
    ) -> (bool, Option<(usize, Error)>);
}

macro_rules! lanes {
    ($T:ident) => {
        impl Lanes for $T {
            fn masses(model: &Model<Self>, unit: Unit, q: &[Self], kernel: Masses<'_, Self>) -> bool {
                Self::dispatch_wide(unit, Over { model, q, kernel }).0
            }
            fn inverse(model: &Model<Self>, unit: Unit, q: &[Self], kernel: Inverse<'_, Self>) -> bool {
                Self::dispatch_wide(unit, Over { model, q, kernel }).0
            }
            fn forward(
                model: &Model<Self>,
                unit: Unit,
                q: &[Self],
                kernel: Forward<'_, Self>,
            ) -> (bool, Option<(usize, Error)>) {
                Self::dispatch_wide(unit, Over { model, q, kernel })
            }
        }
    };
}

lanes!(f32);
lanes!(f64);

/// Zero in every lane as long as all numbers are finite, and all quaternions near enough to unit ones.
struct Faults<W>([W; 4]);

impl<W: Wide> Faults<W> {
    /// 0 x is zero for a finite number and for no other.
    #[inline(always)]
    fn look_at(&mut self, x: &[W]) {
        for (k, &x) in x.iter().enumerate() {
            self.0[k % 4] = x.mul_add(W::ZERO, self.0[k % 4]);
        }
    }

    #[inline(always)]
    fn look_at_quaternion(&mut self, q: &[W]) {
        let square = q[0].mul_add(q[0], q[1] * q[1]) + q[2].mul_add(q[2], q[3] * q[3]);
        let apart = (square - W::ONE).abs();
        self.0[0] += W::from_f64(QUATERNION_TOLERANCE).select_lt(apart, W::ONE, W::ZERO);
    }

    #[inline(always)]
    fn none(self) -> bool {
        let [a, b, c, d] = self.0;
        !(a + b + (c + d)).select_lt(W::ONE, W::ZERO, W::ONE).any_above(W::Constant::ZERO)
    }
}

/// A kernel over the configurations of a chunk.
struct Over<'a, T, K> {
    model: &'a Model<T>,
    q: &'a [T],
    kernel: K,
}

/// What is computed of a group of configurations, one a lane.
trait Kernel<T: Batched> {
    /// What is told of a chunk.
    type Output: Default;
    /// Memory for a group.
    type Room<W: Wide<Constant = T>>;
    /// Memory for a group.
    fn room<W: Wide<Constant = T>>(&self, model: &Model<T>) -> Self::Room<W>;
    /// Computes a group of configurations, of which q stands in lanes already.
    fn group<W: Wide<Constant = T>>(
        &mut self,
        model: &Model<T>,
        q: &[W],
        group: Range<usize>,
        room: &mut Self::Room<W>,
        faults: &mut Faults<W>,
        output: &mut Self::Output,
    );
}

impl<T: Batched, K: Kernel<T>> WideAlgorithm<T> for Over<'_, T, K> {
    /// Whether all numbers are fit to be computed with, and what the kernel tells.
    type Output = (bool, K::Output);

    #[inline(always)]
    fn run<W: Wide<Constant = T>>(mut self) -> (bool, K::Output) {
        let (model, nq) = (self.model, self.model.nq());
        let count = self.q.len().checked_div(nq).unwrap_or(0);
        let mut q = turn::room(nq);
        let (mut room, mut output) = (self.kernel.room::<W>(model), K::Output::default());
        let mut faults = Faults([W::ZERO; 4]);
        let mut first = 0;
        while first < count {
            let lanes = W::WIDTH.min(count - first);
            turn::into_lanes(&self.q[first * nq..], nq, lanes, &mut q);
            faults.look_at(&q[..nq]);
            for &(_, index) in &model.mechanism.quaternions {
                faults.look_at_quaternion(&q[index as usize..]);
            }
            self.kernel.group(model, &q, first..first + lanes, &mut room, &mut faults, &mut output);
            first += W::WIDTH;
        }
        (faults.none(), output)
    }
}

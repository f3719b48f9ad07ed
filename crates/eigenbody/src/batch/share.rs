//! What threads share: parts of a batch, each taken by whoever is done with another, and rooms that are left for the next call.

use super::{GROUP, turn};
use crate::error::Error;
use crate::model::{Model, QUATERNION_TOLERANCE};
use crate::scalar::{Batched, Scalar, Wide, WideAlgorithm};
use std::any::Any;
use std::fmt;
use std::ops::Range;
use std::sync::Mutex;

/// Parts for each thread, and the fewest configurations of a part: small enough that no thread waits long for another, at the end.
const PARTS: usize = 32;
const LEAST: usize = 4 * GROUP;

/// Configurations of a part, whole groups.
pub(super) fn part(count: usize) -> usize {
    match rayon::current_num_threads() {
        1 => count.max(1),
        threads => count.div_ceil(PARTS * threads).next_multiple_of(GROUP).max(LEAST),
    }
}

/// So many configurations of `n` numbers at a time.
pub(super) fn rows<T>(x: &[T], configurations: usize, n: usize) -> std::slice::Chunks<'_, T> {
    x.chunks((configurations * n).max(1))
}

pub(super) fn rows_mut<T>(x: &mut [T], configurations: usize, n: usize) -> std::slice::ChunksMut<'_, T> {
    x.chunks_mut((configurations * n).max(1))
}

/// What a thread found in its parts.
#[doc(hidden)]
#[derive(Debug, Default)]
pub struct Found {
    /// Some number is not fit to be computed with.
    pub(super) unfit: bool,
    /// The first configuration without an answer.
    pub(super) failed: Option<(usize, Error)>,
}

impl Found {
    pub(super) fn and(self, other: Self) -> Self {
        let failed = match (self.failed, other.failed) {
            (Some(one), Some(other)) => Some(if other.0 < one.0 { other } else { one }),
            (one, other) => one.or(other),
        };
        Self { unfit: self.unfit || other.unfit, failed }
    }
}

/// Configurations in a row: the first one's place in the batch, their q, and a kernel with what else belongs to them.
#[doc(hidden)]
#[derive(Debug)]
pub struct Part<'a, T, K> {
    pub(super) first: usize,
    pub(super) q: &'a [T],
    pub(super) kernel: K,
}

/// The next part, until none is left.
type Parts<'a, T, K> = &'a (dyn Fn() -> Option<Part<'a, T, K>> + Sync);

/// Memory of threads that are done.
#[derive(Default)]
pub(super) struct Rooms(Mutex<Vec<Box<dyn Any + Send>>>);

impl fmt::Debug for Rooms {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Rooms").finish_non_exhaustive()
    }
}

impl Rooms {
    /// One of this kind, if one is left.
    fn take<R: Any>(&self) -> Option<Box<R>> {
        let mut rooms = self.0.lock().ok()?;
        let place = rooms.iter().rposition(|room| room.is::<R>())?;
        rooms.swap_remove(place).downcast().ok()
    }

    fn leave<R: Any + Send>(&self, room: Box<R>) {
        if let Ok(mut rooms) = self.0.lock() {
            rooms.push(room);
        }
    }
}

/// Zero in every lane as long as all numbers are finite, and all quaternions near enough to unit ones.
pub(super) struct Faults<W>([W; 4]);

impl<W: Wide> Faults<W> {
    /// 0 x is zero for a finite number and for no other.
    #[inline(always)]
    pub(super) fn look_at(&mut self, x: &[W]) {
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

/// A kernel over the configurations of as many parts as it gets.
#[doc(hidden)]
#[allow(missing_debug_implementations)]
pub struct Over<'a, T, K> {
    pub(super) model: &'a Model<T>,
    pub(super) rooms: &'a Rooms,
    pub(super) next: Parts<'a, T, K>,
}

/// What is computed of a group of configurations, one a lane.
pub(super) trait Kernel<T: Batched> {
    /// Memory for a group, whatever stands in it.
    type Room<W: Wide<Constant = T>>: Any + Send;
    /// Memory for a group.
    fn room<W: Wide<Constant = T>>(&self, model: &Model<T>) -> Self::Room<W>;
    /// Computes a group of configurations, of which q stands in lanes already, and tells the first of its part without an answer.
    fn group<W: Wide<Constant = T>>(
        &mut self,
        model: &Model<T>,
        q: &[W],
        group: Range<usize>,
        room: &mut Self::Room<W>,
        faults: &mut Faults<W>,
        failed: &mut Option<(usize, Error)>,
    );
}

/// Memory of a thread: q in lanes, and what its kernel needs.
struct Own<W, R> {
    q: Vec<W>,
    room: R,
}

impl<T: Batched, K: Kernel<T>> WideAlgorithm<T> for Over<'_, T, K> {
    type Output = Found;

    #[inline(always)]
    fn run<W: Wide<Constant = T>>(self) -> Found {
        let Self { model, rooms, next } = self;
        let nq = model.nq();
        let mut found = Found::default();
        let Some(mut part) = next() else { return found };
        let mut own = rooms
            .take::<Own<W, K::Room<W>>>()
            .unwrap_or_else(|| Box::new(Own { q: turn::room(nq), room: part.kernel.room::<W>(model) }));
        let Own { q, room } = &mut *own;
        let mut faults = Faults([W::ZERO; 4]);
        loop {
            let count = part.q.len().checked_div(nq).unwrap_or(0);
            let (mut failed, mut first) = (None, 0);
            while first < count {
                let lanes = W::WIDTH.min(count - first);
                turn::into_lanes(&part.q[first * nq..], nq, lanes, q);
                faults.look_at(&q[..nq]);
                for &(_, index) in &model.mechanism.quaternions {
                    faults.look_at_quaternion(&q[index as usize..]);
                }
                part.kernel.group(model, q, first..first + lanes, room, &mut faults, &mut failed);
                first += W::WIDTH;
            }
            if found.failed.is_none() {
                found.failed = failed.map(|(k, error)| (part.first + k, error));
            }
            match next() {
                Some(next) => part = next,
                None => break,
            }
        }
        rooms.leave(own);
        found.unfit = !faults.none();
        found
    }
}

//! What threads share: a batch, of which each takes parts until none is left, and rooms that wait for the next call.

use super::{GROUP, turn};
use crate::error::Error;
use crate::model::{Model, QUATERNION_TOLERANCE};
use crate::scalar::{Batched, Scalar, Wide, WideAlgorithm};
use std::any::Any;
use std::fmt;
use std::ops::Range;
use std::sync::Mutex;

/// Most shares of a batch: of more threads, some have one together.
const SHARES: usize = 32;
/// Parts that a thread sees in what is left of a share, when it takes one: they grow smaller, and no thread waits long for another at the
/// end.
const PARTS: usize = 8;
/// Configurations that are worth a thread.
const WORTH: usize = 4 * GROUP;

/// Threads for so many configurations.
pub(super) fn threads(count: usize) -> usize {
    rayon::current_num_threads().min(count.div_ceil(WORTH))
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

impl<T: Batched, K: Kernel<T>> Part<'_, T, K> {
    fn count(&self, model: &Model<T>) -> usize {
        self.q.len().checked_div(model.nq()).unwrap_or(0)
    }

    /// Its first configurations, so many, and the others.
    fn split_at(self, model: &Model<T>, count: usize) -> (Self, Self) {
        let (q, others) = self.q.split_at(count * model.nq());
        let (kernel, other) = self.kernel.split_at(model, count);
        let first = self.first + count;
        (Self { q, kernel, ..self }, Self { first, q: others, kernel: other })
    }
}

/// A batch in shares, of each what is left.
///
/// ```text
/// a thread:    while some of its share is left:            take from the front
///              while some of another share is left:        take from the back
/// ```
/// A thread finds the memory of its share where it left it in the call before: near.
#[allow(missing_debug_implementations)]
pub struct Shares<'a, T, K> {
    left: [Mutex<Option<Part<'a, T, K>>>; SHARES],
    count: usize,
}

impl<'a, T: Batched, K: Kernel<T>> Shares<'a, T, K> {
    /// One for each thread, of whole groups but for the last.
    pub(super) fn new(model: &Model<T>, threads: usize, all: Part<'a, T, K>) -> Self {
        let mut left = [const { Mutex::new(None) }; SHARES];
        let count = threads.clamp(1, SHARES);
        let size = all.count(model).div_ceil(count).next_multiple_of(GROUP);
        let mut rest = all;
        for share in &mut left[..count] {
            let own = size.min(rest.count(model));
            let (part, others) = rest.split_at(model, own);
            *share = Mutex::new(Some(part));
            rest = others;
        }
        Self { left, count }
    }

    /// A part of a thread's own share, or else of another.
    fn next(&self, model: &Model<T>, own: usize) -> Option<Part<'a, T, K>> {
        (0..self.count).find_map(|k| {
            let mut share = self.left[(own + k) % self.count].lock().ok()?;
            let left = share.take()?;
            let count = left.count(model);
            let size = match self.count {
                1 => count,
                _ => count.div_ceil(PARTS).next_multiple_of(GROUP),
            };
            if size >= count {
                return (count > 0).then_some(left);
            }
            let (part, rest) = if k == 0 {
                left.split_at(model, size)
            } else {
                let (rest, part) = left.split_at(model, (count - size) / GROUP * GROUP);
                (part, rest)
            };
            *share = Some(rest);
            Some(part)
        })
    }
}

/// Memory of threads that are done, each with the thread's number.
#[derive(Default)]
pub(super) struct Rooms(Mutex<Vec<(usize, Box<dyn Any + Send>)>>);

impl fmt::Debug for Rooms {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Rooms").finish_non_exhaustive()
    }
}

impl Rooms {
    /// One of this kind, if one is left: the thread's own rather than another.
    fn take<R: Any>(&self, thread: usize) -> Option<Box<R>> {
        let mut rooms = self.0.lock().ok()?;
        let fit = (0..rooms.len()).filter(|&place| rooms[place].1.is::<R>());
        let place = fit.max_by_key(|&place| rooms[place].0 == thread)?;
        rooms.swap_remove(place).1.downcast().ok()
    }

    fn leave<R: Any + Send>(&self, thread: usize, room: Box<R>) {
        if let Ok(mut rooms) = self.0.lock() {
            rooms.push((thread, room));
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

/// A kernel over the configurations of as many parts as its thread gets.
#[doc(hidden)]
#[allow(missing_debug_implementations)]
pub struct Over<'a, T, K> {
    pub(super) model: &'a Model<T>,
    pub(super) rooms: &'a Rooms,
    pub(super) shares: &'a Shares<'a, T, K>,
}

/// What is computed of a group of configurations, one a lane.
pub(super) trait Kernel<T: Batched>: Sized {
    /// Memory for a group, whatever stands in it.
    type Room<W: Wide<Constant = T>>: Any + Send;
    /// For the first configurations, so many, and for the others.
    fn split_at(self, model: &Model<T>, count: usize) -> (Self, Self);
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
        let Self { model, rooms, shares } = self;
        let nq = model.nq();
        let mut found = Found::default();
        let thread = rayon::current_thread_index().unwrap_or(0);
        let Some(mut part) = shares.next(model, thread) else { return found };
        let mut own = rooms
            .take::<Own<W, K::Room<W>>>(thread)
            .unwrap_or_else(|| Box::new(Own { q: turn::room(nq), room: part.kernel.room::<W>(model) }));
        let Own { q, room } = &mut *own;
        let mut faults = Faults([W::ZERO; 4]);
        loop {
            let count = part.count(model);
            let (mut failed, mut first) = (None, 0);
            while first < count {
                let lanes = W::WIDTH.min(count - first);
                turn::into_lanes(&part.q[first * nq..], nq, lanes, q);
                faults.look_at(&q[..nq]);
                for &(_, index) in &model.quaternions {
                    faults.look_at_quaternion(&q[index as usize..]);
                }
                part.kernel.group(model, q, first..first + lanes, room, &mut faults, &mut failed);
                first += W::WIDTH;
            }
            let failed = failed.map(|(k, error)| (part.first + k, error));
            found = found.and(Found { unfit: false, failed });
            match shares.next(model, thread) {
                Some(next) => part = next,
                None => break,
            }
        }
        rooms.leave(thread, own);
        found.unfit = !faults.none();
        found
    }
}

#[cfg(test)]
mod tests {
    use super::super::kernels::Inverse;
    use super::*;
    use crate::family::Family;

    /// Places of the parts that threads take in this order, until nothing is left.
    fn taken(count: usize, threads: usize, order: impl Fn(usize) -> usize) -> Vec<Range<usize>> {
        let model: Model<f64> = Family::hydra(1, 1.0, 0.0, 1.0).unwrap().model().unwrap();
        let q: Vec<f64> = (0..count).map(|k| k as f64).collect();
        let mut tau = vec![0.0; count];
        let kernel = Inverse { v: &q, vdot: &q, tau: &mut tau };
        let shares = Shares::new(&model, threads, Part { first: 0, q: &q, kernel });
        let mut places = Vec::new();
        while let Some(Part { first, q, kernel }) = shares.next(&model, order(places.len())) {
            assert_eq!((q[0], kernel.v, kernel.tau.len()), (first as f64, q, q.len()));
            kernel.tau.fill(1.0);
            places.push(first..first + q.len());
        }
        assert!(tau.iter().all(|&x| x == 1.0));
        places
    }

    fn assert_whole(mut places: Vec<Range<usize>>, count: usize) {
        places.sort_by_key(|place| place.start);
        let mut end = 0;
        for place in places {
            assert_eq!((place.start, place.start % GROUP, place.is_empty()), (end, 0, false));
            end = place.end;
        }
        assert_eq!(end, count);
    }

    #[test]
    fn every_configuration_is_taken_once() {
        for count in [1, 15, 64, 65, 1000, 5003] {
            for threads in [1, 2, 3, 8, 2 * SHARES] {
                for step in [0, 1, 3] {
                    assert_whole(taken(count, threads, |k| k * step), count);
                }
            }
        }
    }

    #[test]
    fn a_thread_takes_its_own_share_before_others_from_behind() {
        let places = taken(4096, 2, |_| 1);
        let (own, others): (Vec<_>, Vec<_>) = places.iter().cloned().partition(|place| place.start >= 2048);
        assert_eq!(places, [own.clone(), others.clone()].concat());
        assert!(own.is_sorted_by_key(|place| place.start) && own[0] == (2048..2304));
        assert!(others.is_sorted_by_key(|place| 4096 - place.start) && others[0] == (1792..2048));
    }

    #[test]
    fn one_thread_takes_all_at_once() {
        assert_eq!(taken(5003, 1, |_| 0), std::slice::from_ref(&(0..5003)));
    }

    #[test]
    fn a_thread_finds_its_own_room_again() {
        let rooms = Rooms::default();
        rooms.leave(0, Box::new(10));
        rooms.leave(1, Box::new(11));
        rooms.leave(2, Box::new("other"));
        assert_eq!(rooms.take::<i32>(0).as_deref(), Some(&10));
        // Another's rather than none.
        assert_eq!(rooms.take::<i32>(0).as_deref(), Some(&11));
        assert_eq!(rooms.take::<i32>(2), None);
    }
}

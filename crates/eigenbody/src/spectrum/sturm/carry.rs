//! What bodies hand to those that carry them, tips first, in memory of the order of log₂ N.

use super::pencil::{Node, Route};
use crate::scalar::Scalar;
use crate::spatial::{ArticulatedInertia, Force, RigidInertia};
use std::ops::{Add, AddAssign};

/// What is summed up, and may have to wait in memory.
pub(super) trait Waits: Copy + Add<Output = Self> + AddAssign {
    /// What it is in memory.
    type Stored: Copy;
    fn load(x: Self::Stored) -> Self;
    fn store(self) -> Self::Stored;
}

macro_rules! waits {
    ($($Type:ident),+) => {$(
        impl<T: Scalar> Waits for $Type<T> {
            type Stored = $Type<T::Stored>;
            #[inline(always)]
            fn load(x: Self::Stored) -> Self {
                x.map(T::load)
            }
            #[inline(always)]
            fn store(self) -> Self::Stored {
                self.map(T::store)
            }
        }
    )+};
}

waits!(ArticulatedInertia, Force, RigidInertia);

/// Sums of what the children of each body hand down. Bodies are taken from the last to the first, each with one
/// [`collect`](Self::collect) and, after it, one [`hand_down`](Self::hand_down).
pub(super) struct Carry<'s, V: Waits> {
    zero: V,
    /// For the body that is next.
    carried: V,
    /// For bodies further on. Empty before the first body and after the last.
    waiting: &'s mut Vec<V::Stored>,
}

impl<'s, V: Waits> Carry<'s, V> {
    #[inline(always)]
    pub fn new(zero: V, waiting: &'s mut Vec<V::Stored>) -> Self {
        Self { zero, carried: zero, waiting }
    }

    /// A body's own part and what its children handed down.
    #[inline(always)]
    pub fn collect<T>(&mut self, node: &Node<T>, own: V) -> V {
        let mut sum = self.carried + own;
        if let (true, Some(&others)) = (node.collects, self.waiting.last()) {
            sum += V::load(others);
            self.waiting.pop();
        }
        sum
    }

    /// Hands `up` to the body's parent.
    #[inline(always)]
    pub fn hand_down(&mut self, route: Route, up: impl FnOnce() -> V) {
        self.carried = self.zero;
        if route == Route::World {
            return;
        }
        let up = up();
        match (route, self.waiting.last_mut()) {
            (Route::Next, _) => self.carried = up,
            (Route::Add, Some(top)) => *top = (V::load(*top) + up).store(),
            _ => self.waiting.push(up.store()),
        }
    }
}

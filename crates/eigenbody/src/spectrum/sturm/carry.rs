//! What bodies hand to those that carry them, tips first, in memory of the order of log₂ N.

use super::pencil::{Node, Route};
use std::ops::{Add, AddAssign};

/// Sums of what the children of each body hand down. Bodies are taken from the last to the first, each with one
/// [`collect`](Self::collect) and, after it, one [`hand_down`](Self::hand_down).
pub(super) struct Carry<'s, V> {
    zero: V,
    /// For the body that is next.
    carried: V,
    /// For bodies further on. Empty before the first body and after the last.
    waiting: &'s mut Vec<V>,
}

impl<'s, V: Copy + Add<Output = V> + AddAssign> Carry<'s, V> {
    #[inline(always)]
    pub fn new(zero: V, waiting: &'s mut Vec<V>) -> Self {
        Self { zero, carried: zero, waiting }
    }

    /// A body's own part and what its children handed down.
    #[inline(always)]
    pub fn collect<T>(&mut self, node: &Node<T>, own: V) -> V {
        let mut sum = self.carried + own;
        if let (true, Some(others)) = (node.collects, self.waiting.last()) {
            sum += *others;
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
            (Route::Add, Some(top)) => *top += up,
            _ => self.waiting.push(up),
        }
    }
}

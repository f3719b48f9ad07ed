//! Numbers that begin where a line of the cache does, so that no register of them is loaded from two.

use std::ops::{Deref, DerefMut};

/// Bytes of a line.
const LINE: usize = 64;

/// A value that begins at a line, as do all of a `Vec` of them.
#[derive(Debug, Clone, Copy)]
#[repr(align(64))]
pub(crate) struct Line<V>(pub V);

/// As many numbers as it was made with, the first at a line.
#[derive(Debug)]
pub(crate) struct Aligned<T> {
    /// With room before them.
    values: Vec<T>,
    first: usize,
    count: usize,
}

impl<T: Clone> Aligned<T> {
    pub fn new(value: T, count: usize) -> Self {
        // As many as it may take to come to a line; none where that cannot be told, or is impossible.
        let values = vec![value; count + LINE];
        let first = values.as_ptr().align_offset(LINE);
        Self { values, first: if first < LINE { first } else { 0 }, count }
    }
}

impl<T: Clone> Clone for Aligned<T> {
    fn clone(&self) -> Self {
        match self.first() {
            None => Self { values: Vec::new(), first: 0, count: 0 },
            Some(value) => {
                let mut clone = Self::new(value.clone(), self.count);
                clone.clone_from_slice(self);
                clone
            }
        }
    }
}

impl<T> Deref for Aligned<T> {
    type Target = [T];
    #[inline(always)]
    fn deref(&self) -> &[T] {
        &self.values[self.first..self.first + self.count]
    }
}

impl<T> DerefMut for Aligned<T> {
    #[inline(always)]
    fn deref_mut(&mut self) -> &mut [T] {
        &mut self.values[self.first..self.first + self.count]
    }
}

#[cfg(test)]
mod tests {
    use super::{Aligned, LINE, Line};

    #[test]
    fn values_begin_at_a_line() {
        for count in [0, 1, 7, 100] {
            let mut row = Aligned::new(1.5, count);
            assert_eq!((row.len(), row.as_ptr().align_offset(LINE)), (count, 0));
            row.fill(2.5);
            let copy = row.clone();
            assert_eq!(
                (&copy[..], copy.is_empty() || copy.as_ptr().align_offset(LINE) == 0),
                (&row[..], true)
            );
        }
        assert_eq!(align_of::<Line<[f64; 4]>>(), LINE);
    }
}

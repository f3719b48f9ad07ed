//! A dense row-major matrix: storage and access, no algorithms.

use crate::scalar::{Real, Scalar};
use std::ops::{Index, IndexMut};

/// A dense matrix, rows one after the other. Symmetric matrices have both triangles.
///
/// ```
/// use eigenbody::Matrix;
/// let mut H = Matrix::<f64>::zeros(2, 2);
/// H[(0, 1)] = 3.0;
/// assert_eq!(H.row(0), &[0.0, 3.0]);
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Matrix<T> {
    rows: usize,
    cols: usize,
    data: Vec<T>,
}

impl<T: Scalar> Matrix<T> {
    /// All zeros.
    pub fn zeros(rows: usize, cols: usize) -> Self {
        Self { rows, cols, data: vec![T::ZERO; rows * cols] }
    }

    /// Ones on the diagonal.
    pub fn identity(n: usize) -> Self {
        Self::from_fn(n, n, |i, j| if i == j { T::ONE } else { T::ZERO })
    }

    /// Entry (i, j) = `f(i, j)`.
    pub fn from_fn(rows: usize, cols: usize, f: impl Fn(usize, usize) -> T) -> Self {
        let data = (0..rows * cols).map(|k| f(k / cols, k % cols)).collect();
        Self { rows, cols, data }
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Number of columns.
    pub fn cols(&self) -> usize {
        self.cols
    }

    /// Row i.
    pub fn row(&self, i: usize) -> &[T] {
        &self.data[i * self.cols..(i + 1) * self.cols]
    }

    /// Row i, to be written.
    pub fn row_mut(&mut self, i: usize) -> &mut [T] {
        &mut self.data[i * self.cols..(i + 1) * self.cols]
    }

    /// All entries, row after row.
    pub fn as_slice(&self) -> &[T] {
        &self.data
    }

    /// All entries, by rows.
    pub(crate) fn as_rows(&mut self) -> Rows<'_, T> {
        Rows { stride: self.cols, numbers: &mut self.data }
    }

    /// Sets every entry.
    pub fn fill(&mut self, value: T) {
        self.data.fill(value);
    }

    /// Two different rows, the first read, the second written.
    pub(crate) fn row_pair(&mut self, read: usize, write: usize) -> (&[T], &mut [T]) {
        let n = self.cols;
        if read < write {
            let (head, tail) = self.data.split_at_mut(write * n);
            (&head[read * n..(read + 1) * n], &mut tail[..n])
        } else {
            let (head, tail) = self.data.split_at_mut(read * n);
            (&tail[..n], &mut head[write * n..(write + 1) * n])
        }
    }

    /// Rows i and i + 1, both written.
    pub(crate) fn two_rows_mut(&mut self, i: usize) -> (&mut [T], &mut [T]) {
        let n = self.cols;
        self.data[i * n..(i + 2) * n].split_at_mut(n)
    }

    /// H x.
    pub fn times(&self, x: &[T]) -> Vec<T> {
        (0..self.rows).map(|i| dot(self.row(i), x)).collect()
    }
}

impl<T: Real> Matrix<T> {
    /// Largest absolute entry.
    pub fn max_abs(&self) -> f64 {
        self.data.iter().fold(0.0, |m, x| m.max(x.to_f64().abs()))
    }
}

/// A square matrix in someone's memory.
pub(crate) struct Rows<'a, T> {
    pub numbers: &'a mut [T],
    /// From one row to the next.
    pub stride: usize,
}

/// xᵀ y.
#[inline]
pub(crate) fn dot<T: Scalar>(x: &[T], y: &[T]) -> T {
    x.iter().zip(y).fold(T::ZERO, |sum, (&a, &b)| a.mul_add(b, sum))
}

impl<T> Index<(usize, usize)> for Matrix<T> {
    type Output = T;
    #[inline(always)]
    fn index(&self, (i, j): (usize, usize)) -> &T {
        &self.data[i * self.cols + j]
    }
}

impl<T> IndexMut<(usize, usize)> for Matrix<T> {
    #[inline(always)]
    fn index_mut(&mut self, (i, j): (usize, usize)) -> &mut T {
        &mut self.data[i * self.cols + j]
    }
}

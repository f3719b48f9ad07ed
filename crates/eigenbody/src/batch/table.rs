//! Numbers of many configurations, in one of two orders, and parts of them for the threads.

use super::turn;
use crate::scalar::{MOST_LANES, Scalar, Wide};

/// How the numbers of k configurations follow one another, n of each.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Order {
    /// One configuration after the other: k × n, row-major.
    #[default]
    Rows,
    /// One number of all configurations after the other: n × k, row-major. Registers are then loaded as they stand.
    Columns,
}

/// Numbers of some configurations.
#[doc(hidden)]
#[allow(missing_debug_implementations)]
pub enum Table<'a, T> {
    Rows(&'a [T]),
    /// Each number of all of them.
    Columns(Vec<&'a [T]>),
}

/// The same, to be written.
#[doc(hidden)]
#[allow(missing_debug_implementations)]
pub enum TableMut<'a, T> {
    Rows(&'a mut [T]),
    Columns(Vec<&'a mut [T]>),
}

impl Order {
    /// Parts of `chunk` configurations of `count`, each of `n` numbers.
    pub(super) fn parts<T>(self, x: &[T], n: usize, count: usize, chunk: usize) -> Vec<Table<'_, T>> {
        if n * count == 0 {
            return (0..count.div_ceil(chunk)).map(|_| Table::Rows(&[])).collect();
        }
        match self {
            Self::Rows => x.chunks(n * chunk).map(Table::Rows).collect(),
            Self::Columns => {
                let mut parts: Vec<_> = (0..count.div_ceil(chunk)).map(|_| Vec::with_capacity(n)).collect();
                for column in x.chunks(count) {
                    parts.iter_mut().zip(column.chunks(chunk)).for_each(|(part, some)| part.push(some));
                }
                parts.into_iter().map(Table::Columns).collect()
            }
        }
    }

    /// The same, to be written.
    pub(super) fn parts_mut<T>(self, x: &mut [T], n: usize, count: usize, chunk: usize) -> Vec<TableMut<'_, T>> {
        if n * count == 0 {
            return (0..count.div_ceil(chunk)).map(|_| TableMut::Rows(&mut [])).collect();
        }
        match self {
            Self::Rows => x.chunks_mut(n * chunk).map(TableMut::Rows).collect(),
            Self::Columns => {
                let mut parts: Vec<_> = (0..count.div_ceil(chunk)).map(|_| Vec::with_capacity(n)).collect();
                for column in x.chunks_mut(count) {
                    parts.iter_mut().zip(column.chunks_mut(chunk)).for_each(|(part, some)| part.push(some));
                }
                parts.into_iter().map(TableMut::Columns).collect()
            }
        }
    }

    /// The numbers of configuration k.
    pub(super) fn row<T: Copy>(self, x: &[T], k: usize, n: usize, count: usize) -> Vec<T> {
        match self {
            Self::Rows => x[k * n..][..n].to_vec(),
            Self::Columns => (0..n).map(|j| x[j * count + k]).collect(),
        }
    }
}

impl<T: Scalar> Table<'_, T> {
    /// Configurations from `first` on, of `n` numbers, one a lane; the last one again where there are fewer than lanes. `out` comes from
    /// [`turn::room`].
    #[inline(always)]
    pub(super) fn into_lanes<W: Wide<Constant = T>>(&self, first: usize, n: usize, lanes: usize, out: &mut [W]) {
        match self {
            Self::Rows(x) => turn::into_lanes(&x[first * n..], n, lanes, out),
            Self::Columns(columns) => {
                for (out, column) in out.iter_mut().zip(columns) {
                    *out = match lanes == W::WIDTH {
                        true => W::from_slice(&column[first..]),
                        false => few(&column[first..first + lanes]),
                    };
                }
            }
        }
    }

    /// The numbers of configuration k.
    pub(super) fn row(&self, k: usize, n: usize) -> Vec<T> {
        match self {
            Self::Rows(x) => x[k * n..][..n].to_vec(),
            Self::Columns(columns) => columns.iter().map(|column| column[k]).collect(),
        }
    }
}

impl<T: Scalar> TableMut<'_, T> {
    /// Number j of configuration `first` + l, of `n`, is lane l of `x[j]`. `x` comes from [`turn::room`].
    #[inline(always)]
    pub(super) fn from_lanes<W: Wide<Constant = T>>(&mut self, x: &[W], n: usize, first: usize, lanes: usize) {
        match self {
            Self::Rows(rows) => turn::from_lanes(x, n, lanes, &mut rows[first * n..]),
            Self::Columns(columns) => {
                for (column, &x) in columns.iter_mut().zip(x) {
                    put(x, column, first, lanes);
                }
            }
        }
    }

    /// Number j of configuration `first` + l is lane l of `x[places[j]]`.
    #[inline(always)]
    pub(super) fn from_places<W: Wide<Constant = T>>(
        &mut self,
        x: &[W],
        places: &[u32],
        first: usize,
        lanes: usize,
    ) {
        match self {
            Self::Rows(rows) => turn::from_places(x, places, lanes, &mut rows[first * places.len()..]),
            Self::Columns(columns) => {
                for (column, &place) in columns.iter_mut().zip(places) {
                    put(x[place as usize], column, first, lanes);
                }
            }
        }
    }
}

/// The first `lanes` numbers of a register.
#[inline(always)]
fn put<W: Wide>(x: W, column: &mut [W::Constant], first: usize, lanes: usize) {
    if lanes == W::WIDTH {
        x.to_slice(&mut column[first..]);
    } else {
        let mut numbers = [<W::Constant as Scalar>::ZERO; MOST_LANES];
        x.to_slice(&mut numbers);
        column[first..first + lanes].copy_from_slice(&numbers[..lanes]);
    }
}

/// Fewer numbers than lanes, the last of them again.
#[inline(always)]
fn few<W: Wide>(x: &[W::Constant]) -> W {
    let mut numbers = [<W::Constant as Scalar>::ZERO; MOST_LANES];
    for (l, number) in numbers.iter_mut().enumerate() {
        *number = x[l.min(x.len() - 1)];
    }
    W::from_slice(&numbers)
}

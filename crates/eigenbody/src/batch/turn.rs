//! Rows of numbers into lanes and back: row l of a group is lane l.

use crate::scalar::{MOST_LANES, Scalar, Wide};
use std::ops::Range;

/// Numbers that are turned at once.
const BLOCK: usize = 4;
/// How far ahead of what is written its memory is asked for, in bytes. Rows of a group are long and lie apart: nothing else foresees them.
const AHEAD: usize = 64;

/// Room for `n` values in lanes, and for whole registers of them at least.
pub(super) fn room<W: Wide>(n: usize) -> Vec<W> {
    vec![W::ZERO; n.max(W::WIDTH)]
}

/// Rows of `n` numbers into lanes; where there are fewer rows than lanes the last row is repeated.
#[inline(always)]
pub(super) fn into_lanes<W: Wide>(x: &[W::Constant], n: usize, lanes: usize, out: &mut [W]) {
    let (Some(last), true) = (n.checked_sub(BLOCK), lanes == W::WIDTH) else {
        return few_into_lanes(x, n, lanes, out);
    };
    let mut rows: [&[W::Constant]; MOST_LANES] = [&[]; MOST_LANES];
    let mut rest = x;
    for row in &mut rows[..W::WIDTH] {
        (*row, rest) = rest.split_at(n);
    }
    let out = &mut out[..n];
    let mut first = 0;
    while first < n {
        // The last block may meet the one before it.
        let at = first.min(last);
        out[at..at + BLOCK].copy_from_slice(&W::gather(&rows, at));
        first += BLOCK;
    }
}

/// Lanes into rows of `n` numbers: number j of row l is lane l of `x[j]`, `x` from [`room`].
#[inline(always)]
pub(super) fn from_lanes<W: Wide>(x: &[W], n: usize, lanes: usize, out: &mut [W::Constant]) {
    part_from_lanes(x, 0..n, n, lanes, out);
}

/// Some numbers of rows of `n`: number j of `part` and of row l is lane l of `x[j]`.
#[inline(always)]
pub(super) fn part_from_lanes<W: Wide>(
    x: &[W],
    part: Range<usize>,
    n: usize,
    lanes: usize,
    out: &mut [W::Constant],
) {
    if lanes == W::WIDTH && W::WIDTH >= BLOCK && part.len() >= W::WIDTH {
        blocks_from_lanes(&x[..part.len()], part, n, out);
    } else if lanes == W::WIDTH && W::WIDTH >= BLOCK && part.len() == n {
        short_from_lanes(x, n, out);
    } else {
        few_from_lanes(x, part, n, lanes, out);
    }
}

/// The same from any of the values: number j of row l is lane l of `x[places[j]]`.
#[inline(always)]
pub(super) fn from_places<W: Wide>(x: &[W], places: &[u32], lanes: usize, out: &mut [W::Constant]) {
    if lanes < W::WIDTH || W::WIDTH < BLOCK || places.len() < W::WIDTH {
        few_from_places(x, places, lanes, out);
    } else {
        blocks_from_lanes(Chosen(x, places), 0..places.len(), places.len(), out);
    }
}

/// Where values to be turned come from.
trait Values<W: Wide>: Copy {
    /// As many as a register holds, from number `at` on; in `room`, if they do not stand side by side.
    fn block<'a>(&'a self, at: usize, room: &'a mut [W; MOST_LANES]) -> &'a [W];
}

impl<W: Wide> Values<W> for &[W] {
    #[inline(always)]
    fn block<'a>(&'a self, at: usize, _: &'a mut [W; MOST_LANES]) -> &'a [W] {
        &self[at..at + W::WIDTH]
    }
}

/// Values at places.
#[derive(Clone, Copy)]
struct Chosen<'a, W>(&'a [W], &'a [u32]);

impl<W: Wide> Values<W> for Chosen<'_, W> {
    #[inline(always)]
    fn block<'a>(&'a self, at: usize, room: &'a mut [W; MOST_LANES]) -> &'a [W] {
        for (value, &place) in room.iter_mut().zip(&self.1[at..at + W::WIDTH]) {
            *value = self.0[place as usize];
        }
        &room[..W::WIDTH]
    }
}

/// Some numbers of rows of `n`, a register at a time.
#[inline(always)]
fn blocks_from_lanes<W: Wide>(x: impl Values<W>, part: Range<usize>, n: usize, out: &mut [W::Constant]) {
    let mut rows: [&mut [W::Constant]; MOST_LANES] = Default::default();
    let (mut rest, count) = (&mut out[part.start..], part.len());
    for row in &mut rows[..W::WIDTH - 1] {
        let (whole, others) = rest.split_at_mut(n);
        (*row, rest) = (&mut whole[..count], others);
    }
    rows[W::WIDTH - 1] = &mut rest[..count];
    let (mut room, mut first) = ([W::ZERO; MOST_LANES], 0);
    while first < count {
        // The last block may meet the one before it.
        let at = first.min(count - W::WIDTH);
        let values = x.block(at, &mut room);
        for (quarter, rows) in rows[..W::WIDTH].chunks_exact_mut(BLOCK).enumerate() {
            for (row, x) in rows.iter_mut().zip(turned(values, BLOCK * quarter)) {
                x.to_slice(&mut row[at..]);
                W::announce(row, at + AHEAD / size_of::<W::Constant>());
            }
        }
        first += W::WIDTH;
    }
}

/// Rows shorter than a register: what it reaches into is written later, but for the last row's.
#[inline(always)]
fn short_from_lanes<W: Wide>(x: &[W], n: usize, out: &mut [W::Constant]) {
    if out.len() < (W::WIDTH - 1) * n + W::WIDTH {
        return few_from_lanes(x, 0..n, n, W::WIDTH, out);
    }
    let mut rest = out;
    for quarter in 0..W::WIDTH / BLOCK {
        for row in turned(x, BLOCK * quarter) {
            row.to_slice(rest);
            rest = &mut rest[n..];
        }
    }
}

/// Lanes from `first` on of as many values as a register holds.
#[inline(always)]
fn turned<W: Wide>(x: &[W], first: usize) -> [W; BLOCK] {
    let mut values = [&x[0]; MOST_LANES];
    for k in 0..W::WIDTH {
        values[k] = &x[k];
    }
    W::turn(&values, first)
}

#[cold]
#[inline(never)]
fn few_into_lanes<W: Wide>(x: &[W::Constant], n: usize, lanes: usize, out: &mut [W]) {
    for (j, out) in out[..n].iter_mut().enumerate() {
        let mut numbers = [W::Constant::ZERO; MOST_LANES];
        for (lane, number) in numbers[..W::WIDTH].iter_mut().enumerate() {
            *number = x[lane.min(lanes - 1) * n + j];
        }
        *out = W::from_slice(&numbers);
    }
}

#[cold]
#[inline(never)]
fn few_from_lanes<W: Wide>(x: &[W], part: Range<usize>, n: usize, lanes: usize, out: &mut [W::Constant]) {
    for (j, x) in part.zip(x) {
        let mut numbers = [W::Constant::ZERO; MOST_LANES];
        x.to_slice(&mut numbers);
        for (lane, &number) in numbers[..lanes].iter().enumerate() {
            out[lane * n + j] = number;
        }
    }
}

#[cold]
#[inline(never)]
fn few_from_places<W: Wide>(x: &[W], places: &[u32], lanes: usize, out: &mut [W::Constant]) {
    for (j, &place) in places.iter().enumerate() {
        let mut numbers = [W::Constant::ZERO; MOST_LANES];
        x[place as usize].to_slice(&mut numbers);
        for (lane, &number) in numbers[..lanes].iter().enumerate() {
            out[lane * places.len() + j] = number;
        }
    }
}

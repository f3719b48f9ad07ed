//! Rows of numbers into lanes and back: row l of a group is lane l.

use crate::scalar::{MOST_LANES, Scalar, Wide};

/// Numbers that are turned at once.
const BLOCK: usize = 4;

/// Room for `n` values in lanes, whole blocks.
pub(super) fn room<W: Scalar>(n: usize) -> Vec<W> {
    vec![W::ZERO; n.next_multiple_of(BLOCK)]
}

/// Rows of `n` numbers into lanes; where there are fewer rows than lanes the last row is repeated. `out` comes from [`room`].
#[inline(always)]
pub(super) fn into_lanes<W: Wide>(rows: &[W::Constant], n: usize, lanes: usize, out: &mut [W]) {
    let mut at = [0; MOST_LANES];
    for (lane, at) in at.iter_mut().enumerate() {
        *at = lane.min(lanes - 1) * n;
    }
    // A block may reach into the row after its own, whose numbers then stand beyond the first n, but not beyond the last row.
    let whole = if lanes * n + BLOCK <= rows.len() { n } else { n / BLOCK * BLOCK };
    let (blocks, rest) = out.split_at_mut(whole.next_multiple_of(BLOCK));
    for out in blocks.chunks_exact_mut(BLOCK) {
        out.copy_from_slice(&W::gather(rows, &at));
        for at in &mut at {
            *at += BLOCK;
        }
    }
    let mut buffer = [<W::Constant as Scalar>::ZERO; MOST_LANES];
    for (j, out) in rest[..n - whole].iter_mut().enumerate() {
        for (number, at) in buffer.iter_mut().zip(&at) {
            *number = rows[at + j];
        }
        *out = W::from_slice(&buffer);
    }
}

/// Lanes into rows of as many numbers as there are `places`: number j of row l is lane l of `x[places[j]]`.
#[inline(always)]
pub(super) fn from_lanes<W: Wide>(x: &[W], places: &[u32], lanes: usize, rows: &mut [W::Constant]) {
    let (n, width) = (places.len(), W::WIDTH);
    let mut at = [0; MOST_LANES];
    // A few rows from beginning to end: whole lines of memory, one after the other.
    let mut lane = 0;
    while lane < lanes {
        let mut first = 0;
        while first < n {
            // The last block overlaps the one before it. Where a row is shorter than a block the block reaches into the rows after its
            // own, which are written later.
            let j = first.min(n.saturating_sub(width));
            for (k, at) in at[..width].iter_mut().enumerate() {
                *at = places[(j + k).min(n - 1)] as usize;
            }
            for (k, row) in W::turn(x, &at, lane).into_iter().enumerate() {
                if lane + k < lanes {
                    write(row, &mut rows[(lane + k) * n + j..]);
                }
            }
            first += width;
        }
        lane += BLOCK;
    }
}

/// As many numbers as there is room for.
#[inline(always)]
fn write<W: Wide>(x: W, out: &mut [W::Constant]) {
    if out.len() >= W::WIDTH {
        x.to_slice(out);
    } else {
        let mut buffer = [<W::Constant as Scalar>::ZERO; MOST_LANES];
        x.to_slice(&mut buffer);
        for (out, &number) in out.iter_mut().zip(&buffer) {
            *out = number;
        }
    }
}

//! H, τ and v̇ of a group of configurations.

use super::layout::Layout;
use super::mass::Columns;
use super::turn::{self, from_lanes, from_places, into_lanes, part_from_lanes};
use super::{AbaWorkspace, Faults, GROUP, Kernel, RneaWorkspace};
use crate::dynamics::{Aba, Rnea};
use crate::error::{Error, NotPositiveDefinite};
use crate::model::Model;
use crate::scalar::{Batched, Real, Scalar, Wide};
use std::ops::Range;

/// H, both triangles.
#[doc(hidden)]
#[allow(missing_debug_implementations)]
pub struct Masses<'a, T> {
    /// In one piece.
    pub(super) layout: &'a Layout,
    /// Which entry each number is.
    pub(super) places: &'a [u32],
    pub(super) H: &'a mut [T],
}

impl<T: Batched> Kernel<T> for Masses<'_, T> {
    type Room<W: Wide<Constant = T>> = Columns<W>;

    fn split_at(self, _: &Model<T>, count: usize) -> (Self, Self) {
        let (H, others) = self.H.split_at_mut(count * self.places.len());
        (Self { H, ..self }, Self { H: others, ..self })
    }

    #[inline(always)]
    fn room<W: Wide<Constant = T>>(&self, model: &Model<T>) -> Columns<W> {
        Columns::new(model, self.layout)
    }

    #[inline(always)]
    fn group<W: Wide<Constant = T>>(
        &mut self,
        model: &Model<T>,
        q: &[W],
        group: Range<usize>,
        columns: &mut Columns<W>,
        _: &mut Faults<W>,
        _: &mut Option<(usize, Error)>,
    ) {
        let (first, lanes) = (group.start, group.len());
        let H = columns.update(model, self.layout, q);
        from_places(H, self.places, lanes, &mut self.H[first * self.places.len()..]);
    }
}

/// Entries of H.
#[doc(hidden)]
#[allow(missing_debug_implementations)]
pub struct Entries<'a, T> {
    pub(super) layout: &'a Layout,
    pub(super) entries: &'a mut [T],
}

/// Columns of a layout in pieces, where they do not last.
pub(super) struct Passing<W: Wide>(Columns<W>);

impl<T: Batched> Kernel<T> for Entries<'_, T> {
    type Room<W: Wide<Constant = T>> = Passing<W>;

    fn split_at(self, _: &Model<T>, count: usize) -> (Self, Self) {
        let (entries, others) = self.entries.split_at_mut(count * self.layout.entries());
        (Self { entries, ..self }, Self { entries: others, ..self })
    }

    #[inline(always)]
    fn room<W: Wide<Constant = T>>(&self, model: &Model<T>) -> Passing<W> {
        Passing(Columns::new(model, self.layout))
    }

    #[inline(always)]
    fn group<W: Wide<Constant = T>>(
        &mut self,
        model: &Model<T>,
        q: &[W],
        group: Range<usize>,
        Passing(columns): &mut Passing<W>,
        _: &mut Faults<W>,
        _: &mut Option<(usize, Error)>,
    ) {
        let (first, lanes, n) = (group.start, group.len(), self.layout.entries());
        let out = &mut self.entries[first * n..];
        columns.bend(model, q);
        for piece in &self.layout.pieces {
            let entries = columns.piece(model, self.layout, piece, q);
            part_from_lanes(entries, piece.first..piece.first + piece.at.len(), n, lanes, out);
        }
    }
}

/// τ.
#[doc(hidden)]
#[allow(missing_debug_implementations)]
pub struct Inverse<'a, T> {
    pub(super) v: &'a [T],
    pub(super) vdot: &'a [T],
    pub(super) tau: &'a mut [T],
}

/// A workspace, and v, v̇ or τ, and the result in lanes.
pub(super) struct Room<K, W> {
    workspace: K,
    v: Vec<W>,
    given: Vec<W>,
    found: Vec<W>,
}

impl<K, W: Wide> Room<K, W> {
    fn new(workspace: K, nv: usize) -> Self {
        let (v, given, found) = (turn::room(nv), turn::room(nv), turn::room(nv));
        Self { workspace, v, given, found }
    }
}

impl<T: Batched> Kernel<T> for Inverse<'_, T> {
    type Room<W: Wide<Constant = T>> = Room<RneaWorkspace<W>, W>;

    fn split_at(self, model: &Model<T>, count: usize) -> (Self, Self) {
        let at = count * model.nv();
        let ((v, vs), (vdot, vdots), (tau, taus)) =
            (self.v.split_at(at), self.vdot.split_at(at), self.tau.split_at_mut(at));
        (Self { v, vdot, tau }, Self { v: vs, vdot: vdots, tau: taus })
    }

    #[inline(always)]
    fn room<W: Wide<Constant = T>>(&self, model: &Model<T>) -> Self::Room<W> {
        Room::new(RneaWorkspace::new(model), model.nv())
    }

    #[inline(always)]
    fn group<W: Wide<Constant = T>>(
        &mut self,
        model: &Model<T>,
        q: &[W],
        group: Range<usize>,
        Room { workspace, v, given, found }: &mut Self::Room<W>,
        faults: &mut Faults<W>,
        _: &mut Option<(usize, Error)>,
    ) {
        let (nv, first, lanes) = (model.nv(), group.start, group.len());
        into_lanes(&self.v[first * nv..], nv, lanes, v);
        into_lanes(&self.vdot[first * nv..], nv, lanes, given);
        faults.look_at(&v[..nv]);
        faults.look_at(&given[..nv]);
        Rnea { model, q, v, vdot: given, workspace, tau: found }.sweep::<W>();
        from_lanes(found, nv, lanes, &mut self.tau[first * nv..]);
    }
}

/// v̇.
#[doc(hidden)]
#[allow(missing_debug_implementations)]
pub struct Forward<'a, T> {
    pub(super) v: &'a [T],
    pub(super) tau: &'a [T],
    pub(super) vdot: &'a mut [T],
}

impl<T: Batched> Kernel<T> for Forward<'_, T> {
    type Room<W: Wide<Constant = T>> = Room<AbaWorkspace<W>, W>;

    fn split_at(self, model: &Model<T>, count: usize) -> (Self, Self) {
        let at = count * model.nv();
        let ((v, vs), (tau, taus), (vdot, vdots)) =
            (self.v.split_at(at), self.tau.split_at(at), self.vdot.split_at_mut(at));
        (Self { v, tau, vdot }, Self { v: vs, tau: taus, vdot: vdots })
    }

    #[inline(always)]
    fn room<W: Wide<Constant = T>>(&self, model: &Model<T>) -> Self::Room<W> {
        Room::new(AbaWorkspace::new(model), model.nv())
    }

    #[inline(always)]
    fn group<W: Wide<Constant = T>>(
        &mut self,
        model: &Model<T>,
        q: &[W],
        group: Range<usize>,
        Room { workspace, v, given, found }: &mut Self::Room<W>,
        faults: &mut Faults<W>,
        failed: &mut Option<(usize, Error)>,
    ) {
        let (nv, first, lanes) = (model.nv(), group.start, group.len());
        into_lanes(&self.v[first * nv..], nv, lanes, v);
        into_lanes(&self.tau[first * nv..], nv, lanes, given);
        faults.look_at(&v[..nv]);
        faults.look_at(&given[..nv]);
        Aba { model, q, v, tau: given, workspace, vdot: found }.sweep::<W>();
        from_lanes(found, nv, lanes, &mut self.vdot[first * nv..]);
        if failed.is_none() && !all_positive(workspace.pivots()) {
            *failed = first_bad(model, workspace.pivots(), lanes).map(|(lane, error)| (first + lane, error));
        }
    }
}

/// That no pivot is zero, negative, infinite or not a number.
#[inline(always)]
fn all_positive<W: Wide>(D: &[W]) -> bool {
    let mut faults = W::ZERO;
    for &D in D {
        // 0 D is zero for a finite number and for no other; a comparison with what is not a number chooses the last.
        let finite = (D * W::ZERO).abs().select_lt(W::ONE, W::ZERO, W::ONE);
        faults += W::ZERO.select_lt(D, finite, W::ONE);
    }
    !faults.any_above(W::Constant::from_f64(0.0))
}

/// The first lane with a bad pivot, and the first of its pivots, tips first.
#[cold]
#[inline(never)]
fn first_bad<W: Wide>(model: &Model<W::Constant>, D: &[W], lanes: usize) -> Option<(usize, Error)> {
    let zero = W::Constant::from_f64(0.0);
    let mut buffer = [zero; GROUP];
    for lane in 0..lanes {
        for dof in model.dofs().order().rev() {
            D[dof].to_slice(&mut buffer);
            let pivot = buffer[lane];
            if !(pivot > zero && pivot.is_finite()) {
                return Some((lane, NotPositiveDefinite { dof, pivot: pivot.to_f64() }.into()));
            }
        }
    }
    None
}

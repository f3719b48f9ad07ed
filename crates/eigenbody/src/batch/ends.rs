//! λmin, λmax and κ′ of a group of configurations: from the matrices, side by side, as far as those know them.

use super::layout::Layout;
use super::mass::Columns;
use super::{Faults, GROUP, Kernel};
use crate::conditioning::Values;
use crate::error::Error;
use crate::model::Model;
use crate::scalar::{Two, Wide};
use crate::spectrum::sturm::Pencil;
use crate::spectrum::{Metric, Packed, Precision, extremes_from};
use std::ops::Range;

/// Up to so many rows, two triangles fit into the nearest memory, and both metrics are taken together.
const TOGETHER: usize = 20;

/// Largest eigenvalues whose matrices, squared, stay within the range of numbers.
const RANGE: Range<f64> = 1e-100..1e100;

/// What is asked of every configuration.
pub(super) struct Spectra<'a> {
    pub q: &'a [f64],
    pub layout: &'a Layout,
    pub metric: &'a Metric<f64>,
    /// B of every DoF, and B^-½ by place in pre-order; of no meaning in the unit-diagonal metric.
    pub weights: &'a [f64],
    pub units: &'a [f64],
    /// κ′ as well.
    pub weighted: bool,
    /// Relative error of λmin up to which the matrix is asked.
    pub accuracy: f64,
    pub out: &'a mut [Values],
}

/// H, matrices to be reduced, alone or two by two, and the units B^-½ and H_dd^-½ of every DoF, by place in pre-order.
pub(super) struct Room<W: Wide> {
    columns: Columns<W>,
    one: Packed<W>,
    two: Packed<Two<W>>,
    units: Vec<W>,
    own: Vec<W>,
}

impl Spectra<'_> {
    /// H and the metric's λ and H's own are both asked for, and small.
    fn together(&self) -> bool {
        self.weighted && *self.metric != Metric::UnitDiagonal && self.layout.nv <= TOGETHER
    }
}

impl Kernel<f64> for Spectra<'_> {
    type Room<W: Wide<Constant = f64>> = Room<W>;

    fn split_at(self, model: &Model<f64>, count: usize) -> (Self, Self) {
        let (q, others) = self.q.split_at(count * model.nq());
        let (out, rest) = self.out.split_at_mut(count);
        (Self { q, out, ..self }, Self { q: others, out: rest, ..self })
    }

    #[inline(always)]
    fn room<W: Wide<Constant = f64>>(&self, model: &Model<f64>) -> Room<W> {
        let nv = model.nv();
        Room {
            columns: Columns::new(model, self.layout),
            one: Packed::new(nv),
            two: Packed::new(if nv <= TOGETHER { nv } else { 0 }),
            units: vec![W::ZERO; nv],
            own: vec![W::ZERO; nv],
        }
    }

    #[inline(always)]
    fn group<W: Wide<Constant = f64>>(
        &mut self,
        model: &Model<f64>,
        q: &[W],
        group: Range<usize>,
        Room { columns, one, two, units, own }: &mut Room<W>,
        _: &mut Faults<W>,
        failed: &mut Option<(usize, Error)>,
    ) {
        let (layout, triangle) = (self.layout, self.layout.triangle());
        for (unit, &number) in units.iter_mut().zip(self.units) {
            *unit = W::constant(number);
        }
        let H = columns.update(model, layout, q);
        let unit_diagonal = *self.metric == Metric::UnitDiagonal;
        let weighted = self.weighted || unit_diagonal;
        if weighted {
            for (d, own) in own.iter_mut().enumerate() {
                *own = W::ONE / H[layout.diagonal(d)].sqrt();
            }
        }
        // λmin and λmax in the metric and in units of H's own diagonal.
        let nothing = [W::ZERO; 2];
        let (ends, own_ends) = if self.together() {
            let mut entries = two.A.iter_mut().zip(triangle);
            for (i, (&unit_i, &own_i)) in units.iter().zip(&*own).enumerate() {
                let row = entries.by_ref().take(i + 1);
                for ((a, &place), (&unit, &own)) in row.zip(units.iter().zip(&*own)) {
                    let H = H[place as usize];
                    *a = Two(H * (unit_i * unit), H * (own_i * own));
                }
            }
            let [min, max] = two.ends();
            ([min.0, max.0], [min.1, max.1])
        } else if unit_diagonal {
            let found = scaled_ends(one, H, triangle, own);
            (found, found)
        } else {
            let found = scaled_ends(one, H, triangle, units);
            (found, if weighted { scaled_ends(one, H, triangle, own) } else { nothing })
        };
        let mut numbers = [[0.0; GROUP]; 4];
        for (numbers, x) in numbers.iter_mut().zip([ends[0], ends[1], own_ends[0], own_ends[1]]) {
            x.to_slice(numbers);
        }
        let [min, max, own_min, own_max] = numbers;
        for (lane, k) in group.enumerate() {
            let found = Values {
                lambda_min: min[lane],
                lambda_max: max[lane],
                kappa_weighted: if weighted { own_max[lane] / own_min[lane] } else { f64::NAN },
            };
            let all_known =
                self.known(min[lane], max[lane]) && (!weighted || self.known(own_min[lane], own_max[lane]));
            if all_known {
                self.out[k] = found;
                continue;
            }
            let q = &self.q[k * model.nq()..][..model.nq()];
            match by_counts(model, q, self.metric, self.weights, weighted) {
                Ok(values) => self.out[k] = values,
                Err(error) => {
                    failed.get_or_insert((k, error));
                }
            }
        }
    }
}

impl Spectra<'_> {
    /// That rounding leaves λmin as good as asked. A ratio that is not a number is not known either.
    #[inline(always)]
    fn known(&self, least: f64, largest: f64) -> bool {
        RANGE.contains(&largest) && self.layout.nv as f64 * f64::EPSILON * largest <= self.accuracy * least
    }
}

/// Both ends of H with every degree of freedom in its unit.
#[inline(always)]
fn scaled_ends<W: Wide>(room: &mut Packed<W>, H: &[W], triangle: &[u32], units: &[W]) -> [W; 2] {
    let mut entries = room.A.iter_mut().zip(triangle);
    for (i, &unit_i) in units.iter().enumerate() {
        for ((a, &place), &unit) in entries.by_ref().take(i + 1).zip(units) {
            *a = H[place as usize] * (unit_i * unit);
        }
    }
    room.ends()
}

/// The same from the tree, whatever κ.
#[cold]
#[inline(never)]
fn by_counts(
    model: &Model<f64>,
    q: &[f64],
    metric: &Metric<f64>,
    weights: &[f64],
    weighted: bool,
) -> Result<Values, Error> {
    let pencil = Pencil::euclidean(model, q, false)?;
    let own = pencil.diagonal();
    let has_zero = own.iter().any(|&h| h <= 0.0);
    let ends_in = |pencil: Pencil<'_, f64>| -> Result<(f64, f64), Error> {
        let found = extremes_from(&pencil, &own, Precision::Auto)?;
        Ok((found.min.map_or(0.0, |min| min.value), found.max.value))
    };
    let unit_diagonal = *metric == Metric::UnitDiagonal;
    let weights = if unit_diagonal { pencil.weights(metric, &own)? } else { weights.to_vec() };
    let (min, max) = ends_in(pencil.clone().with_metric(weights)?)?;
    let kappa_weighted = match (weighted, unit_diagonal) {
        (false, _) => f64::NAN,
        (true, _) if has_zero => f64::INFINITY,
        (true, true) => max / min,
        (true, false) => {
            let (least, largest) = ends_in(pencil.with_metric(own.clone())?)?;
            largest / least
        }
    };
    Ok(Values { lambda_min: min, lambda_max: max, kappa_weighted })
}

//! λmin, λmax and κ′ of a group of configurations: from the matrices, side by side, as far as those know them.

use super::{CrbaWorkspace, GROUP, Kernel};
use crate::conditioning::Values;
use crate::dynamics::{Entries, crba};
use crate::error::Error;
use crate::model::{EMPTY, Model};
use crate::scalar::{Scalar, Wide};
use crate::spectrum::sturm::Pencil;
use crate::spectrum::{EndsWorkspace, Metric, Precision, ends, extremes_from};

/// What is asked of every configuration.
pub(super) struct Spectra<'a> {
    pub q: &'a [f64],
    pub metric: &'a Metric<f64>,
    /// B of every DoF; of no meaning in the unit-diagonal metric.
    pub weights: &'a [f64],
    /// κ′ as well.
    pub weighted: bool,
    /// Relative error of λmin up to which the matrix is asked.
    pub accuracy: f64,
    pub out: &'a mut [Values],
}

/// Workspaces of both algorithms, H, and the units B^-½ of every DoF.
pub(super) struct Room<W> {
    crba: CrbaWorkspace<W>,
    ends: EndsWorkspace<W>,
    H: Vec<W>,
    units: Vec<W>,
}

impl Kernel<f64> for Spectra<'_> {
    /// The first configuration without an answer.
    type Output = Option<(usize, Error)>;
    type Room<W: Wide<Constant = f64>> = Room<W>;

    #[inline(always)]
    fn room<W: Wide<Constant = f64>>(&self, model: &Model<f64>) -> Room<W> {
        let nv = model.nv();
        Room {
            crba: CrbaWorkspace::new(model),
            ends: EndsWorkspace::new(nv),
            H: vec![W::ZERO; nv * nv],
            units: vec![W::ZERO; nv],
        }
    }

    #[inline(always)]
    fn group<W: Wide<Constant = f64>>(
        &mut self,
        model: &Model<f64>,
        q: &[W],
        first: usize,
        lanes: usize,
        Room { crba: workspace, ends: tridiagonal, H, units }: &mut Room<W>,
        failed: &mut Option<(usize, Error)>,
    ) {
        let nv = model.nv();
        crba::<W, _>(model, q, workspace, &mut Full { H, nv });
        let unit_diagonal = *self.metric == Metric::UnitDiagonal;
        let (mut min, mut max) = ([0.0; GROUP], [0.0; GROUP]);
        let mut own = [[0.0; GROUP]; 2];
        let passes = if self.weighted && !unit_diagonal { 2 } else { 1 };
        for pass in 0..passes {
            let weighted = unit_diagonal || pass == 1;
            for (d, unit) in units.iter_mut().enumerate() {
                let B = if weighted { H[d * nv + d] } else { W::constant(self.weights[d]) };
                *unit = W::ONE / B.sqrt();
            }
            for d in 0..nv {
                for (e, scaled) in tridiagonal.row_mut(d)[..nv].iter_mut().enumerate() {
                    *scaled = H[d * nv + e] * units[d] * units[e];
                }
            }
            let [least, largest] = ends::<W>(tridiagonal);
            if pass == 0 {
                least.to_slice(&mut min);
                largest.to_slice(&mut max);
            }
            if weighted {
                least.to_slice(&mut own[0]);
                largest.to_slice(&mut own[1]);
            }
        }
        for lane in 0..lanes {
            let k = first + lane;
            // A ratio that is not a number is not known either.
            let known =
                |least: f64, largest: f64| nv as f64 * f64::EPSILON * largest <= self.accuracy * least;
            let weighted = self.weighted || unit_diagonal;
            let all_known = known(min[lane], max[lane]) && (!weighted || known(own[0][lane], own[1][lane]));
            let found = Values {
                lambda_min: min[lane],
                lambda_max: max[lane],
                kappa_weighted: if weighted { own[1][lane] / own[0][lane] } else { f64::NAN },
            };
            if all_known {
                self.out[k] = found;
                continue;
            }
            let q = &self.q[k * model.nq()..][..model.nq()];
            match by_counts(model, q, self.metric, self.weights, self.weighted || unit_diagonal) {
                Ok(values) => self.out[k] = values,
                Err(error) => {
                    failed.get_or_insert((k, error));
                }
            }
        }
    }
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
    let pencil = Pencil::new(model, q, vec![1.0; model.nv()])?;
    let own = pencil.diagonal();
    let has_zero = own.iter().any(|&h| h <= 0.0);
    let ends_in = |pencil: Pencil<f64>| -> Result<(f64, f64), Error> {
        let found = extremes_from(model, q, &pencil, &own, Precision::Auto)?;
        Ok((found.min.map_or(0.0, |min| min.value), found.max.value))
    };
    let unit_diagonal = *metric == Metric::UnitDiagonal;
    let (min, max) = match unit_diagonal {
        true if has_zero => (0.0, f64::NAN),
        true => ends_in(pencil.clone().with_metric(own.clone())?)?,
        false => ends_in(pencil.clone().with_metric(weights.to_vec())?)?,
    };
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

/// One matrix in lanes, both triangles; entries between branches stay zero.
struct Full<'a, W> {
    H: &'a mut [W],
    nv: usize,
}

impl<W: Scalar> Entries<W> for Full<'_, W> {
    #[inline(always)]
    fn put(&mut self, d: usize, e: usize, H_de: W) {
        self.H[d * self.nv + e] = H_de;
        self.H[e * self.nv + d] = H_de;
    }
    #[inline(always)]
    fn put_all(&mut self, dofs: &[u32], e: usize, H_e: &[W]) {
        for (&d, &H_de) in dofs.iter().zip(H_e) {
            if d != EMPTY {
                self.put(d as usize, e, H_de);
            }
        }
    }
}

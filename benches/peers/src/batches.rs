//! eigenbody's batches: many configurations a call, on one unit of the processor or another, on one core or two.

use std::error::Error;
use std::sync::Arc;
use std::time::Instant;

use eigenbody::batch::{Batch, Lanes};
use eigenbody::conditioning::Values;
use eigenbody::scalar::Unit;
use eigenbody::{Metric, Model};
use rayon::ThreadPool;

use crate::Outcome;
use crate::contest::Contestant;
use crate::robot::{Robot, Sample};

/// Degrees of freedom in a batch, about: states, results and H of one core's share stay in its own memory.
pub const FEW: usize = 8192;
/// The same where threads share: a millisecond and more, beside which it is nothing to wake one.
pub const MANY: usize = 32 * FEW;
/// Relative error of κ asked for.
const ACCURACY: f64 = 1e-8;

/// States of a robot in one precision, and room for results.
pub struct Batches<T> {
    model: Model<T>,
    /// The same in f64, for κ.
    exact: Model<f64>,
    unit: Unit,
    threads: Arc<ThreadPool>,
    /// How much longer than others' its turns are: a system takes some milliseconds to give a second core to a second thread.
    patience: f64,
    count: usize,
    q: Vec<T>,
    v: Vec<T>,
    x: Vec<T>,
    exact_q: Vec<f64>,
    out: Vec<T>,
    H: Vec<T>,
    values: Vec<Values>,
}

impl<T: Lanes> Batches<T> {
    pub fn new(robot: &Robot, unit: Unit, size: usize, threads: usize) -> Result<Self, Box<dyn Error>> {
        let (exact, samples) = (robot.model.clone(), &robot.samples);
        let nv = exact.nv();
        let times = (size / nv).div_ceil(samples.len());
        let count = times * samples.len();
        let all = |of: fn(&Sample) -> &Vec<f64>| {
            samples.iter().flat_map(of).copied().collect::<Vec<f64>>().repeat(times)
        };
        let numbers = |all: Vec<f64>| all.into_iter().map(T::from_f64).collect::<Vec<T>>();
        let exact_q = all(|sample| &sample.q);
        Ok(Self {
            model: exact.cast(),
            unit,
            threads: Arc::new(rayon::ThreadPoolBuilder::new().num_threads(threads).build()?),
            patience: if size == MANY { 20.0 } else { 1.0 },
            count,
            q: numbers(exact_q.clone()),
            v: numbers(all(|sample| &sample.v)),
            x: numbers(all(|sample| &sample.x)),
            exact_q,
            out: vec![T::ZERO; count * nv],
            H: vec![T::ZERO; count * nv * nv],
            values: vec![Values { lambda_min: 0.0, lambda_max: 0.0, kappa_weighted: 0.0 }; count],
            exact,
        })
    }

    fn all(&mut self, quantity: &str) -> Outcome {
        let Self { model, exact, unit, q, v, x, exact_q, out, H, values, .. } = self;
        let batch = Batch::new(model).on(*unit);
        match quantity {
            "rnea" => batch.inverse_dynamics(q, v, x, out)?,
            "aba" => batch.forward_dynamics(q, v, x, out)?,
            "crba" => batch.mass_matrices(q, H)?,
            "entries" => {
                batch.mass_matrix_entries(q, &mut H[..exact_q.len() / exact.nq() * batch.entries().len()])?
            }
            _ => {
                let batch = Batch::new(exact).on(*unit);
                batch.conditioning(exact_q, &Metric::Euclidean, ACCURACY, values)?;
            }
        }
        Ok(())
    }
}

impl<T: Lanes> Contestant for Batches<T> {
    fn quantities(&self) -> &'static [&'static str] {
        match T::EPSILON == f64::EPSILON {
            true => &["rnea", "aba", "crba", "entries", "conditioning"],
            false => &["rnea", "aba", "crba", "entries"],
        }
    }

    fn compute(&mut self, quantity: &str, _: usize, _: &Sample) -> Outcome {
        self.all(quantity)
    }

    /// The whole batch, on its own threads from beginning to end.
    fn turn(&mut self, quantity: &str, _: &[Sample], seconds: f64) -> Result<f64, Box<dyn Error>> {
        let (threads, patience) = (self.threads.clone(), self.patience);
        let each = threads.install(|| -> Result<f64, String> {
            let mut all = || self.all(quantity).map_err(|error| error.to_string());
            // A thread that has slept is given a core of its own only after some milliseconds.
            let asleep = Instant::now();
            all()?;
            while asleep.elapsed().as_secs_f64() < seconds * (patience - 1.0) {
                all()?;
            }
            let (start, mut calls) = (Instant::now(), 0);
            while start.elapsed().as_secs_f64() < seconds * patience {
                all()?;
                calls += 1;
            }
            Ok(start.elapsed().as_secs_f64() / f64::from(calls))
        })?;
        Ok(each / self.count as f64)
    }

    fn tolerance(&self) -> f64 {
        if T::EPSILON == f64::EPSILON { 1e-9 } else { 1e-3 }
    }

    /// Of the first configuration.
    fn value(&mut self, quantity: &str) -> Vec<f64> {
        let nv = self.exact.nv();
        let first = |numbers: &[T], n: usize| numbers[..n].iter().map(|x| x.to_f64()).collect();
        match quantity {
            "crba" => first(&self.H, nv * nv),
            "entries" => {
                // The matrix that the entries belong to.
                let entries: Vec<f64> = first(&self.H, Batch::new(&self.model).entries().len());
                let mut H = vec![0.0; nv * nv];
                for (&(d, e), H_de) in Batch::new(&self.model).entries().iter().zip(entries) {
                    (H[d * nv + e], H[e * nv + d]) = (H_de, H_de);
                }
                H
            }
            "conditioning" => vec![self.values[0].kappa(), self.values[0].kappa_weighted],
            _ => first(&self.out, nv),
        }
    }
}

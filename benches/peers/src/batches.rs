//! eigenbody's batches: many configurations a call, on one unit of the processor or another, on one core or two.

use std::error::Error;
use std::hint::black_box;
use std::sync::Arc;

use eigenbody::batch::{Batch, Lanes};
use eigenbody::conditioning::Values;
use eigenbody::scalar::Unit;
use eigenbody::{Metric, Model};
use rayon::ThreadPool;

use crate::Outcome;
use crate::contest::{Contestant, repeated};
use crate::quantity::Quantity;
use crate::robot::{Robot, SAMPLES, Sample};

/// Degrees of freedom in a batch, about: states, results and H of one core's share stay in its own memory.
pub const FEW: usize = 8192;
/// The same where threads share: a call takes so many milliseconds that it is nothing to wake one.
pub const MANY: usize = 128 * FEW;
/// How many times fewer they are then for matrices, which take longer and more memory.
const FEWER: usize = 4;
/// Numbers of few matrices, at most: a megabyte, so that they stay near as well.
const NEAR: usize = 1 << 17;
/// How much longer than others' the turns of threads that share are: a system takes some milliseconds to give a second core to a second
/// thread.
const PATIENCE: f64 = 20.0;
/// Relative error of κ asked for.
const ACCURACY: f64 = 1e-8;

/// States of a robot in one precision, and room for results.
pub struct Batches<'r, T> {
    batch: Batch<'r, T>,
    /// The same in f64, for κ.
    exact: Batch<'r, f64>,
    nq: usize,
    nv: usize,
    entries: Vec<(usize, usize)>,
    threads: Arc<ThreadPool>,
    /// How much longer than others' its turns are.
    patience: f64,
    /// Configurations of a call, and at most of one for matrices.
    count: usize,
    matrices: usize,
    /// Numbers of them, at most.
    near: usize,
    q: Vec<T>,
    v: Vec<T>,
    x: Vec<T>,
    exact_q: Vec<f64>,
    out: Vec<T>,
    H: Vec<T>,
    values: Vec<Values>,
}

impl<'r, T: Lanes> Batches<'r, T> {
    /// Of a robot and its model in this precision.
    pub fn new(
        robot: &'r Robot,
        model: &'r Model<T>,
        unit: Unit,
        size: usize,
        threads: usize,
    ) -> Result<Self, Box<dyn Error>> {
        let samples = &robot.samples;
        let (nq, nv) = (model.nq(), model.nv());
        let times = (size / nv).div_ceil(samples.len());
        let count = times * samples.len();
        let all = |of: fn(&Sample) -> &Vec<f64>| {
            samples.iter().flat_map(of).copied().collect::<Vec<f64>>().repeat(times)
        };
        let numbers = |all: Vec<f64>| all.into_iter().map(T::from_f64).collect::<Vec<T>>();
        let exact_q = all(|sample| &sample.q);
        let matrices = if size > FEW { count / FEWER } else { count };
        let batch = Batch::new(model).on(unit);
        Ok(Self {
            entries: batch.entries(),
            batch,
            exact: Batch::new(&robot.model).on(unit),
            nq,
            nv,
            threads: Arc::new(rayon::ThreadPoolBuilder::new().num_threads(threads).build()?),
            patience: if size > FEW { PATIENCE } else { 1.0 },
            count,
            matrices,
            near: if size > FEW { usize::MAX } else { NEAR },
            q: numbers(exact_q.clone()),
            v: numbers(all(|sample| &sample.v)),
            x: numbers(all(|sample| &sample.x)),
            exact_q: exact_q[..matrices * nq].to_vec(),
            out: vec![T::ZERO; count * nv],
            H: vec![T::ZERO; matrices * nv * nv],
            values: vec![Values { lambda_min: 0.0, lambda_max: 0.0, kappa_weighted: 0.0 }; matrices],
        })
    }

    /// Configurations of a call.
    fn count(&self, quantity: Quantity) -> usize {
        let numbers = match quantity {
            Quantity::Rnea | Quantity::Aba => return self.count,
            Quantity::Crba => self.nv * self.nv,
            Quantity::Entries => self.entries.len(),
            _ => return self.matrices,
        };
        self.matrices.min((self.near / numbers / SAMPLES).max(1) * SAMPLES)
    }

    fn all(&mut self, quantity: Quantity) -> Outcome {
        let count = self.count(quantity);
        let Self { batch, exact, nq, nv, entries, q, v, x, exact_q, out, H, values, .. } = self;
        let q = &q[..count * *nq];
        match quantity {
            Quantity::Rnea => batch.inverse_dynamics(q, v, x, out)?,
            Quantity::Aba => batch.forward_dynamics(q, v, x, out)?,
            Quantity::Crba => batch.mass_matrices(q, &mut H[..count * *nv * *nv])?,
            Quantity::Entries => batch.mass_matrix_entries(q, &mut H[..count * entries.len()])?,
            _ => exact.conditioning(exact_q, &Metric::Euclidean, ACCURACY, values)?,
        }
        Ok(())
    }
}

impl<T: Lanes> Contestant for Batches<'_, T> {
    fn quantities(&self) -> &'static [Quantity] {
        match T::EPSILON == f64::EPSILON {
            true => {
                &[Quantity::Rnea, Quantity::Aba, Quantity::Crba, Quantity::Entries, Quantity::Conditioning]
            }
            false => &[Quantity::Rnea, Quantity::Aba, Quantity::Crba, Quantity::Entries],
        }
    }

    fn compute(&mut self, quantity: Quantity, _: usize, _: &Sample) -> Outcome {
        self.all(quantity)
    }

    /// The whole batch, on its own threads from beginning to end.
    fn turn(&mut self, quantity: Quantity, _: &[Sample], seconds: f64) -> Result<f64, Box<dyn Error>> {
        let (threads, patience) = (self.threads.clone(), self.patience);
        let each = threads.install(|| {
            let mut all = || self.all(quantity).map_err(|error| error.to_string());
            // A thread that has slept is given a core of its own only after some milliseconds.
            repeated(seconds * (patience - 1.0).max(0.5), &mut all)?;
            repeated(seconds * patience, &mut all)
        })?;
        Ok(each / self.count(quantity) as f64)
    }

    fn tolerance(&self) -> f64 {
        if T::EPSILON == f64::EPSILON { 1e-9 } else { 1e-3 }
    }

    /// Of the first configuration.
    fn value(&mut self, quantity: Quantity) -> Vec<f64> {
        let nv = self.nv;
        let first = |numbers: &[T], n: usize| numbers[..n].iter().map(|x| x.to_f64()).collect();
        match quantity {
            Quantity::Crba => first(&self.H, nv * nv),
            Quantity::Entries => {
                // The matrix that the entries belong to.
                let numbers: Vec<f64> = first(&self.H, self.entries.len());
                let mut H = vec![0.0; nv * nv];
                for (&(d, e), H_de) in self.entries.iter().zip(numbers) {
                    (H[d * nv + e], H[e * nv + d]) = (H_de, H_de);
                }
                H
            }
            Quantity::Conditioning => vec![self.values[0].kappa(), self.values[0].kappa_weighted],
            _ => first(&self.out, nv),
        }
    }
}

/// Two batches on a thread each that know nothing of one another: what a machine gives to two threads at the time.
pub struct Apart<'r>([Batches<'r, f64>; 2]);

impl<'r> Apart<'r> {
    pub fn new(robot: &'r Robot, size: usize) -> Result<Self, Box<dyn Error>> {
        let half = || Batches::new(robot, &robot.model, Unit::Avx512, size / 2, 1);
        Ok(Self([half()?, half()?]))
    }
}

impl Contestant for Apart<'_> {
    fn quantities(&self) -> &'static [Quantity] {
        self.0[0].quantities()
    }

    fn compute(&mut self, quantity: Quantity, sample: usize, state: &Sample) -> Outcome {
        self.0[0].compute(quantity, sample, state)
    }

    /// As many seconds as both need for one configuration together.
    fn turn(&mut self, quantity: Quantity, samples: &[Sample], seconds: f64) -> Result<f64, Box<dyn Error>> {
        let [one, other] = &mut self.0;
        let run = |batch: &mut Batches<'_, f64>| {
            batch.turn(quantity, samples, seconds).map_err(|error| error.to_string())
        };
        let (one, other) = std::thread::scope(|scope| {
            let other = scope.spawn(|| run(other));
            (run(one), other.join())
        });
        let other = other.map_err(|_| "a thread ended")?;
        Ok(1.0 / (1.0 / one? + 1.0 / other?))
    }

    fn value(&mut self, _: Quantity) -> Vec<f64> {
        Vec::new()
    }
}

/// Nothing but zeros where a batch would write: what its results cost at least.
pub struct Zeros<'r>(Batches<'r, f64>);

impl<'r> Zeros<'r> {
    pub fn new(robot: &'r Robot) -> Result<Self, Box<dyn Error>> {
        Ok(Self(Batches::new(robot, &robot.model, Unit::Avx512, FEW, 1)?))
    }
}

impl Contestant for Zeros<'_> {
    fn quantities(&self) -> &'static [Quantity] {
        &[Quantity::Crba, Quantity::Entries]
    }

    fn compute(&mut self, quantity: Quantity, _: usize, _: &Sample) -> Outcome {
        let batch = &mut self.0;
        let numbers = if quantity == Quantity::Crba { batch.nv * batch.nv } else { batch.entries.len() };
        let count = batch.count(quantity);
        batch.H[..count * numbers].fill(0.0);
        black_box(&mut batch.H);
        Ok(())
    }

    fn turn(&mut self, quantity: Quantity, samples: &[Sample], seconds: f64) -> Result<f64, Box<dyn Error>> {
        let mut all = || self.compute(quantity, 0, &samples[0]);
        repeated(seconds / 2.0, &mut all)?;
        let each = repeated(seconds, &mut all)?;
        Ok(each / self.0.count(quantity) as f64)
    }

    fn value(&mut self, _: Quantity) -> Vec<f64> {
        Vec::new()
    }
}

//! Arrays through the kernels of one robot.

use crate::array::{Number, Out, Rows, all_single, count};
use crate::error::Failure;
use crate::model::{Model, Shared};
use eigenbody::batch::{Batch, BatchError, Lanes};
use eigenbody::dynamics::{
    AbaWorkspace, CrbaWorkspace, RneaWorkspace, bias_force_into, forward_dynamics_into, gravity_force_into,
    inverse_dynamics_into, mass_matrix_into,
};
use eigenbody::{Error, Matrix, Reduction};
use pyo3::prelude::*;
use rayon::prelude::*;
use std::borrow::Cow;
use std::sync::{Mutex, PoisonError};

/// Rows that a thread takes at a time.
const GRAIN: usize = 32;

/// A robot in one precision, and memory for its kernels.
pub struct Robot<T> {
    pub model: eigenbody::Model<T>,
    pub reduction: Reduction,
    pool: Mutex<Vec<Workspaces<T>>>,
}

/// Memory for the kernels.
struct Workspaces<T> {
    crba: CrbaWorkspace<T>,
    rnea: RneaWorkspace<T>,
    aba: AbaWorkspace<T>,
    H: Matrix<T>,
}

impl<T: Number> Robot<T> {
    pub fn new(model: eigenbody::Model<T>, reduction: Reduction) -> Self {
        Self { model, reduction, pool: Mutex::default() }
    }

    /// Lends memory; what is not being used is kept for the next call.
    fn with<R>(&self, work: impl FnOnce(&mut Workspaces<T>) -> R) -> R {
        let pool = || self.pool.lock().unwrap_or_else(PoisonError::into_inner);
        let kept = pool().pop();
        let mut workspaces = kept.unwrap_or_else(|| self.workspaces());
        let result = work(&mut workspaces);
        pool().push(workspaces);
        result
    }

    fn workspaces(&self) -> Workspaces<T> {
        let (model, nv) = (&self.model, self.model.nv());
        Workspaces {
            crba: CrbaWorkspace::new(model),
            rnea: RneaWorkspace::new(model),
            aba: AbaWorkspace::new(model),
            H: Matrix::zeros(nv, nv),
        }
    }

    /// All coordinates of those that a caller gives.
    pub fn expand<'a>(&self, q: &'a [T]) -> Cow<'a, [T]> {
        match self.model.coupling().filter(|_| self.reduction.mimic) {
            Some(coupling) => Cow::Owned(coupling.expand(q)),
            None => Cow::Borrowed(q),
        }
    }

    fn is_coupled(&self) -> bool {
        self.reduction.mimic && self.model.coupling().is_some()
    }

    fn mass_matrix(&self, work: &mut Workspaces<T>, q: &[T], out: &mut [T]) -> Result<(), Error> {
        if self.is_coupled() || self.reduction.base {
            let H = self.reduction.mass_matrix(&self.model, &self.expand(q))?;
            out.copy_from_slice(H.as_slice());
        } else {
            mass_matrix_into(&self.model, q, &mut work.crba, &mut work.H)?;
            out.copy_from_slice(work.H.as_slice());
        }
        Ok(())
    }
}

/// A precision: which of the robot's two forms computes.
pub trait Precision: Number + Lanes {
    fn robot(shared: &Shared) -> &Robot<Self>;
}

impl Precision for f64 {
    fn robot(shared: &Shared) -> &Robot<Self> {
        &shared.robot
    }
}

impl Precision for f32 {
    fn robot(shared: &Shared) -> &Robot<Self> {
        shared.single.get_or_init(|| Robot::new(shared.robot.model.cast(), shared.robot.reduction))
    }
}

/// An argument: its name, its value, numbers in a row.
type Argument<'a, 'py> = (&'static str, &'a Bound<'py, PyAny>, usize);

/// A kernel over whole arrays, all with as many rows.
type Whole<T> = fn(&eigenbody::Model<T>, &[&[T]], &mut [T]) -> Result<(), BatchError>;

/// Applies a kernel to one row or to all rows of a batch, on all cores; a single row stands in for every row of the others.
///
/// A batch goes through `whole`, in lanes, if there is such a kernel.
fn apply<'py, T: Precision>(
    shared: &Shared,
    arguments: &[Argument<'_, 'py>],
    shape: &[usize],
    out: Option<&Bound<'py, PyAny>>,
    kernel: impl Fn(&Robot<T>, &mut Workspaces<T>, &[&[T]], &mut [T]) -> Result<(), Error> + Sync + Send,
    whole: Option<Whole<T>>,
) -> Result<Bound<'py, PyAny>, Failure> {
    let mut rows = Vec::with_capacity(arguments.len());
    for (what, value, width) in arguments {
        rows.push((*what, Rows::<T>::new(what, value, *width)?));
    }
    let named: Vec<(&str, &Rows<'_, T>)> = rows.iter().map(|(what, rows)| (*what, rows)).collect();
    let count = count(&named)?;
    let full: Vec<usize> = count.iter().chain(shape).copied().collect();
    let out = Out::new(arguments[0].1.py(), &full, out)?;
    let numbers: Vec<(Cow<'_, [T]>, usize)> = rows
        .iter()
        .map(|(_, rows)| (rows.numbers(), if rows.count().is_some() { rows.width() } else { 0 }))
        .collect();
    let widths: Vec<usize> = rows.iter().map(|(_, rows)| rows.width()).collect();
    let robot = T::robot(shared);
    let slices: Vec<(&[T], usize)> = numbers.iter().map(|(all, stride)| (all.as_ref(), *stride)).collect();
    let size: usize = shape.iter().product();
    let row = |work: &mut Workspaces<T>, k: usize, out: &mut [T]| {
        let mut inputs: [&[T]; 3] = [&[]; 3];
        for ((input, (all, stride)), width) in inputs.iter_mut().zip(&slices).zip(&widths) {
            *input = &all[k * stride..k * stride + width];
        }
        kernel(robot, work, &inputs[..slices.len()], out)
    };
    let is_plain = !robot.is_coupled() && !robot.reduction.base;
    let whole = whole.filter(|_| is_plain && slices.iter().all(|(_, stride)| *stride > 0));
    out.fill(|out| match (count, whole) {
        (Some(count), Some(whole)) if count > 0 => {
            let all: Vec<&[T]> = slices.iter().map(|(all, _)| *all).collect();
            whole(&robot.model, &all, out).map_err(|error| match error {
                BatchError::Shape(source) => source.into(),
                BatchError::Configuration { index, error } => {
                    Failure::Numbers { row: Some(index), source: error }
                }
            })
        }
        (None, _) => robot.with(|work| row(work, 0, out)).map_err(Failure::from),
        (Some(_), _) if size == 0 => Ok(()),
        (Some(_), _) => out.par_chunks_mut(size * GRAIN).enumerate().try_for_each(|(block, out)| {
            robot.with(|work| {
                out.chunks_mut(size).enumerate().try_for_each(|(k, out)| {
                    let k = block * GRAIN + k;
                    row(work, k, out).map_err(|source| Failure::Numbers { row: Some(k), source })
                })
            })
        }),
    })
}

/// What [`apply`] needs to know of each function.
macro_rules! in_either_precision {
    ($shared:expr, [$(($what:literal, $value:expr, $width:expr)),+], $shape:expr, $out:expr, $kernel:expr, $whole:expr) => {{
        let arguments = [$(($what, $value, $width)),+];
        Ok(if all_single(&[$($value),+]) {
            apply::<f32>($shared, &arguments, $shape, $out, $kernel, $whole)?
        } else {
            apply::<f64>($shared, &arguments, $shape, $out, $kernel, $whole)?
        })
    }};
}

fn check_free(model: &Model) -> Result<(), Failure> {
    match model.shared.robot.is_coupled() {
        true => Err(eigenbody::InputError::NotATree.into()),
        false => Ok(()),
    }
}

pub fn mass_matrix<'py>(
    model: &Model,
    q: &Bound<'py, PyAny>,
    out: Option<&Bound<'py, PyAny>>,
) -> Result<Bound<'py, PyAny>, Failure> {
    let n = model.shared.dofs.len();
    model.shared.robot.model.check_dense()?;
    in_either_precision!(
        &model.shared,
        [("q", q, model.shared.nq)],
        &[n, n],
        out,
        |robot, work, input, out| { robot.mass_matrix(work, input[0], out) },
        Some(|model, input, out| Batch::new(model).mass_matrices(input[0], out))
    )
}

pub fn inverse_dynamics<'py>(
    model: &Model,
    q: &Bound<'py, PyAny>,
    v: &Bound<'py, PyAny>,
    a: &Bound<'py, PyAny>,
    out: Option<&Bound<'py, PyAny>>,
) -> Result<Bound<'py, PyAny>, Failure> {
    check_free(model)?;
    let (nq, nv) = (model.shared.nq, model.shared.nv);
    in_either_precision!(
        &model.shared,
        [("q", q, nq), ("v", v, nv), ("a", a, nv)],
        &[nv],
        out,
        |robot, work, input, out| {
            Ok(inverse_dynamics_into(&robot.model, input[0], input[1], input[2], &mut work.rnea, out)?)
        },
        Some(|model, input, out| Batch::new(model).inverse_dynamics(input[0], input[1], input[2], out))
    )
}

pub fn forward_dynamics<'py>(
    model: &Model,
    q: &Bound<'py, PyAny>,
    v: &Bound<'py, PyAny>,
    tau: &Bound<'py, PyAny>,
    out: Option<&Bound<'py, PyAny>>,
) -> Result<Bound<'py, PyAny>, Failure> {
    check_free(model)?;
    let (nq, nv) = (model.shared.nq, model.shared.nv);
    in_either_precision!(
        &model.shared,
        [("q", q, nq), ("v", v, nv), ("tau", tau, nv)],
        &[nv],
        out,
        |robot, work, input, out| {
            forward_dynamics_into(&robot.model, input[0], input[1], input[2], &mut work.aba, out)
        },
        Some(|model, input, out| Batch::new(model).forward_dynamics(input[0], input[1], input[2], out))
    )
}

pub fn bias_force<'py>(
    model: &Model,
    q: &Bound<'py, PyAny>,
    v: &Bound<'py, PyAny>,
    out: Option<&Bound<'py, PyAny>>,
) -> Result<Bound<'py, PyAny>, Failure> {
    check_free(model)?;
    let (nq, nv) = (model.shared.nq, model.shared.nv);
    in_either_precision!(
        &model.shared,
        [("q", q, nq), ("v", v, nv)],
        &[nv],
        out,
        |robot, work, input, out| {
            Ok(bias_force_into(&robot.model, input[0], input[1], &mut work.rnea, out)?)
        },
        None
    )
}

pub fn gravity_force<'py>(
    model: &Model,
    q: &Bound<'py, PyAny>,
    out: Option<&Bound<'py, PyAny>>,
) -> Result<Bound<'py, PyAny>, Failure> {
    check_free(model)?;
    let (nq, nv) = (model.shared.nq, model.shared.nv);
    in_either_precision!(
        &model.shared,
        [("q", q, nq)],
        &[nv],
        out,
        |robot, work, input, out| { Ok(gravity_force_into(&robot.model, input[0], &mut work.rnea, out)?) },
        None
    )
}

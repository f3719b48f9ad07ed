//! Arrays through the kernels of one robot.

use crate::array::{Number, Out, Rows, all_single, count};
use crate::compute::go_on;
use crate::error::Failure;
use crate::model::{Model, Shared};
use eigenbody::batch::{Batch, BatchError, Lanes};
use eigenbody::dynamics::{
    AbaWorkspace, CrbaWorkspace, RneaWorkspace, bias_force_into, forward_dynamics_into,
    inverse_dynamics_into, mass_matrix_into,
};
use eigenbody::factor::{
    CoupledWorkspace, coupled_bias_force_into, coupled_forward_dynamics_into, coupled_inverse_dynamics_into,
};
use eigenbody::model::Coupling;
use eigenbody::{Error, InputError, Matrix, Reduction};
use numpy::ndarray::{ArrayView, IxDyn};
use numpy::{PyArray, PyArray1, PyArrayDyn, PyArrayMethods, PyReadonlyArray1, PyUntypedArrayMethods};
use pyo3::prelude::*;
use rayon::prelude::*;
use std::borrow::Cow;
use std::sync::{Mutex, PoisonError};

/// Rows that a thread takes at a time.
const GRAIN: usize = 32;
/// Robots of so many degrees of freedom are done with one row before the interpreter's lock is released and taken again.
const QUICK: usize = 64;

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
    /// Where mimic joints follow.
    coupled: Option<CoupledWorkspace<T>>,
    /// A velocity of zero.
    rest: Vec<T>,
    /// A result on its way into an array.
    result: Vec<T>,
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
            H: if model.check_dense().is_ok() { Matrix::zeros(nv, nv) } else { Matrix::zeros(0, 0) },
            coupled: self.coupling().and_then(|coupling| CoupledWorkspace::new(model, coupling).ok()),
            rest: vec![T::ZERO; self.coupling().map_or(nv, Coupling::nv)],
            result: Vec::new(),
        }
    }

    /// The map of mimic joints, where they follow.
    pub fn coupling(&self) -> Option<&Coupling<T>> {
        self.model.coupling().filter(|_| self.reduction.mimic)
    }

    /// All coordinates of those that a caller gives.
    pub fn expand<'a>(&self, q: &'a [T]) -> Cow<'a, [T]> {
        match self.coupling() {
            Some(coupling) => Cow::Owned(coupling.expand(q)),
            None => Cow::Borrowed(q),
        }
    }

    /// True if H and the forces are those of all joints.
    pub fn is_plain(&self) -> bool {
        self.coupling().is_none() && !self.reduction.base
    }

    /// Where mimic joints follow, forces and accelerations are those of the independent ones.
    fn coupled<'a>(
        &'a self,
        room: &'a mut Option<CoupledWorkspace<T>>,
    ) -> Option<(&'a Coupling<T>, &'a mut CoupledWorkspace<T>)> {
        self.coupling().zip(room.as_mut())
    }

    fn inverse_dynamics(
        &self,
        work: &mut Workspaces<T>,
        [q, v, a]: [&[T]; 3],
        out: &mut [T],
    ) -> Result<(), InputError> {
        match self.coupled(&mut work.coupled) {
            None => inverse_dynamics_into(&self.model, q, v, a, &mut work.rnea, out),
            Some((map, room)) => {
                coupled_inverse_dynamics_into(&self.model, map, &map.expand(q), v, a, room, out)
            }
        }
    }

    fn forward_dynamics(
        &self,
        work: &mut Workspaces<T>,
        [q, v, tau]: [&[T]; 3],
        out: &mut [T],
    ) -> Result<(), Error> {
        match self.coupled(&mut work.coupled) {
            None => forward_dynamics_into(&self.model, q, v, tau, &mut work.aba, out),
            Some((map, room)) => {
                coupled_forward_dynamics_into(&self.model, map, &map.expand(q), v, tau, room, out)
            }
        }
    }

    fn bias_force(
        &self,
        work: &mut Workspaces<T>,
        [q, v]: [&[T]; 2],
        out: &mut [T],
    ) -> Result<(), InputError> {
        match self.coupled(&mut work.coupled) {
            None => bias_force_into(&self.model, q, v, &mut work.rnea, out),
            Some((map, room)) => coupled_bias_force_into(&self.model, map, &map.expand(q), v, room, out),
        }
    }

    fn mass_matrix(&self, work: &mut Workspaces<T>, q: &[T], out: &mut [T]) -> Result<(), Error> {
        if !self.is_plain() {
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
type Whole<T, const A: usize> = fn(&eigenbody::Model<T>, [&[T]; A], &mut [T]) -> Result<(), BatchError>;

/// Applies a kernel to one row or to all rows of a batch, on all cores; a single row stands in for every row of the others.
///
/// A batch goes through `whole`, in lanes, if there is such a kernel.
fn apply<'py, T: Precision, const A: usize>(
    shared: &Shared,
    arguments: [Argument<'_, 'py>; A],
    shape: &[usize],
    out: Option<&Bound<'py, PyAny>>,
    kernel: impl Fn(&Robot<T>, &mut Workspaces<T>, [&[T]; A], &mut [T]) -> Result<(), Error> + Sync + Send,
    whole: Option<Whole<T, A>>,
) -> Result<Bound<'py, PyAny>, Failure> {
    let robot = T::robot(shared);
    if let Some(done) = quick(robot, &arguments, shape, out, &kernel) {
        return done;
    }
    let mut rows = Vec::with_capacity(A);
    for (what, value, width) in arguments {
        rows.push((what, Rows::<T>::new(what, value, width)?));
    }
    let named: Vec<(&str, &Rows<'_, T>)> = rows.iter().map(|(what, rows)| (*what, rows)).collect();
    let count = count(&named)?;
    let full: Vec<usize> = count.iter().chain(shape).copied().collect();
    let out = Out::new(arguments[0].1.py(), &full, out)?;
    let numbers = rows.iter().map(|(_, rows)| rows.numbers()).collect::<Result<Vec<_>, _>>()?;
    let all: [&[T]; A] = std::array::from_fn(|k| numbers[k].as_ref());
    let widths: [usize; A] = std::array::from_fn(|k| rows[k].1.width());
    let strides: [usize; A] =
        std::array::from_fn(|k| if rows[k].1.count().is_some() { widths[k] } else { 0 });
    let size: usize = shape.iter().product();
    let row = |work: &mut Workspaces<T>, k: usize, out: &mut [T]| {
        kernel(robot, work, std::array::from_fn(|i| &all[i][k * strides[i]..][..widths[i]]), out)
    };
    let whole = whole.filter(|_| robot.is_plain() && strides == widths);
    out.fill(count.is_none(), |out, progress| match (count, whole) {
        (Some(count), Some(whole)) if count > 0 => Ok(whole(&robot.model, all, out)?),
        (None, _) => robot.with(|work| row(work, 0, out)).map_err(Failure::from),
        (Some(_), _) if size == 0 => Ok(()),
        (Some(_), _) => out.par_chunks_mut(size * GRAIN).enumerate().try_for_each(|(block, out)| {
            go_on(progress)?;
            robot.with(|work| {
                out.chunks_mut(size).enumerate().try_for_each(|(k, out)| {
                    let k = block * GRAIN + k;
                    row(work, k, out).map_err(|source| Failure::Numbers { row: Some(k), source })
                })
            })
        }),
    })
}

/// One row of contiguous numbers of the right type, with no more ado than there must be: for a small robot that would cost more than
/// the result. None if it is something else that is asked.
fn quick<'py, T: Number, const A: usize>(
    robot: &Robot<T>,
    arguments: &[Argument<'_, 'py>; A],
    shape: &[usize],
    out: Option<&Bound<'py, PyAny>>,
    kernel: impl Fn(&Robot<T>, &mut Workspaces<T>, [&[T]; A], &mut [T]) -> Result<(), Error>,
) -> Option<Result<Bound<'py, PyAny>, Failure>> {
    if robot.model.nv() > QUICK {
        return None;
    }
    let mut rows: [Option<PyReadonlyArray1<'py, T>>; A] = [const { None }; A];
    for (row, (_, value, width)) in rows.iter_mut().zip(arguments) {
        let array = value.cast::<PyArray1<T>>().ok().filter(|array| array.len() == *width)?;
        *row = Some(array.try_readonly().ok()?);
    }
    let mut all: [&[T]; A] = [&[]; A];
    for (slice, row) in all.iter_mut().zip(&rows) {
        *slice = row.as_ref()?.as_slice().ok()?;
    }
    if let Some(out) = out {
        let array = out.cast::<PyArrayDyn<T>>().ok().filter(|array| array.shape() == shape)?;
        let mut guard = array.try_readwrite().ok().filter(|_| array.is_c_contiguous())?;
        let slice = guard.as_slice_mut().ok()?;
        let done = robot.with(|work| kernel(robot, work, all, slice));
        return Some(done.map(|()| out.clone()).map_err(Failure::from));
    }
    Some(robot.with(|work| {
        let mut result = std::mem::take(&mut work.result);
        result.resize(shape.iter().product(), T::ZERO);
        let done = kernel(robot, work, all, &mut result).map_err(Failure::from);
        let array = done.and_then(|()| {
            let view = ArrayView::from_shape(IxDyn(shape), &result);
            let view = view.map_err(|error| Failure::input("out", error))?;
            Ok(PyArray::from_array(arguments[0].1.py(), &view).into_any())
        });
        work.result = result;
        array
    }))
}

/// What [`apply`] needs to know of each function.
macro_rules! in_either_precision {
    ($shared:expr, [$(($what:literal, $value:expr, $width:expr)),+], $shape:expr, $out:expr, $kernel:expr, $whole:expr) => {{
        let arguments = [$(($what, $value, $width)),+];
        if all_single(&[$($value),+]) {
            apply::<f32, _>($shared, arguments, $shape, $out, $kernel, $whole)
        } else {
            apply::<f64, _>($shared, arguments, $shape, $out, $kernel, $whole)
        }
    }};
}

/// Where mimic joints follow there is a matrix to be had.
fn check_size(shared: &Shared) -> Result<(), Failure> {
    match shared.robot.coupling() {
        Some(_) => Ok(shared.robot.model.check_dense()?),
        None => Ok(()),
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
        |robot, work, [q], out| robot.mass_matrix(work, q, out),
        Some(|model, [q], out| Batch::new(model).mass_matrices(q, out))
    )
}

pub fn inverse_dynamics<'py>(
    model: &Model,
    q: &Bound<'py, PyAny>,
    v: &Bound<'py, PyAny>,
    a: &Bound<'py, PyAny>,
    out: Option<&Bound<'py, PyAny>>,
) -> Result<Bound<'py, PyAny>, Failure> {
    check_size(&model.shared)?;
    let (nq, nv) = (model.shared.nq, model.shared.nv);
    in_either_precision!(
        &model.shared,
        [("q", q, nq), ("v", v, nv), ("a", a, nv)],
        &[nv],
        out,
        |robot, work, rows, out| Ok(robot.inverse_dynamics(work, rows, out)?),
        Some(|model, [q, v, a], out| Batch::new(model).inverse_dynamics(q, v, a, out))
    )
}

pub fn forward_dynamics<'py>(
    model: &Model,
    q: &Bound<'py, PyAny>,
    v: &Bound<'py, PyAny>,
    tau: &Bound<'py, PyAny>,
    out: Option<&Bound<'py, PyAny>>,
) -> Result<Bound<'py, PyAny>, Failure> {
    check_size(&model.shared)?;
    let (nq, nv) = (model.shared.nq, model.shared.nv);
    in_either_precision!(
        &model.shared,
        [("q", q, nq), ("v", v, nv), ("tau", tau, nv)],
        &[nv],
        out,
        Robot::forward_dynamics,
        Some(|model, [q, v, tau], out| Batch::new(model).forward_dynamics(q, v, tau, out))
    )
}

pub fn bias_force<'py>(
    model: &Model,
    q: &Bound<'py, PyAny>,
    v: &Bound<'py, PyAny>,
    out: Option<&Bound<'py, PyAny>>,
) -> Result<Bound<'py, PyAny>, Failure> {
    check_size(&model.shared)?;
    let (nq, nv) = (model.shared.nq, model.shared.nv);
    in_either_precision!(
        &model.shared,
        [("q", q, nq), ("v", v, nv)],
        &[nv],
        out,
        |robot, work, rows, out| Ok(robot.bias_force(work, rows, out)?),
        None
    )
}

pub fn gravity_force<'py>(
    model: &Model,
    q: &Bound<'py, PyAny>,
    out: Option<&Bound<'py, PyAny>>,
) -> Result<Bound<'py, PyAny>, Failure> {
    check_size(&model.shared)?;
    let (nq, nv) = (model.shared.nq, model.shared.nv);
    in_either_precision!(
        &model.shared,
        [("q", q, nq)],
        &[nv],
        out,
        |robot, work, [q], out| {
            let rest = std::mem::take(&mut work.rest);
            let done = robot.bias_force(work, [q, &rest], out);
            work.rest = rest;
            Ok(done?)
        },
        None
    )
}

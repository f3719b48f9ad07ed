//! Rows of numbers from whatever Python has, and into arrays of the caller's.

use crate::compute::{Progress, compute};
use crate::error::Failure;
use eigenbody::scalar::Real;
use numpy::{
    Element, PyArrayDescrMethods, PyArrayDyn, PyArrayMethods, PyReadonlyArrayDyn, PyReadwriteArrayDyn,
    PyUntypedArray, PyUntypedArrayMethods, dtype,
};
use pyo3::intern;
use pyo3::prelude::*;
use pyo3::types::PyTuple;
use std::borrow::Cow;

/// What arrays hold: f32 or f64.
pub trait Number: Real + Element {}
impl Number for f32 {}
impl Number for f64 {}

/// True if all arrays are float32: the computation then is.
pub fn all_single(arrays: &[&Bound<'_, PyAny>]) -> bool {
    arrays.iter().all(|array| {
        array.cast::<PyUntypedArray>().is_ok_and(|array| array.dtype().is_equiv_to(&dtype::<f32>(array.py())))
    })
}

/// One row of numbers, or a batch of them.
pub struct Rows<'py, T: Number> {
    array: PyReadonlyArrayDyn<'py, T>,
    width: usize,
}

impl<'py, T: Number> Rows<'py, T> {
    /// Takes `(width,)` or `(k, width)`.
    pub fn new(what: &str, value: &Bound<'py, PyAny>, width: usize) -> Result<Self, Failure> {
        let array = match value.cast::<PyArrayDyn<T>>() {
            Ok(array) => array.clone(),
            Err(_) => convert(what, value)?,
        };
        let fits = matches!(array.shape(), [n] | [_, n] if *n == width);
        if !fits {
            let found = shape_text(array.shape());
            let problem = format!("has shape {found}, expected ({width},) or (k, {width})");
            return Err(Failure::Input { message: format!("{what} {problem}"), what: Some(what.to_owned()) });
        }
        let array = array
            .try_readonly()
            .map_err(|_| Failure::input(what, "is being written to, as `out` perhaps"))?;
        Ok(Self { array, width })
    }

    /// How many, if it is a batch.
    pub fn count(&self) -> Option<usize> {
        match self.array.shape() {
            [count, _] => Some(*count),
            _ => None,
        }
    }

    /// All numbers, row by row.
    pub fn numbers(&self) -> Result<Cow<'_, [T]>, Failure> {
        match self.array.as_slice() {
            Ok(slice) if self.array.is_c_contiguous() => Ok(Cow::Borrowed(slice)),
            _ => {
                let mut numbers = room(self.array.len())?;
                numbers.extend(self.array.as_array().iter().copied());
                Ok(Cow::Owned(numbers))
            }
        }
    }

    /// Numbers in a row.
    pub fn width(&self) -> usize {
        self.width
    }
}

/// An empty list with room for so many.
pub fn room<T>(count: usize) -> Result<Vec<T>, Failure> {
    let mut list = Vec::new();
    let size = count.saturating_mul(size_of::<T>());
    list.try_reserve_exact(count).map_err(|_| Failure::Memory(size))?;
    Ok(list)
}

/// Finds numpy and its functions in C, where its absence is an ImportError and Ctrl-C a KeyboardInterrupt: later both would be panics.
pub fn find_numpy(py: Python<'_>) -> PyResult<()> {
    let empty = py.import(intern!(py, "numpy"))?.call_method1(intern!(py, "zeros"), (0,))?;
    empty.cast_into::<PyArrayDyn<f64>>()?;
    Ok(())
}

/// A new array.
pub fn zeros<'py, T: Number>(py: Python<'py>, shape: &[usize]) -> Result<Bound<'py, PyArrayDyn<T>>, Failure> {
    // By numpy's Python function: that of C tells no failure.
    let numpy = py.import(intern!(py, "numpy"))?;
    let shape = PyTuple::new(py, shape)?;
    let array = numpy.call_method1(intern!(py, "zeros"), (shape, dtype::<T>(py)))?;
    Ok(array.cast_into::<PyArrayDyn<T>>().map_err(PyErr::from)?)
}

/// Lists, integers, other floats: by numpy's own rules, but no text, complex numbers or objects.
fn convert<'py, T: Number>(
    what: &str,
    value: &Bound<'py, PyAny>,
) -> Result<Bound<'py, PyArrayDyn<T>>, Failure> {
    let py = value.py();
    let numpy = py.import(intern!(py, "numpy"))?;
    let array = numpy
        .call_method1(intern!(py, "asarray"), (value,))
        .map_err(|error| Failure::Type(format!("{what} is no array of numbers: {error}")))?;
    let kind: char = array.getattr(intern!(py, "dtype"))?.getattr(intern!(py, "kind"))?.extract()?;
    if !"biuf".contains(kind) {
        let dtype = array.getattr(intern!(py, "dtype"))?;
        return Err(Failure::Type(format!("{what} holds {dtype}, expected real numbers")));
    }
    let array = array.call_method1(intern!(py, "astype"), (dtype::<T>(py),))?;
    Ok(array.cast_into::<PyArrayDyn<T>>().map_err(PyErr::from)?)
}

pub fn shape_text(shape: &[usize]) -> String {
    match shape {
        [n] => format!("({n},)"),
        _ => format!("({})", shape.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ")),
    }
}

/// Where results go: an array of the caller's, or a new one.
pub struct Out<'py, T: Number> {
    array: Bound<'py, PyArrayDyn<T>>,
}

impl<'py, T: Number> Out<'py, T> {
    /// An array of this shape.
    pub fn new(py: Python<'py>, shape: &[usize], out: Option<&Bound<'py, PyAny>>) -> Result<Self, Failure> {
        let Some(out) = out else {
            return Ok(Self { array: zeros(py, shape)? });
        };
        let name = if T::EPSILON > 1e-10 { "float32" } else { "float64" };
        let wrong = |found: String| Failure::Type(format!("out is {found}, expected an array of {name}"));
        let array = match out.cast::<PyArrayDyn<T>>() {
            Ok(array) => array.clone(),
            Err(_) => match out.cast::<PyUntypedArray>() {
                Ok(array) => return Err(wrong(format!("an array of {}", array.dtype()))),
                Err(_) => return Err(wrong(out.get_type().to_string())),
            },
        };
        if array.shape() != shape {
            let (found, expected) = (shape_text(array.shape()), shape_text(shape));
            return Err(Failure::Input {
                message: format!("out has shape {found}, expected {expected}"),
                what: Some("out".to_owned()),
            });
        }
        Ok(Self { array })
    }

    /// Lets `fill` write the numbers, the interpreter's lock released, and returns the array. What is not short has all cores, and ends on
    /// Ctrl-C.
    ///
    /// An array that is not contiguous is written at the end, all at once. After an error, what it holds is undefined.
    pub fn fill(
        self,
        is_short: bool,
        fill: impl FnOnce(&mut [T], &Progress<'_>) -> Result<(), Failure> + Send,
    ) -> Result<Bound<'py, PyAny>, Failure> {
        let py = self.array.py();
        let mut guard: PyReadwriteArrayDyn<'py, T> = self
            .array
            .try_readwrite()
            .map_err(|_| Failure::input("out", "is read-only, or one of the inputs"))?;
        if self.array.is_c_contiguous() {
            let slice = guard.as_slice_mut().map_err(|error| Failure::input("out", error))?;
            compute(py, is_short, |progress| fill(slice, progress))?;
        } else {
            let mut numbers = room(self.array.len())?;
            numbers.resize(self.array.len(), T::ZERO);
            compute(py, is_short, |progress| fill(&mut numbers, progress))?;
            guard.as_array_mut().iter_mut().zip(numbers).for_each(|(to, from)| *to = from);
        }
        drop(guard);
        Ok(self.array.into_any())
    }
}

/// How many rows a call has: all batches have the same, or there is none.
pub fn count<T: Number>(all: &[(&str, &Rows<'_, T>)]) -> Result<Option<usize>, Failure> {
    let mut counts = all.iter().filter_map(|(what, rows)| Some((what, rows.count()?)));
    let Some((first, count)) = counts.next() else { return Ok(None) };
    match counts.find(|(_, other)| *other != count) {
        None => Ok(Some(count)),
        Some((what, other)) => Err(Failure::Input {
            message: format!("{what} has {other} rows and {first} {count}"),
            what: Some((*what).to_owned()),
        }),
    }
}

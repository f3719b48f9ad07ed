//! eigenbody for Python: arrays in, arrays out. No numerics of its own.
//!
//! What takes one configuration `(nq,)` takes a batch `(k, nq)` as well; float32 stays float32; the interpreter's lock is
//! released while numbers are computed. Results that are more than arrays go to Python as the JSON that the command line prints,
//! and are given their types there.

// H is the book's symbol.
#![allow(non_snake_case)]
// What Python hands over is ours.
#![allow(clippy::needless_pass_by_value)]

mod array;
mod build;
mod compute;
mod dynamics;
mod error;
mod functions;
mod given;
mod model;
mod properties;
mod simulate;
mod spectrum;
mod study;
mod sweep;
mod tracker;

use pyo3::prelude::*;

#[pymodule]
mod _eigenbody {
    #[pymodule_export]
    use crate::build::Parts;
    #[pymodule_export]
    use crate::model::Model;
    #[pymodule_export]
    use crate::study::{Examination, reproduce};
    #[pymodule_export]
    use crate::sweep::SweepPlan;
    #[pymodule_export]
    use crate::tracker::Tracker;

    #[pymodule_init]
    fn init(module: &pyo3::Bound<'_, pyo3::types::PyModule>) -> pyo3::PyResult<()> {
        use pyo3::types::PyModuleMethods;
        crate::array::find_numpy(module.py())?;
        module.add("__version__", env!("CARGO_PKG_VERSION"))
    }
}

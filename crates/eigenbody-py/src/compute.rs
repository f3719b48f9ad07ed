//! Where numbers are computed: on the threads of this process, the interpreter's lock released, Ctrl-C heard.

use crate::error::Failure;
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

/// How often Ctrl-C is looked for.
const PAUSE: Duration = Duration::from_millis(50);

/// What is asked between two parts of a computation: whether to go on.
pub type Progress<'a> = dyn Fn(usize) -> ControlFlow<()> + Sync + 'a;

/// The threads of this process. A forked child has none of its parent's, so that it starts its own.
///
/// The interpreter's lock is held meanwhile: Python does not fork while the pool is being looked up.
fn pool(_py: Python<'_>) -> Result<&'static ThreadPool, Failure> {
    static POOL: Mutex<Option<(u32, &'static ThreadPool)>> = Mutex::new(None);
    let mut kept = POOL.lock().unwrap_or_else(PoisonError::into_inner);
    let process = std::process::id();
    match *kept {
        Some((owner, pool)) if owner == process => Ok(pool),
        _ => {
            let pool = ThreadPoolBuilder::new().build();
            let pool = pool.map_err(|error| PyRuntimeError::new_err(error.to_string()))?;
            // A parent's pool is never dropped: its threads cannot be joined here.
            let pool: &'static ThreadPool = Box::leak(Box::new(pool));
            *kept = Some((process, pool));
            Ok(pool)
        }
    }
}

/// The exception that Ctrl-C raises.
fn ctrl_c(py: Python<'_>) -> PyResult<()> {
    py.check_signals()
}

/// Computes on all cores, beside the thread that signals come to. After Ctrl-C `progress` breaks, and KeyboardInterrupt is the result.
pub fn in_parallel<T: Send>(
    py: Python<'_>,
    work: impl FnOnce(&Progress<'_>) -> Result<T, Failure> + Send,
) -> Result<T, Failure> {
    let pool = pool(py)?;
    let unwanted = AtomicBool::new(false);
    let progress = |_: usize| match unwanted.load(Relaxed) {
        true => ControlFlow::Break(()),
        false => ControlFlow::Continue(()),
    };
    let mut signal = Ok(());
    let mut found = None;
    py.detach(|| {
        pool.in_place_scope(|scope| {
            let (tell, told) = channel::<()>();
            let (found, progress) = (&mut found, &progress);
            scope.spawn(move |_| {
                *found = Some(work(progress));
                drop(tell);
            });
            // Nothing is ever sent: the channel closes with the work.
            while let Err(RecvTimeoutError::Timeout) = told.recv_timeout(PAUSE) {
                if signal.is_ok() {
                    signal = Python::attach(ctrl_c);
                    unwanted.store(signal.is_err(), Relaxed);
                }
            }
        });
    });
    signal?;
    found.unwrap_or_else(|| Err(PyRuntimeError::new_err("the computation gave no result").into()))
}

/// Computes what is soon done at once, all else [`in_parallel`].
pub fn compute<T: Send>(
    py: Python<'_>,
    is_short: bool,
    work: impl FnOnce(&Progress<'_>) -> Result<T, Failure> + Send,
) -> Result<T, Failure> {
    match is_short {
        true => py.detach(|| work(&|_| ControlFlow::Continue(()))),
        false => in_parallel(py, work),
    }
}

/// Ends a computation whose result nobody waits for.
pub fn go_on(progress: &Progress<'_>) -> Result<(), Failure> {
    match progress(0) {
        ControlFlow::Continue(()) => Ok(()),
        ControlFlow::Break(()) => Err(eigenbody::Error::Interrupted.into()),
    }
}

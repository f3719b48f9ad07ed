//! Ctrl-C, and whatever else asks the process to end.
//!
//! ```text
//! first signal     what the command put down for it, else as the second
//! second signal    temporary files are removed; status 130
//! ```

use eigenbody_report::file::remove_unfinished;
use std::sync::{Mutex, PoisonError};

/// Status of a run that was interrupted, as a shell has it.
pub const STATUS: u8 = 130;

type Action = Box<dyn FnOnce() + Send>;

static FIRST: Mutex<Option<Action>> = Mutex::new(None);

/// Listens for SIGINT, SIGTERM and SIGHUP.
///
/// Where one of them is ignored, as under `nohup`, or no handler can be set, signals do what they do by themselves.
pub fn listen() {
    _ = ctrlc::try_set_handler(|| {
        let action = FIRST.lock().unwrap_or_else(PoisonError::into_inner).take();
        match action {
            Some(action) => action(),
            None => remove_unfinished(|| std::process::exit(STATUS.into())),
        }
    });
}

/// What the first signal does in place of ending the process.
pub fn at_first(action: impl FnOnce() + Send + 'static) {
    *FIRST.lock().unwrap_or_else(PoisonError::into_inner) = Some(Box::new(action));
}

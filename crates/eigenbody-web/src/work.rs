//! Computations, off the threads that talk: a bounded number at once, a bounded number waiting.

use crate::refusal::Refusal;
use std::sync::Arc;
use std::thread::available_parallelism;
use tokio::sync::Semaphore;
use tokio::task::spawn_blocking;

/// Requests that wait for a turn; more are sent away.
const WAITING: usize = 512;
/// Long computations at once. Each uses all cores.
const LONG: usize = 1;

/// Whose turn it is.
pub struct Workers {
    quick: Arc<Semaphore>,
    long: Arc<Semaphore>,
    waiting: Semaphore,
    threads: usize,
}

/// How long a computation may be expected to take.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Pace {
    /// Milliseconds.
    Quick,
    /// Seconds.
    Long,
}

impl Workers {
    /// One quick computation a core.
    pub fn new() -> Self {
        let cores = available_parallelism().map_or(2, usize::from).max(2);
        let (quick, long) = (Arc::new(Semaphore::new(cores)), Arc::new(Semaphore::new(LONG)));
        Self { quick, long, waiting: Semaphore::new(WAITING), threads: cores + LONG }
    }

    /// Threads that this takes at most.
    pub fn threads(&self) -> usize {
        self.threads
    }

    /// Runs a computation when it is its turn. One whose asker has gone is not begun.
    pub async fn run<T: Send + 'static>(
        &self,
        pace: Pace,
        work: impl FnOnce() -> Result<T, Refusal> + Send + 'static,
    ) -> Result<T, Refusal> {
        let place = self.waiting.try_acquire().map_err(|_| Refusal::busy())?;
        let turns = match pace {
            Pace::Quick => &self.quick,
            Pace::Long => &self.long,
        };
        let turn = Arc::clone(turns).acquire_owned().await.map_err(|_| Refusal::internal("no turns"))?;
        drop(place);
        let done = spawn_blocking(move || {
            let result = work();
            // Given back when the work ends, not when its asker goes.
            drop(turn);
            result
        });
        done.await.map_err(|_| Refusal::internal("a computation broke off"))?
    }
}

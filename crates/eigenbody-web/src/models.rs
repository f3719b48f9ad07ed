//! Robots in use, the latest used first; what does not fit is forgotten.

use crate::robot::{Request, Robot};
use std::collections::VecDeque;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Most robots.
const COUNT: usize = 128;
/// Most bytes, roughly, of all but the latest.
const BYTES: usize = 96 << 20;

/// A cache by id.
#[derive(Default)]
pub struct Models(Mutex<Shelf>);

#[derive(Default)]
struct Shelf {
    next: u64,
    robots: VecDeque<Arc<Robot>>,
}

impl Models {
    /// The robot with an id.
    pub fn get(&self, id: &str) -> Option<Arc<Robot>> {
        let mut shelf = self.shelf();
        let k = shelf.robots.iter().position(|robot| robot.id == id)?;
        let robot = shelf.robots.remove(k)?;
        shelf.robots.push_front(Arc::clone(&robot));
        Some(robot)
    }

    /// The robot that this request made, if it is still there.
    pub fn made_by(&self, request: &Request) -> Option<Arc<Robot>> {
        let id = self.shelf().robots.iter().find(|robot| robot.request == *request)?.id.clone();
        self.get(&id)
    }

    /// A new id.
    pub fn next_id(&self) -> String {
        let mut shelf = self.shelf();
        shelf.next += 1;
        shelf.next.to_string()
    }

    /// Keeps a robot, and forgets those that were not used for longest.
    pub fn keep(&self, robot: Arc<Robot>) {
        let mut shelf = self.shelf();
        shelf.robots.push_front(robot);
        let mut bytes = 0;
        let mut kept = 0;
        for robot in &shelf.robots {
            bytes += robot.bytes();
            if kept == COUNT || (kept > 0 && bytes > BYTES) {
                break;
            }
            kept += 1;
        }
        shelf.robots.truncate(kept);
    }

    fn shelf(&self) -> MutexGuard<'_, Shelf> {
        // Nothing is left half done in there.
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

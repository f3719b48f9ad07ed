//! The worst configuration: a search over all that a robot's joints allow.
//!
//! ```text
//! low-discrepancy samples  ->  the worst of them, by several measures  ->  descent from each by exact gradients  ->  the worst of all
//! ```

mod descent;
mod domain;
mod evaluate;
mod worst;

pub use crate::conditioning::{Measure, Values};
pub use descent::{Landscape, descend};
pub use domain::{Domain, Point};
pub use evaluate::Evaluator;
pub use worst::{Effort, Spread, Survey, sample_points, survey};

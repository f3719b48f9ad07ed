//! Many robots in many configurations: a plan of numbered cases, in chunks that may be computed anywhere and in any order.
//!
//! ```text
//! spec -> plan: cases 0 .. count, case = (robot, configuration), the configuration innermost
//! chunk k = cases [k·size, (k+1)·size)    size from the plan alone
//! random numbers of a case = mix(seed, case), so that no case depends on who computes it
//! ```

mod document;
mod fingerprint;
mod plan;
mod quantity;
mod spec;

pub use plan::{Case, Chunk, Plan, SweepError};
pub use quantity::Quantity;
pub use spec::{Axis, Group, Places, Robots, Spec, SpecError};

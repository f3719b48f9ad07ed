//! What a live picture of a robot asks for: where it stands, how a mode moves it, κ along a line and over a plane, and edits.
//!
//! Each function answers one question about one robot from scratch and keeps nothing, so that any number may run at once.

mod edit;
mod even_box;
mod field;
mod stance;
mod swing;

pub use edit::{EditError, Edits, edited, link_inertia};
pub use even_box::{EvenBox, even_box};
pub use field::{Line, Plane, line, plane};
pub use stance::{Stance, extent, pose, settled, stance};
pub use swing::{Swing, swing};

//! Figures: SVG from tables, PNG from the same SVG.
//!
//! [`draw`] knows how each experiment of a study is drawn; [`Plot`] and [`mechanism`] are what it draws with. [`pose`] draws any robot in
//! any configuration, [`heat`] a matrix. Curves differ in
//! colour (Okabe & Ito's palette, safe for colour-blind readers), in dashes and in markers, so that they can be told apart in grey.

mod axis;
pub mod heat;
pub mod mechanism;
mod motion;
mod papers;
mod plot;
#[cfg(feature = "png")]
mod png;
pub mod pose;
mod scene;
mod style;

pub use axis::{Axis, Scale};
pub use motion::{Series, motion};
pub use papers::{Growth, draw, growth};
pub use plot::{Curve, Panel, Plot};
#[cfg(feature = "png")]
pub use png::{PngError, png};
pub use scene::{Anchor, Scene};
pub use style::{Marker, Style};

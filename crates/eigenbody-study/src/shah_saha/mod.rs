//! S. V. Shah, S. K. Saha, *Correlation between diagonal ratio and condition number of the generalized inertia matrix of a
//! serial-chain*, Archive of Mechanical Engineering 60 (2013): a function a figure.
//!
//! The paper does not print how its motions start nor how long they last. Here every chain starts at rest, straight, 30° from the
//! vertical, as its numbers for φ imply, and swings for 10 s.

mod beyond;
mod example;
mod swing;

pub use beyond::{robots, wide_swing};
pub use example::{eq7, eq11, fig1};
pub use swing::{fig2, fig3, fig4, fig5};

use crate::experiment::{Experiment, Outcome, Paper};
use crate::lab::{Lab, StudyError};

const fn experiment(
    id: &'static str,
    title: &'static str,
    seen: &'static str,
    claims: &'static [&'static str],
    effort: u64,
    compute: fn(&Lab<'_>) -> Result<Outcome, StudyError>,
) -> Experiment {
    Experiment { id, paper: Paper::ShahSaha, title, seen, claims, effort, compute }
}

/// Every figure and every printed number, in the paper's order.
#[rustfmt::skip]
pub static EXPERIMENTS: [Experiment; 9] = [
    experiment("S-fig1", "a 4-link chain, 30° from the vertical", "Four slender rods of 1 m, at rest.", &[], 1, fig1),
    experiment("S-eq7", "Eqs. 7 to 9: inertia matrix, forces and accelerations of the 4-link chain", "Forces rounded by less than 0.7% give accelerations off by up to 55%.", &["S-eq7", "S-eq7-phi", "S-eq8", "S-eq9", "S-kappa"], 1, eq7),
    experiment("S-eq11", "Eqs. 11 and 12: the matrix by DeNOC beside composite rigid bodies", "Two formulations, the same matrix to rounding.", &["S-eq11"], 2, eq11),
    experiment("S-fig2", "properties of the inertia matrix of a swinging 4-link chain", "The largest diagonal element follows the largest eigenvalue, the diagonal ratio follows κ.", &["S-fig2"], 5, fig2),
    experiment("S-fig3", "κ and diagonal ratio of swinging 10- and 20-link chains", "The ratio shows when κ rises and falls, not how large it is.", &["S-fig3"], 20, fig3),
    experiment("S-fig4", "pivot ratios of 10- and 20-link chains", "Pivots say little about κ.", &["S-fig4"], 20, fig4),
    experiment("S-fig5", "κ and scaled diagonal ratio of 4-, 10- and 20-link chains", "Scaled by its first value the ratio comes near κ as long as the swing is small.", &["S-fig5"], 20, fig5),
    experiment("S-beyond-swing", "a 4-link chain released horizontally: κ, its scaled ratio, its bracket", "On a wide swing the scaled ratio misses κ by a factor of several; the bracket always holds it.", &[], 5, wide_swing),
    experiment("S-beyond-robots", "the estimators on trees and on a real arm, in random configurations", "Scaled at one configuration, the ratio can be far off at another; r ≤ κ ≤ rκ′ never is.", &[], 5, robots),
];

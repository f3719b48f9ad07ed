//! R. Featherstone, *An Empirical Study of the Joint Space Inertia Matrix*, Int. J. Robotics Research 23 (2004): a function a figure.
//!
//! Postures that the paper draws without naming their angles are chosen here; the claims name theirs.

mod branching;
mod curves;
mod eigenvalues;
mod example;
mod floating;
mod growth;
mod mechanisms;
mod metric;
mod modes;
mod sizes;

pub use branching::{fig16, fig17};
pub use eigenvalues::{fig11, fig12, fig13};
pub use example::eq1;
pub use floating::{fig18, fig19};
pub use growth::{asymptotic, fig6, fig6_beyond, fig7, fig7_beyond, fig8};
pub use mechanisms::{fig1, fig2, fig3, fig4, fig5};
pub use metric::{fig20, fig21, h_prime};
pub use modes::{fig14, fig15};
pub use sizes::{fig9, fig9_beyond, fig10};

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
    Experiment { id, paper: Paper::Featherstone, title, seen, claims, effort, compute }
}

/// Every figure and every printed number, in the paper's order.
#[rustfmt::skip]
pub static EXPERIMENTS: [Experiment; 28] = [
    experiment("F-fig1", "hydra(8,1,0,1) in zag(π/2)", "An unremarkable planar arm of eight links: κ = 1515.", &[], 1, fig1),
    experiment("F-eq1", "Eq. 1: torques rounded to three figures", "Torques off by less than 0.5% give accelerations off by up to 50%.", &["F-eq1-tau", "F-eq1-qdd", "F-eq1-kappa"], 1, eq1),
    experiment("F-fig2", "a kinematic tree with a branching factor of 1.5", "Nodes have one child and two children in turn.", &["F-fig2"], 1, fig2),
    experiment("F-fig3", "link 1 of hydra(N,B,α,ρ)", "A thin tube with its inboard axis at one end and its outboard axis, turned by α, at the other.", &["F-erratum"], 1, fig3),
    experiment("F-fig4", "a physical realisation of onion(2,1,α,ρ)", "Shells that turn about axes through one point.", &[], 1, fig4),
    experiment("F-fig5", "zag and curl configurations of hydra(N,1,0,1)", "In zag(3.0) five links are wider than long, twenty-two are longer than wide.", &[], 1, fig5),
    experiment("F-fig6", "condition number of hydra(N,1,0,1) in zag(θ)", "Two slopes, 4 and 2. A zigzag changes from one to the other where it is as long as it is wide.", &["F-fig6", "F-fig6-values"], 3, fig6),
    experiment("F-fig6-beyond", "figure 6 up to a million links", "The slope of 4 holds to N = 10⁶, where κ is 4·10²⁴: far past double precision for a matrix, not for the tree.", &[], 500, fig6_beyond),
    experiment("F-fig7", "condition number of hydra(N,1,0,1) in curl(θ)", "Slope 4 until the chain closes into a circle, an undulation, then slope 2.", &["F-fig7"], 3, fig7),
    experiment("F-fig7-beyond", "figure 7 up to a million links", "Once wound up, every curve settles on slope 2.", &[], 500, fig7_beyond),
    experiment("F-fig8", "hydra(N,1,0.5,1) beside hydra(N,1,0,1) in zag(θ)", "Skewed axes lower κ by up to 2.5 and change nothing else.", &["F-fig8"], 3, fig8),
    experiment("F-fig9", "hydra(N,1,0,ρ) at curl(0) and curl(π/2)", "A fixed taper makes κ grow exponentially. Curves stop where a dense double-precision solver does.", &["F-fig9"], 5, fig9),
    experiment("F-fig9-beyond", "figure 9 past double precision", "On the tree nothing stops: the same curves to κ = 10⁹⁰.", &[], 5, fig9_beyond),
    experiment("F-fig10", "hydra(N,1,0,ρ) with fixed ratio R of last to first link", "A fixed ratio of sizes costs a constant factor: all curves become parallel to R = 1.", &["F-fig10"], 20, fig10),
    experiment("F-fig11", "eigenvalues of hydra(N,1,0,1) at zag(0)", "κ grows because λmax does; λmin settles at 0.021 kg m², a quarter of a single link's smallest inertia.", &["F-fig11"], 5, fig11),
    experiment("F-fig12", "eigenvalues of hydra(N,1,0,1) at zag(0) by normalised period", "Like the periods of a vibrating beam: the i-th largest falls as about 1/i⁴.", &["F-fig12"], 2, fig12),
    experiment("F-fig13", "effect of tapering on eigenvalues of hydra(50,1,0,ρ) at curl(2.2)", "Taper tilts the staircase and smooths it.", &["F-fig13"], 2, fig13),
    experiment("F-fig14", "largest eigenvectors of hydra(20,1,0,1) and hydra(10,1,0,1) at zag(0)", "The largest has one sign throughout: small turns add up along the chain.", &["F-fig14"], 1, fig14),
    experiment("F-fig15", "hydra(10,1,0,1) and hydra(20,1,0,1) in 0.2 times their largest eigenvectors", "Vectors of the same length bend the longer chain more: a gear of √N.", &["F-fig15"], 1, fig15),
    experiment("F-asymptotic", "κ/(N H₁₁/H_NN) of unbranched chains", "The product of gearing and inertia ratio grows as κ does.", &["F-asymptotic"], 3, asymptotic),
    experiment("F-fig16", "condition number of onion(N,B,α,1)", "Branching takes one power of N away.", &["F-fig16"], 5, fig16),
    experiment("F-fig17", "largest eigenvectors of onion(33,B,0,1)", "Motion gathers in the joints that carry most links.", &["F-fig17"], 1, fig17),
    experiment("F-fig18", "free-floating hydra(N+1,1,0,1) beside fixed hydra(N,1,0,1) in zag(θ)", "The same curves, lower by 4 and by 40.", &["F-fig18", "F-fig18-extreme"], 3, fig18),
    experiment("F-fig19", "fixed hydra(10,1,0,1) and free-floating hydra(11,1,0,1) in 0.2 times their largest eigenvectors", "The free robot bends about its still centre of mass; each half is like a fixed robot of half the length.", &["F-fig19"], 1, fig19),
    experiment("F-fig20", "κ and κ′ of hydra(N,1,0,1) in zag(θ)", "Units of inertia instead of radians change little: unequal diagonal entries are not the cause.", &["F-fig20"], 5, fig20),
    experiment("F-fig21", "κ and κ′ of hydra(N,1,0,ρ) at curl(0)", "With taper κ explodes and κ′ converges.", &["F-fig21"], 5, fig21),
    experiment("F-Hprime", "H′ of hydra(5,1,0,ρ) at curl(0)", "The smaller its neighbours, the less a link feels of them: off-diagonal entries fall with taper.", &["F-Hprime-1", "F-Hprime-half"], 1, h_prime),
    experiment("F-Imin", "λmin of hydra(N,1,0,1) in zag(θ) against θ", "Between 0.021 kg m² stretched out and 0.164 kg m² at θ = 2.45.", &[], 3, eigenvalues::smallest),
];

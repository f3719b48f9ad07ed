//! What can be watched along a motion, what it costs and how far it may be off.

use crate::row::Field;

/// A quantity that is computed for every row.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// κ = λmax/λmin.
    Kappa,
    /// κ′, of H with its diagonal scaled to one.
    KappaWeighted,
    /// λmin.
    LambdaMin,
    /// λmax.
    LambdaMax,
    /// The softest and the stiffest mode.
    Modes,
    /// r = max H_dd/min H_dd.
    DiagonalRatio,
    /// δ κ(0)/δ(0).
    ScaledDiagonalRatio,
    /// Largest over smallest pivot of Gaussian elimination.
    PivotRatio,
    /// r ≤ κ ≤ r κ′.
    Bracket,
    /// All eigenvalues.
    Eigenvalues,
    /// Kinetic, potential and total energy.
    Energy,
    /// Momentum of the whole mechanism.
    Momentum,
}

/// What is said of a quantity.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct About {
    /// Its name on the command line, and of its columns unless they have their own.
    pub name: &'static str,
    /// What it is.
    pub what: &'static str,
    /// What a row costs.
    pub cost: &'static str,
    /// How far it may be off.
    pub error: &'static str,
}

/// What the tracker promises.
const TRACKED: &str = "exact: to 3e-13 of itself, its place in the spectrum certified by count";
/// What the tracker costs.
const SWEEP: &str = "about one O(N) factor-and-solve, shared by both ends";

impl Quantity {
    /// All of them.
    pub const ALL: [Self; 12] = [
        Self::Kappa,
        Self::KappaWeighted,
        Self::LambdaMin,
        Self::LambdaMax,
        Self::Modes,
        Self::DiagonalRatio,
        Self::ScaledDiagonalRatio,
        Self::PivotRatio,
        Self::Bracket,
        Self::Eigenvalues,
        Self::Energy,
        Self::Momentum,
    ];

    /// Name, meaning, cost and error.
    pub fn about(self) -> About {
        let about = |name, what, cost, error| About { name, what, cost, error };
        match self {
            Self::Kappa => about("kappa", "κ = λmax/λmin", SWEEP, TRACKED),
            Self::KappaWeighted => about(
                "kappa_weighted",
                "κ′: κ of H with unit diagonal",
                "as kappa, and the diagonal",
                TRACKED,
            ),
            Self::LambdaMin => about("lambda_min", "smallest eigenvalue", "with kappa", TRACKED),
            Self::LambdaMax => about("lambda_max", "largest eigenvalue", "with kappa", TRACKED),
            Self::Modes => about(
                "modes",
                "softest and stiffest mode",
                "with kappa",
                "angle at most 6e-7 √(λ/gap), gap to the next eigenvalue",
            ),
            Self::DiagonalRatio => about(
                "diagonal_ratio",
                "r = max H_dd/min H_dd",
                "O(N): composite inertias",
                "a lower bound of κ; κ may be κ′ times larger",
            ),
            Self::ScaledDiagonalRatio => about(
                "scaled_diagonal_ratio",
                "δ_s = r κ(0)/r(0), Shah & Saha Eq. 15",
                "as diagonal_ratio",
                "an estimate without bound, exact at the start",
            ),
            Self::PivotRatio => about(
                "pivot_ratio",
                "largest over smallest pivot of elimination",
                "H by CRBA and elimination, O(n³)",
                "an estimate without bound",
            ),
            Self::Bracket => about(
                "bracket",
                "r ≤ κ ≤ r κ′, as bracket_lo and bracket_hi",
                "as diagonal_ratio and kappa_weighted",
                "holds always",
            ),
            Self::Eigenvalues => about(
                "eigenvalues",
                "all eigenvalues, ascending",
                "H by CRBA, dense, O(n³)",
                "about ε λmax each",
            ),
            Self::Energy => {
                about("energy", "energy, with kinetic and potential", "O(N)", "a sum of squares: a few ε")
            }
            Self::Momentum => about(
                "momentum",
                "[angular; linear], about the world's origin",
                "O(N)",
                "a few ε of the links' momenta",
            ),
        }
    }

    /// The quantity with this name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|quantity| quantity.about().name == name)
    }

    /// Its columns.
    pub fn fields(self, unit: &str) -> Vec<Field> {
        let name = self.about().name;
        match self {
            Self::LambdaMin | Self::LambdaMax => vec![Field::number(name, unit)],
            Self::Modes => vec![Field::list("softest_mode", "1"), Field::list("stiffest_mode", "1")],
            Self::Bracket => vec![Field::number("bracket_lo", "1"), Field::number("bracket_hi", "1")],
            Self::Eigenvalues => vec![Field::list(name, unit)],
            Self::Energy => {
                ["energy", "kinetic_energy", "potential_energy"].map(|name| Field::number(name, "J")).into()
            }
            Self::Momentum => vec![Field::list(name, "kg m^2/s, kg m/s")],
            _ => vec![Field::number(name, "1")],
        }
    }
}

//! What contestants compute.

/// A quantity of a robot at a state.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// τ.
    Rnea,
    /// v̇.
    Aba,
    /// The upper triangle of H.
    Upper,
    /// H.
    Crba,
    /// H, but for its zeros between branches: of batches.
    Entries,
    /// C.
    Bias,
    /// λmin and λmax of H.
    Extremes,
    /// κ and κ′.
    Conditioning,
    /// λmin and λmax of an H that is given.
    Eigenvalues,
}

impl Quantity {
    pub const ALL: [Self; 9] = [
        Self::Rnea,
        Self::Aba,
        Self::Upper,
        Self::Crba,
        Self::Entries,
        Self::Bias,
        Self::Extremes,
        Self::Conditioning,
        Self::Eigenvalues,
    ];

    /// What tables and programs call it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Rnea => "rnea",
            Self::Aba => "aba",
            Self::Upper => "upper",
            Self::Crba => "crba",
            Self::Entries => "entries",
            Self::Bias => "bias",
            Self::Extremes => "extremes",
            Self::Conditioning => "conditioning",
            Self::Eigenvalues => "eigenvalues",
        }
    }

    /// What has the same numbers, one configuration at a time.
    pub fn one_by_one(self) -> Self {
        match self {
            Self::Entries => Self::Crba,
            other => other,
        }
    }
}

//! What can go wrong with an input. Every failure says where and what was expected.

use thiserror::Error;

/// An argument that a function cannot work with.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum InputError {
    /// A slice of the wrong length.
    #[error("{what} has {found} {}, expected {expected}", if *found == 1 { "number" } else { "numbers" })]
    Length {
        /// Name of the argument, in the words of NOTATION.md.
        what: &'static str,
        /// Length that the model asks for.
        expected: usize,
        /// Length that was given.
        found: usize,
    },
    /// Room or factors of one model, given with another.
    #[error("{what} was made for a model with other bodies or joints")]
    OtherModel {
        /// Name of the argument.
        what: &'static str,
    },
    /// What follows from finite numbers is none: it is beyond the range of the scalar.
    #[error("{what} is beyond the range of floating-point numbers")]
    Overflow {
        /// What was to be computed, in the words of NOTATION.md.
        what: &'static str,
    },
    /// A NaN or an infinity.
    #[error("{what}[{index}] is not a finite number")]
    NotFinite {
        /// Name of the argument.
        what: &'static str,
        /// Position of the first offender.
        index: usize,
    },
    /// Four numbers that are not a unit quaternion to within 1e-6.
    #[error("q[{index}..{}] of joint '{joint}' has norm {norm}, expected a unit quaternion w, x, y, z", index + 4)]
    NotUnitQuaternion {
        /// The joint whose coordinates they are.
        joint: String,
        /// Position of w in q.
        index: usize,
        /// Norm of the four numbers.
        norm: f64,
    },
    /// An orientation whose E Eᵀ is not 1 to within 1e-6, or a reflection.
    #[error("an anchor of closure '{closure}' has an orientation that is no rotation")]
    NotARotation {
        /// Name of the closure whose anchor it is.
        closure: String,
    },
    /// An axis whose length is not 1 to within 1e-6.
    #[error("closure '{closure}' has an axis of length {length}, expected a unit vector")]
    NotAUnitVector {
        /// Name of the closure.
        closure: String,
        /// Length of the axis.
        length: f64,
    },
    /// A weight that must be positive and is not.
    #[error("{what}[{index}] = {value}, expected a positive number")]
    NotPositive {
        /// Name of the argument.
        what: &'static str,
        /// Position of the first offender.
        index: usize,
        /// Its value.
        value: f64,
    },
    /// A number that may be zero and is below.
    #[error("{what}[{index}] = {value}, expected zero or more")]
    Negative {
        /// Name of the argument.
        what: &'static str,
        /// Position of the first offender.
        index: usize,
        /// Its value.
        value: f64,
    },
    /// An index beyond what the model has.
    #[error("there is no {what} number {index}, counted from 0: the model has {count}")]
    NoSuch {
        /// What is counted.
        what: &'static str,
        /// The index that was given.
        index: usize,
        /// How many there are.
        count: usize,
    },
    /// A link that is fastened to the world has no inertia that matters.
    #[error("link '{link}' does not move")]
    Immovable {
        /// Its name.
        link: String,
    },
    /// Limits belong to joints with one coordinate.
    #[error("joint '{joint}' has not one coordinate, and can have no limits")]
    SeveralCoordinates {
        /// Its name.
        joint: String,
    },
    /// A lower limit above the upper one.
    #[error("joint '{joint}' has lower limit {lower} above upper limit {upper}")]
    CrossedLimits {
        /// Its name.
        joint: String,
        /// The lower limit (rad, m).
        lower: f64,
        /// The upper limit (rad, m).
        upper: f64,
    },
    /// A dense matrix that would not fit.
    #[error("a dense matrix of {nv} × {nv} entries is too large (limit {limit} × {limit})")]
    TooLargeForDense {
        /// Degrees of freedom of the model.
        nv: usize,
        /// Largest dimension that is formed.
        limit: usize,
    },
    /// Mimic joints couple degrees of freedom across the tree.
    #[error(
        "mimic joints break the tree that the method needs; use the dense method or let them move freely"
    )]
    NotATree,
    /// A base that a loop holds cannot be removed.
    #[error("a loop ties the floating base to the world: it cannot be removed")]
    LoopHoldsBase,
    /// The operation needs a floating base and the model has none.
    #[error("the model has no floating base")]
    NoFloatingBase,
}

/// Elimination met a pivot that is not positive: H is singular or indefinite to working precision.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[error("the mass matrix is not positive definite: pivot {pivot:e} at degree of freedom {dof}")]
pub struct NotPositiveDefinite {
    /// DoF at which elimination stopped.
    pub dof: usize,
    /// Value of the pivot.
    pub pivot: f64,
}

/// Any failure of an algorithm on a model.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum Error {
    /// The input was refused.
    #[error(transparent)]
    Input(#[from] InputError),
    /// The mass matrix is singular or indefinite.
    #[error(transparent)]
    NotPositiveDefinite(#[from] NotPositiveDefinite),
    /// Loops that do not close near a configuration.
    #[error(
        "{closure} stays open by {after:.1e} (m, rad) after {steps} steps from {before:.1e}: start nearer to a closed configuration"
    )]
    Open {
        /// The closure that is open the farthest.
        closure: String,
        /// How far loops were open at first (m, rad).
        before: f64,
        /// How far at last.
        after: f64,
        /// Steps that were taken.
        steps: usize,
    },
    /// An iteration did not settle; the matrix is returned to the user's care.
    #[error("eigenvalue {index} did not converge in {iterations} iterations")]
    NoConvergence {
        /// Position of the eigenvalue in the tridiagonal matrix.
        index: usize,
        /// Iterations spent on it.
        iterations: usize,
    },
    /// Whoever was told of the progress wanted no more of it.
    #[error("interrupted")]
    Interrupted,
}

/// Refuses a length that is not the expected one.
#[inline]
pub(crate) fn check_length(what: &'static str, found: usize, expected: usize) -> Result<(), InputError> {
    if found == expected { Ok(()) } else { Err(InputError::Length { what, expected, found }) }
}

//! A column of S: one of the six unit vectors, or any.

use crate::scalar::Scalar;
use crate::spatial::{Force, Motion};

/// What is known of a column of S without looking at q.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Column {
    AngX,
    AngY,
    AngZ,
    LinX,
    LinY,
    LinZ,
    General,
}

impl Column {
    /// Which unit vector it is.
    #[inline(always)]
    pub fn place(self) -> Option<usize> {
        match self {
            Self::General => None,
            unit => Some(unit as usize),
        }
    }

    /// Sᵀ f.
    #[inline(always)]
    pub fn along<T: Scalar>(self, S: Motion<T>, f: Force<T>) -> T {
        match self {
            Self::AngX => f.ang.x,
            Self::AngY => f.ang.y,
            Self::AngZ => f.ang.z,
            Self::LinX => f.lin.x,
            Self::LinY => f.lin.y,
            Self::LinZ => f.lin.z,
            Self::General => S.dot(f),
        }
    }

    /// a + S x.
    #[inline(always)]
    pub fn moved<T: Scalar>(self, mut a: Motion<T>, S: Motion<T>, x: T) -> Motion<T> {
        match self {
            Self::AngX => a.ang.x += x,
            Self::AngY => a.ang.y += x,
            Self::AngZ => a.ang.z += x,
            Self::LinX => a.lin.x += x,
            Self::LinY => a.lin.y += x,
            Self::LinZ => a.lin.z += x,
            Self::General => a += S * x,
        }
        a
    }
}

//! What the numbers of a robot may be, in a description and in a change of a model alike.

use crate::error::InputError;
use crate::scalar::Real;
use crate::spatial::RigidInertia;

/// Why a number is impossible.
pub(super) enum Fault {
    /// A NaN or an infinity, and which number it is of those that were given.
    NotFinite { what: &'static str, index: usize },
    /// A number below zero where there can be none.
    Negative { what: &'static str, index: usize, value: f64 },
}

impl From<Fault> for InputError {
    fn from(fault: Fault) -> Self {
        match fault {
            Fault::NotFinite { what, index } => Self::NotFinite { what, index },
            Fault::Negative { what, index, value } => Self::Negative { what, index, value },
        }
    }
}

fn finite<T: Real>(what: &'static str, numbers: &[T]) -> Result<(), Fault> {
    match numbers.iter().position(|x| !x.is_finite()) {
        Some(index) => Err(Fault::NotFinite { what, index }),
        None => Ok(()),
    }
}

fn not_negative<T: Real>(what: &'static str, numbers: &[T]) -> Result<(), Fault> {
    finite(what, numbers)?;
    match numbers.iter().position(|&x| x < T::ZERO) {
        Some(index) => Err(Fault::Negative { what, index, value: numbers[index].to_f64() }),
        None => Ok(()),
    }
}

pub(super) fn check_inertia<T: Real>(inertia: &RigidInertia<T>) -> Result<(), Fault> {
    let I = inertia.I;
    not_negative("mass", &[inertia.m])?;
    finite("centre of mass", &inertia.h.to_array())?;
    finite("inertia", &[I.xx, I.yy, I.zz, I.xy, I.xz, I.yz])
}

pub(super) fn check_armature<T: Real>(armature: &[T]) -> Result<(), Fault> {
    not_negative("armature", armature)
}

/// Limits may be infinite. Returned are a lower limit and an upper one below it.
pub(super) fn crossed_limits<T: Real>(limits: Option<(T, T)>) -> Result<Option<(f64, f64)>, Fault> {
    let limits = limits.map(|(lower, upper)| [lower.to_f64(), upper.to_f64()]);
    if let Some(index) = limits.and_then(|limits| limits.iter().position(|x| x.is_nan())) {
        return Err(Fault::NotFinite { what: "limit", index });
    }
    Ok(limits.and_then(|[lower, upper]| (lower > upper).then_some((lower, upper))))
}

//! What the papers print, and what becomes of it.

mod printed;

pub use printed::CLAIMS;

use std::fmt;

/// How a claim is meant.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// Numbers that are right as printed.
    Exact,
    /// Numbers that the paper rounds further than its digits show: "about 1500".
    Rounded,
    /// Numbers that carry the round-off of the paper's own computation.
    RoundOff,
    /// A statement about a curve, tested by [`Check`]s.
    Shape,
}

/// One claim of a paper.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Claim {
    /// Its name.
    pub id: &'static str,
    /// What is claimed.
    pub what: &'static str,
    /// How it is meant.
    pub kind: Kind,
    /// The numbers as the paper has them.
    pub printed: &'static [f64],
    /// The same numbers computed at high precision, where that was done; else empty.
    pub exact: &'static [f64],
    /// How far a computed number may be from the printed one: absolute, and relative.
    pub tolerance: (f64, f64),
    /// How far it may be from the exact one, relative.
    pub exact_tolerance: f64,
    /// What must be known to compute it; empty if the paper says all.
    pub note: &'static str,
}

/// What became of a claim.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// The printed numbers are right.
    Agrees,
    /// Right, but for rounding that the digits do not show.
    PaperRounds,
    /// The printed numbers carry round-off; the computed ones are exact.
    PaperRoundOff,
    /// What is said about the curve is so.
    ShapeHolds,
    /// Not reproduced.
    Fails,
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Agrees => "agrees",
            Self::PaperRounds => "paper rounds",
            Self::PaperRoundOff => "paper's round-off",
            Self::ShapeHolds => "shape holds",
            Self::Fails => "fails",
        })
    }
}

/// A number that must lie in an interval.
#[derive(Debug, Clone, PartialEq)]
pub struct Check {
    /// What the number is.
    pub what: String,
    /// The number.
    pub found: f64,
    /// Half the width of its confidence interval, for a fitted slope.
    pub half_width: Option<f64>,
    /// Where it must lie.
    pub low: f64,
    /// Where it must lie.
    pub high: f64,
}

impl Check {
    /// `found` must lie in [low, high].
    pub fn within(what: impl Into<String>, found: f64, low: f64, high: f64) -> Self {
        Self { what: what.into(), found, half_width: None, low, high }
    }

    /// A fitted slope must lie in [low, high].
    pub fn slope(what: impl Into<String>, line: crate::fit::Line, low: f64, high: f64) -> Self {
        Self { half_width: Some(line.half_width), ..Self::within(what, line.slope, low, high) }
    }

    /// Something is so, or not.
    pub fn truth(what: impl Into<String>, holds: bool) -> Self {
        Self::within(what, f64::from(u8::from(holds)), 1.0, 1.0)
    }

    /// True if the number lies where it must.
    pub fn holds(&self) -> bool {
        (self.low..=self.high).contains(&self.found)
    }
}

/// A claim, computed.
#[derive(Debug, Clone, PartialEq)]
pub struct Reading {
    /// The claim.
    pub claim: &'static Claim,
    /// The computed numbers, beside [`Claim::printed`].
    pub computed: Vec<f64>,
    /// What else was tested.
    pub checks: Vec<Check>,
    /// What there is to say.
    pub note: String,
    /// What became of it.
    pub verdict: Verdict,
}

impl Reading {
    /// Judges the claim named `id` by computed numbers (none for a shape) and by checks. An unknown name is judged as a failure.
    pub fn new(id: &'static str, computed: Vec<f64>, checks: Vec<Check>) -> Self {
        static UNKNOWN: Claim = Claim::shape("?", "unknown claim");
        let claim = CLAIMS.iter().find(|claim| claim.id == id).unwrap_or(&UNKNOWN);
        let all = |expected: &[f64], absolute: f64, relative: f64| {
            let near = |(c, e): (&f64, &f64)| (c - e).abs() <= absolute + relative * e.abs();
            expected.len() == computed.len() && computed.iter().zip(expected).all(near)
        };
        let is_exact = claim.exact.is_empty() || all(claim.exact, 0.0, claim.exact_tolerance);
        let (absolute, relative) = claim.tolerance;
        let is_near = all(claim.printed, absolute, relative);
        let passed = is_exact && is_near && checks.iter().all(Check::holds);
        let verdict = match claim.kind {
            _ if !passed || claim.id != id => Verdict::Fails,
            Kind::Exact => Verdict::Agrees,
            Kind::Rounded => Verdict::PaperRounds,
            Kind::RoundOff => Verdict::PaperRoundOff,
            Kind::Shape if checks.is_empty() => Verdict::Fails,
            Kind::Shape => Verdict::ShapeHolds,
        };
        Self { claim, computed, checks, note: claim.note.to_owned(), verdict }
    }

    /// A statement about a curve.
    pub fn shape(id: &'static str, checks: Vec<Check>) -> Self {
        Self::new(id, Vec::new(), checks)
    }

    /// The same with something more to say.
    pub fn noting(mut self, note: impl AsRef<str>) -> Self {
        let separator = if self.note.is_empty() { "" } else { "; " };
        self.note = format!("{}{separator}{}", self.note, note.as_ref());
        self
    }

    /// Largest relative difference between printed and computed numbers; none for a shape.
    pub fn difference(&self) -> Option<f64> {
        let pairs = self.computed.iter().zip(self.claim.printed);
        pairs.map(|(c, p)| ((c - p) / p).abs()).reduce(f64::max)
    }
}

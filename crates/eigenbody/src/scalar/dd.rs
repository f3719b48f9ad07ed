//! Double-double arithmetic: a number as the unevaluated sum of two f64, about 32 digits.
//!
//! ```text
//! two_sum:   s = fl(a + b),  e = (a + b) − s      exactly      (Knuth)
//! two_prod:  p = fl(a · b),  e = a · b − p        exactly      (Dekker; one fma where there is one)
//! ```
//! The algorithms are the accurate ones of Joldes, Muller and Popescu, "Tight and rigorous error bounds for basic
//! building blocks of double-word arithmetic" (ACM TOMS 44, 2017): relative error at most 3u² for a sum, 5u² for a
//! product and about 10u² for a quotient, u = 2⁻⁵³. The range is that of f64: what is beyond is no finite number, and below 2⁻⁹⁶⁹
//! low parts fade.

use super::{Real, Scalar, Trig, only_itself};
use std::cmp::Ordering;
use std::fmt;
use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

/// A double-double number `hi + lo`, |lo| ≤ ulp(hi)/2. The oracle against which every error is measured.
///
/// ```
/// use eigenbody::scalar::{Dd, Scalar};
/// let third = Dd::ONE / Dd::from_f64(3.0);
/// assert_eq!(third * Dd::from_f64(3.0), Dd::ONE);
/// assert!(third.lo() != 0.0);
/// ```
#[derive(Clone, Copy, PartialEq, Default)]
pub struct Dd {
    hi: f64,
    lo: f64,
}

#[inline(always)]
fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let s = a + b;
    let t = s - a;
    (s, (a - (s - t)) + (b - t))
}

/// `two_sum` for |a| ≥ |b| or a = 0.
#[inline(always)]
fn quick_two_sum(a: f64, b: f64) -> (f64, f64) {
    let s = a + b;
    (s, b - (s - a))
}

/// The upper 26 and the lower 27 bits of `a` (Veltkamp).
#[inline(always)]
fn split(a: f64) -> (f64, f64) {
    let c = 134_217_729.0 * a; // 2^27 + 1
    let hi = c - (c - a);
    (hi, a - hi)
}

/// a · b − p for p = fl(a · b).
#[inline(always)]
fn low_part(a: f64, b: f64, p: f64) -> f64 {
    let ((ah, al), (bh, bl)) = (split(a), split(b));
    ((ah * bh - p) + ah * bl + al * bh) + al * bl
}

/// [`low_part`] with a factor beyond 2⁹⁹⁶, whose upper bits alone may be out of range, so that it is no number: all of it by the 2⁵³rd part of that factor.
#[cold]
fn low_part_of_large(a: f64, b: f64, p: f64) -> f64 {
    const UNIT: f64 = (1u64 << 53) as f64;
    let (large, other) = if a.abs() > b.abs() { (a, b) } else { (b, a) };
    low_part(large / UNIT, other, p / UNIT) * UNIT
}

#[inline(always)]
fn two_prod(a: f64, b: f64) -> (f64, f64) {
    let p = a * b;
    if cfg!(target_feature = "fma") {
        return (p, a.mul_add(b, -p));
    }
    let e = low_part(a, b, p);
    (p, if e.is_nan() { low_part_of_large(a, b, p) } else { e })
}

impl Dd {
    /// π.
    pub const PI: Self = Self { hi: std::f64::consts::PI, lo: 1.2246467991473532e-16 };

    /// The sum of two f64, exactly.
    #[inline(always)]
    pub fn from_sum(a: f64, b: f64) -> Self {
        let (hi, lo) = two_sum(a, b);
        Self { hi, lo }
    }

    /// The product of two f64, exactly.
    #[inline(always)]
    pub fn from_product(a: f64, b: f64) -> Self {
        let (hi, lo) = two_prod(a, b);
        Self { hi, lo }
    }

    /// xⁿ by repeated squaring.
    pub fn powi(self, n: u32) -> Self {
        let (mut power, mut square, mut n) = (Self::ONE, self, n);
        while n > 0 {
            if n & 1 == 1 {
                power *= square;
            }
            square *= square;
            n >>= 1;
        }
        power
    }

    /// The n-th root of a number that is not negative: the f64 root and two Newton steps. NaN of a negative number, and for n = 0.
    pub fn root(self, n: u32) -> Self {
        if n == 0 || self < Self::ZERO {
            return Self::from_f64(f64::NAN);
        }
        if self == Self::ZERO {
            return Self::ZERO;
        }
        let order = Self::from_f64(f64::from(n));
        let mut x = Self::from_f64(self.hi.powf(1.0 / f64::from(n)));
        for _ in 0..2 {
            let below = x.powi(n - 1);
            x -= (below * x - self) / (order * below);
        }
        x
    }

    pub(super) const fn from_parts(hi: f64, lo: f64) -> Self {
        Self { hi, lo }
    }

    /// The leading part: the nearest f64.
    #[inline(always)]
    pub fn hi(self) -> f64 {
        self.hi
    }

    /// The trailing part.
    #[inline(always)]
    pub fn lo(self) -> f64 {
        self.lo
    }
}

impl From<f64> for Dd {
    fn from(x: f64) -> Self {
        Self { hi: x, lo: 0.0 }
    }
}

impl Add for Dd {
    type Output = Self;
    #[inline(always)]
    fn add(self, y: Self) -> Self {
        let (s, e) = two_sum(self.hi, y.hi);
        let (t, f) = two_sum(self.lo, y.lo);
        let (s, e) = quick_two_sum(s, e + t);
        let (hi, lo) = quick_two_sum(s, e + f);
        Self { hi, lo }
    }
}

impl Neg for Dd {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self { hi: -self.hi, lo: -self.lo }
    }
}

impl Sub for Dd {
    type Output = Self;
    #[inline(always)]
    fn sub(self, y: Self) -> Self {
        self + -y
    }
}

impl Mul for Dd {
    type Output = Self;
    #[inline(always)]
    fn mul(self, y: Self) -> Self {
        let (p, e) = two_prod(self.hi, y.hi);
        let (hi, lo) = quick_two_sum(p, e + (self.hi * y.lo + self.lo * y.hi));
        Self { hi, lo }
    }
}

impl Div for Dd {
    type Output = Self;
    /// Long division with three partial quotients.
    #[inline(always)]
    fn div(self, y: Self) -> Self {
        let q1 = self.hi / y.hi;
        let r = self - y * Self::from_f64(q1);
        let q2 = r.hi / y.hi;
        let r = r - y * Self::from_f64(q2);
        let q3 = r.hi / y.hi;
        let (hi, lo) = quick_two_sum(q1, q2);
        Self { hi, lo } + Self::from_f64(q3)
    }
}

impl AddAssign for Dd {
    #[inline(always)]
    fn add_assign(&mut self, y: Self) {
        *self = *self + y;
    }
}

impl SubAssign for Dd {
    #[inline(always)]
    fn sub_assign(&mut self, y: Self) {
        *self = *self - y;
    }
}

impl MulAssign for Dd {
    #[inline(always)]
    fn mul_assign(&mut self, y: Self) {
        *self = *self * y;
    }
}

impl PartialOrd for Dd {
    #[inline(always)]
    fn partial_cmp(&self, y: &Self) -> Option<Ordering> {
        match self.hi.partial_cmp(&y.hi) {
            Some(Ordering::Equal) => self.lo.partial_cmp(&y.lo),
            order => order,
        }
    }
}

impl Scalar for Dd {
    type Constant = Self;
    #[inline(always)]
    fn constant(c: Self) -> Self {
        c
    }
    only_itself!();
    const ZERO: Self = Self { hi: 0.0, lo: 0.0 };
    const ONE: Self = Self { hi: 1.0, lo: 0.0 };
    const FUSED: bool = false;
    #[inline(always)]
    fn from_f64(x: f64) -> Self {
        Self { hi: x, lo: 0.0 }
    }
    #[inline(always)]
    fn mul_add(self, a: Self, b: Self) -> Self {
        self * a + b
    }
    /// Karp's trick: one f64 root and one correction; √0 = 0.
    #[inline(always)]
    fn sqrt(self) -> Self {
        let root = self.hi.sqrt();
        let rest = self - Self::from_product(root, root);
        let correction = if root == 0.0 { 0.0 } else { rest.hi / (2.0 * root) };
        Self::from_sum(root, correction)
    }
    #[inline]
    fn sin_cos(self) -> (Self, Self) {
        super::dd_trig::sin_cos(self)
    }
    #[inline(always)]
    fn abs(self) -> Self {
        if self.hi < 0.0 { -self } else { self }
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        if self < other { self } else { other }
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        if self > other { self } else { other }
    }
    #[inline(always)]
    fn select_lt(self, other: Self, yes: Self, no: Self) -> Self {
        if self < other { yes } else { no }
    }
    #[inline(always)]
    fn any_above(self, bound: Self) -> bool {
        self > bound
    }
}

impl Real for Dd {
    const TRIG: Option<Trig<Self>> = None;
    /// 2⁻¹⁰⁴: what a chain of accurate double-double operations can be trusted to.
    const EPSILON: f64 = f64::EPSILON * f64::EPSILON;
    #[inline(always)]
    fn to_f64(self) -> f64 {
        self.hi
    }
    #[inline(always)]
    fn from_dd(x: Dd) -> Self {
        x
    }
}

/// The nearest f64's digits.
impl fmt::Display for Dd {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.hi.fmt(f)
    }
}

impl fmt::Debug for Dd {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:?} + {:?}", self.hi, self.lo)
    }
}

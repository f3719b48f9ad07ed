//! Decimal numbers as double-double ones: the nearest f64, and the nearest f64 to what it leaves.
//!
//! ```text
//! hi = fl(x)      lo = fl(x − hi)      x − hi exactly, digit by digit: a binary fraction is a decimal one
//! ```

use super::Dd;
use std::num::ParseFloatError;
use std::str::FromStr;

/// A decimal number, to the last digit that fits: `0.7` is seven tenths, not the nearest f64.
///
/// What an f64 cannot say at all, because it is too large or too small, `inf` and `nan`, is what `f64` makes of it.
impl FromStr for Dd {
    type Err = ParseFloatError;
    fn from_str(text: &str) -> Result<Self, ParseFloatError> {
        let hi: f64 = text.parse()?;
        if hi == 0.0 || !hi.is_finite() {
            return Ok(hi.into());
        }
        let lo = Decimal::read(text).minus(Decimal::of(hi)).parse::<f64>()?;
        Ok(Self::from_parts(hi, if hi < 0.0 { -lo } else { lo }))
    }
}

/// |x| = digits · 10^−places.
struct Decimal {
    digits: Vec<u8>,
    places: i64,
}

impl Decimal {
    /// A number that f64 reads as neither zero nor infinite: its exponent is of the length of its text.
    fn read(text: &str) -> Self {
        let (number, exponent) = text.split_once(['e', 'E']).unwrap_or((text, "0"));
        let (_, fraction) = number.split_once('.').unwrap_or((number, ""));
        let digits = number.bytes().filter(u8::is_ascii_digit).map(|digit| digit - b'0');
        let places = fraction.len() as i64 - exponent.parse::<i64>().unwrap_or(0);
        Self { digits: digits.skip_while(|&digit| digit == 0).collect(), places }
    }

    /// All digits of m · 2^e, of which −e stand behind the point.
    fn of(x: f64) -> Self {
        let exponent = (x.to_bits() >> 52 & 0x7ff) as usize;
        Self::read(&format!("{x:.*}", 1075_usize.saturating_sub(exponent.max(1))))
    }

    /// The same number with more places and so many digits.
    fn aligned(mut self, places: i64, length: usize) -> Vec<u8> {
        self.digits.extend((self.places..places).map(|_| 0));
        let zeros = vec![0; length.saturating_sub(self.digits.len())];
        [zeros, self.digits].concat()
    }

    /// The difference of two numbers, as text.
    fn minus(self, other: Self) -> String {
        let places = self.places.max(other.places).max(0);
        let length = |x: &Self| x.digits.len() + (places - x.places) as usize;
        let length = length(&self).max(length(&other));
        let (a, b) = (self.aligned(places, length), other.aligned(places, length));
        let (sign, larger, smaller) = if a < b { ("-", b, a) } else { ("", a, b) };
        let mut digits = vec![0; length];
        let mut borrow = 0;
        for k in (0..length).rev() {
            let below = smaller[k] + borrow;
            borrow = u8::from(larger[k] < below);
            digits[k] = b'0' + larger[k] + 10 * borrow - below;
        }
        format!("{sign}{}e-{places}", digits.into_iter().map(char::from).collect::<String>())
    }
}

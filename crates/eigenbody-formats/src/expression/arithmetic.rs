//! Sums, products and numbers, in double-double: a decimal stands for itself, not for the nearest f64.

use super::{ExpressionError, Reader};
use eigenbody::scalar::{Dd, Real};

/// How deep parentheses may nest.
const MAX_DEPTH: usize = 64;

impl Reader<'_> {
    /// A sum, rounded.
    pub fn number(&mut self) -> Result<f64, ExpressionError> {
        self.sum().map(Dd::hi)
    }

    /// A sum.
    pub fn sum(&mut self) -> Result<Dd, ExpressionError> {
        let mut value = self.product()?;
        loop {
            let operator = self.offset();
            let sum = match () {
                () if self.eat('+') => value + self.product()?,
                () if self.eat('-') => value - self.product()?,
                () => return Ok(value),
            };
            value = self.finite(sum, operator)?;
        }
    }

    fn product(&mut self) -> Result<Dd, ExpressionError> {
        let mut value = self.factor()?;
        loop {
            let operator = self.offset();
            let product = match () {
                () if self.eat('*') => value * self.factor()?,
                () if self.eat('/') => value / self.factor()?,
                () => return Ok(value),
            };
            value = self.finite(product, operator)?;
        }
    }

    fn factor(&mut self) -> Result<Dd, ExpressionError> {
        let mut negative = false;
        while self.rest().starts_with(['+', '-']) {
            negative ^= self.rest().starts_with('-');
            self.at += 1;
        }
        let value = if self.eat('(') {
            self.depth += 1;
            if self.depth > MAX_DEPTH {
                return Err(self.error(self.at - 1, format!("more than {MAX_DEPTH} nested parentheses")));
            }
            let value = self.sum()?;
            self.expect(')')?;
            self.depth -= 1;
            value
        } else if let word @ ("pi" | "π") = self.word() {
            self.at += word.len();
            Dd::PI
        } else {
            self.literal()?
        };
        Ok(if negative { -value } else { value })
    }

    fn literal(&mut self) -> Result<Dd, ExpressionError> {
        let rest = self.rest();
        let digits = |from: usize| rest[from..].bytes().take_while(u8::is_ascii_digit).count();
        let whole = digits(0);
        let mut end = whole;
        if rest[end..].starts_with('.') {
            let fraction = digits(end + 1);
            end += if whole + fraction > 0 { 1 + fraction } else { 0 };
        }
        if end == 0 {
            let found = match self.found().as_str() {
                "the end" => "the text ends here".to_owned(),
                found => format!("{found} is not a number"),
            };
            return Err(self.error(self.at, format!("{found}; expected a number such as 0.3 or pi/2")));
        }
        if rest[end..].starts_with(['e', 'E']) {
            let sign = usize::from(rest[end + 1..].starts_with(['+', '-']));
            let exponent = digits(end + 1 + sign);
            end += if exponent > 0 { 1 + sign + exponent } else { 0 };
        }
        let start = self.at;
        self.at += end;
        // Only an overflow is left to go wrong.
        self.finite(rest[..end].parse().unwrap_or(Dd::from(f64::INFINITY)), start)
    }

    fn finite(&self, value: Dd, offset: usize) -> Result<Dd, ExpressionError> {
        match value.is_finite() {
            true => Ok(value),
            false => Err(self.error(offset, "the value is not a finite number")),
        }
    }
}

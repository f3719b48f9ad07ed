//! What is remembered of one end of the spectrum, and what a count says of it.

/// How close to its end of the spectrum a value is certified to be, where eigenvalues lie together.
pub(super) const CERTIFIED: f64 = 1e-13;
/// How far, at least and at most, a shift stands inside of the value that it is meant for.
pub(super) const MARGIN: (f64, f64) = (1e-9, 1e-3);

/// What is remembered of one end.
#[derive(Debug, Clone)]
pub(super) struct End {
    /// Its place in the spectrum.
    pub index: usize,
    /// The last values, the latest first; as many as `known` count.
    pub values: [f64; 4],
    pub known: usize,
    /// By how much, relative to the value, the last prediction missed it.
    pub missed: f64,
}

/// The factor that moves a shift from its end of the spectrum into it.
pub(super) fn inwards(which: usize, margin: f64) -> f64 {
    if which == 0 { 1.0 + margin } else { 1.0 - margin }
}

/// The factor that moves it out.
pub(super) fn outwards(which: usize, margin: f64) -> f64 {
    inwards(which, -margin)
}

impl End {
    /// Whether a count says for certain that an eigenvalue near `value` is the end: it is alone on the outer side of the shift, or the shift is
    /// so close that nothing matters in between.
    pub fn is_certain(&self, which: usize, value: f64, shift: f64, below: usize) -> bool {
        let is_outside = if which == 0 { value < shift } else { value >= shift };
        let alone = if which == 0 { self.index + 1 } else { self.index };
        let empty = if which == 0 { self.index } else { self.index + 1 };
        let is_close = (value - shift).abs() <= CERTIFIED * value.abs();
        if is_outside { below == alone } else { below == empty && is_close }
    }

    /// A shift that lies inside of the next value by twice what the last prediction missed.
    pub fn shift(&self, which: usize) -> f64 {
        let margin = (2.0 * self.missed).clamp(MARGIN.0, MARGIN.1);
        self.predict() * inwards(which, margin)
    }

    fn predict(&self) -> f64 {
        let [a, b, c, d] = self.values;
        match self.known {
            0 | 1 => a,
            2 => 2.0 * a - b,
            3 => 3.0 * (a - b) + c,
            _ => 4.0 * (a + c) - 6.0 * b - d,
        }
    }

    pub fn settle(&mut self, value: f64) {
        let predicted = self.predict();
        self.missed = if self.known > 0 && value > 0.0 { (predicted / value - 1.0).abs() } else { MARGIN.1 };
        self.values = [value, self.values[0], self.values[1], self.values[2]];
        self.known = (self.known + 1).min(4);
    }
}

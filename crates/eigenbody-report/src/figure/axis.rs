//! Axes: where numbers stand, and which of them are written.

/// How numbers are spread along an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scale {
    /// Evenly.
    Linear,
    /// By their logarithms; only positive numbers are seen.
    Log,
}

/// One axis.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// What it shows, with its unit.
    pub label: String,
    /// How.
    pub scale: Scale,
}

impl Axis {
    /// A linear one.
    pub fn linear(label: impl Into<String>) -> Self {
        Self { label: label.into(), scale: Scale::Linear }
    }

    /// A logarithmic one.
    pub fn log(label: impl Into<String>) -> Self {
        Self { label: label.into(), scale: Scale::Log }
    }
}

/// An axis with its range: numbers to places from 0 to 1.
#[derive(Debug, Clone, Copy)]
pub(super) struct Range {
    scale: Scale,
    low: f64,
    high: f64,
}

impl Range {
    /// Room for all numbers, and a little more.
    pub fn around(scale: Scale, values: impl Iterator<Item = f64>) -> Self {
        let seen = values.filter_map(|value| place(scale, value));
        let (low, high) = seen.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)));
        let (low, high) = if low <= high { (low, high) } else { (0.0, 1.0) };
        let margin = if high > low { 0.03 * (high - low) } else { 0.5 };
        Self { scale, low: low - margin, high: high + margin }
    }

    /// From 0 to 1; none for what the axis cannot show.
    pub fn place(&self, value: f64) -> Option<f64> {
        place(self.scale, value).map(|x| (x - self.low) / (self.high - self.low))
    }

    /// Ticks with their words, at most about `room` of them, and ticks without.
    pub fn ticks(&self, room: usize) -> (Vec<(f64, String)>, Vec<f64>) {
        match self.scale {
            Scale::Linear => (self.linear_ticks(room), Vec::new()),
            Scale::Log => self.log_ticks(room),
        }
    }

    fn inside(&self, x: f64) -> Option<f64> {
        let at = (x - self.low) / (self.high - self.low);
        (-1e-9..=1.0 + 1e-9).contains(&at).then_some(at)
    }

    fn linear_ticks(&self, room: usize) -> Vec<(f64, String)> {
        let rough = (self.high - self.low) / room.max(2) as f64;
        let decade = 10f64.powf(rough.log10().floor());
        let step =
            [1.0, 2.0, 5.0, 10.0].map(|f| f * decade).into_iter().find(|&s| s >= rough).unwrap_or(decade);
        let decimals = (-step.log10().floor()).max(0.0) as usize;
        let first = (self.low / step).ceil() as i64;
        let last = (self.high / step).floor() as i64;
        let word = |value: f64| {
            let text = format!("{value:.decimals$}");
            if text.trim_start_matches('-').chars().all(|c| "0.".contains(c)) {
                "0".into()
            } else {
                text.replace('-', "−")
            }
        };
        (first..=last).filter_map(|k| Some((self.inside(k as f64 * step)?, word(k as f64 * step)))).collect()
    }

    fn log_ticks(&self, room: usize) -> (Vec<(f64, String)>, Vec<f64>) {
        let span = self.high - self.low;
        let (first, last) = (self.low.floor() as i32, self.high.ceil() as i32);
        let every = ((span / room.max(2) as f64).ceil() as i32).max(1);
        // Steps of 1, 2, 3, 5, 10, .. decades.
        let every = [1, 2, 3, 5, 10, 20, 50, 100].into_iter().find(|&step| step >= every).unwrap_or(100);
        // The finest division that leaves room between words.
        let count = |digits: &[f64]| {
            let all =
                (first..=last).flat_map(|decade| digits.iter().map(move |d| f64::from(decade) + d.log10()));
            all.filter(|&x| self.inside(x).is_some()).count()
        };
        let divisions: [&[f64]; 4] = [
            &[1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0],
            &[1.0, 2.0, 3.0, 5.0, 7.0],
            &[1.0, 2.0, 5.0],
            &[1.0],
        ];
        let fits = |digits: &&[f64]| (every == 1 && count(digits) <= room + 1) || digits.len() == 1;
        let digits = divisions.into_iter().find(fits).unwrap_or(&[1.0]);
        let plain = self.low > -3.5 && self.high < 4.5 && span < 4.0;
        let mut words = Vec::new();
        let mut marks = Vec::new();
        for decade in first..=last {
            for &digit in digits.iter().filter(|_| decade.rem_euclid(every) == 0) {
                if let Some(at) = self.inside(f64::from(decade) + digit.log10()) {
                    words.push((
                        at,
                        if plain || (digits.len() > 1 && (0..4).contains(&decade)) {
                            written(digit, decade)
                        } else {
                            power(digit, decade)
                        },
                    ));
                }
            }
            let finer = (2..=9)
                .filter(|_| every == 1)
                .filter_map(|d| self.inside(f64::from(decade) + f64::from(d).log10()));
            marks.extend(finer);
            marks.extend(self.inside(f64::from(decade)));
        }
        (words, marks)
    }
}

fn place(scale: Scale, value: f64) -> Option<f64> {
    let x = if scale == Scale::Log { value.log10() } else { value };
    x.is_finite().then_some(x)
}

fn written(digit: f64, decade: i32) -> String {
    let value = digit * 10f64.powi(decade);
    let decimals = usize::try_from(-decade).unwrap_or(0) + usize::from(digit.fract() > 0.0 && decade <= 0);
    format!("{value:.decimals$}")
}

/// 10⁶, 2·10⁶.
fn power(digit: f64, decade: i32) -> String {
    const RAISED: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let mut exponent = String::new();
    for c in decade.to_string().chars() {
        exponent.push(c.to_digit(10).map_or('⁻', |d| RAISED[d as usize]));
    }
    match (digit, decade) {
        (1.0, 0) => "1".into(),
        (1.0, 1) => "10".into(),
        (1.0, _) => format!("10{exponent}"),
        _ => format!("{digit}·10{exponent}"),
    }
}

#[cfg(test)]
mod tests {
    use super::{Range, Scale};

    fn words(scale: Scale, low: f64, high: f64, room: usize) -> Vec<String> {
        Range::around(scale, [low, high].into_iter()).ticks(room).0.into_iter().map(|tick| tick.1).collect()
    }

    #[test]
    fn ticks_are_round_numbers() {
        assert_eq!(words(Scale::Linear, 0.0, 1.0, 6), ["0", "0.2", "0.4", "0.6", "0.8", "1.0"]);
        assert_eq!(words(Scale::Linear, -0.4, 0.4, 5), ["−0.4", "−0.2", "0", "0.2", "0.4"]);
        assert_eq!(words(Scale::Log, 1.0, 1e12, 7), ["1", "10²", "10⁴", "10⁶", "10⁸", "10¹⁰", "10¹²"]);
        assert_eq!(words(Scale::Log, 1.0, 560.0, 8), ["1", "2", "5", "10", "20", "50", "100", "200", "500"]);
    }

    #[test]
    fn what_a_log_axis_cannot_show_has_no_place() {
        let range = Range::around(Scale::Log, [0.0, -1.0, 10.0, 100.0].into_iter());
        assert!(range.place(0.0).is_none() && range.place(-1.0).is_none());
        assert!(range.place(10.0).is_some_and(|at| (0.0..0.1).contains(&at)));
    }
}

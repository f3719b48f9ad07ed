//! Straight lines through points, with the uncertainty of their slopes.

/// A line y = intercept + slope·x by least squares.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Line {
    /// Slope.
    pub slope: f64,
    /// Half the width of the slope's 95 % confidence interval, from the scatter about the line; infinite for two points.
    pub half_width: f64,
    /// y at x = 0.
    pub intercept: f64,
}

impl Line {
    /// x where two lines meet.
    pub fn meets(&self, other: &Self) -> f64 {
        (other.intercept - self.intercept) / (self.slope - other.slope)
    }
}

/// 97.5 % quantile of Student's distribution for 1 to 10 degrees of freedom; beyond, 1.96 + 2.5/ν is within 0.01.
const QUANTILE: [f64; 10] = [12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228];

/// Least squares through points. Fewer than two different x give a slope that is not a number.
///
/// ```
/// let line = eigenbody_study::fit::line(&[(0.0, 1.0), (1.0, 3.0), (2.0, 5.0)]);
/// assert_eq!((line.slope, line.intercept, line.half_width), (2.0, 1.0, 0.0));
/// ```
pub fn line(points: &[(f64, f64)]) -> Line {
    let n = points.len() as f64;
    let mean = |of: fn(&(f64, f64)) -> f64| points.iter().map(of).sum::<f64>() / n;
    let (x0, y0) = (mean(|p| p.0), mean(|p| p.1));
    let sxx: f64 = points.iter().map(|(x, _)| (x - x0).powi(2)).sum();
    let slope = points.iter().map(|(x, y)| (x - x0) * (y - y0)).sum::<f64>() / sxx;
    let intercept = y0 - slope * x0;
    let rest: f64 = points.iter().map(|(x, y)| (y - intercept - slope * x).powi(2)).sum();
    let half_width = match points.len().saturating_sub(2) {
        0 => f64::INFINITY,
        free => {
            let t = QUANTILE.get(free - 1).copied().unwrap_or(1.96 + 2.5 / free as f64);
            t * (rest / free as f64 / sxx).sqrt()
        }
    };
    Line { slope, half_width, intercept }
}

/// [`line()`] through (log10 x, log10 y) of the points with x in `from..=to`: the exponent of a power law.
pub fn power(points: &[(f64, f64)], from: f64, to: f64) -> Line {
    let chosen: Vec<(f64, f64)> =
        points.iter().filter(|(x, _)| (from..=to).contains(x)).map(|(x, y)| (x.log10(), y.log10())).collect();
    line(&chosen)
}

//! Numbers for people.

/// A number with so many significant digits: plain between 1e-4 and 1e7, scientific outside.
///
/// ```
/// use eigenbody_report::significant;
/// assert_eq!(significant(42907.97274937, 6), "42908.0");
/// assert_eq!(significant(0.021146, 3), "0.0211");
/// assert_eq!(significant(8.1053e10, 3), "8.11e10");
/// ```
pub fn significant(x: f64, digits: usize) -> String {
    let magnitude = x.abs();
    if x == 0.0 {
        return "0".into();
    }
    if !x.is_finite() {
        return format!("{x}");
    }
    if !(1e-4..1e7).contains(&magnitude) {
        return format!("{x:.*e}", digits.saturating_sub(1));
    }
    let before = magnitude.log10().floor() as i64 + 1;
    let decimals = usize::try_from(digits as i64 - before).unwrap_or(0);
    format!("{x:.decimals$}")
}

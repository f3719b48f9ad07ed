use eigenbody_study::fit::{line, power};

/// y = 1 + 2x with errors +1, −1, −1, +1 at x = 0, 1, 2, 3: slope 2, scatter √(4/2), Σ(x − x̄)² = 5, t₂ = 4.303.
#[test]
fn the_interval_is_students() {
    let found = line(&[(0.0, 2.0), (1.0, 2.0), (2.0, 4.0), (3.0, 8.0)]);
    assert!((found.slope - 2.0).abs() < 1e-14);
    assert!((found.half_width - 4.303 * (2.0f64 / 5.0).sqrt()).abs() < 1e-12);
}

#[test]
fn powers_within_a_range() {
    let points: Vec<(f64, f64)> =
        (1..=20).map(f64::from).map(|x| (x, if x < 10.0 { x } else { 3.0 * x.powi(4) })).collect();
    assert!((power(&points, 10.0, 20.0).slope - 4.0).abs() < 1e-12);
    assert!((power(&points, 1.0, 9.0).slope - 1.0).abs() < 1e-12);
    // 3 x⁴ = x at x = 3^(−1/3)
    let meeting = power(&points, 1.0, 9.0).meets(&power(&points, 10.0, 20.0));
    assert!((meeting + 3f64.log10() / 3.0).abs() < 1e-12);
}

#[test]
fn too_few_points_make_no_slope() {
    assert!(line(&[]).slope.is_nan() && line(&[(1.0, 1.0)]).slope.is_nan());
    assert_eq!(line(&[(0.0, 0.0), (1.0, 1.0)]).half_width, f64::INFINITY);
}

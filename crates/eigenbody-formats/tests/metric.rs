//! Metrics by name.

use eigenbody::Metric;
use eigenbody_formats::metric;
use insta::assert_snapshot;

#[test]
fn every_metric_has_a_name() {
    assert_eq!(metric("euclidean"), Ok(Metric::Euclidean));
    assert_eq!(metric(" unit-diagonal "), Ok(Metric::UnitDiagonal));
    assert_eq!(metric("length = 2/4"), Ok(Metric::Length(0.5)));
    assert_eq!(metric("diagonal=[1, 2.5]"), Ok(Metric::Diagonal(vec![1.0, 2.5])));
}

#[test]
fn what_is_no_metric_is_refused() {
    let error = |text| metric(text).unwrap_err().to_string();
    assert_snapshot!(error("manhattan"), @"manhattan, column 1: no metric; expected euclidean, unit-diagonal, length=L or diagonal=[..]");
    assert_snapshot!(error(""), @"empty text, column 1: no metric; expected euclidean, unit-diagonal, length=L or diagonal=[..]");
    assert_snapshot!(error("length"), @"length, column 1: no metric; expected euclidean, unit-diagonal, length=L or diagonal=[..]");
    assert_snapshot!(error("length=0"), @"length=0, column 8: length 0 m, expected a positive number");
    assert_snapshot!(error("length=long"), @"length=long, column 8: 'long' is not a number; expected a number such as 0.3 or pi/2");
    assert_snapshot!(error("diagonal=[1, -2]"), @"diagonal=[1, -2], column 14: weight -2, expected a positive number");
    assert_snapshot!(error("diagonal=3"), @"diagonal=3, column 10: expected '[', found '3'");
    assert_snapshot!(error("diagonal=[1] 2"), @"diagonal=[1] 2, column 14: expected the end, found '2'");
}

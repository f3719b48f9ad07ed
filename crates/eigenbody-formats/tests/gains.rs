//! Gains by joint.

use eigenbody::Model;
use eigenbody_formats::{LoadOptions, gains, load};
use insta::assert_snapshot;

fn arm() -> Model<f64> {
    load("puma560", &LoadOptions::default()).unwrap().model
}

#[test]
fn for_all_or_for_some() {
    let model = arm();
    assert_eq!(gains(" 2*5 ", &model).unwrap(), vec![Some(10.0); 6]);
    let [first, second] = [0, 1].map(|j| model.joints()[j].name().to_owned());
    let some = gains(&format!("{second} = 3, {first}=0"), &model).unwrap();
    assert_eq!(some, [Some(0.0), Some(3.0), None, None, None, None]);
}

#[test]
fn what_is_no_gain_is_refused() {
    let model = arm();
    let error = |text| gains(text, &model).unwrap_err().to_string();
    assert_snapshot!(error("-1"), @"-1, column 1: gain -1, expected none below zero");
    assert_snapshot!(error(""), @"empty text, column 1: the text ends here; expected a number such as 0.3 or pi/2");
    assert_snapshot!(error("wing=1"), @"wing=1, column 1: no moving joint is named 'wing'");
    assert_snapshot!(error("5 6"), @"5 6, column 3: expected the end, found '6'");
}

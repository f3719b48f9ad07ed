use eigenbody_report::{Shown, claims_json, claims_text, gallery};
use eigenbody_study::{Check, Lab, Outcome, Reading, Verdict, select};

fn outcome(id: &str) -> Outcome {
    select(&[id]).unwrap()[0].run(&Lab { quick: true, ..Lab::default() }).unwrap()
}

#[test]
fn claims_are_json_without_nan() {
    let readings = [
        Reading::new("F-eq1-kappa", vec![f64::NAN], Vec::new()),
        Reading::shape("F-fig6", vec![Check::within("slope", 3.0, 3.9, f64::INFINITY)]),
    ];
    let json: serde_json::Value = serde_json::from_str(&claims_json(readings.iter()).unwrap()).unwrap();
    assert_eq!(json[0]["computed"][0], serde_json::Value::Null);
    assert_eq!(json[0]["verdict"], "fails");
    assert_eq!(json[1]["checks"][0]["high"], serde_json::Value::Null);
    assert_eq!(json[1]["checks"][0]["holds"], false);
}

#[test]
fn numbers_parse_back_to_the_same_bits() {
    let readings = outcome("F-eq1").readings;
    let json: serde_json::Value = serde_json::from_str(&claims_json(readings.iter()).unwrap()).unwrap();
    for (k, reading) in readings.iter().enumerate() {
        for (i, x) in reading.computed.iter().enumerate() {
            assert_eq!(json[k]["computed"][i].as_f64(), Some(*x));
        }
    }
}

/// A failed claim is named with the test that failed, and its bounds.
#[test]
fn failures_are_told() {
    let reading = Reading::shape("F-fig6", vec![Check::within("slope at θ = 0", 3.0, 3.9, 4.1)]);
    assert_eq!(reading.verdict, Verdict::Fails);
    let page = claims_text(&[&reading]);
    assert!(
        page.contains("0 of 1 tests hold") && page.contains("slope at θ = 0: 3.00000, expected 3.9 to 4.1"),
        "{page}"
    );
}

#[test]
fn the_gallery_needs_nothing_from_elsewhere() {
    let (growth, example) = (outcome("F-fig2"), outcome("S-eq7"));
    let shown = [
        Shown { experiment: select(&["F-fig2"]).unwrap()[0], outcome: &growth, has_figure: true },
        Shown { experiment: select(&["S-eq7"]).unwrap()[0], outcome: &example, has_figure: false },
    ];
    let page = gallery(&shown);
    for part in [
        "<img src=\"F-fig2.svg\"",
        "F-fig2.csv",
        "F-fig2.png",
        "S-eq7.csv",
        "claims.json",
        "paper rounds",
        "shape holds",
    ] {
        assert!(page.contains(part), "{part}");
    }
    assert!(!page.contains("S-eq7.svg"));
    for address in ["http:", "https:", "//", "<script"] {
        assert!(!page.contains(address), "{address}");
    }
}

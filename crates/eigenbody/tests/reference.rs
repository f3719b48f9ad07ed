//! Rows of reference tables: families and postures, computed in ball arithmetic and correct to at least 15 of the 20 digits given.
//!
//! `data/families.json`: 143 rows. `data/further.json`: more extreme ones, printed by `oracle/families.py`.

use eigenbody::scalar::Dd;
use eigenbody::{Family, Posture};
use serde::Deserialize;
use std::f64::consts::PI;

#[derive(Debug, Clone, Deserialize)]
pub struct Row {
    kind: String,
    pub n: usize,
    branching: String,
    skew: String,
    taper: Option<String>,
    size_ratio: Option<String>,
    posture: String,
    theta: String,
    pub floating: bool,
    pub lambda_min: String,
    pub lambda_max: String,
    pub kappa: String,
    pub kappa_weighted: Option<String>,
    pub diagonal_ratio: Option<String>,
}

pub fn families() -> Vec<Row> {
    serde_json::from_str(include_str!("data/families.json")).unwrap()
}

pub fn further() -> Vec<Row> {
    serde_json::from_str(include_str!("data/further.json")).unwrap()
}

pub fn number(text: &str) -> f64 {
    match text.strip_prefix("pi*") {
        Some(factor) => PI * factor.parse::<f64>().unwrap(),
        None => text.parse().unwrap(),
    }
}

/// |found / expected − 1| against a decimal of more digits than f64 has.
pub fn relative_error(found: f64, expected: &str) -> f64 {
    let expected: Dd = expected.parse().unwrap();
    ((Dd::from(found) - expected) / expected).hi().abs()
}

impl Row {
    /// Tapers and size ratios are decimals to the last digit.
    pub fn family(&self) -> Family {
        let decimal = |text: &str| text.parse::<Dd>().unwrap();
        let [branching, skew] = [&self.branching, &self.skew].map(|text| number(text));
        let taper = decimal(self.taper.as_deref().unwrap_or("1"));
        let family = match self.kind.as_str() {
            "hydra" => Family::hydra(self.n, branching, skew, taper).unwrap(),
            "onion" => Family::onion(self.n, branching, skew, taper).unwrap(),
            other => panic!("family {other}"),
        };
        let family = match &self.size_ratio {
            Some(ratio) => family.with_size_ratio(decimal(ratio)).unwrap(),
            None => family,
        };
        if self.floating { family.floating() } else { family }
    }

    pub fn posture(&self) -> Posture {
        match self.posture.as_str() {
            "zag" => Posture::Zag(number(&self.theta)),
            "curl" => Posture::Curl(number(&self.theta)),
            other => panic!("posture {other}"),
        }
    }
}

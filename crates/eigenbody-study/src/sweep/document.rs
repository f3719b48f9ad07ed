//! A sweep's file as it is written: TOML, every fault at its place.

use eigenbody_formats::metric;
use serde::Deserialize;
use serde::de::IntoDeserializer;
use std::ops::Range;
use toml::Spanned;

use super::quantity::Quantity;
use super::spec::{Axis, Group, Places, Robots, Spec, SpecError};

/// Most values of one axis, and most cases of a sweep.
const VALUES: u64 = 1_000_000;
const CASES: u64 = 1 << 40;

/// A fault at a byte of the text.
type Fault = (usize, String);

/// What a text says.
pub(super) fn read(text: &str) -> Result<Spec, SpecError> {
    let document: Document = toml::from_str(text).map_err(|error| {
        let offset = error.span().map_or(0, |span| span.start);
        located(text, (offset, error.message().trim().replace('\n', "; ")))
    })?;
    document.spec(text).map_err(|fault| located(text, fault))
}

fn located(text: &str, (offset, what): Fault) -> SpecError {
    let (line, column) = place(text, offset);
    SpecError { line, column, what }
}

/// Where a word of a list stands, the list itself if it is not written as it is meant.
fn within(text: &str, list: Range<usize>, word: &str) -> usize {
    let found = text.get(list.clone()).and_then(|list| list.find(word));
    list.start + found.unwrap_or(0)
}

fn place(text: &str, offset: usize) -> (usize, usize) {
    let before = text.get(..offset).unwrap_or(text);
    let line = before.matches('\n').count() + 1;
    let column = before.rsplit('\n').next().unwrap_or_default().chars().count() + 1;
    (line, column)
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Document {
    #[serde(default = "one")]
    seed: u64,
    metric: Option<Spanned<String>>,
    quantities: Option<Vec<Spanned<String>>>,
    robots: Spanned<Vec<Spanned<RawGroup>>>,
}

fn one() -> u64 {
    1
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawGroup {
    model: Option<Spanned<OneOrMany<String>>>,
    family: Option<Spanned<String>>,
    n: Option<Spanned<RawAxis>>,
    branching: Option<Spanned<RawAxis>>,
    skew: Option<Spanned<RawAxis>>,
    taper: Option<Spanned<RawAxis>>,
    sample: Option<Spanned<u64>>,
    base: Option<Spanned<OneOrMany<String>>>,
    mimic: Option<bool>,
    #[serde(default)]
    reduced: bool,
    at: Option<Spanned<OneOrMany<String>>>,
    #[serde(default)]
    random: u64,
}

#[derive(Deserialize)]
#[serde(untagged)]
enum OneOrMany<T> {
    One(T),
    Many(Vec<T>),
}

impl<T> OneOrMany<T> {
    fn into_vec(self) -> Vec<T> {
        match self {
            Self::One(one) => vec![one],
            Self::Many(many) => many,
        }
    }
}

/// A number, a list, or `{ from, to, count, scale }`.
#[derive(Deserialize)]
#[serde(
    untagged,
    expecting = "a number, a list of numbers, or { from = .., to = .., count = .., scale = \"log\" }"
)]
enum RawAxis {
    One(f64),
    Many(Vec<f64>),
    Range(RawRange),
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawRange {
    from: f64,
    to: f64,
    count: Option<u64>,
    scale: Option<Scale>,
}

#[derive(Deserialize, PartialEq)]
#[serde(rename_all = "lowercase")]
enum Scale {
    Linear,
    Log,
}

impl Document {
    fn spec(self, text: &str) -> Result<Spec, Fault> {
        let metric_text = match &self.metric {
            None => "euclidean".to_owned(),
            Some(text) => {
                metric(text.get_ref()).map_err(|error| (text.span().start, error.to_string()))?;
                text.get_ref().clone()
            }
        };
        let quantities = match self.quantities {
            None => Quantity::USUAL.to_vec(),
            Some(names) => names.iter().map(quantity).collect::<Result<_, _>>()?,
        };
        let start = self.robots.span().start;
        let groups: Vec<Group> = self
            .robots
            .into_inner()
            .into_iter()
            .map(|group| {
                let start = group.span().start;
                group.into_inner().group(start, text)
            })
            .collect::<Result<_, _>>()?;
        let spec = Spec { seed: self.seed, metric: metric_text, quantities, groups };
        match spec.cases() {
            Some(1..=CASES) => Ok(spec),
            Some(0) => Err((start, "no cases".into())),
            _ => Err((start, format!("more than {CASES} cases"))),
        }
    }
}

fn quantity(name: &Spanned<String>) -> Result<Quantity, Fault> {
    let deserializer: serde::de::value::StrDeserializer<'_, serde::de::value::Error> =
        name.get_ref().as_str().into_deserializer();
    Quantity::deserialize(deserializer).map_err(|error| (name.span().start, error.to_string()))
}

impl RawGroup {
    fn group(self, start: usize, text: &str) -> Result<Group, Fault> {
        let mut floating = Vec::new();
        for base in self.base.map(|base| (base.span().start, base.into_inner().into_vec())).into_iter() {
            for name in base.1 {
                floating.push(match name.as_str() {
                    "fixed" => false,
                    "floating" => true,
                    other => return Err((base.0, format!("base '{other}', expected fixed or floating"))),
                });
            }
        }
        if floating.is_empty() {
            floating.push(false);
        }
        if self.reduced && floating.contains(&false) {
            return Err((start, "reduced removes a floating base: add base = \"floating\"".into()));
        }
        let span = self.at.as_ref().map_or(start..start, Spanned::span);
        let mut at = self.at.map(|at| at.into_inner().into_vec()).unwrap_or_default();
        let places = Places(at.iter().map(|at| place(text, within(text, span.clone(), at))).collect());
        if at.is_empty() && self.random == 0 {
            at.push("zero".to_owned());
        }
        let axes = [
            ("n", self.n, None),
            ("branching", self.branching, Some(1.0)),
            ("skew", self.skew, Some(0.0)),
            ("taper", self.taper, Some(1.0)),
        ];
        let robots = match (self.model, self.family) {
            (Some(models), None) => {
                if let Some((name, Some(axis), _)) = axes.iter().find(|(_, axis, _)| axis.is_some()) {
                    return Err((axis.span().start, format!("{name} is for a family")));
                }
                Robots::Models(models.into_inner().into_vec())
            }
            (None, Some(family)) => {
                let name = family.get_ref().clone();
                if !["hydra", "onion", "auto_tree"].contains(&name.as_str()) {
                    return Err((
                        family.span().start,
                        format!("family '{name}', expected hydra, onion or auto_tree"),
                    ));
                }
                let sample = self.sample.map(Spanned::into_inner);
                let mut read = Vec::new();
                for (name, axis, default) in axes {
                    read.push(match (axis, default) {
                        (Some(axis), _) => {
                            let start = axis.span().start;
                            axis.into_inner().axis(name, sample.is_some()).map_err(|what| (start, what))?
                        }
                        (None, Some(default)) => Axis::Values(vec![default]),
                        (None, None) => return Err((start, "a family needs n".into())),
                    });
                }
                let axes = <[Axis; 4]>::try_from(read).map_err(|_| (start, "four axes".to_owned()))?;
                Robots::Family { name, axes, sample }
            }
            _ => return Err((start, "robots have either a model or a family".into())),
        };
        Ok(Group {
            robots,
            floating,
            mimic: self.mimic,
            reduced: self.reduced,
            at,
            places,
            random: self.random,
        })
    }
}

impl RawAxis {
    fn axis(self, name: &str, is_sample: bool) -> Result<Axis, String> {
        let axis = match self {
            Self::One(one) => Axis::Values(vec![one]),
            Self::Many(many) => Axis::Values(many),
            Self::Range(RawRange { from, to, count, scale }) => {
                let log = scale == Some(Scale::Log);
                if log && !(from > 0.0 && to > 0.0) {
                    return Err(format!("{name}: a log scale needs ends above zero"));
                }
                if count.is_none() && !is_sample {
                    return Err(format!("{name}: a grid needs a count; or say sample = .."));
                }
                Axis::Range { from, to, count, log }
            }
        };
        let ends = match &axis {
            Axis::Values(values) => values.clone(),
            Axis::Range { from, to, .. } => vec![*from, *to],
        };
        if ends.is_empty() || !ends.iter().all(|x| x.is_finite()) || axis.len() > VALUES {
            return Err(format!("{name}: expected 1 to {VALUES} finite numbers"));
        }
        Ok(axis)
    }
}

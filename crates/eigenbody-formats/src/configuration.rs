//! CONFIG: a configuration of a robot.

use crate::error::{FormatError, numbers_of, shortened};
use crate::expression::{ExpressionError, Reader, Value};
use crate::suggest::did_you_mean;
use eigenbody::model::{Coupling, JointInfo};
use eigenbody::{InputError, Model, Posture};
use std::collections::HashMap;

const EXPECTED: &str =
    "no configuration; expected zero, zag(angle), curl(angle), random(seed), q=[..] or joint=value, ..";

/// All coordinates of the configuration that a text names.
///
/// | text | configuration |
/// |------|---------------|
/// | `zero` | all coordinates zero, quaternions the identity |
/// | `zag(θ)`, `curl(θ)` | a [`Posture`] |
/// | `random(seed)` | [`Model::random`] |
/// | `q=[..]` | as given |
/// | `elbow=pi/2, base=[0, 0, 1, 1, 0, 0, 0]` | the joints named; the others neutral |
///
/// With `coupling`, mimic joints follow: `q=[..]` holds the independent coordinates only, the others configurations fix these,
/// and a mimic joint cannot be named. Errors: [`FormatError::Expression`].
pub fn configuration(text: &str, model: &Model<f64>, coupling: bool) -> Result<Vec<f64>, FormatError> {
    Ok(Configuration::new(text, model, coupling).read()?)
}

/// A configuration being read: the independent coordinates, and where each is written.
struct Configuration<'a> {
    text: &'a str,
    model: &'a Model<f64>,
    coupling: Option<&'a Coupling<f64>>,
    p: Vec<f64>,
    offsets: Vec<Option<usize>>,
}

impl<'a> Configuration<'a> {
    fn new(text: &'a str, model: &'a Model<f64>, coupling: bool) -> Self {
        let coupling = model.coupling().filter(|_| coupling);
        let mut neutral = Self { text, model, coupling, p: Vec::new(), offsets: Vec::new() };
        neutral.take(&model.neutral());
        neutral.offsets = vec![None; neutral.p.len()];
        neutral
    }

    /// Keeps the independent ones of all coordinates.
    fn take(&mut self, q: &[f64]) {
        self.p = match self.coupling {
            Some(coupling) => coupling.independent_coordinates().iter().map(|&k| q[k]).collect(),
            None => q.to_vec(),
        };
    }

    fn read(mut self) -> Result<Vec<f64>, ExpressionError> {
        let mut reader = Reader::new(self.text);
        let word = reader.word();
        let after = reader.rest()[word.len()..].trim_start();
        let next = after.chars().next();
        match (word, next) {
            ("zero", None) => reader.skip(word.len()),
            ("zag" | "curl" | "random", Some('(')) => {
                reader.skip(word.len());
                reader.expect('(')?;
                let q = match word {
                    "zag" => Posture::Zag(reader.number()?).configuration(self.model),
                    "curl" => Posture::Curl(reader.number()?).configuration(self.model),
                    _ => self.model.random(reader.whole()?),
                };
                reader.expect(')')?;
                self.take(&q);
            }
            ("q", Some('=')) if after[1..].trim_start().starts_with('[') => {
                reader.skip(word.len());
                reader.expect('=')?;
                self.coordinates(&mut reader)?;
            }
            _ => self.joints(&mut reader)?,
        }
        reader.end()?;
        self.finish()
    }

    /// `[..]` after `q=`.
    fn coordinates(&mut self, reader: &mut Reader<'_>) -> Result<(), ExpressionError> {
        let start = reader.offset();
        let numbers = reader.list()?;
        if numbers.len() != self.p.len() {
            let which = if self.coupling.is_some() { " independent coordinates" } else { "" };
            let (found, expected) = (numbers.len(), self.p.len());
            return Err(
                reader.error(start, format!("q has {}, expected {expected}{which}", numbers_of(found)))
            );
        }
        self.p = numbers.iter().map(|number| number.value).collect();
        self.offsets = numbers.iter().map(|number| Some(number.offset)).collect();
        Ok(())
    }

    /// `joint=value, joint=value, ..`.
    fn joints(&mut self, reader: &mut Reader<'_>) -> Result<(), ExpressionError> {
        let joints: HashMap<&str, &JointInfo<f64>> =
            self.model.joints().iter().map(|joint| (joint.name(), joint)).collect();
        let longest = joints.keys().map(|name| name.len()).max().unwrap_or(0);
        loop {
            let (start, rest) = (reader.offset(), reader.rest());
            // A name may hold any character, even an equals sign: it ends at the first one that makes it a joint's.
            let ends = rest.match_indices('=').map(|(end, _)| end);
            let mut names =
                ends.map(|end| (end, rest[..end].trim_end())).take_while(|(_, n)| n.len() <= longest);
            let Some((end, joint)) = names.find_map(|(end, name)| Some((end, *joints.get(name)?))) else {
                return Err(reader.error(start, self.unknown(rest, start, joints.keys().copied())));
            };
            reader.skip(end);
            reader.expect('=')?;
            self.joint(reader, start, joint)?;
            match reader.rest() {
                "" => return Ok(()),
                _ if reader.eat(',') => {}
                _ => return Err(reader.unexpected("',' or the end")),
            }
        }
    }

    /// Why no joint's name stands at `start`.
    fn unknown<'n>(&self, rest: &str, start: usize, names: impl Iterator<Item = &'n str>) -> String {
        match rest.split_once('=').map(|(name, _)| name.trim()) {
            None if start == 0 => EXPECTED.to_owned(),
            None => "expected joint=value".to_owned(),
            Some("q") => format!("q takes a list of {}: q=[..]", numbers_of(self.p.len())),
            Some(name) => {
                format!("no moving joint is named '{}'{}", shortened(name), did_you_mean(name, names))
            }
        }
    }

    /// The value of a joint whose name stands at `start`.
    fn joint(
        &mut self,
        reader: &mut Reader<'_>,
        start: usize,
        joint: &JointInfo<f64>,
    ) -> Result<(), ExpressionError> {
        let (name, count) = (joint.name(), joint.kind().nq());
        let Some(first) = self.independent(joint.coordinates().start) else {
            return Err(reader.error(
                start,
                format!("joint '{name}' is a mimic joint: it follows another and has no value of its own"),
            ));
        };
        if self.offsets[first].is_some() {
            return Err(reader.error(start, format!("a second value for joint '{name}'")));
        }
        let offset = reader.offset();
        let values = match reader.value()? {
            Value::Number(value) => vec![value.hi()],
            Value::List(list) => list.iter().map(|number| number.value).collect(),
        };
        if values.len() != count {
            let expected =
                if count == 1 { "one number".into() } else { format!("a list of {count} numbers") };
            let message = format!("joint '{name}' takes {expected}, found {}", values.len());
            return Err(reader.error(offset, message));
        }
        self.p[first..first + count].copy_from_slice(&values);
        self.offsets[first..first + count].fill(Some(offset));
        Ok(())
    }

    /// Position of a coordinate among the independent ones; none for a mimic joint's.
    fn independent(&self, k: usize) -> Option<usize> {
        match self.coupling {
            Some(coupling) => coupling.independent_coordinates().binary_search(&k).ok(),
            None => Some(k),
        }
    }

    fn finish(self) -> Result<Vec<f64>, ExpressionError> {
        let q = match self.coupling {
            Some(coupling) => coupling.expand(&self.p),
            None => self.p.clone(),
        };
        match self.model.check_q(&q) {
            Ok(()) => Ok(q),
            Err(error) => {
                let index = match error {
                    InputError::NotFinite { index, .. } | InputError::NotUnitQuaternion { index, .. } => {
                        index
                    }
                    _ => 0,
                };
                let offset = self.independent(index).and_then(|k| *self.offsets.get(k)?).unwrap_or(0);
                Err(ExpressionError::new(self.text, offset, error.to_string()))
            }
        }
    }
}

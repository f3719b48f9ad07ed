//! `eigenbody.toml`: what `check` is held against, kept with the robot.
//!
//! ```toml
//! [check]
//! max-kappa = 1e6
//! fail-on = "error"
//! ```
//! The keys are the options of `check`, and an option wins over its key.

use crate::args::{GainArgs, IntegratorArg};
use crate::fail_on::FailOn;
use crate::failure::Failure;
use eigenbody::Model;
use eigenbody_formats::{Kind, Loaded, gains};
use serde::Deserialize;
use std::path::{Path, PathBuf};
use toml::Spanned;

/// The file's name.
const NAME: &str = "eigenbody.toml";
/// Largest file that is read (bytes).
const LIMIT: u64 = 1 << 20;

/// The whole file.
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct Document {
    #[serde(default)]
    check: Keys,
}

/// `[check]`.
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct Keys {
    metric: Option<Spanned<String>>,
    samples: Option<Spanned<u32>>,
    seed: Option<u32>,
    max_kappa_weighted: Option<Spanned<f64>>,
    max_kappa: Option<Spanned<f64>>,
    f32_digits: Option<Spanned<f64>>,
    kp: Option<Spanned<Gain>>,
    kd: Option<Spanned<Gain>>,
    dt: Option<Spanned<f64>>,
    integrator: Option<IntegratorArg>,
    fail_on: Option<Spanned<String>>,
}

/// A number for all joints, or as `--kp` takes it.
#[derive(Debug, Deserialize)]
#[serde(untagged)]
enum Gain {
    All(f64),
    Named(String),
}

impl From<Gain> for String {
    fn from(gain: Gain) -> Self {
        match gain {
            Gain::All(gain) => gain.to_string(),
            Gain::Named(text) => text,
        }
    }
}

/// What the file says, and where it is.
#[derive(Debug, Default)]
pub struct Settings {
    /// The file.
    pub path: Option<PathBuf>,
    /// `metric`.
    pub metric: Option<String>,
    /// `samples`.
    pub samples: Option<u32>,
    /// `seed`.
    pub seed: Option<u32>,
    /// `max-kappa-weighted`.
    pub max_kappa_weighted: Option<f64>,
    /// `max-kappa`.
    pub max_kappa: Option<f64>,
    /// `f32-digits`.
    pub f32_digits: Option<f64>,
    /// `kp`, `kd`, `dt`, `integrator`.
    pub gains: GainArgs,
    /// `fail-on`.
    pub fail_on: Option<FailOn>,
}

impl Settings {
    /// What drives the robot: as the options say, else as the file does.
    pub fn drive(&self, args: &GainArgs) -> GainArgs {
        let kept = &self.gains;
        GainArgs {
            kp: args.kp.clone().or_else(|| kept.kp.clone()),
            kd: args.kd.clone().or_else(|| kept.kd.clone()),
            dt: args.dt.or(kept.dt),
            integrator: args.integrator.or(kept.integrator),
        }
    }

    /// The file that is named, or the nearest one above the model's; none is all defaults.
    pub fn find(named: Option<&Path>, model: &Loaded) -> Result<Self, Failure> {
        match named.map(Path::to_owned).or_else(|| nearest(model)) {
            Some(path) => Self::read(path, &model.model),
            None => Ok(Self::default()),
        }
    }

    fn read(path: PathBuf, model: &Model<f64>) -> Result<Self, Failure> {
        let failed = |source| Failure::File { path: path.clone(), source };
        let size = std::fs::metadata(&path).map_err(failed)?.len();
        if size > LIMIT {
            return Err(Failure::Folder { path, what: format!("larger than {LIMIT} bytes") });
        }
        let text = std::fs::read_to_string(&path).map_err(failed)?;
        Keys::parse(&text).and_then(|keys| keys.settings(path.clone(), model)).map_err(|(offset, what)| {
            let (line, column) = place(&text, offset);
            Failure::Usage(format!("{}:{line}:{column}: {what}", path.display()))
        })
    }
}

/// A fault at a byte of the text.
type Fault = (usize, String);

impl Keys {
    fn parse(text: &str) -> Result<Self, Fault> {
        toml::from_str::<Document>(text).map(|document| document.check).map_err(|error| {
            (error.span().map_or(0, |span| span.start), error.message().trim().replace('\n', "; "))
        })
    }

    fn settings(self, path: PathBuf, model: &Model<f64>) -> Result<Settings, Fault> {
        let positive = |key: &str, x: Option<Spanned<f64>>| match x {
            Some(x) if !(*x.get_ref() > 0.0 && x.get_ref().is_finite()) => {
                Err((x.span().start, format!("{key} = {}: expected a positive number", x.get_ref())))
            }
            x => Ok(x.map(Spanned::into_inner)),
        };
        let gain = |key: &str, gain: Option<Spanned<Gain>>| match gain {
            Some(gain) => {
                let start = gain.span().start;
                let text = String::from(gain.into_inner());
                let fault = |error| (start, format!("{key} = {error}"));
                gains(&text, model).map(|_| Some(text)).map_err(fault)
            }
            None => Ok(None),
        };
        let fail_on = match self.fail_on {
            Some(text) => Some(text.get_ref().parse().map_err(|what| (text.span().start, what))?),
            None => None,
        };
        if let Some(samples) = self.samples.as_ref().filter(|n| !(1..=65536).contains(n.get_ref())) {
            let what = format!("samples = {}: expected 1 to 65536", samples.get_ref());
            return Err((samples.span().start, what));
        }
        if let Some(metric) = &self.metric {
            eigenbody_formats::metric(metric.get_ref())
                .map_err(|error| (metric.span().start, error.to_string()))?;
        }
        Ok(Settings {
            path: Some(path),
            metric: self.metric.map(Spanned::into_inner),
            samples: self.samples.map(Spanned::into_inner),
            seed: self.seed,
            max_kappa_weighted: positive("max-kappa-weighted", self.max_kappa_weighted)?,
            max_kappa: positive("max-kappa", self.max_kappa)?,
            f32_digits: positive("f32-digits", self.f32_digits)?,
            gains: GainArgs {
                kp: gain("kp", self.kp)?,
                kd: gain("kd", self.kd)?,
                dt: positive("dt", self.dt)?,
                integrator: self.integrator,
            },
            fail_on,
        })
    }
}

/// The nearest file in the folders above the model's, or above the current one for a robot without a file.
fn nearest(model: &Loaded) -> Option<PathBuf> {
    let folder = match &model.kind {
        Kind::File(path) => std::fs::canonicalize(path).ok()?.parent()?.to_owned(),
        _ => std::env::current_dir().ok()?,
    };
    folder.ancestors().map(|folder| folder.join(NAME)).find(|path| path.is_file())
}

/// Line and column of a byte, counted from 1, columns in characters.
fn place(text: &str, offset: usize) -> (usize, usize) {
    let before = text.get(..offset).unwrap_or(text);
    let line = before.lines().count().max(1) + usize::from(before.ends_with('\n'));
    let column = before.rsplit('\n').next().map_or(0, |last| last.chars().count()) + 1;
    (line, column)
}

#[cfg(test)]
mod tests {
    use super::place;

    #[test]
    fn places_count_from_one() {
        let places = [0, 2, 3, 4, 5].map(|offset| place("é\n\nab", offset));
        assert_eq!(places, [(1, 1), (1, 2), (2, 1), (3, 1), (3, 2)]);
    }
}

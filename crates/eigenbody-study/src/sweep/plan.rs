//! A sweep's cases by number, and the rows of a chunk of them.

use std::ops::Range;
use std::path::{Path, PathBuf};

use eigenbody::model::Random;
use eigenbody::{Base, Error, Metric, Question, Reduction, conditioning_at};
use eigenbody_formats::{FormatError, LoadOptions, Loaded, load_from};
use thiserror::Error;

use super::spec::{Axis, Group, Robots, Spec, SpecError};
use super::{Quantity, fingerprint};
use crate::{Cell, Field};

/// What a chunk is meant to cost: n² for H and its extremes, and so much for each case, in units of some ten nanoseconds.
const COST_OF_CHUNK: f64 = 1.5e8;
const COST_OF_CASE: f64 = 500.0;
/// Most cases of a chunk.
const LARGEST: u64 = 1 << 14;

/// Why a case has no row.
#[derive(Debug, Error)]
pub enum SweepError {
    /// A configuration that a robot does not have, at its place in the spec.
    #[error(transparent)]
    Spec(#[from] SpecError),
    /// A robot or a configuration cannot be read.
    #[error("case {case}: {source}")]
    Format {
        /// Its number.
        case: u64,
        /// Why.
        source: Box<FormatError>,
    },
    /// Nothing can be computed of it.
    #[error("case {case}, {robot} at {at}: {source}")]
    Numbers {
        /// Its number.
        case: u64,
        /// The robot.
        robot: String,
        /// The configuration.
        at: String,
        /// Why.
        source: Error,
    },
}

/// One case: which robot, where.
#[derive(Debug, Clone, PartialEq)]
pub struct Case {
    /// Its number.
    pub number: u64,
    /// What names the robot.
    pub model: String,
    /// n, branching, skew and taper of a family.
    pub parameters: Option<[f64; 4]>,
    /// On a floating base.
    pub floating: bool,
    /// The configuration's expression.
    pub at: String,
    group: usize,
}

/// The rows of one chunk.
#[derive(Debug, Clone, PartialEq)]
pub struct Chunk {
    /// Its number.
    pub number: u64,
    /// One for each case, in order.
    pub rows: Vec<Vec<Cell>>,
}

/// All cases of a spec.
#[derive(Debug, Clone)]
pub struct Plan {
    spec: Spec,
    /// Where the spec's paths begin.
    folder: PathBuf,
    /// The first case of each group, and the end.
    starts: Vec<u64>,
    /// Cases of a chunk.
    size: u64,
    unit: &'static str,
    metric: Metric<f64>,
    /// Names and hashes of the robots that are no family's.
    models: Vec<(String, u64)>,
}

impl Group {
    /// Robots, each base one.
    fn robots(&self) -> u64 {
        let points = match &self.robots {
            Robots::Models(models) => models.len() as u64,
            Robots::Family { sample: Some(count), .. } => *count,
            Robots::Family { axes, sample: None, .. } => {
                axes.iter().map(Axis::len).fold(1, u64::saturating_mul)
            }
        };
        points.saturating_mul(self.floating.len() as u64)
    }

    fn configurations(&self) -> u64 {
        (self.at.len() as u64).saturating_add(self.random)
    }
}

impl Spec {
    /// Number of cases; none if it overflows.
    pub fn cases(&self) -> Option<u64> {
        let of = |group: &Group| group.robots().checked_mul(group.configurations());
        self.groups.iter().try_fold(0u64, |sum, group| sum.checked_add(of(group)?))
    }
}

/// A number that depends on every bit of both: the finaliser of SplitMix64 over their sum.
fn mix(seed: u64, key: u64) -> u64 {
    Random::new(seed ^ Random::new(key).bits()).bits()
}

impl Plan {
    /// Numbers the cases of a spec whose paths are seen from `folder`, the spec's own; empty for the current one. Rows do not depend on
    /// where that is.
    ///
    /// Errors: [`SweepError`] if a robot that a chunk's size depends on cannot be read, or does not have a configuration of its group.
    pub fn new(spec: Spec, folder: &Path) -> Result<Self, SweepError> {
        let mut starts = vec![0];
        for group in &spec.groups {
            let last = starts[starts.len() - 1];
            starts.push(last + group.robots() * group.configurations());
        }
        let metric = eigenbody_formats::metric(&spec.metric)
            .map_err(|source| SweepError::Format { case: 0, source: Box::new(source) })?;
        let folder = folder.to_owned();
        let mut plan = Self { spec, folder, starts, size: 1, unit: "kg m^2", metric, models: Vec::new() };
        let mut dearest: f64 = 1.0;
        let mut is_mixed = false;
        for group in 0..plan.spec.groups.len() {
            let robots = plan.spec.groups[group].robots();
            let step = plan.spec.groups[group].configurations();
            let is_named = matches!(plan.spec.groups[group].robots, Robots::Models(_));
            // Files are all looked at. Of a family, the ends of the grid are among the largest and smallest.
            let looked_at = if is_named { (0..robots).collect() } else { vec![0, robots.saturating_sub(1)] };
            for robot in looked_at {
                let case = plan.case(plan.starts[group] + robot * step);
                let loaded = plan.load(&case)?;
                if is_named {
                    plan.models.push((case.model.clone(), fingerprint::of_robot(&loaded)));
                }
                let mimic = plan.reduction(&case, &loaded).mimic;
                let Group { at, places, .. } = &plan.spec.groups[group];
                for (k, text) in at.iter().enumerate() {
                    let of = |error| places.error(k, format!("{error} (of {})", case.model));
                    loaded.configuration(text, mimic).map_err(of)?;
                }
                let n = loaded.model.nv() as f64;
                dearest = dearest.max(if n <= 200.0 { n * n } else { 200.0 * n });
                let rows = plan.reduction(&case, &loaded).dofs(&loaded.model);
                is_mixed |= rows.into_iter().any(|d| loaded.model.is_translation(d));
            }
        }
        plan.size = ((COST_OF_CHUNK / (COST_OF_CASE + 60.0 * dearest)) as u64).clamp(1, LARGEST);
        plan.unit = if is_mixed { "kg m^2, kg m, kg" } else { "kg m^2" };
        Ok(plan)
    }

    /// Number of cases.
    pub fn cases(&self) -> u64 {
        self.starts[self.starts.len() - 1]
    }

    /// Number of chunks.
    pub fn chunks(&self) -> u64 {
        self.cases().div_ceil(self.size)
    }

    /// 64 bits, as hexadecimals, of everything that a row depends on: the spec, the robots named in it, the version.
    pub fn fingerprint(&self, version: &str) -> String {
        format!("{:016x}", fingerprint::of_plan(version, &self.spec, &self.models))
    }

    /// `name hash` for every file that a group names, one a line.
    pub fn models_text(&self) -> String {
        self.models.iter().map(|(name, hash)| format!("{name} {hash:016x}\n")).collect()
    }

    /// The cases of a chunk.
    pub fn cases_of(&self, chunk: u64) -> Range<u64> {
        let first = (chunk * self.size).min(self.cases());
        first..(first + self.size).min(self.cases())
    }

    /// The spec.
    pub fn spec(&self) -> &Spec {
        &self.spec
    }

    /// Columns: which case, then the quantities.
    pub fn fields(&self) -> Vec<Field> {
        let parameters = ["n", "branching", "skew", "taper"].map(|name| Field::number(name, "1"));
        let head = [Field::number("case", "1"), Field::text("model"), Field::text("base"), Field::text("at")];
        let quantities = self.spec.quantities.iter().map(|quantity| quantity.field(self.unit));
        head.into_iter().chain(parameters).chain(quantities).collect()
    }

    /// Case `number`.
    pub fn case(&self, number: u64) -> Case {
        let group = self.starts.partition_point(|&start| start <= number) - 1;
        let Group { robots, floating, at, .. } = &self.spec.groups[group];
        let within = number - self.starts[group];
        let configurations = self.spec.groups[group].configurations();
        let (robot, configuration) = (within / configurations, within % configurations);
        let (point, base) = (robot / floating.len() as u64, robot % floating.len() as u64);
        let (model, parameters) = match robots {
            Robots::Models(models) => (models[point as usize].clone(), None),
            Robots::Family { name, axes, sample } => {
                let mut values = [0.0; 4];
                let mut random = Random::new(mix(self.spec.seed, (group as u64) << 40 | point));
                let mut rest = point;
                for (value, axis) in values.iter_mut().zip(axes).rev() {
                    *value = match sample {
                        Some(_) => axis.at(random.uniform()),
                        None => axis.value(rest % axis.len()),
                    };
                    rest /= axis.len().max(1);
                }
                values[0] = values[0].round();
                let [n, branching, skew, taper] = values;
                (format!("{name}({n},{branching:?},{skew:?},{taper:?})"), Some(values))
            }
        };
        let at = match at.get(configuration as usize) {
            Some(text) => text.clone(),
            None => format!("random({})", mix(self.spec.seed, number) >> 12),
        };
        Case { number, model, parameters, floating: floating[base as usize], at, group }
    }

    fn load(&self, case: &Case) -> Result<Loaded, SweepError> {
        let base = if case.floating { Base::Floating } else { Base::Fixed };
        load_from(&self.folder, &case.model, &LoadOptions { base, size_ratio: None })
            .map_err(|source| SweepError::Format { case: case.number, source: Box::new(source) })
    }

    /// Computes a chunk, on one thread.
    ///
    /// Errors: [`SweepError`], for the first case that fails.
    pub fn compute(&self, chunk: u64) -> Result<Chunk, SweepError> {
        Ok(Chunk { number: chunk, ..self.compute_cases(self.cases_of(chunk))? })
    }

    /// Computes some cases, on one thread. Errors: as [`compute`](Self::compute).
    pub fn compute_cases(&self, cases: Range<u64>) -> Result<Chunk, SweepError> {
        let mut rows = Vec::new();
        let mut loaded: Option<((String, bool), Loaded)> = None;
        for number in cases {
            let case = self.case(number);
            let key = (case.model.clone(), case.floating);
            let robot = match loaded.take() {
                Some((same, robot)) if same == key => robot,
                _ => self.load(&case)?,
            };
            rows.push(self.row(&case, &robot)?);
            loaded = Some((key, robot));
        }
        Ok(Chunk { number: 0, rows })
    }

    fn reduction(&self, case: &Case, robot: &Loaded) -> Reduction {
        let group = &self.spec.groups[case.group];
        Reduction {
            mimic: group.mimic.unwrap_or(robot.mimic),
            base: case.floating && (group.reduced || robot.is_family()),
        }
    }

    fn row(&self, case: &Case, robot: &Loaded) -> Result<Vec<Cell>, SweepError> {
        let reduction = self.reduction(case, robot);
        let q = robot
            .configuration(&case.at, reduction.mimic)
            .map_err(|source| SweepError::Format { case: case.number, source: Box::new(source) })?;
        let all = self.spec.quantities.contains(&Quantity::Eigenvalues);
        let question = Question { metric: self.metric.clone(), reduction, all, ..Question::default() };
        let answer = conditioning_at(&robot.model, &q, &question).map_err(|source| SweepError::Numbers {
            case: case.number,
            robot: case.model.clone(),
            at: case.at.clone(),
            source,
        })?;
        let base = if case.floating { "floating" } else { "fixed" };
        let mut row = vec![
            Cell::from(case.number as f64),
            Cell::Text(case.model.clone()),
            Cell::Text(base.to_owned()),
            Cell::Text(case.at.clone()),
        ];
        let parameters = case.parameters.unwrap_or([f64::NAN; 4]);
        row.extend(parameters.map(Cell::from));
        row.extend(self.spec.quantities.iter().map(|quantity| quantity.cell(&answer, &q)));
        Ok(row)
    }
}

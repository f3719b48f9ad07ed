//! Monitors: quantities along any stream of configurations, a simulation as it runs or a log.

mod quantity;

pub use quantity::{About, Quantity};

use crate::estimators::pivot_ratio;
use crate::row::{Cell, Field};
use crate::simulate::State;
use eigenbody::dynamics::{MomentumWorkspace, energy_into, momentum_into};
use eigenbody::spectrum::sturm::{Diagonal, Pencil};
use eigenbody::spectrum::{Tracker, eigenvalues};
use eigenbody::{Error, InputError, Metric, Model, Question, Reduction, conditioning_at};
use std::time::{Duration, Instant};

/// What a monitor did so far.
#[derive(Debug, Clone, PartialEq)]
pub struct Spent {
    /// Which part of the work.
    pub what: &'static str,
    /// Rows.
    pub rows: u64,
    /// Time over all rows.
    pub time: Duration,
    /// Of a tracker: factorisations a row and end.
    pub factorisations: Option<f64>,
    /// Of a tracker: ends that were lost and found again.
    pub restarts: Option<u64>,
}

/// Quantities along a motion, every shared part computed once a row.
///
/// ```
/// use eigenbody::{Family, Reduction};
/// use eigenbody_study::{Cell, monitor::{Monitors, Quantity}, simulate::State};
/// let chain = Family::slender_chain(4, 2.2, 1.0)?.model::<f64>()?;
/// let mut monitors = Monitors::new(&chain, Reduction::default(), &[Quantity::Kappa, Quantity::DiagonalRatio])?;
/// let row = monitors.observe(&State { t: 0.0, q: vec![0.0; 4], v: vec![0.0; 4] })?;
/// assert!(matches!(row[..], [Cell::Number(Some(kappa)), Cell::Number(Some(ratio))] if ratio < kappa));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Monitors<'m> {
    model: &'m Model<f64>,
    reduction: Reduction,
    quantities: Vec<Quantity>,
    unit: &'static str,
    parts: Vec<Part<'m>>,
    /// κ(0)/δ(0), once it is known.
    scale: Option<f64>,
}

/// A part of the work that several quantities may share.
struct Part<'m> {
    what: &'static str,
    work: Work<'m>,
    rows: u64,
    time: Duration,
}

enum Work<'m> {
    /// Both ends in a metric; made at the first row.
    Track {
        metric: Metric<f64>,
        tracker: Option<Box<Tracker<'m>>>,
        ends: [f64; 2],
        spent: u64,
        restarts: u64,
    },
    Diagonal {
        room: Option<Box<(Pencil<'m, f64>, Diagonal<f64>)>>,
        ratio: f64,
    },
    /// Mimic joints leave no tree: H and its eigenvalues.
    Dense {
        verdict: Box<Option<eigenbody::Conditioning<f64>>>,
    },
    Matrix {
        pivot_ratio: Option<f64>,
        eigenvalues: Option<Vec<f64>>,
        wants: [bool; 2],
    },
    Energy {
        room: Box<MomentumWorkspace<f64>>,
        energy: [f64; 3],
        momentum: [f64; 6],
    },
}

const EUCLIDEAN: &str = "both ends of H";
const WEIGHTED: &str = "both ends of H with unit diagonal";
const DIAGONAL: &str = "diagonal of H";
const DENSE: &str = "both ends of GᵀHG, dense";
const MATRIX: &str = "H and what is made of it";
const ENERGY: &str = "energy and momentum";

impl<'m> Monitors<'m> {
    /// For these quantities, in this order, over the degrees of freedom of a reduction.
    ///
    /// Errors: [`InputError`] where a floating base is to be removed and there is none.
    pub fn new(
        model: &'m Model<f64>,
        reduction: Reduction,
        quantities: &[Quantity],
    ) -> Result<Self, InputError> {
        use Quantity as Q;
        if reduction.base && !model.has_floating_base() {
            return Err(InputError::NoFloatingBase);
        }
        let asks = |any: &[Q]| quantities.iter().any(|quantity| any.contains(quantity));
        let is_coupled = reduction.mimic && model.coupling().is_some();
        let mut parts = Vec::new();
        let mut part = |what, work| parts.push(Part { what, work, rows: 0, time: Duration::ZERO });
        let track =
            |metric| Work::Track { metric, tracker: None, ends: [f64::NAN; 2], spent: 0, restarts: 0 };
        let of_ends = asks(&[Q::Kappa, Q::LambdaMin, Q::LambdaMax, Q::Modes]);
        let of_weighted = asks(&[Q::KappaWeighted, Q::Bracket]);
        let of_diagonal = asks(&[Q::DiagonalRatio, Q::ScaledDiagonalRatio, Q::Bracket]);
        if is_coupled {
            if of_ends || of_weighted || of_diagonal {
                part(DENSE, Work::Dense { verdict: Box::new(None) });
            }
        } else {
            if of_ends {
                part(EUCLIDEAN, track(Metric::Euclidean));
            }
            if of_weighted {
                part(WEIGHTED, track(Metric::UnitDiagonal));
            }
            if of_diagonal {
                part(DIAGONAL, Work::Diagonal { room: None, ratio: f64::NAN });
            }
        }
        let wants = [asks(&[Q::PivotRatio]), asks(&[Q::Eigenvalues])];
        if wants != [false; 2] {
            part(MATRIX, Work::Matrix { pivot_ratio: None, eigenvalues: None, wants });
        }
        if asks(&[Q::Energy, Q::Momentum]) {
            let room = Box::new(MomentumWorkspace::new(model));
            part(ENERGY, Work::Energy { room, energy: [0.0; 3], momentum: [0.0; 6] });
        }
        let translations = reduction.dofs(model).into_iter().map(|d| model.is_translation(d));
        let unit = Metric::<f64>::Euclidean.unit(translations);
        Ok(Self { model, reduction, quantities: quantities.to_vec(), unit, parts, scale: None })
    }

    /// The columns of a row.
    pub fn fields(&self) -> Vec<Field> {
        self.quantities.iter().flat_map(|quantity| quantity.fields(self.unit)).collect()
    }

    /// True if a quantity needs velocities.
    pub fn need_velocities(&self) -> bool {
        self.quantities.iter().any(|quantity| matches!(quantity, Quantity::Energy | Quantity::Momentum))
    }

    /// One row. What does not exist, as κ of a singular H, is an empty cell.
    ///
    /// Errors: [`Error`] if the state does not fit the model.
    pub fn observe(&mut self, state: &State) -> Result<Vec<Cell>, Error> {
        for part in &mut self.parts {
            let start = Instant::now();
            part.work.update(self.model, self.reduction, state)?;
            part.time += start.elapsed();
            part.rows += 1;
        }
        if self.scale.is_none() && self.quantities.contains(&Quantity::ScaledDiagonalRatio) {
            self.scale = Some(self.scale_at(&state.q)?);
        }
        Ok(self.quantities.iter().flat_map(|&quantity| self.cells(quantity)).collect())
    }

    /// What the monitors cost so far.
    pub fn spent(&self) -> Vec<Spent> {
        let spent = |part: &Part<'_>| {
            let (factorisations, restarts) = match part.work {
                Work::Track { spent, restarts, .. } => {
                    // The first row starts cold.
                    let rows = part.rows.saturating_sub(1).max(1);
                    (Some(spent as f64 / (2 * rows) as f64), Some(restarts))
                }
                _ => (None, None),
            };
            Spent { what: part.what, rows: part.rows, time: part.time, factorisations, restarts }
        };
        self.parts.iter().map(spent).collect()
    }

    fn scale_at(&self, q: &[f64]) -> Result<f64, Error> {
        let question = Question { reduction: self.reduction, ..Question::default() };
        let verdict = conditioning_at(self.model, q, &question)?;
        Ok(verdict.kappa.zip(verdict.diagonal_ratio).map_or(f64::NAN, |(kappa, ratio)| kappa / ratio))
    }

    fn find<T>(&self, get: impl Fn(&Part<'m>) -> Option<T>) -> Option<T> {
        self.parts.iter().find_map(get)
    }

    fn verdict(&self) -> Option<&eigenbody::Conditioning<f64>> {
        self.parts.iter().find_map(|part| match &part.work {
            Work::Dense { verdict } => verdict.as_ref().as_ref(),
            _ => None,
        })
    }

    /// λmin and λmax in the Euclidean or the unit-diagonal metric.
    fn ends(&self, what: &'static str) -> Option<[f64; 2]> {
        self.find(|part| match part.work {
            Work::Track { ends, .. } if part.what == what => Some(ends),
            _ => None,
        })
    }

    fn kappa(&self, what: &'static str) -> Option<f64> {
        match (self.ends(what), self.verdict()) {
            (Some([min, max]), _) => (min > 0.0).then_some(max / min),
            (None, Some(verdict)) if what == EUCLIDEAN => verdict.kappa,
            (None, verdict) => verdict?.kappa_weighted,
        }
    }

    fn diagonal_ratio(&self) -> Option<f64> {
        let ratio = self.find(|part| match part.work {
            Work::Diagonal { ratio, .. } => Some(ratio),
            _ => None,
        });
        ratio.or_else(|| self.verdict()?.diagonal_ratio)
    }

    /// The softest (0) or stiffest (1) mode.
    fn mode(&self, which: usize) -> Vec<f64> {
        let dofs = self.reduction.dofs(self.model);
        let tracked = self.find(|part| match &part.work {
            Work::Track { tracker: Some(tracker), .. } if part.what == EUCLIDEAN => {
                let all: Vec<f64> = tracker.mode(which).collect();
                Some(dofs.iter().map(|&d| all[d]).collect())
            }
            _ => None,
        });
        let dense = || {
            let verdict = self.verdict()?;
            if which == 0 { verdict.softest.clone() } else { verdict.stiffest.clone() }
        };
        tracked.or_else(dense).unwrap_or_default()
    }

    fn cells(&self, quantity: Quantity) -> Vec<Cell> {
        let number = |x: Option<f64>| vec![Cell::Number(x.filter(|x| x.is_finite()))];
        let end = |which: usize| match (self.ends(EUCLIDEAN), self.verdict()) {
            (Some(ends), _) => Some(ends[which]),
            (None, verdict) => verdict.and_then(|v| if which == 0 { v.lambda_min } else { v.lambda_max }),
        };
        match quantity {
            Quantity::Kappa => number(self.kappa(EUCLIDEAN)),
            Quantity::KappaWeighted => number(self.kappa(WEIGHTED)),
            Quantity::LambdaMin => number(end(0)),
            Quantity::LambdaMax => number(end(1)),
            Quantity::Modes => vec![Cell::List(self.mode(0)), Cell::List(self.mode(1))],
            Quantity::DiagonalRatio => number(self.diagonal_ratio()),
            Quantity::ScaledDiagonalRatio => {
                number(self.diagonal_ratio().zip(self.scale).map(|(ratio, scale)| ratio * scale))
            }
            Quantity::Bracket => {
                let ratio = self.diagonal_ratio();
                let upper = ratio.zip(self.kappa(WEIGHTED)).map(|(ratio, kappa)| ratio * kappa);
                [number(ratio), number(upper)].concat()
            }
            Quantity::PivotRatio => number(self.find(|part| match part.work {
                Work::Matrix { pivot_ratio, .. } => pivot_ratio,
                _ => None,
            })),
            Quantity::Eigenvalues => vec![Cell::List(
                self.find(|part| match &part.work {
                    Work::Matrix { eigenvalues, .. } => eigenvalues.clone(),
                    _ => None,
                })
                .unwrap_or_default(),
            )],
            Quantity::Energy => self
                .find(|part| match part.work {
                    Work::Energy { energy, .. } => Some(energy),
                    _ => None,
                })
                .map_or_else(Vec::new, |energy| energy.map(Cell::from).into()),
            Quantity::Momentum => vec![Cell::List(
                self.find(|part| match part.work {
                    Work::Energy { momentum, .. } => Some(momentum.to_vec()),
                    _ => None,
                })
                .unwrap_or_default(),
            )],
        }
    }
}

impl<'m> Work<'m> {
    fn update(&mut self, model: &'m Model<f64>, reduction: Reduction, state: &State) -> Result<(), Error> {
        let q = &state.q;
        match self {
            Self::Track { metric, tracker, ends, spent, restarts } => match tracker {
                Some(tracker) => {
                    let readings = tracker.update(q)?;
                    *spent += readings.iter().map(|reading| reading.factorisations as u64).sum::<u64>();
                    *restarts += readings.iter().filter(|reading| reading.restarted).count() as u64;
                    *ends = readings.map(|reading| reading.value);
                }
                None => {
                    let mut first = Tracker::new(model, q, metric, reduction.base)?;
                    *ends = first.update(q)?.map(|reading| reading.value);
                    *tracker = Some(Box::new(first));
                }
            },
            Self::Diagonal { room, ratio } => {
                if room.is_none() {
                    let pencil = Pencil::euclidean(model, q, reduction.base)?;
                    let diagonal = Diagonal::new(&pencil);
                    *room = Some(Box::new((pencil, diagonal)));
                }
                let Some(room) = room else { return Ok(()) };
                let (pencil, diagonal) = room.as_mut();
                pencil.update(q)?;
                let own = &diagonal.update(pencil)[pencil.removed()..];
                let (min, max) =
                    own.iter().fold((f64::INFINITY, 0.0f64), |(min, max), &x| (x.min(min), x.max(max)));
                *ratio = max / min;
            }
            Self::Dense { verdict } => {
                let question = Question { reduction, ..Question::default() };
                **verdict = Some(conditioning_at(model, q, &question)?);
            }
            Self::Matrix { pivot_ratio: pivots, eigenvalues: all, wants } => {
                let H = reduction.mass_matrix(model, q)?;
                *pivots = wants[0].then(|| pivot_ratio(&H));
                *all = match wants[1] {
                    true => Some(eigenvalues(&H, &vec![1.0; H.rows()])?),
                    false => None,
                };
            }
            Self::Energy { room, energy, momentum } => {
                let found = energy_into(model, q, &state.v, room)?;
                *energy = [found.kinetic + found.potential, found.kinetic, found.potential];
                *momentum = momentum_into(model, q, &state.v, room)?.h.to_array();
            }
        }
        Ok(())
    }
}

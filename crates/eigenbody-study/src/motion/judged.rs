//! Estimators of κ beside κ itself, along motions.
//!
//! ```text
//! r = max H_dd/min H_dd     δ_s = r κ(0)/r(0)     pivot ratio     r κ′ ≥ κ     against κ, followed by the tracker
//! ```
//! Every tracked κ is checked against the engine without memory, row by row.

use super::{Group, Subject};
use crate::StudyError;
use crate::estimators::pivot_ratio;
use crate::simulate::{
    Algorithm, Controller, DORMAND_PRINCE, Forces, Method, Simulation, Steps, Trajectory, joint_springs,
};
use eigenbody::search::{Effort, survey};
use eigenbody::spectrum::sturm::{Diagonal, Pencil};
use eigenbody::spectrum::{Precision, Tracker, eigenvalues, extremes};
use eigenbody::{Family, Metric, Model};
use std::hint::black_box;
use std::ops::ControlFlow;
use std::time::Instant;

/// Rows a second.
const RATE: f64 = 1000.0;
/// Relative error estimate up to which the engine's own value is a reference.
const KNOWN: f64 = 1e-13;

/// A motion that takes more steps ends there.
const MOST_STEPS: u64 = 30_000;

/// A kind of motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Motion {
    /// Released in a random configuration, light damping.
    Swinging,
    /// A controller pulls from one random posture to the next, two a second.
    Driven,
    /// A straight line through the worst configuration that the joint limits allow.
    ThroughTheWorst,
    /// Independent random configurations.
    Random,
}

impl Motion {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Swinging, Self::Driven, Self::ThroughTheWorst, Self::Random];

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Swinging => "swinging",
            Self::Driven => "PD-driven",
            Self::ThroughTheWorst => "through the worst",
            Self::Random => "random",
        }
    }
}

/// Estimators, in the order of [`Row::estimates`].
pub const ESTIMATORS: [&str; 4] =
    ["diagonal ratio r", "scaled diagonal ratio δ_s", "pivot ratio", "bracket, r κ′"];

/// One configuration.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Row {
    /// κ by the tracker.
    pub kappa: f64,
    /// By the estimators.
    pub estimates: [f64; 4],
}

/// What was found along one motion of one robot.
#[derive(Debug, Clone)]
pub struct Judgement {
    /// The robot.
    pub name: String,
    /// Its kind.
    pub group: Group,
    /// Degrees of freedom.
    pub dofs: usize,
    /// The motion.
    pub motion: Motion,
    /// Every configuration where κ exists.
    pub rows: Vec<Row>,
    /// Worst relative error of λmin and λmax against the engine, where the engine knows them to 1e-13.
    pub tracker_error: f64,
    /// Rows where the engine does not.
    pub unknown: usize,
    /// Factorisations a row and end, those of lost ends included.
    pub factorisations: f64,
    /// Ends that were lost and found again.
    pub restarts: usize,
    /// Why the motion ended early, if it did.
    pub ended: Option<String>,
}

/// Seconds a row.
#[derive(Debug, Clone)]
pub struct Cost {
    /// The robot.
    pub name: String,
    /// Degrees of freedom.
    pub dofs: usize,
    /// Both ends, by the tracker.
    pub tracker: f64,
    /// The diagonal ratio.
    pub diagonal: f64,
    /// H and its pivot ratio.
    pub pivots: f64,
    /// H and all its eigenvalues.
    pub dense: f64,
}

/// Chains and trees of the study.
///
/// # Errors
///
/// [`StudyError`], if a member cannot be built.
pub fn members() -> Result<Vec<Subject>, StudyError> {
    let mut members = Vec::new();
    for n in [4, 10, 20, 100, 1000] {
        let family = Family::slender_chain(n, 1.0, 1.0)?;
        members.push(Subject::family(format!("chain({n})"), Group::Chain, &family)?);
    }
    members.push(Subject::family(
        "hydra(20,1,0.5,1)".into(),
        Group::Chain,
        &Family::hydra(20, 1.0, 0.5, 1.0)?,
    )?);
    members.push(Subject::family(
        "hydra(20,1,0,0.8)".into(),
        Group::Chain,
        &Family::hydra(20, 1.0, 0.0, 0.8)?,
    )?);
    members.push(Subject::family(
        "hydra(20,1.5,0.5,1)".into(),
        Group::Tree,
        &Family::hydra(20, 1.5, 0.5, 1.0)?,
    )?);
    members.push(Subject::family(
        "hydra(60,2,0.5,0.9)".into(),
        Group::Tree,
        &Family::hydra(60, 2.0, 0.5, 0.9)?,
    )?);
    members.push(Subject::family(
        "onion(20,2,1,0.9)".into(),
        Group::Tree,
        &Family::onion(20, 2.0, 1.0, 0.9)?,
    )?);
    let all = Family::auto_tree(16, 1.5, 0.3, 1.0)?;
    members.push(Subject::family("auto_tree(16,1.5,0.3,1)".into(), Group::Tree, &all)?);
    Ok(members)
}

/// The configurations of a motion, and why it ended early.
fn configurations(subject: &Subject, motion: Motion) -> Result<(Vec<Vec<f64>>, Option<String>), StudyError> {
    let model = &subject.model;
    let long = if subject.dofs() > 500 { 0.06 } else { 2.0 };
    let steps = (long * RATE) as usize;
    match motion {
        Motion::Swinging => Ok(released(model, long, steps)),
        Motion::Driven => Ok(driven(model, long, steps)?),
        Motion::ThroughTheWorst => {
            let middle = if subject.dofs() > 150 {
                model.neutral()
            } else {
                let effort = Effort { samples: 512, ..Effort::default() };
                let found = survey(model, subject.reduction(), &Metric::Euclidean, effort, |_| {
                    ControlFlow::Continue(())
                })?;
                let [worst, ..] = found.spreads;
                worst.at
            };
            // Half a radian either way.
            let way = model.difference(&middle, &model.random(5))?;
            let largest = way.iter().fold(1e-9f64, |largest, x| largest.max(x.abs()));
            let at = |k: usize| {
                let part = (k as f64 / (steps - 1) as f64 - 0.5) / largest;
                model.integrate(&middle, &way.iter().map(|x| part * x).collect::<Vec<_>>())
            };
            Ok(((0..steps).map(at).collect::<Result<_, _>>()?, None))
        }
        Motion::Random => Ok(((0..300.min(steps as u64)).map(|seed| model.random(seed)).collect(), None)),
    }
}

fn released(model: &Model<f64>, long: f64, steps: usize) -> (Vec<Vec<f64>>, Option<String>) {
    let v: Vec<f64> = (0..model.nv()).map(|d| ((7 * d % 5) as f64 - 2.0) * 0.2).collect();
    // The damping ratio of a joint that swings at 1 Hz: one in fifty.
    let forces = match Controller::tuned(model, Trajectory::constant(model.random(1)), 1.0, 0.02) {
        Ok(tuned) => {
            let springs = joint_springs(model, 0.0, 1.0).into_iter();
            let springs = springs.map(|mut spring| {
                spring.damping = tuned.kd[spring.arms[0].0];
                spring
            });
            Forces { springs: springs.collect(), ..Forces::default() }
        }
        Err(_) => Forces::default(),
    };
    simulated(model, &model.random(1), &v, forces, long, steps)
}

fn driven(
    model: &Model<f64>,
    long: f64,
    steps: usize,
) -> Result<(Vec<Vec<f64>>, Option<String>), StudyError> {
    let times = (0..6).map(|k| 0.5 * f64::from(k)).collect();
    let rows: Vec<Vec<f64>> = (11..17).map(|seed| model.random(seed)).collect();
    let start = rows[0].clone();
    let target = Trajectory::new(times, rows, model.nq())?;
    let controller = Controller::tuned(model, target, 3.0, 1.0)?;
    let forces = Forces { controller: Some(controller), ..Forces::default() };
    Ok(simulated(model, &start, &vec![0.0; model.nv()], forces, long, steps))
}

fn simulated(
    model: &Model<f64>,
    q: &[f64],
    v: &[f64],
    forces: Forces,
    long: f64,
    steps: usize,
) -> (Vec<Vec<f64>>, Option<String>) {
    let mut seen = Vec::new();
    let method = Method::RungeKutta(DORMAND_PRINCE);
    let outcome = || -> Result<(), String> {
        let mut simulation =
            Simulation::new(model, q, v, method, Steps::Adaptive(1e-6), forces, Algorithm::Aba)
                .map_err(|error| error.to_string())?;
        let mut state = simulation.state().clone();
        for row in 0..steps {
            let at = long * row as f64 / steps as f64;
            while simulation.state().t < at {
                simulation.step(long).map_err(|error| error.to_string())?;
                if simulation.effort().steps > MOST_STEPS {
                    return Err(format!(
                        "more than {MOST_STEPS} steps up to t = {:.3} s",
                        simulation.state().t
                    ));
                }
            }
            simulation.at(at, &mut state);
            seen.push(state.q.clone());
        }
        Ok(())
    };
    let ended = outcome().err();
    (seen, ended)
}

/// Follows one motion.
///
/// # Errors
///
/// [`StudyError`], if an algorithm fails.
pub fn judge(subject: &Subject, motion: Motion) -> Result<Judgement, StudyError> {
    let Subject { name, group, model } = subject;
    let (path, ended) = configurations(subject, motion)?;
    let free_floating = subject.reduction().base;
    let mut found = Judgement {
        name: name.clone(),
        group: *group,
        dofs: subject.dofs(),
        motion,
        rows: Vec::new(),
        tracker_error: 0.0,
        unknown: 0,
        factorisations: 0.0,
        restarts: 0,
        ended,
    };
    let Some(first) = path.first() else { return Ok(found) };
    let start = |metric| Tracker::new(model, first, &metric, free_floating);
    let (mut euclidean, mut weighted) = (start(Metric::Euclidean)?, start(Metric::UnitDiagonal)?);
    let mut pencil = Pencil::euclidean(model, first, free_floating)?;
    let mut diagonal = Diagonal::new(&pencil);
    let mut scale = None;
    let every = if found.dofs > 500 { 10 } else { 1 };
    for (k, q) in path.iter().enumerate() {
        let ends = euclidean.update(q)?;
        let scaled = weighted.update(q)?;
        found.factorisations += ends.iter().map(|end| end.factorisations as f64).sum::<f64>();
        found.restarts += ends.iter().filter(|end| end.restarted).count();
        pencil.update(q)?;
        if k % every == 0 {
            check(&pencil, ends.map(|end| end.value), &mut found)?;
        }
        let own = &diagonal.update(&pencil)[pencil.removed()..];
        let (min, max) = own.iter().fold((f64::INFINITY, 0.0f64), |(min, max), &x| (x.min(min), x.max(max)));
        let (kappa, ratio) = (ends[1].value / ends[0].value, max / min);
        if !(kappa.is_finite() && ratio.is_finite() && ends[0].value > 0.0) {
            continue;
        }
        let scale = *scale.get_or_insert(kappa / ratio);
        let pivots = match found.dofs > 500 || k % 5 != 0 {
            true => f64::NAN,
            false => pivot_ratio(&subject.reduction().mass_matrix(model, q)?),
        };
        let upper = ratio * scaled[1].value / scaled[0].value;
        found.rows.push(Row { kappa, estimates: [ratio, ratio * scale, pivots, upper] });
    }
    found.factorisations /= (2 * path.len()) as f64;
    Ok(found)
}

/// The tracker's ends against the engine's.
fn check(pencil: &Pencil<'_, f64>, tracked: [f64; 2], found: &mut Judgement) -> Result<(), StudyError> {
    let cold = extremes(pencil, Precision::Auto)?;
    for (end, tracked) in [cold.min.ok(), Some(cold.max)].into_iter().zip(tracked) {
        match end.filter(|end| end.error_estimate <= KNOWN) {
            Some(end) => found.tracker_error = found.tracker_error.max((tracked / end.value - 1.0).abs()),
            None => found.unknown += 1,
        }
    }
    Ok(())
}

/// What a row costs, by turns: the tracker while the robot swings, the others at the same configurations.
///
/// # Errors
///
/// [`StudyError`], if an algorithm fails.
pub fn cost(subject: &Subject) -> Result<Cost, StudyError> {
    let model = &subject.model;
    let (path, _) = configurations(subject, Motion::Swinging)?;
    let path = &path[..path.len().min(200)];
    let reduction = subject.reduction();
    let mut tracker = Tracker::new(model, &path[0], &Metric::Euclidean, reduction.base)?;
    let mut pencil = Pencil::euclidean(model, &path[0], reduction.base)?;
    let mut diagonal = Diagonal::new(&pencil);
    let few = if subject.dofs() > 500 { 2 } else { 20 };
    let mut best = [f64::INFINITY; 4];
    for _ in 0..5 {
        let mut take = |which: usize, start: Instant, rows: usize| {
            best[which] = best[which].min(start.elapsed().as_secs_f64() / rows as f64);
        };
        tracker.update(&path[0])?;
        let start = Instant::now();
        for q in path {
            black_box(tracker.update(q)?);
        }
        take(0, start, path.len());
        let start = Instant::now();
        for q in path {
            pencil.update(q)?;
            black_box(diagonal.update(&pencil));
        }
        take(1, start, path.len());
        let start = Instant::now();
        for q in &path[..few.min(path.len())] {
            black_box(pivot_ratio(&reduction.mass_matrix(model, q)?));
        }
        take(2, start, few.min(path.len()));
        let start = Instant::now();
        for q in &path[..few.min(path.len())] {
            let H = reduction.mass_matrix(model, q)?;
            black_box(eigenvalues(&H, &vec![1.0; H.rows()])?);
        }
        take(3, start, few.min(path.len()));
    }
    let [tracker, diagonal, pivots, dense] = best;
    Ok(Cost { name: subject.name.clone(), dofs: subject.dofs(), tracker, diagonal, pivots, dense })
}

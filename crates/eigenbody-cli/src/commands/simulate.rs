//! `eigenbody simulate`.

use super::motion::{Ending, Recorder, quantities};
use super::{option_gains, positive};
use crate::args::{DynamicsArg, MethodOfMotion, SimulateArgs, Switch};
use crate::failure::Failure;
use crate::output::{check_model, say};
use crate::system::robot;
use eigenbody::dynamics::energy;
use eigenbody::spatial::Vec3;
use eigenbody::{Model, Reduction};
use eigenbody_formats::motion::Wanted;
use eigenbody_formats::{Loaded, velocity};
use eigenbody_report::count;
use eigenbody_study::simulate::{
    Algorithm, Controller, DORMAND_PRINCE, Forces, Method, RK4, Report, Simulation, State, Steps, Trajectory,
    joint_limits, level, passive_springs,
};
use std::ops::ControlFlow;
use std::time::Instant;

/// Length of a step (s), where none is given.
const STEP: f64 = 1e-3;
/// Error of a step, where none is given.
const TOLERANCE: f64 = 1e-9;
/// Events that are printed; more are counted.
const PRINTED: usize = 20;

/// Simulates, row by row.
pub fn run(args: &SimulateArgs) -> Result<Ending, Failure> {
    let Some(quantities) = quantities(&args.rows)? else { return Ok(Ending::Whole) };
    let (loaded, reduction) = robot(&args.model)?;
    check_model(&loaded, &args.rows.writes())?;
    let name = &args.model.model;
    let q = loaded.configuration(&args.initial, reduction.mimic)?;
    let v = velocity(&args.velocity, &loaded.model)?;
    let v = loaded.model.coupling().filter(|_| reduction.mimic).map_or(v.clone(), |map| map.follow(&v));
    let forces = forces(args, &loaded, reduction)?;
    let is_free = forces.springs.is_empty() && forces.controller.is_none() && forces.torque.is_none();
    let refused = |source| Failure::Simulation { model: name.clone(), source };
    let model = match args.gravity {
        Switch::On => loaded.model.clone(),
        Switch::Off => {
            loaded.model.clone().with_gravity(Vec3::ZERO).map_err(|error| refused(error.into()))?
        }
    };
    let (method, steps) = method(args)?;
    let algorithm = match args.dynamics {
        DynamicsArg::Aba => Algorithm::Aba,
        DynamicsArg::Crba => Algorithm::CrbaLtl,
    };
    let algorithm = algorithm.of(&model, reduction);
    let (time, rate) = (positive("--time", args.time)?, positive("--rate", args.rate)?);
    let intervals = (time * rate).round().max(1.0);
    if intervals > 1e9 {
        return Err(Failure::Usage(format!("--time {time} --rate {rate}: more than 1e9 rows")));
    }
    let mut simulation =
        Simulation::new(&model, &q, &v, method, steps, forces, algorithm).map_err(refused)?;
    let mut watches = joint_limits(&model);
    for event in &args.event {
        let watch = level(event, &model, reduction, &q);
        watches.push(watch.map_err(|error| Failure::Usage(format!("--event {event}: {error}")))?);
    }
    let mut recorder = Recorder::new(&model, name, reduction, &quantities, true, &args.rows)?;

    let start = Instant::now();
    let mut book = Book::default();
    let mut events = 0;
    let mut failure = None;
    let outcome = simulation.run(time, intervals as usize, &mut watches, &mut |report| {
        match report {
            Report::Event(event) => {
                events += 1;
                if events <= PRINTED {
                    recorder.say(&format!("t = {:.6} s: {}", event.t, event.what));
                }
            }
            Report::Step => {}
            Report::Sample(state) => {
                book.enter(&model, state);
                if let Err(error) = recorder.record(state, state.t / time) {
                    failure = Some(error);
                    return ControlFlow::Break(());
                }
            }
        }
        if recorder.is_stopped() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    if let Some(failure) = failure {
        return Err(failure);
    }
    if events > PRINTED {
        recorder.say(&count(events - PRINTED, "more event", "more events"));
    }
    let ending = match outcome {
        Ok(ControlFlow::Continue(())) => Ending::Whole,
        Ok(ControlFlow::Break(())) => {
            recorder.say("interrupted: the rows so far are written");
            Ending::Interrupted
        }
        Err(error) if error.is_along_the_way() => {
            recorder.say(&format!("{error}; the rows so far are written"));
            Ending::BlownUp
        }
        Err(error) => return Err(refused(error)),
    };
    let effort = simulation.effort();
    recorder.finish(&args.rows, start.elapsed())?;
    say(format_args!(
        "  {}: {}, {} refused, {}",
        method.name(),
        count(effort.steps as usize, "step", "steps"),
        effort.refused,
        count(effort.evaluations as usize, "acceleration", "accelerations")
    ));
    book.close(is_free);
    Ok(ending)
}

/// Energy along the rows.
#[derive(Default)]
struct Book {
    first: Option<f64>,
    drift: f64,
    largest: f64,
}

impl Book {
    fn enter(&mut self, model: &Model<f64>, state: &State) {
        let Ok(energy) = energy(model, &state.q, &state.v) else { return };
        let total = energy.kinetic + energy.potential;
        let first = *self.first.get_or_insert(total);
        self.drift = self.drift.max((total - first).abs());
        self.largest = self.largest.max(energy.kinetic);
    }

    fn close(&self, is_free: bool) {
        let why = if is_free { "" } else { ", work of forces included" };
        if self.largest > 0.0 {
            let part = self.drift / self.largest;
            say(format_args!("  energy changes by up to {part:.1e} of the largest kinetic energy{why}"));
        }
    }
}

fn method(args: &SimulateArgs) -> Result<(Method, Steps), Failure> {
    let is_adaptive = args.method == MethodOfMotion::Dopri5;
    if is_adaptive && args.step.is_some() {
        return Err(Failure::Usage(
            "--step is for --method euler, rk4 and midpoint; dopri5 has --tolerance".into(),
        ));
    }
    if !is_adaptive && args.tolerance.is_some() {
        return Err(Failure::Usage("--tolerance is for --method dopri5; the others have --step".into()));
    }
    let fixed = || Ok::<_, Failure>(Steps::Fixed(positive("--step", args.step.unwrap_or(STEP))?));
    Ok(match args.method {
        MethodOfMotion::Euler => (Method::SemiImplicitEuler, fixed()?),
        MethodOfMotion::Rk4 => (Method::RungeKutta(RK4), fixed()?),
        MethodOfMotion::Midpoint => (Method::ImplicitMidpoint, fixed()?),
        MethodOfMotion::Dopri5 => {
            let tolerance = positive("--tolerance", args.tolerance.unwrap_or(TOLERANCE))?;
            (Method::RungeKutta(DORMAND_PRINCE), Steps::Adaptive(tolerance))
        }
    })
}

fn forces(args: &SimulateArgs, loaded: &Loaded, reduction: Reduction) -> Result<Forces, Failure> {
    let model = &loaded.model;
    let numbers = |source: eigenbody::InputError| Failure::Numbers {
        model: args.model.model.clone(),
        source: source.into(),
    };
    let own = match args.springs {
        Switch::On => &loaded.springs[..],
        Switch::Off => &[],
    };
    let more = |option: &str, text: &Option<String>| {
        text.as_ref().map_or(Ok(Vec::new()), |text| option_gains(option, text, model))
    };
    // An actuator's feedback is a controller, and that is --hold.
    let springs = passive_springs(
        model,
        own,
        &more("--damping", &args.damping)?,
        &more("--stiffness", &args.stiffness)?,
    );
    let target = match (&args.hold, &args.follow) {
        (Some(posture), _) => Some(Trajectory::constant(loaded.configuration(posture, reduction.mimic)?)),
        (None, Some(file)) => Some(Trajectory::read(file, model, reduction.mimic, Wanted::Configurations)?),
        (None, None) => None,
    };
    let (frequency, ratio) =
        (positive("--bandwidth", args.bandwidth)?, positive("--damping-ratio", args.damping_ratio)?);
    let controller = target
        .map(|target| Controller::tuned(model, target, frequency, ratio))
        .transpose()
        .map_err(numbers)?;
    let torque = match &args.torque {
        Some(file) => Some(Trajectory::read(file, model, reduction.mimic, Wanted::Forces)?),
        None => None,
    };
    let rest = loaded.configuration(&args.rest, reduction.mimic)?;
    Ok(Forces { springs, rest, controller, torque })
}

//! A motion step by step: what is attempted, accepted, sampled and reported.

use super::explicit::Explicit;
use super::flow::Flow;
use super::midpoint::Midpoint;
use super::{Algorithm, Effort, Forces, Method, Report, SimulationError, State, Steps, Tableau, Watch};
use eigenbody::Model;
use std::ops::ControlFlow;

/// A step below this part of the span is no progress.
const SMALLEST: f64 = 1e-14;

/// A motion as it is computed, step by step.
///
/// ```
/// use eigenbody::Family;
/// use eigenbody_study::simulate::{Algorithm, Forces, Method, RK4, Simulation, Steps};
/// let rod = Family::slender_chain(1, 1.0, 1.0)?.model::<f64>()?;
/// let mut simulation =
///     Simulation::new(&rod, &[0.0], &[0.0], Method::RungeKutta(RK4), Steps::Fixed(0.01), Forces::default(), Algorithm::Aba)?;
/// simulation.step(1.0)?;
/// assert_eq!(simulation.state().t, 0.01);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Simulation<'m> {
    flow: Flow<'m>,
    stepper: Stepper,
    /// None for fixed steps.
    tolerance: Option<f64>,
    /// Length of the next step, as far as is known.
    h: f64,
    start: State,
    now: State,
    /// θ at the end of the step.
    theta: Vec<f64>,
    effort: Effort,
}

#[derive(Debug)]
enum Stepper {
    Euler { vdot: Vec<f64> },
    Explicit(Box<Explicit>),
    Midpoint(Box<Midpoint>),
}

impl<'m> Simulation<'m> {
    /// At rest in time, at (q, v).
    ///
    /// Errors: [`SimulationError::Input`] if q, v or a force does not fit the model, [`SimulationError::Schedule`] for steps that the method
    /// cannot have, or mimic joints with the implicit midpoint rule.
    pub fn new(
        model: &'m Model<f64>,
        q: &[f64],
        v: &[f64],
        method: Method,
        steps: Steps,
        forces: Forces,
        algorithm: Algorithm,
    ) -> Result<Self, SimulationError> {
        model.check_q(q)?;
        model.check_v("v", v)?;
        let (h, tolerance) = match steps {
            Steps::Fixed(h) => (h, None),
            Steps::Adaptive(tolerance) => (1e-3, Some(tolerance)),
        };
        let is_positive = |x: f64| x > 0.0 && x.is_finite();
        if !is_positive(h) || tolerance.is_some_and(|tolerance| !is_positive(tolerance)) {
            return Err(SimulationError::Schedule("step and tolerance are positive numbers"));
        }
        let stepper = match method {
            Method::SemiImplicitEuler => Stepper::Euler { vdot: vec![0.0; model.nv()] },
            Method::RungeKutta(tableau) => {
                Stepper::Explicit(Box::new(Explicit::new(tableau, model.nq(), model.nv())))
            }
            Method::ImplicitMidpoint => Stepper::Midpoint(Box::new(Midpoint::new(model)?)),
        };
        let has_estimate = matches!(method, Method::RungeKutta(Tableau { error: Some(_), .. }));
        if tolerance.is_some() && !has_estimate {
            return Err(SimulationError::Schedule("this method has no error estimate: its steps are fixed"));
        }
        if method == Method::ImplicitMidpoint && algorithm != Algorithm::Aba {
            return Err(SimulationError::Schedule(
                "the implicit midpoint rule takes articulated bodies only",
            ));
        }
        let now = State { t: 0.0, q: q.to_vec(), v: v.to_vec() };
        Ok(Self {
            flow: Flow::new(model, forces, algorithm)?,
            stepper,
            tolerance,
            h,
            start: now.clone(),
            now,
            theta: vec![0.0; model.nv()],
            effort: Effort::default(),
        })
    }

    /// The state that was reached.
    pub fn state(&self) -> &State {
        &self.now
    }

    /// Start and end of the last step (s).
    pub fn last_step(&self) -> (f64, f64) {
        (self.start.t, self.now.t)
    }

    /// What was done so far.
    pub fn effort(&self) -> Effort {
        Effort { evaluations: self.flow.evaluations, ..self.effort }
    }

    /// One step, not beyond `limit` (s).
    ///
    /// Errors: [`SimulationError`]; the state is then the one before the step.
    pub fn step(&mut self, limit: f64) -> Result<(), SimulationError> {
        let t = self.now.t;
        loop {
            // A remainder that rounding leaves is no step of its own.
            let is_last = t + self.h * (1.0 + 1e-9) >= limit;
            let h = if is_last { limit - t } else { self.h };
            let error = self.attempt(t, h)?;
            if let (Some(tolerance), Some((error, dof))) = (self.tolerance, error) {
                let size = error / tolerance;
                let order = f64::from(self.order());
                let growth = (0.9 * size.max(1e-10).powf(-1.0 / order)).clamp(0.2, 5.0);
                let proposed = h * if size.is_nan() { 0.2 } else { growth };
                // A step that was cut says nothing against longer ones.
                self.h = if size <= 1.0 && is_last { self.h.max(proposed) } else { proposed };
                let is_within = size <= 1.0;
                if !is_within {
                    self.effort.refused += 1;
                    if self.h < SMALLEST * limit.abs() {
                        let joint = self.flow.model.dof_name(dof);
                        return Err(SimulationError::Stuck { t, joint, step_s: self.h });
                    }
                    continue;
                }
            }
            self.accept(if is_last { limit } else { t + h }, h);
            return Ok(());
        }
    }

    fn order(&self) -> u32 {
        match &self.stepper {
            Stepper::Euler { .. } => 1,
            Stepper::Explicit(explicit) => explicit.order(),
            Stepper::Midpoint(_) => 2,
        }
    }

    /// Error of the attempt, where there is an estimate, and the DoF that has most of it.
    fn attempt(&mut self, t: f64, h: f64) -> Result<Option<(f64, usize)>, SimulationError> {
        let Self { flow, stepper, now: State { q, v, .. }, .. } = self;
        match stepper {
            Stepper::Euler { vdot } => {
                flow.check(t, v, h)?;
                flow.accelerate(t, q, v, vdot)?;
                Ok(None)
            }
            Stepper::Explicit(explicit) => match explicit.attempt(flow, t, (q, v), h) {
                Ok(()) => Ok(explicit.error(h, v)),
                // A stage may go astray where a shorter step does not.
                Err(SimulationError::BlownUp { .. }) if self.tolerance.is_some() => Ok(Some((f64::NAN, 0))),
                Err(error) => Err(error),
            },
            Stepper::Midpoint(midpoint) => midpoint.attempt(flow, t, (q, v), h).map(|()| None),
        }
    }

    fn accept(&mut self, t: f64, h: f64) {
        std::mem::swap(&mut self.start, &mut self.now);
        let Self { flow, stepper, start, now, theta, .. } = self;
        match stepper {
            Stepper::Euler { vdot } => {
                for d in 0..theta.len() {
                    now.v[d] = start.v[d] + h * vdot[d];
                    theta[d] = h * now.v[d];
                }
            }
            Stepper::Explicit(explicit) => {
                explicit.end(h, &start.v, theta, &mut now.v);
                explicit.accept();
            }
            Stepper::Midpoint(midpoint) => {
                now.v.copy_from_slice(&midpoint.v1);
                theta.iter_mut().zip(midpoint.xi()).for_each(|(theta, xi)| *theta = h * xi);
                midpoint.accept();
            }
        }
        flow.model.integrate_into(&start.q, theta, &mut now.q);
        unit_quaternions(flow.model, &mut now.q);
        now.t = t;
        self.effort.steps += 1;
    }

    /// The state within the last step: by the method's own interpolant, or along its constant velocity.
    pub fn at(&self, t: f64, out: &mut State) {
        let Self { flow, stepper, start, now, theta, .. } = self;
        let h = now.t - start.t;
        let s = if h > 0.0 { (t - start.t) / h } else { 1.0 };
        out.t = t;
        if s >= 1.0 {
            out.q.copy_from_slice(&now.q);
            out.v.copy_from_slice(&now.v);
            return;
        }
        let mut within = vec![0.0; theta.len()];
        match stepper {
            Stepper::Explicit(explicit) => explicit.at(s, h, &start.v, &mut within, &mut out.v),
            _ => {
                for d in 0..theta.len() {
                    within[d] = s * theta[d];
                    out.v[d] = start.v[d] + s * (now.v[d] - start.v[d]);
                }
            }
        }
        flow.model.integrate_into(&start.q, &within, &mut out.q);
    }

    /// Runs for `span_s`, with samples at equal intervals, the start included, and events as they happen, in the order of time.
    ///
    /// Ends early where `report` breaks. Errors: [`SimulationError`]; what was reported stands, up to the last good step.
    pub fn run(
        &mut self,
        span_s: f64,
        intervals: usize,
        watches: &mut [Watch<'_>],
        report: &mut dyn FnMut(Report<'_>) -> ControlFlow<()>,
    ) -> Result<ControlFlow<()>, SimulationError> {
        if !(span_s > 0.0 && span_s.is_finite()) {
            return Err(SimulationError::Schedule("the span is a positive number of seconds"));
        }
        if intervals == 0 {
            return Err(SimulationError::Schedule("at least one interval"));
        }
        let interval = span_s / intervals as f64;
        let begin = self.now.t;
        let (end, time) = (begin + span_s, |k: usize| begin + k as f64 * interval);
        if self.tolerance.is_none() {
            // Steps of one length that end on samples, or with the span.
            let whole = if self.h <= interval * (1.0 + 1e-9) { interval } else { span_s };
            self.h = whole / (whole / self.h * (1.0 - 1e-9)).ceil().max(1.0);
        } else {
            self.h = self.h.min(interval);
        }
        let mut room = self.now.clone();
        for event in watches.iter_mut().filter_map(|watch| watch.begin(&self.now)).collect::<Vec<_>>() {
            if report(Report::Event(event)).is_break() {
                return Ok(ControlFlow::Break(()));
            }
        }
        if report(Report::Sample(&self.now)).is_break() {
            return Ok(ControlFlow::Break(()));
        }
        let mut next = 1;
        while next <= intervals {
            let limit = if self.tolerance.is_none() && self.h <= interval { time(next) } else { end };
            self.step(if next == intervals { end } else { limit })?;
            if report(Report::Step).is_break() {
                return Ok(ControlFlow::Break(()));
            }
            let mut events = Vec::new();
            for watch in watches.iter_mut() {
                events.extend(watch.after(self, &mut room)?);
            }
            events.sort_by(|a, b| a.t.total_cmp(&b.t));
            let mut events = events.into_iter().peekable();
            loop {
                let at = if next == intervals { end } else { time(next) };
                let is_due = next <= intervals && at <= self.now.t;
                if let Some(event) = events.next_if(|event| !is_due || event.t <= at) {
                    if report(Report::Event(event)).is_break() {
                        return Ok(ControlFlow::Break(()));
                    }
                } else if is_due {
                    self.at(at, &mut room);
                    next += 1;
                    if report(Report::Sample(&room)).is_break() {
                        return Ok(ControlFlow::Break(()));
                    }
                } else {
                    break;
                }
            }
        }
        Ok(ControlFlow::Continue(()))
    }
}

/// Takes the last digits' drift off unit quaternions.
fn unit_quaternions(model: &Model<f64>, q: &mut [f64]) {
    for joint in model.joints() {
        let Some(at) = joint.kind().quaternion() else { continue };
        let first = joint.coordinates().start + at;
        let norm = q[first..first + 4].iter().map(|x| x * x).sum::<f64>().sqrt();
        q[first..first + 4].iter_mut().for_each(|x| *x /= norm);
    }
}

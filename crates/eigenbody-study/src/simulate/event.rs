//! What happens on the way: a function of the motion changes its sign.

use super::{Simulation, SimulationError, State};
use eigenbody::Model;

/// A function to be watched. An event is where it changes its sign.
pub struct Watch<'a> {
    /// What happens there, as in "κ rises above 1e5".
    pub rises: String,
    /// What is so where it is positive from the start, as in "κ is above 1e5".
    pub is_above: String,
    /// What happens where it falls.
    pub falls: String,
    function: Box<dyn FnMut(&State) -> f64 + 'a>,
    last: f64,
}

impl std::fmt::Debug for Watch<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Watch").field("rises", &self.rises).finish_non_exhaustive()
    }
}

/// Something that happened.
#[derive(Debug, Clone, PartialEq)]
pub struct Event {
    /// When (s).
    pub t: f64,
    /// What.
    pub what: String,
}

impl<'a> Watch<'a> {
    /// Watches a function of the motion for changes of sign: what happens where it rises above zero and falls below, and what is so where
    /// it is above from the start.
    pub fn new(
        rises: impl Into<String>,
        falls: impl Into<String>,
        is_above: impl Into<String>,
        function: impl FnMut(&State) -> f64 + 'a,
    ) -> Self {
        Self {
            rises: rises.into(),
            falls: falls.into(),
            is_above: is_above.into(),
            function: Box::new(function),
            last: f64::NAN,
        }
    }

    /// Takes note of the start; an event if the function is positive there already.
    pub(super) fn begin(&mut self, state: &State) -> Option<Event> {
        self.last = (self.function)(state);
        (self.last > 0.0).then(|| Event { t: state.t, what: self.is_above.clone() })
    }

    /// The event within the last step, if the function has changed its sign there: by bisection on the interpolated motion, to 1e-12 of
    /// the step. A function that changes it twice within a step is not noticed.
    pub(super) fn after(
        &mut self,
        simulation: &Simulation<'_>,
        room: &mut State,
    ) -> Result<Option<Event>, SimulationError> {
        let end = (self.function)(simulation.state());
        let rises = end > 0.0;
        let changes = end.is_finite() && self.last.is_finite() && rises != (self.last > 0.0);
        self.last = end;
        if !changes {
            return Ok(None);
        }
        let (mut before, mut after) = simulation.last_step();
        for _ in 0..40 {
            let middle = 0.5 * (before + after);
            simulation.at(middle, room);
            if ((self.function)(room) > 0.0) == rises {
                after = middle;
            } else {
                before = middle;
            }
        }
        let what = if rises { &self.rises } else { &self.falls };
        Ok(Some(Event { t: after, what: what.clone() }))
    }
}

/// Watches for every limit of every joint.
pub fn joint_limits<'a>(model: &Model<f64>) -> Vec<Watch<'a>> {
    let mut watches = Vec::new();
    for joint in model.joints() {
        let Some((lower, upper)) = joint.limits().filter(|_| joint.kind().is_linear()) else { continue };
        for k in joint.coordinates() {
            let (name, verbs) = (joint.name(), ["passes", "returns within", "is beyond"]);
            let words =
                |side: &str, limit: f64, verb: &str| format!("'{name}' {verb} its {side} limit {limit}");
            if upper.is_finite() {
                let [rises, falls, is] = verbs.map(|verb| words("upper", upper, verb));
                watches.push(Watch::new(rises, falls, is, move |state| state.q[k] - upper));
            }
            if lower.is_finite() {
                let [rises, falls, is] = verbs.map(|verb| words("lower", lower, verb));
                watches.push(Watch::new(rises, falls, is, move |state| lower - state.q[k]));
            }
        }
    }
    watches
}

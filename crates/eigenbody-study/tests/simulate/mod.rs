mod energy;
mod event;
mod force;
mod manifold;
mod method;
mod reference;

use eigenbody::{Family, Model};
use eigenbody_study::simulate::{DORMAND_PRINCE, Method, Schedule, State, Steps, simulate};

pub fn chain(n: usize) -> Model<f64> {
    Family::slender_chain(n, 2.2, 1.0).unwrap().model().unwrap()
}

pub fn run(model: &Model<f64>, schedule: &Schedule) -> Vec<State> {
    simulate(model, &vec![0.3; model.nq()], &vec![0.0; model.nv()], schedule).unwrap()
}

pub const SECOND: Schedule = Schedule {
    method: Method::RungeKutta(DORMAND_PRINCE),
    steps: Steps::Adaptive(1e-10),
    span_s: 1.0,
    intervals: 10,
};

/// Configurations by the motion between them, velocities by their difference: the largest entry.
pub fn apart(model: &Model<f64>, a: &State, b: &State) -> f64 {
    let way = model.difference(&a.q, &b.q).unwrap();
    let velocities = a.v.iter().zip(&b.v).map(|(a, b)| a - b);
    way.into_iter().chain(velocities).fold(0.0, |worst, x| worst.max(x.abs()))
}

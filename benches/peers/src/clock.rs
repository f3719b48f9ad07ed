//! Medians of alternating runs: what the machine does besides falls on all alike.

use std::time::Instant;

/// Rounds over all measurements.
const ROUNDS: usize = 5;
/// Calls are repeated until they take so long together (s).
const LONG_ENOUGH: f64 = 2e-3;

/// What is to be timed.
#[derive(Default)]
pub struct Clock<'a> {
    measurements: Vec<Measurement<'a>>,
}

struct Measurement<'a> {
    name: String,
    /// Returns a number so that its work is not optimised away.
    call: Box<dyn Fn() -> usize + 'a>,
    seconds: Vec<f64>,
}

impl<'a> Clock<'a> {
    /// One more call to time.
    pub fn add(&mut self, name: String, call: impl Fn() -> usize + 'a) {
        self.measurements.push(Measurement { name, call: Box::new(call), seconds: Vec::new() });
    }

    /// Times every call in turn, several rounds, and prints the median of each in seconds.
    pub fn run(mut self) {
        for _ in 0..ROUNDS {
            for Measurement { call, seconds, .. } in &mut self.measurements {
                let (start, mut calls) = (Instant::now(), 0);
                while calls == 0 || start.elapsed().as_secs_f64() < LONG_ENOUGH {
                    std::hint::black_box(call());
                    calls += 1;
                }
                seconds.push(start.elapsed().as_secs_f64() / f64::from(calls));
            }
        }
        for Measurement { name, mut seconds, .. } in self.measurements {
            seconds.sort_by(f64::total_cmp);
            println!("{name}\t{:e}", seconds[ROUNDS / 2]);
        }
    }
}

//! Both ends of the spectrum along a motion: the tracker beside H and all its eigenvalues.

use crate::clock::Clock;
use eigenbody::dynamics::{CrbaWorkspace, mass_matrix_into};
use eigenbody::spectrum::Tracker;
use eigenbody::{Family, Matrix, Metric, Model, forward_dynamics};
use std::cell::RefCell;
use std::error::Error;
use std::hint::black_box;

/// Degrees of freedom, and rows of the motion.
const SIZES: [(usize, usize); 4] = [(7, 200), (35, 200), (100, 100), (1000, 30)];
/// Skew angles of successive axes: planar, and not.
const SKEWS: [f64; 2] = [0.0, 0.5];
/// Time from row to row (s).
const STEP: f64 = 1e-3;

/// hydra(n, 1, α, 1), let go and sampled every millisecond.
struct Swing {
    name: String,
    model: Model<f64>,
    rows: Vec<Vec<f64>>,
}

/// Every size and skew.
fn all() -> Result<Vec<Swing>, Box<dyn Error>> {
    let mut swings = Vec::new();
    for skew in SKEWS {
        for (n, rows) in SIZES {
            swings.push(Swing::new(n, skew, rows)?);
        }
    }
    Ok(swings)
}

/// Times every swing.
pub fn time() -> Result<(), Box<dyn Error>> {
    let swings = all()?;
    let mut clock = Clock::default();
    for swing in &swings {
        swing.add(&mut clock)?;
    }
    clock.run();
    Ok(())
}

/// Configurations, and both ends at the last of them, for other programs to read.
pub fn write(directory: &str) -> Result<(), Box<dyn Error>> {
    std::fs::create_dir_all(directory)?;
    for swing in all()? {
        let bytes: Vec<u8> = swing.rows.iter().flatten().flat_map(|x| x.to_le_bytes()).collect();
        std::fs::write(format!("{directory}/swing-{}.f64", swing.name), bytes)?;
        let last = swing.rows.last().ok_or("no rows")?;
        let mut tracker = Tracker::new(&swing.model, last, &Metric::Euclidean, false)?;
        let [min, max] = tracker.update(last)?.map(|end| end.value);
        std::fs::write(format!("{directory}/swing-{}.ends", swing.name), format!("{min:e} {max:e}\n"))?;
    }
    Ok(())
}

impl Swing {
    fn new(n: usize, skew: f64, rows: usize) -> Result<Self, Box<dyn Error>> {
        let model: Model<f64> = Family::hydra(n, 1.0, skew, 1.0)?.model()?;
        let (mut q, mut v, tau) = (vec![0.0; n], vec![0.0; n], vec![0.0; n]);
        q[0] = -0.5;
        let mut seen = Vec::new();
        for _ in 0..rows {
            let vdot = forward_dynamics(&model, &q, &v, &tau)?;
            for d in 0..n {
                v[d] += STEP * vdot[d];
                q[d] += STEP * v[d];
            }
            seen.push(q.clone());
        }
        Ok(Self { name: format!("{skew}-{n}"), model, rows: seen })
    }

    /// One step of the tracker, and H with its eigenvalues, each to and fro along the motion.
    fn add<'a>(&'a self, clock: &mut Clock<'a>) -> Result<(), Box<dyn Error>> {
        let tracker = RefCell::new(Tracker::new(&self.model, &self.rows[0], &Metric::Euclidean, false)?);
        let turn = RefCell::new(Turn::default());
        clock.add(format!("track {}", self.name), move || {
            let q = &self.rows[turn.borrow_mut().next(self.rows.len())];
            let ends = tracker.borrow_mut().update(black_box(q)).expect("q fits");
            ends[0].factorisations
        });
        let n = self.model.nv();
        let room = RefCell::new((CrbaWorkspace::new(&self.model), Matrix::zeros(n, n), Turn::default()));
        clock.add(format!("dense {}", self.name), move || {
            let (workspace, H, turn) = &mut *room.borrow_mut();
            let q = &self.rows[turn.next(self.rows.len())];
            mass_matrix_into(&self.model, black_box(q), workspace, H).expect("q fits");
            crate::dense::faer_eigenvalues(&crate::dense::dense(H), faer::Par::Seq).len()
        });
        Ok(())
    }
}

/// Places 0, 1, .., n − 1, n − 2, .., 0, 1, ..
#[derive(Default)]
struct Turn {
    at: usize,
    is_back: bool,
}

impl Turn {
    fn next(&mut self, n: usize) -> usize {
        if self.at == 0 {
            self.is_back = false;
        } else if self.at + 1 == n {
            self.is_back = true;
        }
        self.at = if self.is_back { self.at - 1 } else { self.at + 1 };
        self.at
    }
}

//! Springs and dampers at the joints.
//!
//! ```text
//! l = Σ a_d q_d        τ_d = −a_d (k l + c l̇)        K = Σ k a aᵀ,  D = Σ c a aᵀ
//! ```

use crate::dynamics::Reduction;
use crate::error::{Error, InputError, check_length};
use crate::matrix::Matrix;
use crate::model::{Model, check};
use crate::spectrum::eigenvalues;

/// What a spring is part of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum SpringSource {
    /// A joint's own stiffness and damping.
    Joint,
    /// A tendon's.
    Tendon,
    /// An actuator's feedback: kp and kv.
    Actuator,
}

/// A linear spring and damper along a combination of degrees of freedom.
#[derive(Debug, Clone, PartialEq)]
pub struct Spring {
    /// What it is called.
    pub name: String,
    /// What it is part of.
    pub source: SpringSource,
    /// DoF of the model and moment arm: l̇ = Σ a_d v_d.
    pub arms: Vec<(usize, f64)>,
    /// k (N m/rad, N/m).
    pub stiffness: f64,
    /// c (N m s/rad, N s/m).
    pub damping: f64,
}

/// Stiffness and damping of all springs together, in the degrees of freedom of a study.
#[derive(Debug, Clone, PartialEq)]
pub struct Impedance {
    /// K.
    pub stiffness: Matrix<f64>,
    /// D.
    pub damping: Matrix<f64>,
    /// The part of D that joints have of their own.
    pub joint_damping: Matrix<f64>,
}

impl Impedance {
    /// One spring and one damper of its own for each degree of freedom, as actuators have them.
    ///
    /// Errors: [`InputError::Length`] if there are not as many dampers as springs, [`InputError::NotFinite`].
    pub fn diagonal(stiffness: &[f64], damping: &[f64]) -> Result<Self, InputError> {
        let n = stiffness.len();
        check("stiffness", stiffness, n)?;
        check("damping", damping, n)?;
        let of = |x: &[f64]| Matrix::from_fn(n, n, |i, j| if i == j { x[i] } else { 0.0 });
        Ok(Self { stiffness: of(stiffness), damping: of(damping), joint_damping: Matrix::zeros(n, n) })
    }

    /// That of some springs on a model, mimic joints folded in and the base left out as the study has them.
    ///
    /// ```text
    /// K = Σ k (Gᵀa)(Gᵀa)ᵀ
    /// ```
    /// A removed base is free: what pulls on it pulls on nothing, and its arms are passed over.
    ///
    /// Errors: [`InputError::NoSuch`] for an arm on a degree of freedom that the model does not have; [`InputError::NotFinite`],
    /// which tells the spring's position among `springs`.
    pub fn new(model: &Model<f64>, reduction: Reduction, springs: &[Spring]) -> Result<Self, InputError> {
        let removed = if reduction.base { model.base_dofs() } else { 0 };
        let n = reduction.dofs(model).len();
        let zero = || Matrix::zeros(n, n);
        let mut all = Self { stiffness: zero(), damping: zero(), joint_damping: zero() };
        for (index, spring) in springs.iter().enumerate() {
            spring.check(model.nv(), index)?;
            let mut a = vec![0.0; model.nv()];
            spring.arms.iter().for_each(|&(d, arm)| a[d] += arm);
            if let Some(coupling) = model.coupling().filter(|_| reduction.mimic) {
                a = coupling.pull_back(&a);
            }
            let a = &a[removed..];
            add(&mut all.stiffness, spring.stiffness, a);
            add(&mut all.damping, spring.damping, a);
            if spring.source == SpringSource::Joint {
                add(&mut all.joint_damping, spring.damping, a);
            }
        }
        Ok(all)
    }

    /// Refuses matrices that are not n × n, or have a number that is not finite.
    pub(super) fn check(&self, n: usize) -> Result<(), InputError> {
        square("stiffness", &self.stiffness, n)?;
        square("damping", &self.damping, n)?;
        square("damping of joints", &self.joint_damping, n)
    }

    /// Number of degrees of freedom.
    pub fn len(&self) -> usize {
        self.stiffness.rows()
    }

    /// True without degrees of freedom.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// True if neither springs nor dampers give energy away: K, D ≥ 0 to within rounding.
    ///
    /// Errors: as [`eigenvalues`].
    pub fn is_passive(&self) -> Result<bool, Error> {
        for A in [&self.stiffness, &self.damping] {
            let values = eigenvalues(A, &vec![1.0; self.len()])?;
            let ends = values.first().zip(values.last());
            if ends.is_some_and(|(least, most)| *least < -1e-10 * most.abs().max(least.abs())) {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// True if nothing pulls anywhere.
    pub fn is_zero(&self) -> bool {
        self.stiffness.max_abs() == 0.0 && self.damping.max_abs() == 0.0
    }
}

impl Spring {
    /// Refuses what does not fit a model of nv degrees of freedom; `index` is the spring's position among several.
    pub fn check(&self, nv: usize, index: usize) -> Result<(), InputError> {
        if let Some(&(d, _)) = self.arms.iter().find(|(d, _)| *d >= nv) {
            return Err(InputError::NoSuch { what: "degree of freedom", index: d, count: nv });
        }
        let what = match () {
            () if !self.stiffness.is_finite() => "stiffness of springs",
            () if !self.damping.is_finite() => "damping of springs",
            () if self.arms.iter().any(|(_, arm)| !arm.is_finite()) => "arms of springs",
            () => return Ok(()),
        };
        Err(InputError::NotFinite { what, index })
    }
}

/// Refuses a matrix that is not n × n, or has a number that is not finite.
pub(super) fn square(what: &'static str, A: &Matrix<f64>, n: usize) -> Result<(), InputError> {
    check_length(what, A.rows(), n)?;
    check_length(what, A.cols(), n)?;
    check(what, A.as_slice(), n * n)
}

/// A += w a aᵀ.
fn add(A: &mut Matrix<f64>, w: f64, a: &[f64]) {
    let held: Vec<usize> = (0..a.len()).filter(|&d| a[d] != 0.0).collect();
    for &d in &held {
        for &e in &held {
            A[(d, e)] += w * a[d] * a[e];
        }
    }
}

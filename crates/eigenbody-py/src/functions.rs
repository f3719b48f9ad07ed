//! What a `Model` computes.

use crate::error::Failure;
use crate::given::{At, Gains, Table};
use crate::model::Model;
use crate::{dynamics, simulate, spectrum, study};
use pyo3::prelude::*;
use pyo3::types::PyDict;

#[pymethods]
impl Model {
    /// H(q): (n, n) or (k, n, n), both triangles; by composite rigid bodies.
    #[pyo3(signature = (q, /, *, out=None))]
    fn mass_matrix<'py>(
        &self,
        q: &Bound<'py, PyAny>,
        out: Option<&Bound<'py, PyAny>>,
    ) -> Result<Bound<'py, PyAny>, Failure> {
        dynamics::mass_matrix(self, q, out)
    }

    /// `mass_matrix`.
    #[pyo3(signature = (q, /, *, out=None))]
    fn crba<'py>(
        &self,
        q: &Bound<'py, PyAny>,
        out: Option<&Bound<'py, PyAny>>,
    ) -> Result<Bound<'py, PyAny>, Failure> {
        dynamics::mass_matrix(self, q, out)
    }

    /// τ = H a + C: (nv,) or (k, nv); by recursive Newton-Euler. Where mimic joints follow, of the independent ones: Gᵀ (H G a + C).
    #[pyo3(signature = (q, v, a, /, *, out=None))]
    fn inverse_dynamics<'py>(
        &self,
        q: &Bound<'py, PyAny>,
        v: &Bound<'py, PyAny>,
        a: &Bound<'py, PyAny>,
        out: Option<&Bound<'py, PyAny>>,
    ) -> Result<Bound<'py, PyAny>, Failure> {
        dynamics::inverse_dynamics(self, q, v, a, out)
    }

    /// `inverse_dynamics`.
    #[pyo3(signature = (q, v, a, /, *, out=None))]
    fn rnea<'py>(
        &self,
        q: &Bound<'py, PyAny>,
        v: &Bound<'py, PyAny>,
        a: &Bound<'py, PyAny>,
        out: Option<&Bound<'py, PyAny>>,
    ) -> Result<Bound<'py, PyAny>, Failure> {
        dynamics::inverse_dynamics(self, q, v, a, out)
    }

    /// a = H⁻¹ (τ − C): (nv,) or (k, nv); by articulated bodies. Where mimic joints follow, (GᵀHG)⁻¹ (τ − GᵀC), by Cholesky.
    #[pyo3(signature = (q, v, tau, /, *, out=None))]
    fn forward_dynamics<'py>(
        &self,
        q: &Bound<'py, PyAny>,
        v: &Bound<'py, PyAny>,
        tau: &Bound<'py, PyAny>,
        out: Option<&Bound<'py, PyAny>>,
    ) -> Result<Bound<'py, PyAny>, Failure> {
        dynamics::forward_dynamics(self, q, v, tau, out)
    }

    /// `forward_dynamics`.
    #[pyo3(signature = (q, v, tau, /, *, out=None))]
    fn aba<'py>(
        &self,
        q: &Bound<'py, PyAny>,
        v: &Bound<'py, PyAny>,
        tau: &Bound<'py, PyAny>,
        out: Option<&Bound<'py, PyAny>>,
    ) -> Result<Bound<'py, PyAny>, Failure> {
        dynamics::forward_dynamics(self, q, v, tau, out)
    }

    /// C(q, v): gravity, Coriolis and centrifugal forces; (nv,) or (k, nv).
    #[pyo3(signature = (q, v, /, *, out=None))]
    fn bias_force<'py>(
        &self,
        q: &Bound<'py, PyAny>,
        v: &Bound<'py, PyAny>,
        out: Option<&Bound<'py, PyAny>>,
    ) -> Result<Bound<'py, PyAny>, Failure> {
        dynamics::bias_force(self, q, v, out)
    }

    /// C(q, 0): (nv,) or (k, nv).
    #[pyo3(signature = (q, /, *, out=None))]
    fn gravity_force<'py>(
        &self,
        q: &Bound<'py, PyAny>,
        out: Option<&Bound<'py, PyAny>>,
    ) -> Result<Bound<'py, PyAny>, Failure> {
        dynamics::gravity_force(self, q, out)
    }

    /// All eigenvalues of H x = λ B x, ascending: (n,) or (k, n).
    #[pyo3(signature = (q, /, *, metric="euclidean", out=None))]
    fn spectrum<'py>(
        &self,
        q: &Bound<'py, PyAny>,
        metric: &str,
        out: Option<&Bound<'py, PyAny>>,
    ) -> Result<Bound<'py, PyAny>, Failure> {
        spectrum::eigenvalues(self, q, metric, out)
    }

    /// λmin and λmax: (2,) or (k, 2); NaN where λmin cannot be told from zero.
    ///
    /// Rows of a batch are computed side by side, λmin to a relative `accuracy`; 0 computes each as if it were alone, digit for
    /// digit, at several times the cost.
    #[pyo3(signature = (q, /, *, metric="euclidean", accuracy=1e-8, out=None))]
    fn extremes<'py>(
        &self,
        q: &Bound<'py, PyAny>,
        metric: &str,
        accuracy: f64,
        out: Option<&Bound<'py, PyAny>>,
    ) -> Result<Bound<'py, PyAny>, Failure> {
        spectrum::extremes(self, q, metric, accuracy, out)
    }

    /// κ: a number, or (k,); with ``metric="unit-diagonal"`` κ′. NaN where λmin cannot be told from zero. `accuracy`: see `extremes`.
    #[pyo3(signature = (q, /, *, metric="euclidean", accuracy=1e-8, out=None))]
    fn kappa<'py>(
        &self,
        q: &Bound<'py, PyAny>,
        metric: &str,
        accuracy: f64,
        out: Option<&Bound<'py, PyAny>>,
    ) -> Result<Bound<'py, PyAny>, Failure> {
        spectrum::kappa(self, q, metric, accuracy, out)
    }

    /// κ, κ′, bracket and modes: a `Conditioning`, or `Conditionings` of a batch. None: zero. `all`: all eigenvalues too.
    #[pyo3(signature = (q=None, /, *, metric="euclidean", method="auto", precision="auto", all=false))]
    fn conditioning<'py>(
        &self,
        py: Python<'py>,
        q: Option<At<'py>>,
        metric: &str,
        method: &str,
        precision: &str,
        all: bool,
    ) -> Result<Bound<'py, PyAny>, Failure> {
        spectrum::conditioning(
            self,
            py,
            &q.unwrap_or_default(),
            &spectrum::Asked { metric, method, precision, all },
        )
    }

    /// What is wrong over all that the joints allow: as `eigenbody check`, whose options these are; `step` is its `--dt`.
    ///
    /// `kp`, `kd`: gains in place of those of the file's actuators. One of the `want_` options asks for advice: the least armature
    /// with which κ is at most, λmin at least, or a step stable everywhere. `baseline`: an earlier `Diagnosis`, or its JSON.
    #[pyo3(signature = (*, metric="euclidean", samples=2048, seed=1, max_kappa_weighted=None, max_kappa=None, f32_digits=None,
        kp=None, kd=None, step=None, integrator=None, want_kappa=None, want_lambda_min=None, want_step=None, baseline=None))]
    #[allow(clippy::too_many_arguments)] // each a named option in Python
    fn check<'py>(
        &self,
        py: Python<'py>,
        metric: &str,
        samples: u32,
        seed: u32,
        max_kappa_weighted: Option<f64>,
        max_kappa: Option<f64>,
        f32_digits: Option<f64>,
        kp: Option<Gains<'py>>,
        kd: Option<Gains<'py>>,
        step: Option<f64>,
        integrator: Option<String>,
        want_kappa: Option<f64>,
        want_lambda_min: Option<f64>,
        want_step: Option<f64>,
        baseline: Option<Bound<'py, PyAny>>,
    ) -> Result<Bound<'py, PyAny>, Failure> {
        let look = study::Look {
            metric,
            effort: (samples, seed),
            limits: [max_kappa_weighted, max_kappa, f32_digits],
            gains: [kp, kd],
            step,
            integrator,
            wants: [want_kappa, want_lambda_min, want_step],
            baseline,
        };
        study::check(self, py, &look)
    }

    /// Moves for `time` seconds from (q, v) and gives `rate` rows a second: as `eigenbody simulate`, whose options these are.
    ///
    /// `method`: "dopri5" (if left out) takes steps by its `tolerance`, the others fixed ones of `step` seconds. `springs`: those of
    /// the file; `damping` and `stiffness` add more, slack at `rest`. A controller pulls to the posture `hold` or along `follow`,
    /// with gains for `bandwidth` (Hz) and `damping_ratio`, or `kp` and `kd`. `torque`: forces over time. `monitors`: kappa,
    /// kappa_weighted (these if left out), lambda_min, lambda_max, modes, diagonal_ratio, scaled_diagonal_ratio, pivot_ratio,
    /// bracket, eigenvalues, energy, momentum. `events`: crossings to report, as "kappa=1e5". Ctrl-C is heard.
    #[pyo3(signature = (time=10.0, *, rate=100.0, q=None, v=None, method="dopri5".to_owned(), step=1e-3, tolerance=1e-9,
        dynamics="aba".to_owned(), gravity=true, springs=true, damping=None, stiffness=None, rest=None, hold=None, follow=None,
        bandwidth=2.0, damping_ratio=1.0, kp=None, kd=None, torque=None,
        monitors=vec!["kappa".to_owned(), "kappa_weighted".to_owned()], events=Vec::new()))]
    #[allow(clippy::too_many_arguments)] // each a named option in Python
    fn simulate<'py>(
        &self,
        py: Python<'py>,
        time: f64,
        rate: f64,
        q: Option<At<'py>>,
        v: Option<At<'py>>,
        method: String,
        step: f64,
        tolerance: f64,
        dynamics: String,
        gravity: bool,
        springs: bool,
        damping: Option<Gains<'py>>,
        stiffness: Option<Gains<'py>>,
        rest: Option<At<'py>>,
        hold: Option<At<'py>>,
        follow: Option<Table<'py>>,
        bandwidth: f64,
        damping_ratio: f64,
        kp: Option<Gains<'py>>,
        kd: Option<Gains<'py>>,
        torque: Option<Table<'py>>,
        monitors: Vec<String>,
        events: Vec<String>,
    ) -> Result<Bound<'py, PyAny>, Failure> {
        let asked = simulate::Asked {
            time,
            rate,
            q,
            v,
            method,
            step,
            tolerance,
            dynamics,
            gravity,
            springs,
            damping,
            stiffness,
            rest,
            hold,
            follow,
            bandwidth,
            damping_ratio,
            kp,
            kd,
            torque,
            monitors,
            events,
        };
        simulate::simulate(self, py, &asked)
    }

    /// The worst configuration by `kappa`, `kappa_weighted` and `lambda_min`.
    #[pyo3(signature = (*, metric="euclidean", samples=2048, seed=1))]
    fn worst_case<'py>(
        &self,
        py: Python<'py>,
        metric: &str,
        samples: u32,
        seed: u32,
    ) -> Result<Bound<'py, PyDict>, Failure> {
        study::worst_case(self, py, metric, (samples, seed))
    }

    fn _repr_html_(slf: &Bound<'_, Self>) -> PyResult<String> {
        slf.py().import("eigenbody._results")?.call_method1("model_html", (slf,))?.extract()
    }
}

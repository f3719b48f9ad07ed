//! What a `Model` computes.

use crate::error::Failure;
use crate::given::{At, Gains, Table};
use crate::model::Model;
use crate::{dynamics, simulate, spectrum, study};
use pyo3::prelude::*;
use pyo3::types::PyDict;

#[pymethods]
impl Model {
    #[pyo3(signature = (q, /, *, out=None))]
    fn mass_matrix<'py>(
        &self,
        q: &Bound<'py, PyAny>,
        out: Option<&Bound<'py, PyAny>>,
    ) -> Result<Bound<'py, PyAny>, Failure> {
        dynamics::mass_matrix(self, q, out)
    }

    #[pyo3(signature = (q, /, *, out=None))]
    fn crba<'py>(
        &self,
        q: &Bound<'py, PyAny>,
        out: Option<&Bound<'py, PyAny>>,
    ) -> Result<Bound<'py, PyAny>, Failure> {
        dynamics::mass_matrix(self, q, out)
    }

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

    #[pyo3(signature = (q, v, /, *, out=None))]
    fn bias_force<'py>(
        &self,
        q: &Bound<'py, PyAny>,
        v: &Bound<'py, PyAny>,
        out: Option<&Bound<'py, PyAny>>,
    ) -> Result<Bound<'py, PyAny>, Failure> {
        dynamics::bias_force(self, q, v, out)
    }

    #[pyo3(signature = (q, /, *, out=None))]
    fn gravity_force<'py>(
        &self,
        q: &Bound<'py, PyAny>,
        out: Option<&Bound<'py, PyAny>>,
    ) -> Result<Bound<'py, PyAny>, Failure> {
        dynamics::gravity_force(self, q, out)
    }

    #[pyo3(signature = (q, /, *, metric="euclidean", out=None))]
    fn spectrum<'py>(
        &self,
        q: &Bound<'py, PyAny>,
        metric: &str,
        out: Option<&Bound<'py, PyAny>>,
    ) -> Result<Bound<'py, PyAny>, Failure> {
        spectrum::eigenvalues(self, q, metric, out)
    }

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

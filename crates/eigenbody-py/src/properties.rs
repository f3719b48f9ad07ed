//! What a `Model` is: names, limits, configurations, copies with something changed.

use crate::array::Out;
use crate::compute::go_on;
use crate::error::Failure;
use crate::model::{Model, Shared};
use eigenbody_formats::{Loaded, patched, write_mjcf, write_urdf, write_urdf_with_rotors};
use numpy::{PyArray1, PyArray2};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use rayon::prelude::*;

#[pymethods]
impl Model {
    fn __repr__(&self) -> String {
        let Shared { name, nq, nv, dofs, robot, .. } = &*self.shared;
        let base = match (robot.model.has_floating_base(), robot.reduction.base) {
            (false, _) => "fixed",
            (true, false) => "floating",
            (true, true) => "free-floating",
        };
        let bodies = robot.model.bodies().len();
        let rows = if dofs.len() == *nv { String::new() } else { format!(", H {0} × {0}", dofs.len()) };
        format!("<eigenbody.Model '{name}': {bodies} bodies, {base} base, nq {nq}, nv {nv}{rows}>")
    }

    /// What it was made of.
    #[getter]
    fn name(&self) -> &str {
        &self.shared.name
    }

    /// Numbers in q.
    #[getter]
    fn nq(&self) -> usize {
        self.shared.nq
    }

    /// Degrees of freedom: numbers in v.
    #[getter]
    fn nv(&self) -> usize {
        self.shared.nv
    }

    /// Moving bodies.
    #[getter]
    fn nbodies(&self) -> usize {
        self.shared.robot.model.bodies().len()
    }

    /// The first joint is a floating base.
    #[getter]
    fn has_floating_base(&self) -> bool {
        self.shared.robot.model.has_floating_base()
    }

    /// One name a row of H.
    #[getter]
    fn dof_names(&self) -> Vec<String> {
        self.shared.dofs.clone()
    }

    /// All links, merged ones included.
    #[getter]
    fn link_names(&self) -> Vec<String> {
        self.shared.robot.model.links().iter().map(|link| link.name().to_owned()).collect()
    }

    /// Name, kind, first coordinate and first degree of freedom of every moving joint, among all of them.
    #[getter]
    fn joints(&self) -> Vec<(String, &'static str, usize, usize)> {
        let joint = |joint: &eigenbody::model::JointInfo<f64>| {
            (joint.name().to_owned(), joint.kind().kind(), joint.coordinates().start, joint.dofs().start)
        };
        self.shared.robot.model.joints().iter().map(joint).collect()
    }

    /// (2, nq): lower and upper limits, infinite where there is none.
    #[getter]
    fn limits<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        let model = &self.shared.robot.model;
        let mut ends = vec![[f64::NEG_INFINITY, f64::INFINITY]; model.nq()];
        for joint in model.joints() {
            if let (Some((lower, upper)), 1) = (joint.limits(), joint.kind().nq()) {
                ends[joint.coordinates().start] = [lower, upper];
            }
        }
        let columns =
            [0, 1].map(|end| self.shared.given(&ends.iter().map(|pair| pair[end]).collect::<Vec<_>>()));
        PyArray2::from_vec2(py, &columns).unwrap_or_else(|_| PyArray2::zeros(py, [2, 0], false))
    }

    /// Rotor inertia reflected to each degree of freedom (kg m², kg), those of mimic joints and a floating base included.
    #[getter]
    fn armature<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_slice(py, self.shared.robot.model.armature())
    }

    /// (3,): m/s².
    #[getter]
    fn gravity<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_slice(py, &self.shared.robot.model.gravity().to_array())
    }

    /// What is suspicious about the model, with file and line.
    #[getter]
    fn findings(&self) -> Vec<String> {
        self.shared.findings.clone()
    }

    /// Configurations that the file names.
    #[getter]
    fn keyframes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let keyframes = PyDict::new(py);
        for key in self.shared.loaded.iter().flat_map(Loaded::keyframes) {
            keyframes.set_item(&key.name, PyArray1::from_vec(py, self.shared.given(&key.q)))?;
        }
        Ok(keyframes)
    }

    /// (nq,): zero, quaternions the identity.
    fn neutral<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_vec(py, self.shared.given(&self.shared.robot.model.neutral()))
    }

    /// A random configuration within limits, (nq,), or `count` of them, (count, nq): of seeds seed, seed + 1, ..
    #[pyo3(signature = (seed=1, count=None))]
    fn random<'py>(
        &self,
        py: Python<'py>,
        seed: u64,
        count: Option<usize>,
    ) -> Result<Bound<'py, PyAny>, Failure> {
        let shared = &self.shared;
        let row = |seed| shared.given(&shared.robot.model.random(seed));
        let Some(count) = count else { return Ok(PyArray1::from_vec(py, row(seed)).into_any()) };
        Out::<f64>::new(py, &[count, shared.nq], None)?.fill(false, |out, progress| {
            out.par_chunks_mut(shared.nq.max(1)).enumerate().try_for_each(|(k, out)| {
                go_on(progress)?;
                out.copy_from_slice(&row(seed.wrapping_add(k as u64)));
                Ok(())
            })
        })
    }

    /// What the command line's `--at` takes: 'zag(pi/2)', 'elbow=0.3', 'random(7)', a keyframe's name.
    #[pyo3(signature = (text, /))]
    pub fn configuration<'py>(
        &self,
        py: Python<'py>,
        text: &str,
    ) -> Result<Bound<'py, PyArray1<f64>>, Failure> {
        let q = self.shared.configuration(text)?;
        Ok(PyArray1::from_vec(py, self.shared.given(&q)))
    }

    /// The same with other armature, one number for each that `armature` has.
    #[pyo3(signature = (armature, /))]
    fn with_armature(&self, armature: &Bound<'_, PyAny>) -> Result<Self, Failure> {
        let model = &self.shared.robot.model;
        let rows = crate::array::Rows::<f64>::new("armature", armature, model.nv())?;
        let changed = model.clone().with_armature(rows.numbers()?.into_owned())?;
        Ok(Self::with(&self.shared, changed))
    }

    /// The same with other gravity, (3,), m/s².
    #[pyo3(signature = (gravity, /))]
    fn with_gravity(&self, gravity: [f64; 3]) -> Result<Self, Failure> {
        let gravity = eigenbody::spatial::Vec3::from_f64(gravity);
        Ok(Self::with(&self.shared, self.shared.robot.model.clone().with_gravity(gravity)?))
    }

    /// The text of the URDF or MJCF file that it was read from, with what was changed since and all else as it stands there. Armature
    /// of URDF is added as rotors of transmissions, which `Model(.., rotors=True)` reads.
    fn patched(&self) -> Result<String, Failure> {
        let loaded = self.shared.loaded.as_ref();
        let loaded = loaded.ok_or_else(|| Failure::input("model", "it was read from no file"))?;
        patched(loaded, &self.shared.robot.model).map_err(|error| Failure::input("model", error))
    }

    /// As URDF, fixed joints merged; `rotors`: armature as rotors of transmissions, which `Model(.., rotors=True)` reads.
    #[pyo3(signature = (*, rotors=false))]
    fn to_urdf(&self, rotors: bool) -> Result<String, Failure> {
        let model = &self.shared.robot.model;
        let text = if rotors { write_urdf_with_rotors(model) } else { write_urdf(model) };
        text.map_err(|error| Failure::input("model", error))
    }

    /// As MJCF, fixed joints merged.
    fn to_mjcf(&self) -> Result<String, Failure> {
        write_mjcf(&self.shared.robot.model).map_err(|error| Failure::input("model", error))
    }
}

//! `eigenbody.Model`.

use crate::build::Parts;
use crate::dynamics::Robot;
use crate::error::Failure;
use eigenbody::{Base, Reduction};
use eigenbody_formats::{
    LoadOptions, Loaded, MjcfOptions, SdfOptions, UrdfOptions, load, read_mjcf, read_sdf, read_urdf,
};
use eigenbody_study::diagnosis::Drive;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::path::PathBuf;
use std::sync::{Arc, OnceLock};

/// A robot in both precisions, with what its source said beside the model.
pub struct Shared {
    pub robot: Robot<f64>,
    pub single: OnceLock<Robot<f32>>,
    /// How its source drives and steps it.
    pub drive: Drive,
    /// The file or expression, if there was one.
    pub loaded: Option<Loaded>,
    pub name: String,
    /// Numbers in q and v as a caller gives them: independent ones where mimic joints follow.
    pub nq: usize,
    pub nv: usize,
    /// Names of H's rows.
    pub dofs: Vec<String>,
    pub findings: Vec<String>,
}

/// A robot: a tree of rigid bodies and joints.
///
/// `model` is a URDF, MJCF or SDF file, `puma560`, a family such as ``'hydra(40,1,0,1)'``, or `Parts`. `mimic`: mimic joints follow
/// (None: as the command line); `reduced`: a floating base is removed, H is H*; `rotors`: rotor inertia of URDF transmissions
/// counts. Raises ModelError with file, line and column.
///
/// Every function of q takes ``(nq,)`` or a batch ``(k, nq)``; a single row stands in for every row of a batch; `out` takes
/// the result. If all arrays are float32, dynamics are computed and given in it; spectra are always float64.
#[pyclass(module = "eigenbody", frozen, weakref)]
pub struct Model {
    pub shared: Arc<Shared>,
    /// What makes it again, for pickling.
    source: Option<Source>,
}

/// The constructor that was called with the model's name, and its options.
struct Source {
    constructor: &'static str,
    options: Options,
}

/// Options of every constructor.
#[derive(Clone, Copy, Default)]
struct Options {
    base: Base,
    mimic: Option<bool>,
    reduced: bool,
    rotors: bool,
}

impl Options {
    fn new(base: &str, mimic: Option<bool>, reduced: bool, rotors: bool) -> Result<Self, Failure> {
        let base = match base {
            "fixed" => Base::Fixed,
            "floating" => Base::Floating,
            _ => return Err(Failure::input("base", format!("'{base}', expected 'fixed' or 'floating'"))),
        };
        if reduced && base == Base::Fixed {
            return Err(Failure::input("reduced", "removes a floating base: add base='floating'"));
        }
        Ok(Self { base, mimic, reduced, rotors })
    }

    /// As a constructor takes them.
    fn named<'py>(self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let named = PyDict::new(py);
        named.set_item("base", if self.base == Base::Fixed { "fixed" } else { "floating" })?;
        named.set_item("mimic", self.mimic)?;
        named.set_item("reduced", self.reduced)?;
        if self.rotors {
            named.set_item("rotors", true)?;
        }
        Ok(named)
    }
}

impl Shared {
    /// Of all coordinates, those that a caller gives.
    pub fn given(&self, q: &[f64]) -> Vec<f64> {
        match self.robot.coupling() {
            Some(coupling) => coupling.independent_coordinates().iter().map(|&k| q[k]).collect(),
            None => q.to_vec(),
        }
    }

    /// Of the velocities of all degrees of freedom, those that a caller gives.
    pub fn given_rates(&self, v: &[f64]) -> Vec<f64> {
        match self.robot.coupling() {
            Some(coupling) => coupling.independent_dofs().iter().map(|&d| v[d]).collect(),
            None => v.to_vec(),
        }
    }

    /// All coordinates of the configuration that a text names.
    pub fn configuration(&self, text: &str) -> Result<Vec<f64>, Failure> {
        let mimic = self.robot.reduction.mimic;
        Ok(match &self.loaded {
            Some(loaded) => loaded.configuration(text, mimic)?,
            None => eigenbody_formats::configuration(text, &self.robot.model, mimic)?,
        })
    }
}

impl Model {
    fn of(
        constructor: &'static str,
        loaded: Loaded,
        name: String,
        options: Options,
    ) -> Result<Self, Failure> {
        let loaded = if options.rotors { loaded.with_rotors()? } else { loaded };
        let reduction = Reduction {
            mimic: options.mimic.unwrap_or(loaded.mimic),
            base: options.base == Base::Floating && (options.reduced || loaded.is_family()),
        };
        let findings = if loaded.is_family() { Vec::new() } else { loaded.findings() };
        let source = Some(Source { constructor, options });
        let (model, drive) = (loaded.model.clone(), Drive::of(&loaded));
        Ok(Self { source, ..Self::assemble(model, reduction, name, findings, drive, Some(loaded)) })
    }

    fn assemble(
        model: eigenbody::Model<f64>,
        reduction: Reduction,
        name: String,
        findings: Vec<String>,
        drive: Drive,
        loaded: Option<Loaded>,
    ) -> Self {
        let coupling = model.coupling().filter(|_| reduction.mimic);
        let (nq, nv) = coupling.map_or((model.nq(), model.nv()), |coupling| (coupling.nq(), coupling.nv()));
        let dofs = reduction.dofs(&model).into_iter().map(|d| model.dof_name(d)).collect();
        let robot = Robot::new(model, reduction);
        let shared = Shared { robot, single: OnceLock::new(), drive, loaded, name, nq, nv, dofs, findings };
        Self { shared: Arc::new(shared), source: None }
    }

    /// The same robot with another model.
    pub fn with(shared: &Shared, model: eigenbody::Model<f64>) -> Self {
        let Shared { robot, name, findings, drive, loaded, .. } = shared;
        let (findings, drive) = (findings.clone(), drive.clone());
        Self::assemble(model, robot.reduction, name.clone(), findings, drive, loaded.clone())
    }

    fn family(py: Python<'_>, text: String, base: &str) -> Result<Self, Failure> {
        Self::load(py, text, Options::new(base, None, false, false)?)
    }

    /// A path or an expression.
    fn load(py: Python<'_>, text: String, options: Options) -> Result<Self, Failure> {
        py.detach(|| {
            let loaded = load(&text, &LoadOptions { base: options.base, size_ratio: None })?;
            Self::of("Model", loaded, text, options)
        })
    }
}

#[pymethods]
impl Model {
    #[new]
    #[pyo3(signature = (model, /, *, base="fixed", mimic=None, reduced=false, rotors=false))]
    fn new(
        py: Python<'_>,
        model: &Bound<'_, PyAny>,
        base: &str,
        mimic: Option<bool>,
        reduced: bool,
        rotors: bool,
    ) -> Result<Self, Failure> {
        let options = Options::new(base, mimic, reduced, rotors)?;
        if let Ok(parts) = model.cast::<Parts>() {
            let parts = parts.get();
            let built = parts.build(options.base)?;
            let reduction = Reduction { mimic: options.mimic.unwrap_or(true), base: options.reduced };
            let findings = built.findings().iter().map(ToString::to_string).chain(parts.notes()).collect();
            let drive = Drive { springs: parts.springs(&built), ..Drive::default() };
            return Ok(Self::assemble(built, reduction, parts.name.clone(), findings, drive, None));
        }
        let text = match model.extract::<String>() {
            Ok(text) => text,
            Err(_) => model
                .extract::<PathBuf>()
                .map_err(|_| Failure::Type("model is no path, expression or Parts".into()))?
                .to_string_lossy()
                .into_owned(),
        };
        Self::load(py, text, options)
    }

    /// A URDF file.
    #[staticmethod]
    #[pyo3(signature = (path, /, *, base="fixed", mimic=None, reduced=false, rotors=false))]
    fn from_urdf(
        py: Python<'_>,
        path: PathBuf,
        base: &str,
        mimic: Option<bool>,
        reduced: bool,
        rotors: bool,
    ) -> Result<Self, Failure> {
        let options = Options::new(base, mimic, reduced, rotors)?;
        let loaded = py.detach(|| read_urdf(&path, &UrdfOptions { base: options.base }))?;
        Self::of("from_urdf", loaded, path.to_string_lossy().into_owned(), options)
    }

    /// An MJCF file.
    #[staticmethod]
    #[pyo3(signature = (path, /, *, base="fixed", mimic=None, reduced=false))]
    fn from_mjcf(
        py: Python<'_>,
        path: PathBuf,
        base: &str,
        mimic: Option<bool>,
        reduced: bool,
    ) -> Result<Self, Failure> {
        let options = Options::new(base, mimic, reduced, false)?;
        let loaded = py.detach(|| read_mjcf(&path, &MjcfOptions { base: options.base }))?;
        Self::of("from_mjcf", loaded, path.to_string_lossy().into_owned(), options)
    }

    /// An SDF file.
    #[staticmethod]
    #[pyo3(signature = (path, /, *, base="fixed", mimic=None, reduced=false))]
    fn from_sdf(
        py: Python<'_>,
        path: PathBuf,
        base: &str,
        mimic: Option<bool>,
        reduced: bool,
    ) -> Result<Self, Failure> {
        let options = Options::new(base, mimic, reduced, false)?;
        let loaded = py.detach(|| read_sdf(&path, &SdfOptions { base: options.base }))?;
        Self::of("from_sdf", loaded, path.to_string_lossy().into_owned(), options)
    }

    /// Featherstone's hydra: n tubes of 1 m and 1 kg, each `taper` times as large as its parent.
    #[staticmethod]
    #[pyo3(signature = (n, /, branching=1.0, skew=0.0, taper=1.0, *, base="fixed"))]
    fn hydra(
        py: Python<'_>,
        n: usize,
        branching: f64,
        skew: f64,
        taper: f64,
        base: &str,
    ) -> Result<Self, Failure> {
        Self::family(py, format!("hydra({n},{branching:?},{skew:?},{taper:?})"), base)
    }

    /// Featherstone's onion: hydra with all joints in one place.
    #[staticmethod]
    #[pyo3(signature = (n, /, branching=1.0, skew=0.0, taper=1.0, *, base="fixed"))]
    fn onion(
        py: Python<'_>,
        n: usize,
        branching: f64,
        skew: f64,
        taper: f64,
        base: &str,
    ) -> Result<Self, Failure> {
        Self::family(py, format!("onion({n},{branching:?},{skew:?},{taper:?})"), base)
    }

    /// Hydra's links with joints of every kind.
    #[staticmethod]
    #[pyo3(signature = (n, /, branching=1.0, skew=0.0, taper=1.0, *, base="fixed"))]
    fn auto_tree(
        py: Python<'_>,
        n: usize,
        branching: f64,
        skew: f64,
        taper: f64,
        base: &str,
    ) -> Result<Self, Failure> {
        Self::family(py, format!("auto_tree({n},{branching:?},{skew:?},{taper:?})"), base)
    }

    /// n slender rods, horizontal at q = 0.
    #[staticmethod]
    #[pyo3(signature = (n, /, *, mass=1.0, length=1.0))]
    fn chain(py: Python<'_>, n: usize, mass: f64, length: f64) -> Result<Self, Failure> {
        Self::family(py, format!("chain({n}, m={mass:?}, l={length:?})"), "fixed")
    }

    /// The PUMA 560.
    #[staticmethod]
    fn puma560(py: Python<'_>) -> Result<Self, Failure> {
        Self::family(py, "puma560".into(), "fixed")
    }

    /// A live `pinocchio.Model`: joints in its order. Coordinates are ours; see `Layout`.
    #[staticmethod]
    #[pyo3(signature = (model, /))]
    fn from_pinocchio(py: Python<'_>, model: &Bound<'_, PyAny>) -> Result<Self, Failure> {
        let parts = py.import("eigenbody._live")?.call_method1("pinocchio_parts", (model,))?;
        Self::new(py, &parts, "fixed", None, false, false)
    }

    /// A live `mujoco.MjModel`: joints in its order, with stiffness and damping. Coordinates are ours; see `Layout`.
    ///
    /// Actuators, tendons, keyframes and the time step are left out; `findings` says so.
    #[staticmethod]
    #[pyo3(signature = (model, /))]
    fn from_mujoco(py: Python<'_>, model: &Bound<'_, PyAny>) -> Result<Self, Failure> {
        let parts = py.import("eigenbody._live")?.call_method1("mujoco_parts", (model,))?;
        Self::new(py, &parts, "fixed", None, false, false)
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> Result<Bound<'py, PyAny>, Failure> {
        let py = slf.py();
        let model = slf.get();
        let source = model.source.as_ref().ok_or_else(|| {
            let name = &model.shared.name;
            Failure::Type(format!(
                "only a Model of a file or an expression can be pickled, and '{name}' is none"
            ))
        })?;
        let rebuild = py.import("eigenbody._live")?.getattr("rebuild")?;
        let arguments = (source.constructor, model.shared.name.clone(), source.options.named(py)?);
        Ok((rebuild, arguments).into_pyobject(py)?.into_any())
    }

    fn __copy__(slf: Bound<'_, Self>) -> Bound<'_, Self> {
        slf
    }

    fn __deepcopy__<'py>(slf: Bound<'py, Self>, _memo: &Bound<'py, PyAny>) -> Bound<'py, Self> {
        slf
    }
}

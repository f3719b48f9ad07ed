//! From the command line to a robot in a configuration, with the degrees of freedom to study.

use crate::args::{BaseArg, ModelArgs, RobotArgs, Switch};
use crate::failure::Failure;
use eigenbody::{Base, Matrix, Model, Reduction};
use eigenbody_formats::{LoadOptions, Loaded, load};
use eigenbody_report::Subject;

/// A robot in a configuration.
pub struct System {
    /// The robot, and how its findings are located.
    pub loaded: Loaded,
    /// Which degrees of freedom H has.
    pub reduction: Reduction,
    /// All coordinates.
    pub q: Vec<f64>,
    name: String,
    at: String,
}

/// The model that a text names, on a base.
pub fn open(model: &str, base: BaseArg) -> Result<Loaded, Failure> {
    let base = match base {
        BaseArg::Fixed => Base::Fixed,
        BaseArg::Floating => Base::Floating,
    };
    Ok(load(model, &LoadOptions { base, size_ratio: None })?)
}

/// The robot that arguments name, and the degrees of freedom of its study.
pub fn robot(args: &ModelArgs) -> Result<(Loaded, Reduction), Failure> {
    let base = match args.base {
        BaseArg::Fixed => Base::Fixed,
        BaseArg::Floating => Base::Floating,
    };
    let loaded = load(&args.model, &LoadOptions { base, size_ratio: args.size_ratio })?;
    let loaded = if args.rotors == Switch::On { loaded.with_rotors()? } else { loaded };
    if args.reduced && base == Base::Fixed {
        return Err(Failure::Usage("--reduced removes a floating base: add --base floating".into()));
    }
    let reduction = Reduction {
        mimic: args.mimic.map_or(loaded.mimic, |switch| switch == Switch::On),
        base: base == Base::Floating && (args.reduced || loaded.is_family()),
    };
    Ok((loaded, reduction))
}

impl System {
    /// Reads what the arguments name.
    pub fn open(args: &RobotArgs) -> Result<Self, Failure> {
        let (loaded, reduction) = robot(&args.model)?;
        let q = loaded.configuration(&args.at, reduction.mimic)?;
        Ok(Self { loaded, reduction, q, name: args.model.model.clone(), at: args.at.clone() })
    }

    /// The robot.
    pub fn model(&self) -> &Model<f64> {
        &self.loaded.model
    }

    /// H in the degrees of freedom of the study.
    pub fn mass_matrix(&self) -> Result<Matrix<f64>, Failure> {
        self.reduction.mass_matrix(self.model(), &self.q).map_err(|source| self.failure(source))
    }

    /// Names of H's rows.
    pub fn dof_names(&self) -> Vec<String> {
        self.reduction.dofs(self.model()).into_iter().map(|d| self.model().dof_name(d)).collect()
    }

    /// What a report is about. Its q is what `--at 'q=[..]'` takes: all coordinates, or the independent ones where mimic
    /// joints follow.
    pub fn subject(&self) -> Subject {
        let model = self.model();
        let q = match model.coupling() {
            Some(coupling) if self.reduction.mimic => {
                coupling.independent_coordinates().iter().map(|&k| self.q[k]).collect()
            }
            _ => self.q.clone(),
        };
        let base = match (model.has_floating_base(), self.reduction.base) {
            (false, _) => "fixed",
            (true, false) => "floating",
            (true, true) => "free-floating",
        };
        Subject {
            model: self.name.clone(),
            bodies: model.bodies().len(),
            base: base.into(),
            configuration: self.at.clone(),
            q,
        }
    }

    /// What is suspicious about the robot. A family's links are idealised on purpose.
    pub fn findings(&self) -> Vec<String> {
        if self.loaded.is_family() { Vec::new() } else { self.loaded.findings() }
    }

    /// An error of the core, with the robot's name.
    pub fn failure(&self, source: impl Into<eigenbody::Error>) -> Failure {
        Failure::Numbers { model: self.name.clone(), source: source.into() }
    }
}

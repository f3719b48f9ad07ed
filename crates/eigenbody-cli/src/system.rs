//! From the command line to a robot in a configuration, with the degrees of freedom to study.

use crate::args::{BaseArg, Loops, ModelArgs, RobotArgs, Switch};
use crate::failure::Failure;
use eigenbody::conditioning::{Allowed, ClosedAt, close_loops};
use eigenbody::dynamics::Closure;
use eigenbody::{Base, Matrix, Model, Reduction};
use eigenbody_formats::{LoadOptions, Loaded, load};
use eigenbody_report::{LoopsReport, Subject};

/// A robot in a configuration.
pub struct System {
    /// The robot, and how its findings are located.
    pub loaded: Loaded,
    /// Which degrees of freedom H has.
    pub reduction: Reduction,
    /// All coordinates.
    pub q: Vec<f64>,
    /// The loops, and how they were closed, if they are to be.
    pub loops: Option<(Vec<Closure>, ClosedAt)>,
    name: String,
    at: String,
}

fn base(base: BaseArg) -> Base {
    match base {
        BaseArg::Fixed => Base::Fixed,
        BaseArg::Floating => Base::Floating,
    }
}

/// The model that a text names, on a base.
pub fn open(model: &str, on: BaseArg) -> Result<Loaded, Failure> {
    Ok(load(model, &LoadOptions { base: base(on), size_ratio: None })?)
}

/// The robot that arguments name, and the degrees of freedom of its study.
pub fn robot(args: &ModelArgs) -> Result<(Loaded, Reduction), Failure> {
    let base = base(args.base);
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
        let (name, at) = (args.model.model.clone(), args.at.clone());
        if args.loops == Loops::Open {
            return Ok(Self { loaded, reduction, q, loops: None, name, at });
        }
        let closures = loaded.closures()?;
        let closed = close_loops(&loaded.model, &q, &closures, reduction)
            .map_err(|source| Failure::Numbers { model: name.clone(), source })?;
        Ok(Self { loaded, reduction, q: closed.q.clone(), loops: Some((closures, closed)), name, at })
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

    /// What was made of the loops, and what they leave.
    pub fn loops_report(&self, allowed: &Allowed) -> Option<LoopsReport> {
        let (closures, closed) = self.loops.as_ref()?;
        Some(LoopsReport {
            closures: closures.iter().map(|closure| closure.name.clone()).collect(),
            rank: allowed.rank,
            freedom: allowed.H.rows(),
            opened: closed.before,
            residual: closed.after,
            steps: closed.steps,
        })
    }

    /// What is suspicious about the robot. A family's links are idealised on purpose.
    pub fn findings(&self) -> Vec<String> {
        if self.loaded.is_family() {
            return Vec::new();
        }
        let mut findings = self.loaded.findings();
        if self.loops.is_some() {
            // They are closed.
            findings.retain(|finding| !finding.contains(" closes a loop: "));
        }
        findings
    }

    /// An error of the core, with the robot's name.
    pub fn failure(&self, source: impl Into<eigenbody::Error>) -> Failure {
        Failure::Numbers { model: self.name.clone(), source: source.into() }
    }
}

//! Which robot, and in which configuration.

use clap::ValueEnum;
use eigenbody::scalar::Dd;
use std::path::Path;

/// Which robot.
#[derive(Debug, clap::Args)]
pub struct ModelArgs {
    /// A URDF, MJCF or SDF file, `puma560`, or a family: 'hydra(40,1,0,1)', 'onion(33,1.125,0,1)', 'chain(4, m=2.2, l=1)',
    /// 'auto_tree(12,1.5,0.3,0.9)'.
    pub model: String,

    /// What carries the root link. A family on a floating base loses its first joint and is studied free-floating.
    #[arg(long, value_enum, default_value_t = BaseArg::Fixed)]
    pub base: BaseArg,

    /// Remove the floating base: the matrix H* that the joints of a free-floating robot feel.
    #[arg(long)]
    pub reduced: bool,

    /// Mimic joints, and the joint equalities of MJCF, are followed (on) or not (off). URDF: on, MJCF: off, as MuJoCo's own H.
    #[arg(long, value_enum, value_name = "on|off")]
    pub mimic: Option<Switch>,

    /// Rotor inertia that a URDF file gives in <transmission> is added to the joints (on) or not (off).
    #[arg(long, value_enum, value_name = "on|off", default_value_t = Switch::Off)]
    pub rotors: Switch,

    /// For a family: last link R times the size of the first, ρ = R^(1/(N−1)).
    #[arg(long, value_name = "R")]
    pub size_ratio: Option<Dd>,
}

impl ModelArgs {
    /// Its file, if it is one.
    pub fn path(&self) -> &Path {
        Path::new(&self.model)
    }
}

/// Which robot, in which configuration.
#[derive(Debug, clap::Args)]
pub struct RobotArgs {
    /// The robot.
    #[command(flatten)]
    pub model: ModelArgs,

    /// zero, 'zag(pi/2)', 'curl(0.1)', 'q=[..]', 'joint=value,..', 'random(seed)' or a keyframe's name.
    #[arg(long, value_name = "CONFIG", default_value = "zero", allow_hyphen_values = true)]
    pub at: String,

    /// Loops of MJCF (connect, weld) and SDF files: cut open, H is that of the tree, or closed, H is Nᵀ H N among the motions that
    /// they allow, at the closed configuration near CONFIG.
    #[arg(long, value_enum, value_name = "open|closed", default_value_t = Loops::Open)]
    pub loops: Loops,
}

/// `--loops`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Loops {
    /// Cut.
    Open,
    /// Closed.
    Closed,
}

/// `--base`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum BaseArg {
    /// Fastened to the world.
    Fixed,
    /// Free: six more degrees of freedom.
    Floating,
}

/// `on` or `off`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Switch {
    /// On.
    On,
    /// Off.
    Off,
}

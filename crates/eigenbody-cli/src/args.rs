//! The command line: a contract. Add, do not rename.

use crate::fail_on::FailOn;
use clap::{Parser, Subcommand, ValueEnum};
use eigenbody::Method;
use eigenbody::scalar::Dd;
use eigenbody::spectrum::Precision;
use serde::Deserialize;
use std::path::PathBuf;

/// How well-conditioned is a robot?
///
/// Computes the joint-space inertia matrix H(q), its eigenvalues and its condition number, and says which joints are to blame.
/// Without a command: a report on a built-in robot, and what to try next.
#[derive(Debug, Parser)]
#[command(name = "eigenbody", version, disable_help_subcommand = true, max_term_width = 100)]
pub struct Args {
    /// What to compute.
    #[command(subcommand)]
    pub command: Option<Command>,
}

/// The commands.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// What is wrong with a robot over all that its joints allow: the worst case, who is to blame, what to change.
    Check(CheckCommand),
    /// The same as a page to keep: one HTML file with pictures, tables and how it was computed.
    Report(ReportArgs),
    /// κ, κ', the bracket, λmin, λmax and the softest and stiffest mode in one configuration.
    Spectrum(SpectrumArgs),
    /// The mass matrix H itself.
    Matrix(MatrixArgs),
    /// Every figure and number of two papers on ill-conditioned mass matrices, printed against computed.
    Reproduce(ReproduceArgs),
    /// The tree, the degrees of freedom in order, masses, findings.
    Info(InfoArgs),
    /// The model in another format, its fixed joints merged.
    Convert(ConvertArgs),
}

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

/// `eigenbody spectrum`.
#[derive(Debug, clap::Args)]
pub struct SpectrumArgs {
    /// The robot.
    #[command(flatten)]
    pub robot: RobotArgs,

    /// What counts as a unit of motion: euclidean, unit-diagonal, length=L (L metres count as a radian), or diagonal=[..].
    #[arg(long, default_value = "euclidean")]
    pub metric: String,

    /// From the matrix (dense), from the tree in O(N) without it (sturm), or whichever suits (auto).
    #[arg(long, value_enum, default_value_t = MethodArg::Auto)]
    pub method: MethodArg,

    /// Double-double for the last digits: never (f64), always (dd), or where the error estimate asks (auto).
    #[arg(long, value_enum, default_value_t = PrecisionArg::Auto)]
    pub precision: PrecisionArg,

    /// Count the eigenvalues below σ.
    #[arg(long, value_name = "σ", allow_negative_numbers = true)]
    pub count_below: Option<f64>,

    /// List all eigenvalues.
    #[arg(long)]
    pub all: bool,

    /// Print JSON.
    #[arg(long)]
    pub json: bool,

    /// Write to a file instead of standard output.
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
}

/// `eigenbody matrix`.
#[derive(Debug, clap::Args)]
pub struct MatrixArgs {
    /// The robot.
    #[command(flatten)]
    pub robot: RobotArgs,

    /// Print JSON: DoF names and rows.
    #[arg(long, conflicts_with_all = ["npy", "csv"])]
    pub json: bool,

    /// Write a NumPy file (float64, n × n).
    #[arg(long, conflicts_with = "csv")]
    pub npy: bool,

    /// Write CSV with a heading of DoF names.
    #[arg(long)]
    pub csv: bool,

    /// Write to a file instead of standard output.
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
}

/// `eigenbody check`.
#[derive(Debug, clap::Args)]
pub struct CheckArgs {
    /// The robot.
    #[command(flatten)]
    pub model: ModelArgs,

    /// What counts as a unit of motion for κ and λmin: euclidean, or length=L (L metres count as a radian) [default: euclidean].
    #[arg(long)]
    pub metric: Option<String>,

    /// Configurations sampled before the search for the worst, at most 65536 [default: 2048].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=65536))]
    pub samples: Option<u32>,

    /// Another seed, other samples [default: 1].
    #[arg(long)]
    pub seed: Option<u32>,

    /// A finding if κ' exceeds this anywhere: what solves in double precision feel.
    #[arg(long, value_name = "X", allow_negative_numbers = true)]
    pub max_kappa_weighted: Option<f64>,

    /// A finding if κ exceeds this anywhere: what gains and explicit steps feel.
    #[arg(long, value_name = "X", allow_negative_numbers = true)]
    pub max_kappa: Option<f64>,

    /// Digits that single precision must keep of an acceleration.
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    pub f32_digits: Option<f64>,

    /// How it is driven.
    #[command(flatten)]
    pub gains: GainArgs,

    /// Advise the least armature with which κ is at most this in every configuration, and what else would do.
    #[arg(long, value_name = "K", allow_negative_numbers = true, conflicts_with = "want_lambda_min")]
    pub want_kappa: Option<f64>,

    /// Advise the least armature with which λmin is at least this (kg m²) in every configuration.
    #[arg(long, value_name = "L", allow_negative_numbers = true)]
    pub want_lambda_min: Option<f64>,

    /// Advise the least armature with which this step (s) is stable in every configuration, by the integrator in use.
    #[arg(long, value_name = "S", allow_negative_numbers = true, conflicts_with_all = ["want_kappa", "want_lambda_min"])]
    pub want_step: Option<f64>,

    /// Write a copy of the model with what is advised: .xml as MJCF; .urdf as URDF, armature as rotors of transmissions
    /// (`--rotors on` reads them).
    #[arg(long, value_name = "FILE")]
    pub write_patch: Option<PathBuf>,

    /// What the copy has: armature, one link's inertia, or a limit.
    #[arg(long, value_enum, default_value_t = RemedyArg::Armature, requires = "write_patch")]
    pub remedy: RemedyArg,

    /// Thresholds and the like, as a TOML file; without it, the eigenbody.toml nearest above the model.
    #[arg(long, value_name = "FILE")]
    pub config: Option<PathBuf>,

    /// An earlier `--format json`: says what is new, what got worse and what is gone.
    #[arg(long, value_name = "FILE")]
    pub baseline: Option<PathBuf>,
}

/// `eigenbody check`: what to examine, and what to make of it.
#[derive(Debug, clap::Args)]
pub struct CheckCommand {
    /// What to examine.
    #[command(flatten)]
    pub check: CheckArgs,

    /// Exit status 1 for: findings of this level or graver (note, warning, error), for none (never), or for some by name
    /// (solves,loop). With --baseline only new and worse ones count [default: warning].
    #[arg(long, value_name = "LEVEL|CODE,..")]
    pub fail_on: Option<FailOn>,

    /// A page for the terminal, JSON, SARIF for code hosts, or an HTML page.
    #[arg(long, value_enum, default_value_t = CheckFormat::Human)]
    pub format: CheckFormat,

    /// Write to a file instead of standard output.
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
}

/// `eigenbody report`.
#[derive(Debug, clap::Args)]
pub struct ReportArgs {
    /// What to examine.
    #[command(flatten)]
    pub check: CheckArgs,

    /// The file to write.
    #[arg(short, long, value_name = "FILE", default_value = "report.html")]
    pub output: PathBuf,
}

/// How a robot is driven and stepped.
#[derive(Debug, Default, clap::Args)]
pub struct GainArgs {
    /// Stiffness on joints in place of the gains of the file's actuators: a number for all, or 'elbow=100,wrist=5' (N m/rad, N/m).
    #[arg(long, value_name = "GAINS", allow_hyphen_values = true)]
    pub kp: Option<String>,

    /// The same for damping (N m s/rad, N s/m).
    #[arg(long, value_name = "GAINS", allow_hyphen_values = true)]
    pub kd: Option<String>,

    /// Step of simulation or control in seconds; an MJCF file has its own.
    #[arg(long, value_name = "S", allow_negative_numbers = true)]
    pub dt: Option<f64>,

    /// How a step is made; an MJCF file has its own, else semi-implicit.
    #[arg(long, value_enum)]
    pub integrator: Option<IntegratorArg>,
}

/// `--remedy`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum RemedyArg {
    /// The least armature.
    Armature,
    /// More inertia for the link that needs the smallest change.
    Link,
    /// The limit that costs the least.
    Limit,
}

/// `--integrator`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum IntegratorArg {
    /// Semi-implicit Euler.
    SemiImplicit,
    /// The same, damping of joints implicit: MuJoCo's Euler.
    Damped,
    /// The same, all damping implicit: MuJoCo's implicitfast.
    Implicit,
    /// Runge-Kutta of order four.
    Rk4,
}

/// `--format`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum CheckFormat {
    /// A page for the terminal.
    Human,
    /// JSON, floats that parse back to the same bits.
    Json,
    /// SARIF 2.1.0.
    Sarif,
    /// One HTML file.
    Html,
}

/// `eigenbody reproduce`.
#[derive(Debug, clap::Args)]
pub struct ReproduceArgs {
    /// Experiments or claims, such as F-fig6 or S-eq7; all if none is named. F: Featherstone (2004). S: Shah & Saha (2013).
    #[arg(value_name = "ID")]
    pub ids: Vec<String>,

    /// The same as ID.
    #[arg(long, value_name = "ID")]
    pub figure: Vec<String>,

    /// Folder for figures (SVG, PNG), tables (CSV), claims.json and index.html; made if it is not there.
    #[arg(short, long, value_name = "DIR")]
    pub output: PathBuf,

    /// Fewer points and smaller robots, for a first look. Every claim is still tested.
    #[arg(long)]
    pub quick: bool,

    /// Write into a folder that is not empty.
    #[arg(long)]
    pub force: bool,
}

/// `eigenbody info`.
#[derive(Debug, clap::Args)]
pub struct InfoArgs {
    /// A model, as for `spectrum`.
    pub model: String,

    /// What carries the root link.
    #[arg(long, value_enum, default_value_t = BaseArg::Fixed)]
    pub base: BaseArg,

    /// Print JSON.
    #[arg(long)]
    pub json: bool,
}

/// `eigenbody convert`.
#[derive(Debug, clap::Args)]
pub struct ConvertArgs {
    /// A model, as for `spectrum`.
    pub model: String,

    /// What carries the root link.
    #[arg(long, value_enum, default_value_t = BaseArg::Fixed)]
    pub base: BaseArg,

    /// The file to write: .urdf, or .xml for MJCF.
    #[arg(short, long, value_name = "FILE")]
    pub output: PathBuf,
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

/// `--method`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum MethodArg {
    /// Whichever suits.
    Auto,
    /// From the matrix.
    Dense,
    /// From the tree.
    Sturm,
}

impl From<MethodArg> for Method {
    fn from(method: MethodArg) -> Self {
        match method {
            MethodArg::Auto => Self::Auto,
            MethodArg::Dense => Self::Dense,
            MethodArg::Sturm => Self::Sturm,
        }
    }
}

/// `--precision`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum PrecisionArg {
    /// Where the error estimate asks.
    Auto,
    /// Never.
    F64,
    /// Always.
    Dd,
}

impl From<PrecisionArg> for Precision {
    fn from(precision: PrecisionArg) -> Self {
        match precision {
            PrecisionArg::Auto => Self::Auto,
            PrecisionArg::F64 => Self::F64,
            PrecisionArg::Dd => Self::Dd,
        }
    }
}

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
    /// A motion, with energy, κ and other quantities along it.
    Simulate(Box<SimulateArgs>),
    /// κ and other quantities along a recorded motion.
    Track(TrackArgs),
    /// Many robots in many configurations, from one core to a cluster, as one Parquet table.
    #[cfg(feature = "parquet")]
    Sweep(SweepArgs),
    /// The explorer: a page in the browser that shows a robot, its modes and κ while it is moved. For this machine alone.
    #[cfg(feature = "web")]
    Serve(ServeArgs),
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

/// `eigenbody serve`.
#[cfg(feature = "web")]
#[derive(Debug, clap::Args)]
pub struct ServeArgs {
    /// What to show first: a URDF, MJCF or SDF file, `puma560`, or a family. Others are chosen, or dropped, on the page.
    #[arg(default_value = "puma560")]
    pub model: String,

    /// What carries the root link.
    #[arg(long, value_enum, default_value_t = BaseArg::Fixed)]
    pub base: BaseArg,

    /// Port of 127.0.0.1; any free one if it is not said.
    #[arg(long, default_value_t = 0, hide_default_value = true)]
    pub port: u16,

    /// Open the page in the browser.
    #[arg(long)]
    pub open: bool,
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

/// `eigenbody simulate`.
#[derive(Debug, clap::Args)]
pub struct SimulateArgs {
    /// The robot.
    #[command(flatten)]
    pub model: ModelArgs,

    /// Where it starts: zero, 'zag(pi/2)', 'curl(0.1)', 'q=[..]', 'joint=value,..', 'random(seed)' or a keyframe's name.
    #[arg(long, value_name = "CONFIG", default_value = "zero", allow_hyphen_values = true)]
    pub initial: String,

    /// How fast it starts: zero, 'random(seed)', 'v=[..]' or 'joint=value,..'.
    #[arg(long, value_name = "VELOCITY", default_value = "zero", allow_hyphen_values = true)]
    pub velocity: String,

    /// How long it moves, in seconds.
    #[arg(long, value_name = "S", default_value_t = 10.0, allow_negative_numbers = true)]
    pub time: f64,

    /// Rows a second.
    #[arg(long, value_name = "HZ", default_value_t = 100.0, allow_negative_numbers = true)]
    pub rate: f64,

    /// How steps are taken.
    #[arg(long, value_enum, default_value_t = MethodOfMotion::Dopri5)]
    pub method: MethodOfMotion,

    /// Length of a step in seconds, for all methods but dopri5.
    #[arg(long, value_name = "S", default_value_t = 1e-3, allow_negative_numbers = true)]
    pub step: f64,

    /// Error of a step that dopri5 allows, in rad, m and units of max(1, |v|).
    #[arg(long, value_name = "TOL", default_value_t = 1e-9, allow_negative_numbers = true)]
    pub tolerance: f64,

    /// How accelerations are found: articulated bodies (aba), or H and its factors (crba). Mimic joints need the matrix.
    #[arg(long, value_enum, default_value_t = DynamicsArg::Aba)]
    pub dynamics: DynamicsArg,

    /// Gravity.
    #[arg(long, value_enum, value_name = "on|off", default_value_t = Switch::On)]
    pub gravity: Switch,

    /// Springs and dampers that joints and tendons have in the file.
    #[arg(long, value_enum, value_name = "on|off", default_value_t = Switch::On)]
    pub springs: Switch,

    /// More damping on joints: a number for all, or 'elbow=1,wrist=0.2' (N m s/rad, N s/m).
    #[arg(long, value_name = "D")]
    pub damping: Option<String>,

    /// More stiffness on joints: a number for all, or 'elbow=10,wrist=2' (N m/rad, N/m).
    #[arg(long, value_name = "K")]
    pub stiffness: Option<String>,

    /// Where all springs are slack.
    #[arg(long, value_name = "CONFIG", default_value = "zero", allow_hyphen_values = true)]
    pub rest: String,

    /// A controller holds this posture.
    #[arg(long, value_name = "CONFIG", conflicts_with = "follow", allow_hyphen_values = true)]
    pub hold: Option<String>,

    /// A controller follows a recorded motion: a table as for `track`.
    #[arg(long, value_name = "FILE")]
    pub follow: Option<PathBuf>,

    /// The controller's frequency f: gains are (2πf)² and 2ζ 2πf times the diagonal of H at its first target.
    #[arg(long, value_name = "HZ", default_value_t = 2.0, allow_negative_numbers = true)]
    pub bandwidth: f64,

    /// The controller's damping ratio ζ.
    #[arg(long, value_name = "Z", default_value_t = 1.0, allow_negative_numbers = true)]
    pub damping_ratio: f64,

    /// External forces on joints over time: a table with columns t and tau0, tau1, .. or joints' names.
    #[arg(long, value_name = "FILE")]
    pub torque: Option<PathBuf>,

    /// Report where a quantity crosses a level: 'kappa=1e5'; kappa, kappa_weighted, lambda_min, lambda_max. Joint limits are always
    /// reported.
    #[arg(long, value_name = "QUANTITY=X")]
    pub event: Vec<String>,

    /// Where the rows go.
    #[command(flatten)]
    pub rows: RowsArgs,
}

/// What is written of every row.
#[derive(Debug, clap::Args)]
pub struct RowsArgs {
    /// Quantities, separated by commas; `help` lists them with what they cost and how exact they are.
    #[arg(long, value_name = "LIST", default_value = "kappa,kappa_weighted", value_delimiter = ',')]
    pub monitor: Vec<String>,

    /// A .csv or .parquet file; standard output, as CSV, without one. Rows so far stand in FILE.partial, or FILE.partial.csv.
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,

    /// Draw the quantities over time: .svg or .png.
    #[arg(long, value_name = "FILE")]
    pub plot: Option<PathBuf>,
}

/// `eigenbody track`.
#[derive(Debug, clap::Args)]
pub struct TrackArgs {
    /// The robot.
    #[command(flatten)]
    pub model: ModelArgs,

    /// A .csv or .parquet file with columns t and q0, q1, .. or joints' names; v0, v1, .. if there are velocities.
    pub log: PathBuf,

    /// Where joints stand that have no column; without it they are an error.
    #[arg(long, value_name = "CONFIG", allow_hyphen_values = true)]
    pub others: Option<String>,

    /// Pass over rows with a wrong number of columns, without numbers or out of order, and say how many there were.
    #[arg(long)]
    pub skip_bad: bool,

    /// Where the rows go.
    #[command(flatten)]
    pub rows: RowsArgs,
}

/// `simulate --method`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum MethodOfMotion {
    /// Semi-implicit Euler, order 1.
    Euler,
    /// Runge-Kutta, order 4.
    Rk4,
    /// Dormand-Prince 5(4), steps by its own error estimate.
    Dopri5,
    /// Implicit midpoint rule, order 2: keeps energy and momenta over long times.
    Midpoint,
}

/// `simulate --dynamics`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum DynamicsArg {
    /// Articulated bodies, O(N).
    Aba,
    /// Composite bodies and a branch-sparse factorisation.
    Crba,
}

/// `eigenbody sweep`.
#[cfg(feature = "parquet")]
#[derive(Debug, clap::Args)]
pub struct SweepArgs {
    /// A TOML file: robots, configurations, quantities. Paths in it are seen from where the command runs.
    #[arg(value_name = "SPEC.toml")]
    pub spec: PathBuf,

    /// Folder for chunks and the table; one of the same sweep is taken up where it was left.
    #[arg(short, long, value_name = "DIR")]
    pub output: Option<PathBuf>,

    /// Compute every n-th chunk from the i-th on, and do not merge: for job arrays.
    #[arg(long, value_name = "i/n")]
    pub shard: Option<Shard>,

    /// Only merge what is there.
    #[arg(long, conflicts_with = "shard")]
    pub merge: bool,

    /// Say how many cases, how long and how large, and compute nothing.
    #[arg(long)]
    pub dry_run: bool,
}

/// `--shard`.
#[cfg(feature = "parquet")]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Shard {
    index: u64,
    count: u64,
}

#[cfg(feature = "parquet")]
impl Shard {
    /// True if a chunk is this shard's.
    pub fn has(self, chunk: u64) -> bool {
        chunk % self.count == self.index - 1
    }
}

#[cfg(feature = "parquet")]
impl std::str::FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let parts =
            text.split_once('/').and_then(|(i, n)| Some((i.trim().parse().ok()?, n.trim().parse().ok()?)));
        match parts {
            Some((index, count)) if (1..=count).contains(&index) => Ok(Self { index, count }),
            _ => Err("expected i/n with 1 ≤ i ≤ n".into()),
        }
    }
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

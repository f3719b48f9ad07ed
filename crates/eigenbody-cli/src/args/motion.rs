//! Along a motion: `simulate` and `track`.

use super::{ModelArgs, Switch};
use clap::ValueEnum;
use std::path::{Path, PathBuf};

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

    /// Length of a step in seconds, for all methods but dopri5 [default: 0.001].
    #[arg(long, value_name = "S", allow_negative_numbers = true)]
    pub step: Option<f64>,

    /// Error of a step that dopri5 allows, in rad, m and units of max(1, |v|) [default: 1e-9].
    #[arg(long, value_name = "TOL", allow_negative_numbers = true)]
    pub tolerance: Option<f64>,

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
    #[arg(long, value_name = "D", allow_hyphen_values = true)]
    pub damping: Option<String>,

    /// More stiffness on joints: a number for all, or 'elbow=10,wrist=2' (N m/rad, N/m).
    #[arg(long, value_name = "K", allow_hyphen_values = true)]
    pub stiffness: Option<String>,

    /// Where all springs are slack.
    #[arg(long, value_name = "CONFIG", default_value = "zero", allow_hyphen_values = true)]
    pub rest: String,

    /// A controller holds this posture.
    #[arg(long, value_name = "CONFIG", group = "target", allow_hyphen_values = true)]
    pub hold: Option<String>,

    /// A controller follows a recorded motion: a table as for `track`.
    #[arg(long, value_name = "FILE", group = "target")]
    pub follow: Option<PathBuf>,

    /// The controller's frequency f: gains are (2πf)² and 2ζ 2πf times the diagonal of H at its first target.
    #[arg(
        long,
        value_name = "HZ",
        default_value_t = 2.0,
        allow_negative_numbers = true,
        requires = "target"
    )]
    pub bandwidth: f64,

    /// The controller's damping ratio ζ.
    #[arg(long, value_name = "Z", default_value_t = 1.0, allow_negative_numbers = true, requires = "target")]
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

impl RowsArgs {
    /// Files that are written.
    pub fn writes(&self) -> [Option<&Path>; 2] {
        [self.output.as_deref(), self.plot.as_deref()]
    }
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

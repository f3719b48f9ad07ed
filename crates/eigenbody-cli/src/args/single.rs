//! Of one configuration: `spectrum` and `matrix`.

use super::RobotArgs;
use clap::ValueEnum;
use eigenbody::Method;
use eigenbody::spectrum::Precision;
use std::path::PathBuf;

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

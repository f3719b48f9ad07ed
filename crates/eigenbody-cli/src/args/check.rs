//! Over all that the joints allow: `check` and `report`.

use super::ModelArgs;
use crate::fail_on::FailOn;
use clap::ValueEnum;
use serde::Deserialize;
use std::path::{Path, PathBuf};

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
    /// (`--rotors on` reads them). In the model's own format it is the model's own file, all else as it was.
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

impl CheckArgs {
    /// Files that are read and written.
    pub fn files(&self) -> (Vec<&Path>, Vec<&Path>) {
        let reads = [Some(self.model.path()), self.config.as_deref(), self.baseline.as_deref()];
        super::files(reads, [self.write_patch.as_deref()])
    }
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

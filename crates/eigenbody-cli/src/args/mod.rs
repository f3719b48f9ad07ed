//! The command line: a contract. Add, do not rename.

mod check;
mod many;
mod model;
mod motion;
mod robot;
mod single;

pub use check::{CheckArgs, CheckCommand, CheckFormat, GainArgs, IntegratorArg, RemedyArg, ReportArgs};
pub use many::ReproduceArgs;
#[cfg(feature = "parquet")]
pub use many::SweepArgs;
#[cfg(feature = "web")]
pub use model::ServeArgs;
pub use model::{ConvertArgs, InfoArgs};
pub use motion::{DynamicsArg, MethodOfMotion, RowsArgs, SimulateArgs, TrackArgs};
pub use robot::{BaseArg, Loops, ModelArgs, RobotArgs, Switch};
pub use single::{MatrixArgs, MethodArg, SpectrumArgs};

use clap::{Parser, Subcommand};
use std::path::Path;

/// How well-conditioned is a robot?
///
/// Computes the joint-space inertia matrix H(q), its eigenvalues and its condition number, and says which joints are to blame.
/// Without a command: a report on a built-in robot, and what to try next.
#[derive(Debug, Parser)]
#[command(name = "eigenbody", version, max_term_width = 100)]
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

impl Command {
    /// Files that the command reads and files that it writes. A model's text may name one.
    pub fn files(&self) -> (Vec<&Path>, Vec<&Path>) {
        match self {
            Self::Check(args) => with(args.check.files(), [], [args.output.as_deref()]),
            Self::Report(args) => with(args.check.files(), [], [Some(&args.output)]),
            Self::Spectrum(args) => files([Some(args.robot.model.path())], [args.output.as_deref()]),
            Self::Matrix(args) => files([Some(args.robot.model.path())], [args.output.as_deref()]),
            Self::Simulate(args) => {
                let reads = [Some(args.model.path()), args.follow.as_deref(), args.torque.as_deref()];
                files(reads, args.rows.writes())
            }
            Self::Track(args) => files([Some(args.model.path()), Some(&args.log)], args.rows.writes()),
            Self::Convert(args) => files([Some(Path::new(&args.model))], [Some(&args.output)]),
            Self::Info(_) | Self::Reproduce(_) => Default::default(),
            #[cfg(feature = "parquet")]
            Self::Sweep(_) => Default::default(),
            #[cfg(feature = "web")]
            Self::Serve(_) => Default::default(),
        }
    }
}

/// Those paths that are given.
fn files<'a, const R: usize, const W: usize>(
    reads: [Option<&'a Path>; R],
    writes: [Option<&'a Path>; W],
) -> (Vec<&'a Path>, Vec<&'a Path>) {
    with(Default::default(), reads, writes)
}

fn with<'a, const R: usize, const W: usize>(
    mut known: (Vec<&'a Path>, Vec<&'a Path>),
    reads: [Option<&'a Path>; R],
    writes: [Option<&'a Path>; W],
) -> (Vec<&'a Path>, Vec<&'a Path>) {
    known.0.extend(reads.into_iter().flatten());
    known.1.extend(writes.into_iter().flatten());
    known
}

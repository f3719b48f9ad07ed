//! The model itself: `info`, `convert` and `serve`.

use super::BaseArg;
use std::path::PathBuf;

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

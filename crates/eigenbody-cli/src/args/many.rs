//! Many robots: `reproduce` and `sweep`.

use std::path::PathBuf;

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

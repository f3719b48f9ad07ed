//! What a run of the server knows: its token, the robot that it was started with, and the robots in use.

use crate::api::figure::FIGURES;
use crate::looks::Meshes;
use crate::models::Models;
use crate::robot::{Options, Source};
use crate::work::Workers;
use eigenbody_formats::{FormatError, Kind, LoadOptions, load};
use std::io;
use std::sync::{Arc, OnceLock};

/// What the page shows first.
#[derive(Debug, Clone, PartialEq)]
pub struct Opening {
    pub(crate) source: Source,
    pub(crate) options: Options,
    /// The file named when the server was started: the one that it may read, with what that names.
    pub(crate) file: Option<String>,
}

impl Default for Opening {
    /// A built-in arm.
    fn default() -> Self {
        Self { source: Source::builtin("puma560"), options: Options::default(), file: None }
    }
}

impl Opening {
    /// A robot by what the command line calls it: a file, a family or a built-in robot.
    ///
    /// Errors: [`FormatError`], if it cannot be read.
    pub fn new(model: &str, options: Options) -> Result<Self, FormatError> {
        let loaded = load(model, &LoadOptions { base: options.base.into(), size_ratio: None })?;
        Ok(match loaded.kind {
            Kind::Family(_) => Self { source: Source::family(model), options, file: None },
            Kind::BuiltIn => Self { source: Source::builtin(model.trim()), options, file: None },
            Kind::File(_) => Self { source: Source::opened(), options, file: Some(model.to_owned()) },
        })
    }
}

/// One run.
pub struct Explorer {
    pub opening: Opening,
    pub models: Models,
    pub workers: Workers,
    pub meshes: Meshes,
    /// Figures, each computed once.
    pub figures: [OnceLock<Arc<[u8]>>; FIGURES.len()],
    token: String,
    hosts: [String; 2],
}

impl Explorer {
    /// For a server on this port.
    pub fn new(opening: Opening, port: u16) -> io::Result<Self> {
        let mut secret = [0u8; 32];
        getrandom::fill(&mut secret).map_err(|_| io::Error::other("the system gives no random numbers"))?;
        Ok(Self {
            opening,
            models: Models::default(),
            workers: Workers::new(),
            meshes: Meshes::default(),
            figures: Default::default(),
            token: secret.iter().map(|byte| format!("{byte:02x}")).collect(),
            hosts: [format!("127.0.0.1:{port}"), format!("localhost:{port}")],
        })
    }

    /// The token of this run.
    pub fn token(&self) -> &str {
        &self.token
    }

    /// Compares without telling by time how much is right.
    pub fn is_token(&self, token: &str) -> bool {
        let differs = self.token.bytes().zip(token.bytes()).fold(0, |found, (a, b)| found | (a ^ b));
        token.len() == self.token.len() && differs == 0
    }

    /// Whether a name with a port is this server's.
    pub fn is_host(&self, host: &str) -> bool {
        self.hosts.iter().any(|own| own.eq_ignore_ascii_case(host))
    }
}

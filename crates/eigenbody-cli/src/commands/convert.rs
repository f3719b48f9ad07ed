//! `eigenbody convert`.

use crate::args::ConvertArgs;
use crate::failure::Failure;
use crate::output::{check_model, deliver, say};
use crate::system::open;
use eigenbody_formats::{write_mjcf, write_urdf};
use std::path::Path;

/// The formats that models are written in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Written {
    Urdf,
    Mjcf,
}

impl Written {
    /// By the name of the file that an option asks for.
    pub fn of(option: &str, file: &Path) -> Result<Self, Failure> {
        let extension = file.extension().and_then(|e| e.to_str()).unwrap_or_default().to_lowercase();
        match extension.as_str() {
            "urdf" => Ok(Self::Urdf),
            "xml" | "mjcf" => Ok(Self::Mjcf),
            _ => {
                let file = file.display();
                Err(Failure::Usage(format!("{option} {file}: expected a file named .urdf or .xml (MJCF)")))
            }
        }
    }
}

/// Writes the model in another format.
pub fn run(args: &ConvertArgs) -> Result<(), Failure> {
    let loaded = open(&args.model, args.base)?;
    check_model(&loaded, &[Some(&args.output)])?;
    let text = match Written::of("-o", &args.output)? {
        Written::Urdf => write_urdf(&loaded.model),
        Written::Mjcf => write_mjcf(&loaded.model),
    };
    let text = text.map_err(|source| Failure::Write { model: args.model.clone(), source })?;
    for finding in loaded.findings() {
        say(finding);
    }
    deliver(Some(&args.output), |out| out.write_all(text.as_bytes()))
}

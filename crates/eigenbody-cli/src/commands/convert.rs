//! `eigenbody convert`.

use crate::args::ConvertArgs;
use crate::failure::Failure;
use crate::output::{check_model, deliver, say};
use crate::system::open;
use eigenbody_formats::{write_mjcf, write_urdf};

/// Writes the model in another format.
pub fn run(args: &ConvertArgs) -> Result<(), Failure> {
    let loaded = open(&args.model, args.base)?;
    check_model(&loaded, &[Some(&args.output)])?;
    let extension = args.output.extension().and_then(|e| e.to_str()).unwrap_or_default().to_lowercase();
    let text = match extension.as_str() {
        "urdf" => write_urdf(&loaded.model),
        "xml" | "mjcf" => write_mjcf(&loaded.model),
        _ => {
            let output = args.output.display();
            return Err(Failure::Usage(format!("-o {output}: expected a file named .urdf or .xml (MJCF)")));
        }
    };
    let text = text.map_err(|source| Failure::Write { model: args.model.clone(), source })?;
    for finding in loaded.findings() {
        say(finding);
    }
    deliver(Some(&args.output), |out| out.write_all(text.as_bytes()))
}

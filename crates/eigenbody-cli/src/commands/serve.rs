//! `eigenbody serve`.

use crate::args::{BaseArg, ServeArgs};
use crate::failure::Failure;
use crate::interrupt;
use crate::output::{deliver, say};
use eigenbody_web::{Base, Opening, Options, Server};
use std::io;
use std::process::{Command, Stdio};

/// Serves the explorer until Ctrl-C.
pub fn run(args: &ServeArgs) -> Result<(), Failure> {
    let base = match args.base {
        BaseArg::Fixed => Base::Fixed,
        BaseArg::Floating => Base::Floating,
    };
    let opening = Opening::new(&args.model, Options { base, ..Options::default() })?;
    let failed = |source| Failure::Listen { port: args.port, source };
    let server = Server::bind(args.port, opening).map_err(failed)?;
    let (stop, url) = (server.stopper(), server.url());
    interrupt::at_first(move || stop.stop());
    deliver(None, |out| writeln!(out, "{url}"))?;
    say("the explorer, for this machine alone; Ctrl-C ends it");
    if args.open && open(&url).is_err() {
        say("note: no browser could be started; open the address above");
    }
    server.run().map_err(failed)
}

/// Starts whatever opens pages here.
fn open(url: &str) -> io::Result<()> {
    let (program, before): (&str, &[&str]) = match std::env::consts::OS {
        "macos" => ("open", &[]),
        "windows" => ("rundll32", &["url.dll,FileProtocolHandler"]),
        _ => ("xdg-open", &[]),
    };
    let quiet = Stdio::null;
    Command::new(program)
        .args(before)
        .arg(url)
        .stdin(quiet())
        .stdout(quiet())
        .stderr(quiet())
        .spawn()
        .map(drop)
}

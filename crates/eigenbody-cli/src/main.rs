//! The `eigenbody` command: how well-conditioned is this robot?
//!
//! Data goes to stdout, talk to stderr. Exit status: 0 ok, 1 findings or a claim that is not reproduced, 2 error. An error is one line; on a
//! terminal, with the line of the file that it is about.

#![forbid(unsafe_code)]
// H is the book's symbol.
#![allow(non_snake_case)]

mod args;
mod commands;
mod fail_on;
mod failure;
mod output;
mod settings;
mod system;

use args::{Args, Command};
use clap::Parser;
use std::io::IsTerminal;
use std::process::ExitCode;

fn main() -> ExitCode {
    let args = Args::parse();
    let result = match &args.command {
        None => commands::welcome::run().map(|()| true),
        Some(Command::Check(check)) => commands::check::run(check),
        Some(Command::Report(report)) => commands::check::page(report).map(|()| true),
        Some(Command::Spectrum(spectrum)) => commands::spectrum::run(spectrum).map(|()| true),
        Some(Command::Matrix(matrix)) => commands::matrix::run(matrix).map(|()| true),
        Some(Command::Reproduce(reproduce)) => commands::reproduce::run(reproduce),
        Some(Command::Info(info)) => commands::info::run(info).map(|()| true),
        Some(Command::Convert(convert)) => commands::convert::run(convert).map(|()| true),
    };
    match result {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(failure) if failure.is_closed_pipe() => ExitCode::SUCCESS,
        Err(failure) => {
            match std::io::stderr().is_terminal().then(|| failure.excerpt()).flatten() {
                Some(excerpt) => eprintln!("{excerpt}"),
                None => eprintln!("error: {failure}"),
            }
            ExitCode::from(2)
        }
    }
}

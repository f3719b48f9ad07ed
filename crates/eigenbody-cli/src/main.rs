//! The `eigenbody` command: how well-conditioned is this robot?
//!
//! Data goes to stdout, talk to stderr. Exit status: 0 ok, 1 findings, a claim that is not reproduced or a motion that
//! blows up, 2 error, 130 interrupted. An error is one line; on a
//! terminal, with the line of the file that it is about.

#![forbid(unsafe_code)]
// H is the book's symbol.
#![allow(non_snake_case)]

mod args;
mod commands;
mod fail_on;
mod failure;
mod growing;
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
        Some(Command::Simulate(simulate)) => return ended(commands::simulate::run(simulate)),
        Some(Command::Track(track)) => return ended(commands::track::run(track)),
        #[cfg(feature = "parquet")]
        Some(Command::Sweep(sweep)) => commands::sweep::run(sweep).map(|()| true),
        #[cfg(feature = "web")]
        Some(Command::Serve(serve)) => commands::serve::run(serve).map(|()| true),
        Some(Command::Info(info)) => commands::info::run(info).map(|()| true),
        Some(Command::Convert(convert)) => commands::convert::run(convert).map(|()| true),
    };
    match result {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(failure) => failed(&failure),
    }
}

/// The status of a run along a motion.
fn ended(result: Result<commands::motion::Ending, failure::Failure>) -> ExitCode {
    match result {
        Ok(commands::motion::Ending::Whole) => ExitCode::SUCCESS,
        Ok(commands::motion::Ending::BlownUp) => ExitCode::FAILURE,
        // As a shell has it for a program that was interrupted.
        Ok(commands::motion::Ending::Interrupted) => ExitCode::from(130),
        Err(failure) => failed(&failure),
    }
}

fn failed(failure: &failure::Failure) -> ExitCode {
    if failure.is_closed_pipe() {
        return ExitCode::SUCCESS;
    }
    match std::io::stderr().is_terminal().then(|| failure.excerpt()).flatten() {
        Some(excerpt) => eprintln!("{excerpt}"),
        None => eprintln!("error: {failure}"),
    }
    ExitCode::from(2)
}

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
mod interrupt;
mod output;
mod settings;
mod system;

use args::{Args, Command};
use clap::Parser;
use std::io::{IsTerminal, Write};
use std::process::ExitCode;

fn main() -> ExitCode {
    let args = Args::parse();
    interrupt::listen();
    let (reads, writes) = args.command.as_ref().map(Command::files).unwrap_or_default();
    if let Err(failure) = output::check_files(&reads, &writes) {
        return failed(&failure);
    }
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
        Ok(commands::motion::Ending::Interrupted) => ExitCode::from(interrupt::STATUS),
        Err(failure) => failed(&failure),
    }
}

fn failed(failure: &failure::Failure) -> ExitCode {
    if failure.is_closed_pipe() {
        return ExitCode::SUCCESS;
    }
    match std::io::stderr().is_terminal().then(|| failure.excerpt(has_colours())).flatten() {
        // Its colours are control characters: it goes out as it is.
        Some(excerpt) => _ = writeln!(std::io::stderr(), "{excerpt}"),
        None => output::say(format_args!("error: {failure}")),
    }
    ExitCode::from(2)
}

/// As <https://no-color.org> has it, and for terminals that have none.
fn has_colours() -> bool {
    let is_set = |name: &str| std::env::var_os(name).is_some_and(|value| !value.is_empty());
    !is_set("NO_COLOR") && std::env::var_os("TERM").is_none_or(|term| term != "dumb")
}

//! Development tasks: `cargo xtask TASK`.

mod bench;
mod conformance;
mod explorer;
mod layers;
mod newton;
mod oracle;
mod program;
mod python;
mod stability;
mod steps;
mod studies;
mod suite;
mod survey;
mod sweep;

use std::process::ExitCode;

/// What a task or one of its steps comes to: a failure is one line for the reader.
type Outcome = Result<(), String>;

struct Task {
    name: &'static str,
    about: &'static str,
    run: fn() -> Outcome,
}

const TASKS: &[Task] = &[
    Task { name: "test", about: "every test: the workspace's own, then conformance", run: suite::test },
    Task {
        name: "ci",
        about: "what a change must pass: format, lints, docs, layers, test, instruction counts",
        run: suite::ci,
    },
    Task { name: "layers", about: "the one-way arrows of docs/ARCHITECTURE.md", run: layers::check },
    Task {
        name: "oracle",
        about: "install the Python references (Pinocchio, MuJoCo) into .oracle/",
        run: oracle::prepare,
    },
    Task {
        name: "conformance",
        about: "H and kappa of real robots against Pinocchio and MuJoCo",
        run: conformance::check,
    },
    Task { name: "python", about: "the Python package: wheel, tests, types", run: python::test },
    Task {
        name: "explorer",
        about: "the explorer and the report in a real browser; the page's own tests",
        run: explorer::test,
    },
    Task {
        name: "explorer-bench",
        about: "how fast the explorer answers in a browser, into docs/performance.md",
        run: explorer::speed,
    },
    Task {
        name: "pictures",
        about: "the guide's pictures of the explorer and of a report",
        run: explorer::pictures,
    },
    Task {
        name: "survey",
        about: "docs/survey.md: `eigenbody check` on published robots",
        run: survey::survey,
    },
    Task {
        name: "stability",
        about: "stable steps of `eigenbody check` against MuJoCo and Pinocchio",
        run: stability::stability,
    },
    Task { name: "newton", about: "docs/guide/src/newton.md: a case study", run: newton::newton },
    Task {
        name: "estimators",
        about: "docs/estimators.md: estimators of kappa beside kappa, along motions",
        run: studies::estimators,
    },
    Task { name: "cost", about: "docs/cost.md: what ill-conditioning costs", run: studies::cost },
    Task {
        name: "tracking",
        about: "the tracker beside Pinocchio and LAPACK, into docs/performance.md",
        run: bench::tracking,
    },
    Task {
        name: "python-bench",
        about: "calls from Python beside Rust and Pinocchio, into docs/performance.md",
        run: bench::calls::calls,
    },
    Task {
        name: "sweep",
        about: "200,000 cases on every engine, killed and resumed, into docs/performance.md",
        run: sweep::sweep,
    },
    Task {
        name: "bench",
        about: "the figures of docs/performance.md, beside LAPACK and faer",
        run: bench::bench,
    },
    Task {
        name: "bench-peers",
        about: "the figures of docs/performance.md, beside Pinocchio, MuJoCo and dynibo",
        run: bench::peers::bench,
    },
];

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let outcome = match arguments.as_slice() {
        [] => {
            print!("{}", usage());
            Ok(())
        }
        [name] => match TASKS.iter().find(|task| task.name == name) {
            Some(task) => (task.run)(),
            None => Err(format!("no task `{name}`; `cargo xtask` lists them")),
        },
        [name, ..] => Err(format!("task `{name}` takes no arguments")),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("error: {message}");
            ExitCode::FAILURE
        }
    }
}

fn usage() -> String {
    let tasks = TASKS.iter().map(|task| format!("  {:<14} {}\n", task.name, task.about));
    format!("cargo xtask TASK\n\n{}", tasks.collect::<String>())
}

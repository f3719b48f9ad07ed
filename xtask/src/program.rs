//! Running other programs from the root of the repository.

use std::collections::VecDeque;
use std::ffi::{OsStr, OsString};
use std::io::{self, BufRead, BufReader, ErrorKind, IsTerminal, PipeReader, Write};
use std::path::{Path, PathBuf};
use std::process::{Command, ExitStatus, Stdio};
use std::sync::mpsc;
use std::thread;
use std::time::Duration;

use crate::Outcome;

/// The root of the repository.
///
/// Cargo names the manifest of the checkout it was called in; the compiled-in path may be that of another one with
/// which the build directory is shared.
pub fn root() -> PathBuf {
    let manifest =
        std::env::var_os("CARGO_MANIFEST_DIR").unwrap_or_else(|| OsString::from(env!("CARGO_MANIFEST_DIR")));
    let mut root = PathBuf::from(manifest);
    root.pop();
    root
}

/// A call of `program` in the root, without input.
pub fn program(program: impl Into<OsString>) -> Command {
    let mut command = Command::new(program.into());
    command.current_dir(root()).stdin(Stdio::null());
    command
}

/// A call of the cargo that runs this task.
pub fn cargo(arguments: &[&str]) -> Command {
    let mut command = program(std::env::var_os("CARGO").unwrap_or_else(|| OsString::from("cargo")));
    command.args(arguments);
    command
}

/// How many of a failed program's last lines its error repeats.
const LAST: usize = 60;

/// Runs `command` to its end; its output is the user's to see.
///
/// In a log the error repeats the output's end: a summary can then say why a step failed that is far above it.
pub fn run(command: &mut Command) -> Outcome {
    let line = line(command);
    println!("$ {line}");
    let terminal = io::stdout().is_terminal();
    let ended =
        if terminal { command.status().map(|status| (status, String::new())) } else { relayed(command) };
    let (status, last) = ended.map_err(|error| not_started(command, &error))?;
    if status.success() { Ok(()) } else { Err(format!("`{line}` failed ({status}){last}")) }
}

/// Runs `command`, passes on what it writes, and returns the last lines of it, each on a line of its own.
fn relayed(command: &mut Command) -> io::Result<(ExitStatus, String)> {
    let (reader, writer) = io::pipe()?;
    let spawned = command.stdout(writer.try_clone()?).stderr(writer).spawn();
    // The command's own ends of the pipe go, so that it closes with the program.
    command.stdout(Stdio::null()).stderr(Stdio::null());
    let mut child = spawned?;
    let (done, end) = mpsc::channel();
    thread::spawn(move || done.send(passed_on(reader)));
    let status = child.wait()?;
    // A process left behind may hold the pipe open.
    let last = end.recv_timeout(Duration::from_secs(5)).unwrap_or_default();
    Ok((status, last.into_iter().flat_map(|line| ["\n  ".to_string(), line]).collect()))
}

/// Copies `reader` to stdout; the last lines of it.
fn passed_on(reader: PipeReader) -> VecDeque<String> {
    let mut reader = BufReader::new(reader);
    let mut last = VecDeque::with_capacity(LAST);
    let mut line = Vec::new();
    while reader.read_until(b'\n', &mut line).is_ok_and(|length| length > 0) {
        // A log that cannot be written is no fault of the program's.
        let _ = io::stdout().write_all(&line);
        if last.len() == LAST {
            last.pop_front();
        }
        last.push_back(String::from_utf8_lossy(&line).trim_end().to_string());
        line.clear();
    }
    last
}

/// What `command` writes to stdout. What it writes to stderr becomes the error's text.
pub fn output(command: &mut Command) -> Result<String, String> {
    let result = command.output().map_err(|error| not_started(command, &error))?;
    if result.status.success() {
        Ok(String::from_utf8_lossy(&result.stdout).into_owned())
    } else {
        let talk = String::from_utf8_lossy(&result.stderr);
        let last = talk.trim().lines().last().unwrap_or("no message");
        Err(format!("`{}` failed ({}): {last}", line(command), result.status))
    }
}

/// Installs a Debian package, where that can be done.
pub fn debian(package: &str) -> Outcome {
    let root = output(program("id").arg("-u")).is_ok_and(|id| id.trim() == "0");
    if !root || output(program("apt-get").arg("--version")).is_err() {
        return Ok(());
    }
    run(program("apt-get").args(["update", "-qq"]))?;
    run(program("apt-get")
        .args(["install", "-y", "-qq", "--no-install-recommends", package])
        .env("DEBIAN_FRONTEND", "noninteractive"))
}

/// Where cargo builds: `target/`, unless the environment or a configuration file moved it.
pub fn build_directory() -> Result<PathBuf, String> {
    let metadata = output(&mut cargo(&["metadata", "--format-version", "1", "--no-deps"]))?;
    let directory =
        text_field(&metadata, "target_directory").ok_or("cargo metadata names no target directory")?;
    Ok(Path::new(directory).to_path_buf())
}

/// The value of a text field that holds nothing escaped.
fn text_field<'a>(json: &'a str, name: &str) -> Option<&'a str> {
    let (_, rest) = json.split_once(&format!("\"{name}\":\""))?;
    let (value, _) = rest.split_once('"')?;
    (!value.contains('\\')).then_some(value)
}

fn not_started(command: &Command, error: &std::io::Error) -> String {
    let name = command.get_program().to_string_lossy();
    match error.kind() {
        ErrorKind::NotFound => format!("`{name}` is not installed or not on the path"),
        _ => format!("`{name}` does not start: {error}"),
    }
}

/// The call as one would type it in the root.
fn line(command: &Command) -> String {
    let root = root();
    let inside = |word: &OsStr| Path::new(word).strip_prefix(&root).ok().map(Path::to_path_buf);
    let name = Path::new(command.get_program());
    let name = inside(name.as_os_str()).or_else(|| name.file_name().map(PathBuf::from)).unwrap_or_default();
    let arguments = command.get_args().map(|word| inside(word).unwrap_or_else(|| PathBuf::from(word)));
    let words = std::iter::once(name).chain(arguments).map(|word| word.display().to_string());
    words.collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_missing_program_is_named() {
        let message = run(&mut program("no-such-program")).unwrap_err();
        assert_eq!(message, "`no-such-program` is not installed or not on the path");
    }

    #[test]
    fn the_end_of_a_log_is_repeated() {
        let script = "for k in $(seq 100); do echo $k; done; echo why >&2; exit 3";
        let (status, last) = relayed(program("sh").args(["-c", script])).unwrap();
        assert_eq!(status.code(), Some(3));
        let lines: Vec<&str> = last.lines().collect();
        assert_eq!((lines.len(), lines[1], lines[LAST]), (LAST + 1, "  42", "  why"));
    }

    #[test]
    fn a_process_left_behind_is_not_waited_for() {
        let start = std::time::Instant::now();
        let (status, last) = relayed(program("sh").args(["-c", "sleep 60 & exit 1"])).unwrap();
        assert_eq!((status.code(), last.as_str()), (Some(1), ""));
        assert!(start.elapsed() < Duration::from_secs(30));
    }

    #[test]
    fn calls_are_shown_as_typed_in_the_root() {
        let mut command = program(root().join(".oracle/bin/python"));
        command.arg(root().join("oracle/conformance.py")).arg("--quick");
        assert_eq!(line(&command), ".oracle/bin/python oracle/conformance.py --quick");
        assert_eq!(line(program("/opt/rust/bin/cargo").arg("test")), "cargo test");
    }

    #[test]
    fn a_text_field_is_found_by_its_name() {
        let json = r#"{"packages":[],"target_directory":"/src/robot/target","version":1}"#;
        assert_eq!(text_field(json, "target_directory"), Some("/src/robot/target"));
        assert_eq!(text_field(json, "workspace_root"), None);
    }
}

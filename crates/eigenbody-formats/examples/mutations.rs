//! Broken copies of real robot files: each ends in a model or an error, in bounded time, never in a panic.
//!
//! Standard input: a path a line. Argument: how many copies in all. Memory is bounded by whoever starts this (`ulimit -v`): an
//! allocation that fails ends the process.

#[path = "../tests/mutation.rs"]
mod mutation;

use eigenbody::model::Random;
use eigenbody_formats::{
    FormatError, Loaded, MjcfOptions, SdfOptions, UrdfOptions, read_mjcf_str, read_sdf_str, read_urdf_str,
};
use std::io::BufRead;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::process::{ExitCode, exit};
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};
use std::time::{Duration, Instant};

/// Longest time that a copy may take.
const PATIENCE: Duration = Duration::from_secs(20);

/// The copy that is being read.
static CURRENT: AtomicUsize = AtomicUsize::new(0);

fn main() -> ExitCode {
    let count: usize = std::env::args().nth(1).and_then(|n| n.parse().ok()).unwrap_or(10_000);
    let files: Vec<(String, String)> = std::io::stdin()
        .lock()
        .lines()
        .map_while(Result::ok)
        .filter_map(|path| Some((std::fs::read(&path).ok()?, path)))
        .map(|(bytes, path)| (String::from_utf8_lossy(&bytes).into_owned(), path))
        .collect();
    if files.is_empty() {
        eprintln!("no files");
        return ExitCode::from(2);
    }
    std::thread::spawn(watch);
    let (mut read, mut refused, mut panics, mut longest) = (0, 0, 0, (Duration::ZERO, ""));
    for k in 0..count {
        CURRENT.store(k, Relaxed);
        let (text, path) = &files[k % files.len()];
        let broken = mutation::mutated(text, &mut Random::new(k as u64));
        let start = Instant::now();
        match catch_unwind(AssertUnwindSafe(|| load(&broken, path))) {
            Ok(Ok(_)) => read += 1,
            Ok(Err(error)) => {
                refused += 1;
                let message = error.to_string();
                if message.is_empty() || message.contains('\n') {
                    println!("  copy {k} of {path}: the error is no line: {message:?}");
                    panics += 1;
                }
            }
            Err(_) => {
                println!("  copy {k} of {path}: panic");
                panics += 1;
            }
        }
        if start.elapsed() > longest.0 {
            longest = (start.elapsed(), path);
        }
    }
    println!(
        "{count} broken copies of {} files: {read} read, {refused} refused, {panics} failed; the longest took {:.2} s ({})",
        files.len(),
        longest.0.as_secs_f64(),
        longest.1.rsplit('/').next().unwrap_or_default()
    );
    // Breaking must break something, and not everything.
    ExitCode::from(u8::from(panics > 0 || read * 20 < count || refused * 20 < count))
}

fn load(text: &str, path: &str) -> Result<Loaded, FormatError> {
    match path.rsplit('.').next() {
        Some("urdf") => read_urdf_str(text, path, &UrdfOptions::default()),
        Some("sdf") => read_sdf_str(text, path, &SdfOptions::default()),
        _ => read_mjcf_str(text, path, &MjcfOptions::default()),
    }
}

/// Ends the process if a copy takes too long.
fn watch() {
    let (mut seen, mut since) = (usize::MAX, Instant::now());
    loop {
        std::thread::sleep(Duration::from_millis(200));
        let current = CURRENT.load(Relaxed);
        if current != seen {
            (seen, since) = (current, Instant::now());
        } else if since.elapsed() > PATIENCE {
            println!("  copy {current}: no end after {} s", PATIENCE.as_secs());
            exit(1);
        }
    }
}

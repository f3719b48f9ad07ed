//! `simulate` and `track`: rows, logs, and what is left when something goes wrong.

use crate::run::{Scratch, failure, run, stdout};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

fn table(csv: &str) -> (Vec<String>, Vec<Vec<f64>>) {
    let mut lines = csv.lines();
    let names = lines.next().unwrap().split(',').map(str::to_owned).collect();
    let rows = lines.map(|line| line.split(',').map(|cell| cell.parse().unwrap()).collect()).collect();
    (names, rows)
}

const CHAIN: &str = "chain(3, m=1, l=1)";

#[test]
fn a_simulation_is_a_table() {
    let csv = stdout(&["simulate", CHAIN, "--time", "0.5", "--rate", "20", "--monitor", "kappa,energy"]);
    let (names, rows) = table(&csv);
    let expected =
        ["t", "q0", "q1", "q2", "v0", "v1", "v2", "kappa", "energy", "kinetic_energy", "potential_energy"];
    assert_eq!(names, expected);
    assert_eq!(rows.len(), 11);
    // every row's κ is that of `spectrum`
    for row in [&rows[0], &rows[10]] {
        let q = format!("q=[{}, {}, {}]", row[1], row[2], row[3]);
        let kappa = crate::run::json(&["spectrum", CHAIN, "--at", &q, "--json"])["kappa"].as_f64().unwrap();
        assert!((row[7] / kappa - 1.0).abs() < 1e-12, "{} {kappa}", row[7]);
        assert!(row[8].abs() < 1e-6 * rows[10][9], "energy {}", row[8]);
    }
}

/// What one command writes the other reads, in either format, to the last bit.
#[test]
fn a_log_is_followed() {
    let scratch = Scratch::new();
    let from = |name: &str| scratch.path(name).to_str().unwrap().to_owned();
    for name in ["run.csv", "run.parquet"] {
        let file = from(name);
        let call = ["simulate", CHAIN, "--time", "0.2", "--initial", "random(2)", "-o", &file];
        let output = run(&[&call[..], &["--monitor", "kappa,eigenvalues,modes"]].concat());
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        assert_eq!(std::fs::read_dir(scratch.path("")).unwrap().count(), 1, "a partial file is left");
        let tracked = table(&stdout(&["track", CHAIN, &file, "--monitor", "kappa,bracket"])).1;
        assert_eq!(tracked.len(), 21);
        for row in &tracked {
            let [kappa, lo, hi] = row[row.len() - 3..] else { panic!("{row:?}") };
            assert!(lo <= kappa && kappa <= hi);
        }
        std::fs::remove_file(file).unwrap();
    }
}

#[test]
fn figures_are_drawn() {
    let scratch = Scratch::new();
    for name in ["motion.svg", "motion.png"] {
        let file = scratch.path(name);
        stdout(&["simulate", CHAIN, "--time", "0.2", "--plot", file.to_str().unwrap()]);
        assert!(std::fs::metadata(file).unwrap().len() > 1000);
    }
}

#[test]
fn quantities_say_what_they_cost() {
    let help = stdout(&["simulate", CHAIN, "--monitor", "help"]);
    for name in ["kappa:", "scaled_diagonal_ratio:", "bracket:", "cost", "error", "holds always"] {
        assert!(help.contains(name), "{name}");
    }
    let unknown = failure(&["simulate", CHAIN, "--monitor", "kapa"]);
    assert!(unknown.contains("--monitor kapa: no such quantity; known: kappa, "), "{unknown}");
}

/// Torques and controllers from tables; events on the way.
#[test]
fn tables_drive_and_events_are_told() {
    let scratch = Scratch::new();
    let torque = scratch.file("torque.csv", "t,joint_1\n0,0\n1,5\n");
    let target = scratch.file("target.csv", "t,q0,q1,q2\n0,0,0,0\n0.5,0.5,0.5,0.5\n");
    let output = run(&[
        "simulate",
        CHAIN,
        "--time",
        "1",
        "--torque",
        &torque,
        "--follow",
        &target,
        "--event",
        "kappa=300",
    ]);
    let talk = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.success() && talk.contains("kappa falls below 300"), "{talk}");
    let (_, rows) = table(&String::from_utf8(output.stdout).unwrap());
    assert!(rows[100][1] > 0.1, "{:?}", rows[100]);
}

/// Every bad row is located; with --skip-bad it is counted.
#[test]
fn bad_logs_are_located() {
    let scratch = Scratch::new();
    let head = "t,q0,q1,q2\n0.0,0,0,0\n0.1,0,0,0.1\n";
    for (row, message) in [
        ("0.2,0,0\n", ":4: 3 columns, expected 4"),
        ("0.2,0,nan,0\n", ":4: column 'q1': 'NaN' is no finite number"),
        ("0.2,0,x,0\n", ":4: column 'q1': 'x' is no finite number"),
        ("0.2,0,,0\n", ":4: column 'q1' is empty"),
        ("0.05,0,0,0\n", ":4: t = 0.05 s does not come after 0.1 s"),
        (
            "9.0,0,0,0\n",
            ":4: a gap: t = 9 s comes 8.900 s after the row before, where steps took up to 0.100 s",
        ),
    ] {
        let log = scratch.file("log.csv", &format!("{head}{row}9.1,0,0,0\n"));
        let output = run(&["track", CHAIN, &log]);
        let talk = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{talk}");
        assert!(talk.lines().last().unwrap().ends_with(&format!("log.csv{message}")), "{talk}");
        let skipped = run(&["track", CHAIN, &log, "--skip-bad"]);
        let talk = String::from_utf8(skipped.stderr).unwrap();
        assert!(
            skipped.status.success() && (talk.contains("skipped 1 of 4 rows") || talk.contains("1 gap")),
            "{talk}"
        );
    }
    for (heading, message) in [
        ("t,joint_1,joint_2,joint_4", "unknown joint 'joint_4'; did you mean 'joint_1'?"),
        ("t,joint_1,joint_2", "no column for joint 'joint_3' (q2)"),
        ("s,q0,q1,q2", "no column 't' or 'time'"),
        ("t,q0,q1,q2,q3", "column 'q3': the robot has q0 to q2"),
        ("t,q0,q1,q1,q2", "two columns hold 'q1'"),
    ] {
        let log = scratch.file("log.csv", &format!("{heading}\n"));
        let message_found = failure(&["track", CHAIN, &log]);
        assert!(message_found.ends_with(message), "{message_found}");
    }
    // joints without a column may stand somewhere
    let log = scratch.file("log.csv", "time [s],joint_3,joint_1\n0,0.1,0.2\n");
    let rows = table(&stdout(&["track", CHAIN, &log, "--others", "joint_2=0.7"])).1;
    assert_eq!(rows[0][..4], [0.0, 0.2, 0.7, 0.1]);
    assert!(failure(&["track", CHAIN, "nowhere.csv"]).ends_with("nowhere.csv: no such file"));
    let broken = scratch.file("log.parquet", "no Parquet");
    assert!(failure(&["track", CHAIN, &broken]).contains("log.parquet: "));
}

#[test]
fn what_cannot_be_simulated_is_one_line() {
    for (arguments, message) in [
        (&["--time", "-1"][..], "--time -1: expected a positive number"),
        (&["--method", "rk4", "--step", "0"], "--step 0: expected a positive number"),
        (&["--initial", "q=[0]"], "q has 1 number, expected 3"),
        (&["--velocity", "v=[0]"], "v has 1 number, expected 3"),
        (&["--velocity", "elbow=1"], "no degree of freedom is named 'elbow'"),
        (&["--event", "kappa"], "--event kappa: expected QUANTITY=X"),
        (&["-o", "run.txt"], "run.txt: expected a .csv or .parquet file"),
        (&["-o", "no/where.csv"], "no folder 'no'"),
    ] {
        let found = failure(&[&["simulate", CHAIN][..], arguments].concat());
        assert!(found.contains(message), "{found}");
    }
}

/// A blow-up ends with status 1, its rows written.
#[test]
fn a_blow_up_keeps_its_rows() {
    let scratch = Scratch::new();
    let file = scratch.path("run.csv");
    let stiff = ["--stiffness", "1e7", "--initial", "random(1)", "--method", "euler", "--step", "0.02"];
    let output =
        run(&[&["simulate", CHAIN, "--time", "10", "-o", file.to_str().unwrap()], &stiff[..]].concat());
    let talk = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(1), "{talk}");
    assert!(
        talk.contains("the motion has blown up: 'joint_") && talk.contains("rows so far are written"),
        "{talk}"
    );
    let rows = std::fs::read_to_string(file).unwrap().lines().count();
    assert!(rows > 1 && rows < 1000, "{rows}");
}

/// A child that is in the middle of a long run, with rows on disk.
#[cfg(unix)]
fn long_run(scratch: &Scratch, name: &str, partial: &str) -> (std::process::Child, std::path::PathBuf) {
    let file = scratch.path(name);
    let child = Command::new(env!("CARGO_BIN_EXE_eigenbody"))
        .args(["simulate", CHAIN, "--time", "100000", "-o", file.to_str().unwrap()])
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    let (partial, start) = (scratch.path(partial), Instant::now());
    while std::fs::metadata(&partial).map_or(0, |metadata| metadata.len()) < 2000 {
        assert!(start.elapsed() < Duration::from_secs(60), "no rows");
        std::thread::sleep(Duration::from_millis(20));
    }
    (child, partial)
}

#[cfg(unix)]
fn signal(child: &std::process::Child, name: &str) {
    Command::new("kill").args([name, &child.id().to_string()]).status().unwrap();
}

/// Ctrl-C: status 130, the table under its own name, nothing partial left.
#[cfg(unix)]
#[test]
fn an_interrupted_run_ends_cleanly() {
    for (name, partial) in [("run.csv", "run.csv.partial"), ("run.parquet", "run.parquet.partial.csv")] {
        let scratch = Scratch::new();
        let (mut child, partial) = long_run(&scratch, name, partial);
        signal(&child, "-INT");
        assert_eq!(child.wait().unwrap().code(), Some(130));
        assert!(!partial.exists());
        let file = scratch.path(name);
        assert!(table(&stdout(&["track", CHAIN, file.to_str().unwrap()])).1.len() > 5);
    }
}

/// The same between two rows, where steps are far shorter than they are apart.
#[cfg(unix)]
#[test]
fn a_run_can_be_interrupted_between_rows() {
    for name in ["-INT", "-TERM"] {
        let scratch = Scratch::new();
        let file = scratch.path("run.csv");
        let mut child = Command::new(env!("CARGO_BIN_EXE_eigenbody"))
            .args(["simulate", CHAIN, "--hold", "q=[.5,.5,.5]", "--bandwidth", "1e9", "--time", "0.1"])
            .args(["-o", file.to_str().unwrap()])
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let partial = scratch.path("run.csv.partial");
        while !std::fs::read_to_string(&partial).is_ok_and(|text| text.contains('\n')) {
            std::thread::yield_now();
        }
        std::thread::sleep(Duration::from_millis(200));
        signal(&child, name);
        let end = Instant::now() + Duration::from_secs(20);
        let status = loop {
            if let Some(status) = child.try_wait().unwrap() {
                break status.code();
            }
            if Instant::now() > end {
                child.kill().unwrap();
                break child.wait().unwrap().code();
            }
            std::thread::sleep(Duration::from_millis(10));
        };
        assert_eq!(status, Some(130), "{name}");
        assert!(file.exists() && !partial.exists());
    }
}

/// A killed run leaves whole rows, which `track` reads; the next run does not overwrite them.
#[cfg(unix)]
#[test]
fn a_killed_run_leaves_its_rows() {
    for (name, partial) in [("run.csv", "run.csv.partial"), ("run.parquet", "run.parquet.partial.csv")] {
        let scratch = Scratch::new();
        let (mut child, partial) = long_run(&scratch, name, partial);
        signal(&child, "-KILL");
        child.wait().unwrap();
        assert!(!scratch.path(name).exists());
        assert!(table(&stdout(&["track", CHAIN, partial.to_str().unwrap()])).1.len() > 5);
        let file = scratch.path(name);
        let refused = failure(&["simulate", CHAIN, "-o", file.to_str().unwrap()]);
        assert!(refused.contains("holds the rows of a run that did not end"), "{refused}");
    }
}

/// A full disk: status 2, one line, and whole rows up to there. A limit on the size of files stands in for a disk.
#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_leaves_whole_rows() {
    let full = failure(&["simulate", CHAIN, "--time", "1", "-o", "/dev/full"]);
    assert!(full.starts_with("error: /dev/full: No space left on device"), "{full}");
    let scratch = Scratch::new();
    let file = scratch.path("run.csv");
    // 16 blocks of 512 bytes; the signal that comes with the limit is ignored, so that writing fails.
    let script = r#"trap '' XFSZ; ulimit -f 16; exec "$0" simulate "$1" --time 100 -o "$2""#;
    let output = Command::new("sh")
        .args(["-c", script, env!("CARGO_BIN_EXE_eigenbody"), CHAIN, file.to_str().unwrap()])
        .output()
        .unwrap();
    let talk = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2), "{talk}");
    assert!(talk.contains("run.csv: File too large") && talk.contains("rows so far: "), "{talk}");
    let partial = scratch.path("run.csv.partial");
    let text = std::fs::read_to_string(&partial).unwrap();
    assert!(text.ends_with('\n') && text.lines().count() > 10);
    assert!(table(&stdout(&["track", CHAIN, partial.to_str().unwrap()])).1.len() > 10);
}

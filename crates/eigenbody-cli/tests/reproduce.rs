//! `eigenbody reproduce`: what it writes, how it refuses, what it leaves behind.

use crate::run::{Scratch, failure, run, stdout};
use insta::assert_snapshot;
use std::collections::BTreeSet;
use std::path::Path;

fn files(folder: &Path) -> BTreeSet<String> {
    std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect()
}

/// A message about a folder, its path cut to a word.
fn refused(args: &[&str], folder: &str) -> String {
    failure(&[&["reproduce", "-o", folder], args].concat()).replace(folder, "FOLDER")
}

#[test]
fn one_claim_writes_its_experiment() {
    let scratch = Scratch::new();
    let folder = scratch.path("new/out");
    let page = stdout(&[
        "reproduce",
        "F-eq1-kappa",
        "--figure",
        "F-fig2",
        "--quick",
        "-o",
        folder.to_str().unwrap(),
    ]);
    let expected = ["F-eq1.csv", "F-fig2.csv", "F-fig2.png", "F-fig2.svg", "claims.json", "index.html"];
    assert_eq!(files(&folder), expected.map(str::to_owned).into());
    assert!(page.contains("F-eq1-kappa") && page.contains("paper rounds"), "{page}");
    assert!(page.contains("1 figure, 4 claims, 0 failed"), "{page}");
    let json = std::fs::read_to_string(folder.join("claims.json")).unwrap();
    let claims: serde_json::Value = serde_json::from_str(&json).unwrap();
    let ids: Vec<&str> =
        claims.as_array().unwrap().iter().map(|claim| claim["id"].as_str().unwrap()).collect();
    assert_eq!(ids, ["F-eq1-tau", "F-eq1-qdd", "F-eq1-kappa", "F-fig2"]);
    assert_eq!(claims[2]["exact"][0], 1514.643493110704);
    let picture = std::fs::read(folder.join("F-fig2.png")).unwrap();
    assert_eq!(&picture[..8], b"\x89PNG\r\n\x1a\n");
}

#[test]
fn unknown_names_list_the_known_ones() {
    let scratch = Scratch::new();
    let folder = scratch.path("out");
    let message = refused(&["F-fig66"], folder.to_str().unwrap());
    assert_snapshot!(message, @"error: no experiment or claim 'F-fig66'; did you mean 'F-fig16'?; known: F-Hprime, F-Hprime-1, F-Hprime-half, F-Imin, F-asymptotic, F-eq1, F-eq1-kappa, F-eq1-qdd, F-eq1-tau, F-erratum, F-fig1, F-fig10, F-fig11, F-fig12, F-fig13, F-fig14, F-fig15, F-fig16, F-fig17, F-fig18, F-fig18-extreme, F-fig19, F-fig2, F-fig20, F-fig21, F-fig3, F-fig4, F-fig5, F-fig6, F-fig6-beyond, F-fig6-values, F-fig7, F-fig7-beyond, F-fig8, F-fig9, F-fig9-beyond, S-beyond-robots, S-beyond-swing, S-eq11, S-eq7, S-eq7-phi, S-eq8, S-eq9, S-fig1, S-fig2, S-fig3, S-fig4, S-fig5, S-kappa");
    assert!(!folder.exists());
}

#[test]
fn folders_that_will_not_do() {
    let scratch = Scratch::new();
    let file = scratch.file("file", "precious");
    assert_snapshot!(refused(&["F-fig2"], &file), @"error: FOLDER: not a folder");
    assert_snapshot!(refused(&["F-fig2"], &format!("{file}/out")), @"error: FOLDER: the folder cannot be made: not a directory");
    let folder = Path::new(&file).parent().unwrap().to_str().unwrap().to_owned();
    assert_snapshot!(refused(&["F-fig2"], &folder), @"error: FOLDER: the folder is not empty; --force writes into it all the same");
    assert_eq!(files(Path::new(&folder)), ["file".to_owned()].into());

    // With --force it is written to, and what was there stays.
    stdout(&["reproduce", "F-fig2", "--force", "-o", &folder]);
    assert!(files(Path::new(&folder)).contains("F-fig2.svg"));
    assert_eq!(std::fs::read_to_string(&file).unwrap(), "precious");
}

/// What a run that was ended has left is taken up; it holds its own files alone.
#[test]
fn a_run_goes_on_in_its_own_folder() {
    let scratch = Scratch::new();
    let folder = scratch.path("out");
    let call = ["reproduce", "F-fig2", "--quick", "-o", folder.to_str().unwrap()];
    stdout(&call);
    std::fs::remove_file(folder.join("index.html")).unwrap();
    std::fs::write(folder.join(".tmpAbCdEf"), "half").unwrap();
    stdout(&call);
    assert!(folder.join("index.html").exists());
    std::fs::write(folder.join("F-fig2.txt"), "notes").unwrap();
    assert!(failure(&call).contains("not empty"));
}

/// An output cannot take its final name: the run ends with a message and no half-written file stands under any final name.
#[test]
fn what_cannot_be_written_leaves_nothing_half_written() {
    let scratch = Scratch::new();
    let folder = scratch.path("out");
    // A folder stands where a file should go.
    std::fs::create_dir_all(folder.join("F-fig2.svg")).unwrap();
    let output = run(&["reproduce", "F-fig2", "--force", "-o", folder.to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(2));
    let message = String::from_utf8(output.stderr).unwrap();
    assert!(message.contains("F-fig2.svg"), "{message}");
    assert_eq!(files(&folder), ["F-fig2.csv", "F-fig2.svg"].map(str::to_owned).into());
}

/// Killed in the middle of a run: every file under a final name is whole.
#[test]
fn an_interrupted_run_leaves_whole_files() {
    let scratch = Scratch::new();
    let folder = scratch.path("out");
    let mut child = std::process::Command::new(env!("CARGO_BIN_EXE_eigenbody"))
        .args([
            "reproduce",
            "F-fig9",
            "F-fig10",
            "F-fig16",
            "F-fig20",
            "F-fig21",
            "S-fig3",
            "S-fig4",
            "S-fig5",
        ])
        .args(["-o", folder.to_str().unwrap()])
        .stdout(std::process::Stdio::null())
        .stderr(std::process::Stdio::null())
        .spawn()
        .unwrap();
    while !folder.is_dir() || files(&folder).len() < 4 {
        assert!(child.try_wait().unwrap().is_none(), "ended by itself");
        std::thread::yield_now();
    }
    child.kill().unwrap();
    child.wait().unwrap();
    for name in files(&folder).iter().filter(|name| !name.starts_with('.')) {
        let bytes = std::fs::read(folder.join(name)).unwrap();
        let whole = match name.rsplit('.').next() {
            Some("svg") => bytes.ends_with(b"</svg>\n"),
            Some("png") => bytes.ends_with(b"IEND\xaeB`\x82"),
            _ => bytes.ends_with(b"\n"),
        };
        assert!(whole, "{name}");
    }
    assert!(!folder.join("index.html").exists() && !folder.join("claims.json").exists());
}

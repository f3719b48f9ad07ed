use crate::run::{Scratch, failure, json, run, stdout};

/// A neck whose first and last axis align at roll = 0, with nothing between.
const NECK: &str = r#"<robot name="neck">
<link name="base"/><link name="first"/><link name="second"/>
<link name="head"><inertial><origin xyz="0.2 0 0.1"/><mass value="1"/>
<inertia ixx="0.01" ixy="0" ixz="0" iyy="0.02" iyz="0" izz="0.025"/></inertial></link>
<joint name="yaw" type="continuous"><parent link="base"/><child link="first"/><axis xyz="0 0 1"/></joint>
<joint name="roll" type="continuous"><parent link="first"/><child link="second"/><axis xyz="1 0 0"/></joint>
<joint name="twist" type="continuous"><parent link="second"/><child link="head"/><axis xyz="0 0 1"/></joint>
</robot>"#;

/// A link with 0.5 kg.
const SOLID: &str = r#"<link name="first"><inertial><mass value="0.5"/>
<inertia ixx="0.001" ixy="0" ixz="0" iyy="0.001" iyz="0" izz="0.001"/></inertial></link>"#;

#[test]
fn a_clean_bill_of_health() {
    let page = stdout(&["check", "puma560", "--samples", "64"]);
    assert!(page.contains("Nothing found"), "{page}");
    assert!(page.lines().count() <= 10, "{page}");
}

#[test]
fn findings_end_with_status_1_and_fit_one_screen() {
    let scratch = Scratch::new();
    let path = scratch.file("neck.urdf", NECK);
    let output = run(&["check", &path, "--samples", "128"]);
    assert_eq!(output.status.code(), Some(1));
    let page = String::from_utf8(output.stdout).unwrap();
    assert!(page.lines().count() <= 40 && page.lines().all(|line| line.chars().count() <= 100), "{page}");
    for words in ["warning[solves]", "'yaw' and 'twist' turn about nearly the same line", "help:"] {
        assert!(page.contains(words), "{words}: {page}");
    }
    assert_eq!(run(&["check", &path, "--samples", "64", "--fail-on", "error"]).status.code(), Some(0));
}

#[test]
fn json_says_where() {
    let report = json(&["check", "hydra(5,1,0,1)", "--samples", "64", "--format", "json"]);
    let worst = &report["worst"][0];
    assert_eq!(worst["measure"], "kappa");
    let q: Vec<f64> = worst["q"].as_array().unwrap().iter().map(|q| q.as_f64().unwrap()).collect();
    let at = format!("q={q:?}");
    let there = json(&["spectrum", "hydra(5,1,0,1)", "--at", &at, "--json"]);
    let (found, again) = (worst["worst"].as_f64().unwrap(), there["kappa"].as_f64().unwrap());
    assert!((found / again - 1.0).abs() < 1e-12, "{found} {again}");
}

#[test]
fn advice_mends_what_it_says() {
    let scratch = Scratch::new();
    let (path, patch) = (scratch.file("neck.urdf", NECK), scratch.path("mended.xml"));
    let patch = patch.to_str().unwrap();
    let call = [
        "check",
        &path,
        "--samples",
        "128",
        "--want-kappa",
        "1e4",
        "--write-patch",
        patch,
        "--format",
        "json",
    ];
    let output = run(&call);
    let report: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let advice = &report["advice"];
    assert!(advice["reached"].as_f64().unwrap() <= 1e4, "{advice}");
    let mended = json(&["check", patch, "--samples", "128", "--format", "json", "--max-kappa", "1e4"]);
    assert_eq!(mended["findings"].as_array().unwrap().len(), 0, "{}", mended["findings"]);
}

/// A step that is too long, what makes it stable, and the copy of the model in which it is.
#[test]
fn a_step_is_judged_and_mended() {
    let scratch = Scratch::new();
    let path = scratch.file("neck.urdf", &NECK.replace("<link name=\"first\"/>", SOLID));
    let own =
        ["check", &path, "--samples", "128", "--kp", "yaw=40,twist=20", "--kd", "1", "--format", "json"];
    let report = json(&[&own[..], &["--dt", "0.02", "--fail-on", "never"]].concat());
    let limit = report["stepping"]["limits"][0]["largest"].as_f64().unwrap();
    assert_eq!(report["stepping"]["limits"][0]["integrator"], "semi-implicit Euler");
    assert!(limit < 0.02, "{limit}");
    assert_eq!(report["findings"].as_array().unwrap().last().unwrap()["id"], "time-step");
    let page = stdout(&[&own[..8], &["--dt", "1e-4"]].concat());
    assert!(page.contains("largest stable step: semi-implicit Euler"), "{page}");
    for (patch, rotors) in [("mended.xml", "off"), ("mended.urdf", "on")] {
        let patch = scratch.path(patch);
        let patch = patch.to_str().unwrap();
        json(&[&own[..], &["--want-step", "0.02", "--write-patch", patch, "--fail-on", "never"]].concat());
        let again =
            ["check", patch, "--samples", "128", "--kp", "yaw=40,twist=20", "--kd", "1", "--rotors", rotors];
        let mended = json(
            &[&again[..], &["--dt", "0.02", "--integrator", "semi-implicit", "--format", "json"]].concat(),
        );
        let reached = mended["stepping"]["limits"][0]["largest"].as_f64().unwrap();
        assert!(reached >= 0.02, "{patch}: {reached}");
    }
}

/// What else would do: a limit on the joint between, a link's inertia; and a copy with each.
#[test]
fn other_remedies() {
    let scratch = Scratch::new();
    let light = SOLID.replace("0.5", "1e-6").replace("0.001", "1e-9");
    let neck = NECK.replace("<link name=\"first\"/>", &light);
    let limited = neck.replace(
        "name=\"roll\" type=\"continuous\">",
        "name=\"roll\" type=\"revolute\"><limit lower=\"-0.3\" upper=\"1.2\" effort=\"1\" velocity=\"1\"/>",
    );
    let path = scratch.file("neck.urdf", &limited);
    for remedy in ["limit", "link", "armature"] {
        let patch = scratch.path(&format!("{remedy}.urdf"));
        let patch = patch.to_str().unwrap();
        let call = [
            "check",
            &path,
            "--samples",
            "128",
            "--want-kappa",
            "3000",
            "--fail-on",
            "never",
            "--format",
            "json",
        ];
        let advice =
            json(&[&call[..], &["--remedy", remedy, "--write-patch", patch]].concat())["advice"].clone();
        assert_eq!(advice["limits"][0]["joint"], "roll", "{advice}");
        let mended = json(&[
            "check",
            patch,
            "--samples",
            "128",
            "--rotors",
            "on",
            "--fail-on",
            "never",
            "--format",
            "json",
        ]);
        let kappa = mended["worst"][0]["worst"].as_f64().unwrap();
        assert!(kappa <= 3000.0 * 1.001, "{remedy}: {kappa}");
    }
}

/// A copy in the model's own format is its own text but for the change; in another folder that is said.
#[test]
fn a_copy_keeps_what_the_file_has() {
    let scratch = Scratch::new();
    let seen = "<link name=\"first\"><visual><geometry><sphere radius=\"0.1\"/></geometry></visual></link>";
    let text = NECK.replace("<link name=\"first\"/>", seen);
    let (path, beside) = (scratch.file("neck.urdf", &text), scratch.path("mended.urdf"));
    let away = scratch.path("away");
    std::fs::create_dir(&away).unwrap();
    let mut call = [
        "check",
        &path,
        "--samples",
        "128",
        "--want-kappa",
        "1e4",
        "--fail-on",
        "never",
        "--write-patch",
        "",
    ];
    let notes = |call: &[&str]| {
        let output = run(call);
        assert_eq!(output.status.code(), Some(0));
        String::from_utf8(output.stderr).unwrap().lines().filter(|line| line.starts_with("note: ")).count()
    };
    call[9] = beside.to_str().unwrap();
    assert_eq!(notes(&call), 1);
    let away = away.join("mended.urdf");
    call[9] = away.to_str().unwrap();
    assert_eq!(notes(&call), 2);
    let copy = std::fs::read_to_string(&beside).unwrap();
    assert_eq!(copy, std::fs::read_to_string(&away).unwrap());
    let (rest, rotors) = copy.split_once("  <transmission").unwrap();
    let rest = rest.replace(" xmlns:drake=\"http://drake.mit.edu\"", "");
    assert!(
        rest.contains(seen) && text.starts_with(&rest) && text[rest.len()..].trim() == "</robot>",
        "{copy}"
    );
    assert!(rotors.contains("rotor_inertia"), "{copy}");
}

#[test]
fn bad_input() {
    insta::assert_snapshot!(failure(&["check", "puma560", "--want-kappa", "9", "--write-patch", "x.sdf"]), @"error: --write-patch x.sdf: expected a file named .urdf or .xml (MJCF)");
    insta::assert_snapshot!(failure(&["check", "puma560", "--want-kappa", "0"]), @"error: --want-kappa 0: expected a positive number");
    insta::assert_snapshot!(failure(&["check", "puma560", "--want-kappa", "0.5"]), @"error: puma560: nothing was found that does what is wanted");
    insta::assert_snapshot!(failure(&["check", "puma560", "--write-patch", "x.xml"]), @"error: --write-patch: say what is wanted, --want-kappa, --want-lambda-min or --want-step");
    insta::assert_snapshot!(failure(&["check", "puma560", "--dt", "0"]), @"error: --dt 0: expected a positive number");
    insta::assert_snapshot!(failure(&["check", "puma560", "--kp", "wing=3"]), @"error: --kp wing=3, column 1: no moving joint is named 'wing'");
    insta::assert_snapshot!(failure(&["check", "puma560", "--kd", "-3"]), @"error: --kd -3, column 1: gain -3, expected none below zero");
    insta::assert_snapshot!(failure(&["check", "puma560", "--want-step", "0.01"]), @"error: --want-step: the file has no stiffness, damping or gains; give --kp and --kd");
    insta::assert_snapshot!(failure(&["check", "puma560", "--want-step", "0.01", "--kp", "1", "--integrator", "rk4"]), @"error: --want-step is for methods of Euler's kind; choose one with --integrator");
    insta::assert_snapshot!(failure(&["check", "puma560", "--max-kappa", "-1"]), @"error: --max-kappa -1: expected a positive number");
    insta::assert_snapshot!(failure(&["check", "no/such/robot.urdf"]), @"error: no/such/robot.urdf: no such file");
    insta::assert_snapshot!(failure(&["check", "puma560", "--metric", "diagonal=[1]"]), @"error: puma560: B has 1 number, expected 6");
}

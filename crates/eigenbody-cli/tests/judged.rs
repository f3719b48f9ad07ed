//! What `check` is held against and how it is kept: SARIF, baselines, settings, exit status.

use crate::run::{Scratch, failure, run};
use insta::assert_snapshot;
use serde_json::{Value, json};

/// Two joints; the second carries `mass` at half a metre. Far too little of it is a finding.
fn arm(mass: f64) -> String {
    format!(
        r#"<robot name="arm">
<link name="base"/>
<link name="upper"><inertial><origin xyz="0.5 0 0"/><mass value="5"/>
<inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial></link>
<link name="tip"><inertial><origin xyz="0.5 0 0"/><mass value="{mass:e}"/>
<inertia ixx="{i:e}" ixy="0" ixz="0" iyy="{i:e}" iyz="0" izz="{i:e}"/></inertial></link>
<joint name="shoulder" type="continuous"><parent link="base"/><child link="upper"/><axis xyz="0 0 1"/></joint>
<joint name="elbow" type="continuous"><parent link="upper"/><child link="tip"/><origin xyz="1 0 0"/><axis xyz="0 0 1"/></joint>
</robot>"#,
        i = 0.1 * mass
    )
}

/// Status and standard output of `check MODEL` with some more words.
fn check(model: &str, more: &[&str]) -> (i32, String) {
    let output = run(&[&["check", model, "--samples", "64"], more].concat());
    let talk = String::from_utf8_lossy(&output.stderr).into_owned();
    (
        output.status.code().unwrap(),
        if output.stdout.is_empty() { talk } else { String::from_utf8(output.stdout).unwrap() },
    )
}

fn sarif(model: &str, more: &[&str]) -> Value {
    serde_json::from_str(&check(model, &[&["--format", "sarif"], more].concat()).1).unwrap()
}

/// What the standard asks of a log (SARIF 2.1.0, §3.13, §3.14, §3.27): required properties, and values from its lists.
fn assert_valid(log: &Value) {
    assert_eq!((log["version"].as_str(), log["runs"].as_array().unwrap().len()), (Some("2.1.0"), 1));
    assert!(log["$schema"].as_str().unwrap().ends_with("sarif-2.1.0.json"));
    let run = &log["runs"][0];
    let driver = &run["tool"]["driver"];
    assert!(driver["name"].is_string() && driver["version"].is_string());
    assert!(["utf16CodeUnits", "unicodeCodePoints"].contains(&run["columnKind"].as_str().unwrap()));
    assert_eq!(run["invocations"][0]["executionSuccessful"], true);
    let rules = driver["rules"].as_array().unwrap();
    assert!(rules.iter().all(|rule| rule["id"].is_string() && rule["shortDescription"]["text"].is_string()));
    for result in run["results"].as_array().unwrap() {
        let index = result["ruleIndex"].as_u64().unwrap() as usize;
        assert_eq!(rules[index]["id"], result["ruleId"]);
        assert!(["none", "note", "warning", "error"].contains(&result["level"].as_str().unwrap()));
        assert!(result["message"]["text"].as_str().unwrap().ends_with('.'));
        assert!(result["partialFingerprints"]["eigenbody/v1"].is_string());
        for location in result["locations"].as_array().unwrap() {
            if let Some(physical) = location.get("physicalLocation") {
                let uri = physical["artifactLocation"]["uri"].as_str().unwrap();
                assert!(!uri.contains(' ') && (!uri.starts_with('/')), "{uri}");
                assert!(physical["region"]["startLine"].as_u64().unwrap() >= 1);
                assert!(physical["region"]["startColumn"].as_u64().unwrap() >= 1);
            }
        }
        if let Some(state) = result.get("baselineState") {
            assert!(["new", "unchanged", "updated", "absent"].contains(&state.as_str().unwrap()));
        }
    }
}

/// The line of a result by its rule.
fn line(log: &Value, rule: &str) -> Option<u64> {
    let results = log["runs"][0]["results"].as_array().unwrap();
    let found = results.iter().find(|result| result["ruleId"] == rule)?;
    found["locations"][0]["physicalLocation"]["region"]["startLine"].as_u64()
}

/// The joint to blame, at its line, in each format; and a link's own finding at the link's.
#[test]
fn sarif_points_at_lines() {
    let scratch = Scratch::new();
    let urdf = scratch.file("my arm.urdf", &arm(1e-10).replace("izz=\"0.1\"", "izz=\"0.9\""));
    let log = sarif(&urdf, &[]);
    assert_valid(&log);
    assert_eq!((line(&log, "gains"), line(&log, "triangle-inequality")), (Some(8), Some(3)));
    let uri =
        log["runs"][0]["results"][0]["locations"][0]["physicalLocation"]["artifactLocation"]["uri"].as_str();
    assert!(uri.unwrap().ends_with("/my%20arm.urdf") && uri.unwrap().starts_with("file:///"), "{uri:?}");

    let mjcf = scratch.file(
        "arm.xml",
        "<mujoco><worldbody>\n<body><joint axis='0 0 1'/><geom size='.1' pos='.5 0 0' mass='5'/>\n<body pos='1 0 0'>\n  \
         <joint name='elbow' axis='0 0 1'/><inertial pos='.5 0 0' mass='1e-10' diaginertia='1e-11 1e-11 1e-11'/></body></body></worldbody></mujoco>",
    );
    let log = sarif(&mjcf, &[]);
    assert_valid(&log);
    assert_eq!(line(&log, "gains"), Some(4), "{log}");

    let link = |name: &str, mass: f64| {
        format!(
            "<link name='{name}'><inertial><pose>.5 0 0 0 0 0</pose><mass>{mass:e}</mass><inertia><ixx>{i:e}</ixx><iyy>{i:e}</iyy><izz>{i:e}</izz></inertia></inertial></link>\n",
            i = 0.1 * mass
        )
    };
    let joint = |name: &str, parent: &str, child: &str| {
        format!(
            "<joint name='{name}' type='revolute'><parent>{parent}</parent><child>{child}</child><axis><xyz>0 0 1</xyz></axis></joint>\n"
        )
    };
    let parts = link("a", 5.0) + &link("b", 1e-10) + &joint("ja", "world", "a") + &joint("jb", "a", "b");
    let sdf = scratch.file("arm.sdf", &format!("<sdf version='1.9'><model name='m'>\n{parts}</model></sdf>"));
    let log = sarif(&sdf, &[]);
    assert_valid(&log);
    assert_eq!(line(&log, "gains"), Some(5), "{log}");
    // A robot without a file has no lines, and one without findings no results.
    let log = sarif("puma560", &[]);
    assert_valid(&log);
    assert_eq!(log["runs"][0]["results"], json!([]));
}

/// New, worse, as before, gone: on the page, in JSON, in SARIF, and in the exit status.
#[test]
fn baselines() {
    let scratch = Scratch::new();
    let path = scratch.file("arm.urdf", &arm(1e-10));
    let old = scratch.path("old.json");
    let old = old.to_str().unwrap();
    assert_eq!(check(&path, &["--format", "json", "-o", old]).0, 1);
    let against = |more: &[&str]| check(&path, &[&["--baseline", old], more].concat());
    // The same robot: its findings are known.
    let (status, page) = against(&[]);
    assert!(status == 0 && page.contains("0 new, 0 worse, 1 finding as before, 0 gone"), "{page}");
    let states = |text: &str| -> Value {
        serde_json::from_str::<Value>(text).unwrap()["comparison"]["findings"].clone()
    };
    assert_eq!(states(&against(&["--format", "json"]).1), json!(["unchanged"]));
    // Ten times less mass: worse.
    scratch.file("arm.urdf", &arm(1e-11));
    let (status, page) = against(&[]);
    assert!(status == 1 && page.contains("0 new, 1 worse"), "{page}");
    assert_eq!(states(&against(&["--format", "json"]).1), json!(["worse"]));
    let log = sarif(&path, &["--baseline", old]);
    assert_valid(&log);
    assert_eq!(log["runs"][0]["results"][0]["baselineState"], "updated");
    // Better, and still a finding.
    scratch.file("arm.urdf", &arm(3e-10));
    assert_eq!(against(&[]).0, 0);
    // Mended: gone.
    scratch.file("arm.urdf", &arm(1.0));
    let (status, page) = against(&[]);
    assert!(
        status == 0
            && page.contains("0 new, 0 worse, 0 findings as before, 1 gone")
            && page.contains("gone: gains"),
        "{page}"
    );
    let log = sarif(&path, &["--baseline", old]);
    assert_valid(&log);
    assert_eq!(log["runs"][0]["results"][0]["baselineState"], "absent");
    // The other way about it is new.
    let good = scratch.path("good.json");
    let good = good.to_str().unwrap();
    check(&path, &["--format", "json", "-o", good]);
    scratch.file("arm.urdf", &arm(1e-10));
    let (status, page) = check(&path, &["--baseline", good]);
    assert!(status == 1 && page.contains("1 new"), "{page}");
}

#[test]
fn a_baseline_must_be_one() {
    let scratch = Scratch::new();
    let other = scratch.file("other.json", "{\n \"worst\": 3}");
    let message = failure(&["check", "puma560", "--baseline", &other]);
    let place = "other.json:2:11: no report of `eigenbody check --format json`: invalid type: integer `3`";
    assert!(message.contains(place), "{message}");
    assert!(failure(&["check", "puma560", "--baseline", "no.json"]).starts_with("error: no.json: "));
}

#[test]
fn what_fails_is_a_choice() {
    let scratch = Scratch::new();
    let path = scratch.file("arm.urdf", &arm(1e-10).replace("izz=\"0.1\"", "izz=\"0.9\""));
    let status = |fail_on: &str| check(&path, &["--fail-on", fail_on]).0;
    let found =
        ["note", "warning", "error", "never", "gains", "solves", "triangle-inequality", "solves,gains"]
            .map(status);
    assert_eq!(found, [1, 1, 0, 0, 1, 0, 1, 1]);
    let output = run(&["check", &path, "--fail-on", "gain"]);
    assert_eq!(output.status.code(), Some(2));
    let message = String::from_utf8(output.stderr).unwrap();
    assert!(message.contains("no level or finding is called 'gain'"), "{message}");
}

/// Beside the model or above it, or by name; options win.
#[test]
fn settings_are_found() {
    let scratch = Scratch::new();
    std::fs::create_dir_all(scratch.path("robots/arms")).unwrap();
    let path = scratch.file("robots/arms/arm.urdf", &arm(1e-3));
    assert_eq!(check(&path, &[]).0, 0);
    scratch.file("eigenbody.toml", "[check]\nmax-kappa = 10\n");
    assert_eq!(check(&path, &[]).0, 1);
    assert_eq!(check(&path, &["--max-kappa", "1e9"]).0, 0);
    // The nearest counts, alone.
    scratch.file("robots/eigenbody.toml", "[check]\nmax-kappa = 10\nfail-on = \"error\"\n");
    assert_eq!(check(&path, &[]).0, 0);
    assert_eq!(check(&path, &["--fail-on", "warning"]).0, 1);
    // Gains, step and integrator as well: 0.1 s is far too long for 10,000 N m/rad on this arm.
    let driven =
        scratch.file("driven.toml", "[check]\nkp = 1e4\nkd = \"elbow=1\"\ndt = 0.1\nintegrator = \"rk4\"\n");
    let (status, page) = check(&path, &["--config", &driven]);
    assert!(status == 1 && page.contains("warning[time-step]"), "{page}");
    assert_eq!(check(&path, &["--config", &driven, "--dt", "1e-9"]).0, 0);
    let named = scratch.file("strict.toml", "[check]\nmax-kappa = 1e7\n");
    assert_eq!(check(&path, &["--config", &named]).0, 0);
}

#[test]
fn faults_of_settings_are_located() {
    let scratch = Scratch::new();
    let fault = |text: &str| {
        let path = scratch.file("s.toml", text);
        failure(&["check", "puma560", "--config", &path]).replace(&path, "s.toml")
    };
    assert_snapshot!(fault("[check]\nmax-kapa = 3\n"), @"error: s.toml:2:1: unknown field `max-kapa`, expected one of `metric`, `samples`, `seed`, `max-kappa-weighted`, `max-kappa`, `f32-digits`, `kp`, `kd`, `dt`, `integrator`, `fail-on`");
    assert_snapshot!(fault("[check]\nmax-kappa = -3\n"), @"error: s.toml:2:13: max-kappa = -3: expected a positive number");
    assert_snapshot!(fault("[check]\nmax-kappa = \"big\"\n"), @r#"error: s.toml:2:13: invalid type: string "big", expected f64"#);
    assert_snapshot!(fault("[check]\nsamples = 0\n"), @"error: s.toml:2:11: samples = 0: expected 1 to 65536");
    assert_snapshot!(fault("[check]\n\nmetric = \"manhattan\"\n"), @"error: s.toml:3:10: manhattan, column 1: no metric; expected euclidean, unit-diagonal, length=L or diagonal=[..]");
    assert!(fault("[check\n").starts_with("error: s.toml:1:"));
    assert!(
        fault("[check]\nfail-on = \"gain\"\n")
            .starts_with("error: s.toml:2:11: no level or finding is called 'gain'")
    );
    assert_snapshot!(failure(&["check", "puma560", "--config", "no/such.toml"]), @"error: no/such.toml: No such file or directory (os error 2)");
}

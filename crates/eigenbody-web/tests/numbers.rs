//! The page's numbers are the library's, which are the command line's.

use crate::client::Running;
use eigenbody::conditioning_at;
use eigenbody::{Question, Reduction, mass_matrix};
use eigenbody_formats::{LoadOptions, load, load_text};
use eigenbody_report::DiagnosisReport;
use eigenbody_study::diagnosis::{self, Drive, diagnose};
use serde_json::{Value, json};
use std::ops::ControlFlow::Continue;

const ARM: &str = r#"<robot name="arm">
  <link name="base"/>
  <link name="upper"><inertial><origin xyz="0.2 0 0"/><mass value="2"/><inertia ixx="0.01" ixy="0" ixz="0" iyy="0.03" iyz="0" izz="0.03"/></inertial></link>
  <link name="fore"><inertial><origin xyz="0.1 0 0"/><mass value="0.5"/><inertia ixx="0.001" ixy="0" ixz="0" iyy="0.002" iyz="0" izz="0.002"/></inertial></link>
  <link name="hand"><inertial><mass value="0.1"/><inertia ixx="1e-4" ixy="0" ixz="0" iyy="1e-4" iyz="0" izz="1e-4"/></inertial></link>
  <joint name="shoulder" type="revolute"><parent link="base"/><child link="upper"/><axis xyz="0 0 1"/><limit lower="-1" upper="2"/></joint>
  <joint name="elbow" type="revolute"><parent link="upper"/><child link="fore"/><origin xyz="0.4 0 0"/><axis xyz="0 1 0"/><limit lower="0" upper="2.5"/></joint>
  <joint name="grip" type="prismatic"><parent link="fore"/><child link="hand"/><origin xyz="0.3 0 0"/><axis xyz="1 0 0"/>
    <limit lower="-0.1" upper="0.1"/><mimic joint="elbow" multiplier="0.05" offset="0.01"/></joint>
</robot>"#;

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect()
}

#[test]
fn an_evaluation_has_the_bits_of_the_library() {
    let server = Running::new();
    for family in [
        "hydra(9, 1.5, 0.4, 0.9)",
        "onion(50, 1, 0.2, 1)",
        "auto_tree(11, 1.5, 0.3, 0.9)",
        "hydra(200, 1, 0, 1)",
    ] {
        let model = server.model(&json!({ "family": family }));
        let loaded = load(family, &LoadOptions::default()).unwrap();
        let q = loaded.configuration("random(5)", true).unwrap();
        let at = server.ask("/api/pose", &json!({ "id": model["id"], "at": "random(5)" }));
        assert_eq!(numbers(&at["q"]), q);
        let want = json!(["numbers", "modes", "eigenvalues", "matrix"]);
        let found =
            server.ask("/api/evaluate", &json!({ "id": model["id"], "q": q, "want": want, "pool": 256 }));
        let question = Question { all: true, ..Question::default() };
        let expected = conditioning_at(&loaded.model, &q, &question).unwrap();
        assert_eq!(found["kappa"].as_f64(), expected.kappa, "{family}");
        assert_eq!(found["kappa_weighted"].as_f64(), expected.kappa_weighted);
        assert_eq!(found["lambda_min"].as_f64(), expected.lambda_min);
        assert_eq!(found["lambda_max"].as_f64(), expected.lambda_max);
        let (lower, upper) = expected.bracket.unwrap();
        assert_eq!(numbers(&found["bracket"]), [lower, upper]);
        assert_eq!(numbers(&found["eigenvalues"]), expected.eigenvalues.unwrap());
        assert_eq!(numbers(&found["softest"]["vector"]), expected.softest.unwrap());
        assert_eq!(numbers(&found["stiffest"]["vector"]), expected.stiffest.unwrap());
        let total: f64 = numbers(&found["stiffest"]["share"]).iter().sum();
        // n ε of a sum of one.
        assert!((total - 1.0).abs() < 1e-13, "{total}");
        let H = mass_matrix(&loaded.model, &q).unwrap();
        let single: Vec<f64> = H.as_slice().iter().map(|&x| f64::from(x as f32)).collect();
        let shown: Vec<f64> =
            numbers(&found["matrix"]["values"]).iter().map(|&x| f64::from(x as f32)).collect();
        assert_eq!(shown, single, "{family}");
    }
}

/// Every block shows its entry of largest magnitude.
#[test]
fn a_large_matrix_is_pooled() {
    let server = Running::new();
    let model = server.model(&json!({ "family": "hydra(50, 1, 0.7, 1)" }));
    let q = server.ask("/api/pose", &json!({ "id": model["id"], "at": "random(1)" }))["q"].clone();
    let found = server
        .ask("/api/evaluate", &json!({ "id": model["id"], "q": q, "want": ["matrix"], "pool": 8 }))["matrix"]
        .clone();
    assert_eq!((&found["rows"], &found["pooled"], &found["size"]), (&json!(50), &json!(7), &json!(8)));
    let loaded = load("hydra(50, 1, 0.7, 1)", &LoadOptions::default()).unwrap();
    let H = mass_matrix(&loaded.model, &numbers(&q)).unwrap();
    for (k, shown) in numbers(&found["values"]).into_iter().enumerate() {
        let rows = |k: usize| k * 7..50.min(k * 7 + 7);
        let block = rows(k / 8).flat_map(|i| rows(k % 8).map(move |j| (i, j)));
        let largest = block.map(|ij| H[ij]).fold(0.0, |m: f64, x| if x.abs() > m.abs() { x } else { m });
        assert_eq!(shown as f32, largest as f32);
    }
}

#[test]
fn followers_follow() {
    let server = Running::new();
    let model = server.model(&json!({ "text": ARM, "name": "arm.urdf" }));
    assert_eq!(model["joints"][2]["follows"], "elbow");
    assert_eq!(model["rows"], json!([0, 1]));
    let found = server.ask("/api/evaluate", &json!({ "id": model["id"], "q": [0.3, 1.0, 99.0] }));
    assert_eq!(numbers(&found["q"]), [0.3, 1.0, 0.05 + 0.01]);
    assert_eq!(found["softest"]["vector"].as_array().unwrap().len(), 2);
    let loaded = load_text(ARM, "arm.urdf", &LoadOptions::default()).unwrap();
    let reduction = Reduction { mimic: true, base: false };
    let question = Question { reduction, ..Question::default() };
    let expected = conditioning_at(&loaded.model, &[0.3, 1.0, 0.05 + 0.01], &question).unwrap();
    assert_eq!(found["kappa"].as_f64(), expected.kappa);
    let free = json!({ "source": { "text": ARM, "name": "arm.urdf" }, "options": { "mimic": false } });
    let free = server.ask("/api/model", &free);
    assert_eq!(free["rows"], json!([0, 1, 2]));
    let over = json!({ "id": model["id"], "q": model["q0"], "dofs": [0, 2] });
    assert!(server.post("/api/map", &over).message().contains("'grip' follows another"));
}

/// Boxes of even density at the poses have the robot's mass and inertia: the kinetic energy of a turn about the first joint is H₁₁/2.
#[test]
fn boxes_at_their_places_have_the_first_inertia() {
    let server = Running::new();
    let model = server.model(&json!({ "text": ARM, "name": "arm.urdf" }));
    let found = server.ask(
        "/api/evaluate",
        &json!({ "id": model["id"], "q": [0.4, 0.9, 0.0], "want": ["places", "matrix"] }),
    );
    let turn = |[w, x, y, z]: [f64; 4], v: [f64; 3]| -> [f64; 3] {
        let cross = |a: [f64; 3], b: [f64; 3]| {
            [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
        };
        let u = [x, y, z];
        let t = cross(u, v).map(|c| 2.0 * c);
        let ut = cross(u, t);
        [0, 1, 2].map(|k| v[k] + w * t[k] + ut[k])
    };
    let apply = |pose: &[f64], p: [f64; 3]| {
        let turned = turn([pose[3], pose[4], pose[5], pose[6]], p);
        [0, 1, 2].map(|k| pose[k] + turned[k])
    };
    let mut about_z = 0.0;
    for (body, place) in model["bodies"].as_array().unwrap().iter().zip(found["places"].as_array().unwrap()) {
        let (place, frame, half) =
            (numbers(place), numbers(&body["box"]["pose"]), numbers(&body["box"]["half"]));
        // Eight points at half-edges over √3 have the box's second moments.
        for corner in 0..8 {
            let p = [0, 1, 2].map(|k| half[k] / 3f64.sqrt() * if corner >> k & 1 == 1 { 1.0 } else { -1.0 });
            let [x, y, _] = apply(&place, apply(&frame, p));
            about_z += body["mass"].as_f64().unwrap() / 8.0 * (x * x + y * y);
        }
    }
    let H11 = found["matrix"]["values"][0].as_f64().unwrap();
    // 16 ε of single precision in poses and sizes.
    assert!((about_z / H11 - 1.0).abs() < 16.0 * f64::from(f32::EPSILON), "{about_z} {H11}");
}

#[test]
fn a_path_and_a_map_meet_the_evaluations() {
    let server = Running::new();
    let model = server.model(&json!({ "family": "hydra(4, 1, 0.3, 1)" }));
    let id = &model["id"];
    let kappa =
        |q: &Value| server.ask("/api/evaluate", &json!({ "id": id, "q": q }))["kappa"].as_f64().unwrap();
    let (from, to) = (json!([0.1, 0.2, 0.3, 0.4]), json!([1.0, -2.0, 0.5, 0.0]));
    let path = server.ask("/api/path", &json!({ "id": id, "from": from, "to": to, "points": 5 }));
    let (t, along) = (numbers(&path["t"]), numbers(&path["kappa"]));
    assert_eq!(t, [0.0, 0.25, 0.5, 0.75, 1.0]);
    for k in 0..5 {
        let q = server.ask("/api/move", &json!({ "id": id, "q": from, "to": to, "t": t[k] }))["q"].clone();
        // Counts alone against the dense solver: 100 n ε κ.
        let expected = kappa(&q);
        assert!((along[k] / expected - 1.0).abs() < 400.0 * f64::EPSILON * expected, "{k}");
    }
    let map = server.ask("/api/map", &json!({ "id": id, "q": from, "dofs": [1, 3], "resolution": 4 }));
    let (x, y) = (numbers(&map["x"]), numbers(&map["y"]));
    assert_eq!((x[0], x[3]), (-std::f64::consts::PI, std::f64::consts::PI));
    for (row, y) in map["kappa"].as_array().unwrap().iter().zip(y) {
        for (shown, x) in numbers(row).into_iter().zip(&x) {
            let expected = kappa(&json!([0.1, x, 0.3, y]));
            assert!((shown / expected - 1.0).abs() < 2.0 * f64::from(f32::EPSILON), "{x} {y}");
        }
    }
}

#[test]
fn a_check_is_that_of_the_command_line() {
    let server = Running::new();
    let model = server.model(&json!({ "text": ARM, "name": "arm.urdf" }));
    let found = server.ask("/api/check", &json!({ "id": model["id"], "samples": 256 }));
    let loaded = load_text(ARM, "arm.urdf", &LoadOptions::default()).unwrap();
    let reduction = Reduction { mimic: true, base: false };
    let question =
        diagnosis::Question { reduction, drive: Drive::of(&loaded), ..diagnosis::Question::default() };
    let effort = eigenbody::search::Effort { samples: 256, ..question.effort };
    let expected =
        diagnose(&loaded.model, &diagnosis::Question { effort, ..question }, |_| Continue(())).unwrap();
    let report = DiagnosisReport::of("arm.urdf", &loaded, &expected);
    assert_eq!(found, serde_json::to_value(report).unwrap());
}

/// What is saved is what was seen: read again, the edited robot has the same κ.
#[test]
fn a_patch_is_the_edited_robot() {
    let server = Running::new();
    let edits = json!({ "armature": { "elbow": 0.25 }, "mass": { "fore": 1.5 } });
    let source = json!({ "text": ARM, "name": "arm.urdf" });
    let options = json!({ "mimic": false });
    let plain = server.ask("/api/model", &json!({ "source": source, "options": options }));
    let edited = server.ask("/api/model", &json!({ "source": source, "options": options, "edits": edits }));
    let q = json!([0.2, 0.7, 0.05]);
    let kappa =
        |id: &Value| server.ask("/api/evaluate", &json!({ "id": id, "q": q }))["kappa"].as_f64().unwrap();
    let seen = kappa(&edited["id"]);
    assert!((seen / kappa(&plain["id"]) - 1.0).abs() > 0.1);
    assert_eq!((&edited["bodies"][1]["mass"], &edited["dofs"][1]["armature"]), (&json!(1.5), &json!(0.25)));
    for (format, name, rotors) in [("mjcf", "arm-edited.xml", false), ("urdf", "arm-edited.urdf", true)] {
        let saved = server.ask("/api/patch", &json!({ "id": edited["id"], "format": format }));
        assert_eq!(saved["name"], name);
        let source = json!({ "text": saved["text"], "name": name });
        let again = server
            .ask("/api/model", &json!({ "source": source, "options": { "mimic": false, "rotors": rotors } }));
        // Shifts of inertia to the centre of mass and back: 100 ε κ.
        assert!((kappa(&again["id"]) / seen - 1.0).abs() < 100.0 * f64::EPSILON * seen, "{format}");
    }
}

/// A point of a figure names the robot that it is about.
#[test]
fn a_point_of_a_figure_is_that_robot() {
    let server = Running::new();
    for figure in ["F-fig6", "F-fig9", "F-fig10", "F-fig16", "F-fig18", "F-fig21"] {
        let found = server.get(&format!("/api/figure/{figure}"), &[]).json();
        let curves = found["curves"].as_array().unwrap();
        assert!(curves.len() > 3);
        for curve in curves {
            let points = curve["points"].as_array().unwrap();
            let point = points.iter().rfind(|point| point["x"].as_f64().unwrap() <= 100.0).unwrap();
            let model =
                server.ask("/api/model", &json!({ "source": point["source"], "options": point["options"] }));
            let q = server.ask("/api/pose", &json!({ "id": model["id"], "at": point["at"] }))["q"].clone();
            let seen = server.ask("/api/evaluate", &json!({ "id": model["id"], "q": q }));
            let name = curve["name"].as_str().unwrap();
            let weighted = name.starts_with("κ′");
            let kappa = seen[if weighted { "kappa_weighted" } else { "kappa" }].as_f64().unwrap();
            // A taper that is a root of a size ratio is named to 16 digits: 5 N ε in a ratio of inertias.
            assert!(
                (kappa / point["y"].as_f64().unwrap() - 1.0).abs() < 1e-11,
                "{figure} {name}: {kappa} {point}"
            );
        }
    }
    assert_eq!(server.get("/api/figure/F-fig12", &[]).refusal(), (404, "path".into()));
}

#[test]
fn a_swing_passes_through_the_robot_as_it_stands() {
    let server = Running::new();
    let model = server.model(&json!({ "family": "hydra(5, 1.5, 0.3, 1)" }));
    let q = json!([0.1, -0.3, 0.5, 0.2, 1.0]);
    let swing = server.ask(
        "/api/swing",
        &json!({ "id": model["id"], "q": q, "mode": "stiffest", "amplitude": 0.2, "frames": 5 }),
    );
    let here =
        server.ask("/api/evaluate", &json!({ "id": model["id"], "q": q, "want": ["places", "modes"] }));
    assert_eq!(swing["places"][2], here["places"]);
    let rates = numbers(&here["stiffest"]["vector"]);
    let largest = rates.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
    let v: Vec<f64> = rates.iter().map(|x| 0.2 * x / largest).collect();
    let end = server.ask("/api/move", &json!({ "id": model["id"], "q": q, "v": v }))["q"].clone();
    let there = server.ask("/api/evaluate", &json!({ "id": model["id"], "q": end, "want": ["places"] }));
    for (a, b) in swing["places"][4].as_array().unwrap().iter().zip(there["places"].as_array().unwrap()) {
        let apart = numbers(a).iter().zip(numbers(b)).fold(0.0, |m: f64, (a, b)| m.max((a - b).abs()));
        assert!(apart <= 4.0 * f64::from(f32::EPSILON), "{apart}");
    }
}

#[test]
fn models_are_kept_while_they_are_used() {
    let server = Running::new();
    let source = json!({ "family": "hydra(3)" });
    let first = server.model(&source)["id"].clone();
    assert_eq!(server.model(&source)["id"], first, "the same robot is made once");
    let used = server.model(&json!({ "family": "hydra(2)" }));
    let kept = server.model(&json!({ "family": "hydra(4)" }))["id"].clone();
    for n in 0..128 {
        if n == 100 {
            // Not yet forgotten; this is no use of it.
            assert_eq!(server.model(&json!({ "family": "hydra(4)" }))["id"], kept, "made once, still there");
        }
        server.model(&json!({ "family": format!("hydra({})", 4 + n) }));
        assert_eq!(server.post("/api/evaluate", &json!({ "id": used["id"], "q": [0, 0] })).status, 200);
    }
    assert_eq!(
        server.post("/api/pose", &json!({ "id": first, "at": "zero" })).refusal(),
        (404, "gone".into())
    );
    assert_ne!(server.model(&source)["id"], first);
}

#[test]
fn faults_of_dropped_texts_have_their_places() {
    let server = Running::new();
    let text = "<robot name=\"r\">\n  <link name=\"a\"/>\n  <link name=\"b\"><inertial><mass value=\"five\"/></inertial></link>\n</robot>";
    let reply = server.post("/api/model", &json!({ "source": { "text": text, "name": "r.urdf" } }));
    let error = reply.json()["error"].clone();
    assert_eq!(
        (&error["code"], &error["line"], &error["column"]),
        (&json!("model"), &json!(3), &json!(34)),
        "{error}"
    );
    assert_eq!(error["message"], format!("r.urdf:3:34: {}", error["what"].as_str().unwrap()));
    assert!(error["excerpt"].as_str().unwrap().contains("━"));
    // What is only suspicious comes with the model.
    let text = ARM.replace("ixx=\"0.01\"", "ixx=\"0.5\"");
    let findings = server.model(&json!({ "text": text, "name": "arm.urdf" }))["findings"].clone();
    let finding = findings.as_array().unwrap().iter().find(|finding| finding["subject"] == "upper").unwrap();
    assert_eq!((&finding["code"], &finding["place"]["line"]), (&json!("triangle-inequality"), &json!(3)));
}

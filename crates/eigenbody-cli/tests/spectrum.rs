//! `eigenbody spectrum` and the command alone.

use crate::run::{Scratch, json, stdout};

/// The keys of the contract, with a reference value (Featherstone 2004, §4.1: "over 40,000 at N = 10").
#[test]
fn json_contract() {
    let report = json(&["spectrum", "hydra(10,1,0,1)", "--at", "zag(0)", "--json", "--all"]);
    let keys = [
        "model",
        "bodies",
        "dofs",
        "base",
        "configuration",
        "metric",
        "method",
        "lambda_min",
        "lambda_max",
        "kappa",
        "kappa_weighted",
        "diagonal_ratio",
        "bracket",
        "eigenvalues",
        "softest",
        "stiffest",
    ];
    for key in keys {
        assert!(!report[key].is_null(), "{key} is missing");
    }
    let kappa = report["kappa"].as_f64().unwrap();
    // κ·n·ε of the dense method
    assert!((kappa / 42_907.972_749_37 - 1.0).abs() < 43_000.0 * 10.0 * f64::EPSILON, "{kappa}");
    let bracket = [report["bracket"][0].as_f64().unwrap(), report["bracket"][1].as_f64().unwrap()];
    assert!(bracket[0] < kappa && kappa < bracket[1]);
    assert_eq!(report["eigenvalues"].as_array().unwrap().len(), 10);
    assert_eq!(report["softest"]["joints"][9], "joint_10");
    assert_eq!(report["softest"]["vector"].as_array().unwrap().len(), 10);
}

/// A family on a floating base is studied free-floating: N − 1 degrees of freedom (claim F-fig18-extreme).
#[test]
fn floating_family() {
    let report = json(&["spectrum", "hydra(3,1,0,10)", "--at", "zag(pi/2)", "--base", "floating", "--json"]);
    assert_eq!((report["dofs"].as_u64(), report["base"].as_str()), (Some(2), Some("free-floating")));
    let kappa = report["kappa"].as_f64().unwrap();
    // The softest mode is the small base's own: from the central body nothing cancels.
    assert!((kappa / 100_222.262_767_586_15 - 1.0).abs() < 10.0 * f64::EPSILON, "{kappa}");
}

/// Mimic joints follow by default and move freely on request; q then has as many numbers.
#[test]
fn mimic_switch() {
    let inertial =
        "<inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial>";
    let link = |name: &str| format!("<link name='{name}'>{inertial}</link>");
    let joint = |name: &str, parent: &str, child: &str, mimic: &str| {
        format!(
            "<joint name='{name}' type='continuous'><parent link='{parent}'/><child link='{child}'/><axis xyz='0 0 1'/>{mimic}</joint>"
        )
    };
    let robot = [
        "<robot name='r'>",
        &link("a"),
        &link("b"),
        &link("c"),
        &joint("lead", "a", "b", ""),
        &joint("follow", "b", "c", "<mimic joint='lead' multiplier='-1'/>"),
        "</robot>",
    ]
    .concat();
    let scratch = Scratch::new();
    let path = scratch.file("pair.urdf", &robot);
    // follow turns back what lead turns: only link b, of 1 kg m², is felt.
    let on = json(&["spectrum", &path, "--json", "--at", "q=[0.3]"]);
    assert_eq!((on["dofs"].as_u64(), on["lambda_min"].as_f64()), (Some(1), Some(1.0)));
    let off = json(&["spectrum", &path, "--json", "--mimic", "off", "--at", "q=[0.3,0.1]"]);
    assert_eq!(off["dofs"].as_u64(), Some(2));
}

/// A singular robot: null with a note, never NaN.
#[test]
fn singular_is_null_with_a_note() {
    let robot = "<robot name='r'><link name='a'/><link name='b'/><joint name='j' type='continuous'><parent link='a'/><child link='b'/></joint></robot>";
    let scratch = Scratch::new();
    let path = scratch.file("ghost.urdf", robot);
    let report = json(&["spectrum", &path, "--json"]);
    assert!(report["kappa"].is_null() && report["lambda_min"].is_null());
    assert!(report["note"].as_str().unwrap().contains("singular"));
    assert!(report["findings"][0].as_str().unwrap().contains("no mass"));
}

#[test]
fn text_is_a_page() {
    insta::assert_snapshot!(stdout(&["spectrum", "hydra(4,1,0,1)", "--at", "zag(0)"]), @r#"
hydra(4,1,0,1)
  4 moving bodies, 4 degrees of freedom, fixed base, at zag(0)

  κ     1061.15           λmax/λmin, euclidean metric: for gains and time steps
  κ'    512.976           digits left in a solve: 13 of 15 in f64, 4 of 7 in f32
  r     63.7758           bracket: 63.8 ≤ κ ≤ 32715
  λmin  0.0305649 kg m²   inertia of the softest motion, ± 3e-15
  λmax  32.4338 kg m²     inertia of the stiffest motion, ± 2e-15

  softest mode, λ = 0.03056            stiffest mode, λ = 32.43
  joint_4 +  42.4% ███████             joint_1 +  65.2% ██████████
  joint_3 −  40.0% ██████              joint_2 +  27.3% ████
  joint_2 +  16.3% ███                 joint_3 +   7.0% █
  joint_1 −   1.3% █                   joint_4 +   0.6% █
"#);
}

#[test]
fn the_command_alone_reports_on_the_built_in_arm() {
    let page = stdout(&[]);
    assert!(page.starts_with("puma560\n"), "{page}");
    assert!(page.contains("1275 to 1399") && page.contains("Try next:"));
}

/// Both methods answer alike, and say which they are and how well they know.
#[test]
fn methods_agree() {
    let ask = |method: &str| {
        json(&["spectrum", "hydra(40,1,0.5,1)", "--at", "curl(0.1)", "--json", "--method", method])
    };
    let (dense, sturm) = (ask("dense"), ask("sturm"));
    assert_eq!((dense["method"].as_str(), sturm["method"].as_str()), (Some("dense"), Some("sturm")));
    assert!(dense["passes"].is_null() && sturm["passes"].as_u64().unwrap() <= 20);
    for key in ["lambda_min", "lambda_max"] {
        let estimate = |report: &serde_json::Value| report["error_estimate"][key].as_f64().unwrap();
        let ratio = dense[key].as_f64().unwrap() / sturm[key].as_f64().unwrap();
        assert!((ratio - 1.0).abs() <= estimate(&dense) + estimate(&sturm), "{key}: {ratio}");
        assert!(estimate(&sturm) < 1e-13);
    }
}

/// Beyond what a dense matrix can hold, and beyond 1/ε.
#[test]
fn long_chains_keep_their_digits() {
    let report = json(&["spectrum", "hydra(30000,1,0,1)", "--json"]);
    let kappa = report["kappa"].as_f64().unwrap();
    // λmin → 0.0211458 and κ/(4N⁴) → 0.9563 for long chains
    assert!((report["lambda_min"].as_f64().unwrap() - 0.021_145_8).abs() < 1e-7);
    assert!((kappa / (4.0 * 3e4f64.powi(4)) - 0.9563).abs() < 1e-3, "{kappa}");
    // onion: λ₁ = 1/(4 sin²(π/(4N+2)))
    let report = json(&["spectrum", "onion(30000,1,0,1)", "--json"]);
    let expected = 1.0 / (4.0 * (std::f64::consts::PI / 120_002.0).sin().powi(2));
    assert!((report["lambda_max"].as_f64().unwrap() / expected - 1.0).abs() < 1e-12);
}

/// A decimal stands for itself: with ρ rounded to f64 first, λmin of this robot is off by 6e-15 (its κ is 1.5e15).
#[test]
fn decimals_are_exact() {
    let report = json(&["spectrum", "hydra(19,1,0,0.7)", "--json"]);
    let ratio = report["lambda_min"].as_f64().unwrap() / 1.401_711_565_360_296_7e-15;
    assert!((ratio - 1.0).abs() <= 4.0 * f64::EPSILON, "{ratio}");
}

#[test]
fn eigenvalues_are_counted() {
    let report = json(&["spectrum", "onion(5,1,0,1)", "--json", "--all", "--count-below", "1"]);
    assert_eq!(report["count_below"], serde_json::json!({ "sigma": 1.0, "count": 3 }));
    assert_eq!(
        report["eigenvalues"].as_array().unwrap().iter().filter(|x| x.as_f64().unwrap() < 1.0).count(),
        3
    );
    let page = stdout(&["spectrum", "onion(5,1,0,1)", "--count-below", "1e300"]);
    assert!(page.contains("5 of 5 eigenvalues lie below"), "{page}");
}

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
  λmin  0.0305649 kg m²   inertia of the softest motion, ± 1e-15
  λmax  32.4338 kg m²     inertia of the stiffest motion, ± 3e-16

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

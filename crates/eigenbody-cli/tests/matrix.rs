//! `eigenbody matrix`: every form holds the same numbers.

use crate::run::{Scratch, json, stdout};
use eigenbody::{family, mass_matrix};

const ARGS: [&str; 4] = ["matrix", "puma560", "--at", "random(7)"];

fn expected() -> Vec<f64> {
    let arm = family::puma560::<f64>().unwrap();
    mass_matrix(&arm, &arm.random(7)).unwrap().as_slice().to_vec()
}

/// Floats in JSON parse back to the same bits.
#[test]
fn json_is_exact() {
    let report = json(&[&ARGS[..], &["--json"]].concat());
    let rows = report["rows"].as_array().unwrap();
    let numbers: Vec<f64> =
        rows.iter().flat_map(|row| row.as_array().unwrap()).map(|x| x.as_f64().unwrap()).collect();
    assert_eq!(numbers, expected());
    assert_eq!(report["dofs"][5], "joint_6");
    assert_eq!(report["base"], "fixed");
}

#[test]
fn csv_has_names_and_numbers() {
    let csv = stdout(&[&ARGS[..], &["--csv"]].concat());
    let mut lines = csv.lines();
    assert_eq!(lines.next(), Some("joint_1,joint_2,joint_3,joint_4,joint_5,joint_6"));
    let numbers: Vec<f64> = lines.flat_map(|line| line.split(',')).map(|x| x.parse().unwrap()).collect();
    assert_eq!(numbers, expected());
}

/// A NumPy file: magic, header with shape and type, then the numbers, row-major.
#[test]
fn npy_holds_the_same_bits() {
    let scratch = Scratch::new();
    let path = scratch.path("h.npy");
    stdout(&[&ARGS[..], &["--npy", "-o", path.to_str().unwrap()]].concat());
    let bytes = std::fs::read(&path).unwrap();
    assert_eq!(&bytes[..6], b"\x93NUMPY");
    let data = bytes.len() - 36 * 8;
    let header = String::from_utf8_lossy(&bytes[10..data]);
    assert!(
        header.contains("'descr': '<f8'") && header.contains("'shape': (6, 6, )")
            || header.contains("(6, 6)"),
        "{header}"
    );
    assert!(header.contains("'fortran_order': False"), "{header}");
    let numbers: Vec<f64> =
        bytes[data..].chunks_exact(8).map(|b| f64::from_le_bytes(b.try_into().unwrap())).collect();
    assert_eq!(numbers, expected());
}

/// The base's six DoFs come first, named and in the order [angular; linear].
#[test]
fn floating_base_comes_first() {
    let scratch = Scratch::new();
    let robot = "<robot name='r'><link name='a'><inertial><mass value='2'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial></link></robot>";
    let path = scratch.file("brick.urdf", robot);
    let report = json(&["matrix", &path, "--base", "floating", "--json"]);
    let names: Vec<&str> = report["dofs"].as_array().unwrap().iter().map(|x| x.as_str().unwrap()).collect();
    assert_eq!(names, ["wx", "wy", "wz", "vx", "vy", "vz"].map(|s| format!("floating_base/{s}")));
    assert_eq!(report["rows"][5][5], 2.0);
    assert_eq!(report["q"], serde_json::json!([0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]));
}

//! What a model's text can be.

use eigenbody::scalar::Dd;
use eigenbody::{Base, Family, Posture, mass_matrix};
use eigenbody_formats::{Kind, LoadOptions, load};
use insta::assert_snapshot;

const FLOATING: LoadOptions = LoadOptions { base: Base::Floating, size_ratio: None };

fn error(text: &str) -> String {
    load(text, &LoadOptions::default()).unwrap_err().to_string()
}

fn error_with(text: &str, options: LoadOptions) -> String {
    load(text, &options).unwrap_err().to_string()
}

/// The test data's directory.
fn data(name: &str) -> String {
    format!("{}/tests/data/{name}", env!("CARGO_MANIFEST_DIR"))
}

/// A file's error without the directory.
fn file_error(name: &str) -> String {
    error(&data(name)).replace(&data(""), "")
}

#[test]
fn family_expressions_are_the_families() {
    let cases = [
        (
            "hydra(7, 1.5, pi/4, 0.9)",
            Family::hydra(7, 1.5, std::f64::consts::FRAC_PI_4, "0.9".parse::<Dd>().unwrap()),
        ),
        ("hydra(7)", Family::hydra(7, 1.0, 0.0, 1.0)),
        ("onion( 5,2 )", Family::onion(5, 2.0, 0.0, 1.0)),
        ("onion(5, rho=0.5, alpha=1)", Family::onion(5, 1.0, 1.0, 0.5)),
        ("hydra(N=3, α=0.1, ρ=2)", Family::hydra(3, 1.0, 0.1, 2.0)),
        ("auto_tree(9, 1, 0.3)", Family::auto_tree(9, 1.0, 0.3, 1.0)),
        ("chain(4)", Family::slender_chain(4, 1.0, 1.0)),
        ("chain(4, m=2.2, l=1/2)", Family::slender_chain(4, 2.2, 0.5)),
        ("chain(4, 2.2, 0.5)", Family::slender_chain(4, 2.2, 0.5)),
        ("chain(2*2, l=3)", Family::slender_chain(4, 1.0, 3.0)),
    ];
    for (text, family) in cases {
        let (loaded, family) = (load(text, &LoadOptions::default()).unwrap(), family.unwrap());
        assert_eq!(loaded.kind, Kind::Family(family.clone()), "{text}");
        assert_eq!((&loaded.model, loaded.name), (&family.model().unwrap(), family.name()), "{text}");
    }
}

#[test]
fn a_floating_family_has_no_first_joint() {
    let loaded = load("hydra(4, 1, 0, 1)", &FLOATING).unwrap();
    assert!(loaded.is_family() && loaded.model.has_floating_base());
    assert_eq!((loaded.model.nv(), loaded.model.bodies().len()), (9, 4));
}

#[test]
fn a_size_ratio_sets_the_taper() {
    let options = LoadOptions { size_ratio: Some(100.0.into()), ..Default::default() };
    let expected = Family::hydra(5, 1.0, 0.0, 1.0).unwrap().with_size_ratio(100.0).unwrap();
    assert_eq!(load("hydra(5, 1, 0, 1)", &options).unwrap().kind, Kind::Family(expected));
    assert_snapshot!(error_with("hydra(5, 1, 0, 0.9)", options), @"hydra(5, 1, 0, 0.9): a size ratio sets the taper ρ, which has a value already");
    assert_snapshot!(error_with("chain(5)", options), @"chain(5): a size ratio is for the families with a taper: hydra, onion, auto_tree");
    assert_snapshot!(error_with("puma560", options), @"puma560: a size ratio is for the families hydra, onion and auto_tree");
    assert_snapshot!(error_with("robot.urdf", options), @"robot.urdf: a size ratio is for the families hydra, onion and auto_tree");
    assert_snapshot!(error_with("onion(5)", LoadOptions { size_ratio: Some((-1.0).into()), ..options }), @"onion(5): size ratio -1: expected a positive number");
    assert_snapshot!(error_with("onion(5)", LoadOptions { size_ratio: Some(f64::NAN.into()), ..options }), @"onion(5): size ratio NaN: expected a positive number");
}

#[test]
fn the_built_in_robot_is_there() {
    let loaded = load("puma560", &LoadOptions::default()).unwrap();
    assert_eq!((loaded.model.nv(), loaded.name.as_str(), loaded.kind), (6, "puma560", Kind::BuiltIn));
    assert_snapshot!(error_with("puma560", FLOATING), @"puma560: stands on a fixed base only");
}

#[test]
fn parameters_out_of_range_are_named() {
    assert_snapshot!(error("hydra(0,1,0,1)"), @"hydra(0,1,0,1), column 7: N = 0: the number of links is a whole number from 1 to 10000000");
    assert_snapshot!(error("hydra(-3)"), @"hydra(-3), column 7: N = -3: the number of links is a whole number from 1 to 10000000");
    assert_snapshot!(error("hydra(2.5,1,0,1)"), @"hydra(2.5,1,0,1), column 7: N = 2.5: the number of links is a whole number from 1 to 10000000");
    assert_snapshot!(error("hydra(1000000000000,1,0,1)"), @"hydra(1000000000000,1,0,1), column 7: N = 1000000000000: the number of links is a whole number from 1 to 10000000");
    assert_snapshot!(error("hydra(10, 0.5)"), @"hydra(10, 0.5), column 11: B = 0.5: the branching factor is a number of 1 or more");
    assert_snapshot!(error("onion(10, 1, 0, -1)"), @"onion(10, 1, 0, -1), column 17: ρ = -1: the taper is a positive number");
    assert_snapshot!(error("chain(3, m=0)"), @"chain(3, m=0), column 10: m (kg) = 0: expected a positive number");
    assert_snapshot!(error("chain(3, l=-1)"), @"chain(3, l=-1), column 10: l (m) = -1: expected a positive number");
    assert_snapshot!(error("hydra(1000, 1, 0, 1e9)"), @"hydra(1000, 1, 0, 1e9): inertia of link 'link_8' is not a finite number");
}

#[test]
fn misshapen_calls_are_explained() {
    assert_snapshot!(error("hydra()"), @"hydra(), column 8: N is missing in hydra(N,B,α,ρ)");
    assert_snapshot!(error("hydra(B=2)"), @"hydra(B=2), column 11: N is missing in hydra(N,B,α,ρ)");
    assert_snapshot!(error("hydra(3, C=2)"), @"hydra(3, C=2), column 10: no parameter 'C' in hydra(N,B,α,ρ)");
    assert_snapshot!(error("hydra(3, B=2, B=3)"), @"hydra(3, B=2, B=3), column 15: a second value for B");
    assert_snapshot!(error("hydra(3, 1, 0, 1, 1)"), @"hydra(3, 1, 0, 1, 1), column 19: too many parameters for hydra(N,B,α,ρ)");
    assert_snapshot!(error("chain(3, [1])"), @"chain(3, [1]), column 10: a list, expected a number");
    assert_snapshot!(error("hydra(3"), @"hydra(3, column 8: expected ')', found the end");
    assert_snapshot!(error("hydra(3) 4"), @"hydra(3) 4, column 10: expected the end, found '4'");
    assert_snapshot!(error("hydra(three)"), @"hydra(three), column 7: 'three' is not a number; expected a number such as 0.3 or pi/2");
}

#[test]
fn what_is_no_model_is_told_what_a_model_is() {
    assert_snapshot!(error("robot.urdff"), @"no model 'robot.urdff': no such file, and none of hydra(N,B,α,ρ), onion(N,B,α,ρ), auto_tree(N,B,α,ρ), chain(N,m,l), puma560");
    assert_snapshot!(error("hydra"), @"no model 'hydra': this family has parameters: hydra(N,B,α,ρ)");
    assert_snapshot!(error("hyrda(3)"), @"no model 'hyrda(3)': no such file, and none of hydra(N,B,α,ρ), onion(N,B,α,ρ), auto_tree(N,B,α,ρ), chain(N,m,l), puma560; did you mean 'hydra'?");
    assert_snapshot!(error("puma"), @"no model 'puma': no such file, and none of hydra(N,B,α,ρ), onion(N,B,α,ρ), auto_tree(N,B,α,ρ), chain(N,m,l), puma560");
    assert_snapshot!(error(""), @"no model '': no such file, and none of hydra(N,B,α,ρ), onion(N,B,α,ρ), auto_tree(N,B,α,ρ), chain(N,m,l), puma560");
}

#[test]
fn files_are_read_whatever_their_extension() {
    for name in ["pendulum.urdf", "pendulum.xml", "pendulum"] {
        let loaded = load(&data(name), &LoadOptions::default()).unwrap();
        assert_eq!((loaded.model.name(), loaded.model.nv()), ("pendulum", 1), "{name}");
        assert_eq!((loaded.name.as_str(), loaded.is_family()), (data(name).as_str(), false));
        let q = Posture::Zero.configuration(&loaded.model);
        // 2 kg at 0.5 m and 0.1 kg m² about the centre of mass: 0.1 + 2·0.25, within 4 ε of the sum
        let H = mass_matrix(&loaded.model, &q).unwrap();
        assert!((H[(0, 0)] - 0.6).abs() <= 4.0 * f64::EPSILON * 0.6, "{}", H[(0, 0)]);
    }
    let loaded = load(&data("pendulum.urdf"), &FLOATING).unwrap();
    assert_eq!(loaded.model.nv(), 7);
}

#[test]
fn files_that_cannot_be_read_say_why() {
    assert_snapshot!(file_error("absent.urdf"), @"absent.urdf: no such file");
    assert_snapshot!(file_error("directory.urdf"), @"directory.urdf: a directory, expected a file");
    assert_snapshot!(file_error("latin1.urdf"), @"latin1.urdf:1:15: byte 0xfc is not UTF-8 text");
    assert_snapshot!(file_error("world.sdf"), @"world.sdf:1:1: <sdf> holds no <model> and no <world>");
    assert_snapshot!(file_error("macros.urdf"), @"macros.urdf:2:3: <xacro:property> is a xacro macro; expand the file with xacro first");
    assert_snapshot!(file_error("empty"), @"empty:1:1: not well-formed XML: the document does not have a root node");
}

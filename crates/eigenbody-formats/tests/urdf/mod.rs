//! URDF files: the numbers they give, and the errors.

mod dynamics;
mod faults;
mod limits;
mod links;
mod places;
mod rotors;

use eigenbody::{Base, Matrix, Model, mass_matrix};
use eigenbody_formats::{UrdfOptions, read_urdf_str};

/// The model of the elements of a robot.
fn model(elements: &str) -> Model<f64> {
    model_on(Base::Fixed, elements)
}

fn model_on(base: Base, elements: &str) -> Model<f64> {
    let text = format!(r#"<robot name="test">{elements}</robot>"#);
    read_urdf_str(&text, "test.urdf", &UrdfOptions { base }).unwrap().model
}

/// H of the elements of a robot in a configuration.
fn H(elements: &str, q: &[f64]) -> Matrix<f64> {
    mass_matrix(&model(elements), q).unwrap()
}

/// A link with mass, an origin's attributes and the six entries xx, yy, zz, xy, xz, yz.
fn link(name: &str, mass: f64, origin: &str, I: [f64; 6]) -> String {
    let [xx, yy, zz, xy, xz, yz] = I;
    format!(
        r#"<link name="{name}"><inertial><origin {origin}/><mass value="{mass:?}"/>
           <inertia ixx="{xx:?}" iyy="{yy:?}" izz="{zz:?}" ixy="{xy:?}" ixz="{xz:?}" iyz="{yz:?}"/></inertial></link>"#
    )
}

/// A joint named after its child.
fn joint(kind: &str, parent: &str, child: &str, rest: &str) -> String {
    format!(
        r#"<joint name="{child}" type="{kind}"><parent link="{parent}"/><child link="{child}"/>{rest}</joint>"#
    )
}

/// |a − b| ≤ c ε scale for every entry.
fn assert_close(found: &Matrix<f64>, expected: &Matrix<f64>, c: f64, scale: f64) {
    assert_eq!((found.rows(), found.cols()), (expected.rows(), expected.cols()));
    for (a, b) in found.as_slice().iter().zip(expected.as_slice()) {
        assert!((a - b).abs() <= c * f64::EPSILON * scale, "{found:?}\n{expected:?}");
    }
}

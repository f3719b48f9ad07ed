//! H of small robots in closed form.

use super::{H, assert_close, joint, link, model, model_on};
use eigenbody::{Base, Family, Matrix, Model, mass_matrix};

fn matrix<const N: usize>(rows: [[f64; N]; N]) -> Matrix<f64> {
    Matrix::from_fn(N, N, |i, j| rows[i][j])
}

#[test]
fn a_pendulum_is_steiners() {
    // I_yy + m (x² + z²); the axis may have any length.
    let rod = link("rod", 2.0, r#"xyz="0.3 5 -0.4""#, [0.1, 0.2, 0.3, 0.0, 0.0, 0.0]);
    let hinge = joint("revolute", "base", "rod", r#"<origin xyz="1 2 3"/><axis xyz="0 -2.5 0"/>"#);
    let found = H(&format!(r#"<link name="base"/>{rod}{hinge}"#), &[0.7]);
    // 20 ε of the largest moment on the way, 2·25
    assert_close(&found, &matrix([[0.2 + 2.0 * 0.25]]), 20.0, 50.0);
}

#[test]
fn the_default_axis_is_x() {
    let rod = link("rod", 1.0, "", [0.1, 0.2, 0.3, 0.0, 0.0, 0.0]);
    let found =
        H(&[r#"<link name="base"/>"#, &rod, &joint("continuous", "base", "rod", "")].concat(), &[0.0]);
    assert_close(&found, &matrix([[0.1]]), 4.0, 0.3);
}

#[test]
fn slender_rods_are_the_chain_family() {
    let (m, l) = (2.2, 0.8);
    let across = m * l * l / 12.0;
    let mut text = String::from(r#"<link name="link_0"/>"#);
    for i in 1..=3 {
        let (parent, child) = (format!("link_{}", i - 1), format!("link_{i}"));
        let at = if i == 1 { 0.0 } else { l };
        text += &link(&child, m, &format!(r#"xyz="{} 0 0""#, l / 2.0), [0.0, across, across, 0.0, 0.0, 0.0]);
        text +=
            &joint("revolute", &parent, &child, &format!(r#"<origin xyz="{at} 0 0"/><axis xyz="0 0 1"/>"#));
    }
    let (read, family): (_, Model<f64>) =
        (model(&text), Family::slender_chain(3, m, l).unwrap().model().unwrap());
    for seed in 0..5 {
        let q = family.random(seed);
        let (found, expected) = (mass_matrix(&read, &q).unwrap(), mass_matrix(&family, &q).unwrap());
        assert_close(&found, &expected, 10.0, expected.max_abs());
    }
}

#[test]
fn a_planar_joint_moves_in_the_plane_of_its_axis() {
    let (m, x, y, zz) = (2.0, 0.3, -0.4, 0.05);
    let expected = matrix([[m, 0.0, -m * y], [0.0, m, m * x], [-m * y, m * x, zz + m * (x * x + y * y)]]);
    let disc = link("disc", m, &format!(r#"xyz="{x} {y} 0.7""#), [0.02, 0.03, zz, 0.0, 0.0, 0.0]);
    let on = joint("planar", "base", "disc", r#"<axis xyz="0 0 1"/>"#);
    let found = H(&format!(r#"<link name="base"/>{disc}{on}"#), &[0.5, 0.6, 0.7]);
    // 10 ε of the largest moment on the way, 2·(0.5 + 0.49)
    assert_close(&found, &expected, 10.0, 2.0);
}

#[test]
fn a_floating_body_is_its_own_spatial_inertia() {
    let (m, [x, y, z]) = (2.0, [0.3, -0.4, 0.7]);
    let (ix, iy, iz) = (0.02 + m * (y * y + z * z), 0.03 + m * (x * x + z * z), 0.04 + m * (x * x + y * y));
    let (xy, xz, yz) = (-m * x * y, -m * x * z, -m * y * z);
    let expected = matrix([
        [ix, xy, xz, 0.0, -m * z, m * y],
        [xy, iy, yz, m * z, 0.0, -m * x],
        [xz, yz, iz, -m * y, m * x, 0.0],
        [0.0, m * z, -m * y, m, 0.0, 0.0],
        [-m * z, 0.0, m * x, 0.0, m, 0.0],
        [m * y, -m * x, 0.0, 0.0, 0.0, m],
    ]);
    let body = link("body", m, &format!(r#"xyz="{x} {y} {z}""#), [0.02, 0.03, 0.04, 0.0, 0.0, 0.0]);
    let q = [1.0, 2.0, 3.0, 0.5, -0.5, 0.5, 0.5];
    // Its axis does not matter, not even a zero one.
    let on = joint("floating", "base", "body", r#"<origin rpy="1 2 3"/><axis xyz="0 0 0"/>"#);
    assert_close(&H(&format!(r#"<link name="base"/>{body}{on}"#), &q), &expected, 10.0, 2.0);
    let based = mass_matrix(&model_on(Base::Floating, &body), &q).unwrap();
    assert_close(&based, &expected, 10.0, 2.0);
}

#[test]
fn a_slide_carries_its_mass() {
    let body = link("body", 3.0, r#"xyz="1 2 3""#, [0.02, 0.03, 0.04, 0.0, 0.0, 0.0]);
    let on = joint("prismatic", "base", "body", r#"<axis xyz="1 1 1"/>"#);
    assert_close(&H(&format!(r#"<link name="base"/>{body}{on}"#), &[0.3]), &matrix([[3.0]]), 4.0, 3.0);
}

#[test]
fn links_on_fixed_joints_are_one_body() {
    // 1 kg at x = 0.5 and 3 kg at x = 1 + 0.2 y-turned: the second link stands at (1, 0, 0), turned by π/2 about z.
    let hinge = joint("continuous", "base", "rod", r#"<axis xyz="0 0 1"/>"#);
    let rod = link("rod", 1.0, r#"xyz="0.5 0 0""#, [0.0, 0.0, 0.1, 0.0, 0.0, 0.0]);
    let tip = link("tip", 3.0, r#"xyz="0.2 0 0""#, [0.0, 0.0, 0.2, 0.0, 0.0, 0.0]);
    let weld = joint("fixed", "rod", "tip", r#"<origin xyz="1 0 0" rpy="0 0 1.5707963267948966"/>"#);
    let text = format!(r#"<link name="base"/>{rod}{tip}{hinge}{weld}"#);
    let expected = 0.1 + 0.25 + 0.2 + 3.0 * (1.0 + 0.04);
    assert_close(&H(&text, &[0.4]), &matrix([[expected]]), 10.0, expected);

    // The same by one link: 4 kg at (0.875, 0.15, 0).
    let about_com = expected - 4.0 * (0.875 * 0.875 + 0.15 * 0.15);
    let one = link("rod", 4.0, r#"xyz="0.875 0.15 0""#, [0.0, 0.0, about_com, 0.0, 0.0, 0.0]);
    let arm = joint("continuous", "rod", "arm", r#"<origin xyz="0 2 0"/><axis xyz="0 1 0.5"/>"#);
    let arm = link("arm", 1.0, r#"xyz="0.1 0.2 0.3""#, [0.1, 0.1, 0.1, 0.0, 0.0, 0.0]) + &arm;
    let q = [0.4, 1.1];
    let merged = H(&format!(r#"<link name="base"/>{one}{hinge}{arm}"#), &q);
    assert_close(&H(&format!("{text}{arm}"), &q), &merged, 20.0, merged.max_abs());
}

#[test]
fn damping_of_joints_is_read() {
    let text = r#"<robot name="r"><link name="a"/><link name="b"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
<joint name="j" type="continuous"><parent link="a"/><child link="b"/><dynamics damping="0.25" friction="1"/></joint></robot>"#;
    let loaded =
        eigenbody_formats::read_urdf_str(text, "r.urdf", &eigenbody_formats::UrdfOptions::default()).unwrap();
    let spring = &loaded.springs[0];
    assert_eq!((spring.arms.as_slice(), spring.stiffness, spring.damping), (&[(0, 1.0)][..], 0.0, 0.25));
}

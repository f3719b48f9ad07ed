//! Orientations: of an inertia, of a joint.

use super::{H, assert_close, joint, link};
use eigenbody::Matrix;

type M = [[f64; 3]; 3];

/// R = Rz(yaw) Ry(pitch) Rx(roll), from its three factors.
fn rotation([roll, pitch, yaw]: [f64; 3]) -> M {
    let ((sr, cr), (sp, cp), (sy, cy)) = (roll.sin_cos(), pitch.sin_cos(), yaw.sin_cos());
    let x = [[1.0, 0.0, 0.0], [0.0, cr, -sr], [0.0, sr, cr]];
    let y = [[cp, 0.0, sp], [0.0, 1.0, 0.0], [-sp, 0.0, cp]];
    let z = [[cy, -sy, 0.0], [sy, cy, 0.0], [0.0, 0.0, 1.0]];
    product(z, product(y, x))
}

fn product(a: M, b: M) -> M {
    let entry = |i: usize, j: usize| (0..3).map(|k| a[i][k] * b[k][j]).sum();
    [0, 1, 2].map(|i| [0, 1, 2].map(|j| entry(i, j)))
}

fn transposed(a: M) -> M {
    [0, 1, 2].map(|i| [0, 1, 2].map(|j| a[j][i]))
}

fn times(a: M, b: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|i| dot(a[i], b))
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|k| a[k] * b[k]).sum()
}

#[test]
fn an_inertia_is_given_in_its_own_axes() {
    let (rpy, a) = ([0.3, -0.9, 2.1], [2.0 / 7.0, -3.0 / 7.0, 6.0 / 7.0]);
    let R = rotation(rpy);
    let I = product(product(R, [[0.5, 0.01, -0.02], [0.01, 0.4, 0.03], [-0.02, 0.03, 0.3]]), transposed(R));
    let expected = dot(a, times(I, a));
    let [r, p, y] = rpy;
    let body = link("body", 1.0, &format!(r#"rpy="{r} {p} {y}""#), [0.5, 0.4, 0.3, 0.01, -0.02, 0.03]);
    let hinge = joint("continuous", "base", "body", r#"<axis xyz="2 -3 6"/>"#);
    let found = H(&format!(r#"<link name="base"/>{body}{hinge}"#), &[0.2]);
    assert_close(&found, &Matrix::from_fn(1, 1, |_, _| expected), 20.0, 0.5);
}

#[test]
fn a_joints_origin_turns_its_axis() {
    // Two balls about one point: H = [I₁ + I₂, I₂ a·Rb; ., I₂], a and b the axes, R the second joint's orientation at q.
    let (rpy, a, b) = ([0.3, -0.9, 2.1], [0.0, 0.6, 0.8], [1.0, 0.0, 0.0]);
    let off = 0.25 * dot(a, times(rotation(rpy), b));
    let balls = link("one", 1.0, "", [0.5, 0.5, 0.5, 0.0, 0.0, 0.0])
        + &link("two", 1.0, "", [0.25, 0.25, 0.25, 0.0, 0.0, 0.0]);
    let first = joint("continuous", "base", "one", r#"<axis xyz="0 0.6 0.8"/>"#);
    let second = joint("continuous", "one", "two", r#"<origin rpy="0.3 -0.9 2.1"/>"#);
    let expected = Matrix::from_fn(2, 2, |i, j| [[0.75, off], [off, 0.25]][i][j]);
    let found = H(&format!(r#"<link name="base"/>{balls}{first}{second}"#), &[0.2, 1.3]);
    assert_close(&found, &expected, 20.0, 0.75);
}

#[test]
fn a_quaternion_is_the_same_orientation() {
    let robot = |origin: &str| {
        let body = link("body", 1.0, origin, [0.5, 0.4, 0.3, 0.01, -0.02, 0.03]);
        let hinge = joint("continuous", "base", "body", r#"<axis xyz="2 -3 6"/>"#);
        H(&format!(r#"<link name="base"/>{body}{hinge}"#), &[0.2])
    };
    // A turn of 0.8 rad about y.
    let (s, c) = 0.4f64.sin_cos();
    let turned = robot(&format!(r#"quat_xyzw="0 {s} 0 {c}""#));
    assert_close(&turned, &robot(r#"rpy="0 0.8 0""#), 20.0, 0.5);
    // Files round to a few digits.
    let rounded = robot(&format!(r#"quat_xyzw="0 {s:.4} 0 {c:.4}""#));
    assert!((rounded[(0, 0)] - turned[(0, 0)]).abs() < 1e-4);
}

#[test]
fn numbers_may_be_written_in_any_way() {
    let plain = link("body", 1.5, r#"xyz="1 0.5 -0.001""#, [0.5, 0.4, 0.3, 0.0, 0.0, 0.0]);
    let fancy = plain
        .replace(r#"xyz="1 0.5 -0.001""#, "xyz=\"\n\t+1.  .5\t\n-1E-3 \"")
        .replace(r#"value="1.5""#, r#"value=" 15e-1 ""#);
    assert_ne!(plain, fancy);
    let robot = |body: &str| {
        H(&[r#"<link name="base"/>"#, body, &joint("continuous", "base", "body", "")].concat(), &[0.0])
    };
    assert_eq!(robot(&plain), robot(&fancy));
}

//! Models back out as files: the merged tree, in its internal frames, with all digits.
//!
//! What a format has no word for is an error: a file that reloads to another H is never written.

mod mjcf;
mod urdf;

pub(crate) use mjcf::inertial as mjcf_inertial;
pub use mjcf::write_mjcf;
pub(crate) use urdf::{inertial as urdf_inertial, rotor as rotor_element};
pub use urdf::{write_urdf, write_urdf_with_rotors};

use eigenbody::spatial::{Mat3, RigidInertia, Sym3, Vec3};
use eigenbody::spectrum::eigenvalues;
use eigenbody::{Matrix, Model};
use std::fmt::Write;
use thiserror::Error;

/// What the format to be written cannot say.
#[derive(Debug, Clone, PartialEq, Error)]
#[allow(missing_docs)] // the messages say it all
pub enum WriteError {
    #[error("joint '{joint}' of kind {kind} has no counterpart in {format}")]
    Joint { joint: String, kind: &'static str, format: &'static str },
    #[error(
        "link '{link}' has principal moments of inertia down to {least:e} kg m²; {format} allows none below zero"
    )]
    Inertia { link: String, least: f64, format: &'static str },
    #[error("joint '{joint}' has armature, for which URDF has no place; write MJCF (.xml) instead")]
    Armature { joint: String },
    #[error("joint '{joint}' has several degrees of freedom and armature; a rotor in URDF drives one")]
    Rotor { joint: String },
}

/// A mass with its centre and the inertia about it.
struct Central {
    m: f64,
    com: Vec3<f64>,
    I: Sym3<f64>,
}

impl Central {
    /// The inverse of [`RigidInertia::from_com`]. Without mass the centre is the origin.
    fn of(body: &RigidInertia<f64>) -> Self {
        let com = if body.m > 0.0 { body.h * (1.0 / body.m) } else { Vec3::ZERO };
        let I = body.I - RigidInertia::from_com(body.m, com, Sym3::ZERO).I;
        Self { m: body.m, com, I }
    }
}

impl Central {
    /// The least principal moment of inertia.
    fn least_moment(&self) -> f64 {
        let I = self.I.full();
        let rows = [I.x.to_array(), I.y.to_array(), I.z.to_array()];
        let I = Matrix::from_fn(3, 3, |i, j| rows[i][j]);
        eigenvalues(&I, &[1.0; 3]).map_or(f64::NAN, |moments| moments[0])
    }
}

/// Numbers that parse back to the same bits.
fn numbers(numbers: &[f64]) -> String {
    let mut text = String::new();
    for (k, x) in numbers.iter().enumerate() {
        let _ = write!(text, "{}{x:?}", if k > 0 { " " } else { "" });
    }
    text
}

fn vector(v: Vec3<f64>) -> String {
    numbers(&v.to_array())
}

/// A text as an attribute's value.
pub(crate) fn escaped(text: &str) -> String {
    let mut out = String::new();
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            c if c.is_control() => {
                let _ = write!(out, "&#{};", c as u32);
            }
            c => out.push(c),
        }
    }
    out
}

/// The link that a body's joint carries gives the body its name.
fn body_name(model: &Model<f64>, body: usize) -> &str {
    model.links()[model.bodies()[body].link()].name()
}

/// The unit quaternion w, x, y, z of a coordinate rotation E.
pub(crate) fn quaternion(E: &Mat3<f64>) -> [f64; 4] {
    let [a, b, c] = [E.x.x, E.y.y, E.z.z];
    // Four times the squares; the largest is at least 1.
    let squares = [1.0 + a + b + c, 1.0 + a - b - c, 1.0 - a + b - c, 1.0 - a - b + c];
    let largest = (0..4).max_by(|&i, &j| squares[i].total_cmp(&squares[j])).unwrap_or(0);
    let s = 0.5 / squares[largest].sqrt();
    // E is the transpose of R.
    let (wx, wy, wz) = (E.y.z - E.z.y, E.z.x - E.x.z, E.x.y - E.y.x);
    let (xy, xz, yz) = (E.x.y + E.y.x, E.x.z + E.z.x, E.y.z + E.z.y);
    let half = squares[largest];
    match largest {
        0 => [half * s, wx * s, wy * s, wz * s],
        1 => [wx * s, half * s, xy * s, xz * s],
        2 => [wy * s, xy * s, half * s, yz * s],
        _ => [wz * s, xz * s, yz * s, half * s],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quaternion_gives_its_rotation_back() {
        for q in [[0.5, 0.5, -0.5, 0.5], [0.1, 0.9, 0.3, -0.2], [0.0, 0.2, 0.9, 0.1], [-0.1, 0.1, 0.2, 0.9]] {
            let norm = q.iter().map(|x| x * x).sum::<f64>().sqrt();
            let E = Mat3::rotation_quaternion(q[0], Vec3::new(q[1], q[2], q[3]));
            let found = quaternion(&E);
            let cosine: f64 = found.iter().zip(q).map(|(a, b)| a * b / norm).sum();
            // the same up to sign, 10 ε
            assert!((cosine.abs() - 1.0).abs() < 10.0 * f64::EPSILON, "{found:?} {q:?}");
        }
    }
}

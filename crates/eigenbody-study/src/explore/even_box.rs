//! The box of even density that a body's inertia is that of.
//!
//! ```text
//! I = m/3 diag(b² + c², a² + c², a² + b²)      a² = 3/(2m) (I_y + I_z − I_x), half-edges a, b, c along the principal axes
//! ```

use eigenbody::Matrix;
use eigenbody::spatial::{Mat3, RigidInertia, Transform, Vec3};
use eigenbody::spectrum::eigen;

/// A box.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EvenBox {
    /// From the body's frame to the box's, whose origin is the centre of mass and whose axes are the principal ones.
    pub frame: Transform<f64>,
    /// Half-edges (m); zero where the inertia asks for less.
    pub half: [f64; 3],
}

/// The box of a body's inertia; none without mass, or where numbers do not suffice.
///
/// ```
/// use eigenbody::spatial::{RigidInertia, Sym3, Vec3};
/// use eigenbody_study::explore::even_box;
/// // 3 kg, half-edges 1, 2, 3 m.
/// let body = RigidInertia::from_com(3.0, Vec3::X, Sym3::diagonal(13.0, 10.0, 5.0));
/// let mut half = even_box(&body).unwrap().half;
/// half.sort_by(f64::total_cmp);
/// assert!(half.iter().zip([1.0, 2.0, 3.0]).all(|(a, b)| (a - b).abs() < 1e-14));
/// ```
pub fn even_box(inertia: &RigidInertia<f64>) -> Option<EvenBox> {
    let (m, centre, I) = inertia.central();
    if m <= 0.0 {
        return None;
    }
    let rows = [[I.xx, I.xy, I.xz], [I.xy, I.yy, I.yz], [I.xz, I.yz, I.zz]];
    let found = eigen(&Matrix::from_fn(3, 3, |i, j| rows[i][j]), &[1.0; 3]).ok()?;
    let moments = [0, 1, 2].map(|k| found.values[k]);
    let half = [0, 1, 2].map(|k| {
        let square = moments.iter().sum::<f64>() - 2.0 * moments[k];
        (1.5 * square.max(0.0) / m).sqrt()
    });
    let axis = |k: usize| {
        let x = found.vectors.row(k);
        Vec3::new(x[0], x[1], x[2])
    };
    let (x, y) = (axis(0), axis(1));
    let frame = Transform::new(Mat3::from_rows(x, y, x.cross(y)), centre);
    half.iter().chain(&centre.to_array()).all(|x| x.is_finite()).then_some(EvenBox { frame, half })
}

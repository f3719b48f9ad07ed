//! Eigenvectors, and robots bent along them: figures 14 and 15.

use super::curves::planar;
use super::mechanisms::planar_links;
use crate::claim::{Check, Reading};
use crate::experiment::Outcome;
use crate::lab::{Lab, StudyError};
use crate::table::Rows;
use eigenbody::Posture;
use eigenbody::spectrum::eigen;

/// Figure 14: e₁, e₂, e₃ of hydra(20,1,0,1) and d₁ of hydra(10,1,0,1) at zag(0), in joint coordinates.
///
/// # Errors
///
/// [`StudyError`], as every experiment.
pub fn fig14(lab: &Lab<'_>) -> Result<Outcome, StudyError> {
    let numbers = [("N", "1"), ("mode", "1"), ("joint", "1"), ("coordinate", "1")];
    let mut table = Rows::new(&[("curve", "")], &numbers);
    let mut turns = Vec::new();
    let mut one_sign = true;
    for (name, n, mode) in
        [("e₁, N = 20", 20, 1), ("e₂, N = 20", 20, 2), ("e₃, N = 20", 20, 3), ("d₁, N = 10", 10, 1)]
    {
        let H = lab.pose(&planar(n)?, Posture::Zag(0.0))?.mass_matrix()?;
        let vectors = eigen(&H, &vec![1.0; n])?.vectors;
        let x = vectors.row(n - mode);
        for (joint, &x) in (1..).zip(x) {
            table.push([name.into()], [n as f64, mode as f64, f64::from(joint), x].map(Some));
        }
        turns.push(x.windows(2).filter(|pair| pair[0] * pair[1] < 0.0).count() as f64);
        one_sign &= mode > 1 || x.iter().all(|&x| x > 0.0);
    }
    let mut shape = vec![
        Check::truth("all coordinates of e₁ and d₁ are positive", one_sign),
        Check::within("sign changes of e₂", turns[1], 1.0, 1.0),
        Check::within("sign changes of e₃", turns[2], 2.0, 2.0),
    ];
    for n in [10, 20, 40, 100] {
        let sum: f64 = lab.pose(&planar(n)?, Posture::Zag(0.0))?.ends()?.stiffest.iter().sum();
        let grown = sum.abs() / (n as f64).sqrt();
        shape.push(Check::within(format!("sum/√N of the largest eigenvector, N = {n}"), grown, 0.78, 0.81));
    }
    Ok(Outcome::new(table, vec![Reading::shape("F-fig14", shape)]))
}

/// Figure 15: both robots in 0.2 times their largest eigenvectors, in units of their whole length.
///
/// # Errors
///
/// [`StudyError`], as every experiment.
pub fn fig15(lab: &Lab<'_>) -> Result<Outcome, StudyError> {
    let mut table = planar_links();
    let mut bends = Vec::new();
    for n in [10, 20] {
        let posed = lab.pose(&planar(n)?, Posture::Zag(0.0))?;
        let x = posed.ends()?.stiffest;
        let sign = x[0].signum();
        let q: Vec<f64> = x.iter().map(|x| 0.2 * sign * x).collect();
        bends.push(q.iter().sum::<f64>());
        super::mechanisms::push_links(&mut table, "", &format!("N = {n}"), &posed.model, &q, 1.0 / n as f64)?;
    }
    let shape = vec![
        Check::within("turn of the last link, N = 20 (rad)", bends[1], 0.68, 0.74),
        Check::within("that over N = 10: √2 of the gear", bends[1] / bends[0], 1.35, 1.45),
    ];
    Ok(Outcome::new(table, vec![Reading::shape("F-fig15", shape)]))
}

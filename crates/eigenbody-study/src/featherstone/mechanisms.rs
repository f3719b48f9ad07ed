//! Drawings of mechanisms: figures 1 to 5. Tables hold where links begin and end.

use super::curves::planar;
use crate::claim::{Check, Reading};
use crate::experiment::Outcome;
use crate::lab::{Lab, StudyError};
use crate::table::Rows;
use eigenbody::dynamics::link_pose;
use eigenbody::{Family, Model, Posture};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_3};

/// A table of planar links: from (x0, y0) to (x1, y1).
pub(super) fn planar_links() -> Rows<2, 5> {
    let numbers = [("link", "1"), ("x0", "m"), ("y0", "m"), ("x1", "m"), ("y1", "m")];
    Rows::new(&[("panel", ""), ("robot", "")], &numbers)
}

/// Adds the links of an unbranched hydra robot, whose links are 1 m long, scaled.
pub(super) fn push_links(
    table: &mut Rows<2, 5>,
    panel: &str,
    robot: &str,
    model: &Model<f64>,
    q: &[f64],
    scale: f64,
) -> Result<(), StudyError> {
    let links = model.links().iter().enumerate().filter(|(_, link)| link.body().is_some());
    for (number, (index, _)) in (1..).zip(links) {
        let pose = link_pose(model, q, index)?;
        let tip = pose.inverse_point(eigenbody::spatial::Vec3::X);
        let [a, b] = [pose.r, tip].map(|p| p * scale);
        table.push([panel.into(), robot.into()], [f64::from(number), a.x, a.y, b.x, b.y].map(Some));
    }
    Ok(())
}

/// Figure 1: the robot of the example.
///
/// # Errors
///
/// [`StudyError`], as every experiment.
pub fn fig1(lab: &Lab<'_>) -> Result<Outcome, StudyError> {
    let mut table = planar_links();
    let posed = lab.pose(&planar(8)?, Posture::Zag(FRAC_PI_2))?;
    push_links(&mut table, "", "hydra(8,1,0,1)", &posed.model, &posed.q, 1.0)?;
    Ok(Outcome::new(table, Vec::new()))
}

/// Figure 2: connectivity for B = 1.5.
///
/// # Errors
///
/// [`StudyError`], as every experiment.
pub fn fig2(_: &Lab<'_>) -> Result<Outcome, StudyError> {
    let tree = Family::hydra(12, 1.5, 0.0, 1.0)?;
    let mut table = Rows::new(&[], &[("link", "1"), ("parent", "1"), ("depth", "1")]);
    let mut depth = [0.0; 13];
    for i in 1..=12 {
        depth[i] = depth[tree.parent(i)] + 1.0;
        table.push([], [i as f64, tree.parent(i) as f64, depth[i]].map(Some));
    }
    let many = Family::hydra(600, 1.5, 0.0, 1.0)?;
    let mut children = vec![0usize; 601];
    (1..=600).for_each(|i| children[many.parent(i)] += 1);
    // Links 1 to 390 have all their children among the first 600.
    let alternates = (1..390).all(|i| children[i] + children[i + 1] == 3);
    let binary = Family::hydra(5, 2.0, 0.0, 1.0)?;
    let unbranched = planar(50)?;
    let shape = vec![
        Check::truth("B = 1.5: one child and two in turn, links 1 to 390", alternates),
        Check::truth(
            "B = 2: P = [0, 1, 1, 2, 2]",
            [1, 2, 3, 4, 5].map(|i| binary.parent(i)) == [0, 1, 1, 2, 2],
        ),
        Check::truth("B = 1: P(i) = i − 1", (1..=50).all(|i| unbranched.parent(i) == i - 1)),
        Check::within("children of the root, B = 1.5", children[0] as f64, 1.0, 1.0),
    ];
    Ok(Outcome::new(table, vec![Reading::shape("F-fig2", shape)]))
}

/// Figure 3: link 1, its tube and its axes for α = 0.5; and the erratum about which α is planar.
///
/// # Errors
///
/// [`StudyError`], as every experiment.
pub fn fig3(lab: &Lab<'_>) -> Result<Outcome, StudyError> {
    let alpha = 0.5f64;
    let (s, c) = alpha.sin_cos();
    let numbers = ["x", "y", "z", "dx", "dy", "dz"].map(|name| (name, "m"));
    let mut table = Rows::new(&[("feature", "")], &numbers);
    let features = [
        ("tube, from end to end", [0.0, 0.0, 0.0, 1.0, 0.0, 0.0]),
        ("radius", [0.0, 0.0, 0.0, 0.0, 0.05, 0.0]),
        ("inboard axis", [0.0, 0.0, 0.0, 0.0, 0.0, 1.0]),
        ("outboard axis", [1.0, 0.0, 0.0, 0.0, -s, c]),
        ("centre of mass", [0.5, 0.0, 0.0, 0.0, 0.0, 0.0]),
    ];
    for (name, numbers) in features {
        table.push([name.into()], numbers.map(Some));
    }
    // How far the links of a bent robot leave the x-y plane.
    let out_of_plane = |skew: f64| -> Result<f64, StudyError> {
        let posed = lab.pose(&Family::hydra(6, 1.0, skew, 1.0)?, Posture::Curl(0.7))?;
        let mut height = 0.0f64;
        for link in 0..posed.model.links().len() {
            height = height.max(link_pose(&posed.model, &posed.q, link)?.r.z.abs());
        }
        Ok(height)
    };
    let shape = vec![
        Check::within("height above the plane of a bent hydra(6,1,0,1) (m)", out_of_plane(0.0)?, 0.0, 0.0),
        Check::within("the same of hydra(6,1,1,1) (m)", out_of_plane(1.0)?, 0.5, 6.0),
    ];
    Ok(Outcome::new(table, vec![Reading::shape("F-erratum", shape)]))
}

/// Figure 4: two shells about one point, the axes of onion(2,1,α,ρ) for α = 0.5.
///
/// # Errors
///
/// [`StudyError`], as every experiment.
pub fn fig4(lab: &Lab<'_>) -> Result<Outcome, StudyError> {
    let posed = lab.pose(&Family::onion(2, 1.0, 0.5, 0.7)?, Posture::Zero)?;
    let numbers = [("link", "1"), ("axis_x", "1"), ("axis_y", "1"), ("axis_z", "1"), ("size", "1")];
    let mut table = Rows::new(&[], &numbers);
    let links = posed.model.links().iter().enumerate().filter(|(_, link)| link.body().is_some());
    for (number, (index, _)) in (1..).zip(links) {
        let pose = link_pose(&posed.model, &posed.q, index)?;
        let axis = pose.E.transpose_times(eigenbody::spatial::Vec3::Z);
        table.push([], [f64::from(number), axis.x, axis.y, axis.z, 0.7f64.powi(number - 1)].map(Some));
    }
    Ok(Outcome::new(table, Vec::new()))
}

/// Figure 5: zag and curl. The paper names N; of the angles only θ = 3.0 of (d) and (e) follows from its text.
///
/// # Errors
///
/// [`StudyError`], as every experiment.
pub fn fig5(lab: &Lab<'_>) -> Result<Outcome, StudyError> {
    let mut table = planar_links();
    let panels = [
        ("(a) curl(π/3), N = 3", 3, Posture::Curl(FRAC_PI_3)),
        ("(b) zag(1.0), N = 5", 5, Posture::Zag(1.0)),
        ("(c) curl(1.0), N = 5", 5, Posture::Curl(1.0)),
        ("(d) zag(3.0), N = 5", 5, Posture::Zag(3.0)),
        ("(e) zag(3.0), N = 22", 22, Posture::Zag(3.0)),
    ];
    for (panel, n, posture) in panels {
        let posed = lab.pose(&planar(n)?, posture)?;
        push_links(&mut table, panel, "", &posed.model, &posed.q, 1.0)?;
    }
    Ok(Outcome::new(table, Vec::new()))
}

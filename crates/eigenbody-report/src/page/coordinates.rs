//! What the numbers of a configuration are called.

use eigenbody::Model;

/// Name and unit of every coordinate.
pub fn coordinates(model: &Model<f64>) -> Vec<(String, &'static str)> {
    let mut names = Vec::with_capacity(model.nq());
    for joint in model.joints() {
        let dofs: Vec<usize> = joint.dofs().collect();
        if joint.kind().nq() == dofs.len() {
            let unit = |d: usize| if model.is_translation(d) { "m" } else { "rad" };
            names.extend(dofs.into_iter().map(|d| (model.dof_name(d), unit(d))));
        } else {
            // A displacement if there is one, then a unit quaternion.
            let moves = joint.kind().nq() - 4;
            let parts = ["x", "y", "z"].into_iter().take(moves).map(|part| (part, "m"));
            let turns = ["w", "x", "y", "z"].map(|part| (part, "1"));
            names.extend(parts.chain(turns).map(|(part, unit)| (format!("{}/{part}", joint.name()), unit)));
        }
    }
    names
}

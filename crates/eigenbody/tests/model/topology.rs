//! Bodies in pre-order, whatever the order of the description.

use crate::robots::plan;
use eigenbody::{Base, Model};

/// Number of bodies in the subtree of each body, itself included.
fn sizes(model: &Model<f64>) -> Vec<usize> {
    let mut sizes = vec![1; model.bodies().len()];
    for (i, body) in model.bodies().iter().enumerate().rev() {
        if let Some(parent) = body.parent() {
            sizes[parent] += sizes[i];
        }
    }
    sizes
}

#[test]
fn parents_come_first_and_subtrees_are_contiguous() {
    for seed in 0..60 {
        let base = if seed % 2 == 0 { Base::Fixed } else { Base::Floating };
        let model = plan::<f64>(seed, 1 + seed as usize).build(base);
        let sizes = sizes(&model);
        for (i, body) in model.bodies().iter().enumerate() {
            let Some(parent) = body.parent() else { continue };
            assert!(
                parent < i && i + sizes[i] <= parent + sizes[parent],
                "seed {seed}: body {i} on {parent}"
            );
        }
    }
}

/// Siblings stand in the order of their joints; DoFs in that order too, a floating base before them all.
#[test]
fn siblings_and_dofs_keep_the_order_of_the_joints() {
    for seed in 0..60 {
        let base = if seed % 2 == 0 { Base::Fixed } else { Base::Floating };
        let plan = plan::<f64>(seed, 1 + seed as usize);
        let model = plan.build(base);
        let moving = plan.joints.iter().filter(|joint| joint.kind.nv() > 0).map(|joint| joint.name.as_str());
        let floating = (base == Base::Floating).then_some("floating_base");
        let names: Vec<&str> = model.joints().iter().map(eigenbody::model::JointInfo::name).collect();
        assert_eq!(names, floating.into_iter().chain(moving).collect::<Vec<_>>());
        let mut next = 0;
        for joint in model.joints() {
            assert_eq!(joint.dofs().start, next);
            next = joint.dofs().end;
        }
        assert_eq!(next, model.nv());
    }
}

/// The expanded parent array: DoFs of one body in a row, the first on the last of the parent's.
#[test]
fn dof_parents_follow_the_bodies() {
    for seed in 0..60 {
        let model = plan::<f64>(seed, 1 + seed as usize).build(Base::Floating);
        let mut order = Vec::new();
        for body in model.bodies() {
            let mut above = body.parent().map(|p| model.bodies()[p].dofs().end - 1);
            for d in body.dofs() {
                assert_eq!(model.dofs().parent(d), above);
                above = Some(d);
                order.push(d);
            }
        }
        assert_eq!(model.dofs().order().collect::<Vec<_>>(), order);
    }
}

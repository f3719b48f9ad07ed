//! `eigenbody info`.

use crate::args::{BaseArg, InfoArgs};
use crate::failure::Failure;
use crate::output::{deliver, page};
use crate::system::open;
use eigenbody::Model;
use eigenbody_report::{BodyRow, DofRow, InfoReport};

/// Prints what a model consists of.
pub fn run(args: &InfoArgs) -> Result<(), Failure> {
    let loaded = open(&args.model, args.base)?;
    let model = &loaded.model;
    let report = InfoReport {
        model: args.model.clone(),
        name: model.name().to_owned(),
        base: if args.base == BaseArg::Fixed { "fixed" } else { "floating" }.to_owned(),
        nq: model.nq(),
        nv: model.nv(),
        mass: model.bodies().iter().map(|b| b.inertia().m).sum(),
        bodies: bodies(model),
        dofs: dofs(model),
        keyframes: loaded.keyframes().iter().map(|key| key.name.clone()).collect(),
        findings: if loaded.is_family() { Vec::new() } else { loaded.findings() },
    };
    match args.json {
        true => {
            let json = report.to_json().map_err(|error| Failure::Json(error.to_string()))?;
            deliver(None, |out| writeln!(out, "{json}"))
        }
        false => page(None, &report.to_text()),
    }
}

fn bodies(model: &Model<f64>) -> Vec<BodyRow> {
    let mut depth: Vec<usize> = Vec::new();
    let rows = model.bodies().iter().map(|body| {
        let level = body.parent().map_or(0, |p| depth[p] + 1);
        depth.push(level);
        BodyRow {
            name: model.links()[body.link()].name().to_owned(),
            depth: level,
            joint: body.joint().kind().to_owned(),
            mass: body.inertia().m,
        }
    });
    rows.collect()
}

fn dofs(model: &Model<f64>) -> Vec<DofRow> {
    let of_joint = |j: &eigenbody::model::JointInfo<f64>| {
        let (q, limits, kind) = (j.coordinates(), j.limits(), j.kind().kind().to_owned());
        let follows = model.coupling().map(|c| c.follows(q.start).0).filter(|&leader| leader != q.start);
        let leader = follows.and_then(|k| model.joints().iter().find(|j| j.coordinates().start == k));
        let leader = leader.map(|j| j.name().to_owned());
        j.dofs()
            .map(|d| DofRow {
                dof: d,
                name: model.dof_name(d),
                kind: kind.clone(),
                coordinates: [q.start, q.end],
                unit: if model.is_translation(d) { "m" } else { "rad" }.to_owned(),
                limits,
                armature: model.armature()[d],
                follows: leader.clone(),
            })
            .collect::<Vec<_>>()
    };
    model.joints().iter().flat_map(of_joint).collect()
}

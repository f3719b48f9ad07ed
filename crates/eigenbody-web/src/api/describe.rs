//! `POST /api/model`: a robot is made, and described once; all that changes with q is for the other questions.

use super::{Answer, json};
use crate::asked::AskedLarge;
use crate::explorer::Explorer;
use crate::looks::{ShapeView, shapes};
use crate::refusal::Refusal;
use crate::robot::{EXAMINED, Edits, Options, Request, Robot, Source, WHOLE};
use crate::work::Pace;
use axum::extract::{Path as UrlPath, State};
use axum::http::StatusCode;
use eigenbody::model::JointInfo;
use eigenbody::{Joint, Metric, Model};
use eigenbody_formats::{write_mjcf, write_urdf_with_rotors};
use eigenbody_study::explore::{even_box, extent, link_inertia, pose, settled, stance};
use serde::Serialize;
use std::f64::consts::PI;
use std::path::Path;
use std::sync::Arc;

/// Numbers for drawing.
pub type Pose = [f32; 7];

/// The robot.
#[derive(Serialize)]
struct Description<'a> {
    id: &'a str,
    name: &'a str,
    robot: &'a str,
    source: &'a Source,
    options: Options,
    edits: &'a Edits,
    format: &'static str,
    nq: usize,
    nv: usize,
    mass: f64,
    gravity: [f64; 3],
    extent: f64,
    can: Can,
    bodies: Vec<BodyView>,
    still: Vec<ShapeView>,
    dofs: Vec<DofView>,
    rows: &'a [usize],
    joints: Vec<JointView<'a>>,
    coordinates: Vec<CoordinateView>,
    keyframes: Vec<KeyframeView<'a>>,
    q0: Vec<f64>,
    unit: &'static str,
    findings: Vec<FindingView>,
    text: Option<&'a str>,
    patch: Patch,
    limits: Limits,
}

/// Which options would do something.
#[derive(Serialize)]
struct Can {
    float: bool,
    mimic: bool,
    rotors: bool,
}

#[derive(Serialize)]
struct BodyView {
    link: String,
    parent: Option<usize>,
    mass: f64,
    /// In the link's frame.
    centre: [f32; 3],
    dofs: Vec<usize>,
    #[serde(rename = "box")]
    even: Option<BoxView>,
    shapes: Vec<ShapeView>,
}

#[derive(Serialize)]
struct BoxView {
    pose: Pose,
    half: [f32; 3],
}

#[derive(Serialize)]
struct DofView {
    name: String,
    joint: usize,
    body: usize,
    slides: bool,
    armature: f64,
}

#[derive(Serialize)]
struct JointView<'a> {
    name: &'a str,
    kind: &'static str,
    q: usize,
    nq: usize,
    dofs: Vec<usize>,
    limits: Option<[Option<f64>; 2]>,
    range: [f64; 2],
    unit: &'static str,
    follows: Option<&'a str>,
}

#[derive(Serialize)]
struct CoordinateView {
    name: String,
    unit: &'static str,
}

#[derive(Serialize)]
struct KeyframeView<'a> {
    name: &'a str,
    q: &'a [f64],
}

#[derive(Serialize)]
struct FindingView {
    code: &'static str,
    subject: String,
    message: String,
    place: Option<PlaceView>,
}

#[derive(Serialize)]
struct PlaceView {
    file: String,
    line: u32,
    column: u32,
}

/// Which formats can say what the model is, and why others cannot.
#[derive(Serialize)]
struct Patch {
    urdf: bool,
    mjcf: bool,
    why: Why,
}

#[derive(Serialize)]
struct Why {
    urdf: Option<String>,
    mjcf: Option<String>,
}

/// What the costlier questions take for this robot.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Limits {
    /// Points a side of a map.
    pub map: usize,
    /// Points of a path.
    pub path: usize,
    /// Frames of a swing.
    pub frames: usize,
    /// Whether it can be examined over its joint limits.
    pub check: bool,
    /// Whether there is a matrix and all eigenvalues.
    pub whole: bool,
}

/// Points times rows that a map or a path may have: a second or two.
const POINTS: usize = 400_000;

impl Limits {
    /// For so many rows, degrees of freedom at most.
    pub fn of(robot: &Robot) -> Self {
        let n = robot.rows.len().max(1);
        // From the matrix where followers break the tree: as the cube.
        let coupled = robot.reduction.mimic && robot.model().coupling().is_some();
        let points = if coupled { POINTS / n / (1 + n * n / 400) } else { POINTS / n };
        let map = ((points as f64).sqrt() as usize).clamp(3, 64);
        Self {
            map,
            path: points.clamp(11, 400),
            frames: (100_000 / robot.model().bodies().len().max(1)).clamp(5, 64),
            check: (1..=EXAMINED).contains(&robot.rows.len()),
            whole: robot.rows.len() <= WHOLE,
        }
    }
}

pub async fn model(
    State(explorer): State<Arc<Explorer>>,
    AskedLarge(request): AskedLarge<Request>,
) -> Answer {
    let known = if request.is_lasting() { explorer.models.made_by(&request) } else { None };
    let (id, shared) = (explorer.models.next_id(), Arc::clone(&explorer));
    let made = explorer.workers.run(Pace::Quick, move || {
        let robot = match known {
            Some(robot) => robot,
            None => Arc::new(Robot::new(id, request, shared.opening.file.as_deref())?),
        };
        let text = serde_json::to_vec(&describe(&robot, &shared)?)?;
        Ok((robot, text))
    });
    let (robot, text) = made.await?;
    if explorer.models.get(&robot.id).is_none() {
        explorer.models.keep(robot);
    }
    Ok(json(text))
}

/// `GET /api/mesh/K`: triangles, named by shapes.
pub async fn mesh(State(explorer): State<Arc<Explorer>>, UrlPath(k): UrlPath<String>) -> Answer {
    match k.parse().ok().and_then(|k| explorer.meshes.get(k)) {
        Some(mesh) => Ok(json(mesh.to_vec())),
        None => Err(Refusal::new(StatusCode::NOT_FOUND, "path", "no such mesh")),
    }
}

fn describe<'r>(robot: &'r Robot, explorer: &Explorer) -> Result<Description<'r>, Refusal> {
    let opened = explorer.opening.file.as_deref().filter(|_| !robot.request.is_lasting());
    let (shapes, still) = shapes(robot, &explorer.meshes, opened.map(Path::new));
    let (model, loaded) = (robot.model(), &robot.loaded);
    let q0 = settled(model, robot.reduction, &loaded.configuration("zero", robot.reduction.mimic)?)?;
    let stance = stance(model, &q0)?;
    let Options { base, reduced, rotors, .. } = robot.request.options;
    let options = Options {
        base,
        reduced: robot.reduction.base || reduced,
        mimic: Some(robot.reduction.mimic),
        rotors,
    };
    let written = [write_urdf_with_rotors(model).map(drop), write_mjcf(model).map(drop)];
    let [urdf, mjcf] = written.map(|written| written.err().map(|error| error.to_string()));
    let remarks = if loaded.is_family() { Vec::new() } else { loaded.remarks() };
    Ok(Description {
        id: &robot.id,
        name: &loaded.name,
        robot: model.name(),
        source: &robot.request.source,
        options,
        edits: &robot.request.edits,
        format: robot.format(),
        nq: model.nq(),
        nv: model.nv(),
        mass: model.bodies().iter().map(|body| body.inertia().m).sum(),
        gravity: model.gravity().to_array(),
        extent: extent(model, &stance),
        can: Can {
            float: robot.format() != "builtin",
            mimic: model.coupling().is_some(),
            rotors: !loaded.rotors.is_empty(),
        },
        bodies: bodies(model, shapes),
        still,
        dofs: dofs(model),
        rows: &robot.rows,
        joints: model.joints().iter().map(|joint| joint_view(robot, joint)).collect(),
        coordinates: coordinates(model),
        keyframes: loaded.keyframes().iter().map(|key| KeyframeView { name: &key.name, q: &key.q }).collect(),
        q0,
        unit: Metric::<f64>::Euclidean.unit(robot.rows.iter().map(|&d| model.is_translation(d))),
        findings: remarks
            .into_iter()
            .map(|remark| FindingView {
                code: remark.code,
                subject: remark.subject,
                message: remark.text,
                place: remark.place.map(|(file, at)| PlaceView { file, line: at.line, column: at.column }),
            })
            .collect(),
        text: robot.text.as_deref(),
        patch: Patch { urdf: urdf.is_none(), mjcf: mjcf.is_none(), why: Why { urdf, mjcf } },
        limits: Limits::of(robot),
    })
}

fn bodies(model: &Model<f64>, shapes: Vec<Vec<ShapeView>>) -> Vec<BodyView> {
    let view = |(body, shapes): (&eigenbody::model::Body<f64>, Vec<ShapeView>)| {
        let inertia = link_inertia(model, body.link());
        let even = inertia.as_ref().and_then(even_box);
        BodyView {
            link: model.links()[body.link()].name().to_owned(),
            parent: body.parent(),
            mass: body.inertia().m,
            centre: inertia.map_or([0.0; 3], |inertia| inertia.central().1.to_array()).map(|x| x as f32),
            dofs: body.dofs().collect(),
            even: even.map(|even| BoxView {
                pose: pose(&even.frame).map(|x| x as f32),
                half: even.half.map(|x| x as f32),
            }),
            shapes,
        }
    };
    model.bodies().iter().zip(shapes).map(view).collect()
}

fn dofs(model: &Model<f64>) -> Vec<DofView> {
    let mut body_of = vec![0; model.nv()];
    for (i, body) in model.bodies().iter().enumerate() {
        body.dofs().for_each(|d| body_of[d] = i);
    }
    let mut found = Vec::with_capacity(model.nv());
    for (joint, info) in model.joints().iter().enumerate() {
        found.extend(info.dofs().map(|d| DofView {
            name: model.dof_name(d),
            joint,
            body: body_of[d],
            slides: model.is_translation(d),
            armature: model.armature()[d],
        }));
    }
    found
}

fn joint_view<'a>(robot: &'a Robot, joint: &'a JointInfo<f64>) -> JointView<'a> {
    let model = robot.model();
    let slides = matches!(joint.kind(), Joint::Prismatic);
    let q = joint.coordinates().start;
    let leader = robot.leader(q).filter(|_| joint.kind().nq() == 1);
    let follows = leader.and_then(|leader| model.joints().iter().find(|j| j.coordinates().contains(&leader)));
    let finite = |x: f64| x.is_finite().then_some(x);
    JointView {
        name: joint.name(),
        kind: joint.kind().kind(),
        q,
        nq: joint.kind().nq(),
        dofs: joint.dofs().collect(),
        limits: joint.limits().map(|(lo, hi)| [finite(lo), finite(hi)]),
        range: range(joint),
        unit: if slides { "m" } else { "rad" },
        follows: follows.map(JointInfo::name),
    }
}

/// What a slider or a map covers: the limits where they are finite and no wider than two turns, else a turn, or 2 m.
pub fn range(joint: &JointInfo<f64>) -> [f64; 2] {
    let slides = matches!(joint.kind(), Joint::Prismatic);
    let reach = if slides { 1.0 } else { PI };
    let widest = if slides { f64::MAX } else { 2.0 * PI };
    match joint.limits() {
        Some((lo, hi)) if lo.abs() <= widest && hi.abs() <= widest => [lo, hi],
        _ => [-reach, reach],
    }
}

/// Name and unit of every coordinate.
fn coordinates(model: &Model<f64>) -> Vec<CoordinateView> {
    let mut found = Vec::with_capacity(model.nq());
    for joint in model.joints() {
        let dofs: Vec<usize> = joint.dofs().collect();
        if joint.kind().nq() == dofs.len() {
            found.extend(dofs.into_iter().map(|d| CoordinateView {
                name: model.dof_name(d),
                unit: if model.is_translation(d) { "m" } else { "rad" },
            }));
        } else {
            // A displacement if there is one, then a unit quaternion.
            let moves = joint.kind().nq() - 4;
            let parts = ["x", "y", "z"].into_iter().take(moves).map(|part| (part, "m"));
            let turns = ["w", "x", "y", "z"].map(|part| (part, "1"));
            let name = |(part, unit): (&str, &'static str)| CoordinateView {
                name: format!("{}/{part}", joint.name()),
                unit,
            };
            found.extend(parts.chain(turns).map(name));
        }
    }
    found
}

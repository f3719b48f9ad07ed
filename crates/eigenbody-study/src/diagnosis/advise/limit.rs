//! A limit that keeps a robot away from where it is bad.
//!
//! ```text
//! keep [b, u] or [l, b] of a limited joint, all but (q* − b, q* + b) of one that turns freely, q* the worst configuration:
//! the smaller what is kept, the better its worst; the smallest loss that does is found by bisection
//! ```
//! Every trial is a search of the robot so limited: a lower bound on how bad it gets, as every search.

use super::Judge;
use crate::StudyError;
use eigenbody::Model;
use std::f64::consts::{PI, TAU};

/// Joints that are tried.
const JOINTS: usize = 4;
/// Bisections.
const ROUNDS: usize = 7;
/// A joint that loses more than this part of its range is not worth having.
const MOST: f64 = 0.5;

/// A limit on one joint.
#[derive(Debug, Clone, PartialEq)]
pub struct LimitAdvice {
    /// The joint.
    pub joint: String,
    /// Its position among the model's joints.
    pub index: usize,
    /// What it may do now (rad, m); a turn for one without limits.
    pub range: (f64, f64),
    /// What it may do with the limit.
    pub kept: (f64, f64),
    /// The part of the range that is lost.
    pub lost: f64,
    /// The worst value of the goal's measure on the limited robot.
    pub reached: f64,
}

/// Limits that do, the smallest loss first. `soft`: the softest motion at `at`.
pub(super) fn limits(
    model: &Model<f64>,
    judge: &Judge<'_>,
    at: &[f64],
    soft: &[f64],
) -> Result<Vec<LimitAdvice>, StudyError> {
    let mut found = Vec::new();
    for index in between(model, judge, soft).into_iter().take(JOINTS) {
        let joint = &model.joints()[index];
        let limits = joint.limits().filter(|(l, u)| l.is_finite() && u.is_finite() && u > l);
        let turns = limits.is_none() && !model.is_translation(joint.dofs().start);
        let q = at[joint.coordinates().start];
        let losses: Vec<Loss> = match (limits, turns) {
            (Some((l, u)), _) => {
                let place = ((q - l) / (u - l)).clamp(0.0, 1.0);
                // What is nearer to the worst is given away.
                let range = (l, u);
                vec![Loss::Below { range, place }, Loss::Above { range, place }]
            }
            (None, true) => vec![Loss::About { q }],
            (None, false) => Vec::new(),
        };
        for loss in losses {
            found.extend(least_loss(model, judge, index, loss)?);
        }
    }
    found.sort_by(|a, b| a.lost.total_cmp(&b.lost));
    Ok(found)
}

/// One-coordinate joints on the path between the two that move most, those two included.
fn between(model: &Model<f64>, judge: &Judge<'_>, soft: &[f64]) -> Vec<usize> {
    let rows = judge.wish.reduction.dofs(model);
    let mut order: Vec<usize> = (0..soft.len()).collect();
    order.sort_by(|&a, &b| soft[b].abs().total_cmp(&soft[a].abs()));
    let body_of = |d: usize| model.bodies().iter().position(|body| body.dofs().contains(&rows[d]));
    let [Some(a), Some(b)] = [0, 1].map(|k| order.get(k).and_then(|&d| body_of(d))) else {
        return Vec::new();
    };
    let (near, far) = (a.min(b), a.max(b));
    let mut path = Vec::new();
    let mut body = Some(far);
    while let Some(i) = body.filter(|&i| i >= near) {
        let first = model.bodies()[i].dofs().start;
        let joint = model.joints().iter().position(|joint| joint.dofs().start == first);
        path.extend(joint.filter(|&j| model.joints()[j].kind().nq() == 1 && rows.contains(&first)));
        if i == near {
            break;
        }
        body = model.bodies()[i].parent();
    }
    // Those in between first: they set how the outer two stand to each other.
    if path.len() > 2 {
        let far = path.remove(0);
        path.push(far);
    }
    path
}

/// Which part of a joint's range is lost; `place`: where the worst configuration is in the range, from 0 to 1.
#[derive(Clone, Copy)]
enum Loss {
    /// What is below.
    Below { range: (f64, f64), place: f64 },
    /// What is above.
    Above { range: (f64, f64), place: f64 },
    /// The neighbourhood of q, of a joint that turns freely.
    About { q: f64 },
}

impl Loss {
    /// What the joint may do now.
    fn range(self) -> (f64, f64) {
        match self {
            Self::Below { range, .. } | Self::Above { range, .. } => range,
            Self::About { q } => (q - PI, q + PI),
        }
    }

    /// What stays when a part of the range is lost.
    fn kept(self, lost: f64) -> (f64, f64) {
        let (l, u) = self.range();
        match self {
            Self::Below { .. } => (l + lost * (u - l), u),
            Self::Above { .. } => (l, u - lost * (u - l)),
            // From beyond the worst, once around.
            Self::About { .. } => (l + PI + 0.5 * lost * TAU, l + PI + TAU - 0.5 * lost * TAU),
        }
    }

    /// The loss at which the worst configuration is just given away.
    fn least(self) -> f64 {
        match self {
            Self::Below { place, .. } => place,
            Self::Above { place, .. } => 1.0 - place,
            Self::About { .. } => 0.0,
        }
    }
}

fn least_loss(
    model: &Model<f64>,
    judge: &Judge<'_>,
    index: usize,
    loss: Loss,
) -> Result<Option<LimitAdvice>, StudyError> {
    if loss.least() >= MOST {
        return Ok(None);
    }
    let reached = |lost: f64| -> Result<f64, StudyError> {
        let limited = model.clone().with_limits(index, Some(loss.kept(lost)))?;
        Ok(judge.worst(&limited, 0)?.1)
    };
    let mut best = (MOST, reached(MOST)?);
    if !judge.wish.goal.holds(best.1) {
        return Ok(None);
    }
    let mut low = loss.least();
    for _ in 0..ROUNDS {
        let middle = 0.5 * (low + best.0);
        let value = reached(middle)?;
        if judge.wish.goal.holds(value) { best = (middle, value) } else { low = middle }
    }
    let (lost, reached) = best;
    let joint = model.joints()[index].name().to_owned();
    Ok(Some(LimitAdvice { joint, index, range: loss.range(), kept: loss.kept(lost), lost, reached }))
}

//! `<connect>` and `<weld>`: loops, closed where MuJoCo closes them.
//!
//! ```text
//! connect, by bodies   a point of body 1, and the point of body 2 that lies there in the pose that the file describes
//! weld, by bodies      the pose of body 2 in body 1: relpose, or the one that the file describes
//! by sites             both frames as they are
//! ```

use super::attribute::array;
use super::build::Placed;
use super::fault::Fault;
use crate::xml::Element;
use eigenbody::Model;
use eigenbody::dynamics::{Anchor, Closure, Tie, link_pose};
use eigenbody::spatial::{Mat3, Transform, Vec3};
use std::collections::HashMap;

/// A loop as it is read.
#[derive(Debug)]
pub(super) struct Loop {
    pub name: String,
    tie: Tie,
    ends: [End; 2],
    /// From body 1's frame to the anchor's, where the file gives it.
    anchor: Transform<f64>,
    relpose: Option<Transform<f64>>,
}

/// What an end is fastened to, with its full name.
#[derive(Debug)]
enum End {
    World,
    Body(String),
    Site(String),
}

/// Bodies and sites by name: their links, and from the links' frames to their own.
#[derive(Default)]
pub(super) struct Frames {
    pub bodies: HashMap<String, Placed>,
    pub sites: HashMap<String, Anchor>,
}

/// Reads an element; the names in it are prefixed.
pub(super) fn read(element: &Element, prefix: &str) -> Result<Loop, Fault> {
    let tag = element.tag.as_str();
    let end = |body: &str, site: &str| {
        let full = |name: &str| format!("{prefix}{name}");
        match (element.get(site), element.get(body)) {
            (Some(name), _) => End::Site(full(name)),
            (None, Some("world") | None) => End::World,
            (None, Some(name)) => End::Body(full(name)),
        }
    };
    let anchor = Vec3::from_f64(array(element.find("anchor"), tag)?.unwrap_or_default());
    let tie = if tag == "weld" { Tie::Weld } else { Tie::Ball };
    let relpose: Option<[f64; 7]> = array(element.find("relpose"), tag)?;
    let relpose = relpose.filter(|p| p[3..] != [0.0; 4]).map(|[x, y, z, w, a, b, c]| {
        Transform::new(Mat3::rotation_quaternion(w, Vec3::new(a, b, c)), Vec3::new(x, y, z))
    });
    Ok(Loop {
        name: element.described(),
        tie,
        ends: [end("body1", "site1"), end("body2", "site2")],
        // Of a weld, it changes units of the error and not what is held.
        anchor: if tie == Tie::Weld { Transform::IDENTITY } else { Transform::translation(anchor) },
        relpose,
    })
}

/// The closure of a loop of a model whose file describes the pose `reference`; none if an end is not known.
pub(super) fn closure(
    found: &Loop,
    frames: &Frames,
    model: &Model<f64>,
    reference: &[f64],
) -> Option<Closure> {
    let anchor = |end: &End| match end {
        End::World => Some(Anchor { link: None, pose: Transform::IDENTITY }),
        End::Body(name) => {
            let placed = frames.bodies.get(name)?;
            Some(Anchor { link: Some(placed.link.index()), pose: Transform::translation(-placed.origin) })
        }
        End::Site(name) => frames.sites.get(name).copied(),
    };
    let [mut a, mut b] = [anchor(&found.ends[0])?, anchor(&found.ends[1])?];
    if !matches!(found.ends[0], End::Site(_)) {
        let from_world = |anchor: &Anchor| match anchor.link {
            Some(link) => link_pose(model, reference, link).ok().map(|X| anchor.pose * X),
            None => Some(anchor.pose),
        };
        let own = found.relpose.unwrap_or(found.anchor);
        if found.relpose.is_some() {
            a.pose = own * a.pose;
        } else if found.tie == Tie::Weld {
            a.pose = from_world(&b)? * from_world(&a)?.inverse() * a.pose;
        } else {
            let point = own * from_world(&a)?;
            a.pose = own * a.pose;
            b.pose = point * from_world(&b)?.inverse() * b.pose;
        }
    }
    Some(Closure { name: found.name.clone(), tie: found.tie, anchors: [a, b] })
}

//! `<joint>`: what carries one link on another.

use super::element::{Element, Fault};
use super::fault::UrdfFault;
use super::pose::origin;
use eigenbody::Joint;
use eigenbody::model::{JointSpec, LinkId, MimicSpec};
use eigenbody::spatial::Vec3;

/// A joint; `find` gives a link's id, or what to suggest in its place.
pub(super) fn read<'a>(
    element: Element<'a, '_>,
    find: impl Fn(&str) -> Result<LinkId, String>,
) -> Result<JointSpec<f64>, Fault> {
    let name = element.attribute("name")?;
    let kind = kind(element, name)?;
    let link = |role: &'static str| {
        let end = element.required_child(role)?;
        let link = end.attribute("link")?;
        find(link).map_err(|suggestion| {
            let (joint, link) = (name.to_owned(), link.to_owned());
            end.fault_at("link", UrdfFault::UnknownLink { joint, role, link, suggestion })
        })
    };
    let (parent, child) = (link("parent")?, link("child")?);
    Ok(JointSpec {
        placement: origin(element)?,
        axis: axis(element)?,
        limits: limits(element, &kind)?,
        mimic: mimic(element)?,
        ..JointSpec::new(name, kind, parent, child)
    })
}

fn kind(element: Element<'_, '_>, joint: &str) -> Result<Joint<f64>, Fault> {
    Ok(match element.attribute("type")? {
        "revolute" => Joint::Revolute,
        "continuous" => Joint::Continuous,
        "prismatic" => Joint::Prismatic,
        "fixed" => Joint::Fixed,
        "floating" => Joint::Floating,
        "planar" => Joint::Planar,
        found => {
            let (joint, found) = (joint.to_owned(), found.to_owned());
            return Err(element.fault_at("type", UrdfFault::JointType { joint, found }));
        }
    })
}

/// The axis in the joint's frame, x if none is given.
fn axis(element: Element<'_, '_>) -> Result<Vec3<f64>, Fault> {
    let Some(axis) = element.child("axis")? else { return Ok(Vec3::X) };
    axis.attribute("xyz")?;
    Ok(Vec3::from_f64(axis.numbers("xyz")?.unwrap_or_default()))
}

/// Lower and upper limit of a revolute or prismatic joint; a bound that `<limit>` leaves out is 0.
fn limits(element: Element<'_, '_>, kind: &Joint<f64>) -> Result<Option<(f64, f64)>, Fault> {
    if !matches!(kind, Joint::Revolute | Joint::Prismatic) {
        return Ok(None);
    }
    let Some(limit) = element.child("limit")? else { return Ok(None) };
    let bound = |name| Ok(limit.number(name)?.unwrap_or(0.0));
    Ok(Some((bound("lower")?, bound("upper")?)))
}

/// The joint that this one follows: coordinate = multiplier · its coordinate + offset.
fn mimic(element: Element<'_, '_>) -> Result<Option<MimicSpec<f64>>, Fault> {
    let Some(mimic) = element.child("mimic")? else { return Ok(None) };
    Ok(Some(MimicSpec {
        joint: mimic.attribute("joint")?.to_owned(),
        multiplier: mimic.number("multiplier")?.unwrap_or(1.0),
        offset: mimic.number("offset")?.unwrap_or(0.0),
    }))
}

//! `<attach>`: a body, a frame or a whole model in another place, its names prefixed.

use super::asset::Assets;
use super::attribute::required;
use super::body::{Body, Part, Rename, WORLD};
use super::compiler::Compiler;
use super::defaults::Defaults;
use super::document::{Document, Model};
use super::fault::{Fault, MjcfFault, fault, unsupported};
use super::names;
use super::orientation::pose;
use super::world::{Context, Reader};
use crate::suggest::did_you_mean;
use crate::xml::Element;
use std::rc::Rc;

/// Most attachments of one file: each looks through all bodies.
const MAX_ATTACHMENTS: usize = 10_000;

/// What stands in a frame: a body without a parent, whose contents they are.
struct Contents {
    part: Part,
    holder: usize,
}

/// Attaches what an element names to a body, inside a frame.
pub(super) fn attach<'a>(reader: &mut Reader<'a>, element: &'a Element, at: Context) -> Result<(), Fault> {
    let prefix = required(element, "prefix")?.value.clone();
    reader.attachments += 1;
    if reader.attachments > MAX_ATTACHMENTS {
        return Err(fault(element.at, MjcfFault::TooManyAttachments { limit: MAX_ATTACHMENTS }));
    }
    let rename = Rename::Prefix(&prefix);
    let (body, frame) = (element.get("body"), element.get("frame"));
    let Some(model_name) = element.get("model") else {
        match (body, frame) {
            (Some(name), _) => {
                let bodies = &reader.tree.bodies;
                let id =
                    find(bodies, name).ok_or_else(|| nothing(element, "body", name, body_names(bodies)))?;
                let (source, id) = reader.tree.part(id);
                let pose = source.body(id).own_pose * at.frame;
                reader.tree.copy_body(&source, id, at.body, pose, &rename);
            }
            (None, Some(name)) => {
                let contents = frame_contents(reader, element, name)?;
                reader.tree.copy_contents(&contents.part, contents.holder, at.body, at.frame, &rename);
            }
            (None, None) => return Err(unsupported(element, "it names neither model, body nor frame")),
        }
        return reader.check_size(element);
    };
    let Some(&asset) = reader.assets.models.get(model_name) else {
        let names = reader.assets.models.keys().map(String::as_str);
        let suggestion = did_you_mean(model_name, names);
        let (kind, name) = ("model".to_owned(), model_name.to_owned());
        return Err(fault(element.spot_of("model"), MjcfFault::Unknown { kind, name, suggestion }));
    };
    let found = reader.document.model.models.iter().find(|(at, _)| *at == asset.at);
    let Some((_, model)) = found else { return Err(unsupported(element, "its model was not loaded")) };
    let contents = of_model(model, reader, element, body, frame)?;
    match body {
        Some(_) => {
            let pose = contents.part.body(contents.holder).own_pose * at.frame;
            reader.tree.copy_body(&contents.part, contents.holder, at.body, pose, &rename);
        }
        None => reader.tree.copy_contents(&contents.part, contents.holder, at.body, at.frame, &rename),
    }
    // Its other sections speak of all that was attached under one prefix.
    if !reader.attached.iter().any(|(known, p)| std::ptr::eq(*known, model) && *p == prefix) {
        reader.attached.push((model, prefix.clone()));
    }
    reader.check_size(element)
}

/// The part of a model that is attached.
fn of_model(
    model: &Model,
    outer: &Reader<'_>,
    element: &Element,
    body: Option<&str>,
    frame: Option<&str>,
) -> Result<Contents, Fault> {
    let document = Document::new(model, outer.document.files);
    let settings = Rc::new(Compiler::read(&model.root)?);
    let defaults = Defaults::read(&model.root, outer.document.files)?;
    names::classes(&model.root, &defaults)?;
    let assets = Assets::read(&model.root, &defaults, outer.document.files)?;
    let mut reader = Reader::new(&document, &defaults, &settings, &assets);
    reader.sites |= outer.sites;
    reader.read(false)?;
    match (body, frame) {
        (Some(name), _) => {
            let part = reader.tree.split_off(WORLD);
            let holder = find(&part.bodies, name)
                .ok_or_else(|| nothing(element, "body", name, body_names(&part.bodies)))?;
            Ok(Contents { part, holder })
        }
        (None, Some(name)) => frame_contents(&mut reader, element, name),
        (None, None) => Ok(Contents { part: reader.tree.split_off(WORLD), holder: WORLD }),
    }
}

/// Reads what stands in a named frame once more, into a body of its own.
fn frame_contents(reader: &mut Reader<'_>, element: &Element, name: &str) -> Result<Contents, Fault> {
    let found = reader.frames.iter().find(|(frame, _)| frame.get("name") == Some(name)).copied();
    let Some((frame, around)) = found else {
        let names = reader.frames.iter().filter_map(|(frame, _)| frame.get("name"));
        return Err(nothing(element, "frame", name, names));
    };
    let at = reader.tree.bodies[around.body].at;
    let holder = reader.tree.add_loose(Body::new(at, reader.settings));
    let class = reader.defaults.named(frame, "childclass")?.unwrap_or(around.class);
    let inside = Context { frame: pose(frame, reader.settings)?, ..Context::inside(holder, class) };
    reader.contents(frame, inside)?;
    Ok(Contents { part: reader.tree.split_off(holder), holder })
}

fn find(bodies: &[Body], name: &str) -> Option<usize> {
    bodies.iter().position(|b| b.name.as_deref() == Some(name))
}

fn body_names(bodies: &[Body]) -> impl Iterator<Item = &str> {
    bodies.iter().filter_map(|b| b.name.as_deref())
}

fn nothing<'n>(
    element: &Element,
    attribute: &str,
    name: &str,
    names: impl Iterator<Item = &'n str>,
) -> Fault {
    let suggestion = did_you_mean(name, names);
    fault(element.spot_of(attribute), MjcfFault::NothingToAttach { name: name.to_owned(), suggestion })
}

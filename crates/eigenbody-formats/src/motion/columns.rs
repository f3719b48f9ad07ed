//! Which column of a log is what.

use super::MotionOptions;
use crate::error::counted;
use crate::suggest::did_you_mean;
use eigenbody::Model;
use eigenbody::model::JointInfo;

/// What a table holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Wanted {
    /// Configurations, and velocities if there are any.
    #[default]
    Configurations,
    /// One force a degree of freedom; those without a column are zero.
    Forces,
}

/// Where a cell goes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Slot {
    Time,
    Coordinate(usize),
    Velocity(usize),
}

/// The columns of a log.
pub(super) struct Columns {
    /// As in the heading.
    pub names: Vec<String>,
    /// None for columns that are passed over.
    pub slots: Vec<Option<Slot>>,
    pub velocities: bool,
    /// What a row holds where no column says anything.
    pub template: Vec<f64>,
}

/// A name without its unit.
fn plain(name: &str) -> &str {
    name.split_once(" [").map_or(name, |(plain, _)| plain).trim()
}

/// k of `q12` for the letter `q`.
fn numbered(name: &str, letter: &str) -> Option<usize> {
    let digits = name.strip_prefix(letter)?;
    digits.bytes().all(|byte| byte.is_ascii_digit()).then(|| digits.parse().ok()).flatten()
}

impl Columns {
    pub fn find(names: &[String], model: &Model<f64>, options: &MotionOptions) -> Result<Self, String> {
        let (letter, count) = match options.wanted {
            Wanted::Configurations => ("q", model.nq()),
            Wanted::Forces => ("tau", model.nv()),
        };
        let is_numbered = names.iter().any(|name| numbered(plain(name), letter).is_some());
        let mut slots = Vec::new();
        for name in names {
            let name = plain(name);
            slots.push(match name {
                "t" | "time" => Some(Slot::Time),
                _ if is_numbered => numbered_slot(name, letter, count, model.nv())?,
                _ => Some(Slot::Coordinate(named(name, model, options.wanted)?)),
            });
        }
        for (k, slot) in slots.iter().enumerate() {
            if slot.is_some() && slots[..k].contains(slot) {
                return Err(format!("two columns hold '{}'", plain(&names[k])));
            }
        }
        if !slots.contains(&Some(Slot::Time)) {
            return Err("no column 't' or 'time'".into());
        }
        let mut found = Self { names: names.to_vec(), slots, velocities: false, template: Vec::new() };
        found.complete(count, model, options)?;
        Ok(found)
    }

    /// Checks that nothing is missing, or fills it in.
    fn complete(&mut self, count: usize, model: &Model<f64>, options: &MotionOptions) -> Result<(), String> {
        let has = |slot| self.slots.contains(&Some(slot));
        let velocities = (0..model.nv()).filter(|&d| has(Slot::Velocity(d))).count();
        if velocities != 0 && velocities != model.nv() {
            return Err(format!(
                "{} of velocities, expected none or {}",
                counted(velocities, "column", "columns"),
                model.nv()
            ));
        }
        self.velocities = velocities > 0;
        if options.wanted == Wanted::Forces {
            if !self.slots.iter().any(|slot| matches!(slot, Some(Slot::Coordinate(_)))) {
                return Err("no column of forces: tau0, tau1, .. or names of degrees of freedom".into());
            }
            self.template = vec![0.0; count];
            return Ok(());
        }
        let follower = |k: usize| match model.coupling().filter(|_| options.mimic) {
            Some(coupling) => coupling.follows(k).0 != k,
            None => false,
        };
        let missing = (0..count).find(|&k| !self.slots.contains(&Some(Slot::Coordinate(k))) && !follower(k));
        match (missing, &options.others) {
            (Some(k), None) => {
                let joint = model.joints().iter().find(|joint| joint.coordinates().contains(&k));
                let name = joint.map_or("?", |joint| joint.name());
                Err(format!("no column for joint '{name}' (q{k})"))
            }
            (_, others) => {
                self.template = others.clone().unwrap_or_else(|| model.neutral());
                Ok(())
            }
        }
    }
}

fn numbered_slot(name: &str, letter: &str, count: usize, nv: usize) -> Result<Option<Slot>, String> {
    if let Some(k) = numbered(name, letter) {
        return match k < count {
            true => Ok(Some(Slot::Coordinate(k))),
            false => Err(format!(
                "column '{name}': the robot has {letter}0 to {letter}{}",
                count.saturating_sub(1)
            )),
        };
    }
    match numbered(name, "v") {
        Some(d) if letter == "q" && d < nv => Ok(Some(Slot::Velocity(d))),
        Some(_) if letter == "q" => {
            Err(format!("column '{name}': the robot has v0 to v{}", nv.saturating_sub(1)))
        }
        _ => Ok(None),
    }
}

/// The coordinate of a joint, or the degree of freedom, with this name.
fn named(name: &str, model: &Model<f64>, wanted: Wanted) -> Result<usize, String> {
    let joints = || model.joints().iter();
    match wanted {
        Wanted::Configurations => match joints().find(|joint| joint.name() == name) {
            Some(joint) if joint.kind().nq() == 1 => Ok(joint.coordinates().start),
            Some(joint) => {
                let (n, first) = (joint.kind().nq(), joint.coordinates().start);
                Err(format!(
                    "joint '{name}' has {n} coordinates: name the columns q0, q1, .. (it begins at q{first})"
                ))
            }
            None => {
                Err(format!("unknown joint '{name}'{}", did_you_mean(name, joints().map(JointInfo::name))))
            }
        },
        Wanted::Forces => {
            let names: Vec<String> = (0..model.nv()).map(|d| model.dof_name(d)).collect();
            names.iter().position(|dof| dof == name).ok_or_else(|| {
                let near = did_you_mean(name, names.iter().map(String::as_str));
                format!("unknown degree of freedom '{name}'{near}")
            })
        }
    }
}

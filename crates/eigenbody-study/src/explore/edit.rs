//! A robot with other rotors and other masses.

use eigenbody::spatial::RigidInertia;
use eigenbody::{InputError, Model};
use std::collections::BTreeMap;
use thiserror::Error;

/// What is changed, by name.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Edits {
    /// Armature of DoFs (kg m², kg).
    pub armature: BTreeMap<String, f64>,
    /// Mass of links (kg). Density changes, shape stays: the whole inertia is scaled.
    pub mass: BTreeMap<String, f64>,
}

/// A change that cannot be made.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum EditError {
    /// No such DoF.
    #[error("no degree of freedom is named '{0}'")]
    NoDof(String),
    /// No such link, or one that is part of another or does not move.
    #[error("no moving link is named '{0}'")]
    NoLink(String),
    /// No number that an armature can be.
    #[error("armature of '{dof}' = {value}, expected a finite number, zero or more")]
    Armature {
        /// The DoF.
        dof: String,
        /// The number.
        value: f64,
    },
    /// No number that a mass can be.
    #[error("mass of '{link}' = {value}, expected a positive number")]
    Mass {
        /// The link.
        link: String,
        /// The number.
        value: f64,
    },
    /// There is nothing to scale.
    #[error("link '{0}' has no mass: what shape a mass would have is not known")]
    Weightless(String),
    /// The core refused.
    #[error(transparent)]
    Input(#[from] InputError),
}

/// The robot with changes made.
///
/// A link is called by the name of the link that its joint carries; links fastened to it count with it. Errors: [`EditError`].
///
/// ```
/// use eigenbody_study::explore::{Edits, edited};
/// let arm = eigenbody::Family::hydra(3, 1.0, 0.0, 1.0)?.model::<f64>()?;
/// let edits = Edits { mass: [("link_3".to_owned(), 2.0)].into(), ..Edits::default() };
/// assert_eq!(edited(arm, &edits)?.bodies()[2].inertia().m, 2.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn edited(mut model: Model<f64>, edits: &Edits) -> Result<Model<f64>, EditError> {
    if !edits.armature.is_empty() {
        let names: BTreeMap<String, usize> = (0..model.nv()).map(|d| (model.dof_name(d), d)).collect();
        let mut armature = model.armature().to_vec();
        for (dof, &value) in &edits.armature {
            let &d = names.get(dof).ok_or_else(|| EditError::NoDof(dof.clone()))?;
            if !(value >= 0.0 && value.is_finite()) {
                return Err(EditError::Armature { dof: dof.clone(), value });
            }
            armature[d] = value;
        }
        model = model.with_armature(armature)?;
    }
    for (name, &value) in &edits.mass {
        let named = |link: &usize| model.links()[*link].name() == name;
        let link = model.bodies().iter().map(eigenbody::model::Body::link).find(named);
        let link = link.ok_or_else(|| EditError::NoLink(name.clone()))?;
        if !(value > 0.0 && value.is_finite()) {
            return Err(EditError::Mass { link: name.clone(), value });
        }
        let inertia = link_inertia(&model, link).filter(|I| I.m > 0.0);
        let RigidInertia { m, h, I } = inertia.ok_or_else(|| EditError::Weightless(name.clone()))?;
        let scale = value / m;
        model = model.with_inertia(link, RigidInertia { m: value, h: h * scale, I: I.map(|x| x * scale) })?;
    }
    Ok(model)
}

/// Inertia of the body that a link is part of, in the link's frame; none for a link that does not move or is not there.
pub fn link_inertia(model: &Model<f64>, link: usize) -> Option<RigidInertia<f64>> {
    let link = model.links().get(link)?;
    let body = &model.bodies()[link.body()?];
    Some(link.link_from_body().inverse().transpose_rigid(*body.inertia()))
}

//! GAINS: a number for every joint, or for some.

use crate::error::{FormatError, shortened};
use crate::expression::{ExpressionError, Reader};
use crate::suggest::did_you_mean;
use eigenbody::Model;
use eigenbody::model::JointInfo;

/// The gains that a text names, one a DoF of the model, none where it says nothing: `100`, or `elbow=100, wrist=2*5`.
///
/// A number alone goes for every DoF but those of a floating base.
///
/// ```
/// let arm = eigenbody_formats::load("puma560", &Default::default())?.model;
/// let all = eigenbody_formats::gains("50", &arm)?;
/// assert_eq!(all, vec![Some(50.0); 6]);
/// # Ok::<(), eigenbody_formats::FormatError>(())
/// ```
/// Errors: [`FormatError::Expression`], also for a gain below zero.
pub fn gains(text: &str, model: &Model<f64>) -> Result<Vec<Option<f64>>, FormatError> {
    let mut reader = Reader::new(text);
    let base = model.base_dofs();
    let mut all = vec![None; model.nv()];
    if !text.contains('=') {
        let value = gain(&mut reader)?;
        all[base..].fill(Some(value));
        reader.end()?;
        return Ok(all);
    }
    loop {
        let (start, rest) = (reader.offset(), reader.rest());
        // The longest name: one may begin as another does.
        let named = model.joints().iter().filter(|joint| {
            rest.strip_prefix(joint.name()).is_some_and(|after| after.trim_start().starts_with('='))
        });
        let Some(joint) = named.max_by_key(|joint| joint.name().len()) else {
            let name = rest.split_once('=').map_or(rest, |(name, _)| name).trim();
            let names = model.joints().iter().map(JointInfo::name);
            let (name, hint) = (shortened(name), did_you_mean(name, names));
            return Err(reader.error(start, format!("no moving joint is named '{name}'{hint}")).into());
        };
        reader.skip(joint.name().len());
        reader.expect('=')?;
        let value = gain(&mut reader)?;
        if joint.dofs().any(|d| all[d].is_some()) {
            return Err(reader.error(start, format!("'{}' is named twice", shortened(joint.name()))).into());
        }
        joint.dofs().for_each(|d| all[d] = Some(value));
        match reader.rest() {
            "" => return Ok(all),
            _ if reader.eat(',') => {}
            _ => return Err(reader.unexpected("',' or the end").into()),
        }
    }
}

fn gain(reader: &mut Reader<'_>) -> Result<f64, ExpressionError> {
    let at = reader.offset();
    match reader.number()? {
        value if value < 0.0 => Err(reader.error(at, format!("gain {value}, expected none below zero"))),
        value => Ok(value),
    }
}

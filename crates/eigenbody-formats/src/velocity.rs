//! VELOCITY: how fast a robot moves.

use crate::error::{FormatError, numbers_of};
use crate::expression::{ExpressionError, Reader};
use crate::suggest::did_you_mean;
use eigenbody::Model;
use eigenbody::model::Random;

const EXPECTED: &str = "no velocity; expected zero, random(seed), v=[..] or dof=value, ..";

/// The velocity that a text names, one number a DoF (rad/s, m/s): `zero`, `random(seed)` (each between −1 and 1), `v=[..]`, or
/// `elbow=1, wrist=-2`.
///
/// ```
/// let arm = eigenbody_formats::load("puma560", &Default::default())?.model;
/// assert_eq!(eigenbody_formats::velocity("joint_2=-0.5", &arm)?, [0.0, -0.5, 0.0, 0.0, 0.0, 0.0]);
/// # Ok::<(), eigenbody_formats::FormatError>(())
/// ```
/// Errors: [`FormatError::Expression`].
pub fn velocity(text: &str, model: &Model<f64>) -> Result<Vec<f64>, FormatError> {
    Ok(read(text, model)?)
}

fn read(text: &str, model: &Model<f64>) -> Result<Vec<f64>, ExpressionError> {
    let mut reader = Reader::new(text);
    let mut v = vec![0.0; model.nv()];
    let word = reader.word();
    let after = reader.rest()[word.len()..].trim_start();
    match (word, after.chars().next()) {
        ("zero", None) => reader.skip(word.len()),
        ("random", Some('(')) => {
            reader.skip(word.len());
            reader.expect('(')?;
            let mut random = Random::new(reader.whole()?);
            reader.expect(')')?;
            v.iter_mut().for_each(|v| *v = random.between(-1.0, 1.0));
        }
        ("v", Some('=')) if after[1..].trim_start().starts_with('[') => {
            reader.skip(word.len());
            reader.expect('=')?;
            let start = reader.offset();
            let numbers = reader.list()?;
            if numbers.len() != v.len() {
                let (found, expected) = (numbers.len(), v.len());
                return Err(reader.error(start, format!("v has {}, expected {expected}", numbers_of(found))));
            }
            v.iter_mut().zip(numbers).for_each(|(v, number)| *v = number.value);
        }
        _ => dofs(&mut reader, model, &mut v)?,
    }
    reader.end()?;
    match v.iter().all(|v| v.is_finite()) {
        true => Ok(v),
        false => Err(reader.error(0, "a velocity is not finite")),
    }
}

/// `dof=value, ..`, by the names of degrees of freedom.
fn dofs(reader: &mut Reader<'_>, model: &Model<f64>, v: &mut [f64]) -> Result<(), ExpressionError> {
    let names: Vec<String> = (0..model.nv()).map(|d| model.dof_name(d)).collect();
    loop {
        let (start, rest) = (reader.offset(), reader.rest());
        let Some((name, _)) = rest.split_once('=') else { return Err(reader.error(start, EXPECTED)) };
        let plain = name.trim();
        let Some(d) = names.iter().position(|dof| dof == plain) else {
            let hint = did_you_mean(plain, names.iter().map(String::as_str));
            return Err(reader.error(start, format!("no degree of freedom is named '{plain}'{hint}")));
        };
        reader.skip(name.len());
        reader.expect('=')?;
        v[d] = reader.number()?;
        if !reader.eat(',') {
            return Ok(());
        }
    }
}

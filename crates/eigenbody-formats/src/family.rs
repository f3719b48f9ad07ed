//! The names of families: `hydra(40, 1, 0, 1)`, `chain(4, m=2.2, l=1)`.

use crate::error::FormatError;
use crate::expression::{Argument, Call, ExpressionError, Value, call};
use eigenbody::Family;
use eigenbody::family::FamilyError;
use eigenbody::scalar::{Dd, Scalar};

/// How a family is named: its parameters, each with other names for it, and what those left out are. N cannot be.
struct Signature {
    name: &'static str,
    parameters: &'static [&'static [&'static str]],
    defaults: [f64; 4],
}

const TUBES: &[&[&str]] = &[&["N"], &["B"], &["α", "alpha", "skew"], &["ρ", "rho", "taper"]];
const RODS: &[&[&str]] = &[&["N"], &["m"], &["l"]];
const TAPER: usize = 3;

const SIGNATURES: [Signature; 4] = [
    Signature { name: "hydra", parameters: TUBES, defaults: [0.0, 1.0, 0.0, 1.0] },
    Signature { name: "onion", parameters: TUBES, defaults: [0.0, 1.0, 0.0, 1.0] },
    Signature { name: "auto_tree", parameters: TUBES, defaults: [0.0, 1.0, 0.0, 1.0] },
    Signature { name: "chain", parameters: RODS, defaults: [0.0, 1.0, 1.0, 0.0] },
];

/// The families' names.
pub(crate) fn names() -> impl Iterator<Item = &'static str> {
    SIGNATURES.iter().map(|signature| signature.name)
}

/// `hydra(N,B,α,ρ)`: a family's name in full.
pub(crate) fn usage(name: &str) -> Option<String> {
    SIGNATURES.iter().find(|signature| signature.name == name).map(Signature::usage)
}

/// The family that a text names, not yet built; none if it is no call of one. A size ratio R replaces ρ by R^(1/(N−1)).
///
/// ```
/// let family = eigenbody_formats::family("hydra(40, 1, 0, 1)", None)?;
/// assert_eq!(family.map(|family| family.links()), Some(40));
/// # Ok::<(), eigenbody_formats::FormatError>(())
/// ```
/// Errors: [`FormatError::Expression`] for parameters that the family does not take, [`FormatError::Unsuitable`] for a size ratio that it
/// does not.
pub fn family(text: &str, size_ratio: Option<Dd>) -> Result<Option<Family>, FormatError> {
    let name = text.split_once('(').map(|(name, _)| name.trim());
    let Some(signature) = SIGNATURES.iter().find(|signature| Some(signature.name) == name) else {
        return Ok(None);
    };
    let parameters = signature.parameters(text, &call(text)?)?;
    let family = parameters.family(signature.name).map_err(|fault| {
        let offset = parameters.offsets[slot(&fault)].unwrap_or(0);
        ExpressionError::new(text, offset, fault.to_string())
    })?;
    let Some(ratio) = size_ratio else { return Ok(Some(family)) };
    let unsuitable = |problem: String| FormatError::Unsuitable { text: text.to_owned(), problem };
    if signature.parameters.len() <= TAPER {
        return Err(unsuitable(
            "a size ratio is for the families with a taper: hydra, onion, auto_tree".into(),
        ));
    }
    if parameters.offsets[TAPER].is_some() && parameters.values[TAPER] != Dd::ONE {
        return Err(unsuitable("a size ratio sets the taper ρ, which has a value already".into()));
    }
    let refused = |_| unsuitable(format!("size ratio {ratio}: expected a positive number"));
    family.with_size_ratio(ratio).map(Some).map_err(refused)
}

/// The parameters of a call, and where each stands if it was given.
struct Parameters {
    values: [Dd; 4],
    offsets: [Option<usize>; 4],
}

impl Signature {
    fn usage(&self) -> String {
        let names: Vec<&str> = self.parameters.iter().map(|names| names[0]).collect();
        format!("{}({})", self.name, names.join(","))
    }

    fn parameters(&self, text: &str, call: &Call<'_>) -> Result<Parameters, ExpressionError> {
        let mut parameters = Parameters { values: self.defaults.map(Dd::from), offsets: [None; 4] };
        let mut unnamed = 0..self.parameters.len();
        for argument in &call.arguments {
            let error = |message: String| ExpressionError::new(text, argument.offset, message);
            let slot = self.slot(argument, &mut unnamed).map_err(error)?;
            let Value::Number(value) = argument.value else {
                return Err(error("a list, expected a number".into()));
            };
            if parameters.offsets[slot].replace(argument.offset).is_some() {
                return Err(error(format!("a second value for {}", self.parameters[slot][0])));
            }
            parameters.values[slot] = value;
        }
        match parameters.offsets[0] {
            Some(_) => Ok(parameters),
            None => Err(ExpressionError::new(text, text.len(), format!("N is missing in {}", self.usage()))),
        }
    }

    /// Which parameter an argument is: the named one, or the next.
    fn slot(
        &self,
        argument: &Argument<'_>,
        unnamed: &mut impl Iterator<Item = usize>,
    ) -> Result<usize, String> {
        match argument.key {
            None => unnamed.next().ok_or_else(|| format!("too many parameters for {}", self.usage())),
            Some(key) => {
                let named = self.parameters.iter().position(|names| names.contains(&key));
                named.ok_or_else(|| format!("no parameter '{key}' in {}", self.usage()))
            }
        }
    }
}

impl Parameters {
    fn family(&self, name: &str) -> Result<Family, FamilyError> {
        let [links, b, c, _] = self.values.map(Dd::hi);
        let taper = self.values[TAPER];
        // A conversion saturates; what it does not keep is no whole number of links, or too large a one.
        let n = links as usize;
        if n as f64 != links {
            return Err(FamilyError::Links(links));
        }
        match name {
            "hydra" => Family::hydra(n, b, c, taper),
            "onion" => Family::onion(n, b, c, taper),
            "auto_tree" => Family::auto_tree(n, b, c, taper),
            _ => Family::slender_chain(n, b, c),
        }
    }
}

/// Which parameter a fault is about.
fn slot(fault: &FamilyError) -> usize {
    match fault {
        FamilyError::Branching(_) => 1,
        FamilyError::Size { what, .. } => 1 + usize::from(what.starts_with('l')),
        FamilyError::Skew(_) => 2,
        FamilyError::Taper(_) => TAPER,
        // The number of links.
        _ => 0,
    }
}

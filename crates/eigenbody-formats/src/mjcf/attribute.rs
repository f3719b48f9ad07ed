//! Attributes as numbers and keywords, with located faults.

use super::fault::{Fault, MjcfFault, fault};
use crate::error::shortened;
use crate::xml::{Attribute, Element};
use std::ops::RangeInclusive;

/// All numbers of an attribute. Infinite ones are numbers, as limits may be; NaN is not.
fn parse(attribute: &Attribute, tag: &str) -> Result<Vec<f64>, Fault> {
    let number = |word: &str| {
        let value = word.parse().ok().filter(|x: &f64| !x.is_nan());
        value.ok_or_else(|| value_fault(attribute, tag, word, "a number"))
    };
    attribute.value.split_whitespace().map(number).collect()
}

/// The numbers of an attribute, so many of them; empty text counts as no attribute.
pub(super) fn numbers(
    attribute: Option<&Attribute>,
    tag: &str,
    count: RangeInclusive<usize>,
) -> Result<Option<Vec<f64>>, Fault> {
    let Some(attribute) = attribute else { return Ok(None) };
    let found = parse(attribute, tag)?;
    if found.is_empty() {
        return Ok(None);
    }
    if !count.contains(&found.len()) {
        let expected = match (count.start(), count.end()) {
            (a, b) if a == b => a.to_string(),
            (a, b) => format!("{a} to {b}"),
        };
        let (name, tag, found) = (attribute.name.clone(), tag.to_owned(), found.len());
        return Err(fault(attribute.at, MjcfFault::NumberCount { name, tag, found, expected }));
    }
    Ok(Some(found))
}

/// K finite numbers.
pub(super) fn array<const K: usize>(
    attribute: Option<&Attribute>,
    tag: &str,
) -> Result<Option<[f64; K]>, Fault> {
    let Some(found) = numbers(attribute, tag, K..=K)? else { return Ok(None) };
    if let (Some(attribute), Some(bad)) = (attribute, found.iter().find(|x| !x.is_finite())) {
        return Err(value_fault(attribute, tag, &bad.to_string(), "a finite number"));
    }
    Ok(found.try_into().ok())
}

/// One finite number.
pub(super) fn number(attribute: Option<&Attribute>, tag: &str) -> Result<Option<f64>, Fault> {
    Ok(array(attribute, tag)?.map(|[x]| x))
}

/// One of some words, as its position among them.
pub(super) fn keyword(
    attribute: Option<&Attribute>,
    tag: &str,
    words: &[&str],
) -> Result<Option<usize>, Fault> {
    let Some(attribute) = attribute else { return Ok(None) };
    match words.iter().position(|w| *w == attribute.value) {
        Some(k) => Ok(Some(k)),
        None => {
            let expected = format!("one of {}", words.join(", "));
            Err(value_fault(attribute, tag, &attribute.value, &expected))
        }
    }
}

/// `true` or `false`.
pub(super) fn boolean(attribute: Option<&Attribute>, tag: &str) -> Result<Option<bool>, Fault> {
    Ok(keyword(attribute, tag, &["false", "true"])?.map(|k| k == 1))
}

/// An attribute that must be there.
pub(super) fn required<'a>(element: &'a Element, name: &'static str) -> Result<&'a Attribute, Fault> {
    element
        .find(name)
        .ok_or_else(|| fault(element.at, MjcfFault::MissingAttribute { element: element.described(), name }))
}

/// An attribute holds something else than what is expected.
pub(super) fn value_fault(attribute: &Attribute, tag: &str, text: &str, expected: &str) -> Fault {
    let (name, tag, text) = (attribute.name.clone(), tag.to_owned(), shortened(text));
    fault(attribute.at, MjcfFault::Value { name, tag, text, expected: expected.to_owned() })
}

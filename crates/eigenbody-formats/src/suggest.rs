//! The name that was meant.

/// The candidate closest to `name`, if it is close enough to be a slip of the fingers.
pub(crate) fn nearest<'a>(name: &str, candidates: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    let allowed = (name.chars().count() + 2) / 4;
    // A difference of lengths is a lower bound of the distance, and long texts are no names.
    let plausible = candidates.filter(|c| c.len() <= 64 && c.len().abs_diff(name.len()) <= 4 * allowed);
    let rated = plausible.map(|c| (strsim::osa_distance(name, c), c));
    // Of equally close ones the first in the alphabet, whatever the order they come in.
    rated.filter(|&(distance, _)| distance <= allowed).min().map(|(_, c)| c)
}

/// `; did you mean 'x'?`, or nothing.
pub(crate) fn did_you_mean<'a>(name: &str, candidates: impl Iterator<Item = &'a str>) -> String {
    nearest(name, candidates).map(|near| format!("; did you mean '{near}'?")).unwrap_or_default()
}

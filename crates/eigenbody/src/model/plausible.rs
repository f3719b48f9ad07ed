//! What no rule of physics forbids and no robot has: sizes, units, unequal twins.

use super::builder::LinkId;
use super::finding::Finding;
use std::collections::HashMap;

/// A link's mass and principal moments about its centre of mass, ascending.
pub(super) struct Sized {
    pub link: LinkId,
    pub mass: f64,
    pub principal: [f64; 3],
}

/// Radii of gyration beyond this belong to no robot (m).
const LARGEST_RADIUS: f64 = 20.0;

/// Densities outside are no matter's (kg/m³): aerogel to osmium, with room for hollow links and inflated inertias.
const DENSITIES: std::ops::Range<f64> = 1e-4..2e5;

/// Twins may differ by this much of the larger: files round.
const TWIN_TOLERANCE: f64 = 0.05;

impl Sized {
    /// Largest radius of gyration (m); none without mass.
    fn radius(&self) -> Option<f64> {
        let radius = (self.principal[2] / self.mass).sqrt();
        (self.mass > 0.0 && radius > 0.0 && radius.is_finite()).then_some(radius)
    }
}

/// Findings on the sizes of links.
pub(super) fn of_sizes<'a>(links: &[Sized], name: impl Fn(LinkId) -> &'a str) -> Vec<Finding> {
    let mut findings = Vec::new();
    if let Some(density) = median_density(links).filter(|density| !DENSITIES.contains(density)) {
        findings.push(Finding::Units { density });
    } else {
        findings.extend(links.iter().filter_map(|sized| of_size(sized, &name)));
    }
    let sided: Vec<&Sized> = links.iter().filter(|l| may_have_side(name(l.link))).collect();
    findings.extend(of_twins(&sided, name));
    findings
}

/// The finding on a link that is too wide.
pub(super) fn of_size<'a>(sized: &Sized, name: impl Fn(LinkId) -> &'a str) -> Option<Finding> {
    let (link, radius) = (sized.link, sized.radius().filter(|&r| r > LARGEST_RADIUS)?);
    Some(Finding::GyrationRadius { link, name: name(link).to_owned(), radius })
}

/// Findings on left and right links that are not alike.
pub(super) fn of_twins<'a>(sided: &[&Sized], name: impl Fn(LinkId) -> &'a str) -> Vec<Finding> {
    let by_name: HashMap<&str, &Sized> = sided.iter().map(|&l| (name(l.link), l)).collect();
    let finding = |sized: &&Sized| {
        let (link, own) = (sized.link, name(sized.link));
        let (&twin, other) = by_name.get_key_value(twin(own)?.as_str())?;
        let (name, twin) = (own.to_owned(), twin.to_owned());
        differ(sized, other).then_some(Finding::TwinDiffers { link, name, twin })
    };
    sided.iter().filter_map(finding).collect()
}

/// True for the names of a left and a right link that differ in nothing else, in either order.
pub(super) fn are_twins(a: &str, b: &str) -> bool {
    let left_right = |left: &str, right: &str| twin(left).is_some_and(|twin| twin == right);
    may_have_side(a) && may_have_side(b) && (left_right(a, b) || left_right(b, a))
}

/// Median of mass over the cube of twice the radius of gyration; none for fewer than three links with mass.
fn median_density(links: &[Sized]) -> Option<f64> {
    let density = |l: &Sized| l.radius().map(|r| l.mass / (8.0 * r * r * r));
    let mut densities: Vec<f64> = links.iter().filter_map(density).collect();
    let middle = densities.len() / 2;
    (densities.len() >= 3).then(|| *densities.select_nth_unstable_by(middle, f64::total_cmp).1)
}

/// Words for a side, left and right.
const SIDES: [(&str, &str); 3] = [("left", "right"), ("Left", "Right"), ("LEFT", "RIGHT")];

/// The right twin's name of a left link.
fn twin(name: &str) -> Option<String> {
    let word = SIDES.iter().find(|(left, _)| name.contains(left));
    if let Some((left, right)) = word {
        return Some(name.replacen(left, right, 1));
    }
    let letter = |from: &str, to: &str| {
        let rest = |c: Option<char>| c.is_some_and(|c| c == '_');
        if let Some(tail) = name.strip_prefix(from).filter(|tail| rest(tail.chars().next())) {
            return Some(format!("{to}{tail}"));
        }
        let head = name.strip_suffix(from).filter(|head| rest(head.chars().last()))?;
        Some(format!("{head}{to}"))
    };
    letter("l", "r").or_else(|| letter("L", "R"))
}

/// False for most names that have no side, at little cost.
fn may_have_side(name: &str) -> bool {
    let letter = |pair: Option<&[u8]>| {
        matches!(pair, Some([b'l' | b'L' | b'r' | b'R', b'_'] | [b'_', b'l' | b'L' | b'r' | b'R']))
    };
    let bytes = name.as_bytes();
    letter(bytes.get(..2))
        || letter(bytes.len().checked_sub(2).and_then(|start| bytes.get(start..)))
        || ["eft", "ight", "EFT", "IGHT"].iter().any(|part| name.contains(part))
}

/// True if masses or moments differ by more than rounding.
fn differ(a: &Sized, b: &Sized) -> bool {
    let apart = |x: f64, y: f64| (x - y).abs() > TWIN_TOLERANCE * x.abs().max(y.abs());
    apart(a.mass, b.mass) || apart(a.principal[2], b.principal[2])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_twin_of_a_left_link() {
        for (left, right) in
            [("left_knee", "right_knee"), ("LeftFoot", "RightFoot"), ("l_arm", "r_arm"), ("hip_L", "hip_R")]
        {
            assert_eq!((twin(left).as_deref(), may_have_side(right)), (Some(right), true));
            assert!(may_have_side(left));
        }
        for neither in ["leg", "roll_link", "panda_link1", "l", ""] {
            assert_eq!((twin(neither), may_have_side(neither)), (None, false));
        }
    }
}

//! What findings are called: one list for SARIF, for `--fail-on` and for the guide.

/// A kind of finding.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Rule {
    /// Its stable name.
    pub code: &'static str,
    /// What it means.
    pub about: &'static str,
}

const fn rule(code: &'static str, about: &'static str) -> Rule {
    Rule { code, about }
}

/// Findings of the search over the joint limits.
pub const OF_ROBOTS: &[Rule] = &[
    rule("moves-no-mass", "Some joint rates move no mass in any configuration: H is singular."),
    rule("solves", "Solves with H in double precision lose digits: κ' is large somewhere."),
    rule("single-precision", "Single precision keeps too few digits of an acceleration somewhere."),
    rule("time-step", "The step is longer than the largest stable one, or none is stable."),
    rule("gains", "κ is large somewhere: gains and explicit steps cannot suit all motions."),
];

/// Findings on the file and the model as it was read.
pub const OF_MODELS: &[Rule] = &[
    rule("inertia-not-positive", "A moment of inertia about the centre of mass is zero or negative."),
    rule("triangle-inequality", "A moment of inertia exceeds the sum of the other two."),
    rule("zero-mass", "A moving link has no mass."),
    rule("gyration-radius", "A link's mass is spread wider than any robot is."),
    rule("units", "Densities suggest masses in grams or lengths in millimetres."),
    rule("twin-differs", "A left and a right link of the same name differ."),
    rule("mimic-unknown", "A mimic joint follows no moving joint, or one of several coordinates."),
    rule("no-name", "The robot has no name."),
    rule("crossed-limits", "A lower limit is above the upper one."),
    rule("no-mass", "An inertial has no mass."),
    rule("point-mass", "An inertial has no complete inertia."),
    rule("rotor", "A rotor's inertia is left out."),
    rule("loop", "A loop is cut."),
    rule("equality-ignored", "An equality is left out."),
    rule("armature-ignored", "An armature that couples joints is left out."),
    rule("spring-ignored", "A spring, damper or feedback is left out."),
    rule("outside-world", "A body stands outside the world."),
    rule("unknown-word", "An element or attribute means nothing where it stands."),
];

/// All rules.
pub fn rules() -> impl Iterator<Item = &'static Rule> {
    OF_ROBOTS.iter().chain(OF_MODELS)
}

//! What the text of a robot says and its model does not.

use std::fmt;

/// What the text says and the model does not.
#[derive(Debug, Clone, PartialEq)]
pub enum Note {
    /// The robot has no name; it is named after its file.
    NoName,
    /// A lower limit above the upper one.
    CrossedLimits {
        /// The joint's name.
        joint: String,
        /// Lower limit.
        lower: f64,
        /// Upper limit.
        upper: f64,
    },
    /// An inertial without mass.
    NoMass {
        /// The link's name.
        link: String,
    },
    /// An inertial with mass and without a complete inertia.
    PointMass {
        /// The link's name.
        link: String,
    },
    /// A rotor's inertia that was not asked for.
    Rotor {
        /// The joint's name.
        joint: String,
    },
    /// Two bodies are fastened to each other across the tree.
    Loop {
        /// The element.
        element: String,
    },
    /// An equality that is no linear relation of two joints with one coordinate each, or contradicts an earlier one.
    EqualityIgnored {
        /// The element.
        element: String,
    },
    /// Armature that couples several joints, or whose joint is not known.
    ArmatureIgnored {
        /// The element.
        element: String,
    },
    /// Stiffness, damping or feedback along something else than joints and fixed tendons, or of another kind than linear.
    SpringIgnored {
        /// The element.
        element: String,
    },
    /// A body outside `<worldbody>`, which MuJoCo passes over.
    OutsideWorld {
        /// The element.
        element: String,
    },
    /// An element or attribute that means nothing where it stands, and may have been meant to.
    Slip {
        /// The word, and where it stands.
        word: String,
        /// What may have been meant.
        meant: String,
    },
}

impl Note {
    /// A stable name of its kind.
    pub fn code(&self) -> &'static str {
        match self {
            Self::NoName => "no-name",
            Self::CrossedLimits { .. } => "crossed-limits",
            Self::NoMass { .. } => "no-mass",
            Self::PointMass { .. } => "point-mass",
            Self::Rotor { .. } => "rotor",
            Self::Loop { .. } => "loop",
            Self::EqualityIgnored { .. } => "equality-ignored",
            Self::ArmatureIgnored { .. } => "armature-ignored",
            Self::SpringIgnored { .. } => "spring-ignored",
            Self::OutsideWorld { .. } => "outside-world",
            Self::Slip { .. } => "unknown-word",
        }
    }

    /// The link, joint or element that it is about.
    pub fn subject(&self) -> &str {
        match self {
            Self::NoName => "",
            Self::CrossedLimits { joint: name, .. }
            | Self::Rotor { joint: name }
            | Self::NoMass { link: name }
            | Self::PointMass { link: name }
            | Self::Loop { element: name }
            | Self::EqualityIgnored { element: name }
            | Self::ArmatureIgnored { element: name }
            | Self::SpringIgnored { element: name }
            | Self::OutsideWorld { element: name }
            | Self::Slip { word: name, .. } => name,
        }
    }
}

impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoName => f.write_str("<robot> has no attribute 'name'; it is named after its file"),
            Self::CrossedLimits { joint, lower, upper } => {
                write!(
                    f,
                    "joint '{joint}' has lower limit {lower} above upper limit {upper}: taken as unlimited"
                )
            }
            Self::NoMass { link } => {
                write!(f, "<inertial> of link '{link}' has no <mass>: it counts for nothing")
            }
            Self::PointMass { link } => {
                write!(
                    f,
                    "<inertial> of link '{link}' has no <inertia> of six entries: its mass counts as a point"
                )
            }
            Self::Rotor { joint } => {
                write!(f, "the rotor of joint '{joint}' has inertia: H is without it; --rotors on adds it")
            }
            Self::Loop { element } => write!(
                f,
                "{element} closes a loop: H is that of the tree without it; --loops closed is with it"
            ),
            Self::EqualityIgnored { element } => {
                write!(f, "{element} is an equality that --mimic on does not apply")
            }
            Self::SpringIgnored { element } => {
                write!(f, "{element} has stiffness, damping or feedback that time steps are judged without")
            }
            Self::OutsideWorld { element } => {
                write!(f, "{element} stands outside <worldbody> and is passed over")
            }
            Self::Slip { word, meant } => {
                write!(f, "{word} means nothing there and is passed over; did you mean '{meant}'?")
            }
            Self::ArmatureIgnored { element } => {
                write!(f, "{element} has armature that couples several joints: H is without it")
            }
        }
    }
}

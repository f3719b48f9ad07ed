//! What URDF calls the things that touch H.

use super::element::Element;
use crate::slips::{Tagged, Words};

pub(super) const VOCABULARY: &[Words] = &[
    Words { tag: "robot", children: &["link", "joint", "transmission", "material"], attributes: &[] },
    Words { tag: "link", children: &["inertial", "visual", "collision"], attributes: &[] },
    Words { tag: "inertial", children: &["origin", "mass", "inertia"], attributes: &[] },
    Words {
        tag: "joint",
        children: &[
            "origin",
            "parent",
            "child",
            "axis",
            "limit",
            "mimic",
            "dynamics",
            "calibration",
            "safety_controller",
        ],
        attributes: &[],
    },
    Words { tag: "origin", children: &[], attributes: &["xyz", "rpy", "quat_xyzw"] },
    Words { tag: "mass", children: &[], attributes: &["value"] },
    Words { tag: "inertia", children: &[], attributes: &["ixx", "ixy", "ixz", "iyy", "iyz", "izz"] },
    Words { tag: "axis", children: &[], attributes: &["xyz"] },
    Words {
        tag: "limit",
        children: &[],
        attributes: &["lower", "upper", "effort", "velocity", "acceleration", "deceleration", "jerk"],
    },
    Words { tag: "mimic", children: &[], attributes: &["joint", "multiplier", "offset"] },
];

impl Tagged for Element<'_, '_> {
    type At = usize;

    fn tag(&self) -> &str {
        Element::tag(*self)
    }

    fn described(&self) -> String {
        Element::described(*self)
    }

    fn at(&self) -> usize {
        self.offset()
    }

    fn children(&self) -> Vec<Self> {
        let namespace = self.0.tag_name().namespace();
        let own = self.0.children().filter(|n| n.is_element() && n.tag_name().namespace() == namespace);
        own.map(Element).collect()
    }

    fn attributes(&self) -> Vec<(String, usize)> {
        let own = self.0.attributes().filter(|a| a.namespace().is_none());
        own.map(|a| (a.name().to_owned(), a.range().start)).collect()
    }
}

//! What SDF calls the things that touch H.

use crate::slips::{Tagged, Words};
use crate::xml::{Element, Spot};

pub(super) const VOCABULARY: &[Words] = &[
    Words { tag: "sdf", children: &["model", "world", "actor", "light"], attributes: &[] },
    Words {
        tag: "world",
        children: &["model", "include", "frame", "joint", "gravity", "physics", "plugin"],
        attributes: &[],
    },
    Words {
        tag: "model",
        children: &[
            "link",
            "joint",
            "frame",
            "model",
            "include",
            "pose",
            "static",
            "plugin",
            "gripper",
            "self_collide",
            "enable_wind",
            "allow_auto_disable",
        ],
        attributes: &["name", "canonical_link", "placement_frame"],
    },
    Words {
        tag: "link",
        children: &[
            "inertial",
            "pose",
            "visual",
            "collision",
            "sensor",
            "light",
            "gravity",
            "kinematic",
            "self_collide",
            "enable_wind",
            "velocity_decay",
            "must_be_base_link",
        ],
        attributes: &[],
    },
    Words {
        tag: "inertial",
        children: &["mass", "inertia", "pose", "frame", "density", "fluid_added_mass", "auto_inertia_params"],
        attributes: &["auto"],
    },
    Words { tag: "inertia", children: &["ixx", "ixy", "ixz", "iyy", "iyz", "izz"], attributes: &[] },
    Words {
        tag: "joint",
        children: &[
            "parent",
            "child",
            "pose",
            "axis",
            "axis2",
            "physics",
            "sensor",
            "frame",
            "gearbox_ratio",
            "gearbox_reference_body",
            "thread_pitch",
            "screw_thread_pitch",
        ],
        attributes: &[],
    },
    Words { tag: "axis", children: AXIS, attributes: &[] },
    Words { tag: "axis2", children: AXIS, attributes: &[] },
    Words { tag: "xyz", children: &[], attributes: &["expressed_in"] },
    Words {
        tag: "limit",
        children: &["lower", "upper", "effort", "velocity", "stiffness", "dissipation"],
        attributes: &[],
    },
    Words { tag: "mimic", children: &["multiplier", "offset", "reference"], attributes: &["joint", "axis"] },
    Words { tag: "pose", children: &[], attributes: &["relative_to", "frame", "degrees", "rotation_format"] },
];

const AXIS: &[&str] =
    &["xyz", "limit", "dynamics", "mimic", "use_parent_model_frame", "initial_position", "joint_id"];

impl Tagged for &Element {
    type At = Spot;

    fn tag(&self) -> &str {
        &self.tag
    }

    fn described(&self) -> String {
        Element::described(self)
    }

    fn at(&self) -> Spot {
        self.at
    }

    fn children(&self) -> Vec<Self> {
        let own = |child: &&Element| !child.tag.contains(':');
        self.children.iter().filter(own).collect()
    }

    fn attributes(&self) -> Vec<(String, Spot)> {
        let own = self.attributes.iter().filter(|a| !a.name.contains(':'));
        own.map(|a| (a.name.clone(), a.at)).collect()
    }
}

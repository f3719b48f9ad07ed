//! `<compiler>`: how the rest of the file is to be read.

use super::attribute::{array, boolean, keyword, number, value_fault};
use super::fault::{Fault, unsupported};
use crate::xml::Element;

/// Whether inertias come from geoms.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum FromGeoms {
    Never,
    Always,
    /// Where a body has no `<inertial>`.
    Auto,
}

/// The settings of `<compiler>`, with MuJoCo's defaults.
#[derive(Debug, Clone)]
pub(super) struct Compiler {
    /// What a written angle is multiplied by.
    pub radians: f64,
    /// The axes of Euler angles; lower case turns with the body, upper case stays.
    pub eulerseq: [u8; 3],
    pub autolimits: bool,
    pub inertiafromgeom: FromGeoms,
    pub inertiagrouprange: [f64; 2],
    pub boundmass: f64,
    pub boundinertia: f64,
    pub balanceinertia: bool,
    pub settotalmass: Option<f64>,
    pub fusestatic: bool,
    pub alignfree: bool,
    pub fitaabb: bool,
    pub strippath: bool,
    /// Where meshes are.
    pub meshdir: String,
}

impl Default for Compiler {
    fn default() -> Self {
        Self {
            radians: 1f64.to_radians(),
            eulerseq: *b"xyz",
            autolimits: true,
            inertiafromgeom: FromGeoms::Auto,
            inertiagrouprange: [0.0, 5.0],
            boundmass: 0.0,
            boundinertia: 0.0,
            balanceinertia: false,
            settotalmass: None,
            fusestatic: false,
            alignfree: false,
            fitaabb: false,
            strippath: false,
            meshdir: String::new(),
        }
    }
}

impl Compiler {
    /// All `<compiler>` elements of a document together: a later attribute goes before an earlier one.
    pub fn read(root: &Element) -> Result<Self, Fault> {
        let mut settings = Self::default();
        let (mut assetdir, mut meshdir) = (None, None);
        for element in root.children_named("compiler") {
            settings.add(element)?;
            assetdir = element.get("assetdir").or(assetdir);
            meshdir = element.get("meshdir").or(meshdir);
        }
        settings.meshdir = meshdir.or(assetdir).unwrap_or_default().to_owned();
        Ok(settings)
    }

    fn add(&mut self, e: &Element) -> Result<(), Fault> {
        let tag = "compiler";
        let flag = |name: &str, old: bool| Ok(boolean(e.find(name), tag)?.unwrap_or(old));
        let value = |name: &str, old: f64| Ok(number(e.find(name), tag)?.unwrap_or(old));
        if let Some(k) = keyword(e.find("angle"), tag, &["radian", "degree"])? {
            self.radians = if k == 0 { 1.0 } else { 1f64.to_radians() };
        }
        if keyword(e.find("coordinate"), tag, &["local", "global"])? == Some(1) {
            return Err(unsupported(e, "global coordinates are no longer part of MJCF"));
        }
        if let Some(attribute) = e.find("eulerseq") {
            let axes: Option<[u8; 3]> = attribute.value.as_bytes().try_into().ok();
            let axes = axes.filter(|axes| axes.iter().all(|a| b"xyzXYZ".contains(a)));
            self.eulerseq = axes.ok_or_else(|| {
                value_fault(attribute, tag, &attribute.value, "three of the letters x, y, z, X, Y, Z")
            })?;
        }
        match keyword(e.find("inertiafromgeom"), tag, &["false", "true", "auto"])? {
            Some(0) => self.inertiafromgeom = FromGeoms::Never,
            Some(1) => self.inertiafromgeom = FromGeoms::Always,
            Some(_) => self.inertiafromgeom = FromGeoms::Auto,
            None => {}
        }
        if let Some(range) = array(e.find("inertiagrouprange"), tag)? {
            self.inertiagrouprange = range;
        }
        self.settotalmass = number(e.find("settotalmass"), tag)?.or(self.settotalmass);
        self.boundmass = value("boundmass", self.boundmass)?;
        self.boundinertia = value("boundinertia", self.boundinertia)?;
        self.autolimits = flag("autolimits", self.autolimits)?;
        self.balanceinertia = flag("balanceinertia", self.balanceinertia)?;
        self.fusestatic = flag("fusestatic", self.fusestatic)?;
        self.alignfree = flag("alignfree", self.alignfree)?;
        self.fitaabb = flag("fitaabb", self.fitaabb)?;
        self.strippath = flag("strippath", self.strippath)?;
        Ok(())
    }
}

//! `<worldbody>`: bodies, frames, replicates and attachments, read into a [`Tree`].

use super::asset::{Assets, Folders};
use super::attribute::{array, number, required, value_fault};
use super::body::{Body, Inertial, Moments, Named, Rename, Tree, WORLD};
use super::compiler::{Compiler, FromGeoms};
use super::defaults::{Class, Defaults, MAIN};
use super::document::{Document, Model};
use super::fault::{Fault, MjcfFault, fault, unsupported};
use super::geom::{self, Shapes};
use super::names::name;
use super::orientation::{euler, pose, rotation};
use super::{attach, joint};
use crate::xml::Element;
use eigenbody::spatial::{Mat3, Sym3, Transform, Vec3};
use std::rc::Rc;

/// Most bodies of one file, replicated ones included.
const MAX_BODIES: usize = 200_000;

/// Most geoms of one file.
const MAX_GEOMS: usize = 1_000_000;

/// What stands around an element: the body, the frames inside it, the class that speaks where the element is silent.
#[derive(Clone, Copy)]
pub(super) struct Context {
    pub body: usize,
    pub frame: Transform<f64>,
    pub class: Class,
    /// Directly in a replicate, so that a joint would be outside.
    pub replicated: bool,
    /// In the world body, which needs no mass.
    pub weightless: bool,
}

impl Context {
    /// Inside a body, outside all frames.
    pub fn inside(body: usize, class: Class) -> Self {
        Self { body, frame: Transform::IDENTITY, class, replicated: false, weightless: false }
    }
}

/// A tree being read.
pub(super) struct Reader<'a> {
    pub document: &'a Document<'a>,
    pub defaults: &'a Defaults<'a>,
    pub settings: &'a Rc<Compiler>,
    pub assets: &'a Assets<'a>,
    pub tree: Tree,
    /// Named frames: what an attachment may name, with the body that they stand in.
    pub frames: Vec<(&'a Element, Context)>,
    /// The models that were attached, each with its prefix.
    pub attached: Vec<(&'a Model, String)>,
    /// How many attachments there were.
    pub attachments: usize,
    /// Whether sites are read: loops are fastened to some.
    pub sites: bool,
    geoms: usize,
}

impl<'a> Reader<'a> {
    /// A reader of a document's `<worldbody>` elements. `weightless`: the world's own geoms count for nothing.
    pub fn new(
        document: &'a Document<'a>,
        defaults: &'a Defaults<'a>,
        settings: &'a Rc<Compiler>,
        assets: &'a Assets<'a>,
    ) -> Self {
        let tree = Tree::new(document.root.at, settings);
        let (frames, attached) = (Vec::new(), Vec::new());
        let equalities = document.root.children_named("equality").flat_map(|section| &section.children);
        let sites = equalities.into_iter().any(|element| element.get("site1").is_some());
        Self { document, defaults, settings, assets, tree, frames, attached, attachments: 0, sites, geoms: 0 }
    }

    /// Reads them all.
    pub fn read(&mut self, weightless: bool) -> Result<(), Fault> {
        let world = Context { weightless, ..Context::inside(WORLD, MAIN) };
        let mut sections = self.document.root.children_named("worldbody");
        sections.try_for_each(|section| self.contents(section, world))
    }

    /// Reads what stands in an element.
    pub fn contents(&mut self, parent: &'a Element, at: Context) -> Result<(), Fault> {
        parent.children.iter().try_for_each(|element| self.element(element, at))
    }

    fn element(&mut self, element: &'a Element, at: Context) -> Result<(), Fault> {
        match element.tag.as_str() {
            "body" => self.body(element, at),
            "frame" => {
                let class = self.defaults.named(element, "childclass")?.unwrap_or(at.class);
                let frame = pose(element, self.settings)? * at.frame;
                let inside = Context { frame, class, ..at };
                self.contents(element, inside)?;
                // Only now: a frame cannot be attached inside itself.
                if element.find("name").is_some() {
                    self.frames.push((element, at));
                }
                self.named("frame", element, at);
                Ok(())
            }
            "replicate" => self.replicate(element, at),
            "attach" => attach::attach(self, element, at),
            "inertial" => {
                if at.body == WORLD {
                    return Err(fault(element.at, MjcfFault::World(element.described())));
                }
                if at.replicated {
                    return Err(unsupported(element, "it stands in a <replicate>"));
                }
                self.tree.bodies[at.body].inertial = Some(inertial(element, &at.frame, self.settings)?);
                Ok(())
            }
            "joint" | "freejoint" => {
                if at.body == WORLD {
                    return Err(fault(element.at, MjcfFault::World(element.described())));
                }
                if at.replicated {
                    let element_name = element.described();
                    return Err(fault(element.at, MjcfFault::ReplicatedJoint { element: element_name }));
                }
                let joint = match element.tag.as_str() {
                    "freejoint" => joint::read_free(element)?,
                    _ => joint::read(&self.defaults.styled(element, at.class)?, &at.frame, self.settings)?,
                };
                self.tree.bodies[at.body].joints.push(joint);
                Ok(())
            }
            "geom" => {
                self.defaults.named(element, "class")?;
                self.named("geom", element, at);
                self.geom(element, at)
            }
            "flexcomp" | "composite" => Err(unsupported(element, "it generates bodies")),
            "site" => {
                self.defaults.named(element, "class")?;
                self.named("site", element, at);
                if self.sites { self.site(element, at) } else { Ok(()) }
            }
            // Cameras, lights and plugins carry neither mass nor joints.
            "camera" | "light" => {
                self.defaults.named(element, "class")?;
                self.named(if element.tag == "light" { "light" } else { "camera" }, element, at);
                Ok(())
            }
            _ => Ok(()),
        }
    }

    /// Notes the name of what stands in a body.
    fn named(&mut self, kind: &'static str, element: &Element, at: Context) {
        let named = |name: &str| Named { kind, name: name.to_owned(), at: element.at };
        self.tree.bodies[at.body].named.extend(name(element).map(named));
    }

    fn body(&mut self, element: &'a Element, at: Context) -> Result<(), Fault> {
        let class = self.defaults.named(element, "childclass")?.unwrap_or(at.class);
        let own_pose = pose(element, self.settings)?;
        let body = Body {
            name: name(element).map(str::to_owned),
            pose: own_pose * at.frame,
            own_pose,
            ..Body::new(element.at, self.settings)
        };
        let body = self.tree.add(at.body, body);
        self.check_size(element)?;
        self.contents(element, Context::inside(body, class))
    }

    pub fn check_size(&self, element: &Element) -> Result<(), Fault> {
        match self.tree.bodies.len() {
            n if n > MAX_BODIES => Err(fault(element.at, MjcfFault::TooManyBodies { limit: MAX_BODIES })),
            _ => Ok(()),
        }
    }

    fn geom(&mut self, element: &'a Element, at: Context) -> Result<(), Fault> {
        // A look that is not understood is passed over; whether the geom is understood is for its mass to say.
        let styled = self.defaults.styled(element, at.class).ok();
        if let Some((pose, form)) = styled.and_then(|styled| geom::look(&styled, &self.shapes())) {
            self.tree.bodies[at.body].looks.push((pose * at.frame, form));
            self.count_geom(element)?;
        }
        // The world has no mass, and an <inertial> says all by default: such geoms need not be understood.
        if at.weightless || self.settings.inertiafromgeom == FromGeoms::Never {
            return Ok(());
        }
        let explicit = self.document.has_inertial(self.tree.bodies[at.body].at);
        if explicit && self.settings.inertiafromgeom != FromGeoms::Always {
            return Ok(());
        }
        let styled = self.defaults.styled(element, at.class)?;
        if !geom::counts(&styled, self.settings)? {
            return Ok(());
        }
        let mut geom = geom::read(&styled, &self.shapes())?;
        geom.pose = geom.pose * at.frame;
        self.tree.bodies[at.body].geoms.push(geom);
        self.count_geom(element)
    }

    fn shapes(&self) -> Shapes<'a> {
        let folders = Folders {
            files: self.document.files,
            main: self.document.model.folder.clone(),
            settings: self.settings,
        };
        Shapes { assets: self.assets, folders, settings: self.settings }
    }

    fn count_geom(&mut self, element: &Element) -> Result<(), Fault> {
        self.geoms += 1;
        match self.geoms > MAX_GEOMS {
            true => Err(fault(element.at, MjcfFault::TooManyGeoms { limit: MAX_GEOMS })),
            false => Ok(()),
        }
    }

    /// `<site>`: a frame that a loop may be fastened to.
    fn site(&mut self, element: &'a Element, at: Context) -> Result<(), Fault> {
        let Some(name) = element.get("name") else { return Ok(()) };
        let styled = self.defaults.styled(element, at.class)?;
        let fromto: Option<[f64; 6]> = array(styled.find("fromto"), "site")?;
        let pose = match fromto.and_then(geom::between) {
            Some((pose, _)) => pose,
            None => {
                let r = Vec3::from_f64(array(styled.find("pos"), "site")?.unwrap_or_default());
                let E = rotation(styled.layers(), self.settings)?.unwrap_or(Mat3::IDENTITY);
                Transform::new(E, r)
            }
        };
        self.tree.bodies[at.body].sites.push((name.to_owned(), pose * at.frame));
        Ok(())
    }

    /// `<replicate>`: its contents `count` times, each displaced and turned against the one before.
    ///
    /// ```text
    /// place 0 = the frame itself;  position i+1 = position i + Rᵢ offset,  Rᵢ the Euler angles times i
    /// ```
    fn replicate(&mut self, element: &'a Element, at: Context) -> Result<(), Fault> {
        let tag = "replicate";
        let count_at = required(element, "count")?;
        let count = number(Some(count_at), tag)?.unwrap_or(0.0);
        if count.fract() != 0.0 || !(0.0..=MAX_BODIES as f64).contains(&count) {
            let expected = format!("a whole number from 0 to {MAX_BODIES}");
            return Err(value_fault(count_at, tag, &count_at.value, &expected));
        }
        let count = count as usize;
        let offset = Vec3::from_f64(array(element.find("offset"), tag)?.unwrap_or_default());
        let angles: [f64; 3] = array(element.find("euler"), tag)?.unwrap_or_default();
        let separator = element.get("sep").unwrap_or_default();
        let class = self.defaults.named(element, "childclass")?.unwrap_or(at.class);

        let loose = self.tree.add_loose(Body::new(self.tree.bodies[at.body].at, self.settings));
        let inside = Context { replicated: true, weightless: at.weightless, ..Context::inside(loose, class) };
        self.contents(element, inside)?;
        let template = self.tree.split_off(loose);
        self.tree.replicate(&template);
        let (bodies, geoms) = template.size(loose);
        if self.tree.bodies.len().saturating_add(count.saturating_mul(bodies)) > MAX_BODIES {
            return Err(fault(element.at, MjcfFault::TooManyBodies { limit: MAX_BODIES }));
        }
        self.geoms = self.geoms.saturating_add(count.saturating_mul(geoms));
        if self.geoms > MAX_GEOMS {
            return Err(fault(element.at, MjcfFault::TooManyGeoms { limit: MAX_GEOMS }));
        }
        let digits = count.to_string().len();
        let mut r = Vec3::ZERO;
        for i in 0..count {
            let E = euler(angles.map(|a| a * i as f64), self.settings);
            let place = Transform::new(E, r) * at.frame;
            let suffix = format!("{separator}{i:0digits$}");
            self.tree.copy_contents(&template, loose, at.body, place, &Rename::Suffix(&suffix));
            r += E.transpose_times(offset);
        }
        Ok(())
    }
}

/// `<inertial>`, inside a frame.
fn inertial(element: &Element, frame: &Transform<f64>, settings: &Compiler) -> Result<Inertial, Fault> {
    let tag = "inertial";
    required(element, "pos")?;
    let mass = number(Some(required(element, "mass")?), tag)?.unwrap_or(0.0);
    let diagonal: Option<[f64; 3]> = array(element.find("diaginertia"), tag)?;
    let full: Option<[f64; 6]> = array(element.find("fullinertia"), tag)?;
    let own = pose(element, settings)?;
    let problem =
        |problem| Err(fault(element.at, MjcfFault::Inertial { element: element.described(), problem }));
    let inertia = match (diagonal, full) {
        (Some(d), Some(_)) if d != [0.0; 3] => {
            return problem("both diaginertia and fullinertia, expected one of them");
        }
        (_, Some(_)) if own.E != Mat3::IDENTITY => {
            return problem("fullinertia and an orientation, expected one of them");
        }
        (_, Some([xx, yy, zz, xy, xz, yz])) => Moments::Full(Sym3 { xx, yy, zz, xy, xz, yz }),
        (d, None) => Moments::Diagonal(d.unwrap_or_default()),
    };
    Ok(Inertial { mass, pose: own * *frame, inertia })
}

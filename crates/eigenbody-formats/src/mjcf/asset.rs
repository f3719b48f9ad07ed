//! `<asset>`: meshes, height fields and models, each read when it is first needed.

use super::attribute::{array, keyword, numbers};
use super::compiler::Compiler;
use super::defaults::{Defaults, MAIN, Styled};
use super::fault::{Fault, MjcfFault, fault, unsupported};
use super::mesh::{Enclosed, Mesh, MeshFault, Mode, enclosed};
use crate::looks::Form;
use crate::suggest::did_you_mean;
use crate::xml::{Element, Files};
use eigenbody::spatial::{Mat3, Vec3};
use std::cell::OnceCell;
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::rc::Rc;

/// The assets that touch mass, by name.
#[derive(Default)]
pub(super) struct Assets<'a> {
    meshes: HashMap<String, MeshAsset<'a>>,
    hfields: HashMap<String, &'a Element>,
    pub models: HashMap<String, &'a Element>,
}

struct MeshAsset<'a> {
    styled: Styled<'a>,
    enclosed: OnceCell<Rc<Enclosed>>,
}

/// Where the files of a document are looked for.
pub(super) struct Folders<'a> {
    pub files: &'a Files,
    pub main: PathBuf,
    pub settings: &'a Compiler,
}

impl<'a> Assets<'a> {
    /// All assets of a document.
    pub fn read(root: &'a Element, defaults: &'a Defaults<'a>, files: &Files) -> Result<Self, Fault> {
        let mut found = Self::default();
        for element in root.children_named("asset").flat_map(|section| &section.children) {
            match element.tag.as_str() {
                "mesh" => {
                    let styled = defaults.styled(element, MAIN)?;
                    let name = name_of(element);
                    let asset = MeshAsset { styled, enclosed: OnceCell::new() };
                    if let Some(first) = found.meshes.get(&name) {
                        return Err(second("mesh", name, element, first.styled.element, files));
                    }
                    found.meshes.insert(name, asset);
                }
                "hfield" => {
                    let name = name_of(element);
                    if let Some(first) = found.hfields.get(&name) {
                        return Err(second("hfield", name, element, first, files));
                    }
                    found.hfields.insert(name, element);
                }
                "model" => {
                    let name = name_of(element);
                    if let Some(first) = found.models.get(&name) {
                        return Err(second("model", name, element, first, files));
                    }
                    found.models.insert(name, element);
                }
                _ => {}
            }
        }
        Ok(found)
    }

    /// What a mesh encloses.
    pub fn mesh(&self, name: &str, by: &Element, folders: &Folders<'_>) -> Result<Rc<Enclosed>, Fault> {
        let Some(asset) = self.meshes.get(name) else {
            return Err(unknown("mesh", name, by, self.meshes.keys().map(String::as_str)));
        };
        if let Some(known) = asset.enclosed.get() {
            return Ok(Rc::clone(known));
        }
        let computed = Rc::new(asset.read(name, folders)?);
        Ok(Rc::clone(asset.enclosed.get_or_init(|| computed)))
    }

    /// How a mesh looks, if it stands in a file as it is: not moved or turned by its asset.
    pub fn look(&self, name: &str, folders: &Folders<'_>) -> Option<Form> {
        let styled = &self.meshes.get(name)?.styled;
        let element = styled.element;
        if element.find("refpos").or(element.find("refquat")).is_some() {
            return None;
        }
        let path = folders.mesh(element, &element.find("file")?.value);
        let file = path.strip_prefix(&folders.main).unwrap_or(&path).display().to_string();
        Some(Form::Mesh { file, scale: array(styled.find("scale"), "mesh").ok()?.unwrap_or([1.0; 3]) })
    }

    /// The half-edges of the box that counts as a height field.
    pub fn hfield(&self, name: &str, by: &Element) -> Result<[f64; 3], Fault> {
        let Some(element) = self.hfields.get(name) else {
            return Err(unknown("hfield", name, by, self.hfields.keys().map(String::as_str)));
        };
        let [x, y, top, base] = array(element.find("size"), "hfield")?.unwrap_or_default();
        Ok([x, y, 0.25 * top + 0.5 * base])
    }
}

fn unknown<'n>(kind: &'static str, name: &str, by: &Element, names: impl Iterator<Item = &'n str>) -> Fault {
    let suggestion = did_you_mean(name, names);
    fault(by.spot_of(kind), MjcfFault::Unknown { kind: kind.to_owned(), name: name.to_owned(), suggestion })
}

fn second(kind: &'static str, name: String, at: &Element, first: &Element, files: &Files) -> Fault {
    let first = files.locate(first.at).1;
    fault(at.at, MjcfFault::Second { kind: kind.to_owned(), name, first })
}

/// An asset's name: its own, or that of its file without folder and extension.
fn name_of(element: &Element) -> String {
    if let Some(name) = element.get("name") {
        return name.to_owned();
    }
    let file = element.get("file").unwrap_or_default();
    let file = file.rsplit(['/', '\\']).next().unwrap_or_default();
    file.rsplit_once('.').map_or(file, |(stem, _)| stem).to_owned()
}

impl MeshAsset<'_> {
    fn read(&self, name: &str, folders: &Folders<'_>) -> Result<Enclosed, Fault> {
        let element = self.styled.element;
        if element.find("builtin").is_some() {
            return Err(unsupported(element, "built-in meshes are generated by MuJoCo"));
        }
        if element.children_named("plugin").next().is_some() {
            return Err(unsupported(element, "its shape comes from a plugin"));
        }
        let mode =
            match keyword(self.styled.find("inertia"), "mesh", &["convex", "legacy", "exact", "shell"])? {
                Some(0) => Mode::Convex,
                Some(2) => Mode::Exact,
                Some(3) => Mode::Shell,
                _ => Mode::Legacy,
            };
        let at = |fault: MeshFault| {
            super::fault::fault(element.at, MjcfFault::Mesh { name: name.to_owned(), fault: Box::new(fault) })
        };
        let scale = array(self.styled.find("scale"), "mesh")?.unwrap_or([1.0; 3]);
        let mirrored = scale.iter().product::<f64>() < 0.0;
        let mut mesh = match element.find("file") {
            Some(attribute) => {
                let path = folders.mesh(element, &attribute.value);
                let bytes = folders
                    .files
                    .shelf
                    .contents(&path)
                    .map_err(|fault| at(MeshFault::File { file: path.display().to_string(), fault }))?;
                let kind = kind(element.get("content_type"), &path);
                Mesh::read(&kind, &bytes, mirrored).map_err(at)?
            }
            None => Mesh::default(),
        };
        self.add_inline(&mut mesh)?;
        if mesh.faces.is_empty() || mode == Mode::Convex {
            let limit = array(self.styled.find("maxhullvert"), "mesh")?.unwrap_or([-1.0]);
            if limit[0] >= 0.0 {
                return Err(at(MeshFault::LimitedHull));
            }
        }
        self.transform(&mut mesh, scale)?;
        enclosed(&mesh, mode).map_err(at)
    }

    /// Vertices and faces that stand in the file itself.
    fn add_inline(&self, mesh: &mut Mesh) -> Result<(), Fault> {
        let element = self.styled.element;
        if let Some(numbers) = numbers(element.find("vertex"), "mesh", 0..=usize::MAX)? {
            // Vertices are f32 in the reference.
            let numbers: Vec<f64> = numbers.iter().map(|&x| f64::from(x as f32)).collect();
            mesh.vertices.extend(numbers.chunks_exact(3).map(|v| [v[0], v[1], v[2]]));
        }
        if let Some(numbers) = numbers(element.find("face"), "mesh", 0..=usize::MAX)? {
            mesh.faces.extend(numbers.chunks_exact(3).map(|f| [f[0], f[1], f[2]].map(index)));
        }
        Ok(())
    }

    /// Moves, turns and scales the vertices.
    fn transform(&self, mesh: &mut Mesh, scale: [f64; 3]) -> Result<(), Fault> {
        let element = self.styled.element;
        let refpos = Vec3::from_f64(array(element.find("refpos"), "mesh")?.unwrap_or_default());
        let [w, x, y, z] = array(element.find("refquat"), "mesh")?.unwrap_or([1.0, 0.0, 0.0, 0.0]);
        let E = match w * w + x * x + y * y + z * z > 0.0 {
            true => Mat3::rotation_quaternion(w, Vec3::new(x, y, z)),
            false => return Err(unsupported(element, "its refquat is zero")),
        };
        let turned = [w, x, y, z] != [1.0, 0.0, 0.0, 0.0];
        for vertex in &mut mesh.vertices {
            let moved = Vec3::from_f64(*vertex) - refpos;
            let moved = if turned { E * moved } else { moved };
            *vertex = [moved.x * scale[0], moved.y * scale[1], moved.z * scale[2]];
        }
        Ok(())
    }
}

/// Files of meshes, height fields and skins that a document names, where they are looked for.
pub(super) fn files(root: &Element, folders: &Folders<'_>) -> Vec<PathBuf> {
    let sections = root.children.iter().filter(|s| matches!(s.tag.as_str(), "asset" | "deformable"));
    let elements = sections.flat_map(|section| &section.children);
    let named = elements.filter(|e| matches!(e.tag.as_str(), "mesh" | "hfield" | "skin"));
    named.filter_map(|e| Some(folders.mesh(e, e.get("file")?))).collect()
}

/// A vertex number; what is none becomes one that no mesh has.
fn index(x: f64) -> u32 {
    if x >= 0.0 && x < f64::from(u32::MAX) { x as u32 } else { u32::MAX }
}

/// A name whose extension says what the file holds.
fn kind(content_type: Option<&str>, path: &Path) -> String {
    match content_type {
        Some("model/stl") => "content.stl".to_owned(),
        Some("model/obj") => "content.obj".to_owned(),
        Some("model/vnd.mujoco.msh") => "content.msh".to_owned(),
        _ => path.display().to_string(),
    }
}

impl Folders<'_> {
    /// Where a mesh's file is: in the mesh folder of the main file, or beside the file that names it.
    fn mesh(&self, element: &Element, name: &str) -> PathBuf {
        let name = match self.settings.strippath {
            true => name.rsplit(['/', '\\']).next().unwrap_or(name),
            false => name,
        };
        let here = self.files.all.get(element.at.file as usize).map(|f| f.folder.clone()).unwrap_or_default();
        let meshdir = &self.settings.meshdir;
        let candidates = [self.main.join(meshdir).join(name), here.join(name), here.join(meshdir).join(name)];
        candidates.iter().find(|path| self.files.shelf.has(path)).unwrap_or(&candidates[0]).clone()
    }
}

//! How links look: shapes that files give for drawing. Nothing of these touches inertia.

use crate::file::Shelf;
use crate::mjcf::{Mesh, MeshFault};
use crate::shape::Shape;
use eigenbody::spatial::Transform;
use std::path::{Path, PathBuf};

/// One shape of a link. What a file gives and this cannot say is passed over.
#[derive(Debug, Clone, PartialEq)]
pub struct Look {
    /// The link's name.
    pub link: String,
    /// From the link's frame to the shape's.
    pub pose: Transform<f64>,
    /// The shape.
    pub form: Form,
}

/// What is seen.
#[derive(Debug, Clone, PartialEq)]
pub enum Form {
    /// A primitive; sizes are half-lengths (m).
    Primitive(Shape),
    /// Triangles of a file, not yet read; [`read_look`] does.
    Mesh {
        /// The file, as it was named.
        file: String,
        /// Factors of its x, y, z.
        scale: [f64; 3],
    },
}

/// Folders above a robot's own among which a package is looked for.
const ABOVE: usize = 4;

/// The triangles of a mesh that a robot file names for drawing: STL (binary), OBJ or MSH.
///
/// It is looked for in the robot's folder and the one above it, `package://NAME/..` and `model://NAME/..` also in a folder NAME further above; a
/// file outside of these, by whatever name, is not read. Errors: [`MeshFault`].
pub fn read_look(robot: &Path, file: &str) -> Result<Mesh, MeshFault> {
    let missing = || MeshFault::File { file: file.to_owned(), fault: crate::error::FileFault::Missing };
    let path = find(robot, file).ok_or_else(missing)?;
    let bytes =
        Shelf::Disk.contents(&path).map_err(|fault| MeshFault::File { file: file.to_owned(), fault })?;
    let mesh = Mesh::read(file, &bytes, false)?;
    mesh.check()?;
    Ok(mesh)
}

/// Where the file of a mesh may stand: beside the robot's, by its name, and where [`read_look`] finds it.
pub(crate) fn places(robot: &Path, file: &str) -> impl Iterator<Item = PathBuf> {
    let beside = robot.parent().map(|folder| folder.join(file.strip_prefix("file://").unwrap_or(file)));
    beside.into_iter().chain(find(robot, file))
}

fn find(robot: &Path, file: &str) -> Option<PathBuf> {
    let robot = std::fs::canonicalize(robot).ok()?;
    let folder = robot.parent()?;
    let near = [Some(folder), folder.parent()];
    let mut places: Vec<(PathBuf, &Path)> = Vec::new();
    match file.strip_prefix("package://").or_else(|| file.strip_prefix("model://")) {
        Some(rest) => {
            let (package, inside) = rest.split_once('/')?;
            for above in folder.ancestors().take(ABOVE) {
                if above.file_name().is_some_and(|name| name == package) {
                    places.push((above.join(inside), above));
                }
            }
            for root in near.into_iter().flatten() {
                places.push((root.join(package).join(inside), root));
                places.push((root.join(inside), root));
            }
        }
        None => {
            let name = file.strip_prefix("file://").unwrap_or(file);
            places.extend(near.into_iter().flatten().map(|root| (folder.join(name), root)));
        }
    }
    let within = |(path, root): (PathBuf, &Path)| {
        std::fs::canonicalize(path).ok().filter(|path| path.starts_with(root) && path.is_file())
    };
    places.into_iter().find_map(within)
}

//! `colliders`: bodies, how they move, and where their files are.

use std::path::Path;
use std::sync::Arc;

use nalgebra::Vector3;
use superhelix::io::{distance_grid, obj_mesh};
use superhelix::shapes::Sides;
use superhelix::splines::PoseSpline;
use superhelix::{BodyDef, Error, Shape};

use crate::scene::contact::groups::Groups;
use crate::scene::pose::deformation::Deformation;
use crate::scene::pose::motions::Motions;
use crate::scene::pose::read_pose;
use crate::shell::json::{Complaint, Entries, Node};
use crate::surfaces::surface::Surface;

/// A body and how it moves.
#[derive(Debug)]
pub struct Collider {
    /// What it is made of; its pose is already that of the motion's start.
    pub definition: BodyDef,
    /// Whether the scene says what its friction is.
    pub states_friction: bool,
    /// Its motion, if it moves.
    pub motion: Option<Arc<PoseSpline>>,
    /// How its vertices move, if they do.
    pub deformation: Option<Deformation>,
    /// For pictures, in the body's axes; meshes have their own triangles.
    pub surface: Option<Surface>,
}

/// Keys of every collider.
const COMMON: [&str; 8] = ["shape", "thickness", "friction", "viscous_friction", "group", "mask", "pose", "motion"];

#[derive(Clone, Copy)]
enum Kind {
    Sphere,
    Capsule,
    Ellipsoid,
    Cuboid,
    HalfSpace,
    Hull,
    Mesh,
    Grid,
}

const SHAPES: [(&str, Kind); 8] = [
    ("sphere", Kind::Sphere),
    ("capsule", Kind::Capsule),
    ("ellipsoid", Kind::Ellipsoid),
    ("box", Kind::Cuboid),
    ("halfspace", Kind::HalfSpace),
    ("hull", Kind::Hull),
    ("mesh", Kind::Mesh),
    ("grid", Kind::Grid),
];

/// Reads the list.
pub fn read(list: &Node, motions: &Motions, groups: &Groups, directory: &Path) -> Result<Vec<Collider>, Complaint> {
    list.list()?.iter().map(|collider| read_one(collider, motions, groups, directory)).collect()
}

fn read_one(node: &Node, motions: &Motions, groups: &Groups, directory: &Path) -> Result<Collider, Complaint> {
    // The shape first: it says which keys are known.
    let Some(shape) = node.value.as_object().map(|map| map.get("shape")) else { return Err(node.complain("an object")) };
    let Some(value) = shape else { return Err(Complaint::new(format!("{}.shape", node.key), "is missing")) };
    let kind = Node { key: format!("{}.shape", node.key), value }.choice(&SHAPES)?;
    let sizes: &[&str] = match kind {
        Kind::Sphere => &["radius"],
        Kind::Capsule => &["a", "b", "radius"],
        Kind::Ellipsoid => &["semi_axes"],
        Kind::Cuboid => &["half_edges"],
        Kind::HalfSpace => &["normal"],
        Kind::Hull => &["points", "file", "scale"],
        Kind::Mesh => &["vertices", "triangles", "file", "scale", "sides", "depth", "deformation"],
        Kind::Grid => &["file"],
    };
    let entries = node.object(&[&COMMON[..], sizes].concat())?;
    let (shape, surface) = read_shape(&entries, kind, directory)?;
    let mut definition = BodyDef::new(Arc::new(shape));
    definition.thickness = entries.or("thickness", definition.thickness, Node::not_negative)?;
    let friction = entries.get("friction").map(Node::not_negative).transpose()?;
    definition.friction = friction.unwrap_or(definition.friction);
    definition.viscous_friction = entries.or("viscous_friction", definition.viscous_friction, Node::not_negative)?;
    definition.group = entries.or("group", definition.group, |node| groups.bits(node))?;
    definition.mask = entries.or("mask", definition.mask, |node| groups.bits(node))?;
    if let Some(pose) = entries.get("pose") {
        definition.pose = read_pose(pose)?;
    }
    let motion = entries.get_unless_null("motion").map(|motion| motions.named_or_own(motion)).transpose()?;
    if let Some(motion) = &motion {
        definition.pose = motion.at(0.0);
    }
    let deformation = match (entries.get_unless_null("deformation"), definition.shape.mesh()) {
        (Some(node), Some(mesh)) => Some(Deformation::read(node, mesh.vertices().len(), scale(&entries)?, directory)?),
        _ => None,
    };
    if let Some(deformation) = &deformation {
        let mesh = definition.shape.mesh().map(|mesh| (mesh.triangles().to_vec(), mesh.sides()));
        if let Some((triangles, sides)) = mesh {
            let start = deformation.at(0.0);
            let shape = Shape::new_mesh(start, triangles, sides)
                .map_err(|error| Complaint::new(entries.path("deformation"), format!("at time 0: {error}")))?;
            definition.shape = Arc::new(shape);
        }
    }
    Ok(Collider { definition, states_friction: friction.is_some(), motion, deformation, surface })
}

/// Index of a vertex.
fn index(node: &Node) -> Result<u32, Complaint> {
    Ok(node.whole(0..=u64::from(u32::MAX))? as u32)
}

fn scale(entries: &Entries) -> Result<f64, Complaint> {
    entries.or("scale", 1.0, Node::positive)
}

fn read_shape(entries: &Entries, kind: Kind, directory: &Path) -> Result<(Shape, Option<Surface>), Complaint> {
    let complain = |error: Error| match error {
        Error::InvalidArgument { argument, value, expected } => Complaint::value(entries.path(&argument), value, expected),
        other => Complaint::new(entries.path("shape"), other.to_string()),
    };
    let vector = |name: &str| Ok(Vector3::from(entries.require(name)?.numbers::<3>()?));
    let radius = || entries.require("radius")?.positive();
    Ok(match kind {
        Kind::Sphere => {
            let radius = radius()?;
            (Shape::new_sphere(radius).map_err(complain)?, Some(Surface::ellipsoid(Vector3::repeat(radius))))
        }
        Kind::Capsule => {
            let (a, b, radius) = (vector("a")?, vector("b")?, radius()?);
            (Shape::new_capsule(a, b, radius).map_err(complain)?, Some(Surface::capsule(a, b, radius)))
        }
        Kind::Ellipsoid => {
            let semi_axes = vector("semi_axes")?;
            (Shape::new_ellipsoid(semi_axes).map_err(complain)?, Some(Surface::ellipsoid(semi_axes)))
        }
        Kind::Cuboid => {
            let half_edges = vector("half_edges")?;
            (Shape::new_box(half_edges).map_err(complain)?, Some(Surface::cuboid(half_edges)))
        }
        Kind::HalfSpace => {
            let normal = entries.or("normal", Vector3::z(), |node| Ok(Vector3::from(node.numbers::<3>()?)))?;
            (Shape::new_half_space(normal).map_err(complain)?, Some(Surface::half_space(normal)))
        }
        Kind::Hull => {
            let (points, source) = match entries.get("points") {
                Some(points) => (read_vectors(points)?, points),
                None => {
                    let file = entries.require("file")?;
                    (read_mesh(file, scale(entries)?, directory)?.0, file)
                }
            };
            only_one(entries, "points", "file")?;
            only_one(entries, "points", "scale")?;
            (Shape::new_hull(&points).map_err(|error| of_source(source, error))?, None)
        }
        Kind::Mesh => {
            only_one(entries, "vertices", "file")?;
            only_one(entries, "vertices", "scale")?;
            only_one(entries, "triangles", "file")?;
            let (vertices, triangles, source) = match entries.get("file") {
                Some(file) => {
                    let (vertices, triangles) = read_mesh(file, scale(entries)?, directory)?;
                    (vertices, triangles, file)
                }
                None => {
                    let vertices = entries.get("vertices").ok_or_else(|| {
                        Complaint::new(entries.path("file"), "is missing; expected it, or vertices and triangles")
                    })?;
                    let triangles = entries.require("triangles")?;
                    (read_vectors(vertices)?, read_triangles(triangles)?, triangles)
                }
            };
            let sides = read_sides(entries)?;
            (Shape::new_mesh(vertices, triangles, sides).map_err(|error| of_source(source, error))?, None)
        }
        Kind::Grid => {
            let file = entries.require("file")?;
            let grid = distance_grid::read(path_of(file, directory)?).map_err(|error| file_complaint(file, &error))?;
            let surface = Surface::grid(&grid);
            (Shape::new_grid(grid), Some(surface))
        }
    })
}

/// What is wrong with a shape, said of the key that it came from.
fn of_source(source: &Node, error: Error) -> Complaint {
    match (error, source.value.is_string()) {
        (error, true) => file_complaint(source, &error),
        (Error::InvalidArgument { argument, value, expected }, false) => {
            // points[3], triangles[2]: the rest of the name after the list's own.
            let rest = argument.find('[').map_or("", |at| &argument[at..]);
            Complaint::value(format!("{}{rest}", source.key), value, expected)
        }
        (other, false) => Complaint::new(&source.key, other.to_string()),
    }
}

pub fn file_complaint(file: &Node, error: &Error) -> Complaint {
    Complaint::new(&file.key, format!("is {}: {error}", file.value))
}

/// Complains if a key stands beside one that it cannot stand beside.
fn only_one(entries: &Entries, first: &str, second: &str) -> Result<(), Complaint> {
    match (entries.get(first), entries.get(second)) {
        (Some(_), Some(node)) => Err(node.complain(format!("no such key beside {first}"))),
        _ => Ok(()),
    }
}

fn read_sides(entries: &Entries) -> Result<Sides, Complaint> {
    #[derive(Clone, Copy, PartialEq)]
    enum Name {
        Solid,
        Front,
        Both,
    }
    let name = entries
        .or("sides", Name::Solid, |node| node.choice(&[("solid", Name::Solid), ("front", Name::Front), ("both", Name::Both)]))?;
    if let (Some(depth), true) = (entries.get("depth"), name != Name::Front) {
        return Err(depth.complain("a depth only where sides is \"front\""));
    }
    Ok(match name {
        Name::Solid => Sides::Solid,
        Name::Both => Sides::Both,
        Name::Front => Sides::Front { depth: entries.require("depth")?.positive()? },
    })
}

/// The path of a file that a scene names: relative to the scene.
pub fn path_of(file: &Node, directory: &Path) -> Result<std::path::PathBuf, Complaint> {
    let name = file.value.as_str().filter(|name| !name.is_empty()).ok_or_else(|| file.complain("the name of a file"))?;
    Ok(directory.join(name))
}

/// A mesh's vertices, m, and triangles.
pub type MeshParts = (Vec<Vector3<f64>>, Vec<[u32; 3]>);

/// Vertices (m) and triangles of a file.
pub fn read_mesh(file: &Node, scale: f64, directory: &Path) -> Result<MeshParts, Complaint> {
    let mesh = obj_mesh::read(path_of(file, directory)?).map_err(|error| file_complaint(file, &error))?;
    Ok((mesh.vertices.iter().map(|vertex| vertex * scale).collect(), mesh.triangles))
}

/// A list of points, m.
pub fn read_vectors(node: &Node) -> Result<Vec<Vector3<f64>>, Complaint> {
    node.list()?.iter().map(|item| Ok(Vector3::from(item.numbers::<3>()?))).collect()
}

fn read_triangles(node: &Node) -> Result<Vec<[u32; 3]>, Complaint> {
    let of = |item: &Node| {
        let corners = item.list()?;
        let [a, b, c] = &corners[..] else { return Err(item.complain("three indices of vertices, from 0")) };
        Ok([index(a)?, index(b)?, index(c)?])
    };
    node.list()?.iter().map(of).collect()
}

impl Collider {
    /// Its surface at a time (s), world, for pictures.
    pub fn surface_at(&self, time: f64) -> Surface {
        let pose = self.motion.as_ref().map_or(self.definition.pose, |motion| motion.at(time));
        let mut surface = match (&self.surface, self.definition.shape.mesh()) {
            (Some(surface), _) => surface.clone(),
            (None, Some(mesh)) => {
                let vertices =
                    self.deformation.as_ref().map_or_else(|| mesh.vertices().to_vec(), |deformation| deformation.at(time));
                Surface { vertices, triangles: mesh.triangles().to_vec() }
            }
            (None, None) => Surface::default(),
        };
        for vertex in &mut surface.vertices {
            *vertex = pose.origin + pose.rotation * *vertex;
        }
        surface
    }
}

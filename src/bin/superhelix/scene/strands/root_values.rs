//! Values at the roots of an item's strands: painted on a mesh, listed for its vertices, or attributes of the file that the strands come from.

use std::cell::OnceCell;
use std::path::Path;

use nalgebra::Vector3;
use superhelix::Frame;
use superhelix::hair::Density;
use superhelix::io::{StrandAttributes, obj_mesh};
use superhelix::shapes::{Mesh, Sides};

use crate::scene::colliders::{file_complaint, path_of};
use crate::scene::pose::read_pose;
use crate::shell::json::{Complaint, Entries, Node};
use crate::surfaces::region::{read_picture, read_vertex_densities};

/// Where values at the roots of an item come from.
#[derive(Debug)]
pub struct Sources<'a> {
    canvas: Option<Canvas>,
    item: &'a Item<'a>,
}

/// What an item of strands is made of, as far as values at its roots come from there.
#[derive(Debug)]
pub struct Item<'a> {
    follicles: Option<&'a Node<'a>>,
    groom: Option<Groom<'a>>,
    /// Where files are that are named.
    directory: &'a Path,
}

/// A mesh that values are painted on.
#[derive(Debug)]
struct Canvas {
    mesh: Mesh,
    corners: Option<Vec<[[f64; 2]; 3]>>,
    pose: Frame,
}

/// A groom's file, whose attributes are read when the first is asked for.
#[derive(Debug)]
struct Groom<'a> {
    file: &'a Node<'a>,
    attributes: OnceCell<StrandAttributes>,
}

/// Values over roots.
#[derive(Debug)]
pub enum Values {
    /// One for each vertex.
    Vertices(Vec<f64>),
    /// A picture over the texture coordinates, from the bottom row up: what black and what white stand for.
    Picture { width: usize, height: usize, values: Vec<f64>, black: f64, white: f64 },
    /// One for each strand of the file; NaN where it has none.
    Attribute(Vec<f64>),
}

/// A root: its place on the mesh, if there is one, and its strand's number in its file.
#[derive(Debug, Clone, Copy)]
pub struct Root {
    on_mesh: Option<(usize, [f64; 3])>,
    strand: usize,
}

/// The keys of values.
pub const KEYS: [&str; 6] = ["picture", "black", "white", "vertices", "attribute", "range"];

impl<'a> Item<'a> {
    /// Strands at these follicles, if there are any.
    pub fn of_follicles(follicles: Option<&'a Node<'a>>, directory: &'a Path) -> Self {
        Self { follicles, groom: None, directory }
    }

    /// Strands that have their shapes from a groom's file.
    pub fn of_groom(file: &'a Node<'a>, directory: &'a Path) -> Self {
        Self { follicles: None, groom: Some(Groom { file, attributes: OnceCell::new() }), directory }
    }

    /// Whether strands have their shapes from a file.
    pub fn is_groom(&self) -> bool {
        self.groom.is_some()
    }
}

impl<'a> Sources<'a> {
    /// Those of an item: the mesh that is named, else that of its follicles; and the file of its groom.
    pub fn read(mesh: Option<&Node>, item: &'a Item<'a>) -> Result<Self, Complaint> {
        let canvas = match (mesh, item.follicles) {
            (Some(mesh), _) => Some(Canvas::read(mesh, &mesh.object(&["file", "scale", "pose"])?, item.directory)?),
            (None, Some(follicles)) => Some(Canvas::read(follicles, &follicles.object(&FOLLICLES)?, item.directory)?),
            (None, None) => None,
        };
        Ok(Self { canvas, item })
    }

    /// A root (m, in the frame in which the mesh has its pose), at the nearest place of the mesh.
    pub fn root(&self, root: &Vector3<f64>, strand: usize) -> Root {
        let on_mesh = self.canvas.as_ref().and_then(|Canvas { mesh, pose, .. }| {
            let surface = mesh.closest(pose.rotation.inverse() * (root - pose.origin), f64::INFINITY)?;
            Some((surface.feature as usize, surface.weights))
        });
        Root { on_mesh, strand }
    }

    /// The value at a root; NaN where there is none.
    pub fn value(&self, values: &Values, root: &Root) -> f64 {
        match (values, &self.canvas, root.on_mesh) {
            (Values::Attribute(numbers), ..) => numbers.get(root.strand).copied().unwrap_or(f64::NAN),
            (Values::Vertices(numbers), Some(canvas), Some((triangle, weights))) => {
                let vertices = canvas.mesh.triangles()[triangle];
                (0..3).map(|corner| weights[corner] * numbers[vertices[corner] as usize]).sum()
            }
            (Values::Picture { width, height, values, black, white }, Some(canvas), Some((triangle, weights))) => {
                let uvs = canvas.corners.as_ref().map_or([[0.0; 2]; 3], |corners| corners[triangle]);
                let uv = [0, 1].map(|axis| (0..3).map(|corner| weights[corner] * uvs[corner][axis]).sum::<f64>());
                black + (white - black) * brightness([*width, *height], values, uv)
            }
            _ => f64::NAN,
        }
    }

    /// Reads values: `picture` with `black` and `white`, or `vertices`, or `attribute`. `missing_mesh` is the key that is missing where
    /// they need a mesh. `colours`: what black and white stand for where a picture does not say.
    pub fn values(&self, entries: &Entries, missing_mesh: &str, colours: Option<[f64; 2]>) -> Result<Values, Complaint> {
        let kinds = ["picture", "vertices", "attribute"];
        let mut given = kinds.iter().filter_map(|kind| entries.get(kind).map(|node| (*kind, node)));
        let Some((kind, node)) = given.next() else {
            return Err(Complaint::new(entries.path("picture"), "is missing: expected it, vertices, or attribute"));
        };
        if let Some((_, other)) = given.next() {
            return Err(other.complain(format!("no such key beside {kind}")));
        }
        if let Some(range) = entries.get("range").filter(|_| kind != "attribute") {
            return Err(range.complain("no such key without attribute"));
        }
        if kind == "attribute" {
            return self.attribute(node, entries);
        }
        let Some(canvas) = &self.canvas else {
            return Err(Complaint::new(missing_mesh, format!("is missing: {kind} is painted on a mesh")));
        };
        let complain = |failure: &dyn std::fmt::Display| Complaint::new(&node.key, format!("is {}: {failure}", node.value));
        if kind == "picture" {
            if canvas.corners.is_none() {
                return Err(node.complain("none where the mesh has no texture coordinates at the corners of its faces"));
            }
            let colour = |name: &str, index: usize| match colours {
                Some(colours) => entries.or(name, colours[index], Node::number),
                None => entries.require(name)?.number(),
            };
            let (black, white) = (colour("black", 0)?, colour("white", 1)?);
            return match read_picture(&path_of(node, self.item.directory)?).map_err(|failure| complain(&failure))? {
                Density::Picture { width, height, values } => Ok(Values::Picture { width, height, values, black, white }),
                _ => Err(node.complain("a picture")),
            };
        }
        if let Some(other) = entries.get("black").or_else(|| entries.get("white")) {
            return Err(other.complain("no such key beside vertices, whose numbers are the values"));
        }
        match read_vertex_densities(&path_of(node, self.item.directory)?).map_err(|failure| complain(&failure))? {
            Density::Vertices(values) if values.len() == canvas.mesh.vertices().len() => Ok(Values::Vertices(values)),
            Density::Vertices(values) => {
                let (has, vertices) = (values.len(), canvas.mesh.vertices().len());
                Err(node.complain(format!("a file of {vertices} numbers, one for each vertex; it has {has}")))
            }
            _ => Err(node.complain("numbers")),
        }
    }

    /// An attribute of the groom's file: its numbers, or from `black` to `white` as they go through `range`.
    fn attribute(&self, node: &Node, entries: &Entries) -> Result<Values, Complaint> {
        let Some(groom) = &self.item.groom else {
            return Err(node.complain("none where strands do not come from the file of a groom"));
        };
        let name = node.value.as_str().ok_or_else(|| node.complain("the name of an attribute"))?;
        let attributes = groom.attributes(self.item.directory)?;
        let Some(numbers) = attributes.get(name) else {
            let names: Vec<&str> = attributes.names().collect();
            let has = if names.is_empty() { "no attributes".to_owned() } else { names.join(", ") };
            return Err(node.complain(format!("an attribute of {}, which has {has}", groom.file.value)));
        };
        let colours = [entries.get("black"), entries.get("white")];
        let [Some(black), Some(white)] = colours else {
            if let Some(other) = colours.into_iter().flatten().chain(entries.get("range")).next() {
                return Err(other.complain("black and white, or neither: then the numbers of the attribute are the values"));
            }
            return Ok(Values::Attribute(numbers.to_vec()));
        };
        let (black, white) = (black.number()?, white.number()?);
        let [low, high] = entries.or("range", [0.0, 1.0], |range| match range.numbers()? {
            [low, high] if low != high => Ok([low, high]),
            _ => Err(range.complain("two different numbers")),
        })?;
        let value = |number: &f64| black + (white - black) * ((number - low) / (high - low));
        Ok(Values::Attribute(numbers.iter().map(value).collect()))
    }
}

/// The keys of follicles, which have a mesh.
const FOLLICLES: [&str; 7] = ["file", "scale", "pose", "count", "spacing", "density", "seed"];

impl Groom<'_> {
    fn attributes(&self, directory: &Path) -> Result<&StrandAttributes, Complaint> {
        if let Some(attributes) = self.attributes.get() {
            return Ok(attributes);
        }
        let read = StrandAttributes::read(path_of(self.file, directory)?).map_err(|error| file_complaint(self.file, &error))?;
        Ok(self.attributes.get_or_init(|| read))
    }
}

/// The brightness of a picture at texture coordinates, linear between the middles of pixels.
fn brightness([width, height]: [usize; 2], values: &[f64], [u, v]: [f64; 2]) -> f64 {
    let between = |coordinate: f64, count: usize| {
        let at = (coordinate * count as f64 - 0.5).clamp(0.0, (count - 1) as f64);
        let first = (at as usize).min(count.saturating_sub(2));
        (first, (first + 1).min(count - 1), at - first as f64)
    };
    let ((left, right, x), (low, high, y)) = (between(u, width), between(v, height));
    let row = |row: usize| values[row * width + left] * (1.0 - x) + values[row * width + right] * x;
    row(low) * (1.0 - y) + row(high) * y
}

impl Canvas {
    fn read(node: &Node, entries: &Entries, directory: &Path) -> Result<Self, Complaint> {
        let file = entries.require("file")?;
        let scale = entries.or("scale", 1.0, Node::positive)?;
        let pose = entries.or("pose", Frame::default(), read_pose)?;
        let read = obj_mesh::read_textured(path_of(file, directory)?);
        let (mesh, texture) = read.map_err(|error| file_complaint(file, &error))?;
        let vertices = mesh.vertices.iter().map(|vertex| vertex * scale).collect();
        let mesh = Mesh::new(vertices, mesh.triangles, Sides::Both);
        let mesh = mesh.map_err(|error| Complaint::new(&node.key, error.to_string()))?;
        Ok(Self { mesh, corners: texture.map(|texture| texture.corners()), pose })
    }
}

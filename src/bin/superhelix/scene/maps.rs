//! `maps` of a strand: parameters that vary from root to root, as they are painted on a mesh or listed for its vertices.

use std::path::Path;

use nalgebra::Vector3;
use superhelix::hair::Density;
use superhelix::io::obj_mesh;
use superhelix::shapes::{Mesh, Sides};
use superhelix::{Frame, Material, StrandDef};

use super::colliders::{file_complaint, path_of};
use super::pose::read_pose;
use crate::shell::json::{Complaint, Entries, Node};
use crate::surfaces::region::{read_picture, read_vertex_densities};

/// What a map can say.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Parameter {
    Radius,
    Density,
    YoungsModulus,
    PoissonRatio,
    InternalFriction,
    Viscosity,
    AirDrag,
    Length,
    Curl,
    Friction,
    WispRadius,
}

const PARAMETERS: [(&str, Parameter); 11] = [
    ("radius", Parameter::Radius),
    ("density", Parameter::Density),
    ("youngs_modulus", Parameter::YoungsModulus),
    ("poisson_ratio", Parameter::PoissonRatio),
    ("internal_friction", Parameter::InternalFriction),
    ("viscosity", Parameter::Viscosity),
    ("air_drag", Parameter::AirDrag),
    ("length", Parameter::Length),
    ("curl", Parameter::Curl),
    ("friction", Parameter::Friction),
    ("wisp_radius", Parameter::WispRadius),
];

/// Values over a mesh.
#[derive(Debug)]
enum Values {
    /// One for each vertex.
    Vertices(Vec<f64>),
    /// A picture over the texture coordinates, from the bottom row up: what black and what white stand for.
    Picture { width: usize, height: usize, values: Vec<f64>, black: f64, white: f64 },
}

/// A mesh that values are painted on.
#[derive(Debug)]
struct Canvas {
    mesh: Mesh,
    corners: Option<Vec<[[f64; 2]; 3]>>,
    pose: Frame,
}

/// The maps of an item of strands.
#[derive(Debug)]
pub struct Maps {
    canvas: Canvas,
    maps: Vec<(Parameter, Values)>,
}

/// What maps say at a root.
#[derive(Debug, Clone, Default)]
pub struct Mapped(Vec<(Parameter, f64)>);

/// What maps say of a strand's contact.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct MappedContact {
    /// Coulomb's coefficient against colliders, whatever the direction.
    pub friction: Option<f64>,
    /// The radius against other strands, m.
    pub wisp_radius: Option<f64>,
}

impl Maps {
    /// Reads `maps`; `follicles` are the strand's, whose mesh counts where no other is named. `fitted`: the strands have their shapes from a
    /// file, so that neither length nor curl can be mapped.
    pub fn read(node: &Node, follicles: Option<&Node>, fitted: bool, directory: &Path) -> Result<Self, Complaint> {
        let names: Vec<&str> = ["mesh"].into_iter().chain(PARAMETERS.map(|(name, _)| name)).collect();
        let entries = node.object(&names)?;
        let canvas = match (entries.get_unless_null("mesh"), follicles) {
            (Some(mesh), _) => Canvas::read(mesh, &mesh.object(&["file", "scale", "pose"])?, directory)?,
            (None, Some(follicles)) => {
                let keys = ["file", "scale", "pose", "count", "spacing", "density", "seed"];
                Canvas::read(follicles, &follicles.object(&keys)?, directory)?
            }
            (None, None) => return Err(Complaint::new(entries.path("mesh"), "is missing: maps are painted on a mesh")),
        };
        let mut maps = Vec::new();
        for (name, parameter) in PARAMETERS {
            let Some(map) = entries.get_unless_null(name) else { continue };
            if fitted && matches!(parameter, Parameter::Length | Parameter::Curl) {
                return Err(map.complain("no such map for strands that have their shapes from a file"));
            }
            maps.push((parameter, Values::read(map, &canvas, directory)?));
        }
        Ok(Self { canvas, maps })
    }

    /// What they say at the place of the mesh that is nearest to a root (m, in the frame in which the mesh has its pose).
    pub fn at(&self, root: &Vector3<f64>) -> Mapped {
        let Canvas { mesh, corners, pose } = &self.canvas;
        let place = pose.rotation.inverse() * (root - pose.origin);
        let Some(surface) = mesh.closest(place, f64::INFINITY) else { return Mapped::default() };
        let (triangle, weights) = (surface.feature as usize, surface.weights);
        let value = |(parameter, values): &(Parameter, Values)| {
            let found = match values {
                Values::Vertices(numbers) => {
                    let vertices = mesh.triangles()[triangle];
                    (0..3).map(|corner| weights[corner] * numbers[vertices[corner] as usize]).sum()
                }
                Values::Picture { width, height, values, black, white } => {
                    let uvs = corners.as_ref().map_or([[0.0; 2]; 3], |corners| corners[triangle]);
                    let uv = [0, 1].map(|axis| (0..3).map(|corner| weights[corner] * uvs[corner][axis]).sum::<f64>());
                    black + (white - black) * brightness([*width, *height], values, uv)
                }
            };
            (*parameter, found)
        };
        Mapped(self.maps.iter().map(value).collect())
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

impl Values {
    fn read(node: &Node, canvas: &Canvas, directory: &Path) -> Result<Self, Complaint> {
        let entries = node.object(&["picture", "black", "white", "vertices"])?;
        let complain =
            |file: &Node, failure: &dyn std::fmt::Display| Complaint::new(&file.key, format!("is {}: {failure}", file.value));
        match (entries.get("picture"), entries.get("vertices")) {
            (Some(picture), None) => {
                if canvas.corners.is_none() {
                    return Err(picture.complain("none where the mesh has no texture coordinates at the corners of its faces"));
                }
                let black = entries.require("black")?.number()?;
                let white = entries.require("white")?.number()?;
                match read_picture(&path_of(picture, directory)?).map_err(|failure| complain(picture, &failure))? {
                    Density::Picture { width, height, values } => Ok(Values::Picture { width, height, values, black, white }),
                    _ => Err(picture.complain("a picture")),
                }
            }
            (None, Some(numbers)) => {
                if let Some(other) = entries.get("black").or_else(|| entries.get("white")) {
                    return Err(other.complain("no such key beside vertices, whose numbers are the values"));
                }
                match read_vertex_densities(&path_of(numbers, directory)?).map_err(|failure| complain(numbers, &failure))? {
                    Density::Vertices(values) if values.len() == canvas.mesh.vertices().len() => Ok(Values::Vertices(values)),
                    Density::Vertices(values) => {
                        let (has, vertices) = (values.len(), canvas.mesh.vertices().len());
                        Err(numbers.complain(format!("a file of {vertices} numbers, one for each vertex; it has {has}")))
                    }
                    _ => Err(numbers.complain("numbers")),
                }
            }
            (Some(_), Some(other)) => Err(other.complain("no such key beside picture")),
            (None, None) => Err(node.complain("a picture, or numbers for the vertices")),
        }
    }
}

impl Mapped {
    fn get(&self, parameter: Parameter) -> Option<f64> {
        self.0.iter().find(|(other, _)| *other == parameter).map(|(_, value)| *value)
    }

    /// A material with what they say of it.
    pub fn material(&self, material: Material) -> Material {
        let get = |parameter, otherwise| self.get(parameter).unwrap_or(otherwise);
        let wider = self.get(Parameter::Radius).map_or(1.0, |mean| mean / material.mean_radius());
        Material {
            radius: material.radius.map(|radius| radius * wider),
            density: get(Parameter::Density, material.density),
            youngs_modulus: get(Parameter::YoungsModulus, material.youngs_modulus),
            poisson_ratio: get(Parameter::PoissonRatio, material.poisson_ratio),
            internal_friction: get(Parameter::InternalFriction, material.internal_friction),
            viscosity: get(Parameter::Viscosity, material.viscosity),
            air_drag: get(Parameter::AirDrag, material.air_drag),
        }
    }

    /// Lengths of elements with what they say of the whole, m.
    pub fn lengths(&self, lengths: &[f64]) -> Vec<f64> {
        let all: f64 = lengths.iter().sum();
        let longer = self.get(Parameter::Length).map_or(1.0, |length| length / all);
        lengths.iter().map(|length| length * longer).collect()
    }

    /// Gives a strand's natural and initial shapes the curl that they say.
    pub fn curl(&self, definition: &mut StrandDef) {
        let Some(curl) = self.get(Parameter::Curl) else { return };
        let rows = definition.natural.iter_mut().chain(definition.initial.iter_mut().flatten());
        rows.flatten().for_each(|curvature| *curvature *= curl);
    }

    /// What they say of contact.
    pub fn contact(&self) -> MappedContact {
        MappedContact { friction: self.get(Parameter::Friction), wisp_radius: self.get(Parameter::WispRadius) }
    }
}

impl MappedContact {
    /// Checks that nothing is below zero; `key` names the maps.
    pub fn check(&self, key: &str) -> Result<(), Complaint> {
        for (name, value) in [("friction", self.friction), ("wisp_radius", self.wisp_radius)] {
            if let Some(value) = value.filter(|value| *value < 0.0) {
                return Err(Complaint::new(format!("{key}.{name}"), format!("gives {value}; expected numbers of 0 or more")));
            }
        }
        Ok(())
    }
}

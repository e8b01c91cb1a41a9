//! `posing`: what is done to the strands before a run begins.
//!
//! Files:
//!
//! - `posed.rs`: The operations of `posing` done to a scene's strands.
//! - `rest_arguments.rs`: Shapes taken as natural or rest shapes, on the command line.

pub mod posed;
pub mod rest_arguments;

use nalgebra::Vector3;
use superhelix::editing::{Brush, ElementChange, Growth, Plane, Stiffening};
use superhelix::{MAX_ELEMENTS, Material};

use crate::groom::stiffening_arguments::STIFFENINGS;
use crate::scene::SceneStrand;
use crate::scene::strands::named;
use crate::scene::words::in_words_of_the_scene;
use crate::shell::json::{Complaint, Entries, Node};

/// Something that is done to strands.
#[derive(Debug, Clone)]
pub struct Operation {
    /// Its place in the document.
    pub key: String,
    /// To which strands; none: to all.
    pub strands: Option<Vec<usize>>,
    /// What.
    pub action: Action,
}

/// What is done to strands.
#[derive(Debug, Clone)]
pub enum Action {
    /// A point is dragged to a place.
    Drag {
        /// Arclength, m; none: the tip.
        arclength: Option<f64>,
        /// Where to, m.
        target: Vector3<f64>,
        /// How.
        how: How,
    },
    /// A brush is moved.
    Brush(Brush, How),
    /// An element is changed.
    Element(usize, ElementChange),
    /// All that lies beyond an arclength (m) goes.
    Cut(f64),
    /// It grows.
    Grow(Growth),
    /// Images are added.
    Mirror(Plane),
    /// The material is changed.
    Material(MaterialChange),
    /// The present shape becomes the natural one.
    TakeNatural,
    /// The present shape becomes that of rest, after the strand has been made as much stiffer as that takes.
    TakeRest(Option<(Stiffening, f64)>),
}

/// How strands are dragged and brushed.
#[derive(Debug, Clone)]
pub struct How {
    /// The first and the last element that may change.
    pub elements: Option<[usize; 2]>,
    /// See [`superhelix::editing::PoseOptions`].
    pub natural_pull: f64,
    /// The same.
    pub keep_tip_direction: bool,
    /// The same.
    pub keep_out: bool,
    /// The same.
    pub clearance: f64,
}

/// Values of a material that are set; the others stay.
#[derive(Debug, Clone, Default)]
pub struct MaterialChange {
    radius: Option<[f64; 2]>,
    values: [Option<f64>; 6],
}

/// Their keys beside `radius`.
const VALUES: [&str; 6] = ["density", "youngs_modulus", "poisson_ratio", "internal_friction", "viscosity", "air_drag"];

impl MaterialChange {
    /// A material with these values.
    pub fn applied(&self, material: &Material) -> Material {
        let [density, youngs_modulus, poisson_ratio, internal_friction, viscosity, air_drag] = self.values;
        Material {
            radius: self.radius.unwrap_or(material.radius),
            density: density.unwrap_or(material.density),
            youngs_modulus: youngs_modulus.unwrap_or(material.youngs_modulus),
            poisson_ratio: poisson_ratio.unwrap_or(material.poisson_ratio),
            internal_friction: internal_friction.unwrap_or(material.internal_friction),
            viscosity: viscosity.unwrap_or(material.viscosity),
            air_drag: air_drag.unwrap_or(material.air_drag),
        }
    }
}

/// The names of the operations, with the keys that each has beside `do` and `strands`.
const KEYS: [(&str, &[&str]); 8] = [
    ("drag", &["arclength", "target", "elements", "natural_pull", "keep_tip_direction", "keep_out", "clearance"]),
    (
        "brush",
        &["centre", "radius", "falloff", "movement", "elements", "natural_pull", "keep_tip_direction", "keep_out", "clearance"],
    ),
    ("change_element", &["element", "twist", "bend", "stretch", "keep_curvature"]),
    ("cut", &["arclength"]),
    ("grow", &["length", "elements", "curvatures"]),
    ("mirror", &["point", "normal"]),
    ("material", &["radius", "density", "youngs_modulus", "poisson_ratio", "internal_friction", "viscosity", "air_drag"]),
    ("take", &["shape", "stiffen", "margin"]),
];

/// Reads a list of operations on a scene's strands.
pub fn read(node: &Node, strands: &[SceneStrand]) -> Result<Vec<Operation>, Complaint> {
    node.list()?.iter().map(|node| read_one(node, strands)).collect()
}

fn read_one(node: &Node, strands: &[SceneStrand]) -> Result<Operation, Complaint> {
    let every: Vec<&str> = KEYS.iter().flat_map(|(_, keys)| keys.iter().copied()).chain(["do", "strands"]).collect();
    let named = node.object(&every)?;
    let names = KEYS.map(|(name, _)| (name, name));
    let name = named.require("do")?.choice(&names)?;
    let (_, keys) = KEYS.iter().find(|(known, _)| *known == name).unwrap_or(&KEYS[0]);
    let entries = node.object(&[&["do", "strands"], *keys].concat())?;
    let strands = entries.get_unless_null("strands").map(|list| {
        if list.value.is_string() {
            return named::of_name(list, strands);
        }
        list.list()?
            .iter()
            .map(|item| Ok(item.whole(0..=u64::from(u32::MAX))? as usize))
            .collect::<Result<Vec<usize>, Complaint>>()
    });
    let action = match name {
        "drag" => Action::Drag {
            arclength: entries.get_unless_null("arclength").map(Node::positive).transpose()?,
            target: Vector3::from(entries.require("target")?.numbers()?),
            how: read_how(&entries)?,
        },
        "brush" => Action::Brush(
            Brush {
                centre: Vector3::from(entries.require("centre")?.numbers()?),
                radius: entries.require("radius")?.positive()?,
                falloff: entries.or("falloff", 1.0, Node::not_negative)?,
                movement: Vector3::from(entries.require("movement")?.numbers()?),
            },
            read_how(&entries)?,
        ),
        "change_element" => {
            let element = entries.require("element")?.whole(0..=MAX_ELEMENTS as u64)? as usize;
            let change = ElementChange {
                twist: entries.or("twist", 0.0, Node::number)?,
                bend: entries.or("bend", [0.0; 2], Node::numbers)?,
                stretch: entries.or("stretch", 1.0, Node::positive)?,
                keep_curvature: entries.or("keep_curvature", true, Node::truth)?,
            };
            Action::Element(element, change)
        }
        "cut" => Action::Cut(entries.require("arclength")?.positive()?),
        "grow" => Action::Grow(Growth {
            length: entries.require("length")?.positive()?,
            elements: entries.or("elements", 0, |node| node.whole(0..=MAX_ELEMENTS as u64))? as usize,
            curvatures: entries.get_unless_null("curvatures").map(Node::numbers).transpose()?,
        }),
        "mirror" => {
            let normal = entries.require("normal")?;
            let point = entries.or("point", [0.0; 3], Node::numbers)?;
            let plane = Plane::new(Vector3::from(point), Vector3::from(normal.numbers()?));
            Action::Mirror(plane.map_err(|_| normal.complain("a vector with a direction"))?)
        }
        "material" => {
            let mut change = MaterialChange { radius: entries.get("radius").map(Node::numbers).transpose()?, values: [None; 6] };
            for (value, name) in change.values.iter_mut().zip(VALUES) {
                *value = entries.get(name).map(Node::number).transpose()?;
            }
            // Alone they must be good already.
            change.applied(&Material::default()).check(&node.key).map_err(in_words_of_the_scene)?;
            Action::Material(change)
        }
        _ => read_take(&entries)?,
    };
    Ok(Operation { key: node.key.clone(), strands: strands.transpose()?, action })
}

fn read_how(entries: &Entries) -> Result<How, Complaint> {
    let elements = entries.get_unless_null("elements").map(|node| {
        let [first, last] = node.numbers::<2>()?;
        if first.fract() != 0.0 || last.fract() != 0.0 || first < 0.0 || last < first {
            return Err(node.complain("the first and the last element that may change"));
        }
        Ok([first as usize, last as usize])
    });
    let natural_pull = entries.or("natural_pull", 0.0, |node| match node.number()? {
        share if (0.0..=1.0).contains(&share) => Ok(share),
        _ => Err(node.complain("a number, 0 to 1")),
    })?;
    Ok(How {
        elements: elements.transpose()?,
        natural_pull,
        keep_tip_direction: entries.or("keep_tip_direction", false, Node::truth)?,
        keep_out: entries.or("keep_out", true, Node::truth)?,
        clearance: entries.or("clearance", 0.0, Node::not_negative)?,
    })
}

fn read_take(entries: &Entries) -> Result<Action, Complaint> {
    let rest = entries.require("shape")?.choice(&[("natural", false), ("rest", true)])?;
    let by = entries.get_unless_null("stiffen").map(|node| node.choice(&STIFFENINGS)).transpose()?;
    if let (false, Some(node)) = (rest, entries.get_unless_null("stiffen")) {
        return Err(node.complain("nothing beside \"natural\": natural shapes need no stiffness"));
    }
    let margin = entries.or("margin", 0.05, |node| match node.number()? {
        margin if (0.0..1.0).contains(&margin) => Ok(margin),
        _ => Err(node.complain("a number, 0 to less than 1")),
    })?;
    if let (None, Some(node)) = (by, entries.get("margin")) {
        return Err(node.complain("no margin without \"stiffen\""));
    }
    Ok(if rest { Action::TakeRest(by.map(|by| (by, margin))) } else { Action::TakeNatural })
}

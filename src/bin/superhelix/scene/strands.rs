//! `strands`: what each is made from, and how its root moves.

use std::path::Path;

use nalgebra::{UnitQuaternion, Vector3};
use serde_json::Value;
use superhelix::contact::options::StrandContact;
use superhelix::math::pose_spline::PoseSpline;
use superhelix::rod::freedoms::Freedoms;
use superhelix::rod::material::Material;
use superhelix::solver::definition::{MAX_ELEMENTS, SolverOptions, StrandDef};

use super::pose::{read_motion, read_pose};
use super::words::in_words_of_the_scene;
use super::{groom, hair};
use crate::json::{Complaint, Entries, Node};

/// A strand and how its root moves.
#[derive(Debug)]
pub struct SceneStrand {
    /// What the strand is made from; its root and root velocity are already those of the motion's start.
    pub definition: StrandDef,
    /// The root's motion, if it moves.
    pub motion: Option<PoseSpline>,
    /// What it is to contact, where there is anything to touch.
    pub contact: Option<StrandContact>,
    /// Of which of the file's strands it is the image, if it is one.
    pub image_of: Option<usize>,
}

/// What a strand may say of its section and material.
const MATERIAL: [&str; 7] =
    ["radius", "density", "youngs_modulus", "poisson_ratio", "internal_friction", "viscosity", "air_drag"];

/// Reads an item of `strands`, but for its contact: one strand, or those of a groom. `directory` is where files are that it names.
pub fn read(node: &Node, options: &SolverOptions, directory: &Path) -> Result<Vec<SceneStrand>, Complaint> {
    if node.value.get("groom").is_none_or(Value::is_null) {
        return Ok(vec![read_one(node)?]);
    }
    let strands = node.object(&[&MATERIAL[..], &["groom", "contact"]].concat())?;
    let material = read_material(&strands, Material::default())?;
    let made = groom::read(strands.require("groom")?, material, options, directory)?;
    let strand = |definition: StrandDef| {
        definition.check(&node.key).map_err(in_words_of_the_scene)?;
        Ok(SceneStrand { definition, motion: None, contact: None, image_of: None })
    };
    made.into_iter().map(strand).collect()
}

fn read_material(strand: &Entries, defaults: Material) -> Result<Material, Complaint> {
    Ok(Material {
        radius: strand.or("radius", defaults.radius, Node::numbers)?,
        density: strand.or("density", defaults.density, Node::number)?,
        youngs_modulus: strand.or("youngs_modulus", defaults.youngs_modulus, Node::number)?,
        poisson_ratio: strand.or("poisson_ratio", defaults.poisson_ratio, Node::number)?,
        internal_friction: strand.or("internal_friction", defaults.internal_friction, Node::number)?,
        viscosity: strand.or("viscosity", defaults.viscosity, Node::number)?,
        air_drag: strand.or("air_drag", defaults.air_drag, Node::number)?,
    })
}

fn read_one(node: &Node) -> Result<SceneStrand, Complaint> {
    let strand = node.object(&[
        "elements",
        "length",
        "element_lengths",
        "groom",
        "hair",
        "radius",
        "density",
        "youngs_modulus",
        "poisson_ratio",
        "internal_friction",
        "viscosity",
        "air_drag",
        "natural_curvatures",
        "initial_curvatures",
        "initial_rates",
        "freedoms",
        "root",
        "root_motion",
        "contact",
    ])?;
    let element_lengths = read_lengths(&strand)?;
    let count = element_lengths.len();
    // Of the lengths only those that are above zero make it here.
    let hair = strand.get_unless_null("hair").map(|node| hair::read(node)?.strand(&element_lengths)).transpose()?;
    let defaults = hair.as_ref().map_or_else(Material::default, |hair| hair.material);
    let material = read_material(&strand, defaults)?;
    let rows = |name: &str| strand.get_unless_null(name).map(|rows| read_rows(rows, count)).transpose();
    let natural = hair.as_ref().map_or_else(|| vec![[0.0; 3]; count], |hair| hair.natural.clone());
    let mut definition = StrandDef {
        element_lengths,
        material,
        freedoms: strand.or("freedoms", Freedoms::ALL, read_freedoms)?,
        natural: strand.or("natural_curvatures", natural, |node| read_rows(node, count))?,
        initial: rows("initial_curvatures")?,
        initial_rates: rows("initial_rates")?,
        ..StrandDef::straight(1.0, 1)
    };
    if let Some(root) = strand.get("root") {
        definition.root = read_pose(root)?;
    }
    if let Some(hair) = hair.filter(|hair| hair.root_turn != 0.0) {
        if let Some(motion) = strand.get_unless_null("root_motion") {
            return Err(motion.complain("none where hair.variation.root_turn turns the root"));
        }
        definition.root.rotation *= UnitQuaternion::from_axis_angle(&Vector3::x_axis(), hair.root_turn);
    }
    let motion = strand.get_unless_null("root_motion").map(read_motion).transpose()?;
    if let Some(motion) = &motion {
        definition.root = motion.at(0.0);
        (definition.root_velocity, definition.root_angular_velocity) = motion.velocity(0.0);
    }
    definition.check(&node.key).map_err(in_words_of_the_scene)?;
    Ok(SceneStrand { definition, motion, contact: None, image_of: None })
}

/// `elements` and `length`, or `element_lengths` in place of both.
fn read_lengths(strand: &Entries) -> Result<Vec<f64>, Complaint> {
    if let Some(lengths) = strand.get("element_lengths") {
        for other in ["elements", "length"] {
            if let Some(other) = strand.get(other) {
                return Err(other.complain("no such key beside element_lengths, which stands in place of elements and length"));
            }
        }
        let items = lengths.list()?;
        if items.is_empty() || items.len() > MAX_ELEMENTS {
            return Err(lengths.complain(format!("1 to {MAX_ELEMENTS} lengths")));
        }
        return items.iter().map(Node::positive).collect();
    }
    let count = strand.require("elements")?.whole(1..=MAX_ELEMENTS as u64)? as usize;
    let length = strand.require("length")?.positive()?;
    Ok(vec![length / count as f64; count])
}

/// One row (twist, k1, k2) for all elements, or one an element.
fn read_rows(node: &Node, count: usize) -> Result<Vec<[f64; 3]>, Complaint> {
    let items = node.list()?;
    if items.len() != 1 && items.len() != count {
        let expected = if count == 1 { "1 row".to_string() } else { format!("1 row, or {count} rows: one an element") };
        return Err(Complaint::value(&node.key, format!("a list of {}", items.len()), expected));
    }
    let rows = items.iter().map(Node::numbers).collect::<Result<Vec<[f64; 3]>, _>>()?;
    Ok(if rows.len() == count { rows } else { vec![rows[0]; count] })
}

fn read_freedoms(node: &Node) -> Result<Freedoms, Complaint> {
    let names = [("twist", Freedoms::TWIST), ("bend1", Freedoms::BEND1), ("bend2", Freedoms::BEND2)];
    let mut freedoms: Option<Freedoms> = None;
    for item in node.list()? {
        let freedom = item.choice(&names)?;
        if freedoms.is_some_and(|seen| seen.bits() & freedom.bits() != 0) {
            return Err(item.complain("each freedom once"));
        }
        freedoms = Some(freedoms.map_or(freedom, |seen| seen.union(freedom)));
    }
    freedoms.ok_or_else(|| node.complain("at least one of \"twist\", \"bend1\", \"bend2\""))
}

//! `strands`: what each is made from, and how its root moves.
//!
//! Files:
//!
//! - `follicles.rs`: `follicles` of a strand: places on a mesh, at each of which one such strand stands.
//! - `groom.rs`: `groom` of a strand: a file of curves, in whose place stands a strand for each of them, fitted.
//! - `hair.rs`: `hair` of a strand: a measured kind, sliders and variation, from which what the strand does not say itself is taken.
//! - `maps.rs`: `maps` of a strand: parameters that vary from root to root.
//! - `named.rs`: `name` of items of `strands`, by which other keys say which strands they mean.
//! - `only.rs`: `only` of an item: which strands of its groom, or which of its follicles, it stands for.
//! - `root_values.rs`: Values at the roots of an item's strands: painted on a mesh, listed for its vertices, or attributes of the file that the strands come from.
//! - `written.rs`: Strands as a scene file.

mod follicles;
mod groom;
mod hair;
pub mod maps;
pub mod named;
mod only;
mod root_values;
pub mod written;

use std::path::Path;
use std::sync::Arc;

use nalgebra::{UnitQuaternion, Vector3};
use serde_json::Value;
use superhelix::hair::VariedStrand;
use superhelix::{Frame, Freedoms, MAX_ELEMENTS, Material, SolverOptions, StrandContact, StrandDef};

use crate::scene::pose::motions::Motions;
use crate::scene::pose::{Moves, RootMotion, read_pose, read_root_motion};
use crate::scene::words::in_words_of_the_scene;
use crate::shell::json::{Complaint, Entries, Node};
use maps::{MappedContact, Maps};
use only::Only;
use root_values::Item;

/// A strand and how its root moves.
#[derive(Debug)]
pub struct SceneStrand {
    /// What the strand is made from; its root and root velocity are already those of the motion's start.
    pub definition: StrandDef,
    /// The root's motion, if it moves.
    pub motion: Option<RootMotion>,
    /// Which item of the file's list it comes from.
    pub item: usize,
    /// The name of the item, if it has one.
    pub name: Option<Arc<str>>,
    /// What it is to contact, where there is anything to touch.
    pub contact: Option<StrandContact>,
    /// What maps say of its contact.
    pub mapped: MappedContact,
    /// Of which strand it is the image, if it is one.
    pub image_of: Option<usize>,
}

/// What a strand may say of its section and material.
const MATERIAL: [&str; 7] =
    ["radius", "density", "youngs_modulus", "poisson_ratio", "internal_friction", "viscosity", "air_drag"];

/// What only a strand that is no groom's may say of its shape and place.
const OF_ITS_OWN: [&str; 7] =
    ["natural_curvatures", "initial_curvatures", "initial_rates", "freedoms", "root", "follicles", "root_motion"];

/// What any item may say beside that.
const OF_ANY: [&str; 4] = ["name", "only", "contact", "maps"];

/// Reads item number `item` of `strands`, but for its contact: one strand, one at each of its follicles, or those of a groom. `directory` is
/// where files are that it names.
pub fn read(
    node: &Node,
    item: usize,
    options: &SolverOptions,
    motions: &Motions,
    directory: &Path,
) -> Result<Vec<SceneStrand>, Complaint> {
    if node.value.get("groom").is_none_or(Value::is_null) {
        return read_own(node, item, motions, directory);
    }
    let strands = node.object(&[&MATERIAL[..], &["groom"], &OF_ANY].concat())?;
    let name = named::read(node)?;
    let material = read_material(&strands, Material::default())?;
    let groom = strands.require("groom")?;
    let file = Node { key: format!("{}.file", groom.key), value: &groom.value["file"] };
    let whole = Item::of_groom(&file, directory);
    let only = strands.get_unless_null("only").map(|only| Only::read(only, &whole)).transpose()?;
    let maps = strands.get_unless_null("maps").map(|maps| Maps::read(maps, &whole)).transpose()?;
    let made = groom::read(groom, material, maps.as_ref(), only.as_ref(), options, directory)?;
    let strand = |(definition, mapped): (StrandDef, MappedContact)| {
        definition.check(&node.key).map_err(in_words_of_the_scene)?;
        mapped.check(&format!("{}.maps", node.key))?;
        Ok(SceneStrand { definition, motion: None, item, name: name.clone(), contact: None, mapped, image_of: None })
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

fn read_own(node: &Node, item: usize, motions: &Motions, directory: &Path) -> Result<Vec<SceneStrand>, Complaint> {
    let strand = node
        .object(&[&["elements", "length", "element_lengths", "groom", "hair"][..], &MATERIAL, &OF_ITS_OWN, &OF_ANY].concat())?;
    let follicles = strand.get_unless_null("follicles");
    let places = match (follicles, strand.get("root")) {
        (Some(_), Some(root)) => return Err(root.complain("no such key beside follicles, which say where the roots are")),
        (Some(follicles), None) => follicles::read(follicles, directory)?,
        (None, root) => vec![root.map_or(Ok(Frame::default()), read_pose)?],
    };
    let name = named::read(node)?;
    let element_lengths = read_lengths(&strand)?;
    let hair = strand.get_unless_null("hair").map(hair::read).transpose()?;
    let motion = strand.get_unless_null("root_motion").map(|node| read_root_motion(node, motions)).transpose()?;
    let whole = Item::of_follicles(follicles, directory);
    let maps = strand.get_unless_null("maps").map(|maps| Maps::read(maps, &whole)).transpose()?;
    let chosen = match strand.get_unless_null("only") {
        Some(only) if follicles.is_none() => return Err(only.complain("no such key without groom or follicles")),
        Some(only) => {
            let only = Only::read(only, &whole)?;
            only.among(0..places.len(), places.len(), |number| places[number].origin)?
        }
        None => (0..places.len()).collect(),
    };
    let one = |number: usize| {
        let place = &places[number];
        // The mesh of follicles moves with them.
        let moves = motion.as_ref().filter(|_| follicles.is_none());
        let root = moves.map_or(place.origin, |motion| motion.at(0.0).origin);
        let mapped = maps.as_ref().map(|maps| maps.at(&root, number)).transpose()?.unwrap_or_default();
        let element_lengths = mapped.lengths(&element_lengths);
        let hair = hair.as_ref().map(|hair| hair.strand(number as u64, &element_lengths)).transpose()?;
        let mut definition = read_definition(&strand, element_lengths, hair.as_ref())?;
        definition.material = mapped.material(definition.material);
        mapped.curl(&mut definition);
        let mut place = *place;
        if let Some(hair) = hair.filter(|hair| hair.root_turn != 0.0) {
            if let Some(motion) = strand.get_unless_null("root_motion").filter(|_| follicles.is_none()) {
                return Err(motion.complain("none where hair.variation.root_turn turns the root"));
            }
            place.rotation *= UnitQuaternion::from_axis_angle(&Vector3::x_axis(), hair.root_turn);
        }
        definition.root = place;
        let motion = motion.as_ref().map(|motion| match follicles {
            Some(_) => RootMotion { local: motion.local.compose(&place), ..motion.clone() },
            None => motion.clone(),
        });
        if let Some(motion) = &motion {
            definition.root = motion.at(0.0);
            (definition.root_velocity, definition.root_angular_velocity) = motion.velocity(0.0);
        }
        definition.check(&node.key).map_err(in_words_of_the_scene)?;
        let mapped = mapped.contact();
        mapped.check(&format!("{}.maps", node.key))?;
        Ok(SceneStrand { definition, motion, item, name: name.clone(), contact: None, mapped, image_of: None })
    };
    chosen.into_iter().map(one).collect()
}

/// A strand at the origin.
fn read_definition(strand: &Entries, element_lengths: Vec<f64>, hair: Option<&VariedStrand>) -> Result<StrandDef, Complaint> {
    let count = element_lengths.len();
    let material = read_material(strand, hair.map_or_else(Material::default, |hair| hair.material))?;
    let rows = |name: &str| strand.get_unless_null(name).map(|rows| read_rows(rows, count)).transpose();
    let natural = hair.map_or_else(|| vec![[0.0; 3]; count], |hair| hair.natural.clone());
    Ok(StrandDef {
        element_lengths,
        material,
        freedoms: strand.or("freedoms", Freedoms::ALL, read_freedoms)?,
        natural: strand.or("natural_curvatures", natural, |node| read_rows(node, count))?,
        initial: rows("initial_curvatures")?,
        initial_rates: rows("initial_rates")?,
        ..StrandDef::straight(1.0, 1)
    })
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

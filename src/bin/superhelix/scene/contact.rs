//! `contact` and `hair_contact`: how touches are answered, and what strands are to them.
//!
//! Files:
//!
//! - `groups.rs`: `groups`: names for the groups of what touches, a bit each.

pub mod groups;

use superhelix::{ContactModel, ContactOptions, Friction, StrandContact};

use crate::scene::SceneStrand;
use crate::scene::colliders::Collider;
use crate::scene::strands::maps::MappedContact;
use crate::shell::json::{Complaint, Entries, Node};
use groups::Groups;

/// The models by their names in a scene and on the command line.
pub const MODELS: [(&str, ContactModel); 5] = [
    ("penalty", ContactModel::Penalty),
    ("regularised", ContactModel::RegularisedPenalty),
    ("at_points", ContactModel::AtPoints),
    ("hard", ContactModel::Coulomb),
    ("coulomb", ContactModel::Coulomb),
];

/// What a scene says of a strand's contact; what it leaves out comes from elsewhere.
#[derive(Debug, Clone, Copy, Default)]
pub struct Given {
    radius: Option<f64>,
    wisp_radius: Option<f64>,
    friction: Option<Friction>,
    hair_friction: Option<Friction>,
    viscous_friction: Option<Friction>,
    exempt_length: Option<f64>,
    group: Option<u32>,
    mask: Option<u32>,
}

impl Given {
    /// This, and where it says nothing `other`.
    fn or(self, other: Given) -> Given {
        Given {
            radius: self.radius.or(other.radius),
            wisp_radius: self.wisp_radius.or(other.wisp_radius),
            friction: self.friction.or(other.friction),
            hair_friction: self.hair_friction.or(other.hair_friction),
            viscous_friction: self.viscous_friction.or(other.viscous_friction),
            exempt_length: self.exempt_length.or(other.exempt_length),
            group: self.group.or(other.group),
            mask: self.mask.or(other.mask),
        }
    }
}

/// What a strand's own `contact` says.
#[derive(Debug, Clone, Copy)]
pub enum OfStrand {
    /// It touches nothing.
    Nothing,
    /// It touches; with these values of its own.
    Touches(Given),
}

/// What touches strands, and what all of them have in common.
#[derive(Debug)]
pub struct Touching {
    hair: bool,
    common: Given,
    /// What strands overlap at the start is allowed.
    pub allow_overlaps: bool,
}

/// Keys that a strand and all strands together may have.
const COMMON: [&str; 6] = ["radius", "friction", "viscous_friction", "exempt_length", "group", "mask"];

/// Reads `contact` and `hair_contact`.
pub fn read(scene: &Entries, groups: &Groups) -> Result<(ContactOptions, Touching), Complaint> {
    let mut options = ContactOptions::default();
    let mut common = Given::default();
    let mut allow_overlaps = false;
    if let Some(contact) = scene.get("contact") {
        let entries = contact.object(&[
            "model",
            "stiffness",
            "damping",
            "regularisation_depth",
            "tolerance",
            "residual",
            "separation_speed",
            "max_iterations",
            "max_sweeps",
            "allow_overlaps",
            "strands",
        ])?;
        options.model = entries.or("model", options.model, |node| node.choice(&MODELS))?;
        options.stiffness = entries.or("stiffness", options.stiffness, Node::positive)?;
        options.damping = entries.or("damping", options.damping, Node::not_negative)?;
        options.regularisation_depth = entries.or("regularisation_depth", options.regularisation_depth, Node::positive)?;
        options.tolerance = entries.or("tolerance", options.tolerance, Node::positive)?;
        options.residual = entries.or("residual", options.residual, Node::positive)?;
        options.separation_speed = entries.or("separation_speed", options.separation_speed, Node::positive)?;
        options.max_iterations =
            entries.or("max_iterations", options.max_iterations, |node| Ok(node.whole(1..=10_000)? as u32))?;
        options.max_sweeps = entries.or("max_sweeps", options.max_sweeps, |node| Ok(node.whole(1..=1_000_000)? as u32))?;
        allow_overlaps = entries.or("allow_overlaps", false, Node::truth)?;
        if let Some(strands) = entries.get("strands") {
            common = read_given(strands, &COMMON, groups)?;
        }
    }
    if let Some(hair) = scene.get("hair_contact") {
        options.hair = match hair.value.is_object() {
            true => {
                let entries = hair.object(&["wisp_radius", "friction"])?;
                common.wisp_radius = entries.get("wisp_radius").map(Node::positive).transpose()?;
                common.hair_friction = entries.get("friction").map(read_friction).transpose()?;
                true
            }
            false => hair.value.as_bool().ok_or_else(|| hair.complain("true, false, or an object"))?,
        };
    }
    Ok((options, Touching { hair: options.hair, common, allow_overlaps }))
}

/// Reads a strand's own `contact`: values, or false.
pub fn read_of_strand(strand: &Node, groups: &Groups) -> Result<OfStrand, Complaint> {
    // Whether the strand has other keys than these was looked at before.
    let Some(value) = strand.value.get("contact") else { return Ok(OfStrand::Touches(Given::default())) };
    let node = Node { key: format!("{}.contact", strand.key), value };
    match value.as_bool() {
        Some(true) => Ok(OfStrand::Touches(Given::default())),
        Some(false) => Ok(OfStrand::Nothing),
        None if value.is_null() => Ok(OfStrand::Touches(Given::default())),
        None if value.is_object() => {
            let known = [&COMMON[..], &["wisp_radius", "hair_friction"]].concat();
            Ok(OfStrand::Touches(read_given(&node, &known, groups)?))
        }
        None => Err(node.complain("true, false, null, or an object")),
    }
}

fn read_given(node: &Node, known: &[&str], groups: &Groups) -> Result<Given, Complaint> {
    let entries = node.object(known)?;
    let length = |name: &str| entries.get(name).map(Node::not_negative).transpose();
    let friction = |name: &str| entries.get(name).map(read_friction).transpose();
    let bits = |name: &str| entries.get(name).map(|node| groups.bits(node)).transpose();
    Ok(Given {
        radius: length("radius")?,
        wisp_radius: length("wisp_radius")?,
        friction: friction("friction")?,
        hair_friction: friction("hair_friction")?,
        viscous_friction: friction("viscous_friction")?,
        exempt_length: length("exempt_length")?,
        group: bits("group")?,
        mask: bits("mask")?,
    })
}

/// One coefficient, or one along and one against the scales.
pub fn read_friction(node: &Node) -> Result<Friction, Complaint> {
    if !node.value.is_object() {
        return Ok(Friction::uniform(
            node.not_negative().map_err(|_| node.complain("a number of 0 or more, or an object with along and against"))?,
        ));
    }
    let entries = node.object(&["along", "against"])?;
    Ok(Friction { along: entries.require("along")?.not_negative()?, against: entries.require("against")?.not_negative()? })
}

impl Touching {
    /// Gives strands their contact, where there is anything to touch.
    ///
    /// A coefficient of friction is the collider's times the strand's; what is left out counts as 1. Where neither says anything, the
    /// strand has that of hair. So a collider without friction is an error where a strand without any touches others that have it.
    pub fn give(&self, strands: &mut [SceneStrand], given: Vec<OfStrand>, colliders: &[Collider]) -> Result<(), Complaint> {
        if colliders.is_empty() && !self.hair {
            return Ok(());
        }
        let defaults = StrandContact::default();
        let stated = colliders.iter().any(|collider| collider.states_friction);
        for (index, (strand, given)) in strands.iter_mut().zip(given).enumerate() {
            let OfStrand::Touches(own) = given else { continue };
            let MappedContact { friction, wisp_radius } = strand.mapped;
            let mapped = Given { friction: friction.map(Friction::uniform), wisp_radius, ..Given::default() };
            let values = mapped.or(own).or(self.common);
            if let (true, None, Some(other)) =
                (stated, values.friction, colliders.iter().position(|collider| !collider.states_friction))
            {
                return Err(Complaint::new(
                    format!("colliders[{other}].friction"),
                    format!("is missing, while other colliders have theirs and strands[{index}] says nothing of friction either"),
                ));
            }
            let section = strand.definition.material.radius;
            let radius = values.radius.unwrap_or(section[0].max(section[1]));
            strand.contact = Some(StrandContact {
                radius,
                wisp_radius: if self.hair { values.wisp_radius.unwrap_or(radius) } else { 0.0 },
                friction: values.friction.unwrap_or(if stated { Friction::uniform(1.0) } else { defaults.friction }),
                hair_friction: values.hair_friction.unwrap_or(defaults.hair_friction),
                viscous_friction: values.viscous_friction.unwrap_or(defaults.viscous_friction),
                exempt_length: values.exempt_length.unwrap_or(0.0),
                groups: values.group.unwrap_or(defaults.groups),
                mask: values.mask.unwrap_or(defaults.mask),
            });
        }
        Ok(())
    }
}

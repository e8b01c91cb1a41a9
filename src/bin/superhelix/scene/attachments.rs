//! `attachments`: what holds strands, as constraints.

use std::sync::Arc;

use nalgebra::Vector3;
use superhelix::splines::PoseSpline;
use superhelix::{ConstraintDef, Frame, Friction, Hold, Solver, StrandId};

use crate::scene::SceneStrand;
use crate::scene::contact::read_friction;
use crate::scene::pose::motions::Motions;
use crate::scene::pose::{read_frame, read_pose};
use crate::shell::json::{Complaint, Entries, Node};

/// Something that holds a strand.
#[derive(Debug)]
pub struct Attachment {
    strand: usize,
    arclength: f64,
    kind: Kind,
    target: Target,
    /// How its target moves, if it does.
    pub motion: Option<Arc<PoseSpline>>,
    compliance: f64,
}

#[derive(Debug, Clone, Copy)]
enum Kind {
    Point,
    Direction,
    Frame,
    Slide(Friction),
    Tie { other: usize, arclength: f64 },
}

/// Where an attachment holds.
#[derive(Debug, Clone, Copy)]
enum Target {
    /// Where the strand's point is at the start, turned as it is there.
    Start,
    /// A place; turned as the strand is at the start.
    Place(Vector3<f64>),
    Frame(Frame),
}

/// Reads the list.
pub fn read(list: &Node, strands: &[SceneStrand], motions: &Motions) -> Result<Vec<Attachment>, Complaint> {
    list.list()?.iter().map(|item| read_one(item, strands, motions)).collect()
}

fn read_one(node: &Node, strands: &[SceneStrand], motions: &Motions) -> Result<Attachment, Complaint> {
    const COMMON: [&str; 4] = ["strand", "arclength", "kind", "compliance"];
    const KINDS: [(&str, Kind); 5] = [
        ("point", Kind::Point),
        ("direction", Kind::Direction),
        ("frame", Kind::Frame),
        ("slide", Kind::Slide(Friction { along: 0.0, against: 0.0 })),
        ("tie", Kind::Tie { other: 0, arclength: 0.0 }),
    ];
    let Some(map) = node.value.as_object() else { return Err(node.complain("an object")) };
    let Some(value) = map.get("kind") else { return Err(Complaint::new(format!("{}.kind", node.key), "is missing")) };
    let mut kind = Node { key: format!("{}.kind", node.key), value }.choice(&KINDS)?;
    let own: &[&str] = match kind {
        Kind::Point | Kind::Direction | Kind::Frame => &["target", "motion"],
        Kind::Slide(_) => &["target", "motion", "friction"],
        Kind::Tie { .. } => &["other", "other_arclength"],
    };
    let entries = node.object(&[&COMMON[..], own].concat())?;
    let strand = read_strand(entries.require("strand")?, strands)?;
    let arclength = read_arclength(entries.require("arclength")?, &strands[strand])?;
    match &mut kind {
        Kind::Slide(friction) => {
            *friction = entries.or("friction", *friction, read_friction)?;
        }
        Kind::Tie { other, arclength: on_other } => {
            *other = read_strand(entries.require("other")?, strands)?;
            let node = entries.require("other_arclength")?;
            *on_other = read_arclength(node, &strands[*other])?;
            if *other == strand && *on_other == arclength {
                return Err(node.complain("another point than the first"));
            }
        }
        Kind::Point | Kind::Direction | Kind::Frame => {}
    }
    let compliance = entries.or("compliance", 0.0, Node::not_negative)?;
    if let (Kind::Slide(_), true, Some(node)) = (kind, compliance != 0.0, entries.get("compliance")) {
        return Err(node.complain("0 where kind is \"slide\""));
    }
    let motion = entries.get_unless_null("motion").map(|motion| motions.named_or_own(motion)).transpose()?;
    let target = match &motion {
        Some(motion) => Target::Frame(motion.at(0.0)),
        None => read_target(&entries)?,
    };
    Ok(Attachment { strand, arclength, kind, target, motion, compliance })
}

fn read_strand(node: &Node, strands: &[SceneStrand]) -> Result<usize, Complaint> {
    if strands.is_empty() {
        return Err(node.complain("no attachment: the scene has no strands"));
    }
    Ok(node.whole(0..=strands.len() as u64 - 1)? as usize)
}

fn read_arclength(node: &Node, strand: &SceneStrand) -> Result<f64, Complaint> {
    let length = strand.definition.length();
    let arclength = node.number()?;
    // The elements' lengths sum to the strand's with rounding.
    match (0.0..=length * (1.0 + 1e-9)).contains(&arclength) {
        true => Ok(arclength),
        false => Err(node.complain(format!("0 to the strand's length, {length} m"))),
    }
}

fn read_target(entries: &Entries) -> Result<Target, Complaint> {
    let Some(node) = entries.get_unless_null("target") else { return Ok(Target::Start) };
    if node.value.is_object() {
        return Ok(Target::Frame(read_pose(node)?));
    }
    match node.value.as_array().map(Vec::len) {
        Some(3) => Ok(Target::Place(Vector3::from(node.numbers()?))),
        Some(7) => {
            let [x, y, z, qx, qy, qz, qw] = node.numbers()?;
            Ok(Target::Frame(read_frame(&node.key, [x, y, z], [qx, qy, qz, qw])?))
        }
        _ => Err(node.complain("[x, y, z], [x, y, z, qx, qy, qz, qw] or an object with origin and rotation")),
    }
}

impl Attachment {
    /// The constraint, for the scene's strands as they are in a solver now.
    pub fn constraint(&self, solver: &Solver, ids: &[StrandId]) -> superhelix::Result<ConstraintDef> {
        let strand = ids[self.strand];
        let mut start = Frame::default();
        solver.sample_at(strand, &[self.arclength], |_, sample| {
            start = Frame { origin: sample.position, rotation: sample.rotation };
        })?;
        Ok(ConstraintDef {
            strand,
            arclength: self.arclength,
            hold: match self.kind {
                Kind::Point => Hold::Point,
                Kind::Direction => Hold::Direction,
                Kind::Frame => Hold::Frame,
                Kind::Slide(friction) => Hold::Ring { friction },
                Kind::Tie { other, arclength } => Hold::Tie { other: ids[other], arclength },
            },
            target: match self.target {
                Target::Start => start,
                Target::Place(origin) => Frame { origin, ..start },
                Target::Frame(frame) => frame,
            },
            compliance: self.compliance,
        })
    }
}

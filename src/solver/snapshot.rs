//! Snapshots: a solver's state as bytes, little-endian, versioned and checksummed; the same image on every machine.
//!
//! Layout: "SHXSNAP\0", format version (u32), length of the body (u64), the body, FNV-1a hash of the body (u64). Static shapes
//! may be kept once beside any number of images (`shapes.rs`); an image then has the hashes of their contents. The body has the
//! options that affect results, the identifiers, every strand, body and constraint, and the warm start of contacts and
//! constraints. Workers, logging and callbacks belong to the host and are left out, and so is the list of the last step's
//! contacts, which affects nothing.
//!
//! Files:
//!
//! - `bodies.rs`: Bodies in a snapshot: shapes (each once, however many bodies share it), poses and motions.
//! - `bytes.rs`: Numbers to bytes and back: little-endian, every length checked against the remaining bytes before allocation.
//! - `constraints.rs`: Constraints in a snapshot: definitions, motions of their targets, last results.
//! - `contact.rs`: Contact in a snapshot, beside bodies: options, contact parameters of strands, and the warm start of the next substep.
//! - `packed_strands.rs`: Strands as images hold them: what a strand shares with the one before it, or says twice itself, is written once.
//! - `shapes.rs`: Static shapes, stored once beside any number of snapshots, each under its content's hash.
//! - `strands.rs`: Parts of strands, and whole ones for hashes.
//! - `targets.rs`: Targets in a snapshot.

mod bodies;
mod bytes;
mod constraints;
mod contact;
mod packed_strands;
mod shapes;
mod strands;
mod targets;

use std::sync::Arc;

use nalgebra::Vector3;

use super::Solver;
use super::bodies::SceneBody;
use super::constraints::Constraint;
use super::definition::{SolverOptions, UsualLimits, check_jump_acceleration};
use super::id::{BodyId, ConstraintId, SlotMap, StrandId};
use super::live_options::RestoredOptions;
use super::stepping::constrained_substep::ConstrainedSubstep;
use super::strands::sections::Sections;
use super::strands::strand::Strand;
use crate::contact::options::ContactOptions;
use crate::contact::shape::Shape;
#[cfg(doc)]
use crate::error::Error;
use crate::error::Result;
use crate::math::lane::Precision;
use crate::math::quadrature::Rules;
use crate::memory;
use crate::step::options::{Integrator, LinearSolver, StepOptions};
use bytes::{FNV_START, Reader, Writer, bad, fnv1a, of_part};

/// Changes whenever an image of an older version can no longer be read.
pub const SNAPSHOT_VERSION: u32 = 11;
const MAGIC: &[u8; 8] = b"SHXSNAP\0";
const HEAD: usize = 8 + 4 + 8;

/// The parts of a solver in an image.
struct Image {
    gravity: Vector3<f64>,
    wind: Vector3<f64>,
    step: StepOptions,
    jump_acceleration: f64,
    limits: UsualLimits,
    contact: ContactOptions,
    slots: SlotMap<StrandId>,
    body_slots: SlotMap<BodyId>,
    constraint_slots: SlotMap<ConstraintId>,
    strands: Vec<Strand>,
    sections: Sections,
    bodies: Vec<SceneBody>,
    constraints: Vec<Constraint>,
    constrained_substep: ConstrainedSubstep,
}

/// How a snapshot stores static shapes: meshes, hulls and grids that never deformed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum SnapshotShapes {
    /// In full: the snapshot is self-contained.
    #[default]
    Included,
    /// By the hashes of their contents. Restoring finds them in the solver, or in an image of [`Solver::snapshot_shapes`].
    Referenced,
}

/// Options of restoring a snapshot.
///
/// ```
/// use superhelix::reading::{Restoring, SnapshotShapes};
/// use superhelix::{Solver, SolverOptions, StrandDef};
///
/// let mut solver = Solver::new(SolverOptions::default())?;
/// solver.add_strands(&[StrandDef::straight(0.2, 5)])?;
/// // Shapes once, and a small image for each frame.
/// let shapes = solver.snapshot_shapes()?;
/// let image = solver.snapshot_with(SnapshotShapes::Referenced)?;
/// let hash = solver.state_hash();
/// solver.step(0.1, 6)?;
/// solver.restore_with(&image, &Restoring { shapes: Some(&shapes), ..Restoring::default() })?;
/// assert_eq!(solver.state_hash(), hash);
/// # Ok::<(), superhelix::Error>(())
/// ```
#[derive(Debug, Clone, Copy, Default)]
pub struct Restoring<'a> {
    /// Which options the solver has afterwards.
    pub options: RestoredOptions,
    /// An image of [`Solver::snapshot_shapes`], for shapes that the snapshot refers to and the solver does not have.
    pub shapes: Option<&'a [u8]>,
}

/// The checked body of an image.
fn unwrap(image: &[u8]) -> Result<&[u8]> {
    if image.len() < HEAD + 8 {
        return Err(bad(format!("{} bytes are too few for an image", image.len())));
    }
    if &image[..8] != MAGIC {
        return Err(bad("it does not begin with SHXSNAP"));
    }
    let version = u32::from_le_bytes(image[8..12].try_into().unwrap_or_default());
    if version != SNAPSHOT_VERSION {
        return Err(bad(format!("it is of version {version}; this library reads version {SNAPSHOT_VERSION}")));
    }
    let length = u64::from_le_bytes(image[12..20].try_into().unwrap_or_default());
    if length != (image.len() - HEAD - 8) as u64 {
        return Err(bad(format!("its header has a body of {length} bytes, and the image has {}", image.len() - HEAD - 8)));
    }
    let (body, checksum) = image[HEAD..].split_at(image.len() - HEAD - 8);
    if u64::from_le_bytes(checksum.try_into().unwrap_or_default()) != fnv1a(FNV_START, body) {
        return Err(bad("its checksum is wrong"));
    }
    Ok(body)
}

impl Writer {
    /// Options that affect results.
    fn options(&mut self, options: &SolverOptions) {
        let SolverOptions { gravity, wind, step, jump_acceleration, .. } = options;
        self.vector(*gravity);
        self.vector(*wind);
        self.u32(step.integrator as u32);
        self.u32(step.linear_solver as u32);
        self.u32(step.max_iterations);
        self.u32(u32::from(step.exact_hessian));
        self.f64(step.tolerance);
        self.f64(step.reference_tolerance);
        self.u32(step.max_subdivisions);
        self.f64(step.error_tolerance);
        self.u32(match step.precision {
            Precision::F64 => 1,
            Precision::F32 => 2,
        });
        self.f64(step.quadrature_tolerance);
        self.f64(*jump_acceleration);
    }

    fn limits(&mut self, limits: &UsualLimits) {
        self.u64(limits.work.unwrap_or(0));
        self.f64(limits.seconds.unwrap_or(0.0));
    }
}

impl Reader<'_> {
    fn limits(&mut self) -> Result<UsualLimits> {
        let (work, seconds) = (self.u64()?, self.f64()?);
        let limits = UsualLimits { work: (work > 0).then_some(work), seconds: (seconds != 0.0).then_some(seconds) };
        limits.check("limits").map_err(|error| of_part("its options", &error))?;
        Ok(limits)
    }
}

fn precision_from(value: u32) -> Result<Precision> {
    match value {
        1 => Ok(Precision::F64),
        2 => Ok(Precision::F32),
        other => Err(bad(format!("its precision is {other}"))),
    }
}

/// Reads an image.
fn read(image: &[u8], rules: &Rules, find: &dyn Fn(u128) -> Result<Arc<Shape>>) -> Result<Image> {
    let mut reader = Reader { left: unwrap(image)? };
    let gravity = reader.vector()?;
    let wind = reader.vector()?;
    let unknown = |what: &str, value: u32| bad(format!("its {what} is {value}"));
    let integrator = reader.u32()?;
    let solver = reader.u32()?;
    let step = StepOptions {
        integrator: Integrator::from_u32(integrator).ok_or_else(|| unknown("integrator", integrator))?,
        linear_solver: LinearSolver::from_u32(solver).ok_or_else(|| unknown("linear solver", solver))?,
        max_iterations: reader.u32()?,
        exact_hessian: reader.flag()?,
        tolerance: reader.f64()?,
        reference_tolerance: reader.f64()?,
        max_subdivisions: reader.u32()?,
        error_tolerance: reader.f64()?,
        precision: precision_from(reader.u32()?)?,
        quadrature_tolerance: reader.f64()?,
    };
    step.check("step").map_err(|error| of_part("its options", &error))?;
    let jump_acceleration = reader.f64()?;
    check_jump_acceleration("jump_acceleration", jump_acceleration).map_err(|error| of_part("its options", &error))?;
    let limits = reader.limits()?;
    let contact = reader.contact_options()?;
    let slots: SlotMap<StrandId> = reader.slots()?;
    let (body_slots, constraint_slots) = (reader.slots()?, reader.slots()?);
    let strand_count = reader.count(8)?;
    let mut strands = Vec::with_capacity(strand_count);
    let mut sections = Sections::default();
    let ids =
        slots.by_index(strand_count).ok_or_else(|| bad(format!("it holds {strand_count} strands and identifiers of others")))?;
    for id in ids {
        let strand = reader.packed_strand(id, strands.last(), rules, &mut sections)?;
        strands.push(strand);
    }
    let bodies = reader.bodies(&body_slots, find)?;
    let constraints = reader.constraints(&constraint_slots, &strands)?;
    let elements = |index: u32| strands.get(index as usize).map(|strand: &Strand| &*strand.model.lengths);
    let constrained_substep = ConstrainedSubstep::taken_up(reader.contacts()?, elements, bodies.len())
        .ok_or_else(|| bad("its warm start does not match its scene"))?;
    check_taken("bodies", &body_slots, bodies.len())?;
    check_taken("constraints", &constraint_slots, constraints.len())?;
    if !reader.left.is_empty() {
        return Err(bad(format!("{} bytes are left over", reader.left.len())));
    }
    Ok(Image {
        gravity,
        wind,
        step,
        jump_acceleration,
        limits,
        contact,
        slots,
        body_slots,
        constraint_slots,
        strands,
        sections,
        bodies,
        constraints,
        constrained_substep,
    })
}

/// Checks that every identifier names something that exists; the reverse has been checked.
fn check_taken<I>(what: &str, slots: &SlotMap<I>, count: usize) -> Result<()> {
    let taken = slots.slots.iter().filter(|slot| slot.index.is_some()).count();
    if taken == count { Ok(()) } else { Err(bad(format!("it holds {count} {what} and identifiers of {taken}"))) }
}

/// Takes over an image's identifiers; those issued since then stay reserved.
fn take_up<I: super::id::Identifier>(slots: &mut SlotMap<I>, image: SlotMap<I>) {
    let later = std::mem::replace(slots, image);
    slots.remember(&later);
}

impl Solver {
    /// The whole state as bytes for [`Solver::restore`]: options that affect results, identifiers, strands, bodies, constraints.
    /// It contains shapes in full: with large meshes or grids it is as large as they are; see [`Solver::snapshot_with`].
    pub fn snapshot(&self) -> Vec<u8> {
        let shapes = SnapshotShapes::Included;
        self.write_image(shapes, Vec::with_capacity(self.snapshot_size(shapes)))
    }

    /// [`Solver::snapshot`], with a choice of how to store shapes.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn snapshot_with(&self, shapes: SnapshotShapes) -> Result<Vec<u8>> {
        Ok(self.write_image(shapes, memory::list(self.snapshot_size(shapes))?))
    }

    /// The size of a snapshot, bytes, without writing it.
    pub fn snapshot_size(&self, shapes: SnapshotShapes) -> usize {
        let mut writer = Writer::counting();
        self.write_body(&mut writer, shapes);
        HEAD + writer.size() + 8
    }

    fn write_image(&self, shapes: SnapshotShapes, room: Vec<u8>) -> Vec<u8> {
        let mut writer = Writer::into(room);
        writer.bytes(MAGIC);
        writer.u32(SNAPSHOT_VERSION);
        writer.u64(0);
        self.write_body(&mut writer, shapes);
        let mut image = writer.finished();
        let length = (image.len() - HEAD) as u64;
        image[HEAD - 8..HEAD].copy_from_slice(&length.to_le_bytes());
        let hash = fnv1a(FNV_START, &image[HEAD..]);
        image.extend_from_slice(&hash.to_le_bytes());
        image
    }

    fn write_body(&self, writer: &mut Writer, shapes: SnapshotShapes) {
        writer.options(&self.options);
        writer.limits(&self.options.limits);
        writer.contact_options(&self.options.contact);
        writer.slots(&self.slots);
        writer.slots(&self.body_slots);
        writer.slots(&self.constraint_slots);
        writer.u64(self.strands.len() as u64);
        for (index, strand) in self.strands.iter().enumerate() {
            writer.packed_strand(strand, index.checked_sub(1).map(|before| &self.strands[before]));
        }
        writer.bodies(&self.bodies, shapes, |writer, body| {
            writer.u64(body.id.bits());
            writer.flag(body.deforms);
            writer.u64(body.user_data);
        });
        writer.constraints(&self.constraints, &self.slots, |writer, constraint| {
            writer.u64(constraint.id.bits());
            writer.u64(constraint.user_data);
        });
        writer.packed_contacts(&self.constrained_substep.memory());
    }

    /// Restores a snapshot of this solver or another: strands, bodies, constraints, identifiers and options become those of the
    /// image; the workers stay. The list of contacts is empty until the next step.
    ///
    /// # Errors
    /// [`Error::Snapshot`] for an image that is truncated, damaged or of another version.
    pub fn restore(&mut self, image: &[u8]) -> Result<()> {
        self.restore_with(image, &Restoring::default())
    }

    /// [`Solver::restore`], with options.
    ///
    /// # Errors
    /// As [`Solver::restore`]; [`Error::Snapshot`] also for a shape that cannot be found.
    pub fn restore_with(&mut self, image: &[u8], restoring: &Restoring) -> Result<()> {
        // Strands in memory take less than twice their bytes in an image, and shapes with their search data four times.
        memory::check_room(image.len().saturating_mul(4))?;
        let find = |content: u128| {
            if let Some(shape) = self.own_shape(content) {
                return Ok(shape);
            }
            let kept = restoring.shapes.map_or(Ok(None), |shapes| shapes::find(shapes, content))?;
            kept.ok_or_else(|| {
                bad(format!("shape {content:032x}, which it refers to, is neither in the solver nor in the shapes given"))
            })
        };
        let image = read(image, &self.rules, &find)?;
        take_up(&mut self.slots, image.slots);
        take_up(&mut self.body_slots, image.body_slots);
        take_up(&mut self.constraint_slots, image.constraint_slots);
        (self.strands, self.sections) = (image.strands, image.sections);
        (self.bodies, self.constraints) = (image.bodies, image.constraints);
        *self.constrained_substep = image.constrained_substep;
        self.forget_contact_events();
        let own = self.options.clone();
        self.options = SolverOptions {
            gravity: image.gravity,
            wind: image.wind,
            step: image.step,
            jump_acceleration: image.jump_acceleration,
            contact: image.contact,
            limits: image.limits,
            ..own.clone()
        };
        match restoring.options {
            RestoredOptions::Snapshot => self.rules.set_tolerance(image.step.quadrature_tolerance),
            RestoredOptions::Own => {
                let of_image = std::mem::replace(&mut self.options, own);
                self.options_changed(&of_image);
            }
        }
        Ok(())
    }

    /// A hash of the state: options that affect results, every strand, body and constraint, but not the identifiers. The same on
    /// every machine and for any number of workers.
    pub fn state_hash(&self) -> u64 {
        let mut writer = Writer::hashing();
        writer.options(&self.options);
        for strand in &self.strands {
            writer.strand(strand);
        }
        // A scene without contact keeps the hash from before contact existed,
        let detection =
            self.options.contact != ContactOptions::default() || self.strands.iter().any(|strand| strand.contact.is_some());
        if detection || !self.bodies.is_empty() || !self.constraints.is_empty() {
            writer.contact_options(&self.options.contact);
            for strand in &self.strands {
                writer.strand_contact(strand.contact.as_deref());
                writer.flag(strand.touched);
            }
            writer.bodies(&self.bodies, SnapshotShapes::Included, |_, _| ());
            writer.constraints(&self.constraints, &self.slots, |_, _| ());
            writer.contacts(&self.constrained_substep.memory());
        }
        // one without permitted overlaps that from before they existed,
        if self.strands.iter().any(|strand| strand.permitted_overlap.is_some()) {
            for strand in &self.strands {
                writer.permitted_overlap(strand.permitted_overlap.as_deref());
            }
        }
        // one without targets likewise,
        for (index, strand) in self.strands.iter().enumerate() {
            if let Some(target) = &strand.target {
                writer.u64(index as u64);
                writer.target(target);
            }
        }
        // and one without limits: golden hashes depend on it.
        if self.options.limits != UsualLimits::default() {
            writer.limits(&self.options.limits);
        }
        writer.hash()
    }
}

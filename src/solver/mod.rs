//! The scene: strands, their roots, the step, and everything a host reads back.
//!
//! Files:
//!
//! - `astray.rs`: Strands that a substep did not bring through: left before an iteration, carried over a jump of their root, or rolled back and brought back.
//! - `attachment.rs`: Strands, bodies and targets of constraints that go along with one pose: a head with all that is on it.
//! - `bodies.rs`: Bodies: what strands are kept out of.
//! - `bringing_out.rs`: Curves drawn inside a body of the scene, brought out of it before strands are made of them.
//! - `bulk_sampling.rs`: Reading many strands at uniform places: packs of them side by side, shared out among the solver's workers.
//! - `clips.rs`: Clips: strands held where they are in a box, and the box moved.
//! - `constraints.rs`: Hard constraints: what pins, clamps, ties and rings strands, and what forces that takes.
//! - `contact_events.rs`: Contacts that begin and end, kept for a host that drains them: between which strand and what, where.
//! - `crossing.rs`: Where strands cross a blade or the surface that a tooth sweeps, and where they are in a box.
//! - `debug_draw.rs`: Debug drawing: what a solver knows, as coloured lines and points in batches.
//! - `deep_places.rs`: Where strands are in bodies and in each other as they are now, whatever a step makes of it.
//! - `definition.rs`: What a host says to make a solver; strands: `StrandDef`.
//! - `editing.rs`: Changing strands from outside: where their roots go, their natural and present shapes, their rest.
//! - `fast_bodies.rs`: Bodies that go far among strands within a substep, and strands that swing far past thin bodies.
//! - `freezing.rs`: Strands that stand still: a style that is fixed.
//! - `heating.rs`: Heat: hair takes on the shape that it has between hot plates or on a hot barrel.
//! - `holding.rs`: The substep of strands that touches or constraints hold: found, tied into islands, and taken together, Newton iteration by Newton iteration.
//! - `id.rs`: Identifiers that can be checked: a slot, the generation of what sits in it, and a mark of the solver that gave it out.
//! - `jumps.rs`: Roots that jump: that go further within a call of `Solver::step` than their strand can follow, as when a head is dragged.
//! - `level_of_detail.rs`: Living strands on more or fewer elements.
//! - `live_options.rs`: Options of a living solver: read, changed, and which of two sets a restored solver has.
//! - `materials.rs`: Materials of living strands: read, changed, made as stiff as a shape needs.
//! - `mirroring.rs`: Images of living strands in a mirror.
//! - `overlaps.rs`: What strands overlap as they are now, and having it allowed.
//! - `population.rs`: Which strands there are: adding, removing, listing.
//! - `posing.rs`: Living strands posed: dragged by a point, brushed, an element changed (`groom/pose.rs`).
//! - `reading.rs`: What a host reads back of its strands.
//! - `render_guides.rs`: A solver's strands as the guides of render hair, and its bodies as what that is kept out of.
//! - `report.rs`: What a step tells afterwards.
//! - `restyling.rs`: Shapes taken as they are at any moment of a run: as natural shapes, as rest shapes under gravity, as shapes to come back to.
//! - `sampling.rs`: Reading a strand's material points at any arclength.
//! - `scissors.rs`: Scissors: strands cut where a blade crosses them.
//! - `sections.rs`: Sections that strands share: a strand made like one of the last few gets theirs.
//! - `side_by_side.rs`: Strands of one task through a step: those of a kind side by side in packs, the rest one by one.
//! - `snapshot.rs`: A solver's state as bytes: little-endian, versioned, checksummed; the same image on every machine.
//! - `stepping.rs`: Time: all strands through a step, and what came of it.
//! - `strand.rs`: One strand inside a solver: constants, state, the root's motion, and how the last step went.
//! - `touch_compliance.rs`: How strands answer to the bodies that touch them.
//! - `touching.rs`: Who touches whom in a substep: bodies and strands found near held strands, as joints.
//! - `trial_steps.rs`: Strands that a body is near step as if it were not, side by side with those that nothing is near.
//! - `trimming.rs`: Living strands cut and grown.
//! - `wind.rs`: Wind as a field: a host's function of place and time, looked up once before every substep.
//! - `workers.rs`: Who runs the strands of a step.

mod astray;
pub mod attachment;
pub mod bodies;
mod bringing_out;
mod bulk_sampling;
pub mod clips;
pub mod constraints;
pub mod contact_events;
mod crossing;
pub mod debug_draw;
mod deep_places;
pub mod definition;
pub(crate) mod editing;
mod fast_bodies;
mod freezing;
pub mod heating;
mod holding;
pub mod id;
mod jumps;
mod level_of_detail;
mod live_options;
mod materials;
mod mirroring;
mod overlaps;
mod population;
mod posing;
mod reading;
mod render_guides;
pub mod report;
mod restyling;
mod sampling;
pub mod scissors;
mod sections;
mod side_by_side;
mod snapshot;
mod stepping;
mod strand;
pub mod touch_compliance;
mod touching;
mod trial_steps;
mod trimming;
mod wind;
mod workers;

use std::sync::atomic::{AtomicU64, Ordering};

use nalgebra::Vector3;

pub use bulk_sampling::{SampleSink, Tile, Wanted};
pub use live_options::RestoredOptions;
pub use materials::Stiffening;
pub use overlaps::Overlap;
pub use render_guides::SolverGuides;
pub use sampling::Sample;
pub use snapshot::{Restoring, SNAPSHOT_VERSION, SnapshotShapes};
pub use stepping::{LONGEST_STEP, SHORTEST_STEP};
pub use wind::{WIND_BATCH, WindField};

use crate::error::{Error, Result, check_finite};
use crate::math::lanes::InstructionSet;
use crate::math::quadrature::Rules;
use crate::platform::Instant;
use bodies::SceneBody;
use constraints::Constraint;
use contact_events::ContactEvents;
use definition::SolverOptions;
use holding::Holding;
use id::{BodyId, ConstraintId, SlotMap, StrandId};
use sections::Sections;
use stepping::BodiesAtWork;
use strand::Strand;
use workers::Crew;

/// Everything the engine knows: strands, gravity, wind, options.
///
/// Reading (`&self`) from several threads at once is fine; changing (`&mut self`) is exclusive. Every fallible call that fails has
/// changed nothing.
pub struct Solver {
    options: SolverOptions,
    rules: Box<Rules>,
    slots: SlotMap,
    strands: Vec<Strand>,
    sections: Sections,
    crew: Crew,
    constraint_slots: SlotMap<ConstraintId>,
    constraints: Vec<Constraint>,
    holding: Box<Holding>,
    body_slots: SlotMap<BodyId>,
    bodies: Vec<SceneBody>,
    bodies_at_work: BodiesAtWork,
    events: Option<Box<ContactEvents>>,
    wind_field: Option<std::sync::Arc<dyn WindField>>,
    /// Nanoseconds that sampling took since the last step.
    sampling: AtomicU64,
}

impl std::fmt::Debug for Solver {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Solver").field("options", &self.options).field("strands", &self.strands.len()).finish_non_exhaustive()
    }
}

impl Solver {
    /// A solver without strands.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] or [`Error::Unsupported`] for an option that cannot be used, or threads that could not be started.
    pub fn new(options: SolverOptions) -> Result<Self> {
        options.check("options")?;
        let crew = Crew::new(&options.workers)?;
        let rules = Box::new(Rules::new(options.step.quadrature_tolerance));
        // Identifiers of two living solvers differ by where the solvers are: no counter is shared between them.
        let address = std::ptr::from_ref::<Rules>(&rules) as u64;
        let mark = (address >> 4).wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 48;
        Ok(Self {
            options,
            rules,
            slots: SlotMap::new(mark as u16),
            strands: Vec::new(),
            sections: Sections::default(),
            crew,
            constraint_slots: SlotMap::new(mark as u16),
            constraints: Vec::new(),
            holding: Box::default(),
            body_slots: SlotMap::new(mark as u16),
            bodies: Vec::new(),
            bodies_at_work: BodiesAtWork::default(),
            events: None,
            wind_field: None,
            sampling: AtomicU64::new(0),
        })
    }

    /// The vector instructions that it uses.
    fn instruction_set(&self) -> InstructionSet {
        self.options.instruction_set.unwrap_or_else(InstructionSet::detected)
    }

    /// Bytes that the solver holds, its strands, bodies and constraints included, as it asked the allocator for them; a shape counts
    /// whole, though others may share it. Not among them: what the allocator itself adds (glibc: 8 to 24 bytes a piece, of which a strand
    /// has seven or eight), and scratch memory: the threads' stacks, that of a step, which grows with the longest strand and not with
    /// their number, and that of strands which touch or are held, which grows with their number.
    pub fn memory_usage(&self) -> u64 {
        let strands: f64 = self.strands.iter().map(Strand::heap_bytes).sum();
        let lists = size_of::<Self>()
            + self.rules.heap_bytes()
            + self.strands.capacity() * size_of::<Strand>()
            + self.slots.heap_bytes()
            + self.body_slots.heap_bytes()
            + self.constraint_slots.heap_bytes()
            + bodies::heap_bytes(&self.bodies)
            + self.bodies.capacity() * size_of::<SceneBody>()
            + self.constraints.capacity() * size_of::<Constraint>()
            + self.events.as_deref().map_or(0, |events| size_of::<ContactEvents>() + events.heap_bytes());
        (lists as f64 + strands + self.sections.heap_bytes()).round() as u64
    }

    /// Does something that counts as sampling.
    fn timed_sampling<R>(&self, sample: impl FnOnce() -> R) -> R {
        let started = Instant::now();
        let result = sample();
        self.sampling.fetch_add(started.elapsed().as_nanos() as u64, Ordering::Relaxed);
        result
    }

    fn index(&self, argument: &str, id: StrandId) -> Result<usize> {
        self.slots.index(id).ok_or_else(|| Error::InvalidId { argument: argument.into(), bits: id.bits() })
    }

    fn strand(&self, argument: &str, id: StrandId) -> Result<&Strand> {
        Ok(&self.strands[self.index(argument, id)?])
    }

    fn indices(&self, ids: &[StrandId]) -> Result<Vec<usize>> {
        let named = |(k, id): (usize, &StrandId)| self.slots.index(*id).ok_or_else(|| stale(k, *id));
        ids.iter().enumerate().map(named).collect()
    }

    fn indices_with(&self, ids: &[StrandId], frames: usize) -> Result<Vec<usize>> {
        if frames != ids.len() {
            return Err(Error::invalid("frames (count)", frames, format!("{} frames, one a strand", ids.len())));
        }
        self.indices(ids)
    }
}

/// What is said of the `k`th of a call's identifiers when it names nothing. Only then: a name for each would cost more than the look-up.
fn stale(k: usize, id: StrandId) -> Error {
    Error::InvalidId { argument: format!("ids[{k}]"), bits: id.bits() }
}

fn check_vector(argument: &str, vector: Vector3<f64>) -> Result<()> {
    for axis in 0..3 {
        check_finite(|| format!("{argument}[{axis}]"), vector[axis])?;
    }
    Ok(())
}

//! The scene: strands, their roots, the step, and everything a host reads back.

mod astray;
pub mod attachment;
pub mod bodies;
mod bringing_out;
mod bulk_sampling;
pub mod clips;
pub mod constraints;
pub mod contact_events;
mod crossing;
mod deep_places;
pub mod definition;
mod editing;
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
mod workers;

use nalgebra::Vector3;

pub use bulk_sampling::{SampleSink, Tile, Wanted};
pub use live_options::RestoredOptions;
pub use materials::Stiffening;
pub use overlaps::Overlap;
pub use render_guides::SolverGuides;
pub use sampling::Sample;
pub use snapshot::{Restoring, SNAPSHOT_VERSION, SnapshotShapes};
pub use stepping::SHORTEST_STEP;

use crate::error::{Error, Result, check_finite};
use crate::math::lanes::InstructionSet;
use crate::math::quadrature::Rules;
use bodies::SceneBody;
use constraints::Constraint;
use contact_events::ContactEvents;
use definition::SolverOptions;
use holding::Holding;
use id::{BodyId, ConstraintId, SlotMap, StrandId};
use sections::Sections;
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
    events: Option<Box<ContactEvents>>,
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
            events: None,
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

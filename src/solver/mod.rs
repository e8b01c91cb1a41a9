//! The scene: strands, their roots, the step, and everything a host reads back.
//!
//! Files:
//!
//! - `at_points.rs`: Contact at points: strands that only bodies may touch step side by side with others, and their contacts are taken down.
//! - `attachment.rs`: Strands, bodies and targets of constraints attached to one pose: a head with everything on it.
//! - `bodies.rs`: Bodies, which strands stay outside of.
//! - `bringing_out.rs`: Brings curves out of a body of the scene before they become strands.
//! - `bulk_sampling.rs`: Samples many strands at uniform arclengths: in packs side by side, on all of the solver's workers.
//! - `clips.rs`: Clips: hold strands where they are in a box, and move with the box.
//! - `constrained_substep.rs`: The substep of constrained strands.
//! - `constraints.rs`: Bilateral constraints: pin, clamp, tie and ring strands, and report the forces.
//! - `contact_compliance.rs`: The response of strands to bodies in contact with them: contacts and near places, and the compliance between them.
//! - `contact_events.rs`: Contact begin and end events, queued until the host drains them.
//! - `crossing.rs`: Where strands cross a blade or the surface swept by a tooth, and which parts of them are in a box.
//! - `debug_draw.rs`: Debug drawing: what a solver knows, as coloured lines and points in batches.
//! - `deep_places.rs`: Overlaps of strands with bodies and with each other in the current scene, independent of any step.
//! - `definition.rs`: The options of a solver; strands: `StrandDef`.
//! - `divergence.rs`: Diverged strands: strands that a substep gave up before an iteration, carried over a jump of their root, or rolled back.
//! - `editing.rs`: Edits strands: motions of roots, natural and current shapes, rest.
//! - `fast_bodies.rs`: Fast bodies: substeps in which a body moves far among strands, or a strand swings far past a thin body, are subdivided for the whole scene.
//! - `freezing.rs`: Frozen strands: a fixed style.
//! - `heating.rs`: Heat: hair takes on its shape between hot plates or on a hot barrel.
//! - `id.rs`: Checked identifiers: a slot, its generation, and a mark of the solver.
//! - `jumps.rs`: Root jumps: roots that move farther within a call of `Solver::step` than their strand can follow.
//! - `level_of_detail.rs`: Changes the number of elements of simulated strands.
//! - `live_options.rs`: Options of a solver: read them, change them, and choose between two sets when restoring.
//! - `materials.rs`: Materials of simulated strands: read, change, and stiffen as a shape requires.
//! - `mirroring.rs`: Adds mirror images of strands.
//! - `overlaps.rs`: Overlaps of strands in the current scene, and permitted overlaps.
//! - `population.rs`: The population of strands: add, remove, list.
//! - `posing.rs`: Poses simulated strands: drag a point, brush, change an element (`groom/pose.rs`).
//! - `reading.rs`: Reads strands back: shapes, status, energies, samples.
//! - `render_guides.rs`: A solver's strands as guides of render hair, and its bodies as obstacles.
//! - `report.rs`: Reports of a step.
//! - `restyling.rs`: Restyling: takes current shapes as natural shapes, as rest shapes under gravity, or as shapes to return to.
//! - `sampling.rs`: Samples a strand's material points at any arclengths.
//! - `scissors.rs`: Scissors: cut strands where a blade crosses them.
//! - `sections.rs`: Sections that strands share: a new strand equal to one of the last few gets the same one.
//! - `side_by_side.rs`: Steps the strands of one task: those with equal pack keys side by side in packs, the rest one by one.
//! - `snapshot.rs`: Snapshots: a solver's state as bytes, little-endian, versioned and checksummed; the same image on every machine.
//! - `stepping.rs`: Steps all strands through time and reports the results.
//! - `strand.rs`: One strand of a solver: constants, state, the root's motion, and the result of the last step.
//! - `targets.rs`: Targets: curves, of a rig for example, to which strands are drawn with a weight along their length.
//! - `ties.rs`: Which strands are tied together: their wisps give way to each other there.
//! - `trial_steps.rs`: Trial steps: a strand near a body first steps as a free strand, side by side with others.
//! - `trimming.rs`: Cuts simulated strands and lets them grow.
//! - `wind.rs`: Wind as a field: a host's function of place and time, looked up once before every substep.
//! - `workers.rs`: The workers of a step and their scratch memory.

mod at_points;
pub mod attachment;
pub mod bodies;
mod bringing_out;
mod bulk_sampling;
pub mod clips;
mod constrained_substep;
pub mod constraints;
pub mod contact_compliance;
pub mod contact_events;
mod crossing;
pub mod debug_draw;
mod deep_places;
pub mod definition;
mod divergence;
pub(crate) mod editing;
mod fast_bodies;
mod freezing;
pub mod heating;
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
mod targets;
mod ties;
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
use constrained_substep::ConstrainedSubstep;
use constraints::Constraint;
use contact_events::ContactEvents;
use definition::SolverOptions;
use id::{BodyId, ConstraintId, SlotMap, StrandId};
use sections::Sections;
use stepping::BodiesAtWork;
use strand::Strand;
use workers::WorkerSet;

/// The scene: strands, bodies, constraints, gravity, wind, options.
///
/// Any number of threads may read (`&self`) at the same time; changes (`&mut self`) are exclusive. A call that fails has changed
/// nothing.
///
/// ```
/// use superhelix::{Solver, SolverOptions, StrandDef};
///
/// let mut solver = Solver::new(SolverOptions::default())?;
/// let ids = solver.add_strands(&[StrandDef::straight(0.2, 5), StrandDef::straight(0.1, 3)])?;
/// let report = solver.step(1.0 / 60.0, 2)?; // two substeps of 1/120 s
/// assert_eq!((report.substeps, report.unconverged), (2, 0));
/// assert!(solver.curvatures(ids[0])?[0][1] != 0.0); // rad/m: it has begun to bend
/// solver.remove_strands(&ids[1..])?;
/// assert_eq!(solver.strand_count(), 1);
/// # Ok::<(), superhelix::Error>(())
/// ```
pub struct Solver {
    options: SolverOptions,
    rules: Box<Rules>,
    slots: SlotMap,
    strands: Vec<Strand>,
    sections: Sections,
    workers: WorkerSet,
    constraint_slots: SlotMap<ConstraintId>,
    constraints: Vec<Constraint>,
    constrained_substep: Box<ConstrainedSubstep>,
    body_slots: SlotMap<BodyId>,
    bodies: Vec<SceneBody>,
    bodies_at_work: BodiesAtWork,
    /// Memory for contacts at points.
    touched: at_points::Touched,
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
        let workers = WorkerSet::new(&options.workers)?;
        let rules = Box::new(Rules::new(options.step.quadrature_tolerance));
        // Identifiers of two solvers differ by the solvers' addresses: they share no counter.
        let address = std::ptr::from_ref::<Rules>(&rules) as u64;
        let mark = (address >> 4).wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 48;
        Ok(Self {
            options,
            rules,
            slots: SlotMap::new(mark as u16),
            strands: Vec::new(),
            sections: Sections::default(),
            workers,
            constraint_slots: SlotMap::new(mark as u16),
            constraints: Vec::new(),
            constrained_substep: Box::default(),
            body_slots: SlotMap::new(mark as u16),
            bodies: Vec::new(),
            bodies_at_work: BodiesAtWork::default(),
            touched: at_points::Touched::default(),
            events: None,
            wind_field: None,
            sampling: AtomicU64::new(0),
        })
    }

    /// The vector instructions in use.
    fn instruction_set(&self) -> InstructionSet {
        self.options.instruction_set.unwrap_or_else(InstructionSet::detected)
    }

    /// Bytes allocated by the solver for strands, bodies and constraints, as requested from the allocator; a shape counts in
    /// full, though others may share it. Not included: the allocator's overhead (glibc: 8 to 24 bytes per block, of which a
    /// strand has seven or eight), and scratch memory: the threads' stacks, that of a step, which grows with the longest strand
    /// and not with their number, and that of strands in contact or with constraints, which grows with their number.
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
            return Err(Error::invalid("frames (count)", frames, format!("{} frames, one per strand", ids.len())));
        }
        self.indices(ids)
    }
}

/// The error for the `k`th identifier of a call. Made only on failure: a name for each would cost more than the look-up.
fn stale(k: usize, id: StrandId) -> Error {
    Error::InvalidId { argument: format!("ids[{k}]"), bits: id.bits() }
}

fn check_vector(argument: &str, vector: Vector3<f64>) -> Result<()> {
    for axis in 0..3 {
        check_finite(|| format!("{argument}[{axis}]"), vector[axis])?;
    }
    Ok(())
}

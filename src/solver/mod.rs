//! The scene: strands, their roots, the step, and everything a host reads back.
//!
//! Files:
//!
//! - `attachment.rs`: Strands, bodies and targets of constraints attached to one pose: a head with everything on it.
//! - `bodies.rs`: Bodies, which strands stay outside of.
//! - `constraints.rs`: Bilateral constraints: pin, clamp, tie and ring strands, and report the forces.
//! - `contact_compliance.rs`: The response of strands to bodies in contact with them: contacts and near places, and the compliance between them.
//! - `definition.rs`: The options of a solver; strands: `StrandDef`.
//! - `id.rs`: Checked identifiers: a slot, its generation, and a mark of the solver.
//! - `live_options.rs`: Options of a solver: read them, change them, and choose between two sets when restoring.
//! - `reading.rs`: Reads strands back: shapes, status, energies, samples.
//! - `report.rs`: Reports of a step.
//! - `snapshot.rs`: Snapshots: a solver's state as bytes, little-endian, versioned and checksummed; the same image on every machine.
//! - `stepping.rs`: Steps all strands through time and reports the results.
//! - `shaping/`: Shaping strands by hand: posing, cutting, heat, clips, frozen styles.
//! - `strands/`: The strands of a scene: their definitions, materials and elements, the motion of their roots, and what draws them.

pub mod attachment;
pub mod bodies;
pub mod constraints;
pub mod contact_compliance;
pub mod definition;
pub mod id;
mod live_options;
pub mod reading;
pub mod report;
pub mod shaping;
mod snapshot;
mod stepping;
mod strands;

use std::sync::atomic::{AtomicU64, Ordering};

use nalgebra::Vector3;

pub use bodies::overlaps::Overlap;
pub use live_options::RestoredOptions;
pub use reading::bulk_sampling::{SampleSink, Tile, Wanted};
pub use reading::render_guides::SolverGuides;
pub use reading::sampling::Sample;
pub use snapshot::{Restoring, SNAPSHOT_VERSION, SnapshotShapes};
pub use stepping::wind::{WIND_BATCH, WindField};
pub use stepping::{LONGEST_STEP, SHORTEST_STEP};
pub use strands::materials::Stiffening;

use crate::error::{Error, Result, check_finite};
use crate::math::lanes::InstructionSet;
use crate::math::quadrature::Rules;
use crate::platform::Instant;
use bodies::SceneBody;
use constraints::Constraint;
use definition::SolverOptions;
use id::{BodyId, ConstraintId, SlotMap, StrandId};
use reading::contact_events::ContactEvents;
use stepping::BodiesAtWork;
use stepping::at_points;
use stepping::constrained_substep::ConstrainedSubstep;
use stepping::workers::WorkerSet;
use strands::sections::Sections;
use strands::strand::Strand;

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

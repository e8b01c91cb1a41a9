//! What a host reads back: points of strands in bulk, contact events, debug drawing, snapshots, compliance of strands at bodies.
//!
//! [`Solver::sample_at`](crate::Solver::sample_at) is the simple way to points of one strand.

pub use crate::contact::constraint::law::coefficient::Coefficient as FrictionCoefficient;
pub use crate::rod::uniform_points::{Lanes, Real, WIDTH};
pub use crate::solver::contact_compliance::{BodyContact, ContactCompliance};
pub use crate::solver::reading::contact_events::{Change, ContactEvent, MAX_EVENTS};
pub use crate::solver::reading::debug_draw::{DEBUG_BATCH, DebugCanvas, DebugDraw, DebugLayer, DebugVertex};
pub use crate::solver::{
    LONGEST_STEP, RestoredOptions, Restoring, SHORTEST_STEP, SNAPSHOT_VERSION, SampleSink, SnapshotShapes, SolverGuides, Tile,
    Wanted,
};

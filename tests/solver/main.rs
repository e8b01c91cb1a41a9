//! The solver as a host meets it: identifiers, snapshots, workers, sampling, level of detail, the same bits however strands are packed.

mod attachments;
mod bulk_sampling;
mod contact_events;
mod debug_draw;
mod identifiers_snapshots_workers;
mod lanes;
mod level_of_detail;
mod live_options;
mod snapshot_shapes;
mod targets;
mod wind;

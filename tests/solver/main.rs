//! The solver as a host meets it: identifiers, snapshots, workers, sampling, level of detail, the same bits however strands are packed.

mod bulk_sampling;
mod identifiers_snapshots_workers;
mod lanes;
mod level_of_detail;

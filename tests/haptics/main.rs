//! Force feedback: what the hand feels, from which model, how fast, how safely.

mod bad_input;
mod direct_and_handed_over;
mod heavy_hair;
mod limits;
mod no_allocation;
mod passivity;
mod scene;
mod triple_buffer;

//! Force feedback: what the hand feels, from which model, how fast, how safely.

mod agreement;
mod bad_input;
mod direct_and_handed_over;
mod explicit_law;
mod grab;
mod hair_types;
mod heavy_hair;
mod limits;
mod no_allocation;
mod passivity;
mod ring_combs;
mod scene;
mod triple_buffer;
mod typed_hair;

//! Styling: hair handle, tools, clips, scissors, heat, combs that hold strands, frozen styles.

mod clips_and_scissors;
mod combing_a_wisp;
mod freezing;
mod hair_handle;
mod heat;
mod ring_combs;
mod scene;
mod tool_bodies;
mod two_freedoms;

//! The command line: every subcommand, good and bad scene files.
#![cfg(feature = "cli")]

mod bench;
mod contact;
mod convert;
mod drawing;
mod fit;
mod fit_friction;
mod info_and_picture;
mod interpolate;
#[path = "../numpy/mod.rs"]
mod numpy;
mod posing;
mod prepare;
mod run;
mod run_in_parts;
mod scene_errors;
mod scene_follicles;
mod scene_grooms;
mod scene_groups;
mod scene_maps;
mod scene_render_hair;
mod scene_targets;
mod settings;
mod simulate;
mod support;
mod wisps;

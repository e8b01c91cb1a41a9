//! The C ABI: every rule of it, from Rust and from C programs.

mod bad_input;
mod c_programs;
mod fit_curves;
mod groom_files;
mod guard;
mod header;
mod layout;
mod motion;
mod older_programs;
mod render_hair;
mod sampling;
mod settings;

//! What every command needs: flags, failures, answers, progress, files that appear whole.
//!
//! Files:
//!
//! - `answer.rs`: What a command prints: lines, and answers as JSON or in words.
//! - `argument_values.rs`: Values of flags, read for clap.
//! - `atomic_file.rs`: Files that appear whole or not at all.
//! - `failure.rs`: How a command can fail, and the exit status that says so.
//! - `frame_files.rs`: Frames in numbered files: which files of a directory they are, and in which order.
//! - `json.rs`: JSON as people write it: comments allowed, and every complaint names the key by its full path, with the value that stands there.
//! - `progress.rs`: Progress of long work on standard error: a bar on a terminal, a line now and then where there is none.
//! - `up.rs`: `--up`: the axis of the world that points up.

pub mod answer;
pub mod argument_values;
pub mod atomic_file;
pub mod failure;
pub mod frame_files;
pub mod json;
pub mod progress;
pub mod up;

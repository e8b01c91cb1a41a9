//! The command line: scenes, grooms with head motion, and pictures of what came out.

mod argument_values;
mod atomic_file;
mod bake;
mod baked_body;
mod bench;
mod cache;
mod convert;
mod failure;
mod film;
mod fit;
mod fit_friction;
mod fit_scene;
mod groom_statistics;
mod groom_strands;
mod guide_frames;
mod head;
mod info;
mod interpolate;
mod json;
mod lock;
mod material_arguments;
mod moving_scalp;
mod picture;
mod place;
mod pose;
mod progress;
mod region;
mod render_frames;
mod render_output;
mod render_roots;
mod render_run;
mod report;
mod resolution;
mod rest_arguments;
mod result;
mod run;
mod run_cache;
mod run_files;
mod run_render;
mod run_snapshot;
mod sampled_frame;
mod scene;
mod settings;
mod settled;
mod simulate;
mod simulate_body;
mod simulate_report;
mod style;
mod suggested;
mod surface;
mod timeline;
mod unit;
mod wisp_arguments;

use std::io::Write;
use std::process::ExitCode;

use clap::{Parser, Subcommand};

/// Simulates hair as Super-Helices.
#[derive(Debug, Parser)]
#[command(version, about, propagate_version = true)]
struct CommandLine {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    Run(run::RunArguments),
    Simulate(Box<simulate::SimulateArguments>),
    Info(info::InfoArguments),
    Convert(convert::ConvertArguments),
    Lock(Box<lock::LockArguments>),
    Bake(bake::BakeArguments),
    Pose(pose::PoseArguments),
    Picture(picture::PictureArguments),
    Settings(settings::SettingsArguments),
    Fit(Box<fit::FitArguments>),
    FitFriction(Box<fit_friction::FitFrictionArguments>),
    Interpolate(Box<interpolate::InterpolateArguments>),
    Place(place::PlaceArguments),
    Bench(bench::BenchArguments),
}

/// Prints a command's answer. A reader that has gone away is no failure of ours.
fn print_line(text: &str) -> Result<(), failure::Failure> {
    match writeln!(std::io::stdout(), "{text}") {
        Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => {
            Err(failure::Failure::Other(format!("standard output cannot be written: {error}")))
        }
        _ => Ok(()),
    }
}

/// Prints a command's answer as JSON, or in words.
fn print_answer(json: bool, answer: &impl serde::Serialize, in_words: impl FnOnce() -> String) -> Result<(), failure::Failure> {
    if !json {
        return print_line(&in_words());
    }
    let text = serde_json::to_string_pretty(answer).map_err(|error| failure::Failure::Other(error.to_string()))?;
    print_line(&text)
}

fn main() -> ExitCode {
    let command_line = match CommandLine::try_parse() {
        Ok(command_line) => command_line,
        Err(error) => {
            // Help and version are what was asked for; status 2 is kept for bad scenes.
            let code = if error.use_stderr() { ExitCode::from(1) } else { ExitCode::SUCCESS };
            let _ = error.print();
            return code;
        }
    };
    let outcome = match &command_line.command {
        Command::Run(arguments) => run::run(arguments),
        Command::Simulate(arguments) => simulate::run(arguments),
        Command::Info(arguments) => info::run(arguments),
        Command::Convert(arguments) => convert::run(arguments),
        Command::Lock(arguments) => lock::run(arguments),
        Command::Bake(arguments) => bake::run(arguments),
        Command::Pose(arguments) => pose::run(arguments),
        Command::Picture(arguments) => picture::run(arguments),
        Command::Settings(arguments) => settings::run(arguments),
        Command::Fit(arguments) => fit::run(arguments),
        Command::FitFriction(arguments) => fit_friction::run(arguments),
        Command::Interpolate(arguments) => interpolate::run(arguments),
        Command::Place(arguments) => place::run(arguments),
        Command::Bench(arguments) => bench::run(arguments),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("error: {failure}");
            failure.exit_code()
        }
    }
}

//! The command line: scenes, grooms with head motion, and pictures of what came out.
//!
//! Files:
//!
//! - `commands/`: Commands of a file or two each.
//! - `groom/`: A groom on the command line: its unit, statistics, material, and the strands made of it.
//! - `picture/`: `superhelix picture`: contact sheets and animations of simulated frames.
//! - `prepare/`: `superhelix prepare`: strands of a reconstruction in, a scene that can be simulated out.
//! - `render/`: Render strands: from guides over time to files.
//! - `run/`: `superhelix run`: a scene file in, a result file out.
//! - `scene/`: A scene file: read, checked, and turned into what the solver is made from.
//! - `shell/`: What every command needs: flags, failures, answers, progress, files that appear whole.
//! - `simulate/`: `superhelix simulate`: a groom on a moving head, to a cache and a picture.
//! - `stepping/`: What commands that simulate share: how steps went, strands at rest, strands sampled.
//! - `surfaces/`: Meshes on the command line: surfaces to draw, scalps, bodies baked into grids.

mod commands;
mod groom;
mod picture;
mod prepare;
mod render;
mod run;
mod scene;
mod shell;
mod simulate;
mod stepping;
mod surfaces;

use std::process::ExitCode;

use clap::{Parser, Subcommand};

use commands::{bake, bench, convert, fit, fit_friction, info, interpolate, lock, place, pose, settings};

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
    Simulate(Box<simulate::arguments::SimulateArguments>),
    Prepare(Box<prepare::arguments::PrepareArguments>),
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
        Command::Prepare(arguments) => prepare::run(arguments),
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

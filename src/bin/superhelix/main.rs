//! The command line: scenes, grooms with head motion, and pictures of what came out.
//!
//! Files:
//!
//! - `argument_values.rs`: Values of flags, read for clap.
//! - `atomic_file.rs`: Files that appear whole or not at all.
//! - `bake.rs`: `superhelix bake`: a mesh into a signed distance grid.
//! - `baked_body.rs`: A mesh that hair is kept out of, baked into a grid of distances, which is kept beside the mesh for the next time.
//! - `bench.rs`: `superhelix bench`: what the engine costs on this machine, on one card.
//! - `cache.rs`: The cache of `superhelix simulate`: a file a frame, or one file with velocities.
//! - `convert.rs`: `superhelix convert`: a groom, or a cache of frames, in another format.
//! - `failure.rs`: How a command can fail, and the exit status that says so.
//! - `film.rs`: The frames of `superhelix simulate` on their way out: to the cache, and some of them to the picture.
//! - `fit.rs`: `superhelix fit`: strands for the curves of a groom, and how close they come.
//! - `fit_friction.rs`: `superhelix fit-friction`: friction coefficients from a recorded curve.
//! - `fit_scene.rs`: Strands as a scene file.
//! - `groom_statistics.rs`: Numbers about a groom: lengths, turning, what is degenerate, and what its unit may be.
//! - `groom_strands.rs`: A groom's curves made into strands: what the flags ask for, and the strands that are left out.
//! - `guide_frames.rs`: Guides over time: a groom, a directory of frames, or a `.usda` file with time samples.
//! - `head.rs`: A head that carries roots: a motion laid onto a groom.
//! - `info.rs`: `superhelix info`: what a groom file holds.
//! - `interpolate.rs`: `superhelix interpolate`: render strands from the guides of a groom or of a cache.
//! - `json.rs`: JSON as people write it: comments allowed, and every complaint names the key by its full path, with the value that stands there.
//! - `lock.rs`: `superhelix lock`: a lock of hair of a kind, as a scene.
//! - `material_arguments.rs`: The material on the command line: a kind of hair, flags that change single values of it, and sliders.
//! - `moving_scalp.rs`: A scalp that deforms, and the roots that stand on it.
//! - `place.rs`: `superhelix place`: follicles scattered over a mesh, or put where texture coordinates say.
//! - `pose.rs`: `superhelix pose`: a scene whose strands are posed, as a scene.
//! - `progress.rs`: Progress of long work on standard error: a bar on a terminal, a line now and then where there is none.
//! - `region.rs`: Where on a mesh follicles stand: meshes as scalps, maps of density, nearness to a groom's roots.
//! - `render_frames.rs`: Render strands from moments of guides, as curves of files, with velocities where it is known how the guides move.
//! - `render_output.rs`: Where render strands go: one groom, a directory of frames, or a cache in one file.
//! - `render_roots.rs`: Where render strands grow: given places, among the guides' roots, or scattered over a scalp, which may deform.
//! - `render_run.rs`: Render strands of one run: bound to the guides at rest, made from every moment of theirs that is handed over, and written.
//! - `report.rs`: How the steps of a run went, all together.
//! - `resolution.rs`: Says when helical elements are too long for the curl that they carry.
//! - `rest_arguments.rs`: Shapes taken as natural or rest shapes, on the command line.
//! - `result.rs`: What a run of a scene gives: the document of docs/reference/scene_format.md, section "Result".
//! - `run.rs`: `superhelix run`: a scene file in, a result file out.
//! - `run_cache.rs`: The strands of `superhelix run` over time in one `.usda` file, with velocities: to be drawn, or as guides for `superhelix interpolate`.
//! - `run_files.rs`: What `superhelix run` writes of a scene's strands beside its result: their cache, and render hair.
//! - `run_render.rs`: The render hair of `superhelix run`: what `superhelix interpolate` would make of the run's cache, to the bit, without the cache.
//! - `run_snapshot.rs`: Where a run of a scene was left, so that another can go on from there.
//! - `sampled_frame.rs`: Strands as a solver has them, sampled for files and pictures.
//! - `settings.rs`: `superhelix settings`: what to set for a preset or for an error that may be made.
//! - `settled.rs`: `--settle`: strands that start at rest in their static equilibrium under gravity.
//! - `simulate.rs`: `superhelix simulate`: a groom on a moving head, to a cache and a picture.
//! - `simulate_body.rs`: `superhelix simulate`: what the hair touches.
//! - `simulate_report.rs`: What `superhelix simulate` tells afterwards.
//! - `style.rs`: How a groom's style held: where strands are beside where they were drawn, in the frame of the head that carries them.
//! - `suggested.rs`: `superhelix info --suggest`: how many elements the strands of a groom need for their shape.
//! - `surface.rs`: Surfaces of bodies as triangles, for pictures.
//! - `timeline.rs`: When states are written and which steps lead there.
//! - `unit.rs`: Metres a unit of a groom: what a flag says, else what the file says; and strands in metres.
//! - `wisp_arguments.rs`: What a guide of a groom stands for, on the command line.
//! - `picture/`: `superhelix picture`: contact sheets and animations of simulated frames.
//! - `scene/`: A scene file: read, checked, and turned into what the solver is made from.

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

//! The command line: scenes, grooms with head motion, and pictures of what came out.

mod atomic_file;
mod failure;
mod json;
mod progress;
mod resolution;
mod result;
mod run;
mod scene;
mod timeline;

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
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("error: {failure}");
            failure.exit_code()
        }
    }
}

//! The command line of pinhole.

use pinhole::command;
use std::process::ExitCode;

#[path = "../chapters/mod.rs"]
mod chapters;

fn main() -> ExitCode {
    command::stop_on_interrupt();
    ExitCode::from(command::run_program(&chapters::all()))
}

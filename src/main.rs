//! The command line of pinhole.

use pinhole_cli::command;
use std::process::ExitCode;

fn main() -> ExitCode {
    command::stop_on_interrupt();
    ExitCode::from(command::run_program(&chapters::all()))
}

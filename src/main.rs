//! The command line of pinhole.

use pinhole::command;
use std::process::ExitCode;

#[path = "../chapters/mod.rs"]
mod chapters;

fn main() -> ExitCode {
    command::stop_on_interrupt();
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    command::conclude(command::run(&chapters::all(), &arguments, &mut std::io::stdout().lock()))
}

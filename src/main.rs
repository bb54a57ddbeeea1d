//! The command line of pinhole.

// What readers write is compiled here, last of all, so that an edit of theirs compiles nothing else.
/// What chapters ask their readers to write: a function in a chapter's `exercise.rs`, and the question beside it.
#[allow(dead_code, reason = "tests ask more of a question than the program does")]
mod exercises {
    include!(concat!(env!("OUT_DIR"), "/exercises.rs"));
}

use pinhole_cli::command;
use std::process::ExitCode;

fn main() -> ExitCode {
    command::stop_on_interrupt();
    ExitCode::from(command::run_program(&chapters::all(), exercises::all))
}

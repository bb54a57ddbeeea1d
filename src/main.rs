//! The command line of pinhole.

// What readers write is compiled here, last of all and alone, so that the answer to an edit of theirs is there at once.
/// What readers write: the function in each chapter's `exercise.rs`.
#[allow(clippy::disallowed_methods, reason = "a reader may call any function")]
#[allow(unused, reason = "every file is compiled for every `check`, which is about one of them")]
mod exercises {
    include!(concat!(env!("OUT_DIR"), "/exercises.rs"));
}

use pinhole_cli::command;
use std::process::ExitCode;

fn main() -> ExitCode {
    command::stop_on_interrupt();
    ExitCode::from(command::run_program(&chapters::all(), exercises::all))
}

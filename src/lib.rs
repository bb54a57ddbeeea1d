//! The program of the ray tracing book you can run: its command line, what each chapter asks its reader to write, and
//! the figures that each draws.

pub mod command;

/// What chapters ask their readers to write: a function in a chapter's `exercise.rs`, and the question beside it.
pub mod exercises {
    include!(concat!(env!("OUT_DIR"), "/exercises.rs"));
}

/// What chapters draw of their scenes: each one's `figures.rs`.
pub mod figures {
    include!(concat!(env!("OUT_DIR"), "/figures.rs"));
}

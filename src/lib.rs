//! The program of the ray tracing book you can run: its command line, and what each chapter draws and asks.

pub mod command;

/// What chapters draw of their scenes: each one's `figures.rs`.
pub mod figures {
    include!(concat!(env!("OUT_DIR"), "/figures.rs"));
}

/// What chapters ask of their readers: each one's `question.rs`, and the `mine.rs` that puts the answer into its picture.
#[allow(clippy::disallowed_methods, reason = "a reader's function is compared within a tolerance")]
pub mod questions {
    include!(concat!(env!("OUT_DIR"), "/questions.rs"));
}

//! The program of the ray tracing book you can run: its command line, and what each chapter draws and asks.

pub mod command;

/// What chapters draw of their scenes: each one's `figures.rs`.
pub mod figures {
    include!(concat!(env!("OUT_DIR"), "/figures.rs"));
}

/// What chapters ask of their readers, what is said of the answers, and how these stand in pictures: each one's `check.rs`.
#[allow(clippy::disallowed_methods, reason = "a reader's function is compared within a tolerance")]
pub mod checks {
    include!(concat!(env!("OUT_DIR"), "/checks.rs"));
}

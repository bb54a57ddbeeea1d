//! The program of the ray tracing book you can run: its command line, and the figures that each chapter draws.

pub mod command;

/// What chapters draw of their scenes: each one's `figures.rs`.
pub mod figures {
    include!(concat!(env!("OUT_DIR"), "/figures.rs"));
}

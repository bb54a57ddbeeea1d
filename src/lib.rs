//! The program of the ray tracing book you can run: its command line, and what each chapter asks its reader to write.

pub mod command;

#[path = "../chapters/exercises.rs"]
pub mod exercises;

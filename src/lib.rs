//! A ray tracing book you can run.
pub mod command;

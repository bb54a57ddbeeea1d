//! A ray tracing book you can run.
pub mod command;
pub mod measure;
pub mod naive;

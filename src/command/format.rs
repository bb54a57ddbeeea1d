use crate::Result;
use clap::ValueEnum;
use serde::Serialize;
use std::io::Write;

/// How a command prints what it found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// Sentences and tables for a person
    #[default]
    Text,
    /// One JSON value for a program, and nothing else
    Json,
}

/// Prints one JSON value, indented, with a newline at its end.
pub fn print_json(value: &impl Serialize, out: &mut dyn Write) -> Result {
    let text = serde_json::to_string_pretty(value).map_err(std::io::Error::from)?;
    writeln!(out, "{text}")?;
    Ok(())
}

use super::arguments::Arguments;
use super::error::Result;
use clap::CommandFactory;
use clap_complete::{Shell, generate};
use std::io::Write;

/// A script that lets a shell complete the program's words.
pub fn print_completions(shell: Shell, out: &mut dyn Write) -> Result {
    let mut script = Vec::new();
    generate(shell, &mut Arguments::command(), "pinhole", &mut script);
    out.write_all(&script)?;
    Ok(())
}

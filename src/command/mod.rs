//! The command line.
use std::io::Write;
/// One chapter (stub).
pub struct Chapter;
/// What a command answers.
pub type Result<T = ()> = std::result::Result<T, std::io::Error>;
/// Runs one command line, without the program's name, and writes what a reader would see to `out` (stub).
pub fn run(_chapters: &[Chapter], arguments: &[String], out: &mut dyn Write) -> Result {
    writeln!(out, "(the kit will answer `{}` here)", arguments.join(" "))
}

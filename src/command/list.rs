use crate::Result;
use crate::chapter::Chapter;
use std::io::Write;

/// The chapters, a line each.
pub fn list(chapters: &[Chapter], out: &mut dyn Write) -> Result {
    for chapter in chapters {
        writeln!(out, "{:<18} {}", chapter.name, chapter.title)?;
    }
    Ok(())
}

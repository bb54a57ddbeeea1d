use crate::Result;
use crate::chapter::Chapter;
use std::io::Write;

/// The chapters, a line each.
pub fn list(chapters: &[Chapter], out: &mut dyn Write) -> Result {
    let longest = chapters.iter().map(|chapter| chapter.name.len()).max().unwrap_or(0);
    for chapter in chapters {
        writeln!(out, "{:<longest$}  {}", chapter.name, chapter.title)?;
    }
    Ok(())
}

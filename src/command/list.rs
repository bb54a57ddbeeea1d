use super::error::Result;
use super::format::{Format, print_json};
use pinhole::Chapter;
use serde_json::{Value, json};
use std::io::Write;

/// The chapters, a line each.
pub fn list(chapters: &[Chapter], format: Format, out: &mut dyn Write) -> Result {
    if format.is_json() {
        let told = |chapter: &Chapter| json!({ "name": chapter.name, "title": chapter.title });
        return print_json(&json!({ "chapters": chapters.iter().map(told).collect::<Vec<Value>>() }), out);
    }
    let longest = chapters.iter().map(|chapter| chapter.name.len()).max().unwrap_or(0);
    for chapter in chapters {
        writeln!(out, "{:<longest$}  {}", chapter.name, chapter.title)?;
    }
    Ok(())
}

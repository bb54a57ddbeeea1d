use super::arguments::DrawFigure;
use crate::Result;
use crate::chapter::Chapter;
use crate::figure::{draw, figures};
use crate::film::write_whole;
use std::io::Write;
use std::path::Path;

/// Draws a figure, or lists those there are.
pub fn draw_figure(chapters: &[Chapter], asked: &DrawFigure, out: &mut dyn Write) -> Result {
    let Some(name) = &asked.name else {
        for figure in figures() {
            writeln!(out, "{:<18} {}", figure.name, figure.about)?;
        }
        return Ok(());
    };
    let drawing = draw(chapters, name)?;
    let file = asked.output.clone().unwrap_or_else(|| Path::new("out").join(format!("{name}.svg")));
    write_whole(&file, |file| file.write_all(drawing.text.as_bytes()))?;
    writeln!(out, "wrote {}", file.display())?;
    Ok(())
}

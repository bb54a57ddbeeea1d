use super::arguments::DrawFigure;
use super::error::{Error, Result};
use super::format::{Format, print_json, print_written};
use super::own_file::write_file;
use crate::figures;
use pinhole::Chapter;
use pinhole::scene::printable_path;
use pinhole_lab::figure::{Figure, draw};
use serde_json::{Value, json};
use std::io::Write;
use std::path::{Path, PathBuf};

/// Draws a figure, or lists those there are.
pub fn draw_figure(chapters: &[Chapter], asked: &DrawFigure, format: Format, out: &mut dyn Write) -> Result {
    let Some(name) = &asked.name else {
        if format.is_json() {
            let told =
                |Figure { name, chapter, about, .. }| json!({ "name": name, "chapter": chapter, "about": about });
            return print_json(
                &json!({ "figures": figures::all().into_iter().map(told).collect::<Vec<Value>>() }),
                out,
            );
        }
        for figure in figures::all() {
            writeln!(out, "{:<18} {}", figure.name, figure.about)?;
        }
        return Ok(());
    };
    let file = svg_place(asked.output.as_ref(), name)?;
    let drawing = draw(&figures::all(), chapters, name)?;
    write_file(asked.output.is_some(), &file, drawing.text.as_bytes())?;
    print_written(&file, format, out)
}

/// Where a drawing goes: where it was asked for, or to out/ under its name.
///
/// Errors: a name that does not end in .svg.
pub fn svg_place(asked: Option<&PathBuf>, name: &str) -> Result<PathBuf> {
    let file = asked.cloned().unwrap_or_else(|| Path::new("out").join(format!("{name}.svg")));
    match file.extension() {
        Some(ending) if ending.eq_ignore_ascii_case("svg") => Ok(file),
        _ => {
            Err(Error::usage(format!("cannot write a drawing to {}: its name must end in .svg", printable_path(&file))))
        }
    }
}

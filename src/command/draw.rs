use super::arguments::DrawImage;
use super::error::{Error, Result};
use super::format::{Format, print_json, print_written};
use super::own_file::write_file;
use pinhole_lab::figure::{DRAWN_IMAGES, DrawnImage};
use serde_json::json;
use std::io::Write;
use std::path::Path;

/// Draws an image that a chapter reads from a file, or lists those there are.
pub fn draw_image(asked: &DrawImage, format: Format, out: &mut dyn Write) -> Result {
    let Some(name) = &asked.name else {
        if format.is_json() {
            let told =
                |DrawnImage { file, about, folder, .. }| json!({ "name": file, "about": about, "folder": folder });
            return print_json(&json!({ "images": DRAWN_IMAGES.map(told) }), out);
        }
        for image in &DRAWN_IMAGES {
            writeln!(out, "{:<18} {}; kept in {}", image.file, image.about, image.folder)?;
        }
        return Ok(());
    };
    let Some(image) = DRAWN_IMAGES.iter().find(|image| image.file == name) else {
        let names: Vec<&str> = DRAWN_IMAGES.iter().map(|image| image.file).collect();
        return Err(Error::usage(format!("there is no image \"{name}\" to be drawn; there are {}", names.join(", "))));
    };
    let file = asked.output.clone().unwrap_or_else(|| Path::new("out").join(image.file));
    let bytes = image.bytes()?;
    write_file(asked.output.is_some(), &file, &bytes)?;
    print_written(&file, format, out)
}

use super::arguments::CompareYours;
use super::error::{Error, Result};
use super::format::{Format, print_json, print_written};
use super::own_file::{check_file, write_file};
use super::streams::Streams;
use pinhole::film::{Curve, png_bytes};
use pinhole::scene::{FileKind, printable_path, read_file};
use pinhole_lab::yours::{Comparison, Expected, Picture, film_after, picture_in, program_after, steps};
use serde_json::{Value, json};
use std::io::Write;
use std::path::Path;

/// What is read of a reader's picture.
const PICTURE: FileKind = FileKind { name: "a picture", max: 16 << 20 };

/// Lists the steps of the reader's program; prints it after one; draws pinhole's picture of its scene; or compares the
/// picture that the reader's program wrote with that.
///
/// Errors: a chapter without a step; a picture that is no text in the format PPM, or of another size.
pub fn yours(asked: &CompareYours, format: Format, streams: &mut Streams<'_>) -> Result {
    let (out, notes) = (&mut *streams.out, &mut *streams.notes);
    let Some(chapter) = &asked.chapter else { return list(format, out) };
    let all = steps();
    let found = all.iter().find(|step| step.chapter == chapter || Ok(step.number) == chapter.parse());
    let Some(step) = found else {
        let numbers: Vec<String> = all.iter().map(|step| step.number.to_string()).collect();
        let told = format!("chapter {chapter} adds nothing to your program; {} do", numbers.join(", "));
        return Err(Error::usage(told));
    };
    if asked.program {
        let program = program_after(step.number).map_err(Error::usage)?;
        return if format.is_json() {
            print_json(&json!({ "program": program }), out)
        } else {
            Ok(out.write_all(program.as_bytes())?)
        };
    }
    let Some(picture) = &asked.picture else {
        let named = asked.output.is_some();
        let file = asked.output.clone().unwrap_or_else(|| format!("out/yours_{:02}.png", step.number).into());
        check_file(named, &file)?;
        write_file(named, &file, &png_bytes(&film_after(step.number, SHOWN)?, Curve::Srgb)?)?;
        return print_written(&file, format, out);
    };
    let picture = read_ppm(picture)?;
    let mut waits =
        || _ = writeln!(notes, "note: it differs; known mistakes are tried in the program, for a minute or two");
    tell(&Expected::after(step.number)?.compare(&picture, &mut waits)?, format, out)
}

/// Samples a pixel of a picture to look at, which is then about as noisy as the program's own.
const SHOWN: u32 = 16;

fn list(format: Format, out: &mut dyn Write) -> Result {
    let mut all: Vec<Value> = Vec::new();
    for step in steps() {
        let lines = program_after(step.number).map_err(Error::usage)?.lines().count();
        if format.is_json() {
            all.push(json!({ "chapter": step.chapter, "lines": lines }));
        } else {
            writeln!(out, "{:<22} {lines} lines", step.chapter)?;
        }
    }
    if format.is_json() { print_json(&json!({ "steps": all }), out) } else { Ok(()) }
}

fn tell(found: &Comparison, format: Format, out: &mut dyn Write) -> Result {
    if format.is_json() {
        let told = match found {
            Comparison::Same { resolved } => json!({ "same": true, "resolved": resolved }),
            Comparison::Shifted { by } => json!({ "same": false, "shifted": by }),
            Comparison::Differs { blocks, of, brightness, most, looks_like } => json!({
                "same": false, "blocks": blocks, "of": of, "brightness": brightness, "most": most, "looks_like": looks_like,
            }),
        };
        return print_json(&told, out);
    }
    match found {
        Comparison::Same { resolved } => {
            let percent = 100.0 * resolved;
            writeln!(out, "The same picture: no block of 16 × 10 pixels differs by more than noise and rounding.")?;
            writeln!(out, "In half of the blocks, a difference of {percent:.1} % of the light would have shown.")?;
        }
        Comparison::Shifted { by: [right, down] } => {
            let by = format!("{right:+.2} pixels to the right and {down:+.2} downward");
            writeln!(out, "The same picture but for its edges, which lie as if it were shifted by {by}.")?;
            let question = "Do rays go through the middle of their pixel, and is the mean taken before the curve?";
            writeln!(out, "{question}")?;
        }
        Comparison::Differs { blocks, of, brightness, most: [x, y], looks_like } => {
            let (percent, than) = (100.0 * brightness.abs(), if *brightness < 0.0 { "less" } else { "more" });
            writeln!(
                out,
                "Another picture: {blocks} of {of} blocks of 16 × 10 pixels differ, with {percent:.1} % {than} light in all."
            )?;
            writeln!(out, "Most of all about pixel {x},{y}.")?;
            if let Some(what) = looks_like {
                writeln!(out, "It looks like this: {what}")?;
            }
        }
    }
    Ok(())
}

/// The size and the bytes of a picture in the text format PPM.
fn read_ppm(file: &Path) -> Result<Picture> {
    let text = read_file(file, PICTURE).map_err(|told| Error::usage(told.to_string()))?;
    let refused = |what: String| Error::usage(format!("cannot read {}: {what}", printable_path(file)));
    picture_in(&String::from_utf8_lossy(&text)).map_err(refused)
}

use super::arguments::CompareYours;
use super::error::{Error, Result};
use super::format::{Format, print_json, print_written};
use super::own_file::{check_file, write_file};
use super::streams::Streams;
use pinhole::film::{Curve, png_bytes};
use pinhole::scene::{FileKind, printable_path, read_file};
use pinhole_lab::yours::{
    Comparison, Expected, Mistake, Picture, Place, Program, film_after, picture_in, program_after, steps,
};
use serde_json::{Value, json};
use std::io::Write;
use std::path::Path;

/// What is read of a reader's picture.
const PICTURE: FileKind = FileKind { name: "a picture", max: 16 << 20 };
/// What is read of a reader's program.
const PROGRAM: FileKind = FileKind { name: "a program", max: 1 << 17 };

/// Lists the steps of the reader's program; prints it after one; draws pinhole's picture of its scene; or compares the
/// picture that the reader's program wrote with that, and looks for a mistake in the program.
///
/// Errors: a chapter without a step; a picture that is no text in the format PPM, or of another size; a program that is no
/// text.
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
    let source = source_of(asked, picture)?;
    let picture = read_ppm(picture)?;
    let expected = Expected::after(step.number)?;
    let mut found = expected.compare(&picture)?;
    let program = match &source {
        Some(source) => {
            let told = "note: your program is compared with the book's, place by place or with more samples, for a minute or two";
            Some(expected.look_into(source, &picture, &mut found, &mut || _ = writeln!(notes, "{told}"))?)
        }
        None => None,
    };
    if !matches!(program, Some(Program::Earlier(_) | Program::Wrong(..))) {
        let told = "note: it differs; known mistakes are tried in the program, for a minute or two";
        expected.look_for_known(&picture, &mut found, &mut || _ = writeln!(notes, "{told}"))?;
    }
    tell(&found, program.as_ref(), format, out)
}

/// The text of the reader's program: the file that is asked for, or one beside the picture.
fn source_of(asked: &CompareYours, picture: &Path) -> Result<Option<String>> {
    let beside = || {
        let folder = picture.parent()?;
        ["src/main.rs", "main.rs"].map(|name| folder.join(name)).into_iter().find(|file| file.is_file())
    };
    let Some(file) = asked.source.clone().or_else(beside) else { return Ok(None) };
    let bytes = read_file(&file, PROGRAM).map_err(|told| Error::usage(told.to_string()))?;
    let text = String::from_utf8(bytes);
    text.map(Some).map_err(|_| Error::usage(format!("cannot read {}: it is no text in UTF-8", printable_path(&file))))
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

fn tell(found: &Comparison, program: Option<&Program>, format: Format, out: &mut dyn Write) -> Result {
    if format.is_json() {
        return print_json(&json_of(found, program), out);
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
    match program {
        None if matches!(found, Comparison::Same { .. }) => Ok(()),
        None => Ok(writeln!(out, "With `--source` and your program, the line is looked for in which it goes wrong.")?),
        Some(program) => tell_program(program, out),
    }
}

/// How many places of a program are shown, at most.
const PLACES: usize = 4;

fn tell_program(program: &Program, out: &mut dyn Write) -> Result {
    let (mistake, places) = match program {
        Program::Books => return Ok(writeln!(out, "Your program is the book's, but for spaces, comments and names.")?),
        Program::Right(places) => {
            let (number, places_are) = (places.len(), if places.len() == 1 { "place" } else { "places" });
            writeln!(out, "Beside the book's program, yours is as good; it is not the same in {number} {places_are}:")?;
            return tell_places(places, out);
        }
        Program::Earlier(chapter) => {
            return Ok(writeln!(
                out,
                "Your program is as it was after chapter {chapter}: this chapter's step is missing."
            )?);
        }
        Program::Another(why) => return Ok(writeln!(out, "In your program nothing was looked for, for it {why}.")?),
        Program::Wrong(mistake, places) => (mistake, places),
    };
    match mistake {
        Mistake::Shows => {}
        Mistake::Hides(part) => {
            let percent = 100.0 * part;
            writeln!(out, "And yet it is wrong: beside the book's program, {percent:.1} % of its picture differ.")?;
        }
        Mistake::MakesNoise(times) => {
            let told = "Its light is right, but not its noise: the squared error is";
            writeln!(out, "{told} {times:.0} times that of the book's program with as many samples.")?;
        }
    }
    let is = if places.len() == 1 { "this" } else { "these together" };
    writeln!(out, "As in the book, {is} would make it right:")?;
    tell_places(places, out)
}

fn tell_places(places: &[Place], out: &mut dyn Write) -> Result {
    for Place { line, within, readers, books } in places.iter().take(PLACES) {
        let within = within.as_ref().map_or(String::new(), |name| format!(", in `{name}`"));
        writeln!(out, "  line {line}{within}")?;
        let nothing = |text: &str| if text.is_empty() { "nothing".to_owned() } else { format!("`{text}`") };
        writeln!(out, "    yours   {}", nothing(readers))?;
        writeln!(out, "    book's  {}", nothing(books))?;
    }
    if places.len() > PLACES {
        writeln!(out, "  and {} further places", places.len() - PLACES)?;
    }
    Ok(())
}

fn json_of(found: &Comparison, program: Option<&Program>) -> Value {
    let mut told = match found {
        Comparison::Same { resolved } => json!({ "same": true, "resolved": resolved }),
        Comparison::Shifted { by } => json!({ "same": false, "shifted": by }),
        Comparison::Differs { blocks, of, brightness, most, looks_like } => json!({
            "same": false, "blocks": blocks, "of": of, "brightness": brightness, "most": most, "looks_like": looks_like,
        }),
    };
    told["program"] = match program {
        None => Value::Null,
        Some(Program::Books) => json!({ "is": "the book's" }),
        Some(Program::Right(places)) => json!({ "is": "right", "places": json_of_places(places) }),
        Some(Program::Earlier(chapter)) => json!({ "is": "earlier", "chapter": chapter }),
        Some(Program::Another(why)) => json!({ "is": "another", "why": why }),
        Some(Program::Wrong(mistake, places)) => {
            let [hides, noise] = match mistake {
                Mistake::Shows => [None; 2],
                Mistake::Hides(part) => [Some(part), None],
                Mistake::MakesNoise(times) => [None, Some(times)],
            };
            json!({ "is": "wrong", "places": json_of_places(places), "differing": hides, "squared_error": noise })
        }
    };
    told
}

fn json_of_places(places: &[Place]) -> Vec<Value> {
    let one = |Place { line, within, readers, books }: &Place| json!({ "line": line, "within": within, "yours": readers, "books": books });
    places.iter().map(one).collect()
}

/// The size and the bytes of a picture in the text format PPM.
fn read_ppm(file: &Path) -> Result<Picture> {
    let text = read_file(file, PICTURE).map_err(|told| Error::usage(told.to_string()))?;
    let refused = |what: String| Error::usage(format!("cannot read {}: {what}", printable_path(file)));
    picture_in(&String::from_utf8_lossy(&text)).map_err(refused)
}

use super::arguments::ReviewSnapshots;
use super::error::{Error, Result};
use super::find;
use super::format::{Format, print_json, print_written, shown};
use super::own_file::{check_file, write_file};
use super::review::{keep_page, page_place, picture, told, write_page};
use pinhole::Chapter;
use pinhole_lab::png_url;
use pinhole_lab::review::mutation::{MUTATIONS, Mutation};
use pinhole_lab::review::{Compared, Snapshots, compare_pictures, escape, page, picture_contrast};
use serde_json::{Value, json};
use std::collections::btree_map::{BTreeMap, Entry};
use std::fmt::Write as _;
use std::io::Write;

/// What a review shows with a mutation of one stage: as a page, a picture, or, of all mutations, a table or a gallery.
pub fn mutate(
    chapters: &[Chapter],
    name: &str,
    asked: &ReviewSnapshots,
    format: Format,
    out: &mut dyn Write,
) -> Result {
    let all = name == "all";
    if (asked.gallery && !all) || (asked.picture.is_some() && all) {
        return Err(Error::usage("--gallery goes with --mutate all, and --picture with the name of one mutation"));
    }
    if !all {
        let mutation = Mutation::named(name)?;
        if asked.picture.is_none() {
            page_place(asked)?;
        }
        let chapter = find::chapter(chapters, asked.chapter.as_deref().unwrap_or(mutation.chapter))?;
        let compared = compared(mutation, chapter, Snapshots::of(chapter)?)?;
        if let Some(which) = asked.picture {
            let file = asked.output.clone().ok_or_else(|| Error::usage("--picture needs a file: -o FILE.png"))?;
            let png = picture(&compared, which)?;
            write_file(true, &file, &png)?;
            return print_written(&file, format, out);
        }
        let heading = format!("A mutation, made on purpose: {}", mutation.name);
        let intro = "The mutation lives in this run only: no source and no snapshot has changed.";
        if format.is_json() {
            let difference = told(&compared);
            let file = keep_page(asked, &page(&heading, intro, &[compared])?)?;
            let (name, mistake) = (mutation.name, mutation.mistake);
            let mutation =
                json!({ "mutation": name, "mistake": mistake, "difference": difference, "files": [shown(&file)] });
            return print_json(&mutation, out);
        }
        writeln!(out, "{}: {}", compared.name, compared.headline())?;
        return write_page(asked, &page(&heading, intro, &[compared])?, out);
    }
    let gallery_file = asked.output.clone().unwrap_or_else(|| "out/review/mutations.svg".into());
    if asked.gallery {
        check_file(asked.output.is_some(), &gallery_file)?;
    }
    let (mut mutations, mut right) = (Vec::new(), BTreeMap::<&str, Snapshots>::new());
    for mutation in MUTATIONS {
        let chapter = find::chapter(chapters, asked.chapter.as_deref().unwrap_or(mutation.chapter))?;
        let before = match right.entry(chapter.name) {
            Entry::Occupied(known) => known.get().clone(),
            Entry::Vacant(place) => place.insert(Snapshots::of(chapter)?).clone(),
        };
        mutations.push((mutation, compared(mutation, chapter, before)?));
    }
    if asked.gallery {
        let gallery = gallery(&mutations)?;
        write_file(asked.output.is_some(), &gallery_file, gallery.as_bytes())?;
        return print_written(&gallery_file, format, out);
    }
    table(&mutations, format, out)
}

fn compared(mutation: &Mutation, chapter: &Chapter, before: Snapshots) -> Result<Compared> {
    Ok(Compared {
        name: chapter.name.into(),
        title: format!("with {}: {}", mutation.name, mutation.mistake),
        before,
        now: mutation.snapshots(chapter)?,
        commands: Vec::new(),
    })
}

/// A line for each mutation: its name, the mistake, the stage that the review names, how many pixels show it.
fn table(all: &[(&Mutation, Compared)], format: Format, out: &mut dyn Write) -> Result {
    let found = |(mutation, compared): &(&Mutation, Compared)| {
        let named = compared.before.first_difference(&compared.now).map(|difference| difference.stage);
        let pixels = compare_pictures(&compared.before.picture, &compared.now.picture);
        let right = named.as_deref() == Some(mutation.stage());
        (mutation.name, mutation.mistake, named, pixels.map_or(0, |difference| difference.differing), right)
    };
    let found: Vec<_> = all.iter().map(found).collect();
    let right = found.iter().filter(|(.., right)| *right).count();
    if format.is_json() {
        let told = |(name, mistake, named, pixels, right): &_| json!({ "mutation": name, "mistake": mistake, "stage_named": named, "pixels_differing": pixels, "is_right": right });
        let mutations: Vec<Value> = found.iter().map(told).collect();
        return print_json(&json!({ "tried": all.len(), "named_right": right, "mutations": mutations }), out);
    }
    writeln!(out, "{:<22} {:<27} {:<32} pixels that differ", "mutation", "mistake", "stage named")?;
    for (name, mistake, named, pixels, _) in found {
        let named = named.unwrap_or_else(|| "none".into());
        writeln!(out, "{name:<22} {mistake:<27} {named:<32} {pixels:>4}")?;
    }
    writeln!(out, "{right} of {} mutations named at their stage", all.len())?;
    Ok(())
}

/// Width of the gallery, and of a picture in it.
const WIDTH: usize = 720;
const PICTURE: [usize; 2] = [168, 95];
/// A mutation's room: two pictures and three lines of words.
const ROOM: [usize; 2] = [366, 158];

/// A drawing of all mutations: what each makes of the picture, the difference, the mistake and the stage that the review names.
fn gallery(all: &[(&Mutation, Compared)]) -> Result<String> {
    let height = all.len().div_ceil(2) * ROOM[1];
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{WIDTH}\" height=\"{height}\" viewBox=\"0 0 {WIDTH} {height}\" \
         font-family=\"system-ui, sans-serif\" font-size=\"13\" fill=\"currentColor\">\n"
    );
    for (index, (mutation, compared)) in all.iter().enumerate() {
        let [x, y] = [index % 2 * ROOM[0], index / 2 * ROOM[1]];
        let before_now = [&compared.before.picture, &compared.now.picture];
        let contrast = picture_contrast(before_now[0], before_now[1])?;
        let (difference, _) = contrast.ok_or_else(|| Error::usage("two pictures cannot be compared"))?;
        for (place, png) in [&compared.now.picture, &difference].into_iter().enumerate() {
            let x = x + place * (PICTURE[0] + 8);
            let _ = writeln!(
                svg,
                "<image x=\"{x}\" y=\"{y}\" width=\"{}\" height=\"{}\" style=\"image-rendering: pixelated\" href=\"{}\"/>",
                PICTURE[0],
                PICTURE[1],
                png_url(png)
            );
        }
        let named =
            compared.before.first_difference(&compared.now).map_or("none".into(), |difference| difference.stage);
        let lines = [
            (18, "bold", mutation.name),
            (35, "normal", mutation.mistake),
            (52, "normal", &*format!("names: {named}")),
        ];
        for (down, weight, words) in lines {
            let y = y + PICTURE[1] + down;
            let _ = writeln!(svg, "<text x=\"{x}\" y=\"{y}\" font-weight=\"{weight}\">{}</text>", escape(words));
        }
    }
    svg.push_str("</svg>\n");
    Ok(svg)
}

use super::arguments::{Picture, ReviewAction, ReviewSnapshots};
use super::called::called;
use super::error::{Error, Result};
use super::find;
use super::format::{Format, print_json, shown};
use super::own_file::{check_file, write_file};
use pinhole::Chapter;
use pinhole::scene::{Resolution, printable_path};
use pinhole_lab::review::{
    Compared, Pending, SNAPSHOT_SIZE, Snapshots, compare_pictures, page, pending, picture_contrast,
};
use serde_json::{Value, json};
use std::io::Write;
use std::path::{Path, PathBuf};

/// Lists the snapshots that wait and writes the page that shows them; or keeps them, or throws them away.
pub fn review(chapters: &[Chapter], asked: &ReviewSnapshots, format: Format, out: &mut dyn Write) -> Result {
    let folder = asked.chapters.clone().unwrap_or_else(|| pinhole_lab::repository().join("chapters"));
    match (&asked.action, &asked.mutate) {
        (Some(ReviewAction::Accept { chapter }), _) => {
            settle(chapters, &folder, chapter.as_deref(), "accepted", |pending| Ok(pending.accept()?), format, out)
        }
        (Some(ReviewAction::Reject { chapter }), _) => {
            settle(chapters, &folder, chapter.as_deref(), "rejected", |pending| Ok(pending.reject()?), format, out)
        }
        (None, Some(name)) => super::mutation::mutate(chapters, name, asked, format, out),
        (None, None) => show(chapters, &folder, asked, format, out),
    }
}

/// The page of what waits.
fn show(chapters: &[Chapter], folder: &Path, asked: &ReviewSnapshots, format: Format, out: &mut dyn Write) -> Result {
    let mut waiting = pending(folder)?;
    if let Some(name) = &asked.chapter {
        let near = |word: &&str| strsim::jaro_winkler(word, name) > 0.85;
        if let Some(word) = ["accept", "reject"].into_iter().find(near) {
            return Err(Error::usage(format!("there is no chapter \"{name}\"; a similar word is `review {word}`")));
        }
        let chapter = find::chapter(chapters, name)?;
        waiting.retain(|pending| pending.chapter == chapter.name);
    }
    if waiting.is_empty() {
        return match format {
            Format::Json => print_json(&json!({ "waiting": [], "files": [] }), out),
            Format::Text => nothing_waits(asked.chapter.as_deref(), out),
        };
    }
    let compared: Vec<Compared> = waiting.iter().map(|pending| compared(chapters, pending)).collect();
    let heading = match &compared[..] {
        [one] => format!("One chapter's snapshots wait: {}", one.name),
        several => format!("The snapshots of {} chapters wait", several.len()),
    };
    let intro = "Before is what is kept; now is what the tests computed when they last ran.";
    let page = page(&heading, intro, &compared)?;
    if format.is_json() {
        let file = keep_page(asked, &page)?;
        let told = |(compared, pending): (&Compared, &Pending)| json!({ "difference": told(compared), "folder": shown(&pending.folder), "files": pending.files });
        let waiting: Vec<Value> = compared.iter().zip(&waiting).map(told).collect();
        return print_json(&json!({ "waiting": waiting, "files": [shown(&file)] }), out);
    }
    for chapter in &compared {
        writeln!(out, "{}: {}", chapter.name, chapter.headline())?;
    }
    write_page(asked, &page, out)?;
    writeln!(out, "to keep      {}   (or all)", called("review accept CHAPTER"))?;
    writeln!(out, "to go back   {}   (or all)", called("review reject CHAPTER"))?;
    Ok(())
}

/// What differs first in a chapter.
pub(super) fn told(compared: &Compared) -> Value {
    let first = compared.before.first_difference(&compared.now);
    json!({
        "chapter": compared.name, "title": compared.title, "headline": compared.headline(), "first_difference": first,
    })
}

fn nothing_waits(chapter: Option<&str>, out: &mut dyn Write) -> Result {
    let of = chapter.map_or_else(String::new, |chapter| format!(" of chapter {chapter}"));
    writeln!(
        out,
        "no snapshot{of} waits: one does when `cargo test --test chapters` finds that a chapter computes something else \
         than what is kept"
    )?;
    Ok(())
}

fn compared(chapters: &[Chapter], pending: &Pending) -> Compared {
    let name = &pending.chapter;
    let title = chapters.iter().find(|chapter| chapter.name == name).map_or("", |chapter| chapter.title);
    let (before, now) = (Snapshots::kept(&pending.folder), Snapshots::pending(&pending.folder));
    let mut commands = vec![
        ("to keep what is new", called(&format!("review accept {name}"))),
        ("to throw it away", called(&format!("review reject {name}"))),
    ];
    if let Ok(difference) = compare_pictures(&before.picture, &now.picture).as_ref() {
        let ([x, y], Resolution { width, height }) = (difference.worst, SNAPSHOT_SIZE);
        let command = called(&format!("trace {name} --pixel {x},{y} --size {width}x{height}"));
        commands.push(("to follow the worst pixel", command));
    }
    Compared { name: name.clone(), title: title.into(), before, now, commands }
}

/// Where the page goes, if it can be written there.
pub(super) fn page_place(asked: &ReviewSnapshots) -> Result<PathBuf> {
    let file = asked.output.clone().unwrap_or_else(|| Path::new("out").join("review").join("index.html"));
    check_file(asked.output.is_some(), &file)?;
    Ok(file)
}

/// Writes the page where it was asked for.
pub(super) fn keep_page(asked: &ReviewSnapshots, page: &str) -> Result<PathBuf> {
    let file = page_place(asked)?;
    write_file(asked.output.is_some(), &file, page.as_bytes())?;
    Ok(file)
}

/// Writes the page and says where it is.
pub(super) fn write_page(asked: &ReviewSnapshots, page: &str, out: &mut dyn Write) -> Result {
    let file = keep_page(asked, page)?;
    writeln!(out, "wrote {}: open it in a browser", printable_path(&file))?;
    Ok(())
}

/// The picture of one chapter that is asked for.
pub(super) fn picture(compared: &Compared, picture: Picture) -> Result<Vec<u8>> {
    match picture {
        Picture::Before => Ok(compared.before.picture.clone()),
        Picture::Now => Ok(compared.now.picture.clone()),
        Picture::Difference => match picture_contrast(&compared.before.picture, &compared.now.picture)? {
            Some((png, _)) => Ok(png),
            None => Err(Error::usage(format!("the pictures of {} cannot be compared", compared.name))),
        },
    }
}

/// Accepts or rejects what waits of one chapter, or of all.
fn settle(
    chapters: &[Chapter],
    folder: &Path,
    asked: Option<&str>,
    word: &str,
    settle: fn(&Pending) -> Result<Vec<PathBuf>>,
    format: Format,
    out: &mut dyn Write,
) -> Result {
    let mut waiting = pending(folder)?;
    match asked {
        Some("all") => {}
        Some(name) => {
            let chapter = find::chapter(chapters, name)?;
            waiting.retain(|pending| pending.chapter == chapter.name);
        }
        None if waiting.len() > 1 => {
            let names: Vec<&str> = waiting.iter().map(|pending| &*pending.chapter).collect();
            return Err(Error::usage(format!(
                "the snapshots of {} chapters wait: name one of {}, or all",
                names.len(),
                names.join(", ")
            )));
        }
        None => {}
    }
    if format.is_json() {
        // What was done before a file that could not be settled is done, and is told.
        let (mut settled, mut ended) = (Vec::new(), Ok(()));
        for pending in &waiting {
            match settle(pending) {
                Ok(_) => settled.push(json!({ "chapter": pending.chapter, "files": pending.files })),
                Err(error) => {
                    ended = Err(error);
                    break;
                }
            }
        }
        return print_json(&json!({ word: settled }), out).and(ended);
    }
    if waiting.is_empty() {
        return nothing_waits(asked.filter(|asked| *asked != "all"), out);
    }
    for pending in &waiting {
        settle(pending)?;
        writeln!(out, "{word} {} of {}", pending.files.join(", "), pending.chapter)?;
    }
    Ok(())
}

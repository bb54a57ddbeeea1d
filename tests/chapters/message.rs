//! What a reader is told whose chapter no longer computes what its snapshots hold.

use crate::snapshots::{FILES, SIZE, Snapshots, folder};
use pinhole::review::{ChangedRow, PictureDifference, Place, changed_rows, compare_pictures, first_difference};
use std::fmt::{self, Write};

/// A test's failure: a message for a person.
pub struct Mismatch(pub String);

/// The message as it is, so that a test that returns it prints it.
impl fmt::Debug for Mismatch {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

/// What differs first and where, then by how much, then what to do about it.
pub fn mismatch(chapter: &str, before: &Snapshots, now: &Snapshots, refused: &[&str]) -> Mismatch {
    let missing: Vec<&str> = FILES.into_iter().filter(|file| !folder(chapter).join(file).is_file()).collect();
    let picture = compare_pictures(&before.picture, &now.picture).ok();
    let mut text = format!("{chapter}: {}\n", headline(before, now, &missing, refused));
    if let Some(picture) = &picture {
        let _ = writeln!(text, "{picture}");
    }
    if missing.is_empty() {
        text.push_str(&probes(&before.probes, &now.probes));
        text.push_str(&changed_lines("plan", &before.plan, &now.plan));
    }
    text.push_str(&what_to_do(chapter, pixel(before, now, picture.as_ref())));
    Mismatch(text)
}

fn headline(before: &Snapshots, now: &Snapshots, missing: &[&str], refused: &[&str]) -> String {
    if missing.len() == FILES.len() {
        return "no snapshot of it is kept yet".into();
    }
    if !missing.is_empty() {
        return format!("of its snapshots {} is missing", missing.join(", "));
    }
    if let Some(difference) = first_difference(&before.digests, &now.digests) {
        return difference.to_string();
    }
    if refused.contains(&"image") {
        return "all columns of all stages are the same, and the picture differs: look at what makes pixels of the \
            film (src/film/develop.rs, src/film/png.rs)"
            .into();
    }
    format!("all numbers and pixels are the same; what differs is the wording of {}", refused.join(" and "))
}

/// The probes before and now: every column that changed of the first probe, the first column of the others.
fn probes(before: &str, now: &str) -> String {
    let rows = changed_rows(before, now);
    let Some(first) = rows.first() else { return String::new() };
    let mut text = String::from("\nprobes, where they changed\n");
    let (mut last, mut left_out) = ("", 0);
    for ChangedRow { probe, before, now } in &rows {
        if *probe == last && *probe != first.probe {
            left_out += 1;
            continue;
        }
        if *probe != last {
            let _ = writeln!(text, "  {probe}");
        }
        last = probe;
        write_lines(&mut text, "before", before);
        write_lines(&mut text, "now", now);
    }
    if left_out > 0 {
        let _ = writeln!(text, "  and {left_out} more columns at these probes");
    }
    text
}

/// Lines of a text that the other one does not have.
fn changed_lines(what: &str, before: &str, now: &str) -> String {
    let missing_from = |other: &str, text: &str| -> Vec<String> {
        text.lines().filter(|line| !other.lines().any(|other| other == *line)).map(String::from).collect()
    };
    let (gone, new) = (missing_from(now, before), missing_from(before, now));
    if gone.is_empty() && new.is_empty() {
        return String::new();
    }
    let mut text = format!("\n{what}, where it changed\n");
    write_lines(&mut text, "before", &gone.iter().map(String::as_str).collect::<Vec<_>>());
    write_lines(&mut text, "now", &new.iter().map(String::as_str).collect::<Vec<_>>());
    text
}

fn write_lines(text: &mut String, when: &str, lines: &[&str]) {
    for line in lines {
        let _ = writeln!(text, "    {when:<6} {line}");
    }
}

/// The pixel to look at: where the picture differs most, or the first of the block that differs first.
fn pixel(before: &Snapshots, now: &Snapshots, picture: Option<&PictureDifference>) -> [u32; 2] {
    let block = first_difference(&before.digests, &now.digests).map(|difference| difference.place);
    match (picture, block) {
        (Some(picture), _) if picture.largest > 0 => picture.worst,
        (_, Some(Place::Block { pixels: [x, y], .. })) => [*x.start(), *y.start()],
        _ => [SIZE.width / 2, SIZE.height / 2],
    }
}

fn what_to_do(chapter: &str, [x, y]: [u32; 2]) -> String {
    let (width, height) = (SIZE.width, SIZE.height);
    let snapshots = format!("chapters/{chapter}/snapshots");
    let kept = |file: &str| folder(chapter).join(file).is_file();
    let pictures = if kept("image.snap.png") && kept("image.snap.new.png") {
        format!("\n          {snapshots}/image.snap.png is before, image.snap.new.png beside it is now")
    } else {
        String::new()
    };
    format!(
        "\n\
        to look   cargo run --release -- trace {chapter} --pixel {x},{y} --size {width}x{height}{pictures}\n\
        to keep   INSTA_UPDATE=always cargo test --test chapters chapter_{chapter}\n          \
                  or, with cargo-insta: cargo insta accept\n\
        to go back   undo your edit (`git diff` shows it; `git checkout chapters/{chapter}/main.rs` if it is there)\n"
    )
}

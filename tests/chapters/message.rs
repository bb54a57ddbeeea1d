//! What a reader is told whose chapter no longer computes what its snapshots hold.

use crate::snapshots::folder;
use pinhole_lab::review::{
    ChangedRow, DEVELOP, PictureDifference, Place, SNAPSHOT_FILES as FILES, SNAPSHOT_SIZE as SIZE, Snapshots,
    averages_out, changed_rows, compare_pictures,
};
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
        if !picture.is_none() {
            let _ = writeln!(text, "{}", noise_or_bug(&before.picture, &now.picture));
        }
    }
    if missing.is_empty() {
        text.push_str(&probes(&before.probes, &now.probes));
        text.push_str(&changed_lines("plan", &before.plan, &now.plan));
    }
    let waits = FILES.iter().any(|file| folder(chapter).join(format!("{file}.new")).is_file());
    text.push_str(&what_to_do(chapter, pixel(before, now, picture.as_ref()), waits));
    Mismatch(text)
}

fn headline(before: &Snapshots, now: &Snapshots, missing: &[&str], refused: &[&str]) -> String {
    if missing.len() == FILES.len() {
        return "no snapshot of it is kept yet".into();
    }
    if !missing.is_empty() {
        return format!("of its snapshots {} is missing", missing.join(", "));
    }
    match before.first_difference(now) {
        Some(difference) if difference.stage == DEVELOP => {
            format!(
                "{difference}: all columns of all stages are the same, so look at src/pinhole/film/develop.rs and src/pinhole/film/png_files.rs"
            )
        }
        Some(difference) => difference.to_string(),
        None => {
            format!("all numbers and pixels are the same; what differs is the wording of {}", refused.join(" and "))
        }
    }
}

/// Whether the film differs as two renders with other random numbers do.
fn noise_or_bug(before: &[u8], now: &[u8]) -> &'static str {
    match averages_out(before, now) {
        Some(true) => {
            "over blocks of 8 × 8 pixels the differences average out, as noise does: other random numbers, the same mean"
        }
        Some(false) => {
            "over blocks of 8 × 8 pixels the differences do not average out: not noise but another mean, so bias or a bug"
        }
        None => "too few pixels differ for their mean to tell noise from a bug",
    }
}

/// The probes before and now: every column that changed of the first probe, the first column of the others.
fn probes(before: &str, now: &str) -> String {
    let rows = changed_rows(before, now);
    let Some(first) = rows.first() else { return "\nprobes: none of the nine changed\n".into() };
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
    let block = before.first_difference(now).map(|difference| difference.place);
    match (picture, block) {
        (Some(picture), _) if picture.largest > 0 => picture.worst,
        (_, Some(Place::Block { pixels: [x, y], .. })) => [*x.start(), *y.start()],
        _ => [SIZE.width / 2, SIZE.height / 2],
    }
}

/// The commands that show, keep and undo, by the program that this test has just built; without a review where insta was told to let nothing wait.
pub fn what_to_do(chapter: &str, [x, y]: [u32; 2], waits: bool) -> String {
    let (width, height) = (SIZE.width, SIZE.height);
    let trace = format!("cargo run -- trace {chapter} --pixel {x},{y} --size {width}x{height}");
    if !waits {
        // Insta was told to write nothing: INSTA_UPDATE=no, or CI is set.
        return format!(
            "\n\
            to look      {trace}\n\
            to keep      INSTA_UPDATE=always cargo test --test chapters chapter_{chapter}\n\
            to go back   undo your edit, which `git diff` shows\n"
        );
    }
    format!(
        "\n\
        to look      cargo run -- review {chapter}\n             {trace}\n\
        to keep      cargo run -- review accept {chapter}\n\
        to go back   undo your edit, which `git diff` shows, then\n             \
                     cargo run -- review reject {chapter}\n"
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn snapshots(digests: &str, plan: &str) -> Snapshots {
        Snapshots { digests: digests.into(), plan: plan.into(), ..Snapshots::default() }
    }

    const DIGESTS: &str = "8 × 8 pixels\n\naaaa \"Add light\" writes radiance\n";

    #[test]
    fn the_first_line_says_what_differs_first() {
        let (before, now) = (snapshots(DIGESTS, "a plan"), snapshots(&DIGESTS.replace("aaaa", "bbbb"), "another plan"));
        let line = headline(&before, &now, &[], &["digests", "plan", "image"]);
        assert!(line.starts_with("the first stage whose numbers differ is \"Add light\" (column radiance)"), "{line}");
        let line = headline(&before, &snapshots(DIGESTS, "another plan"), &[], &["plan"]);
        assert_eq!(line, "all numbers and pixels are the same; what differs is the wording of plan");
        assert_eq!(headline(&now, &now, &FILES, &["image"]), "no snapshot of it is kept yet");
        assert_eq!(headline(&now, &now, &["plan.snap"], &["plan"]), "of its snapshots plan.snap is missing");
    }

    #[test]
    fn what_to_do_names_a_review_only_where_something_waits() {
        let text = what_to_do("05_pinhole", [3, 4], true);
        for command in ["review 05_pinhole", "trace 05_pinhole --pixel 3,4 --size 96x54", "review accept 05_pinhole"] {
            assert!(text.contains(&format!("cargo run -- {command}\n")), "{text}");
        }
        assert!(text.ends_with("cargo run -- review reject 05_pinhole\n"), "{text}");
        let text = what_to_do("05_pinhole", [3, 4], false);
        assert!(!text.contains("review") && text.contains("INSTA_UPDATE=always"), "{text}");
    }

    #[test]
    fn only_lines_that_changed_are_told() {
        let text = changed_lines("plan", "one\ntwo\nthree\n", "one\n2\nthree\n");
        assert_eq!(text, "\nplan, where it changed\n    before two\n    now    2\n");
        assert_eq!(changed_lines("plan", "one\n", "one\n"), "");
    }

    #[test]
    fn every_column_of_the_first_probe_and_the_first_of_the_others() {
        let probe = |x: u32| format!("\nplace {x}\nraster {x}\nndc {x}\n");
        let before = format!("size\n{}{}{}", probe(1), probe(2), probe(3));
        let now = before.replace(" 1\nndc 1", " 7\nndc 7").replace(" 2\nndc 2", " 8\nndc 8");
        let text = probes(&before, &now);
        assert!(text.contains("now    ndc 7") && text.contains("now    raster 8"), "{text}");
        assert!(!text.contains("ndc 8") && !text.contains("place 3"), "{text}");
        assert!(text.ends_with("  and 1 more columns at these probes\n"), "{text}");
    }
}

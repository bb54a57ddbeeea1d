//! Steps that change a program, in words for a reader, and the program that they make.

use std::ops::Range;

/// What a chapter adds to the reader's program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Step {
    /// The chapter's stem.
    pub chapter: &'static str,
    /// Its number.
    pub number: u32,
    /// The edits: each a comment that says where, and the lines that go there.
    pub text: &'static str,
}

macro_rules! steps {
    ($($number:literal $chapter:literal,)+) => {
        /// All steps, in the order of the chapters; the first is the program of page 1 as it stands there.
        pub fn steps() -> Vec<Step> {
            vec![Step { chapter: "01_image", number: 1, text: "" }, $(Step {
                chapter: $chapter,
                number: $number,
                text: include_str!(concat!("../../../chapters/", $chapter, "/yours.step")),
            }),+]
        }
    };
}
steps! {
    5 "05_pinhole",
    9 "09_camera_to_world",
    10 "10_light_and_shadow",
    13 "13_shapes",
    17 "17_sampling",
    19 "19_mirrors",
    20 "20_glass",
    21 "21_soft_shadows",
    23 "23_depth_of_field",
    25 "25_path_tracing",
    26 "26_choosing_samples",
    28 "28_meshes",
    30 "30_tree",
    33 "33_rasterisation",
}

/// The program of the first page.
const FIRST: &str = include_str!("../naive/one_page.rs");

/// The program after the step of a chapter; that of the first page for 1.
///
/// Errors: an edit that says nothing of this program, by its own words.
pub fn program_after(chapter: u32) -> Result<String, String> {
    program_of(|number| number <= chapter)
}

/// The program after the steps of these chapters.
///
/// Errors: as for [`program_after`]; so does the step of a chapter that needs one which is left out.
pub fn program_of(takes: impl Fn(u32) -> bool) -> Result<String, String> {
    let listing = FIRST.split("ANCHOR: one_page\n").nth(1).and_then(|rest| rest.split("// ANCHOR_END").next());
    let mut lines: Vec<String> = listing.unwrap_or_default().lines().map(String::from).collect();
    for step in steps().into_iter().filter(|step| takes(step.number)) {
        for (place, body) in edits(step.text) {
            let left_out = place.strip_prefix(IF_THERE);
            let place = left_out.unwrap_or(place);
            if apply(&mut lines, place, &body).is_none() && left_out.is_none() {
                return Err(format!("{}: \"{place}\" is not there once", step.chapter));
            }
        }
    }
    Ok(lines.join("\n").trim_end().to_owned() + "\n")
}

/// The end of a place that may be there more than once.
const EVERYWHERE: &str = "`, wherever it stands:";
/// What stands before the part of a line that is long.
const A_PART: &str = "the line with `";
/// How a place begins that only a step brings which may be left out.
const IF_THERE: &str = "If you have it, ";

/// The edits of a step: where, and what.
fn edits(text: &str) -> Vec<(&str, Vec<&str>)> {
    let mut found: Vec<(&str, Vec<&str>)> = Vec::new();
    // A page may show a step in parts, each between two marks.
    for line in text.lines().filter(|line| !line.starts_with("// ANCHOR")) {
        let place = line.strip_prefix("// ").filter(|place| {
            let begins = ["In ", "After ", "Before ", "If you have it, ", "`"];
            let begins = begins.iter().any(|word| place.starts_with(word));
            begins && place.contains('`') && (place.ends_with(':') || place.ends_with(" goes."))
        });
        match (place, found.last_mut()) {
            (Some(place), _) => found.push((place, Vec::new())),
            (None, Some((_, body))) => body.push(line),
            (None, None) => {}
        }
    }
    for (_, body) in &mut found {
        while body.last() == Some(&"") {
            body.pop();
        }
    }
    found
}

/// Makes one edit; none where its place is missing, or there more than once.
fn apply(lines: &mut Vec<String>, place: &str, body: &[&str]) -> Option<()> {
    let quoted: Vec<&str> = place.split('`').skip(1).step_by(2).collect();
    let is_within = place.starts_with("In `");
    let item = item(lines, quoted.first()?)?;
    let targets: Vec<Range<usize>> = match quoted.get(1) {
        Some(line) if is_within => {
            let is_it = |at: &usize| match place.contains(A_PART) {
                true => lines[*at].contains(line),
                false => lines[*at].trim() == *line,
            };
            item.filter(is_it).map(|at| at..at + 1).collect()
        }
        _ if is_within => return None,
        _ => vec![item],
    };
    if targets.is_empty() || (targets.len() > 1 && !place.ends_with(EVERYWHERE)) {
        return None;
    }
    let mut body: Vec<String> = body.iter().map(|line| (*line).to_owned()).collect();
    let replaces = place.ends_with(" goes.") || place.contains("n place of ");
    let is_after = place.starts_with("After ") || place.contains(", after `");
    // Between items stands an empty line.
    if !replaces && !is_within {
        body.insert(if is_after { 0 } else { body.len() }, String::new());
    }
    for target in targets.into_iter().rev() {
        let at = match (replaces, is_after) {
            (true, _) => target,
            (false, true) => target.end..target.end,
            (false, false) => target.start..target.start,
        };
        lines.splice(at, body.iter().cloned());
    }
    Some(())
}

/// The lines of an item with its documentation: of a function, a type or a constant by its name, of `impl V` by both
/// words; the last one where there are several.
fn item(lines: &[String], name: &str) -> Option<Range<usize>> {
    let is_named = |line: &str| {
        let mut words = line.split(|letter: char| !(letter.is_alphanumeric() || letter == '_'));
        let (kind, own) = (words.next().unwrap_or_default(), words.next().unwrap_or_default());
        match name.strip_prefix("impl ") {
            Some(of) => kind == "impl" && own == of,
            None => ["fn", "struct", "enum", "const", "static"].contains(&kind) && own == name,
        }
    };
    let first = lines.iter().rposition(|line| is_named(line))?;
    let is_whole = |line: &str| line.ends_with([';', '}']) || line.contains("; //");
    let more = if is_whole(&lines[first]) {
        0
    } else {
        lines[first + 1..].iter().position(|line| line.starts_with(['}', ']', ')']))? + 1
    };
    let above = lines[..first].iter().rev().take_while(|line| line.starts_with("//") || line.starts_with("#[")).count();
    Some(first - above..first + more + 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_step_finds_its_places_and_a_wrong_one_is_told() {
        for step in steps() {
            let program = program_after(step.number).expect("applies");
            assert!(program.contains("fn main()") && !program.contains("goes."), "{}", step.chapter);
        }
        let mut lines: Vec<String> =
            ["const A: u8 = 1;", "fn b() {", "    c();", "    c();", "}"].map(String::from).into();
        assert!(apply(&mut lines, "In `b`, after `c();`:", &["d();"]).is_none(), "it is there twice");
        assert!(apply(&mut lines, "After `e`:", &["d();"]).is_none());
        apply(&mut lines, "In place of `A`:", &["const A: u8 = 2;"]).expect("there");
        apply(&mut lines, "After `A`:", &["const F: u8 = 3;"]).expect("there");
        apply(&mut lines, "`b` goes.", &[]).expect("there");
        assert_eq!(lines, ["const A: u8 = 2;", "", "const F: u8 = 3;"]);
    }
}

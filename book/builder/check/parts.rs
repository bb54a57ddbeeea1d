//! A chapter's page in its parts: what is visible under each heading, what is folded, its exercises and answers.

use super::Page;
use super::directive::{Directive, parse};
use super::listing;
use super::pattern::folded;
use super::scan::Scan;

/// What stands under one heading without unfolding anything.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Section {
    /// The heading's words; those of the page for what stands before the first one.
    pub heading: String,
    /// The lines below it, in markdown.
    pub text: String,
}

/// The visible part of a page, by its headings of the second level.
pub fn sections(page: &Page) -> Vec<Section> {
    let scan = Scan::new(&page.text);
    let mut sections: Vec<Section> = Vec::new();
    for (line, _) in folded(&scan).filter(|(_, is_folded)| !is_folded) {
        let heading = line.text.strip_prefix("## ").or_else(|| line.text.strip_prefix("# "));
        match (heading.filter(|_| line.fence.is_none()), sections.last_mut()) {
            (Some(heading), _) => sections.push(Section { heading: heading.to_owned(), text: String::new() }),
            (None, Some(section)) => section.text += &format!("{}\n", line.text),
            (None, None) => {}
        }
    }
    sections
}

/// The visible part under one heading.
pub fn section(page: &Page, heading: &str) -> Option<String> {
    sections(page).into_iter().find(|section| section.heading == heading).map(|section| section.text)
}

/// What is folded under a summary.
fn unfolded(page: &Page, summary: &str) -> String {
    let scan = Scan::new(&page.text);
    let named = format!("<summary>{summary}</summary>");
    let inside = scan.lines.iter().skip_while(|line| line.text.trim() != named).skip(1);
    let inside = inside.take_while(|line| line.fence.is_some() || line.text.trim() != "</details>");
    inside.map(|line| format!("{}\n", line.text)).collect()
}

/// One exercise of a page.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Exercise {
    /// Its number on the page.
    pub number: usize,
    /// Its level: one star to three.
    pub level: String,
    /// What it asks, in markdown.
    pub text: String,
    /// Its answer, in markdown.
    pub answer: String,
}

/// What stands above the exercises of a page, and each of them with its answer.
pub fn exercises(page: &Page) -> (String, Vec<Exercise>) {
    let text = section(page, "Exercises").unwrap_or_default();
    let (before, asked) = numbered(&text, |line| line.split_once(". ").and_then(|(number, _)| number.parse().ok()));
    let answer = |line: &str| line.strip_prefix("**")?.split_once(".**")?.0.parse().ok();
    let (_, answers) = numbered(&unfolded(page, "Answers"), answer);
    let exercise = |(number, text): (usize, String)| {
        let text = text.split_once(". ").map_or("", |(_, text)| text).trim();
        let asked = text.trim_start_matches('★');
        let level = text[..text.len() - asked.len()].to_owned();
        let answer = answers.iter().find(|(answered, _)| *answered == number);
        let answer = answer.and_then(|(_, text)| text.split_once(".**")).map_or("", |(_, text)| text.trim());
        Exercise { number, level, text: asked.trim().to_owned(), answer: answer.to_owned() }
    };
    (before, asked.into_iter().map(exercise).collect())
}

/// The text before the first line that has a number, and the text from each such line to the next.
fn numbered(text: &str, number: impl Fn(&str) -> Option<usize>) -> (String, Vec<(usize, String)>) {
    let (mut before, mut found) = (String::new(), Vec::<(usize, String)>::new());
    let scan = Scan::new(text);
    for line in &scan.lines {
        // A list within an exercise counts from 1 again.
        let next = number(line.text).filter(|&number| line.fence.is_none() && number == found.len() + 1);
        match (next, found.last_mut()) {
            (Some(number), _) => found.push((number, format!("{}\n", line.text))),
            (None, Some((_, text))) => *text += &format!("{}\n", line.text),
            (None, None) => before += &format!("{}\n", line.text),
        }
    }
    (before.trim().to_owned(), found)
}

/// The function that the page asks for: its comment and its signature.
///
/// Errors: a listing that cannot be read.
pub fn signature(page: &Page) -> Result<Option<String>, String> {
    let text = section(page, "Your turn").unwrap_or_default();
    let include = text.lines().find_map(|line| match parse(line) {
        Some(Ok(Directive::Include { path, anchor })) if path.ends_with("exercise.rs") => Some((path, anchor)),
        _ => None,
    });
    let Some((path, anchor)) = include else { return Ok(None) };
    let listing = listing::shown(page, path, anchor)?;
    let from = listing.lines().position(|line| line.starts_with("pub fn ")).unwrap_or(0);
    let length = listing.lines().skip(from).position(|line| line.ends_with('{')).map_or(1, |length| length + 1);
    let lines: Vec<&str> = listing.lines().take(from + length).collect();
    Ok(Some(lines.join("\n")))
}

#[cfg(test)]
mod tests {
    use super::super::{made_up, read_pages};
    use super::*;

    const PAGE: &str = "# A\n\nWhy?\n\n## One\n\nText.\n\n<details>\n<summary>More</summary>\n\n## In it\n\n</details>\n\n\
        ## Exercises\n\nPredict.\n\n1. ★ Do $x$.\n2. ★★★ Do it:\n\n   ```text\n3. no\n   ```\n\n\
        <details>\n<summary>Answers</summary>\n\n**1.** Done.\n\n**2.** So:\n\n$$y$$\n\n</details>\n\n## Last\n";

    #[test]
    fn a_page_has_sections_and_exercises() {
        let page = made_up("01_a.md", PAGE);
        let headings: Vec<String> = sections(&page).into_iter().map(|section| section.heading).collect();
        assert_eq!(headings, ["A", "One", "Exercises", "Last"]);
        assert_eq!(section(&page, "One").as_deref(), Some("\nText.\n\n\n"));
        let (before, exercises) = exercises(&page);
        assert_eq!((before.as_str(), exercises.len()), ("Predict.", 2));
        assert_eq!((exercises[0].text.as_str(), exercises[0].answer.as_str()), ("Do $x$.", "Done."));
        assert_eq!((exercises[1].number, exercises[1].level.as_str()), (2, "★★★"));
        assert!(exercises[1].text.ends_with("```") && exercises[1].answer == "So:\n\n$$y$$");
    }

    #[test]
    fn every_chapter_s_function_and_answers_are_found() {
        let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
        let folder = if folder.ends_with("book") { folder.join("src") } else { folder.join("book/src") };
        let pages = read_pages(&folder).expect("the pages can be read");
        let chapters = pages.iter().filter(|page| page.name.starts_with(|first: char| first.is_ascii_digit()));
        for page in chapters {
            let signature = signature(page).expect(&page.name).expect(&page.name);
            assert!(signature.starts_with("///") && signature.ends_with('{'), "{}: {signature}", page.name);
            let (_, exercises) = exercises(page);
            assert!(exercises.len() > 2, "{}", page.name);
            for exercise in exercises {
                let is_whole = !exercise.text.is_empty() && !exercise.answer.is_empty() && exercise.level.contains('★');
                assert!(is_whole, "{}: {exercise:?}", page.name);
            }
        }
    }
}

//! The parts that the page of a chapter has, in their order, and how much of it is prose and how much is printed.

use super::directive::{Directive, parse};
use super::lists::is_chapter;
use super::scan::{Scan, words_of};
use super::{Page, Problem};
use super::{lesson, listing};

/// What is folded at the end of a chapter's page, in this order, as far as the page has it.
pub const FOLDED: [&str; 7] = [
    "Answers",
    "How it breaks, and how it is made robust",
    "What it costs",
    "What was left out",
    "Columns in and out",
    "The whole chapter",
    lesson::SUMMARY,
];

/// The headings that every chapter has, in this order.
const HEADINGS: [&str; 4] = ["## A worked example", "## Your turn", "## Exercises", "## Further reading"];

/// Words in a line of prose, at the width of the book's column.
const WORDS_A_LINE: usize = 12;
/// Words that a reader reads in a minute.
const WORDS_A_MINUTE: usize = 200;

/// The page's lines, each with whether it is folded.
pub fn folded<'p>(scan: &'p Scan<'p>) -> impl Iterator<Item = (&'p super::scan::Line<'p>, bool)> {
    let mut depth = 0_usize;
    scan.lines.iter().map(move |line| {
        let text = line.text.trim_start();
        if line.fence.is_none() && text.starts_with("<details") {
            depth += 1;
        }
        let is_folded = depth > 0;
        if line.fence.is_none() && text.starts_with("</details") {
            depth = depth.saturating_sub(1);
        }
        (line, is_folded)
    })
}

/// How many words of prose stand on a page without unfolding anything.
pub fn visible_words(text: &str) -> usize {
    let scan = Scan::new(text);
    folded(&scan)
        .filter(|(line, is_folded)| line.fence.is_none() && !is_folded)
        .map(|(line, _)| words_of(line.text))
        .sum()
}

/// How much of a page is prose, and how much of it is printed in a monospaced font.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Measure {
    /// Words of prose: visible, and folded.
    pub words: [usize; 2],
    /// Monospaced lines: visible, and folded.
    pub monospaced: [usize; 2],
}

impl Measure {
    /// Measures a page; `printed` says how many lines a command prints.
    pub fn of(page: &Page, mut printed: impl FnMut(&str) -> usize) -> Self {
        let (scan, mut own) = (Scan::new(&page.text), Self::default());
        for (line, is_folded) in folded(&scan) {
            let at = usize::from(is_folded);
            match (parse(line.text), line.fence) {
                (Some(Ok(Directive::Include { path, anchor })), Some(_)) => {
                    own.monospaced[at] += listing::shown(page, path, anchor).map_or(0, |text| text.lines().count());
                }
                (Some(Ok(Directive::Pinhole { command })), None) => own.monospaced[at] += 1 + printed(command),
                (_, Some(_)) if !line.text.trim_start().starts_with("```") => own.monospaced[at] += 1,
                (None, None) => own.words[at] += words_of(line.text),
                _ => {}
            }
        }
        own
    }

    /// Lines of visible prose.
    pub fn lines(&self) -> usize {
        self.words[0] / WORDS_A_LINE
    }

    /// Minutes to read what is visible.
    pub fn minutes(&self) -> usize {
        self.words[0].div_ceil(WORDS_A_MINUTE)
    }
}

/// What the pages of chapters lack.
pub fn problems(all: &[Page]) -> Vec<Problem> {
    let stem = |page: &Page| page.name.trim_end_matches(".md").to_owned();
    let chapters = all.iter().filter(|page| is_chapter(&stem(page)) && stem(page) != "cover");
    chapters.flat_map(of_chapter).chain(lesson::problems(all)).collect()
}

fn of_chapter(page: &Page) -> Vec<Problem> {
    let (scan, mut problems) = (Scan::new(&page.text), Vec::new());
    let mut lacks = |what: &str| problems.push(Problem::new(&page.label, 0, what));
    let prose: Vec<&str> = scan.prose().map(|line| line.text).collect();
    let is_figure = |line: &&str| line.starts_with("{{#figure");
    let opening = prose.iter().take_while(|line| !is_figure(line) && !line.starts_with("##"));
    if words_of(&opening.skip(1).copied().collect::<Vec<_>>().join(" ")) < 8 {
        lacks("begins without a question: some sentences before its first picture and its first heading.");
    }
    if !prose.iter().any(is_figure) {
        lacks("has no picture: a line {{#figure command | caption}}.");
    }
    let at = |wanted: &str| prose.iter().position(|line| line.trim_end() == wanted);
    let places: Vec<Option<usize>> = HEADINGS.into_iter().map(at).collect();
    for (heading, _) in HEADINGS.into_iter().zip(&places).filter(|(_, place)| place.is_none()) {
        lacks(&format!("has no section `{heading}`."));
    }
    let summaries: Vec<&str> = prose
        .iter()
        .filter_map(|line| line.trim().strip_prefix("<summary>")?.strip_suffix("</summary>"))
        .filter(|summary| FOLDED.contains(summary))
        .collect();
    let in_order: Vec<&str> = FOLDED.into_iter().filter(|summary| summaries.contains(summary)).collect();
    if summaries != in_order || !places.iter().flatten().is_sorted() {
        lacks(&format!("has its parts in another order than {HEADINGS:?}, then folded {FOLDED:?}."));
    }
    for needed in ["Answers", "The whole chapter", "Columns in and out"] {
        if !summaries.contains(&needed) {
            lacks(&format!("has nothing folded under <summary>{needed}</summary>."));
        }
    }
    let [start, end] = [places[2].unwrap_or(0), places[3].unwrap_or(prose.len())];
    let number = |line: &&&str| line.split_once(". ").is_some_and(|(number, _)| number.parse::<u32>().is_ok());
    let exercises: Vec<&&str> = prose[start..end.max(start)].iter().filter(number).collect();
    let has_level = |line: &str| line.split_once(". ").is_some_and(|(_, text)| text.starts_with('★'));
    if exercises.is_empty() || !exercises.iter().all(|line| has_level(line)) {
        lacks("has an exercise without a level: `1. ★ …`, ★★ or ★★★, and at least one.");
    }
    let answers = prose.iter().filter(|line| line.trim_start().starts_with("**1")).count();
    let answered = |number: usize| prose.iter().any(|line| line.trim_start().starts_with(&format!("**{number}.**")));
    if answers == 0 || !(1..=exercises.len()).all(answered) {
        lacks("has an exercise without an answer: `**1.** …` among the answers, and so on.");
    }
    let reading = prose[places[3].unwrap_or(prose.len())..].iter().take_while(|line| !line.starts_with("<details"));
    if !reading.clone().any(|line| line.contains("](bibliography.md#") || line.contains("[@")) {
        lacks("cites nothing under `## Further reading`: write [@key].");
    }
    let text = page.text.as_str();
    if !(text.contains("--mine") && text.contains("check ")) {
        lacks("does not say how the reader's function is checked and rendered: `check N`, and `render N --mine`.");
    }
    problems
}

#[cfg(test)]
mod tests {
    use super::super::made_up;
    use super::*;

    const WHOLE: &str = "# A\n\nWhy is it so that one sees what one sees here?\n\n{{#figure render 1 | b}}\n\n\
        ## Idea\n\nWords.\n\n## A worked example\n\nOne.\n\n## Your turn\n\n`check 1`, `render 1 --mine`\n\n\
        ## Exercises\n\n1. ★ Do it.\n\n<details>\n<summary>Answers</summary>\n\n**1.** Done.\n\n</details>\n\n\
        ## Further reading\n\n[@a1]\n\n<details>\n<summary>Columns in and out</summary>\n\n| a |\n\n</details>\n\n\
        <details>\n<summary>The whole chapter</summary>\n\n```text\none\ntwo\n```\n\n</details>\n";

    #[test]
    fn a_whole_page_lacks_nothing_and_every_part_that_goes_is_missed() {
        let told = |text: &str| of_chapter(&made_up("01_a.md", text));
        assert_eq!(told(WHOLE), []);
        for part in [
            "Why is it so that one sees what one sees here?",
            "{{#figure render 1 | b}}",
            "## A worked example",
            "## Your turn",
            "## Exercises",
            "## Further reading",
            "★ ",
            "**1.** Done.",
            "[@a1]",
            " --mine",
            "<summary>Answers</summary>",
            "<summary>Columns in and out</summary>",
            "<summary>The whole chapter</summary>",
        ] {
            assert!(WHOLE.contains(part) && !told(&WHOLE.replace(part, "")).is_empty(), "{part}");
        }
        let turned = WHOLE.replace("Columns in and out", "x").replace("The whole chapter", "Columns in and out");
        assert!(!told(&turned.replace("<summary>x<", "<summary>The whole chapter<")).is_empty(), "in another order");
    }

    #[test]
    fn what_is_folded_is_counted_apart() {
        let measure = Measure::of(&made_up("01_a.md", WHOLE), |_| 7);
        assert_eq!(measure.monospaced, [0, 2]);
        assert_eq!(measure.words[1], 2);
        let printed = made_up("a.md", "{{#pinhole plan}}\n\n```text\none\n```\n");
        assert_eq!(Measure::of(&printed, |_| 7).monospaced, [9, 0]);
    }
}

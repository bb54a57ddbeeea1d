//! What of a page is folded, and how much of it is prose and how much is printed.

use super::directive::{Directive, parse};
use super::scan::{Scan, words_of};
use super::{Page, listing};

/// Words in a line of prose, at the width of the book's column.
const WORDS_A_LINE: usize = 12;

/// How the fold of a step begins, which holds what a reader types.
pub const STEP: &str = "<details class=\"step\">";

/// The page's lines, each with whether it is folded.
pub fn folded<'p>(scan: &'p Scan<'p>) -> impl Iterator<Item = (&'p super::scan::Line<'p>, bool)> {
    within(scan, |line| line.starts_with("<details"))
}

/// The page's lines, each with whether it is in a fold that who works through the page may leave shut.
pub fn unread<'p>(scan: &'p Scan<'p>) -> impl Iterator<Item = (&'p super::scan::Line<'p>, bool)> {
    within(scan, |line| line.starts_with("<details") && line != STEP)
}

fn within<'p>(
    scan: &'p Scan<'p>,
    opens: impl Fn(&str) -> bool + 'p,
) -> impl Iterator<Item = (&'p super::scan::Line<'p>, bool)> {
    let mut depth = 0_usize;
    scan.lines.iter().map(move |line| {
        let text = line.text.trim_start();
        if line.fence.is_none() && opens(text.trim_end()) {
            depth += 1;
        }
        let is_inside = depth > 0;
        if line.fence.is_none() && text.starts_with("</details") {
            depth = depth.saturating_sub(1);
        }
        (line, is_inside)
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
}

#[cfg(test)]
mod tests {
    use super::super::made_up;
    use super::*;

    const WHOLE: &str = "# A\n\nWords.\n\n<details>\n<summary>Answers</summary>\n\n**1.** Done.\n\n```text\none\ntwo\n```\n\n\
        </details>\n";

    #[test]
    fn what_is_folded_is_counted_apart() {
        let measure = Measure::of(&made_up("01_a.md", WHOLE), |_| 7);
        assert_eq!(measure.monospaced, [0, 2]);
        assert_eq!(measure.words[1], 2);
        let printed = made_up("a.md", "{{#pinhole plan}}\n\n```text\none\n```\n");
        assert_eq!(Measure::of(&printed, |_| 7).monospaced, [9, 0]);
    }
}

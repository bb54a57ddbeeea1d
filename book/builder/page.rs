//! The one preprocessor: a page as its author wrote it becomes the markdown that mdBook shows.

use crate::check::directive::{Directive, parse};
use crate::check::lesson::is_taught;
use crate::check::scan::{Fence, Scan};
use crate::check::work::Work;
use crate::check::{Page, Problem, fit, listing};
use crate::edit::{Edit, apply, escape};
use crate::figure::{self, Pictures};
use crate::handout::{Handout, Printer};
use crate::program::Program;
use crate::{exercises, index, math, print, slides, teaching};
use mdbook_preprocessor::book::Book;
use mdbook_preprocessor::errors::{Error, Result};
use mdbook_preprocessor::{Preprocessor, PreprocessorContext};
use std::cell::RefCell;
use std::rc::Rc;

/// Expands every page, and gathers the pictures they show.
pub struct Pages {
    /// The pages as read and checked before the build.
    pub written: Vec<Page>,
    /// Answers the commands.
    pub program: Rc<RefCell<Program>>,
    /// Filled by the run.
    pub pictures: Rc<RefCell<Pictures>>,
    /// Sheets and slides, filled by the run too, so that a mistake in them stops the build.
    pub handouts: Rc<RefCell<Vec<Handout>>>,
}

impl Pages {
    /// Sheets and slides of pages that were expanded already, with the names that the pictures have there.
    fn handed_out(
        &self,
        program: &mut Program,
        pictures: &Pictures,
    ) -> std::result::Result<Vec<Handout>, Vec<Problem>> {
        let mut printer = Printer { all: &self.written, program, pictures: &mut pictures.clone(), root: "" };
        let mut handouts = exercises::handouts(&mut printer)?;
        handouts.extend(slides::handouts(&mut printer)?);
        Ok(handouts)
    }
}

impl Preprocessor for Pages {
    fn name(&self) -> &str {
        "pinhole"
    }

    fn run(&self, _context: &PreprocessorContext, mut book: Book) -> Result<Book> {
        let (program, pictures) = (&mut self.program.borrow_mut(), &mut self.pictures.borrow_mut());
        let mut problems = Vec::new();
        book.for_each_chapter_mut(|chapter| {
            let name = chapter.source_path.as_ref().map(|path| path.display().to_string());
            let page = self.written.iter().find(|page| Some(&page.name) == name.as_ref());
            let expanded =
                page.map(|page| expand(page, &self.written, program, pictures).map(|content| timed(page, &content)));
            match expanded {
                Some(Ok(content)) => chapter.content = figure::with_drawings_apart(&content, pictures),
                Some(Err(found)) => problems.extend(found),
                None => {}
            }
        });
        if problems.is_empty() {
            match self.handed_out(program, pictures) {
                Ok(handouts) => self.handouts.replace(handouts),
                Err(found) => return Err(Error::msg(told(&found))),
            };
        }
        if problems.is_empty() { Ok(book) } else { Err(Error::msg(told(&problems))) }
    }
}

/// Problems as an author reads them, one a line.
pub fn told(problems: &[Problem]) -> String {
    problems.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n")
}

/// A page with its listings, formulas, outputs and figures in place, and with what it shows of `all` pages.
pub fn expand(
    page: &Page,
    all: &[Page],
    program: &mut Program,
    pictures: &mut Pictures,
) -> std::result::Result<String, Vec<Problem>> {
    let scan = Scan::new(&page.text);
    let (mut edits, mistakes) = math::edits(&without_directives(&page.text, &scan));
    let line_of = |at: usize| page.text[..at].matches('\n').count() + 1;
    let formulas = mistakes.into_iter().map(|mistake| Problem::new(&page.label, line_of(mistake.at), mistake.what));
    let mut problems: Vec<Problem> = formulas.collect();
    for line in &scan.lines {
        let made = match (parse(line.text), line.fence) {
            (Some(Ok(Directive::Pinhole { command })), None) => {
                program.text(command).map(|text| printed(command, &text))
            }
            (Some(Ok(Directive::Figure { command, caption, moves })), None) => {
                figure::block(program, pictures, command, caption, moves)
            }
            (Some(Ok(Directive::Include { path, anchor })), Some(_)) => {
                let margin = &line.text[..line.text.len() - line.text.trim_start().len()];
                listing::shown(page, path, anchor).map(|listing| indented(&listing, margin))
            }
            (Some(Ok(Directive::Course { part })), None) => teaching::part(part, all),
            (Some(Ok(Directive::Syllabus { text })), None) => teaching::syllabus(text, all),
            (Some(Ok(Directive::Index)), None) => index::made(all),
            (None, Some(fence)) if fit::is_wide(line.text) && is_output(&scan, fence) => Ok(fit::printed(line.text)),
            _ => continue,
        };
        match made {
            Ok(text) => edits.push(Edit { range: line.start..line.start + line.text.len(), text }),
            Err(what) => problems.push(Problem::new(&page.label, line.number, what)),
        }
    }
    edits.extend(scan.fences.iter().filter_map(|fence| source_label(&scan, fence)));
    problems.sort_by_key(|problem| problem.line);
    if problems.is_empty() { Ok(print::with_answers_named(&apply(&page.text, edits))) } else { Err(problems) }
}

/// Whether a fence is what a program says, and not what one copies: commands, and what stands in files.
fn is_output(scan: &Scan<'_>, fence: usize) -> bool {
    scan.fences.get(fence).is_some_and(|fence| ["", "text"].contains(&fence.info))
}

/// The text with its directive lines blanked byte for byte: a `$` in a command is no formula.
fn without_directives(text: &str, scan: &Scan<'_>) -> String {
    let directives = scan.prose().filter(|line| parse(line.text).is_some());
    let blank = |line: &crate::check::scan::Line<'_>| Edit {
        range: line.start..line.start + line.text.len(),
        text: " ".repeat(line.text.len()),
    };
    apply(text, directives.map(blank).collect())
}

/// The commands whose output one copies into a file: a line of it stays a line, and the window wraps it.
const COPIED: [&str; 1] = ["export"];

/// What a command prints as the page holds it, and whether it is there to be copied.
pub fn fitted(command: &str, text: &str) -> (String, bool) {
    let is_copied = command.split_whitespace().next().is_some_and(|word| COPIED.contains(&word));
    (if is_copied { text.to_owned() } else { fit::printed(text) }, is_copied)
}

/// What a command prints, under the command as a reader types it.
fn printed(command: &str, text: &str) -> String {
    let typed = figure::typed(command);
    let (copied, text) = if command.starts_with("extremes") {
        ("", tabled(text))
    } else {
        let (text, is_copied) = fitted(command, text);
        let longest = text.split(|letter| letter != '`').map(str::len).max().unwrap_or(0);
        let fence = "`".repeat(3.max(longest + 1));
        (if is_copied { " copied" } else { "" }, format!("\n{fence}text\n{text}\n{fence}\n\n"))
    };
    format!("\n<div class=\"printed{copied}\">\n<div class=\"typed\"><code>{typed}</code></div>\n{text}</div>\n")
}

/// What `extremes` prints as a table: its columns are parted by two spaces or more, its cases and notes have none.
fn tabled(text: &str) -> String {
    let mut out = String::from("<div class=\"table-wrapper\"><table class=\"extremes\">\n");
    for line in text.lines().filter(|line| !line.trim().is_empty()) {
        let cells: Vec<String> = line.split("  ").map(str::trim).filter(|cell| !cell.is_empty()).map(escape).collect();
        let spread = |cells: [&str; 5], tag: &str| cells.map(|cell| format!("<{tag}>{cell}</{tag}>")).concat();
        let row = match cells.iter().map(String::as_str).collect::<Vec<_>>()[..] {
            [unit, wrong, worst, asked] if wrong == "wrong" => spread([unit, wrong, worst, "", asked], "th"),
            [method, wrong, worst, held, asked] => spread([method, wrong, worst, held, asked], "td"),
            [method, wrong, held, asked] => spread([method, wrong, "", held, asked], "td"),
            _ if line.starts_with(' ') => format!("<td colspan=\"5\">{}</td>", cells.join(" ")),
            _ => format!("<th colspan=\"5\">{}</th>", cells.join(" ")),
        };
        out += &format!("<tr>{row}</tr>\n");
    }
    out + "</table></div>\n"
}

/// A page that says under its title how long it takes, if it is one to learn from.
fn timed(page: &Page, content: &str) -> String {
    match content.split_once('\n').filter(|_| is_taught(&page.name)) {
        Some((title, rest)) => {
            format!("{title}\n\n<p class=\"minutes\">{}</p>\n{rest}", Work::of(page).at_a_glance())
        }
        None => content.to_owned(),
    }
}

fn indented(listing: &str, margin: &str) -> String {
    let lines: Vec<String> = listing.lines().map(|line| format!("{margin}{line}")).collect();
    lines.join("\n")
}

/// A small line above a listing that says which file it is from.
fn source_label(scan: &Scan<'_>, fence: &Fence<'_>) -> Option<Edit> {
    let includes = listing::includes(scan, fence)?;
    let Some(Directive::Include { path, .. }) = includes.first() else {
        return None;
    };
    let opening = scan.lines.get(fence.first)?;
    let margin = &opening.text[..opening.text.len() - opening.text.trim_start().len()];
    let label = escape(&listing::label(path));
    let text = format!("\n{margin}<div class=\"source\">{label}</div>\n\n");
    Some(Edit { range: opening.start..opening.start, text })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check::made_up;

    fn expanded(text: &str) -> std::result::Result<String, Vec<String>> {
        let program = Program::with(|words, out| match words[0].as_str() {
            "plan" => writeln!(out, "```\nkept <b> & $x$\n```").map_err(|error| error.to_string()),
            _ => Err("no such command.".to_owned()),
        });
        let expanded = expand(&made_up("a.md", text), &[], &mut program.borrow_mut(), &mut Pictures::default());
        expanded.map_err(|problems| problems.iter().map(ToString::to_string).collect())
    }

    #[test]
    fn a_page_to_learn_from_says_how_long_it_takes() {
        let page = made_up("02_b.md", "# B\n\nWhy?\n");
        assert_eq!(timed(&page, &page.text), "# B\n\n<p class=\"minutes\">About 0 minutes.</p>\n\nWhy?\n");
        let page = made_up("glossary.md", "# G\n\nTerms.\n");
        assert_eq!(timed(&page, &page.text), page.text);
    }

    #[test]
    fn output_stands_under_its_command() {
        let text = expanded("a\n\n{{#pinhole plan 05 --a<b}}\n\nb $\n".trim_end_matches(" $\n")).expect("expands");
        let expected = "<span>plan</span> <span>05</span> <span>--a&lt;b</span></code></div>\n\n\
                        ````text\n```\nkept <b> & $x$\n```\n````\n\n</div>";
        assert!(text.contains(expected), "{text}");
        assert!(text.starts_with("a\n\n") && text.ends_with("\n\nb"), "{text}");
    }

    /// Comments and strings of a scene, commands, and what stands in files are copied from the page: each of their lines is
    /// one there, too, while what a program only says is broken.
    #[test]
    fn what_is_copied_has_the_lines_of_the_file() {
        let comment = format!("// A scene{}", " of words".repeat(20));
        let scene = format!("{comment}\n[\n    (name: \"a{}\"),\n]", " word".repeat(30));
        let kept = scene.clone();
        let program = Program::with(move |_, out| writeln!(out, "{kept}").map_err(|error| error.to_string()));
        let page = |text: &str| {
            let (page, mut pictures) = (made_up("a.md", text), Pictures::default());
            expand(&page, &[], &mut program.borrow_mut(), &mut pictures).expect("expands")
        };
        assert!(page("{{#pinhole export 05 --all}}\n").contains(&format!("```text\n{scene}\n```")));
        assert!(!page("{{#pinhole plan 05}}\n").contains(&comment));
        for (language, is_broken) in [("sh", false), ("ron", false), ("toml", false), ("text", true)] {
            let text = format!("```{language}\n{comment}\n```\n");
            assert_eq!(page(&text) != text, is_broken, "{language}");
        }
    }

    #[test]
    fn a_table_is_one() {
        let table = tabled(
            "all: rays\n  u = 2^-24     wrong   worst error    asked\na case: 5 tried\n  pinhole, t < 1   0   0.6 u  held   ≤ 4\n  \
                            naive   0     held   0 wrong\n\n    a note\nheld: 1 of 1 cases",
        );
        for row in [
            "<tr><th colspan=\"5\">a case: 5 tried</th></tr>",
            "<tr><th>u = 2^-24</th><th>wrong</th><th>worst error</th><th></th><th>asked</th></tr>",
            "<tr><td>pinhole, t &lt; 1</td><td>0</td><td>0.6 u</td><td>held</td><td>≤ 4</td></tr>",
            "<tr><td>naive</td><td>0</td><td></td><td>held</td><td>0 wrong</td></tr>",
            "<tr><td colspan=\"5\">a note</td></tr>",
        ] {
            assert!(table.contains(row), "{table}");
        }
        assert!(!table.contains("\n\n"), "a blank line would end the HTML in markdown");
    }

    #[test]
    fn a_listing_is_labelled_and_indented_as_its_fence() {
        let text = expanded("- a\n\n  ```toml\n  {{#include Cargo.toml}}\n  ```\n").expect("expands");
        assert!(text.contains("  <div class=\"source\">Cargo.toml</div>\n\n  ```toml\n  [package]\n  name"), "{text}");
    }

    #[test]
    fn every_mistake_of_a_page_is_named_at_once() {
        let told = expanded("$\\oops$\n\n{{#pinhole plan}}\n\n{{#pinhole nothing}}\n\n{{#figure plan | $\\oops$}}\n");
        let told = told.expect_err("mistakes");
        assert_eq!(told.len(), 3);
        assert!(told[0].starts_with("a.md:1: the formula `\\oops` cannot be read"), "{told:?}");
        assert_eq!(told[1], "a.md:5: `nothing` failed: no such command.");
        assert_eq!(told[2], "a.md:7: `plan` wrote no .png file when told where with `-o`.");
    }
}

//! A set of slides for each chapter, made from its page: what a class looks at together.

use crate::check::directive::{Directive, parse};
use crate::check::lesson::{self, taught};
use crate::check::parts::{Section, section, sections, signature};
use crate::check::scan::Scan;
use crate::check::{Page, Problem};
use crate::edit::escape;
use crate::handout::{Handout, Printer, whole};

const STYLE: &str = concat!(include_str!("handout.css"), include_str!("slides.css"));
const SCRIPT: &str = include_str!("slides.js");

/// Sections that are no part of the derivation: each has slides of its own, or none.
const APART: [&str; 4] = ["A worked example", "Your turn", "Exercises", "Further reading"];

/// How many letters a line of large code has room for.
const WIDE: usize = 72;
/// The most lines of code that are shown in large letters, and in those of middle size.
const LARGE: usize = 12;
const MIDDLE: usize = 20;

/// The most formulas on a slide.
const FORMULAS: usize = 3;

/// One slide.
#[derive(Debug, Clone, PartialEq, Eq)]
struct Slide {
    heading: String,
    /// In markdown.
    body: String,
}

impl Slide {
    fn new(heading: &str, body: impl Into<String>) -> Self {
        Self { heading: heading.to_owned(), body: body.into() }
    }
}

/// The slides of every chapter, and the page that lists them.
///
/// Errors: those of the pages.
pub fn handouts(printer: &mut Printer<'_>) -> Result<Vec<Handout>, Vec<Problem>> {
    printer.root = "../";
    let mut handouts = Vec::new();
    let mut index = String::from(
        "<main class=\"index\">\n<h1>Slides</h1>\n<p>Arrow keys go from slide to slide. \
         Printed, each slide is a page.</p>\n<ul>\n",
    );
    for (page, title) in taught(printer.all) {
        let path = file_of(&page.name);
        let mut body = String::from("<main>\n");
        for (at, slide) in slides(page, title)?.iter().enumerate() {
            body += &drawn(printer, page, slide, at)?;
        }
        index += &format!("<li><a href=\"{path}\">{}</a></li>\n", escape(title));
        handouts.push(whole(
            &format!("slides/{path}"),
            &format!("{title} – pinhole"),
            STYLE,
            SCRIPT,
            &(body + "</main>\n"),
        ));
    }
    index += "</ul>\n<p><a href=\"../teaching.html\">For teachers</a></p>\n</main>\n";
    handouts.push(whole("slides/index.html", "Slides – pinhole", STYLE, "", &index));
    Ok(handouts)
}

/// The file of a chapter's slides: `06.html`.
fn file_of(name: &str) -> String {
    let stem = name.trim_end_matches(".md");
    let number = stem.split('_').next().filter(|number| number.bytes().all(|letter| letter.is_ascii_digit()));
    format!("{}.html", number.unwrap_or(stem))
}

/// What is shown of a page, in its order.
fn slides(page: &Page, title: &str) -> Result<Vec<Slide>, Vec<Problem>> {
    let all = sections(page);
    let mut slides = Vec::new();
    for (at, one) in all.iter().enumerate().filter(|(_, one)| !APART.contains(&one.heading.as_str())) {
        if at == 0 {
            slides.push(Slide::new(title, opening(&one.text)));
        }
        slides.extend(derived(one, if at == 0 { title } else { &one.heading }));
    }
    if let Some(example) = section(page, APART[0]) {
        let (question, answer) = example.trim().split_once("\n\n").unwrap_or((example.trim(), ""));
        slides.push(Slide::new(APART[0], question));
        slides.push(Slide::new(APART[0], without_figures(answer)));
    }
    if let Some(turn) = section(page, APART[1]) {
        let signature = signature(page).map_err(|what| vec![Problem::new(&page.label, 0, what)])?;
        let code = signature.map_or_else(String::new, |signature| format!("\n\n```rust\n{signature}\n```\n"));
        let question = turn.trim().split("\n\n").next().unwrap_or_default();
        slides.push(Slide::new(APART[1], format!("{question}{code}")));
    }
    if let Ok(lesson) = lesson::read(page) {
        let goals: Vec<String> = lesson.goals.iter().map(|goal| format!("- {goal}")).collect();
        slides.push(Slide::new(lesson::SUMMARY, goals.join("\n")));
    }
    slides.retain(|slide| !slide.body.trim().is_empty());
    Ok(slides)
}

/// The words before the first picture.
fn opening(text: &str) -> String {
    let is_prose = |line: &&str| !line.starts_with("{{#") && !line.starts_with('<');
    text.trim().lines().take_while(is_prose).collect::<Vec<_>>().join("\n")
}

fn without_figures(text: &str) -> String {
    let is_figure = |line: &str| matches!(parse(line), Some(Ok(Directive::Figure { .. })));
    text.lines().filter(|line| !is_figure(line)).collect::<Vec<_>>().join("\n")
}

/// The figures, the displayed formulas and the code of a section, each as a slide; formulas stand together.
fn derived(section: &Section, heading: &str) -> Vec<Slide> {
    let scan = Scan::new(&section.text);
    let (mut slides, mut formulas): (Vec<Slide>, Vec<String>) = (Vec::new(), Vec::new());
    let mut open: Option<String> = None;
    let close = |formulas: &mut Vec<String>, slides: &mut Vec<Slide>| {
        slides.extend(formulas.chunks(FORMULAS).map(|some| Slide::new(heading, some.join("\n\n"))));
        formulas.clear();
    };
    for line in &scan.lines {
        if let Some(fence) = line.fence.map(|fence| &scan.fences[fence]) {
            let is_first = line.number == fence.first + 1;
            if is_first && fence.info == "rust" {
                close(&mut formulas, &mut slides);
                let code: Vec<&str> = scan.body(fence).iter().map(|line| line.text).collect();
                slides.push(Slide::new(heading, format!("```rust\n{}\n```\n", code.join("\n"))));
            }
            continue;
        }
        if matches!(parse(line.text), Some(Ok(Directive::Figure { .. }))) {
            close(&mut formulas, &mut slides);
            slides.push(Slide::new(heading, line.text));
        }
        let marks = line.text.matches("$$").count();
        match (&mut open, marks) {
            (None, 0) => {}
            (None, 1) => open = Some(line.text.to_owned()),
            (None, _) => formulas.push(line.text.trim().to_owned()),
            (Some(formula), _) => {
                *formula += &format!("\n{}", line.text);
                if marks > 0 {
                    formulas.extend(open.take());
                }
            }
        }
    }
    close(&mut formulas, &mut slides);
    slides
}

fn drawn(printer: &mut Printer<'_>, page: &Page, slide: &Slide, at: usize) -> Result<String, Vec<Problem>> {
    let heading = printer.heading(page, &slide.heading)?;
    let body = printer.html(page, &slide.body)?;
    let (level, class) = if at == 0 { ("h1", "title") } else { ("h2", size(&body)) };
    Ok(format!(
        "<section class=\"{class}\">\n<{level}>{heading}</{level}>\n<div class=\"body\">\n{body}</div>\n</section>\n"
    ))
}

/// How large the letters of a slide are.
fn size(html: &str) -> &'static str {
    let code = html.split("<pre>").nth(1).and_then(|rest| rest.split("</pre>").next());
    let lines = code.map_or(0, |code| code.lines().count());
    let is_wide = code.is_some_and(|code| code.lines().any(|line| letters(line) > WIDE));
    let words = html.split("<p>").skip(1).filter_map(|rest| rest.split("</p>").next());
    let words: usize = words.map(|words| words.split_whitespace().count()).sum();
    match (lines, words) {
        (0..=LARGE, 0..=90) if !is_wide => "large",
        (0..=MIDDLE, 0..=180) => "middle",
        _ => "small",
    }
}

/// How many letters a line shows, of which entities stand for one and tags for none.
fn letters(line: &str) -> usize {
    let mut open: Option<char> = None;
    let shown = line.chars().filter(|&letter| match (open, letter) {
        (None, '<' | '&') => {
            open = Some(if letter == '<' { '>' } else { ';' });
            letter == '&'
        }
        (Some(end), _) => {
            open = open.filter(|_| letter != end);
            false
        }
        (None, _) => true,
    });
    shown.count()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::build::tests::little_program;
    use crate::check::made_up;
    use crate::figure::Pictures;

    const PAGE: &str = "# A\n\nWhy?\n\n{{#figure render 1 | A box}}\n\n## Idea\n\nSo:\n\n$$a$$\n\nand\n\n$$\nb\n$$\n\n\
        ```rust\nfn a() {}\n```\n\n```text\nno\n```\n\n## A worked example\n\nHow much?\n\nMuch.\n\n\
        ## Your turn\n\nWrite it.\n\nThen check.\n\n## Exercises\n\n1. ★ No.\n";

    #[test]
    fn slides_follow_the_page() {
        let slides = slides(&made_up("07_a.md", PAGE), "7. A").expect("slides");
        let told: Vec<(&str, &str)> = slides.iter().map(|slide| (slide.heading.as_str(), slide.body.trim())).collect();
        let expected = [
            ("7. A", "Why?"),
            ("7. A", "{{#figure render 1 | A box}}"),
            ("Idea", "$$a$$\n\n$$\nb\n$$"),
            ("Idea", "```rust\nfn a() {}\n```"),
            ("A worked example", "How much?"),
            ("A worked example", "Much."),
            ("Your turn", "Write it."),
        ];
        assert_eq!(told, expected);
    }

    #[test]
    fn a_set_has_a_page_and_figures_are_those_of_the_book() {
        let all = [made_up("SUMMARY.md", "- [7. A](07_a.md)\n"), made_up("07_a.md", PAGE)];
        let (program, mut pictures) = (little_program(), Pictures::default());
        let mut program = program.borrow_mut();
        let mut printer = Printer { all: &all, program: &mut program, pictures: &mut pictures, root: "" };
        let handouts = handouts(&mut printer).expect("slides");
        let paths: Vec<String> = handouts.iter().map(|handout| handout.path.display().to_string()).collect();
        assert_eq!(paths, ["slides/07.html", "slides/index.html"]);
        let html = &handouts[0].html;
        assert!(html.contains("src=\"../figures/render-1.png\"") && html.contains("<h1>7. A</h1>"), "{html}");
        assert_eq!(html.matches("<section").count(), 7);
        assert_eq!(file_of("monte_carlo.md"), "monte_carlo.html");
    }
}

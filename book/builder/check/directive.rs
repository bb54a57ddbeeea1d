//! The directives a page may use, each alone on its line.

use super::movement;
use super::scan::{Scan, blank_spans};
use super::{Page, Problem};

/// What one line of a page asks the builder for.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Directive<'a> {
    /// `{{#include file:anchor}}`: a listing from compiled source.
    Include {
        /// The file, relative to the page.
        path: &'a str,
        /// The part of it, or the whole file.
        anchor: Option<&'a str>,
    },
    /// `{{#pinhole command}}`: what a command of pinhole prints.
    Pinhole {
        /// The command's words.
        command: &'a str,
    },
    /// `{{#figure command | caption}}`: a picture that a command of pinhole draws; a third part names values to move.
    Figure {
        /// The command's words.
        command: &'a str,
        /// Its caption, in markdown.
        caption: &'a str,
        /// What a reader of the served book moves, or nothing.
        moves: &'a str,
    },
    /// `{{#course part}}`: something that is made from what the chapters' pages say of themselves.
    Course {
        /// What of it.
        part: Part,
    },
    /// `{{#syllabus time | chapters: result}}`: a path through the book, read by [`super::syllabus`].
    Syllabus {
        /// Everything behind the name.
        text: &'a str,
    },
    /// `{{#index}}`: every term of the glossary, and where it stands.
    Index,
}

/// What a page may show of the course.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Part {
    /// A drawing of which chapter builds on which.
    Graph,
    /// A table of which later chapters need each one.
    Needed,
    /// A table of goals and minutes.
    Goals,
    /// The rates by which the minutes are counted.
    Rates,
    /// A table of the paths that `{{#syllabus}}` declares.
    Paths,
}

const PARTS: [(&str, Part); 5] = [
    ("graph", Part::Graph),
    ("needed", Part::Needed),
    ("goals", Part::Goals),
    ("rates", Part::Rates),
    ("paths", Part::Paths),
];

const ACCEPTED: &str = "a page may use {{#include file:anchor}}, {{#pinhole command}}, \
    {{#figure command | caption}}, {{#course part}}, {{#syllabus time | chapters: result}} and {{#index}}";

/// Reads a line: no directive at all, a good one, or one sentence about a bad one.
pub fn parse(line: &str) -> Option<Result<Directive<'_>, String>> {
    if !line.contains('{') || !blank_spans(line).contains("{{#") {
        return None;
    }
    let alone = line.trim().strip_prefix("{{#").and_then(|rest| rest.strip_suffix("}}"));
    let Some(inside) = alone.filter(|inside| !inside.contains("}}")) else {
        return Some(Err(format!("a directive stands alone on its line, and `{}` does not.", line.trim())));
    };
    let (name, rest) = inside.split_once(char::is_whitespace).unwrap_or((inside, ""));
    Some(match (name, rest.trim()) {
        ("include", rest) => include(rest),
        ("pinhole", "") => Err("{{#pinhole}} names no command: write {{#pinhole plan 05_pinhole}}.".to_owned()),
        ("pinhole", command) => words(command).map(|command| Directive::Pinhole { command }),
        ("figure", rest) => figure(rest),
        ("course", rest) => course(rest),
        ("syllabus", text) => Ok(Directive::Syllabus { text }),
        ("index", "") => Ok(Directive::Index),
        _ => Err(format!("there is no directive {{{{#{name}}}}}: {ACCEPTED}.")),
    })
}

fn include(rest: &str) -> Result<Directive<'_>, String> {
    let (path, anchor) = match rest.split_once(':') {
        Some((path, anchor)) => (path, Some(anchor)),
        None => (rest, None),
    };
    let named = |name: &str| name.chars().all(|letter| letter.is_alphanumeric() || letter == '_');
    let counted = |name: &str| name.chars().all(|letter| letter.is_ascii_digit());
    match anchor {
        _ if path.is_empty() => Err("{{#include}} names no file: write {{#include ../../src/file.rs:anchor}}.".into()),
        Some(name) if !named(name) || counted(name) => {
            Err(format!("`{name}` is no anchor: name one, as line numbers change ({{{{#include {path}:name}}}})."))
        }
        anchor => Ok(Directive::Include { path, anchor }),
    }
}

fn figure(rest: &str) -> Result<Directive<'_>, String> {
    let (command, rest) = rest.split_once('|').unwrap_or((rest, ""));
    let (caption, moves) = rest.split_once(" | ").unwrap_or((rest, ""));
    if !moves.is_empty() {
        movement::read(moves)?;
        let renders = command.trim().starts_with("render ");
        renders
            .then_some(())
            .ok_or_else(|| format!("`{}` renders no chapter, so no value of it moves.", command.trim()))?;
    }
    match (command.trim(), caption.trim()) {
        ("", _) => Err("{{#figure}} names no command: write {{#figure render 05_pinhole | caption}}.".to_owned()),
        (command, "") => Err(format!("the figure `{command}` has no caption: write it after a `|`.")),
        (command, caption) => words(command).map(|command| Directive::Figure { command, caption, moves }),
    }
}

fn course(rest: &str) -> Result<Directive<'_>, String> {
    let found = PARTS.into_iter().find(|(name, _)| *name == rest);
    let names = PARTS.map(|(name, _)| format!("{{{{#course {name}}}}}")).join(", ");
    found
        .map(|(_, part)| Directive::Course { part })
        .ok_or_else(|| format!("there is no `{rest}` of the course: a page may use {names}."))
}

/// A command is words between spaces, or between quotes, as a shell reads them.
fn words(command: &str) -> Result<&str, String> {
    let is_whole = shlex::split(command).is_some();
    if is_whole { Ok(command) } else { Err(format!("`{command}` has a quote that does not end.")) }
}

/// Bad directives, directives in running text, and pictures that no directive made.
pub fn problems(page: &Page) -> Vec<Problem> {
    let scan = Scan::new(&page.text);
    let mut problems = Vec::new();
    for line in scan.prose() {
        match parse(line.text) {
            Some(Ok(Directive::Include { path, .. })) => {
                let what = format!("the include of `{path}` stands outside a code fence: put ```rust around it.");
                problems.push(Problem::new(&page.label, line.number, what));
            }
            Some(Ok(_)) => {}
            Some(Err(what)) => problems.push(Problem::new(&page.label, line.number, what)),
            None => problems.extend(raw_image(page, line.number, line.text)),
        }
    }
    problems
}

fn raw_image(page: &Page, number: usize, line: &str) -> Option<Problem> {
    let prose = blank_spans(line);
    let found = ["![", "<img", "<svg", "<picture"].into_iter().find(|mark| prose.contains(mark))?;
    let what = format!("`{found}` puts in a picture by hand: draw it with {{{{#figure command | caption}}}}.");
    Some(Problem::new(&page.label, number, what))
}

#[cfg(test)]
mod tests {
    use super::super::made_up;
    use super::*;

    fn sentence(line: &str) -> String {
        parse(line).expect("a directive").expect_err("a bad one")
    }

    #[test]
    fn good_directives_are_read() {
        let include = Directive::Include { path: "../a.rs", anchor: Some("b") };
        assert_eq!(parse("  {{#include ../a.rs:b}}"), Some(Ok(include)));
        assert_eq!(parse("{{#pinhole plan 05_pinhole}}"), Some(Ok(Directive::Pinhole { command: "plan 05_pinhole" })));
        let figure = Directive::Figure { command: "render 05 --size 4x3", caption: "A *box* of |x|", moves: "" };
        assert_eq!(parse("{{#figure render 05 --size 4x3 | A *box* of |x|}}"), Some(Ok(figure)));
        let moves = "fov: camera.lens.fov from 5 to 9";
        let figure = Directive::Figure { command: "render 05", caption: "A box", moves };
        assert_eq!(parse(&format!("{{{{#figure render 05 | A box | {moves}}}}}")), Some(Ok(figure)));
        assert_eq!(parse("{{#course goals}}"), Some(Ok(Directive::Course { part: Part::Goals })));
        assert_eq!(parse("{{#syllabus a | 1: b}}"), Some(Ok(Directive::Syllabus { text: "a | 1: b" })));
        assert_eq!(parse("prose with `{{#pinhole x}}` in code, or \\{{#pinhole x}}"), None);
    }

    #[test]
    fn bad_directives_say_what_is_accepted() {
        assert_eq!(sentence("{{#figure render 05}}"), "the figure `render 05` has no caption: write it after a `|`.");
        assert!(sentence("{{#figure render 05 | A box | fov 5}}").starts_with("`fov 5` is none: a movement is `LABEL"));
        let drawn = sentence("{{#figure figure 05 | A box | fov: a.b.c from 5 to 9}}");
        assert_eq!(drawn, "`figure 05` renders no chapter, so no value of it moves.");
        assert!(sentence("{{#figrue render 05}}").starts_with("there is no directive {{#figrue}}: a page may use"));
        assert!(sentence("See {{#pinhole plan}} here.").starts_with("a directive stands alone on its line"));
        assert!(sentence("{{#include ../a.rs:3:9}}").starts_with("`3:9` is no anchor: name one"));
        assert!(sentence("{{#include }}").starts_with("{{#include}} names no file"));
        assert!(
            sentence("{{#course map}}")
                .starts_with("there is no `map` of the course: a page may use {{#course graph}}")
        );
        assert!(sentence("{{#pinhole }}").starts_with("{{#pinhole}} names no command"));
        assert!(sentence("{{#pinhole trace \"a b}}").ends_with("has a quote that does not end."));
    }

    #[test]
    fn a_raw_image_is_refused() {
        let found = problems(&made_up("a.md", "text\n\n![a box](box.png)\n`![code]`\n"));
        let what = "`![` puts in a picture by hand: draw it with {{#figure command | caption}}.";
        assert_eq!(found, [Problem::new("a.md", 3, what)]);
    }

    #[test]
    fn an_include_belongs_in_a_fence() {
        let found = problems(&made_up("a.md", "{{#include ../a.rs:b}}\n"));
        assert!(found[0].what.ends_with("stands outside a code fence: put ```rust around it."));
    }
}

//! The exercises of all chapters on paper: once to be handed out, and once with their answers.

use crate::check::lesson::{short, taught};
use crate::check::parts::{Exercise, exercises, signature};
use crate::check::{Page, Problem};
use crate::edit::escape;
use crate::handout::{Handout, Printer, whole};
use std::fmt::Write;

/// The look of both.
const STYLE: &str = concat!(include_str!("handout.css"), include_str!("exercises.css"));

/// The sheet without answers, and the one with them.
///
/// Errors: those of the pages.
pub fn handouts(printer: &mut Printer<'_>) -> Result<Vec<Handout>, Vec<Problem>> {
    printer.root = "";
    Ok(vec![sheet(printer, false)?, sheet(printer, true)?])
}

fn sheet(printer: &mut Printer<'_>, with_answers: bool) -> Result<Handout, Vec<Problem>> {
    let (path, title) = if with_answers { ("answers.html", "Answers") } else { ("exercises.html", "Exercises") };
    let mut body = format!("<main>\n<h1>{title}</h1>\n{}", opening(with_answers));
    for (page, title) in taught(printer.all) {
        body += &chapter(printer, page, title, with_answers)?;
    }
    Ok(whole(path, &format!("{title} – pinhole"), STYLE, "", &(body + "</main>\n")))
}

fn opening(with_answers: bool) -> &'static str {
    if with_answers {
        "<p>Every exercise of the pinhole book with its answer. The sheet without answers is <a href=\"exercises.html\">\
         exercises.html</a>; what each chapter is about stands on <a href=\"index.html\">its page</a>.</p>\n"
    } else {
        "<p>Every exercise of the <a href=\"index.html\">pinhole book</a>: ★ takes about five minutes, ★★ a quarter of \
         an hour, ★★★ an hour or so. Commands are typed at the top of the repository.</p>\n\
         <p class=\"name\">Name:</p>\n"
    }
}

fn chapter(printer: &mut Printer<'_>, page: &Page, title: &str, with_answers: bool) -> Result<String, Vec<Problem>> {
    let (before, exercises) = exercises(page);
    if exercises.is_empty() {
        return Ok(String::new());
    }
    let mut out = format!("<section>\n<h2>{}</h2>\n", escape(title));
    let signature = signature(page).map_err(|what| vec![Problem::new(&page.label, 0, what)])?;
    if let Some(signature) = signature.filter(|_| !with_answers) {
        out += "<p>The function to write:</p>\n";
        let _ = write!(out, "<pre><code>{}</code></pre>\n<div class=\"room code\"></div>\n", escape(&signature));
    }
    out += &printer.html(page, &before)?;
    for exercise in &exercises {
        out += &asked(printer, page, exercise, with_answers)?;
    }
    Ok(out + "</section>\n")
}

/// An exercise, and its answer or room for one.
fn asked(
    printer: &mut Printer<'_>,
    page: &Page,
    exercise: &Exercise,
    with_answer: bool,
) -> Result<String, Vec<Problem>> {
    let Exercise { number, level, text, answer } = exercise;
    let asked = printer.html(page, &format!("**{}.{number}** {level} {text}", short(&page.name)))?;
    let below = if with_answer {
        format!("<div class=\"answer\">\n{}</div>\n", printer.html(page, answer)?)
    } else {
        format!("<div class=\"room level{}\"></div>\n", level.chars().count())
    };
    Ok(format!("<div class=\"exercise\">\n{asked}</div>\n{below}"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::build::tests::little_program;
    use crate::check::made_up;
    use crate::figure::Pictures;

    #[test]
    fn answers_stand_on_one_sheet_only() {
        let page = "# A\n\n## Exercises\n\n1. ★★ Which $x$?\n\n<details>\n<summary>Answers</summary>\n\n**1.** This.\n\n</details>\n";
        let all = [made_up("SUMMARY.md", "- [7. Seven](07_a.md)\n"), made_up("07_a.md", page)];
        let (program, mut pictures) = (little_program(), Pictures::default());
        let mut program = program.borrow_mut();
        let mut printer = Printer { all: &all, program: &mut program, pictures: &mut pictures, root: "" };
        let sheets = handouts(&mut printer).expect("two sheets");
        let [sheet, answers] = sheets.as_slice() else { panic!("two sheets") };
        for sheet in [sheet, answers] {
            assert!(
                sheet.html.contains("<h2>7. Seven</h2>")
                    && sheet.html.contains("<strong>7.1</strong> ★★ Which <span class=\"whole\"><math")
            );
        }
        assert!(sheet.html.contains("class=\"room level2\"") && !sheet.html.contains("This."));
        assert!(answers.html.contains("<p>This.</p>") && !answers.html.contains("class=\"room"));
    }
}

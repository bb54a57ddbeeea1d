//! Pages to be printed or shown that stand beside the site, without its navigation: plain HTML made from the chapters.

use crate::check::directive::{Directive, parse};
use crate::check::{Page, Problem};
use crate::edit::{Edit, apply, escape};
use crate::figure::Pictures;
use crate::page::expand;
use crate::program::Program;
use pulldown_cmark::{CowStr, Event, Options, Parser, Tag, html};
use std::path::PathBuf;

/// One such page.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Handout {
    /// Where it lies in the built book.
    pub path: PathBuf,
    /// The whole page.
    pub html: String,
}

/// What stands for the sheet of the formulas' font until its name is known.
pub const FONTS: &str = "FONTS.css";

/// A whole page around its body; `root` leads from it to the built book.
pub fn whole(path: &str, title: &str, style: &str, script: &str, body: &str) -> Handout {
    let root = if path.contains('/') { "../" } else { "" };
    let script = if script.is_empty() { String::new() } else { format!("<script>\n{script}</script>\n") };
    let html = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"UTF-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{}</title>\n\
         <link rel=\"stylesheet\" href=\"{root}fonts/{FONTS}\">\n<style>\n{style}</style>\n</head>\n<body>\n\
         {body}{script}</body>\n</html>\n",
        escape(title)
    );
    Handout { path: PathBuf::from(path), html }
}

/// Makes HTML of parts of pages.
pub struct Printer<'a> {
    /// All pages, for what a part may ask of them.
    pub all: &'a [Page],
    /// Answers the commands.
    pub program: &'a mut Program,
    /// The pictures of the site, which have their names already.
    pub pictures: &'a mut Pictures,
    /// What leads from the page that is made to the built book.
    pub root: &'static str,
}

impl Printer<'_> {
    /// A part of a page as HTML: formulas, listings, outputs and pictures in place, links led to the site.
    ///
    /// Errors: those of the page itself.
    pub fn html(&mut self, page: &Page, markdown: &str) -> Result<String, Vec<Problem>> {
        let part = Page { text: at_rest(markdown), ..page.clone() };
        let text = expand(&part, self.all, self.program, self.pictures)?;
        let options = Options::ENABLE_TABLES | Options::ENABLE_STRIKETHROUGH | Options::ENABLE_SMART_PUNCTUATION;
        let events = Parser::new_ext(&text, options).map(|event| match event {
            Event::Start(Tag::Link { link_type, dest_url, title, id }) => {
                Event::Start(Tag::Link { link_type, dest_url: self.led(page, &dest_url).into(), title, id })
            }
            other => other,
        });
        let mut out = String::new();
        html::push_html(&mut out, events);
        Ok(out.replace("src=\"figures/", &format!("src=\"{}figures/", self.root)))
    }

    /// A heading as HTML, without its tag; `7. A` begins no list.
    pub fn heading(&mut self, page: &Page, markdown: &str) -> Result<String, Vec<Problem>> {
        let html = self.html(page, &format!("# {markdown}"))?;
        Ok(html.trim().trim_start_matches("<h1>").trim_end_matches("</h1>").to_owned())
    }

    /// Where a link leads from the page that is made.
    fn led(&self, page: &Page, target: &CowStr<'_>) -> String {
        let (file, id) = target.split_once('#').map_or((target.as_ref(), ""), |(file, id)| (file, id));
        let file = if file.is_empty() { page.name.as_str() } else { file };
        match file.strip_suffix(".md").filter(|_| !target.contains("://")) {
            Some(stem) if id.is_empty() => format!("{}{stem}.html", self.root),
            Some(stem) => format!("{}{stem}.html#{id}", self.root),
            None => target.to_string(),
        }
    }
}

/// Figures without the values that a reader of the served book moves.
fn at_rest(markdown: &str) -> String {
    let scan = crate::check::scan::Scan::new(markdown);
    let edits = scan.prose().filter_map(|line| match parse(line.text) {
        Some(Ok(Directive::Figure { command, caption, moves })) if !moves.is_empty() => Some(Edit {
            range: line.start..line.start + line.text.len(),
            text: format!("{{{{#figure {command} | {caption}}}}}"),
        }),
        _ => None,
    });
    let edits = edits.collect();
    apply(markdown, edits)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::build::tests::little_program;
    use crate::check::made_up;

    #[test]
    fn a_part_becomes_html_whose_links_lead_to_the_site() {
        let (program, mut pictures) = (little_program(), Pictures::default());
        let mut program = program.borrow_mut();
        let mut printer = Printer { all: &[], program: &mut program, pictures: &mut pictures, root: "../" };
        let page = made_up("02_b.md", "");
        let text =
            "$a$ [b](01_a.md#c), [d](#e), [f](https://g.org)\n\n{{#figure render 1 | h | fov: a.b.c from 1 to 2}}\n";
        let html = printer.html(&page, text).expect("HTML");
        for part in
            ["<math", "../01_a.html#c\"", "../02_b.html#e\"", "\"https://g.org\"", "src=\"../figures/render-1.png\""]
        {
            assert!(html.contains(part), "{part}: {html}");
        }
        assert!(!html.contains("data-live"));
        assert_eq!(printer.heading(&page, "7. *x*").as_deref(), Ok("7. <em>x</em>"));
    }
}

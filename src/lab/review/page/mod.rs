mod pictures;
mod rays;
mod stages;

pub use rays::escape;

use super::{Difference, Snapshots, compare_pictures};
use pinhole::Result;
use std::fmt::Write;

/// One chapter on the page.
pub struct Compared {
    /// The chapter's stem.
    pub name: String,
    /// What it is about, or which mutation it has.
    pub title: String,
    /// What was kept.
    pub before: Snapshots,
    /// What is computed now.
    pub now: Snapshots,
    /// What a reader may type, and what it does.
    pub commands: Vec<(&'static str, String)>,
}

impl Compared {
    /// What differs first and where, in words.
    pub fn headline(&self) -> String {
        if self.before == Snapshots::default() {
            return "no snapshot of it is kept yet".into();
        }
        match self.before.first_difference(&self.now) {
            Some(difference) => difference.to_string(),
            None if self.before.plan != self.now.plan || self.before.probes != self.now.probes => {
                "all numbers and pixels are the same; what differs is the wording".into()
            }
            None => "nothing differs".into(),
        }
    }

    fn first_difference(&self) -> Option<Difference> {
        self.before.first_difference(&self.now)
    }
}

/// The whole page in one file: nothing is fetched, and it reads without its script.
///
/// Errors: an encoder that refuses a picture of the difference.
pub fn page(heading: &str, intro: &str, chapters: &[Compared]) -> Result<String> {
    let mut body = format!("<h1>{}</h1>\n<p>{}</p>\n", escape(heading), escape(intro));
    if chapters.len() > 1 {
        body += "<nav aria-label=\"Chapters\"><ul>\n";
        for chapter in chapters {
            let name = escape(&chapter.name);
            let _ = writeln!(body, "<li><a href=\"#{name}\">{name}</a>: {}</li>", escape(&chapter.headline()));
        }
        body += "</ul></nav>\n";
    }
    for chapter in chapters {
        section(&mut body, chapter)?;
    }
    let (style, script) = (include_str!("page.css"), include_str!("page.js"));
    // The policy lets nothing in from anywhere, which a test relies on.
    Ok(format!(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; \
         style-src 'unsafe-inline'; script-src 'unsafe-inline'\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <meta name=\"color-scheme\" content=\"light dark\">\n\
         <link rel=\"icon\" href=\"data:,\">\n<title>{}</title>\n<style>\n{style}</style>\n</head>\n\
         <body>\n<main>\n{body}</main>\n<script>\n{script}</script>\n</body>\n</html>\n",
        escape(heading)
    ))
}

fn section(body: &mut String, chapter: &Compared) -> Result {
    let Compared { name, title, before, now, commands } = chapter;
    let _ = write!(
        body,
        "<section id=\"{name}\">\n<h2>{name} <small>{}</small></h2>\n<p class=\"first\">{}</p>\n",
        escape(title),
        escape(&capital(&chapter.headline())),
        name = escape(name),
    );
    if let Ok(difference) = compare_pictures(&before.picture, &now.picture) {
        let _ = writeln!(body, "<p>{}</p>", escape(&capital(&difference.to_string())));
    }
    if !commands.is_empty() {
        body.push_str("<dl class=\"commands\">\n");
        for (what, command) in commands {
            let _ = writeln!(body, "<dt>{what}</dt><dd><code>{}</code></dd>", escape(command));
        }
        body.push_str("</dl>\n");
    }
    body.push_str(&pictures::viewer(name, before, now, chapter.first_difference().as_ref())?);
    body.push_str("<h3>Stages</h3>\n");
    body.push_str(&stages::stages(&before.digests, &now.digests));
    body.push_str("<h3>Rays</h3>\n");
    body.push_str(
        &rays::rays(&before.probes, &now.probes).unwrap_or_else(|| "<p>None of the nine probes changed.</p>\n".into()),
    );
    body.push_str("<h3>Plan</h3>\n");
    body.push_str(&plan(&before.plan, &now.plan));
    body.push_str("</section>\n");
    Ok(())
}

/// The lines of the plan that went and that came.
fn plan(before: &str, now: &str) -> String {
    let mut text = String::new();
    for (mark, word, these, those) in [("−", "del", before, now), ("+", "ins", now, before)] {
        for line in these.lines().filter(|line| !those.lines().any(|other| other == *line)) {
            let _ = writeln!(text, "<{word}>{mark} {}</{word}>", escape(line));
        }
    }
    if text.is_empty() {
        "<p>The plan is the same.</p>\n".into()
    } else {
        format!("<pre class=\"plan\">{text}</pre>\n")
    }
}

/// A sentence that starts a paragraph.
fn capital(sentence: &str) -> String {
    let mut letters = sentence.chars();
    let first: String = letters.next().map(|letter| letter.to_uppercase().to_string()).unwrap_or_default();
    format!("{first}{}.", letters.as_str())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plan_shows_what_went_and_what_came() {
        let text = plan("one\ntwo <2>\nthree\n", "one\nthree\nfour\n");
        assert_eq!(text, "<pre class=\"plan\"><del>− two &lt;2&gt;</del>\n<ins>+ four</ins>\n</pre>\n");
        assert_eq!(plan("one\n", "one\n"), "<p>The plan is the same.</p>\n");
    }

    #[test]
    fn a_page_fetches_nothing_and_closes_what_it_opens() {
        let now = Snapshots { probes: "8 × 8\n".into(), ..Snapshots::default() };
        let chapter = |name: &str| Compared {
            name: name.into(),
            title: "a <test>".into(),
            before: Snapshots::default(),
            now: now.clone(),
            commands: vec![("accept", "cargo run --release -- review accept 1".into())],
        };
        let text = page("Two", "of them", &[chapter("01_a"), chapter("02_b")]).expect("a page");
        for mark in ["http://", "https://", "src=\"/", "@import", "fetch("] {
            assert!(!text.contains(mark), "{mark}");
        }
        for tag in ["section", "main", "details", "table", "figure", "dl", "nav"] {
            let (open, close) = (text.matches(&format!("<{tag}")).count(), text.matches(&format!("</{tag}>")).count());
            assert_eq!(open, close, "<{tag}>");
        }
        assert!(text.contains("<p class=\"first\">No snapshot of it is kept yet.</p>"), "{text}");
    }
}

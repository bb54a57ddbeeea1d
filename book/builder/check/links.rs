//! Links between pages, and the ids mdBook gives to headings.

use super::scan::{Scan, blank_spans};
use super::{Page, Problem};
use std::collections::BTreeSet;

/// What the builder makes beside the pages, to which a page may link.
pub const MADE: [&str; 4] = ["exercises.html", "answers.html", "slides/index.html", "print.html"];

/// The ids that a page's headings answer to.
pub fn heading_ids(text: &str) -> BTreeSet<String> {
    ids(text).0
}

/// The headings of a page: the number of the line, the words, and the id.
pub fn headings(text: &str) -> Vec<(usize, &str, String)> {
    ids(text).1
}

/// All ids of a page, and those of its headings with where each stands.
fn ids(text: &str) -> (BTreeSet<String>, Vec<(usize, &str, String)>) {
    let scan = Scan::new(text);
    let (mut ids, mut headings) = (BTreeSet::new(), Vec::new());
    for line in scan.prose() {
        ids.extend(line.text.split("<a id=\"").skip(1).filter_map(|rest| rest.split('"').next()).map(str::to_owned));
        let marks = line.text.len() - line.text.trim_start_matches('#').len();
        if let Some(title) = line.text.get(marks..).filter(|title| (1..=6).contains(&marks) && title.starts_with(' ')) {
            let id = heading_id(title);
            let mut candidate = id.clone();
            let mut count = 0;
            while !ids.insert(candidate.clone()) {
                count += 1;
                candidate = format!("{id}-{count}");
            }
            headings.push((line.number, title.trim(), candidate));
        }
    }
    (ids, headings)
}

/// mdBook keeps letters, digits, `_` and `-`, and turns a space into `-`; a double dash has become a typographic one.
fn heading_id(title: &str) -> String {
    if let Some((_, id)) = title.trim_end().strip_suffix('}').and_then(|title| title.rsplit_once("{#")) {
        return id.to_owned();
    }
    let letter = |letter: char| match letter {
        '-' | '_' => Some(letter),
        letter if letter.is_alphanumeric() => Some(letter),
        letter if letter.is_whitespace() => Some('-'),
        _ => None,
    };
    without_targets(title).replace("--", "").trim().to_lowercase().chars().filter_map(letter).collect()
}

/// `[text](target)` speaks its text only.
fn without_targets(title: &str) -> String {
    let mut text = String::new();
    let mut rest = title;
    while let Some((before, after)) = rest.split_once("](") {
        text.push_str(before);
        rest = after.split_once(')').map_or("", |(_, rest)| rest);
    }
    text + rest
}

/// The targets a line of prose links to.
fn targets(line: &str) -> Vec<String> {
    let prose = blank_spans(line);
    let inline = prose.split("](").skip(1).filter_map(|rest| rest.split([')', ' ']).next());
    let written = prose.split("href=\"").skip(1).filter_map(|rest| rest.split('"').next());
    let defined = prose.trim_start().strip_prefix('[').and_then(|rest| rest.split_once("]:"));
    let defined = defined.and_then(|(_, target)| target.split_whitespace().next());
    inline.chain(written).chain(defined).map(str::to_owned).collect()
}

/// Links that lead nowhere. A link to another site is a reader's choice to follow and is not looked at.
pub fn problems(page: &Page, all: &[Page]) -> Vec<Problem> {
    let scan = Scan::new(&page.text);
    let mut problems = Vec::new();
    for line in scan.prose() {
        for target in targets(line.text) {
            let elsewhere = ["https://", "http://", "mailto:"].iter().any(|scheme| target.starts_with(scheme));
            if !elsewhere {
                let what = dead(page, all, &target);
                problems.extend(what.map(|what| Problem::new(&page.label, line.number, what)));
            }
        }
    }
    problems
}

fn dead(page: &Page, all: &[Page], target: &str) -> Option<String> {
    let (file, id) = target.split_once('#').map_or((target, None), |(file, id)| (file, Some(id)));
    let file = file.strip_prefix("./").unwrap_or(file);
    if MADE.contains(&file) && id.is_none() {
        return None;
    }
    let aim = if file.is_empty() { Some(page) } else { all.iter().find(|other| other.name == file) };
    let Some(aim) = aim else {
        return Some(format!("the link to `{target}` leads nowhere: there is no page `{file}` in book/src."));
    };
    let id = id.filter(|id| !heading_ids(&aim.text).contains(*id))?;
    Some(format!("the link to `{target}` leads nowhere: {} has no heading `#{id}`.", aim.name))
}

#[cfg(test)]
mod tests {
    use super::super::made_up;
    use super::*;

    #[test]
    fn headings_are_named_as_mdbook_names_them() {
        let ids = heading_ids("# Why `tan(θ/2)`?\n## The grid\n## The grid\n### See [x](y.md) {#own}\n");
        let expected = ["own", "the-grid", "the-grid-1", "why-tanθ2"];
        assert!(ids.iter().map(String::as_str).eq(expected), "{ids:?}");
    }

    #[test]
    fn a_dead_link_is_named() {
        let text = "# Top\n\n[a](b.md#near) [c](#top) [d](https://example.org)\n[e](gone.md) `[f](no.md)`\n[g](b.md#far)\n[h]: #low\n";
        let page = made_up("a.md", text);
        let all = [page.clone(), made_up("b.md", "# Near\n")];
        let found: Vec<String> = problems(&page, &all).iter().map(ToString::to_string).collect();
        let expected = [
            "a.md:4: the link to `gone.md` leads nowhere: there is no page `gone.md` in book/src.",
            "a.md:5: the link to `b.md#far` leads nowhere: b.md has no heading `#far`.",
            "a.md:6: the link to `#low` leads nowhere: a.md has no heading `#low`.",
        ];
        assert_eq!(found, expected);
    }
}

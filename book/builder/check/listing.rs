//! Listings: parts of compiled source between `// ANCHOR: name` and `// ANCHOR_END: name`.

use super::directive::{Directive, parse};
use super::fit;
use super::scan::{Fence, Scan};
use super::{Page, Problem};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// What a comment line says about an anchor.
#[derive(Debug, PartialEq, Eq)]
enum Mark<'a> {
    Open(&'a str),
    Close(&'a str),
}

/// Only a comment of its own is a mark; the word inside a string is not.
fn mark(line: &str) -> Option<Mark<'_>> {
    let comment = line.trim_start();
    let comment = comment.strip_prefix("//").or_else(|| comment.strip_prefix('#'))?.trim();
    let close = comment.strip_prefix("ANCHOR_END:").map(|name| Mark::Close(name.trim()));
    close.or_else(|| comment.strip_prefix("ANCHOR:").map(|name| Mark::Open(name.trim())))
}

/// The listing an include asks for, without anchor lines and without the indentation common to its lines.
pub fn listing(source: &str, file: &str, anchor: Option<&str>) -> Result<String, String> {
    let mut kept: Vec<&str> = Vec::new();
    let (mut open, mut closed) = (anchor.is_none(), anchor.is_none());
    for line in source.lines() {
        match mark(line) {
            Some(Mark::Open(name)) if Some(name) == anchor => open = true,
            Some(Mark::Close(name)) if Some(name) == anchor => {
                closed = true;
                break;
            }
            Some(_) => {}
            None if open => kept.push(line),
            None => {}
        }
    }
    let name = anchor.unwrap_or_default();
    let blank = kept.iter().all(|line| line.trim().is_empty());
    match (open, closed) {
        (false, _) => Err(format!("{file} has no anchor `{name}`: put `// ANCHOR: {name}` above what is meant.")),
        (true, false) => Err(format!("the anchor `{name}` in {file} is never closed: add `// ANCHOR_END: {name}`.")),
        _ if blank && anchor.is_none() => Err(format!("{file} is empty.")),
        _ if blank => Err(format!("the anchor `{name}` in {file} is empty: put at least one line inside it.")),
        _ => Ok(without_margin(&kept)),
    }
}

fn without_margin(lines: &[&str]) -> String {
    let indent = |line: &&str| line.len() - line.trim_start().len();
    let margin = lines.iter().filter(|line| !line.trim().is_empty()).map(indent).min().unwrap_or(0);
    let cut: Vec<&str> = lines.iter().map(|line| line.get(margin..).unwrap_or("").trim_end()).collect();
    cut.join("\n").trim_matches('\n').to_owned()
}

/// Reads the listing of an include that stands on a page.
pub fn read(page: &Page, path: &str, anchor: Option<&str>) -> Result<String, String> {
    let file = target(page, path);
    let source = std::fs::read_to_string(&file)
        .map_err(|_| format!("the include names `{path}`, which is not there (looked for {}).", file.display()))?;
    listing(&source, &label(path), anchor)
}

/// The same as the page shows it: Rust and text no wider than its column, and line by line as it is what one copies from
/// the page into a file in which a broken line would mean something else.
pub fn shown(page: &Page, path: &str, anchor: Option<&str>) -> Result<String, String> {
    let listing = read(page, path, anchor)?;
    Ok(match path.rsplit('.').next() {
        Some("rs" | "step") => fit::source(&listing),
        Some("txt") => fit::printed(&listing),
        _ => listing,
    })
}

/// The file an include means.
fn target(page: &Page, path: &str) -> PathBuf {
    page.path.parent().unwrap_or(Path::new("")).join(path)
}

/// The file as a reader would name it, from the top of the repository.
pub fn label(path: &str) -> String {
    path.trim_start_matches("./").trim_start_matches("../").to_owned()
}

/// The includes of a fence, when it holds nothing else.
pub fn includes<'a>(scan: &Scan<'a>, fence: &Fence<'_>) -> Option<Vec<Directive<'a>>> {
    let body = scan.body(fence).iter().filter(|line| !line.text.trim().is_empty());
    let read = body.map(|line| match parse(line.text) {
        Some(Ok(include @ Directive::Include { .. })) => Some(include),
        _ => None,
    });
    read.collect::<Option<Vec<_>>>().filter(|includes| !includes.is_empty())
}

/// Includes that do not resolve, fences that never end, and rust written by hand.
pub fn problems(page: &Page) -> Vec<Problem> {
    let scan = Scan::new(&page.text);
    let mut problems = Vec::new();
    for fence in &scan.fences {
        let here = fence.first + 1;
        if !fence.closed {
            problems.push(Problem::new(&page.label, here, "this code fence is never closed."));
        }
        let language = fence.info.split([',', ' ']).next().unwrap_or_default();
        if ["rust", "rs"].contains(&language) && includes(&scan, fence).is_none() {
            let what = "rust written by hand: include it from compiled source with {{#include file:anchor}}.";
            problems.push(Problem::new(&page.label, here, what));
        }
        for line in scan.body(fence) {
            let what = match parse(line.text) {
                Some(Ok(Directive::Include { path, anchor })) => read(page, path, anchor).err(),
                Some(Err(what)) if line.text.contains("{{#include") => Some(what),
                _ => None,
            };
            problems.extend(what.map(|what| Problem::new(&page.label, line.number, what)));
        }
    }
    problems
}

/// Every (file, anchor) that some page includes.
pub fn used(pages: &[Page]) -> BTreeSet<(PathBuf, String)> {
    let mut used = BTreeSet::new();
    for page in pages {
        for line in Scan::new(&page.text).lines.iter().filter(|line| line.fence.is_some()) {
            if let Some(Ok(Directive::Include { path, anchor: Some(anchor) })) = parse(line.text)
                && let Ok(file) = target(page, path).canonicalize()
            {
                used.insert((file, anchor.to_owned()));
            }
        }
    }
    used
}

/// Anchors of one source file that no page includes, that stand twice, or that close what was not open.
pub fn anchor_problems(label: &str, source: &str, is_used: impl Fn(&str) -> bool) -> Vec<Problem> {
    let mut seen = BTreeSet::new();
    let mut problems = Vec::new();
    for (index, line) in source.lines().enumerate() {
        let what = match mark(line) {
            Some(Mark::Open(name)) if !seen.insert(name) => {
                Some(format!("the anchor `{name}` stands twice in this file: rename one."))
            }
            Some(Mark::Open(name)) if !is_used(name) => {
                Some(format!("no page includes the anchor `{name}`: include it or take it out."))
            }
            Some(Mark::Close(name)) if !seen.contains(name) => {
                Some(format!("`ANCHOR_END: {name}` closes an anchor that is not open."))
            }
            _ => None,
        };
        problems.extend(what.map(|what| Problem::new(label, index + 1, what)));
    }
    problems
}

/// The anchors of every rust file below the named folders of the repository.
pub fn orphans(root: &Path, folders: &[&str], pages: &[Page]) -> Vec<Problem> {
    let used = used(pages);
    let mut waiting: Vec<PathBuf> = folders.iter().map(|folder| root.join(folder)).collect();
    let mut problems = Vec::new();
    while let Some(path) = waiting.pop() {
        if let Ok(entries) = std::fs::read_dir(&path) {
            waiting.extend(entries.filter_map(|entry| Some(entry.ok()?.path())));
        } else if path.extension().is_some_and(|extension| extension == "rs")
            && let (Ok(source), Ok(file)) = (std::fs::read_to_string(&path), path.canonicalize())
        {
            let label = path.strip_prefix(root).unwrap_or(&path).display().to_string();
            let is_used = |name: &str| used.contains(&(file.clone(), name.to_owned()));
            problems.extend(anchor_problems(&label, &source, is_used));
        }
    }
    problems.sort_by(|a, b| (&a.file, a.line).cmp(&(&b.file, b.line)));
    problems
}

#[cfg(test)]
mod tests {
    use super::super::made_up;
    use super::*;

    const SOURCE: &str = "a\n// ANCHOR: one\n    b\n      // ANCHOR: two\n        c\n// ANCHOR_END: one\nd\n";

    #[test]
    fn a_listing_has_no_anchor_lines_and_no_margin() {
        assert_eq!(listing(SOURCE, "f.rs", Some("one")).as_deref(), Ok("b\n    c"));
        assert_eq!(listing(SOURCE, "f.rs", None).as_deref(), Ok("a\n    b\n        c\nd"));
    }

    #[test]
    fn a_broken_anchor_is_named() {
        let told = |source: &str, anchor: &str| listing(source, "f.rs", Some(anchor)).expect_err("broken");
        assert_eq!(told(SOURCE, "six"), "f.rs has no anchor `six`: put `// ANCHOR: six` above what is meant.");
        assert_eq!(told(SOURCE, "two"), "the anchor `two` in f.rs is never closed: add `// ANCHOR_END: two`.");
        let empty = "// ANCHOR: e\n\n// ANCHOR_END: e\n";
        assert_eq!(told(empty, "e"), "the anchor `e` in f.rs is empty: put at least one line inside it.");
    }

    #[test]
    fn a_missing_file_is_named() {
        let found = problems(&made_up("a.md", "```rust\n{{#include not/there.rs:x}}\n```\n"));
        assert_eq!(found[0].line, 2);
        assert!(found[0].what.starts_with("the include names `not/there.rs`, which is not there"));
    }

    #[test]
    fn rust_by_hand_is_refused() {
        let found = problems(&made_up("a.md", "text\n\n```rust,ignore\nlet a = 1;\n```\n\n```text\nfine\n```\n"));
        let what = "rust written by hand: include it from compiled source with {{#include file:anchor}}.";
        assert_eq!(found, [Problem::new("a.md", 3, what)]);
    }

    #[test]
    fn an_orphan_and_a_twin_are_found() {
        let source = "// ANCHOR: a\n// ANCHOR_END: a\n// ANCHOR: a\n// ANCHOR: b\nlet text = \"// ANCHOR: c\";\n";
        let found: Vec<String> =
            anchor_problems("f.rs", source, |name| name == "a").iter().map(ToString::to_string).collect();
        let twice = "f.rs:3: the anchor `a` stands twice in this file: rename one.";
        assert_eq!(found, [twice, "f.rs:4: no page includes the anchor `b`: include it or take it out."]);
    }
}

//! What a page may hold, and how each mistake is reported to its author.
//!
//! mdBook shows a missing anchor as an empty listing and only logs a missing file, so the rules stand here. The
//! builder applies those of a page at every build; `tests/book.rs` includes this very module and applies all of
//! them. Only the standard library and serde are used, so that the test needs nothing more.

pub mod course;
pub mod directive;
pub mod fit;
pub mod guide;
pub mod inline;
pub mod lesson;
pub mod links;
pub mod listing;
pub mod lists;
pub mod movement;
pub mod parts;
pub mod pattern;
pub mod scan;
pub mod syllabus;
pub mod terms;
pub mod work;

use std::fmt;
use std::path::{Path, PathBuf};

/// One mistake of an author: where, and one sentence about it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Problem {
    /// The file, named as an author would: `book/src/02_ndc.md`.
    pub file: String,
    /// The line in that file, from 1; 0 when the whole file is meant.
    pub line: usize,
    /// What is wrong, and what would be accepted.
    pub what: String,
}

impl Problem {
    /// A problem at a line.
    pub fn new(file: &str, line: usize, what: impl Into<String>) -> Self {
        Self { file: file.to_owned(), line, what: what.into() }
    }
}

impl fmt::Display for Problem {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.line {
            0 => write!(out, "{}: {}", self.file, self.what),
            line => write!(out, "{}:{line}: {}", self.file, self.what),
        }
    }
}

/// One page as its author wrote it.
#[derive(Debug, Clone)]
pub struct Page {
    /// Where it lies.
    pub path: PathBuf,
    /// Its file name, `02_ndc.md`.
    pub name: String,
    /// How messages name it.
    pub label: String,
    /// Its text, with what [`inline`] and [`guide`] fill in.
    pub text: String,
}

/// Reads `SUMMARY.md` and every page of a folder, in the order of their names.
pub fn read_pages(folder: &Path) -> Result<Vec<Page>, Problem> {
    let unreadable = |path: &Path, error: &dyn fmt::Display| {
        Problem::new(&path.display().to_string(), 0, format!("cannot be read: {error}."))
    };
    let entries = std::fs::read_dir(folder).map_err(|error| unreadable(folder, &error))?;
    let mut paths: Vec<PathBuf> = entries.filter_map(|entry| Some(entry.ok()?.path())).collect();
    paths.retain(|path| path.extension().is_some_and(|extension| extension == "md"));
    paths.sort();
    let read = |path: PathBuf| {
        let text = std::fs::read_to_string(&path).map_err(|error| unreadable(&path, &error))?;
        let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
        let label = format!("book/src/{name}");
        Ok(Page { path, name, label, text: text.replace("\r\n", "\n") })
    };
    let mut pages: Vec<Page> = paths.into_iter().map(read).collect::<Result<_, _>>()?;
    let bibliography = pages.iter().find(|page| page.name == inline::BIBLIOGRAPHY);
    let citations = bibliography.map_or_else(Default::default, |page| inline::citations(&page.text));
    for page in &mut pages {
        page.text = inline::filled(&page.name, &page.text, &citations);
    }
    guide::guide(&mut pages);
    Ok(pages)
}

/// Everything a page must keep by itself, in the order of its lines.
pub fn page(page: &Page, all: &[Page]) -> Vec<Problem> {
    let mut problems = directive::problems(page);
    problems.extend(inline::problems(page));
    problems.extend(listing::problems(page));
    problems.extend(links::problems(page, all));
    problems.sort_by_key(|problem| problem.line);
    problems
}

/// Every page's problems and those of `SUMMARY.md`: what the builder asks before it builds.
pub fn pages(all: &[Page]) -> Vec<Problem> {
    let mut problems: Vec<Problem> = all.iter().flat_map(|one| page(one, all)).collect();
    problems.extend(lists::summary(all));
    problems.extend(syllabus::problems(all));
    problems
}

/// A page made up for a test.
#[cfg(test)]
pub fn made_up(name: &str, text: &str) -> Page {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(name);
    Page { path, name: name.to_owned(), label: name.to_owned(), text: text.to_owned() }
}

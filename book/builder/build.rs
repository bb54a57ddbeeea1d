//! One build: check the pages, let mdBook make the site, put the pictures beside it.

use crate::check;
use crate::check::terms::INDEX;
use crate::figure::{Pictures, with_drawings};
use crate::handout::{FONTS, Handout};
use crate::page::{Pages, told};
use crate::print;
use crate::program::Program;
use mdbook_driver::MDBook;
use mdbook_driver::config::Config;
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::rc::Rc;

/// Where a book is read and written.
#[derive(Debug, Clone)]
pub struct Book {
    /// The top of the repository.
    pub repository: PathBuf,
    /// The folder of the pages and of `SUMMARY.md`.
    pub pages: PathBuf,
    /// The folder the site is written to; what was there goes.
    pub out: PathBuf,
}

impl Book {
    /// The book this builder was compiled beside.
    pub fn of_this_repository() -> Self {
        let member = Path::new(env!("CARGO_MANIFEST_DIR"));
        let repository = member.parent().unwrap_or(member).to_path_buf();
        Self { pages: member.join("src"), out: repository.join("out").join("book"), repository }
    }

    /// The folder of `book.toml` and of the builder.
    fn root(&self) -> PathBuf {
        self.repository.join("book")
    }
}

/// Builds the book, or says in one sentence each what stands in the way; then the last good build is untouched.
pub fn build(book: &Book, program: &Rc<RefCell<Program>>) -> Result<(), String> {
    let written = check::read_pages(&book.pages).map_err(|problem| problem.to_string())?;
    let problems = check::pages(&written);
    if !problems.is_empty() {
        return Err(told(&problems));
    }
    let mdbook = |error: mdbook_driver::errors::Error| format!("{error:#}");
    program.borrow_mut().ask_for(&written);
    let pictures = Rc::new(RefCell::new(Pictures::default()));
    let mut site = MDBook::load_with_config(book.root(), config(book)?).map_err(mdbook)?;
    let handouts = Rc::default();
    site.with_preprocessor(Pages {
        written,
        program: Rc::clone(program),
        pictures: Rc::clone(&pictures),
        handouts: Rc::clone(&handouts),
    });
    site.build().map_err(mdbook)?;
    let pictures = pictures.borrow();
    write_drawings(&book.out, &pictures)?;
    print::unfold(&book.out)?;
    write_pictures(&book.out.join("figures"), &pictures)?;
    write_handouts(&book.out, &handouts.borrow())
}

fn config(book: &Book) -> Result<Config, String> {
    let mut config = Config::from_disk(book.root().join("book.toml")).map_err(|error| format!("{error:#}"))?;
    config.book.src.clone_from(&book.pages);
    config.build.build_dir.clone_from(&book.out);
    if book.pages.join(INDEX).is_file() {
        // Every term stands there, so a search would find it always, and what explains the term less well.
        let unsearched = BTreeMap::from([(INDEX, BTreeMap::from([("enable", false)]))]);
        config.set("output.html.search.chapter", unsearched).map_err(|error| format!("{error:#}"))?;
    }
    Ok(config)
}

/// Puts the drawings into the pages that mdBook wrote.
fn write_drawings(folder: &Path, pictures: &Pictures) -> Result<(), String> {
    let failed = |error: std::io::Error| format!("{} cannot be written: {error}.", folder.display());
    for entry in folder.read_dir().map_err(failed)? {
        let path = entry.map_err(failed)?.path();
        if path.extension().is_some_and(|extension| extension == "html") {
            let page = std::fs::read_to_string(&path).map_err(failed)?;
            std::fs::write(&path, with_drawings(&page, pictures)).map_err(failed)?;
        }
    }
    Ok(())
}

fn write_pictures(folder: &Path, pictures: &Pictures) -> Result<(), String> {
    let failed = |error: std::io::Error| format!("{} cannot be written: {error}.", folder.display());
    std::fs::create_dir_all(folder).map_err(failed)?;
    for (name, (_, bytes)) in &pictures.files {
        std::fs::write(folder.join(name), bytes).map_err(failed)?;
    }
    let live = serde_json::to_vec(&pictures.live).map_err(|error| error.to_string())?;
    std::fs::write(folder.join("live.json"), live).map_err(failed)
}

/// Writes sheets and slides; mdBook has named the sheet of the formulas' font after what is in it.
fn write_handouts(folder: &Path, handouts: &[Handout]) -> Result<(), String> {
    let fonts = folder.join("fonts").read_dir().into_iter().flatten().flatten().map(|entry| entry.file_name());
    let fonts = fonts.map(|name| name.to_string_lossy().into_owned()).find(|name| name.ends_with(".css"));
    let fonts = fonts.ok_or("the site has no sheet of fonts.")?;
    for handout in handouts {
        let path = folder.join(&handout.path);
        let failed = |error: std::io::Error| format!("{} cannot be written: {error}.", path.display());
        std::fs::create_dir_all(path.parent().unwrap_or(folder)).map_err(failed)?;
        std::fs::write(&path, handout.html.replace(FONTS, &fonts)).map_err(failed)?;
    }
    Ok(())
}

#[cfg(test)]
pub mod tests {
    use super::*;
    use std::io::Write;

    const PAGE: &str = "# One\n\n$a^2$ and [two](02_two.md#b).\n\n{{#pinhole plan}}\n\n{{#figure render | A *box*}}\n\n\
                        {{#figure figure | A drawing}}\n\n```toml\n{{#include PATH}}\n```\n\n| a | b |\n|---|---|\n| 1 | 2 |\n";
    const SVG: &str = "<svg viewBox=\"0 0 9 9\"><path d=\"M0 0\"/></svg>";
    const PNG: &[u8] = b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0\x60\0\0\0\x36";

    /// A little book of two pages, built into a temporary folder.
    pub fn little_book() -> (tempfile::TempDir, Book) {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let real = Book::of_this_repository();
        let book = Book { pages: folder.path().join("src"), out: folder.path().join("out"), ..real };
        std::fs::create_dir(&book.pages).expect("a folder of pages");
        let path = book.root().join("Cargo.toml").display().to_string();
        write(&book, "SUMMARY.md", "# Summary\n\n- [One](01_one.md)\n- [Two](02_two.md)\n");
        write(&book, "01_one.md", &PAGE.replace("PATH", &path));
        write(&book, "02_two.md", "# Two\n\n## B\n\nBack to [one](01_one.md).\n");
        (folder, book)
    }

    /// Writes one page.
    pub fn write(book: &Book, name: &str, text: &str) {
        std::fs::write(book.pages.join(name), text).expect("a page can be written");
    }

    /// A program that prints, paints and draws.
    pub fn little_program() -> Rc<RefCell<Program>> {
        Program::with(little_command)
    }

    /// Runs one command of that program.
    pub fn little_command(words: &[String], out: &mut dyn Write) -> Result<(), String> {
        let path = words.last().cloned().unwrap_or_default();
        let done = match Path::new(&path).extension().and_then(|extension| extension.to_str()) {
            Some("svg") => std::fs::write(path, SVG),
            Some("png") => std::fs::write(path, PNG),
            _ => writeln!(out, "kept"),
        };
        done.map_err(|error| error.to_string())
    }

    fn files(folder: &Path) -> Vec<PathBuf> {
        let entries = std::fs::read_dir(folder).expect("a folder").flatten();
        let below = |path: PathBuf| {
            if path.is_dir() { files(&path) } else { vec![path] }
        };
        entries.map(|entry| entry.path()).flat_map(below).collect()
    }

    /// The addresses a browser would fetch by itself while it shows a file.
    fn fetched(path: &Path, text: &str) -> Vec<String> {
        let quoted = |rest: &str| {
            rest.trim_start_matches(['"', '\'', ' ']).split(['"', '\'', ')', ' ', '>']).next().map(str::to_owned)
        };
        let after = |mark: &str| text.split(mark).skip(1).filter_map(quoted).collect::<Vec<_>>();
        match path.extension().and_then(|extension| extension.to_str()) {
            Some("html") => {
                let links = text.split("<link").skip(1).filter_map(|rest| rest.split("href=").nth(1).and_then(quoted));
                ["src=", "srcset=", "xlink:href=", "url(", "@import "]
                    .into_iter()
                    .flat_map(after)
                    .chain(links)
                    .collect()
            }
            Some("css") => ["url(", "@import "].into_iter().flat_map(after).collect(),
            _ => Vec::new(),
        }
    }

    #[test]
    fn a_book_is_built_whole_and_asks_nothing_of_the_network() {
        let (_folder, book) = little_book();
        build(&book, &little_program()).expect("the little book builds");
        let page = std::fs::read_to_string(book.out.join("01_one.html")).expect("a page");
        for part in ["<math", "figures/render.png", "<svg", "class=\"typed\"", "class=\"source\"", "table-wrapper"] {
            assert!(page.contains(part), "{part} is missing");
        }
        assert!(book.out.join("figures/render.png").is_file());
        for made in check::links::MADE {
            assert!(book.out.join(made).is_file(), "{made} is missing");
        }
        for path in files(&book.out) {
            let bytes = std::fs::read(&path).expect("a file");
            for address in fetched(&path, &String::from_utf8_lossy(&bytes)) {
                let away = address.starts_with("http") || address.starts_with("//");
                assert!(!away, "{} would fetch {address}", path.display());
            }
        }
    }

    #[test]
    fn a_failed_build_leaves_the_last_one() {
        let (_folder, book) = little_book();
        build(&book, &little_program()).expect("the little book builds");
        write(&book, "02_two.md", "# Two\n\n## B\n\n$\\oops$ ![x](y.png)\n");
        let told = build(&book, &little_program()).expect_err("a mistake");
        assert!(told.starts_with("book/src/02_two.md:5: `![` puts in a picture by hand"), "{told}");
        assert!(book.out.join("02_two.html").is_file());
    }

    #[test]
    fn the_sources_are_not_written() {
        let (_folder, book) = little_book();
        write(&book, "SUMMARY.md", "- [One](01_one.md)\n- [Two](02_two.md)\n- [Three](03.md)\n");
        let told = build(&book, &little_program()).expect_err("a missing page");
        assert!(told.contains("SUMMARY.md:3: the link to `03.md` leads nowhere"), "{told}");
        assert!(!book.pages.join("03.md").exists());
    }
}

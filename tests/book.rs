//! The book and the code agree: listings, links, pictures, and the lists of chapters.
//!
//! The rules and the tests that show each can fail are the builder's own, in `book/builder/check`.

#[expect(dead_code, reason = "a build asks for more than this test does")]
#[path = "../book/builder/check/mod.rs"]
mod check;

use check::{Page, Problem};
use std::path::Path;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn pages() -> Vec<Page> {
    check::read_pages(&root().join("book/src")).expect("the pages can be read")
}

#[track_caller]
fn none(problems: &[Problem]) {
    let told: Vec<String> = problems.iter().map(ToString::to_string).collect();
    assert!(told.is_empty(), "{} to mend:\n{}", told.len(), told.join("\n"));
}

#[test]
fn every_page_keeps_the_rules() {
    none(&check::pages(&pages()));
}

#[test]
fn every_anchor_is_in_the_book() {
    none(&check::listing::orphans(root(), &["src", "chapters", "tests"], &pages()));
}

#[test]
fn no_page_is_too_long() {
    none(&check::lists::long_pages(&pages()));
}

#[test]
fn the_lists_of_chapters_agree() {
    let manifest = std::fs::read_to_string(root().join("chapters/Cargo.toml")).expect("the manifest can be read");
    let (examples, problems) = check::lists::example_stems(&manifest);
    none(&problems);
    none(&check::lists::disagreements(&[
        ("chapters/", check::lists::chapter_stems(root())),
        ("book/src/", check::lists::page_stems(&pages())),
        ("the [[example]] entries of chapters/Cargo.toml", examples),
        ("the folders with chapters/*/snapshots/*.snap", check::lists::snapshot_stems(root())),
    ]));
}

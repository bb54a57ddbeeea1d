//! The book and the code agree: listings, links, pictures, and the lists of chapters.
//!
//! The rules and the tests that show each can fail are the builder's own, in `book/builder/check`.

#[expect(dead_code, reason = "a build asks for more than this test does")]
#[path = "../book/builder/check/mod.rs"]
mod check;

use check::directive::{self, Directive};
use check::movement::{self, Movement};
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

/// A step that a page shows in parts is there whole, and in the order in which the edits follow each other.
#[test]
fn every_step_stands_whole_on_its_page() {
    let mut steps = 0;
    for page in pages() {
        let scan = check::scan::Scan::new(&page.text);
        let includes = scan.lines.iter().filter_map(|line| match directive::parse(line.text) {
            Some(Ok(Directive::Include { path, anchor })) if path.ends_with("yours.step") => Some((path, anchor)),
            _ => None,
        });
        let includes: Vec<_> = includes.collect();
        for step in includes.chunk_by(|one, other| one.0 == other.0) {
            let read = |anchor| check::listing::read(&page, step[0].0, anchor).expect("a step");
            let lines =
                |text: String| text.lines().filter(|line| !line.is_empty()).map(str::to_owned).collect::<Vec<_>>();
            let shown: Vec<String> = step.iter().flat_map(|(_, anchor)| lines(read(*anchor))).collect();
            assert_eq!(shown, lines(read(None)), "{}", page.label);
            steps += 1;
        }
    }
    eprintln!("book: {steps} steps stand whole on their pages");
    assert!(steps >= 24);
}

/// The parts of a chapter's page, in their order.
const PARTS: [&str; 8] = [
    "{{#figure ",
    "## A worked example",
    "## Your turn",
    "## Exercises",
    "<summary>Answers</summary>",
    "## Further reading",
    "<summary>Columns in and out</summary>",
    "<summary>The whole chapter</summary>",
];

#[test]
fn every_chapter_s_page_has_its_parts() {
    let mut chapters = 0;
    for page in pages().iter().filter(|page| page.name.starts_with(|first: char| first.is_ascii_digit())) {
        let places: Vec<usize> = PARTS.iter().map(|part| page.text.find(part).unwrap_or(usize::MAX)).collect();
        let missing: Vec<&str> =
            PARTS.iter().zip(&places).filter(|(_, at)| **at == usize::MAX).map(|(part, _)| *part).collect();
        assert!(missing.is_empty(), "{} lacks {missing:?}", page.label);
        assert!(places.is_sorted(), "{} has its parts in another order than {PARTS:?}", page.label);
        chapters += 1;
    }
    eprintln!("book: the pages of {chapters} chapters have their parts");
}

/// Whoever looks for a method's source finds it, and nothing stands in the bibliography that no page speaks of.
#[test]
fn every_source_is_cited() {
    let pages = pages();
    let bibliography = pages.iter().find(|page| page.name == check::inline::BIBLIOGRAPHY).expect("a bibliography");
    let keys: Vec<&str> =
        bibliography.text.lines().filter_map(|line| line.strip_prefix("- <a id=\"")?.split('"').next()).collect();
    assert!(keys.len() > 100, "{} sources", keys.len());
    let is_cited = |key: &str| {
        let link = format!("](bibliography.md#{key})");
        pages.iter().any(|page| page.name != bibliography.name && page.text.contains(&link))
    };
    let idle: Vec<&str> = keys.iter().copied().filter(|key| !is_cited(key)).collect();
    assert!(idle.is_empty(), "no page cites {idle:?}");
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

/// What a reader who comes from a lecture or from PBRT searches for.
const SEARCHED: [&str; 24] = [
    "Monte Carlo",
    "estimator",
    "expected value",
    "pdf",
    "throughput",
    "BRDF",
    "BSDF",
    "albedo",
    "diffuse",
    "Lambertian",
    "specular",
    "dielectric",
    "microfacet",
    "grazing incidence",
    "next-event estimation",
    "importance sampling",
    "MIS",
    "Russian roulette",
    "rendering equation",
    "area light",
    "hemisphere",
    "max_depth",
    "photon mapping",
    "BVH",
];

/// How often a term stands in a text as whole words, in any case, with or without a plural's s.
fn count(text: &str, term: &str) -> usize {
    let (text, term) = (text.to_lowercase(), term.to_lowercase());
    let is_part = |near: Option<char>| near.is_some_and(|near| near.is_alphanumeric() || near == '_');
    let whole = |(at, _): &(usize, &str)| {
        let (before, after) = (&text[..*at], &text[at + term.len()..]);
        let after = after.strip_prefix('s').unwrap_or(after);
        !is_part(before.chars().next_back()) && !is_part(after.chars().next())
    };
    text.match_indices(&term).filter(whole).count()
}

#[test]
fn terms_are_counted_as_words() {
    assert_eq!(count("pdfs, a pdf and `pdf_of`; missed", "pdf"), 2);
    assert_eq!(count("pdfs, a pdf and `pdf_of`; missed", "MIS"), 0);
}

/// mdBook's search reads the pages' prose and tables, so what stands there is found, and what does not is not.
#[test]
fn a_search_finds_the_words_of_the_field() {
    let pages = pages();
    let prose = |page: &Page| {
        let scan = check::scan::Scan::new(&page.text);
        scan.prose().map(|line| line.text).collect::<Vec<_>>().join("\n")
    };
    let missing: Vec<&str> = SEARCHED
        .into_iter()
        .filter(|term| !pages.iter().any(|page| page.name != "glossary.md" && count(&prose(page), term) > 0))
        .collect();
    assert!(missing.is_empty(), "no page but the glossary says {missing:?}");
    let glossary = pages.iter().find(|page| page.name == "glossary.md").expect("a glossary");
    let unexplained: Vec<&str> = SEARCHED.into_iter().filter(|term| count(&prose(glossary), term) == 0).collect();
    assert!(unexplained.is_empty(), "the glossary lacks {unexplained:?}");
}

/// A row of the glossary's first tables names a term, says what it is, and links the page that derives it.
#[test]
fn every_term_of_the_glossary_leads_to_a_page() {
    let pages = pages();
    let glossary = pages.iter().find(|page| page.name == "glossary.md").expect("a glossary");
    let (terms, _) = glossary.text.split_once("## Notation").expect("a notation table");
    let rows: Vec<&str> = terms.lines().filter(|line| line.starts_with("| *")).collect();
    assert!(rows.len() > 80, "{} terms", rows.len());
    for row in rows {
        let cells: Vec<&str> = row.split('|').map(str::trim).collect();
        assert!(
            cells.len() >= 5 && cells[2].len() > 15 && cells[3].contains("](") && cells[3].contains(".md)"),
            "{row}"
        );
    }
}

/// The figures of a page whose values a reader of the served book moves.
fn moved(page: &Page) -> Vec<(&str, Vec<Movement>)> {
    let figure = |line| match directive::parse(line) {
        Some(Ok(Directive::Figure { command, moves, .. })) if !moves.is_empty() => {
            Some((command, movement::read(moves).expect("movements")))
        }
        _ => None,
    };
    page.text.lines().filter_map(figure).collect()
}

/// The picture of a command at a small size, with another value.
fn picture(command: &str, setting: &str) -> Vec<u8> {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = folder.path().join("figure.png").display().to_string();
    let mut words: Vec<String> = command.split_whitespace().map(str::to_owned).collect();
    for option in ["--size", "--samples"] {
        if let Some(own) = words.iter().position(|word| word == option) {
            words.drain(own..own + 2);
        }
    }
    words.extend(["--size", "48x27", "--quiet", "--set", setting, "-o", &file].map(str::to_owned));
    if !setting.contains(".sampling.samples=") {
        words.extend(["--samples", "4"].map(str::to_owned));
    }
    let rendered = pinhole_cli::command::run(&chapters::all(), &words, &mut Vec::new());
    rendered.unwrap_or_else(|error| panic!("{command} --set '{setting}': {error}"));
    std::fs::read(file).expect("a picture")
}

#[test]
fn every_chapter_has_values_to_move_and_each_changes_the_picture() {
    let mut count = 0;
    for page in pages().iter().filter(|page| page.name.starts_with(|letter: char| letter.is_ascii_digit())) {
        let figures = moved(page);
        assert!(!figures.is_empty(), "{} has no figure whose values move", page.label);
        for (command, movements) in figures {
            for movement in movements {
                let ends = movement.ends();
                let settings = ends.iter().map(|end| format!("{}={end}", movement.path));
                let mut pictures: Vec<Vec<u8>> = settings.map(|setting| picture(command, &setting)).collect();
                pictures.sort();
                pictures.dedup();
                assert_eq!(pictures.len(), ends.len(), "{}: {} changes nothing", page.label, movement.path);
                count += 1;
            }
        }
    }
    eprintln!("{count} values to move");
}

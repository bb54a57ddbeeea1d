//! pinhole speaks the language of its field: no private word stands in sources, chapters, tests or book.
//!
//! `cargo test --test renderer words -- --nocapture` lists each one with the field's term.
//! Words are read file by file, so a phrase may run over a line's end; names are split at `_` and at capitals.

mod rules;

use rules::{Place, RULES, TYPES};
use std::collections::{BTreeMap, HashMap};
use std::fmt::Write;
use std::fs;
use std::path::Path;

const FOLDERS: [&str; 6] = ["src", "chapters", "tests", "book/src", "book/builder", "README.md"];
const ENDINGS: [&str; 6] = ["rs", "md", "snap", "txt", "json", "ron"];
/// Where a lane is a SIMD lane.
const KERNELS: [&str; 6] = [
    "src/pinhole/intersect/",
    "src/pinhole/rasterise/setup.rs",
    "src/pinhole/shade/receivers.rs",
    "src/pinhole/shapes/",
    "tests/bench/fused.rs",
    "tests/shapes/together.rs",
];
/// This file and its rules, which have to name them.
const EXEMPT: &str = "tests/words";

/// What a byte of a file belongs to.
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Code,
    Comment,
    Text,
}

/// What each byte of a Rust file belongs to; what is quoted in a comment is text.
fn kinds(text: &str) -> Vec<Kind> {
    let mut kinds = vec![Kind::Code; text.len()];
    let mut at = 0;
    while at < text.len() {
        let rest = &text[at..];
        let (kind, length) = if rest.starts_with("//") {
            (Kind::Comment, rest.find('\n').unwrap_or(rest.len()))
        } else if rest.starts_with("r#\"") {
            (Kind::Text, rest.find("\"#").map_or(rest.len(), |end| end + 2))
        } else if rest.starts_with('"') {
            (Kind::Text, end_of_string(rest))
        } else {
            (Kind::Code, end_of_char(rest))
        };
        kinds[at..at + length].fill(kind);
        if kind == Kind::Comment {
            for quote in ['`', '"'] {
                let mut marks = rest[..length].match_indices(quote).map(|(mark, _)| at + mark);
                while let (Some(from), Some(to)) = (marks.next(), marks.next()) {
                    kinds[from..to].fill(Kind::Text);
                }
            }
        }
        at += length;
    }
    kinds
}

fn end_of_string(rest: &str) -> usize {
    let mut escaped = false;
    for (at, letter) in rest.char_indices().skip(1) {
        if letter == '"' && !escaped {
            return at + 1;
        }
        escaped = letter == '\\' && !escaped;
    }
    rest.len()
}

/// Past a letter in quotes, which may be a quote itself, or past one letter of the code.
fn end_of_char(rest: &str) -> usize {
    let mut letters = rest.chars();
    let first = letters.next().map_or(1, char::len_utf8);
    if !rest.starts_with('\'') {
        return first;
    }
    let inside = match letters.next() {
        Some('\\') => 1 + letters.next().map_or(0, char::len_utf8),
        other => other.map_or(0, char::len_utf8),
    };
    if letters.next() == Some('\'') { inside + 2 } else { first }
}

/// The words of a text in small letters, each with its place: names are split at `_` and at capitals.
fn words(text: &str) -> Vec<(String, usize)> {
    let bytes = text.as_bytes();
    let small = |at: usize| bytes.get(at).is_some_and(u8::is_ascii_lowercase);
    let capital = |at: usize| bytes.get(at).is_some_and(u8::is_ascii_uppercase);
    let mut words = Vec::new();
    let mut at = 0;
    while at < bytes.len() {
        let start = at;
        while capital(at) && !(at > start && small(at + 1)) {
            at += 1;
        }
        if at <= start + 1 {
            while small(at) {
                at += 1;
            }
        }
        if at > start { words.push((text[start..at].to_ascii_lowercase(), start)) } else { at += 1 }
    }
    words
}

type Phrase = Vec<&'static str>;

fn phrases(rule: &'static str) -> Vec<Phrase> {
    rule.split('|').filter(|phrase| !phrase.is_empty()).map(|phrase| phrase.split(' ').collect()).collect()
}

/// The rules with their phrases, by the first word of each.
struct Checker {
    by_first: HashMap<&'static str, Vec<(Phrase, usize)>>,
    allowed: Vec<[Vec<Phrase>; 2]>,
}

/// A private word: where it stands, what it is, and the field's term.
type Offence = (usize, String, &'static str);

impl Checker {
    fn new() -> Self {
        let mut by_first = HashMap::<_, Vec<_>>::new();
        for (number, rule) in RULES.iter().enumerate() {
            for form in phrases(rule.forms) {
                by_first.entry(form[0]).or_default().push((form, number));
            }
        }
        Self { by_first, allowed: RULES.iter().map(|rule| [phrases(rule.allowed), phrases(rule.wrong)]).collect() }
    }

    /// How many words a text has, and the private ones.
    fn read(&self, path: &str, text: &str) -> (usize, Vec<Offence>) {
        let kinds = if path.ends_with(".rs") { kinds(text) } else { Vec::new() };
        let words = words(text);
        let stands = |phrase: &Phrase, at: usize| {
            words.get(at..at + phrase.len()).is_some_and(|found| found.iter().zip(phrase).all(|(a, b)| a.0 == *b))
        };
        let covered = |rows: &[Phrase], at: usize, length: usize| {
            rows.iter().any(|phrase| ((at + length).saturating_sub(phrase.len())..=at).any(|from| stands(phrase, from)))
        };
        let mut found = Vec::new();
        for (at, (word, place)) in words.iter().enumerate() {
            for (form, number) in self.by_first.get(word.as_str()).into_iter().flatten() {
                let here = match RULES[*number].place {
                    Place::Everywhere => true,
                    Place::Code => kinds.get(*place) == Some(&Kind::Code),
                    Place::OutsideKernels => !KERNELS.iter().any(|kernel| path.starts_with(kernel)),
                    Place::CommentsOfSrc => path.starts_with("src/") && kinds.get(*place) == Some(&Kind::Comment),
                };
                let [allowed, wrong] = &self.allowed[*number];
                let idiom = covered(allowed, at, form.len()) && !covered(wrong, at, form.len());
                if here && !idiom && stands(form, at) {
                    found.push((*place, form.join(" "), RULES[*number].term));
                }
            }
        }
        found.extend(old_types(text, &kinds));
        (words.len(), found)
    }
}

fn old_types(text: &str, kinds: &[Kind]) -> Vec<Offence> {
    let is_name = |letter: char| letter.is_alphanumeric() || letter == '_';
    let mut found = Vec::new();
    for (names, term) in TYPES {
        for name in names.split(' ') {
            for (at, _) in text.match_indices(name) {
                let whole = !text[..at].ends_with(is_name) && !text[at + name.len()..].starts_with(is_name);
                if whole && kinds.get(at) == Some(&Kind::Code) {
                    found.push((at, name.into(), *term));
                }
            }
        }
    }
    found
}

/// The files below a folder, or the file itself.
fn files(root: &Path, path: &Path, found: &mut Vec<String>) {
    if path.is_dir() {
        for entry in fs::read_dir(path).expect("a readable folder") {
            files(root, &entry.expect("a readable entry").path(), found);
        }
    } else if path.extension().is_some_and(|ending| ENDINGS.iter().any(|known| ending == *known)) {
        let path = path.strip_prefix(root).expect("below the root");
        found.push(path.to_string_lossy().replace('\\', "/"));
    }
}

#[test]
fn no_private_word_stands_anywhere() {
    let (root, checker) = (Path::new(env!("CARGO_MANIFEST_DIR")), Checker::new());
    let mut paths = Vec::new();
    FOLDERS.iter().for_each(|folder| files(root, &root.join(folder), &mut paths));
    paths.retain(|path| !path.starts_with(EXEMPT));
    paths.sort();
    let (mut read, mut list, mut counts) = (0, String::new(), BTreeMap::<String, u32>::new());
    for path in &paths {
        let text = fs::read_to_string(root.join(path)).expect("readable text");
        let (words, found) = checker.read(path, &text);
        read += words;
        for (at, word, term) in found {
            let line = text[..at].matches('\n').count();
            let shown = text.lines().nth(line).unwrap_or("").trim();
            let _ = writeln!(list, "{path}:{}: {shown:.100} → {word}: {term}", line + 1);
            *counts.entry(path.split('/').take(3).collect::<Vec<_>>().join("/")).or_default() += 1;
        }
    }
    assert!(paths.len() > 500 && read > 500_000, "only {} files with {read} words were read", paths.len());
    eprintln!(
        "words: {} files, {read} words, {} rules, {} private",
        paths.len(),
        RULES.len(),
        counts.values().sum::<u32>()
    );
    assert!(list.is_empty(), "private words, and the field's terms:\n{list}\n{counts:#?}");
}

#[test]
fn the_rules_know_a_private_word_from_an_idiom() {
    let checker = Checker::new();
    let found = |path: &str, text: &str| checker.read(path, text).1.len();
    for private in [
        "a leg of the path",
        "let first_leg = 1;",
        "the way of light",
        "the share that comes back",
        "fn light_share()",
        "the density of a point",
        "found by\n/// chance",
        "struct PixelShare;",
        "of matter",
        "the kit's own",
        "tiny\nmirrors",
        "seen at a slant",
        "the half ball",
        "what the ray meets",
        "is met",
        "let reach = 1.0;",
        "a verdict",
        "struct Verdict;",
        "fn f(asked: &Asked)",
        "Lane::new()",
        "planted",
    ] {
        assert!(found("tests/x.rs", private) > 0, "{private:?} is taken for an idiom");
    }
    for idiom in [
        "in the same way",
        "the other way round",
        "no matter how",
        "they share a mesh",
        "a shared table",
        "probability density",
        "two edges meet at a corner",
        "a SIMD lane",
        "// within reach of",
        "// `reach`, once",
        "\"Told\"",
        "a microfacet",
        "it reaches the wall",
        "a ray hits a light",
        "no number of samples",
        "'\"'; // Asked for",
        "asked_for",
    ] {
        assert_eq!(found("tests/x.rs", idiom), 0, "{idiom:?} is taken for a private word");
    }
    assert!(found("src/pinhole/plan/x.rs", "let lane = 0;") > 0);
    assert_eq!(found("src/pinhole/intersect/x.rs", "let lane = 0;"), 0);
    assert_eq!(found("src/x.rs", "/// the lamp's light"), 1);
    assert_eq!(found("src/x.rs", "/// an entity called \"lamp\"\nName::new(\"lamp\")"), 0);
    assert_eq!(words("RayBlockMut of_tile BSDFs x2").len(), 8);
}

//! Where a reader's program goes wrong: the places that make its picture right once they are as in the book's program.
//!
//! Delta debugging (Zeller and Hildebrandt 2002) between two programs. All differences of the reader's program from the
//! book's are undone but those that, put back, make the picture wrong again; what does not matter, as another formula of
//! the same, falls out by itself, however much of it there is.

use super::program::{program_of, steps};
use similar::{Algorithm, DiffTag, capture_diff_slices};
use std::collections::{HashMap, HashSet};
use std::ops::Range;
use std::time::{Duration, Instant};

/// How long programs are tried.
const LONG: Duration = Duration::from_secs(90);
/// How often names are made as in the book; one may bring others to light.
const ROUNDS: usize = 4;

/// A place where a reader's program is not as the book's.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// The reader's line, from 1; where something is missing, the line before which it is.
    pub line: usize,
    /// The function in which it is.
    pub within: Option<String>,
    /// What stands there; nothing where something is missing.
    pub readers: String,
    /// What stands there in the book's program; nothing where that has nothing.
    pub books: String,
}

/// A reader's program beside the book's.
pub struct Beside {
    readers: String,
    books: String,
    differences: Vec<Difference>,
}

/// Bytes of the reader's program, and what the book's has in their place.
struct Difference {
    at: Range<usize>,
    books: String,
    told: Place,
}

/// A statement, a head or an arm: its words, and its bytes.
struct Part<'t> {
    words: Vec<&'t str>,
    at: Range<usize>,
    within: Option<&'t str>,
}

impl Beside {
    /// A reader's program after a chapter, beside that one of the book's, without steps that may be left out, that it
    /// comes nearest to.
    ///
    /// Errors: a chapter whose steps do not fit.
    pub fn new(readers: &str, chapter: u32) -> Result<Self, String> {
        let mut nearest: Option<Self> = None;
        for left_out in [&[][..], &[23], &[26], &[23, 26]] {
            if left_out.iter().any(|&number| number >= chapter) {
                continue;
            }
            let beside = Self::of(readers, program_of(|number| number <= chapter && !left_out.contains(&number))?);
            if nearest.as_ref().is_none_or(|nearest| beside.differences.len() < nearest.differences.len()) {
                nearest = Some(beside);
            }
        }
        nearest.ok_or_else(|| format!("chapter {chapter} has no program"))
    }

    fn of(readers: &str, books: String) -> Self {
        let mut readers = readers.to_owned();
        for _ in 0..ROUNDS {
            let names = renamed(&parts(&readers), &parts(&books));
            if names.is_empty() {
                break;
            }
            readers = with_names(&readers, &names);
        }
        let differences = differences(&readers, &books);
        Self { readers, books, differences }
    }

    /// Whether there is no difference but of spaces, comments and names.
    pub fn is_the_books(&self) -> bool {
        self.differences.is_empty()
    }

    /// All differences.
    pub fn places(&self) -> Vec<Place> {
        self.differences.iter().map(|difference| difference.told.clone()).collect()
    }

    /// The book's program.
    pub fn books(&self) -> &str {
        &self.books
    }

    /// The chapter whose program the reader's is, of those before this one.
    pub fn earlier(&self, chapter: u32) -> Option<u32> {
        let mut earlier = steps().into_iter().map(|step| step.number).filter(|&number| number < chapter);
        let own: Vec<Vec<&str>> = parts(&self.readers).into_iter().map(|part| part.words).collect();
        earlier.find(|&number| {
            program_of(|step| step <= number)
                .is_ok_and(|program| parts(&program).into_iter().map(|part| part.words).eq(own.iter().cloned()))
        })
    }

    /// The fewest places found without which the picture is right, as `is_right` says of a program; none
    /// where it is not right with all of them as in the book.
    pub fn wrong(&self, is_right: &dyn Fn(&str) -> bool) -> Option<Vec<Place>> {
        let began = Instant::now();
        let mut undone: Vec<usize> = (0..self.differences.len()).collect();
        if undone.len() > 1 && !is_right(&self.with(&undone)) {
            return None;
        }
        // Halves, then quarters, then each.
        let mut size = undone.len().div_ceil(2);
        while size > 0 && undone.len() > 1 {
            let mut from = 0;
            while from < undone.len() && undone.len() > 1 && began.elapsed() < LONG {
                let to = (from + size).min(undone.len());
                let fewer: Vec<usize> = [&undone[..from], &undone[to..]].concat();
                if !fewer.is_empty() && is_right(&self.with(&fewer)) {
                    undone = fewer;
                } else {
                    from = to;
                }
            }
            size = if size == 1 { 0 } else { size.div_ceil(2) };
        }
        Some(undone.into_iter().map(|at| self.differences[at].told.clone()).collect())
    }

    /// The reader's program with these differences made as in the book.
    fn with(&self, undone: &[usize]) -> String {
        let mut text = self.readers.clone();
        for &at in undone.iter().rev() {
            let Difference { at, books, .. } = &self.differences[at];
            text.replace_range(at.clone(), &format!("{books}\n"));
        }
        text
    }

    /// The book's program with these places as the reader has them, without spaces and comments.
    pub fn has_only(&self, wrong: &[Place], program: &str) -> bool {
        let others: Vec<usize> =
            (0..self.differences.len()).filter(|&at| !wrong.contains(&self.differences[at].told)).collect();
        words(&self.with(&others)).map(|(word, _)| word).eq(words(program).map(|(word, _)| word))
    }
}

/// The differences between two programs, in the order of the first.
fn differences(readers: &str, books: &str) -> Vec<Difference> {
    let (own, book) = (parts(readers), parts(books));
    let words_of = |parts: &[Part<'_>]| parts.iter().map(|part| part.words.join(" ")).collect::<Vec<_>>();
    let (own_words, book_words) = (words_of(&own), words_of(&book));
    let text_of = |parts: &[Part<'_>], text: &str| match parts {
        [first, .., last] => text[first.at.start..last.at.end].to_owned(),
        [one] => text[one.at.clone()].to_owned(),
        [] => String::new(),
    };
    let mut found = Vec::new();
    let mut push = |old: Range<usize>, new: Range<usize>| {
        let place = own.get(old.start).or(own.last());
        let start = place.map_or(0, |part| if old.start < own.len() { part.at.start } else { part.at.end });
        let at = start..if old.is_empty() { start } else { own[old.end - 1].at.end };
        let [own_text, book_text] = [text_of(&own[old], readers), text_of(&book[new.clone()], books)];
        let [shown, books_shown] = where_apart([&own_text, &book_text]);
        let told = Place {
            line: readers[..start + shown.start].matches('\n').count() + 1,
            within: place.and_then(|part| part.within).map(String::from),
            readers: one_line(&own_text[shown]),
            books: one_line(&book_text[books_shown]),
        };
        found.push(Difference { at, books: text_of(&book[new], books), told });
    };
    for op in capture_diff_slices(Algorithm::Patience, &own_words, &book_words) {
        let (tag, old, new) = op.as_tag_tuple();
        match tag {
            DiffTag::Equal => {}
            // Line by line, where as many stand for as many.
            DiffTag::Replace if old.len() == new.len() => {
                old.zip(new).for_each(|(old, new)| push(old..old + 1, new..new + 1));
            }
            _ => push(old, new),
        }
    }
    found
}

/// Names of the reader's that stand where the book has others, and nowhere else: each with the book's.
fn renamed(own: &[Part<'_>], book: &[Part<'_>]) -> HashMap<String, String> {
    let all = |parts: &[Part<'_>]| {
        parts.iter().flat_map(|part| part.words.iter().map(|word| (*word).to_owned())).collect::<HashSet<_>>()
    };
    let (in_own, in_book) = (all(own), all(book));
    let (of_own, of_book) = (bound(own), bound(book));
    let is_own = |word: &str| of_own.contains(word) && !in_book.contains(word);
    let is_books = |word: &str| of_book.contains(word) && !in_own.contains(word);
    // What a part looks like whatever its new names are.
    let shape = |part: &Part<'_>, is_new: &dyn Fn(&str) -> bool| {
        let shown = |word: &&str| if is_new(word) { "?" } else { *word }.to_owned();
        part.words.iter().map(shown).collect::<Vec<_>>().join(" ")
    };
    let own_shapes: Vec<String> = own.iter().map(|part| shape(part, &is_own)).collect();
    let book_shapes: Vec<String> = book.iter().map(|part| shape(part, &is_books)).collect();
    let mut names: HashMap<String, Option<String>> = HashMap::new();
    let mut taken: HashMap<String, String> = HashMap::new();
    for op in capture_diff_slices(Algorithm::Patience, &own_shapes, &book_shapes) {
        let (tag, old, new) = op.as_tag_tuple();
        if tag != DiffTag::Equal {
            continue;
        }
        for (word, other) in old.zip(new).flat_map(|(old, new)| own[old].words.iter().zip(&book[new].words)) {
            if word == other || !is_own(word) || !is_books(other) {
                continue;
            }
            let known = names.entry((*word).into()).or_insert_with(|| Some((*other).into()));
            if known.as_deref() != Some(*other) || taken.get(*other).is_some_and(|by| by != word) {
                *known = None;
            }
            taken.insert((*other).into(), (*word).into());
        }
    }
    names.into_iter().filter_map(|(word, other)| Some((word, other?))).collect()
}

/// The names that a program binds itself, as functions, constants, parameters and variables; not those of a library.
fn bound<'t>(parts: &[Part<'t>]) -> HashSet<&'t str> {
    const DEFINE: [&str; 7] = ["fn", "const", "static", "struct", "enum", "type", "mut"];
    let mut all = HashSet::new();
    for Part { words, .. } in parts {
        // Patterns stand between these words.
        let arm = words.windows(2).position(|pair| pair == ["=", ">"]);
        let [mut in_pattern, mut in_closure] = [arm.is_some(), false];
        for (at, &word) in words.iter().enumerate() {
            let previous = at.checked_sub(1).map_or("", |before| words[before]);
            let [next, after] = [1, 2].map(|on| words.get(at + on).copied().unwrap_or_default());
            match word {
                "let" | "for" => in_pattern = true,
                "=" | "in" => in_pattern = false,
                "|" => in_closure = !in_closure && matches!(previous, "(" | "," | "=" | "move"),
                _ => {
                    let has_type = next == ":" && after != ":" && previous != ":";
                    let is_bound = in_pattern || in_closure || has_type || DEFINE.contains(&previous);
                    if is_bound && word.starts_with(|c: char| c.is_alphabetic()) {
                        all.insert(word);
                    }
                }
            }
        }
    }
    all
}

/// A text with other names.
fn with_names(text: &str, names: &HashMap<String, String>) -> String {
    let mut made = String::new();
    let mut done = 0;
    for (word, at) in words(text) {
        if let Some(name) = names.get(word) {
            made += &text[done..at];
            made += name;
            done = at + word.len();
        }
    }
    made + &text[done..]
}

/// The parts of a program: each ends after `;`, `{` or an arm's or a field's `,`, or before `}`.
fn parts(text: &str) -> Vec<Part<'_>> {
    let mut all: Vec<Part<'_>> = Vec::new();
    let mut open: Vec<&str> = Vec::new();
    let (mut begins, mut within) = (true, None);
    let mut previous = "";
    for (word, at) in words(text) {
        if previous == "fn" {
            within = Some(word);
        }
        previous = word;
        match (&mut all[..], begins || word == "}") {
            ([.., last], false) => {
                last.words.push(word);
                last.at.end = at + word.len();
            }
            _ => all.push(Part { words: vec![word], at: at..at + word.len(), within }),
        }
        match word {
            "(" | "[" | "{" => open.push(word),
            ")" | "]" | "}" => _ = open.pop(),
            _ => {}
        }
        begins = matches!(word, ";" | "{" | "}") || word == "," && open.last() == Some(&"{");
    }
    all
}

/// The words of a program without its comments, each with its first byte.
fn words(text: &str) -> impl Iterator<Item = (&str, usize)> {
    let mut at = 0;
    std::iter::from_fn(move || {
        loop {
            let rest = &text[at..];
            let first = rest.chars().next()?;
            let is_word = |c: char| c.is_alphanumeric() || c == '_';
            let length = match first {
                _ if first.is_whitespace() => {
                    at += first.len_utf8();
                    continue;
                }
                '/' if rest.starts_with("//") => {
                    at += rest.find('\n').unwrap_or(rest.len());
                    continue;
                }
                '/' if rest.starts_with("/*") => {
                    at += rest.find("*/").map_or(rest.len(), |end| end + 2);
                    continue;
                }
                '"' => {
                    let mut escaped = false;
                    let is_end = |(_, c): &(usize, char)| {
                        let ends = *c == '"' && !escaped;
                        escaped = *c == '\\' && !escaped;
                        ends
                    };
                    rest.char_indices().skip(1).find(is_end).map_or(rest.len(), |(end, _)| end + 1)
                }
                '0'..='9' => number_length(rest),
                _ if is_word(first) => rest.find(|c| !is_word(c)).unwrap_or(rest.len()),
                _ => first.len_utf8(),
            };
            at += length;
            return Some((&rest[..length], at - length));
        }
    })
}

/// How long the number is that begins here, with its point and its power of ten.
fn number_length(text: &str) -> usize {
    let bytes = text.as_bytes();
    let is_word = |at: usize| bytes.get(at).is_some_and(|byte| byte.is_ascii_alphanumeric() || *byte == b'_');
    let mut end = 1;
    while is_word(end)
        || end < bytes.len() && {
            let has_point = bytes[end] == b'.' && bytes.get(end + 1).is_some_and(u8::is_ascii_digit);
            let has_sign = matches!(bytes[end], b'-' | b'+') && matches!(bytes[end - 1], b'e' | b'E');
            has_point || has_sign
        }
    {
        end += 1;
    }
    end
}

/// The lines of two texts from the first word that is not the same to the last.
fn where_apart(texts: [&str; 2]) -> [Range<usize>; 2] {
    let all = texts.map(|text| words(text).collect::<Vec<_>>());
    let same = |pairs: &mut dyn Iterator<Item = (&str, &str)>| pairs.take_while(|(one, other)| one == other).count();
    let of = |which: usize| all[which].iter().map(|(word, _)| *word);
    let before = same(&mut of(0).zip(of(1)));
    let behind = same(&mut of(0).rev().zip(of(1).rev()));
    [0, 1].map(|which| {
        let (text, words) = (texts[which], &all[which]);
        let Some(last) = words.len().checked_sub(1) else { return 0..0 };
        let (first, last) = (words[before.min(last)], words[last.saturating_sub(behind).max(before.min(last))]);
        // From the word itself on its first line: indentation says nothing.
        let from = text[..first.1].rfind('\n').map_or(0, |end| end + 1);
        let from = from + text[from..].len() - text[from..].trim_start().len();
        let end = last.1 + last.0.len();
        from.min(first.1)..text[end..].find('\n').map_or(text.len(), |line| end + line)
    })
}

/// A text on one line, without comments.
fn one_line(text: &str) -> String {
    let (mut line, mut end) = (String::new(), 0);
    for (word, at) in words(text) {
        if at > end && !line.is_empty() {
            line.push(' ');
        }
        line += word;
        end = at + word.len();
    }
    line
}

#[cfg(test)]
mod tests {
    use super::super::program::program_after;
    use super::*;

    #[test]
    fn words_and_parts_are_those_of_the_language() {
        let text = "let a = 1e-9 + b.0; // gone\nmatch c { V(x, \"} //\") => 2.0_f64, _ => 0 }";
        let own: Vec<&str> = words(text).map(|(word, _)| word).collect();
        let book = "let a = 1e-9 + b . 0 ; match c { V ( x , \"} //\" ) = > 2.0_f64 , _ = > 0 }";
        assert_eq!(own.join(" "), book);
        let own: Vec<String> = parts(text).iter().map(|part| one_line(&text[part.at.clone()])).collect();
        assert_eq!(own, ["let a = 1e-9 + b.0;", "match c {", "V(x, \"} //\") => 2.0_f64,", "_ => 0", "}"]);
    }

    #[test]
    fn spaces_comments_and_names_are_no_difference() {
        for step in steps() {
            let book = program_after(step.number).expect("applies");
            let other = book.replace("to_light", "toward_lamp").replace("    ", "\t").replace("half_b", "b2");
            let other = format!("// mine\n{}", other.replace(" {\n", "\n{ // so\n"));
            let beside = Beside::new(&other, step.number).expect("applies");
            let told: Vec<&Place> = beside.differences.iter().map(|difference| &difference.told).collect();
            assert!(beside.is_the_books(), "{}: {told:?}", step.chapter);
            // Names of the library are none of the reader's.
            for (right, wrong) in [(".max(0.0)", ".min(0.0)"), ("PI", "TAU"), (".sqrt()", ".cbrt()")] {
                let beside = Beside::new(&book.replace(right, wrong), step.number).expect("applies");
                assert!(!beside.is_the_books() || !book.contains(right), "{}: {wrong}", step.chapter);
            }
        }
    }

    /// What is wrong is found, however much else is different; here what is right is asked of the text alone.
    #[test]
    fn only_what_matters_is_told() {
        let book = program_after(13).expect("applies");
        let mine = book.replace("t > 0.0 && t.is_finite()", "t.is_finite()");
        let mine = mine.replace("let half_b = from_centre.dot(direction);", "let h = direction.dot(from_centre);");
        let mine = mine.replace("half_b", "h").replace("const ANGLE: f64 = 60.0;", "const ANGLE: f64 = 120.0 / 2.0;");
        let beside = Beside::new(&mine, 13).expect("applies");
        assert_eq!(beside.differences.len(), 3);
        let found = beside.wrong(&|program| program.contains("t > 0.0 &&")).expect("the book's is right");
        let [wrong] = &found[..] else { panic!("{found:?}") };
        assert_eq!(mine.lines().nth(wrong.line - 1).map(str::trim), Some("(t.is_finite()).then_some((t, normal))"));
        assert_eq!(wrong.within.as_deref(), Some("hit"));
    }
}

//! Where a reader's program goes wrong: the places that make its picture right once they are as in the book's program.
//!
//! Delta debugging (Zeller and Hildebrandt 2002) between two programs. All differences of the reader's program from the
//! book's are undone but those that, put back, make the picture wrong again; what does not matter, as another formula of
//! the same, falls out by itself, however much of it there is.

use super::known::in_parallel;
use super::program::{program_of, steps};
use similar::{Algorithm, DiffTag, capture_diff_slices};
use std::collections::{HashMap, HashSet};
use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// How long programs are tried.
const LONG: Duration = Duration::from_secs(90);
/// Of how many differences each is tried by itself.
const FEW: usize = 16;
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
    original: String,
    /// With the book's names.
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

/// A statement, a head or an arm: its words, each with its first byte, the function in which it is, and in how many
/// brackets it begins.
struct Part<'t> {
    words: Vec<&'t str>,
    starts: Vec<usize>,
    within: Option<&'t str>,
    depth: usize,
}

impl Part<'_> {
    fn start(&self) -> usize {
        self.starts[0]
    }

    fn end(&self) -> usize {
        self.starts[self.starts.len() - 1] + self.words[self.words.len() - 1].len()
    }
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
        let (original, mut readers) = (readers.to_owned(), readers.to_owned());
        for _ in 0..ROUNDS {
            let names = renamed(&parts(&readers), &parts(&books));
            if names.is_empty() {
                break;
            }
            readers = with_names(&readers, &names);
        }
        let differences = differences([&readers, &books], &original);
        Self { original, readers, books, differences }
    }

    /// Whether there is no difference but of spaces, comments and names.
    pub fn is_the_books(&self) -> bool {
        self.differences.is_empty()
    }

    /// Whether there is one difference, which then needs no search.
    pub fn is_one_place(&self) -> bool {
        self.differences.len() == 1
    }

    /// All differences.
    pub fn places(&self) -> Vec<Place> {
        self.told(0..self.differences.len())
    }

    /// Some differences in words; two of one line are one.
    fn told(&self, which: impl IntoIterator<Item = usize>) -> Vec<Place> {
        let mut all: Vec<Place> = which.into_iter().map(|at| self.differences[at].told.clone()).collect();
        all.dedup();
        all
    }

    /// The book's program.
    pub fn books(&self) -> &str {
        &self.books
    }

    /// The chapter whose program the reader's is, of those before this one.
    pub fn earlier(&self, chapter: u32) -> Option<u32> {
        let mut earlier = steps().into_iter().map(|step| step.number).filter(|&number| number < chapter);
        earlier.find(|&number| {
            program_of(|step| step <= number).is_ok_and(|books| Self::of(&self.original, books).is_the_books())
        })
    }

    /// The fewest places found without which the picture is right, as `is_right` says of a program; none
    /// where it is not right with all of them as in the book.
    pub fn wrong(&self, is_right: &(dyn Fn(&str) -> bool + Sync)) -> Option<Vec<Place>> {
        let began = Instant::now();
        let mut undone: Vec<usize> = (0..self.differences.len()).collect();
        if undone.len() > 1 && !is_right(&self.with(&undone)) {
            return None;
        }
        // One by itself, where there are few.
        if (2..=FEW).contains(&undone.len()) {
            let is_found = AtomicBool::new(false);
            let alone = in_parallel(undone.iter().copied(), |one| {
                let makes_right = !is_found.load(Ordering::Relaxed) && is_right(&self.with(&[one]));
                is_found.fetch_or(makes_right, Ordering::Relaxed);
                makes_right.then_some(one)
            });
            if let Some(one) = alone.first() {
                return Some(self.told([*one]));
            }
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
        Some(self.told(undone))
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

/// The differences between two programs, in the order of the first, which is quoted as it was with its own names.
fn differences([readers, books]: [&str; 2], original: &str) -> Vec<Difference> {
    let (own, book) = (parts(readers), parts(books));
    let mut found = Vec::new();
    for (own_item, book_item) in paired(&items(&own), &items(&book), [own.len(), book.len()]) {
        let words_of = |parts: &[Part<'_>]| parts.iter().map(|part| part.words.join(" ")).collect::<Vec<_>>();
        let words = [words_of(&own[own_item.clone()]), words_of(&book[book_item.clone()])];
        let mut push = |old: Range<usize>, new: Range<usize>| {
            let old = own_item.start + old.start..own_item.start + old.end;
            let new = book_item.start + new.start..book_item.start + new.end;
            let start = own.get(old.start).map_or(readers.len(), Part::start);
            let at = start..if old.is_empty() { start } else { own[old.end - 1].end() };
            let text = if new.is_empty() { "" } else { &books[book[new.start].start()..book[new.end - 1].end()] };
            let [lines, books_lines] = lines_apart([&own[old.clone()], &book[new]], [readers, books]);
            let first = readers[..start].matches('\n').count();
            let told = Place {
                line: lines.as_ref().map_or(first, |lines| lines.start) + 1,
                within: own.get(old.start).and_then(|part| part.within).map(String::from),
                readers: lines.map_or(String::new(), |lines| quoted(original, lines)),
                books: books_lines.map_or(String::new(), |lines| quoted(books, lines)),
            };
            found.push(Difference { at, books: text.to_owned(), told });
        };
        for op in capture_diff_slices(Algorithm::Patience, &words[0], &words[1]) {
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
    }
    found.sort_by_key(|difference| difference.at.start);
    found
}

/// The functions, constants and types of a program: what each is called, and its parts.
fn items<'t>(parts: &[Part<'t>]) -> Vec<Item<'t>> {
    const KINDS: [&str; 8] = ["fn", "impl", "const", "static", "struct", "enum", "type", "use"];
    let mut all: Vec<Item<'_>> = Vec::new();
    for (at, part) in parts.iter().enumerate() {
        match all.last_mut().filter(|_| part.depth > 0) {
            Some((_, item)) => item.end = at + 1,
            None => {
                let kind = part.words.iter().position(|word| KINDS.contains(word)).unwrap_or(0);
                let word = |at: usize| part.words.get(at).copied().unwrap_or_default();
                // Of several `impl V` each is known by its first function.
                let method = parts.get(at + 1).and_then(|next| next.words.get(1)).filter(|_| word(kind) == "impl");
                let name = [word(kind), word(kind + 1), method.copied().unwrap_or_default()];
                all.push((name, at..at + 1));
            }
        }
    }
    all
}

/// What an item is called, and its parts.
type Item<'t> = ([&'t str; 3], Range<usize>);

/// The items of two programs that are called the same, wherever they stand, and each that is called as no other, beside
/// nothing.
fn paired(own: &[Item<'_>], book: &[Item<'_>], ends: [usize; 2]) -> Vec<(Range<usize>, Range<usize>)> {
    let mut left: Vec<&Item<'_>> = book.iter().collect();
    let mut all = Vec::new();
    for (name, item) in own {
        let other = left.iter().position(|(other, _)| other == name).map(|at| left.remove(at).1.clone());
        all.push((item.clone(), other.unwrap_or(ends[1]..ends[1])));
    }
    all.extend(left.into_iter().map(|(_, item)| (ends[0]..ends[0], item.clone())));
    all
}

/// The lines of two texts, from 0, from the first word that is not the same in these parts to the last; none of no parts.
fn lines_apart(parts: [&[Part<'_>]; 2], texts: [&str; 2]) -> [Option<Range<usize>>; 2] {
    let all = parts.map(|parts| {
        let words = parts.iter().flat_map(|part| part.words.iter().copied().zip(part.starts.iter().copied()));
        words.collect::<Vec<(&str, usize)>>()
    });
    let of = |which: usize| all[which].iter().map(|(word, _)| *word);
    let before = of(0).zip(of(1)).take_while(|(one, other)| one == other).count();
    let behind = of(0).rev().zip(of(1).rev()).take_while(|(one, other)| one == other).count();
    [0, 1].map(|which| {
        let words = &all[which];
        let last = words.len().checked_sub(1)?;
        let first = before.min(last);
        let line = |at: usize| texts[which][..words[at].1].matches('\n').count();
        Some(line(first)..line(last.saturating_sub(behind).max(first)) + 1)
    })
}

/// Lines of a text in one, without comments.
fn quoted(text: &str, lines: Range<usize>) -> String {
    let lines: Vec<&str> = text.lines().skip(lines.start).take(lines.len()).collect();
    one_line(&lines.join("\n"))
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
        within = within.filter(|_| !open.is_empty() || !begins);
        if previous == "fn" {
            within = Some(word);
        }
        previous = word;
        match (&mut all[..], begins || word == "}") {
            ([.., last], false) => {
                last.words.push(word);
                last.starts.push(at);
                last.within = within;
            }
            _ => all.push(Part { words: vec![word], starts: vec![at], within, depth: open.len() }),
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
        let own: Vec<String> = parts(text).iter().map(|part| one_line(&text[part.start()..part.end()])).collect();
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
            // Nor is the order of functions.
            let mut items: Vec<&str> = book.split("\n\n").collect();
            items.reverse();
            let beside = Beside::new(&items.join("\n\n"), step.number).expect("applies");
            assert!(beside.is_the_books(), "{}: {:?}", step.chapter, beside.places());
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

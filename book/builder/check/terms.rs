//! Where the book defines each term of its glossary, where it uses it most, and where each letter stands.

use super::directive::{Directive, parse};
use super::links::headings;
use super::scan::Scan;
use super::{Page, inline, lesson};

/// The page that lists the terms.
pub const GLOSSARY: &str = "glossary.md";

/// The page that this module fills.
pub const INDEX: &str = "index_of_terms.md";

/// Pages that speak of the book, or list what others say.
const APART: [&str; 5] = ["SUMMARY.md", GLOSSARY, INDEX, inline::BIBLIOGRAPHY, "teaching.md"];

/// Parts of a page that speak of much and explain little; an index leads there only if it has no other place.
const REPEATING: [&str; 7] = [
    "Exercises",
    "Answers",
    "Further reading",
    "Columns in and out",
    "What was left out",
    "The whole chapter",
    lesson::SUMMARY,
];

/// The most sections that an entry names beside those that define its term.
const MAX: usize = 3;

/// A part of a page to which an index leads.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Place {
    /// The page's file.
    pub page: String,
    /// Its number or title as lists have it.
    pub short: String,
    /// The heading, or the summary of what is folded.
    pub heading: String,
    /// The heading's id, or nothing: the page itself.
    pub id: String,
    /// The heading in small letters, a space around it, hyphens as spaces.
    title: String,
    /// Its prose likewise, without formulas.
    words: String,
    /// What stands in italics there, likewise.
    italics: Vec<String>,
    /// The tokens of each formula.
    formulas: Vec<Vec<String>>,
}

/// One entry of the index.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Entry {
    /// The term in markdown, without its italics, or the letter.
    pub term: String,
    /// The places that define it.
    pub defined: Vec<Place>,
    /// The places that use it most.
    pub used: Vec<Place>,
    /// The term that the book uses in its place.
    pub see: Option<String>,
}

impl Entry {
    /// The capital under which it stands.
    pub fn initial(&self) -> Option<char> {
        normal(&self.term).to_uppercase().chars().next()
    }
}

/// All places of the book, in its order.
pub fn places(all: &[Page]) -> Vec<Place> {
    let order = summary_order(all);
    order.into_iter().filter(|(page, _)| !APART.contains(&page.name.as_str())).flat_map(of_page).collect()
}

/// Every page with its title, as `SUMMARY.md` lists them.
fn summary_order(all: &[Page]) -> Vec<(&Page, &str)> {
    let summary = all.iter().find(|page| page.name == "SUMMARY.md").map_or("", |page| page.text.as_str());
    let listed = summary.lines().filter_map(|line| {
        let (before, rest) = line.split_once("](")?;
        let page = all.iter().find(|page| rest.split(')').next() == Some(page.name.as_str()))?;
        Some((page, before.split_once('[')?.1))
    });
    listed.collect()
}

fn of_page((page, title): (&Page, &str)) -> Vec<Place> {
    let scan = Scan::new(&page.text);
    let headings = headings(&page.text);
    let short = if lesson::is_taught(&page.name) { lesson::short(&page.name) } else { title };
    let place = |heading: &str, id: &str| Place {
        page: page.name.clone(),
        short: short.to_owned(),
        heading: heading.to_owned(),
        id: id.to_owned(),
        title: format!(" {} ", normal(heading)),
        words: " ".to_owned(),
        italics: Vec::new(),
        formulas: Vec::new(),
    };
    let mut places: Vec<Place> = Vec::new();
    let mut display: Option<String> = None;
    for line in scan.prose() {
        let summary = line.text.trim().strip_prefix("<summary>").and_then(|rest| rest.strip_suffix("</summary>"));
        if let Some((_, heading, id)) = headings.iter().find(|(number, _, _)| *number == line.number) {
            places.push(place(heading, if line.text.starts_with("# ") { "" } else { id }));
        } else if let Some(summary) = summary {
            places.push(place(summary, ""));
        }
        if let Some(place) = places.last_mut() {
            place.add(said(line.text), &mut display);
        }
    }
    places
}

/// What a line says: a figure says its caption, other directives nothing.
fn said(line: &str) -> &str {
    match parse(line) {
        Some(Ok(Directive::Figure { caption, .. })) => caption,
        Some(_) => "",
        None => line,
    }
}

impl Place {
    /// Adds a line; `display` holds what was read of a formula that goes over several lines.
    fn add(&mut self, line: &str, display: &mut Option<String>) {
        let mut prose = String::new();
        // Parts between dollar signs are formulas, and so is everything until the next two of them.
        for (at, part) in line.split("$$").enumerate() {
            if at > 0 {
                match display.take() {
                    Some(formula) => self.formulas.push(tokens(&formula)),
                    None => *display = Some(String::new()),
                }
            }
            match display {
                Some(formula) => *formula += &format!("{part} "),
                None => {
                    for (at, part) in part.split('$').enumerate() {
                        match at % 2 {
                            0 => prose += part,
                            _ => self.formulas.push(tokens(part)),
                        }
                    }
                }
            }
        }
        let prose = without_targets(&prose);
        self.italics.extend(italics(&prose).map(|text| format!(" {} ", normal(&text))));
        self.words += &format!("{} ", normal(&prose.replace('*', "")));
    }

    /// How often it uses a term.
    fn uses(&self, term: &str) -> usize {
        count(&self.words, term)
    }

    /// Whether it says what a term is: in italics, or as its heading.
    fn defines(&self, term: &str) -> bool {
        count(&self.title, term) > 0 || self.italics.iter().any(|italic| count(italic, term) > 0)
    }
}

/// The text without the addresses of its links.
fn without_targets(text: &str) -> String {
    let mut parts = text.split("](");
    let first = parts.next().unwrap_or_default().to_owned();
    parts.fold(first, |text, part| text + part.split_once(')').map_or("", |(_, rest)| rest))
}

/// What stands between single asterisks.
fn italics(text: &str) -> impl Iterator<Item = String> {
    let plain = text.replace("**", "");
    plain.split('*').skip(1).step_by(2).map(str::to_owned).collect::<Vec<_>>().into_iter()
}

/// Words in small letters without accents, with single spaces between them and in the place of marks.
fn normal(text: &str) -> String {
    let letter = |letter: char| match letter {
        'à' | 'á' | 'â' | 'ä' => 'a',
        letter if letter.is_alphanumeric() || letter == '_' => letter,
        _ => ' ',
    };
    let words: String = text.to_lowercase().chars().map(letter).collect();
    words.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// How often a normal text has a normal term as whole words, in the singular or the plural.
fn count(text: &str, term: &str) -> usize {
    // The plural of MIS is no miss.
    let plural = if term.ends_with('s') { "es " } else { "s " };
    let ends = [" ", plural];
    let ends_here = |at: usize| ends.iter().any(|end| text[at + 1 + term.len()..].starts_with(end));
    let singular = text.match_indices(&format!(" {term}")).filter(|(at, _)| ends_here(*at)).count();
    let plural = term.strip_suffix('y').map(|stem| text.matches(&format!(" {stem}ies ")).count());
    singular + plural.unwrap_or(0)
}

/// The terms of each row of the glossary, which are in italics in the first column, and the pages that derive them.
fn rows(glossary: &Page) -> Vec<(Vec<String>, Vec<String>)> {
    let (text, _) = glossary.text.split_once("\n## Notation").unwrap_or((&glossary.text, ""));
    let term = |part: &str| {
        let part = part.split('$').next().unwrap_or_default();
        // The full name beside an abbreviation is not in italics.
        italics(part).next().unwrap_or_else(|| part.trim().to_owned())
    };
    let row = |line: &str| {
        let cell = line.split('|').nth(1).unwrap_or_default();
        let pages = line.split("](").skip(1).filter_map(|rest| rest.split(')').next());
        let terms = cell.split(", ").map(term).filter(|term| !term.is_empty());
        (terms.collect(), pages.map(str::to_owned).collect())
    };
    text.lines().filter(|line| line.starts_with("| *")).map(row).collect()
}

/// The term of a row that the book uses.
fn used<'r>(row: &'r [String], places: &[Place]) -> Option<&'r String> {
    row.iter().find(|term| {
        let name = normal(term);
        places.iter().any(|place| place.defines(&name) || place.uses(&name) > 0)
    })
}

fn glossary(all: &[Page]) -> Option<&Page> {
    all.iter().find(|page| page.name == GLOSSARY)
}

/// The entries of all terms, in alphabetical order.
pub fn entries(all: &[Page], places: &[Place]) -> Vec<Entry> {
    let of_row = |(terms, derived): (Vec<String>, Vec<String>)| {
        let see = used(&terms, places).cloned();
        terms.into_iter().map(|term| entry(term, &derived, see.clone(), places)).collect::<Vec<_>>()
    };
    let mut entries: Vec<Entry> = glossary(all).into_iter().flat_map(rows).flat_map(of_row).collect();
    entries.sort_by_key(|entry| normal(&entry.term));
    entries.dedup_by(|one, other| normal(&one.term) == normal(&other.term));
    entries
}

fn entry(term: String, derived: &[String], see: Option<String>, places: &[Place]) -> Entry {
    let name = normal(&term);
    let repeats = |place: &Place| REPEATING.contains(&place.heading.as_str());
    let mut defined: Vec<&Place> = places.iter().filter(|place| place.defines(&name) && !repeats(place)).collect();
    // The glossary says where it is derived; another page may say it in italics for another reason.
    defined.sort_by_key(|place| !derived.contains(&place.page));
    defined.truncate(2);
    let mut used: Vec<(bool, usize, usize)> = places
        .iter()
        .enumerate()
        .filter(|(_, place)| !defined.iter().any(|own| std::ptr::eq(*own, *place)))
        .map(|(at, place)| (repeats(place), place.uses(&name), at))
        .filter(|(_, count, _)| *count > 0)
        .collect();
    used.sort_by_key(|&(repeats, count, at)| (repeats, std::cmp::Reverse(count), at));
    let explains = !defined.is_empty() || used.first().is_some_and(|(repeats, _, _)| !repeats);
    used.retain(|&(repeats, _, _)| !repeats || !explains);
    // A section that says it once is worth naming only if no other says more.
    let max = used.first().map_or(0, |&(_, count, _)| count);
    used.retain(|&(_, count, _)| count > 1 || max == 1);
    used.truncate(if defined.is_empty() { MAX + 1 } else { MAX });
    used.sort_by_key(|&(_, _, at)| at);
    let see = see.filter(|_| defined.is_empty() && used.is_empty());
    let defined = defined.into_iter().cloned().collect();
    Entry { term, defined, used: used.into_iter().map(|(_, _, at)| places[at].clone()).collect(), see }
}

/// The letters of the notation's tables, in their order, each with where it first stands on each page that is meant.
pub fn letters(all: &[Page], places: &[Place]) -> Vec<Entry> {
    let notation = glossary(all).and_then(|glossary| glossary.text.split_once("\n## Notation"));
    let rows = notation.map_or("", |(_, notation)| notation).lines().filter(|line| line.starts_with("| $"));
    let mut entries: Vec<Entry> = Vec::new();
    for row in rows {
        let mut cells = row.split('|').map(str::trim).skip(1);
        let (cell, meaning) = (cells.next().unwrap_or_default(), cells.next().unwrap_or_default());
        let pages: Vec<&str> = meaning.split("](").skip(1).filter_map(|rest| rest.split(')').next()).collect();
        for letter in cell.split('$').skip(1).step_by(2) {
            let wanted = tokens(letter.split(" = ").next().unwrap_or_default());
            let found: Vec<Place> = match pages.as_slice() {
                [] => first(places.iter(), &wanted),
                pages => {
                    let on = |page: &&str| first(places.iter().filter(|place| place.page == *page), &wanted);
                    let mut found: Vec<Place> = pages.iter().flat_map(on).collect();
                    found.dedup();
                    found
                }
            };
            let term = format!("${letter}$");
            match entries.iter_mut().find(|entry| entry.term == term) {
                Some(entry) => entry.used.extend(found),
                None => entries.push(Entry { term, defined: Vec::new(), used: found, see: None }),
            }
        }
    }
    entries
}

/// The first of some places with a formula that has these tokens.
fn first<'p>(mut places: impl Iterator<Item = &'p Place>, wanted: &[String]) -> Vec<Place> {
    let has = |place: &&Place| place.formulas.iter().any(|formula| contains(formula, wanted));
    places.find(has).into_iter().cloned().collect()
}

/// Whether a formula has these tokens together, with no index behind them that they lack.
fn contains(formula: &[String], wanted: &[String]) -> bool {
    let goes_on = |end: usize| formula.get(end).is_some_and(|token| token == "_");
    let found = |(at, window): (usize, &[String])| {
        let is_index = at > 0 && formula[at - 1] == "_";
        window == wanted && !goes_on(at + wanted.len()) && !is_index
    };
    !wanted.is_empty() && formula.windows(wanted.len()).enumerate().any(found)
}

/// A formula as commands and single marks, without spaces and what only groups.
fn tokens(latex: &str) -> Vec<String> {
    let mut tokens: Vec<String> = Vec::new();
    let mut rest = latex;
    while let Some(first) = rest.chars().next() {
        let length = match rest.strip_prefix('\\') {
            Some(name) => {
                let letters = name.bytes().take_while(u8::is_ascii_alphabetic).count();
                1 + letters.max(name.chars().next().map_or(0, char::len_utf8))
            }
            None => first.len_utf8(),
        };
        let token = &rest[..length];
        if !token.trim().is_empty() && !["{", "}"].contains(&token) {
            tokens.push(token.to_owned());
        }
        rest = &rest[length..];
    }
    tokens
}

#[cfg(test)]
mod tests {
    use super::super::made_up;
    use super::*;

    fn book() -> Vec<Page> {
        let glossary = "# G\n\n| *albedo* $\\rho$ | x |\n| *ray*, *beam* | x |\n| *MIS*, multiple importance sampling | x |\n\
            | *next-event estimation* | x |\n\n## Notation\n\n| $\\rho$ | an albedo |\n| $L$, $L_e$ | radiance |\n\
            | $u$ | [2](02_b.md): a number |\n";
        let one = "# One\n\nA *ray* goes. $L_e$\n\n## The albedo\n\nRays, [rays](02_b.md#ray) and a ray: $\\rho$, array.\n\n\
            <details>\n<summary>More</summary>\n\nMultiple importance sampling, or MIS.\n\n</details>\n";
        let two = "# Two\n\nNext event estimation.\n\n$$\nu\n= L\n$$\n\n```text\nray ray ray\n```\n";
        vec![
            made_up("SUMMARY.md", "- [1. One](01_a.md)\n- [2. Two](02_b.md)\n- [G](glossary.md)\n"),
            made_up("01_a.md", one),
            made_up("02_b.md", two),
            made_up(GLOSSARY, glossary),
            made_up(INDEX, "# Index\n"),
        ]
    }

    fn told(entry: &Entry) -> (String, Vec<String>, Vec<String>) {
        let names = |places: &[Place]| -> Vec<String> {
            places.iter().map(|place| format!("{} {}#{}", place.short, place.heading, place.id)).collect()
        };
        (entry.term.clone(), names(&entry.defined), names(&entry.used))
    }

    #[test]
    fn terms_are_found_where_they_are_defined_and_used() {
        let all = book();
        let places = places(&all);
        let entries = entries(&all, &places);
        let names: Vec<&str> = entries.iter().map(|entry| entry.term.as_str()).collect();
        assert_eq!(names, ["albedo", "beam", "MIS", "multiple importance sampling", "next-event estimation", "ray"]);
        let (_, defined, used) = told(&entries[0]);
        assert_eq!((defined, used), (vec!["1 The albedo#the-albedo".to_owned()], vec![]));
        assert_eq!(entries[1].see.as_deref(), Some("ray"));
        let (_, defined, used) = told(&entries[5]);
        assert_eq!((defined, used), (vec!["1 One#".to_owned()], vec!["1 The albedo#the-albedo".to_owned()]));
        assert_eq!(told(&entries[2]).2, ["1 More#"]);
        assert_eq!(told(&entries[4]).2, ["2 Two#"]);
    }

    #[test]
    fn letters_are_found_in_formulas() {
        let all = book();
        let letters = letters(&all, &places(&all));
        let told: Vec<_> = letters.iter().map(told).map(|(term, _, used)| (term, used.join(", "))).collect();
        let expected =
            [("$\\rho$", "1 The albedo#the-albedo"), ("$L$", "2 Two#"), ("$L_e$", "1 One#"), ("$u$", "2 Two#")];
        assert_eq!(told, expected.map(|(letter, place)| (letter.to_owned(), place.to_owned())));
    }
}

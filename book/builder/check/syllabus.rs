//! Paths through the book: which chapters, in which order and in which weeks.
//!
//! `{{#syllabus one day | 1 to 3, 5; Monte Carlo: a path tracer}}` names chapters as lists do; `;` ends a session.
//! Several stretches of weeks stand behind each other: `| weeks 1 to 2: 1 to 3; 4: rays | weeks 3 to 4: …`.

use super::course::{Course, Taught};
use super::directive::{Directive, parse};
use super::lesson::label_of;
use super::scan::Scan;
use super::{Page, Problem};
use std::collections::BTreeMap;

/// A path through the book.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Syllabus {
    /// How long it takes: "two hours".
    pub name: String,
    /// What is done, and what the reader has then.
    pub stretches: Vec<Stretch>,
}

/// A part of a path, after which something is whole.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Stretch {
    /// The first week and the last, where it is divided into weeks.
    pub weeks: Option<(usize, usize)>,
    /// The chapters of each session, by their places in the course.
    pub sessions: Vec<Vec<usize>>,
    /// What the reader has then, in markdown.
    pub result: String,
}

impl Syllabus {
    /// Reads what stands behind `{{#syllabus`.
    ///
    /// Errors: a chapter that there is not, named twice, or before one that it builds on; weeks without a session.
    pub fn read(text: &str, course: &Course) -> Result<Self, String> {
        let mut parts = text.split('|').map(str::trim);
        let name = parts.next().unwrap_or_default().to_owned();
        let stretches = parts.map(|part| stretch(part, course)).collect::<Result<Vec<_>, _>>()?;
        if name.is_empty() || stretches.is_empty() {
            return Err("a syllabus is {{#syllabus two hours | 1 to 3, 5: what one has then}}.".to_owned());
        }
        let own = Self { name, stretches };
        own.order(course).map_or(Ok(own), Err)
    }

    /// All chapters in their order.
    pub fn chapters(&self) -> Vec<usize> {
        self.stretches.iter().flat_map(|stretch| stretch.sessions.iter().flatten().copied()).collect()
    }

    /// One sentence about a chapter that comes twice, or before one that it builds on.
    fn order(&self, course: &Course) -> Option<String> {
        let chapters = self.chapters();
        let label = |at: usize| label_of(&course.chapters[at].name);
        let of = format!("the syllabus `{}`", self.name);
        for (at, &chapter) in chapters.iter().enumerate() {
            if chapters[..at].contains(&chapter) {
                return Some(format!("{of} has {} twice.", label(chapter)));
            }
            let Taught { needs, later, .. } = &course.chapters[chapter];
            let late = needs.difference(later).find(|need| chapters[at..].contains(need));
            if let Some(&need) = late {
                return Some(format!("{of} has {} before {}, on which it builds.", label(chapter), label(need)));
            }
        }
        None
    }

    /// The chapters that are left out though others of the path build on them, each with those others.
    pub fn left_out(&self, course: &Course) -> BTreeMap<usize, Vec<usize>> {
        let chapters = self.chapters();
        let mut left_out: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        for &chapter in &chapters {
            for need in course.chapters[chapter].needs.iter().filter(|need| !chapters.contains(need)) {
                left_out.entry(*need).or_default().push(chapter);
            }
        }
        left_out
    }
}

fn stretch(text: &str, course: &Course) -> Result<Stretch, String> {
    let (weeks, rest) = match text.strip_prefix("weeks ").and_then(|rest| rest.split_once(':')) {
        Some((weeks, rest)) => (Some(range(weeks).ok_or_else(|| format!("`weeks {weeks}` are none: 1 to 4."))?), rest),
        None => (None, text),
    };
    let (chapters, result) = rest.split_once(':').ok_or_else(|| format!("`{text}` says not what one has then."))?;
    let sessions = chapters.split(';').map(|session| session_of(session, course)).collect::<Result<Vec<_>, _>>()?;
    match weeks {
        Some((first, last)) if sessions.len() != last + 1 - first => {
            Err(format!("weeks {first} to {last} have {} sessions: one a week, with `;` between them.", sessions.len()))
        }
        _ => Ok(Stretch { weeks, sessions, result: result.trim().to_owned() }),
    }
}

/// "1 to 4".
fn range(text: &str) -> Option<(usize, usize)> {
    let (first, last) = text.trim().split_once(" to ")?;
    let (first, last) = (first.parse().ok()?, last.parse().ok()?);
    (first <= last).then_some((first, last))
}

/// The chapters of "1 to 3, 5, Monte Carlo"; a range takes what the book has in between.
fn session_of(text: &str, course: &Course) -> Result<Vec<usize>, String> {
    let find = |named: &str| {
        let named = named.trim();
        course.find(named).ok_or_else(|| format!("there is no chapter `{named}`: name it by its number or its title."))
    };
    let mut chapters = Vec::new();
    for part in text.split(',') {
        match part.split_once(" to ") {
            Some((first, last)) => chapters.extend(find(first)?..=find(last)?),
            None => chapters.push(find(part)?),
        }
    }
    Ok(chapters)
}

/// The paths that the pages declare, in their order; what cannot be read is among [`problems`].
pub fn declared(all: &[Page], course: &Course) -> Vec<Syllabus> {
    written(all).filter_map(|(_, _, text)| Syllabus::read(&text, course).ok()).collect()
}

/// What is wrong with the paths that the pages declare.
pub fn problems(all: &[Page]) -> Vec<Problem> {
    let mut lines = written(all).peekable();
    if lines.peek().is_none() {
        return Vec::new();
    }
    match Course::of(all) {
        Ok(course) => lines
            .filter_map(|(page, line, text)| {
                Some(Problem::new(&page.label, line, Syllabus::read(&text, &course).err()?))
            })
            .collect(),
        Err(problem) => vec![problem],
    }
}

/// Every line that declares a path: its page, its number, and what stands behind `{{#syllabus`.
fn written(all: &[Page]) -> impl Iterator<Item = (&Page, usize, String)> {
    all.iter().flat_map(|page| {
        let scan = Scan::new(&page.text);
        let found = scan.prose().filter_map(|line| match parse(line.text) {
            Some(Ok(Directive::Syllabus { text })) => Some((page, line.number, text.to_owned())),
            _ => None,
        });
        found.collect::<Vec<_>>()
    })
}

#[cfg(test)]
mod tests {
    use super::super::course::made_up;
    use super::*;

    fn course() -> Course {
        Course::of(&made_up()).expect("a course")
    }

    #[test]
    fn a_syllabus_is_read() {
        let day = Syllabus::read("one day | 1, 2 to 3: all of it, with *light*", &course()).expect("a syllabus");
        assert_eq!((day.name.as_str(), day.chapters()), ("one day", vec![0, 1, 2, 3]));
        assert_eq!(day.stretches[0].result, "all of it, with *light*");
        let term = "one term | weeks 1 to 2: 1, 2; Monte Carlo: rays | weeks 3 to 3: 3: more";
        let term = Syllabus::read(term, &course()).expect("a syllabus");
        assert_eq!(term.stretches[0].weeks, Some((1, 2)));
        assert_eq!(term.stretches[0].sessions, [vec![0, 1], vec![2]]);
        assert_eq!(term.left_out(&course()), BTreeMap::new());
        let short = Syllabus::read("an hour | 1, Monte Carlo: less", &course()).expect("a syllabus");
        assert_eq!(short.left_out(&course()), BTreeMap::from([(1, vec![2])]));
    }

    #[test]
    fn a_wrong_syllabus_is_told() {
        let told = |text: &str| Syllabus::read(text, &course()).expect_err(text);
        assert!(told("one day").starts_with("a syllabus is {{#syllabus"));
        assert_eq!(told("a | 1, 9: x"), "there is no chapter `9`: name it by its number or its title.");
        assert_eq!(told("a | 1, 1: x"), "the syllabus `a` has chapter 1 twice.");
        assert_eq!(told("a | 2, 1: x"), "the syllabus `a` has chapter 2 before chapter 1, on which it builds.");
        assert!(told("a | 1 to 3").ends_with("says not what one has then."));
        assert!(told("a | weeks 1 to 3: 1; 2: x").starts_with("weeks 1 to 3 have 2 sessions"));
        assert!(told("a | weeks x: 1: x").starts_with("`weeks x` are none"));
    }

    #[test]
    fn problems_name_their_page() {
        let mut all = made_up();
        assert_eq!(problems(&all), []);
        all.push(super::super::made_up("teaching.md", "# T\n\n{{#syllabus a | 2, 1: x}}\n"));
        assert_eq!(problems(&all)[0].line, 3);
        assert!(declared(&all, &course()).is_empty());
    }
}

//! The chapters as a course: what each builds on, directly and not, and how long it takes.

use super::lesson::{self, Lesson, short, taught};
use super::work::Work;
use super::{Page, Problem};
use std::collections::BTreeSet;

/// One chapter of the course.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Taught {
    /// The page's file, `06_ndc.md`.
    pub name: String,
    /// Its title as `SUMMARY.md` has it, with its number.
    pub title: String,
    /// How long it takes.
    pub work: Work,
    /// Its goals.
    pub lesson: Lesson,
    /// The chapters it builds on, by their places in the course.
    pub needs: BTreeSet<usize>,
    /// Those of them that only its second half builds on.
    pub later: BTreeSet<usize>,
}

impl Taught {
    /// The number that it has in lists, or its title, as a link.
    pub fn link(&self) -> String {
        format!("[{}]({})", short(&self.name), self.name)
    }
}

/// All chapters in the order of the book.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Course {
    /// Each with what it builds on, which comes before it.
    pub chapters: Vec<Taught>,
}

impl Course {
    /// Reads the course from the pages.
    ///
    /// Errors: a page whose last folded block is missing or wrong, or one that builds on a later page.
    pub fn of(all: &[Page]) -> Result<Self, Problem> {
        if let Some(problem) = lesson::problems(all).into_iter().next() {
            return Err(problem);
        }
        let taught = taught(all);
        let place = |name: &String| taught.iter().position(|(page, _)| page.name == *name);
        let chapter = |&(page, title): &(&Page, &str)| {
            let lesson = lesson::read(page)?;
            Ok(Taught {
                name: page.name.clone(),
                title: title.to_owned(),
                work: Work::of(page),
                needs: lesson.needs.iter().filter_map(place).collect(),
                later: lesson.later.iter().filter_map(place).collect(),
                lesson,
            })
        };
        Ok(Self { chapters: taught.iter().map(chapter).collect::<Result<_, _>>()? })
    }

    /// How long some chapters take together.
    pub fn work(&self, chapters: &[usize]) -> Work {
        chapters.iter().fold(Work::default(), |sum, &chapter| sum + self.chapters[chapter].work)
    }

    /// Minutes to read some chapters and to write what they ask for, with the steps of the reader's program that come
    /// before theirs in other chapters.
    pub fn minutes(&self, chapters: &[usize]) -> usize {
        let others: usize = self.steps_elsewhere(chapters).iter().map(|&at| self.chapters[at].work.step).sum();
        let work = self.work(chapters);
        work.reading + work.writing() + others
    }

    /// The other chapters whose steps of the reader's program come before the last of theirs.
    pub fn steps_elsewhere(&self, chapters: &[usize]) -> Vec<usize> {
        let has_step = |at: &usize| self.chapters[*at].work.step > 0;
        let last = chapters.iter().copied().filter(has_step).max().unwrap_or(0);
        (0..last).filter(|at| has_step(at) && !chapters.contains(at)).collect()
    }

    /// Everything that a chapter builds on, directly or not.
    pub fn needed_by(&self, chapter: usize) -> BTreeSet<usize> {
        let direct = &self.chapters[chapter].needs;
        direct.iter().flat_map(|&need| self.needed_by(need)).chain(direct.iter().copied()).collect()
    }

    /// What a chapter builds on, without what follows from the rest.
    pub fn essential(&self, chapter: usize) -> BTreeSet<usize> {
        let needs = &self.chapters[chapter].needs;
        let implied: BTreeSet<usize> = needs.iter().flat_map(|&need| self.needed_by(need)).collect();
        needs.difference(&implied).copied().collect()
    }

    /// The later chapters that build on one directly, and those that do so only by way of others.
    pub fn builds_on(&self, chapter: usize) -> [BTreeSet<usize>; 2] {
        let later = chapter + 1..self.chapters.len();
        let (direct, all): (BTreeSet<usize>, BTreeSet<usize>) = (
            later.clone().filter(|&later| self.chapters[later].needs.contains(&chapter)).collect(),
            later.filter(|&later| self.needed_by(later).contains(&chapter)).collect(),
        );
        let indirect = all.difference(&direct).copied().collect();
        [direct, indirect]
    }

    /// The chapter that a list names by its number or its title.
    pub fn find(&self, named: &str) -> Option<usize> {
        self.chapters.iter().position(|chapter| short(&chapter.name) == named)
    }

    /// Chapters in a list, each a link; three or more in a row are written as a range.
    pub fn listed(&self, chapters: &[usize]) -> String {
        let mut runs: Vec<(usize, usize)> = Vec::new();
        for &chapter in chapters {
            match runs.last_mut() {
                Some((_, last)) if *last + 1 == chapter => *last = chapter,
                _ => runs.push((chapter, chapter)),
            }
        }
        let link = |at: usize| self.chapters[at].link();
        let told = |&(first, last): &(usize, usize)| match last - first {
            0 => link(first),
            1 => format!("{}, {}", link(first), link(last)),
            _ => format!("{} to {}", link(first), link(last)),
        };
        runs.iter().map(told).collect::<Vec<_>>().join(", ")
    }
}

/// A course of four chapters: the third builds on both before it, the fourth on nothing else.
#[cfg(test)]
pub fn made_up() -> Vec<Page> {
    let summary = "- [1. The one](01_a.md)\n- [2. The two](02_b.md)\n- [Monte Carlo](monte_carlo.md)\n\
                   - [3. The three](03_c.md)\n";
    vec![
        super::made_up("SUMMARY.md", summary),
        lesson::made_up("01_a.md", &[lesson::APPENDIX]),
        lesson::made_up("02_b.md", &["01_a.md"]),
        lesson::made_up("03_c.md", &["01_a.md"]),
        lesson::made_up("monte_carlo.md", &["01_a.md", "02_b.md"]),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_course_knows_what_follows_from_what() {
        let course = Course::of(&made_up()).expect("a course");
        assert_eq!(course.chapters[2].title, "Monte Carlo");
        assert_eq!(course.needed_by(2), BTreeSet::from([0, 1]));
        assert_eq!(course.essential(2), BTreeSet::from([1]), "it builds on 1 already by way of 2");
        assert_eq!(course.builds_on(0), [BTreeSet::from([1, 2, 3]), BTreeSet::new()]);
        assert_eq!(course.builds_on(3), [BTreeSet::new(), BTreeSet::new()]);
        assert_eq!(course.find("3"), Some(3));
        assert_eq!(course.find("Monte Carlo"), Some(2));
    }

    #[test]
    fn a_step_of_a_chapter_that_is_left_out_takes_its_time() {
        let mut course = Course::of(&made_up()).expect("a course");
        for (at, step) in [(0, 10), (1, 20), (3, 40)] {
            course.chapters[at].work = Work { reading: 1, step, ..Work::default() };
        }
        assert_eq!(course.minutes(&[0, 3]), 1 + 10 + 20 + 1 + 40);
        assert_eq!(course.minutes(&[0]), 11);
    }

    #[test]
    fn neighbours_are_listed_as_a_range() {
        let course = Course::of(&made_up()).expect("a course");
        assert_eq!(course.listed(&[0, 2]), "[1](01_a.md), [Monte Carlo](monte_carlo.md)");
        assert_eq!(course.listed(&[0, 1, 2, 3]), "[1](01_a.md) to [3](03_c.md)");
        assert_eq!(course.listed(&[2, 3]), "[Monte Carlo](monte_carlo.md), [3](03_c.md)");
    }

    #[test]
    fn a_course_with_a_gap_is_none() {
        let mut all = made_up();
        all[3].text = "# Three\n".to_owned();
        assert!(Course::of(&all).is_err_and(|problem| problem.what.starts_with("has no block")));
    }
}

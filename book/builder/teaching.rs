//! What teachers are shown of the course: tables of what may be skipped, of goals and minutes, and of paths.

use crate::check::Page;
use crate::check::course::Course;
use crate::check::directive::Part;
use crate::check::lesson::label_of;
use crate::check::syllabus::{Stretch, Syllabus, declared};
use crate::check::work::{self, Work};
use crate::graph;
use crate::math;
use std::fmt::Write;

/// A part of the course, as markdown.
///
/// Errors: a page without what it has to say of itself, or a goal whose formula cannot be read.
pub fn part(part: Part, all: &[Page]) -> Result<String, String> {
    let course = Course::of(all).map_err(|problem| problem.to_string())?;
    match part {
        Part::Graph => Ok(graph::drawn(&course)),
        Part::Needed => Ok(needed(&course)),
        Part::Goals => goals(&course),
        Part::Rates => Ok(format!("Minutes are counted by the work: {}.\n", work::rates())),
        Part::Paths => paths(&declared(all, &course), &course),
    }
}

/// For every chapter: which later ones build on it.
fn needed(course: &Course) -> String {
    let mut table = String::from("| chapter | built on by | by these, too, through others |\n|---|---|---|\n");
    for at in 0..course.chapters.len() {
        let [direct, indirect] = course.builds_on(at).map(|later| later.into_iter().collect::<Vec<_>>());
        let title = titled(course, at);
        let _ = match direct.as_slice() {
            [] => writeln!(table, "| {title} | **none: it may be skipped** | |"),
            _ => writeln!(table, "| {title} | {} | {} |", course.listed(&direct), course.listed(&indirect)),
        };
    }
    table
}

/// For every chapter: what its reader can do, and how long that takes.
fn goals(course: &Course) -> Result<String, String> {
    let mut table = format!("| chapter, and what its reader can do {KINDS}");
    for (at, chapter) in course.chapters.iter().enumerate() {
        let goals = chapter.lesson.goals.iter().map(|goal| cell(goal)).collect::<Result<Vec<_>, _>>()?;
        let items: String = goals.iter().map(|goal| format!("<li>{goal}</li>")).collect();
        let _ = writeln!(table, "| **{}**<ul>{items}</ul> | {}", titled(course, at), minutes(chapter.work));
    }
    let all: Vec<usize> = (0..course.chapters.len()).collect();
    let _ = writeln!(table, "| *all chapters, in hours* | {}", in_hours(course.work(&all)));
    Ok(table)
}

/// The last columns of a table with times, and the line below its head.
const KINDS: &str = "| read | write | exercises |\n|---|---|---|---|\n";

/// The last cells of its rows.
fn minutes(work: Work) -> String {
    format!("{} | {} | {} |", work.reading, work.writing(), work.exercises)
}

/// Those of its last row.
fn in_hours(work: Work) -> String {
    format!("*{}* | *{}* | *{}* |", hours(work.reading), hours(work.writing()), hours(work.exercises))
}

/// The table of the paths, for the introduction.
fn paths(syllabi: &[Syllabus], course: &Course) -> Result<String, String> {
    let mut table = String::from("| time | chapters | what you have then |\n|---|---|---|\n");
    for syllabus in syllabi {
        let whole = course.minutes(&syllabus.chapters());
        let name = format!("{} ({:.0} hours)", syllabus.name, whole as f64 / 60.0);
        for (at, stretch) in syllabus.stretches.iter().enumerate() {
            let time = match stretch.weeks {
                Some((first, last)) if at == 0 => format!("{name}: weeks {first} to {last}"),
                Some((first, last)) => format!("… weeks {first} to {last}"),
                None => name.clone(),
            };
            let mut sessions: Vec<String> = stretch.sessions.iter().map(|session| course.listed(session)).collect();
            let steps = course.steps_elsewhere(&syllabus.chapters());
            if at == 0 && !steps.is_empty() {
                sessions.push(format!("of {} only the step", course.listed(&steps)));
            }
            let _ = writeln!(table, "| {time} | {} | {} |", sessions.join("; "), cell(&stretch.result)?);
        }
    }
    Ok(table)
}

/// One path with its minutes, and what it leaves out.
///
/// Errors: those of [`Syllabus::read`].
pub fn syllabus(text: &str, all: &[Page]) -> Result<String, String> {
    let course = Course::of(all).map_err(|problem| problem.to_string())?;
    let syllabus = Syllabus::read(text, &course)?;
    let has_weeks = syllabus.stretches.iter().any(|stretch| stretch.weeks.is_some());
    let mut table = format!("| {} {KINDS}", if has_weeks { "week, and chapters" } else { "chapter" });
    for stretch in &syllabus.stretches {
        for (name, chapters) in rows(stretch, &course) {
            let _ = writeln!(table, "| {name} | {}", minutes(course.work(&chapters)));
        }
        if has_weeks {
            let _ = writeln!(table, "| *then:* {} | | | |", cell(&stretch.result)?);
        }
    }
    let work = course.work(&syllabus.chapters());
    let _ = writeln!(table, "| *altogether, in hours* | {}", in_hours(work));
    let (minutes, own) = (course.minutes(&syllabus.chapters()), work.reading + work.writing());
    let others = if minutes > own { ", the steps of the program on pages left out included" } else { "" };
    let whole =
        format!("To read it and to write what it asks for takes about {:.0} hours{others}. ", minutes as f64 / 60.0);
    Ok(table + "\n" + &whole + &omitted(&syllabus, &course))
}

/// The rows of a stretch: its weeks, or its chapters.
fn rows(stretch: &Stretch, course: &Course) -> Vec<(String, Vec<usize>)> {
    let week = |(at, session): (usize, &Vec<usize>), first: usize| {
        let titles: Vec<String> = session.iter().map(|&chapter| titled(course, chapter)).collect();
        (format!("**{}**: {}", first + at, titles.join("; ")), session.clone())
    };
    match stretch.weeks {
        Some((first, _)) => stretch.sessions.iter().enumerate().map(|row| week(row, first)).collect(),
        None => stretch.sessions.iter().flatten().map(|&chapter| (titled(course, chapter), vec![chapter])).collect(),
    }
}

/// One sentence about what is left out though chapters of the path build on it.
fn omitted(syllabus: &Syllabus, course: &Course) -> String {
    let left_out = syllabus.left_out(course);
    if left_out.is_empty() {
        return "Every chapter that these build on comes before them in the list.\n".to_owned();
    }
    let told = |(need, chapters): (&usize, &Vec<usize>)| {
        let name = &course.chapters[*need].name;
        format!("[{}]({name}) (for {})", label_of(name), course.listed(chapters))
    };
    let told: Vec<String> = left_out.iter().map(told).collect();
    format!(
        "Left out though chapters of this list build on it, so say in a sentence what it has: {}.\n",
        told.join(", ")
    )
}

fn titled(course: &Course, at: usize) -> String {
    let chapter = &course.chapters[at];
    format!("[{}]({})", chapter.title, chapter.name)
}

fn hours(minutes: usize) -> String {
    format!("{:.1}", minutes as f64 / 60.0)
}

/// Markdown inside a cell of a table: its formulas are converted, and no bar of its own ends the cell.
fn cell(text: &str) -> Result<String, String> {
    Ok(math::expand(text)?.replace('|', "\\|"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check::course::made_up;
    use crate::check::made_up as page;

    #[test]
    fn tables_are_made_from_the_pages() {
        let all = made_up();
        let needed = part(Part::Needed, &all).expect("a table");
        assert!(needed.contains("| [1. The one](01_a.md) | [2](02_b.md) to [3](03_c.md) |  |"), "{needed}");
        assert!(needed.contains("| [3. The three](03_c.md) | **none: it may be skipped** | |"), "{needed}");
        let goals = part(Part::Goals, &all).expect("a table");
        assert!(
            goals.contains("<li>Derive <span class=\"whole\"><math") && goals.contains("| *0.0* | *0.0* | *0.0* |"),
            "{goals}"
        );
        let without = part(Part::Goals, &all[1..]).expect("no summary, no chapters");
        assert!(!without.contains("<li>"));
    }

    #[test]
    fn paths_are_those_that_a_page_declares() {
        let mut all = made_up();
        all.push(page("teaching.md", "{{#syllabus an hour | 1, Monte Carlo: less}}\n"));
        let paths = part(Part::Paths, &all).expect("a table");
        let row = "| an hour (0 hours) | [1](01_a.md), [Monte Carlo](monte_carlo.md) | less |";
        assert!(paths.contains(row), "{paths}");
    }

    #[test]
    fn a_path_sums_its_minutes_and_says_what_it_leaves_out() {
        let mut all = made_up();
        all[4].text += "\n## Exercises\n\n1. ★ A.\n2. ★★ B.\n3. ★★★ C.\n";
        let hour = syllabus("an hour | 1, Monte Carlo: less", &all).expect("a table");
        assert!(hour.contains("| [Monte Carlo](monte_carlo.md) | 0 | 0 | 80 |"), "{hour}");
        assert!(hour.contains("| *altogether, in hours* | *0.0* | *0.0* | *1.3* |"), "{hour}");
        assert!(
            hour.ends_with(
                "say in a sentence what it has: [chapter 2](02_b.md) (for [Monte Carlo](monte_carlo.md)).\n"
            )
        );
        let weeks = syllabus("a term | weeks 1 to 2: 1; 2, 3: more", &all).expect("a table");
        assert!(weeks.contains("| **2**: [2. The two](02_b.md); [3. The three](03_c.md) | 0 | 0 | 0 |"), "{weeks}");
        assert!(
            weeks.contains("| *then:* more | | | |") && weeks.contains("Every chapter that these build on"),
            "{weeks}"
        );
    }
    /// A path is called by what it takes: the hours to read it and to write what it asks for.
    #[test]
    fn a_path_takes_what_its_name_says() {
        let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
        let all = crate::check::read_pages(&folder).expect("pages");
        let course = Course::of(&all).expect("a course");
        let named =
            [("an evening", 2.0..3.5), ("a weekend", 11.0..16.0), ("a week", 16.0..30.0), ("one term", 28.0..56.0)];
        let paths = declared(&all, &course);
        assert_eq!(
            paths.iter().map(|path| path.name.as_str()).collect::<Vec<_>>(),
            named.each_ref().map(|named| named.0)
        );
        for (path, (name, hours)) in paths.iter().zip(named) {
            let taken = course.minutes(&path.chapters()) as f64 / 60.0;
            eprintln!("{name}: {taken:.1} hours");
            assert!(hours.contains(&taken), "{name}: {taken:.1}");
        }
    }
}

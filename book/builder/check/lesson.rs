//! What a page builds on, and what its reader can do afterwards: its last folded block.

use super::lists::is_chapter;
use super::scan::Scan;
use super::{Page, Problem};

/// The line that names the block.
pub const SUMMARY: &str = "What you can do now";

/// The page of the mathematics that every chapter may use.
pub const APPENDIX: &str = "appendix.md";

/// How many goals a page may have.
const GOALS: std::ops::RangeInclusive<usize> = 3..=5;

/// What the block says.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Lesson {
    /// The pages it builds on, `06_ndc.md`, without the appendix.
    pub needs: Vec<String>,
    /// Those of them that only its second half builds on.
    pub later: Vec<String>,
    /// What its reader can do afterwards, in markdown.
    pub goals: Vec<String>,
}

/// Whether a page is one of those that are learnt from: a numbered chapter, or Monte Carlo.
pub fn is_taught(name: &str) -> bool {
    name == "monte_carlo.md" || (name != "cover.md" && name.strip_suffix(".md").is_some_and(is_chapter))
}

/// The pages that are learnt from, each with its title, in the order of `SUMMARY.md`.
pub fn taught(all: &[Page]) -> Vec<(&Page, &str)> {
    let Some(summary) = all.iter().find(|page| page.name == "SUMMARY.md") else { return Vec::new() };
    let linked = summary.text.lines().filter_map(|line| {
        let (before, rest) = line.split_once("](")?;
        let (name, title) = (rest.split(')').next()?, before.split_once('[')?.1);
        Some((all.iter().find(|page| page.name == name.trim_start_matches("./"))?, title))
    });
    linked.filter(|(page, _)| is_taught(&page.name)).collect()
}

/// Reads the block of a page.
///
/// Errors: the first part of it that is missing or is written in another form.
pub fn read(page: &Page) -> Result<Lesson, Problem> {
    let scan = Scan::new(&page.text);
    let lines: Vec<_> = scan.prose().collect();
    let named = |text: &str| text.trim() == format!("<summary>{SUMMARY}</summary>");
    let Some(first) = lines.iter().position(|line| named(line.text)) else {
        let what = format!("has no block <summary>{SUMMARY}</summary>: what it builds on, three to five goals.");
        return Err(Problem::new(&page.label, 0, what));
    };
    let number = lines[first].number;
    let wrong = |what: &str| Problem::new(&page.label, number, what);
    let length = lines[first..].iter().position(|line| line.text.trim() == "</details>");
    let last = first + length.ok_or_else(|| wrong("the block does not end with `</details>`."))?;
    if lines[last..].iter().any(|line| line.text.trim_start().starts_with("<details")) {
        return Err(wrong("the block is not the last of those that are folded: put it before the line `Next: …`."));
    }
    let inside: Vec<&str> = lines[first + 1..last].iter().map(|line| line.text.trim_end()).collect();
    let needs = inside.iter().find_map(|line| line.strip_prefix("Builds on ")?.strip_suffix('.'));
    let needs = needs.ok_or_else(|| wrong("the block has no line `Builds on [chapter 6](06_ndc.md) and …`."))?;
    let (first, second) = needs.split_once("; its second half on ").unwrap_or((needs, ""));
    let mut needs = needed(first).map_err(|what| wrong(&what))?;
    let later = if second.is_empty() { Vec::new() } else { needed(second).map_err(|what| wrong(&what))? };
    needs.extend(later.iter().cloned());
    let goals: Vec<String> = inside.iter().filter_map(|line| line.strip_prefix("- ")).map(str::to_owned).collect();
    if !GOALS.contains(&goals.len()) {
        return Err(wrong(&format!(
            "the block has {} goals (`- Derive …`), and a page has three to five.",
            goals.len()
        )));
    }
    Ok(Lesson { needs, later, goals })
}

/// The pages that `[chapter 6](06_ndc.md) and [chapter 3](03_hit.md)` names, each by the name that it has.
fn needed(text: &str) -> Result<Vec<String>, String> {
    let mut needs = Vec::new();
    for link in text.split('[').skip(1) {
        let parts = link.split_once("](").and_then(|(label, rest)| Some((label, rest.split_once(')')?.0)));
        let (label, target) = parts.ok_or_else(|| format!("`[{link}` is no link to a page."))?;
        let right = label_of(target);
        if label != right {
            return Err(format!("the block calls {target} `{label}`, and its name is `{right}`."));
        }
        if target != APPENDIX {
            needs.push(target.to_owned());
        }
    }
    let named = text.contains("](");
    named.then_some(needs).ok_or_else(|| "the line `Builds on …` links to no page.".to_owned())
}

/// How a page is named in a sentence.
pub fn label_of(name: &str) -> String {
    match name {
        "monte_carlo.md" => "Monte Carlo".to_owned(),
        APPENDIX => "what you need to know".to_owned(),
        name => format!("chapter {}", short(name)),
    }
}

/// How a page is named in a list: by its number, or by its title where it has none.
pub fn short(name: &str) -> &str {
    if name == "monte_carlo.md" {
        "Monte Carlo"
    } else {
        name.split('_').next().unwrap_or(name).trim_start_matches('0')
    }
}

/// What the pages' blocks lack, and what they build on that does not come before them.
pub fn problems(all: &[Page]) -> Vec<Problem> {
    let taught = taught(all);
    let mut problems = Vec::new();
    for (at, (page, _)) in taught.iter().enumerate() {
        let earlier = |need: &String| taught[..at].iter().any(|(page, _)| page.name == *need);
        match read(page) {
            Ok(lesson) => problems.extend(lesson.needs.iter().filter(|need| !earlier(need)).map(|need| {
                Problem::new(&page.label, 0, format!("builds on {need}, which is no earlier chapter of the book."))
            })),
            Err(problem) => problems.push(problem),
        }
    }
    problems
}

/// A page with such a block, made up for a test.
#[cfg(test)]
pub fn made_up(name: &str, needs: &[&str]) -> Page {
    let links: Vec<String> = needs.iter().map(|need| format!("[{}]({need})", label_of(need))).collect();
    let goals = "- Derive $a^2$.\n- See it.\n- Write it.";
    let text = format!(
        "# A page\n\nOne two three.\n\n<details>\n<summary>{SUMMARY}</summary>\n\nBuilds on {}.\n\n{goals}\n\n\
         </details>\n",
        links.join(" and ")
    );
    super::made_up(name, &text)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_block_is_read() {
        let lesson = read(&made_up("06_ndc.md", &["03_hit.md", "monte_carlo.md", APPENDIX])).expect("a block");
        assert_eq!(lesson.needs, ["03_hit.md", "monte_carlo.md"]);
        assert_eq!(lesson.goals.len(), 3);
        assert_eq!(lesson.goals[0], "Derive $a^2$.");
    }

    #[test]
    fn a_second_half_may_build_on_more() {
        let mut page = made_up("06_ndc.md", &["03_hit.md"]);
        page.text = page.text.replace("md).", "md); its second half on [Monte Carlo](monte_carlo.md).");
        let lesson = read(&page).expect("a block");
        assert_eq!(
            (lesson.needs, lesson.later),
            (vec!["03_hit.md".into(), "monte_carlo.md".into()], vec!["monte_carlo.md".into()])
        );
    }

    #[test]
    fn every_part_that_goes_is_missed() {
        let whole = made_up("06_ndc.md", &["03_hit.md"]).text;
        let told = |text: &str| read(&super::super::made_up("06_ndc.md", text)).expect_err(text).what;
        for (part, other, sentence) in [
            ("What you can do now", "Goals", "has no block <summary>What you can do now</summary>"),
            ("Builds on", "Needs", "the block has no line `Builds on"),
            ("[chapter 3](03_hit.md)", "nothing", "the line `Builds on …` links to no page"),
            ("[chapter 3]", "[chapter 4]", "the block calls 03_hit.md `chapter 4`, and its name is `chapter 3`"),
            ("- See it.", "", "the block has 2 goals"),
            ("\n</details>", "", "the block does not end"),
            ("</details>", "</details>\n\n<details>\n", "the block is not the last"),
        ] {
            let told = told(&whole.replace(part, other));
            assert!(told.starts_with(sentence), "{told}");
        }
    }

    #[test]
    fn what_a_page_builds_on_comes_before_it() {
        let summary = "- [1. A](01_a.md)\n- [Monte Carlo](monte_carlo.md)\n- [2. B](02_b.md)\n- [C](appendix.md)\n";
        let mut all = vec![
            super::super::made_up("SUMMARY.md", summary),
            made_up("01_a.md", &[APPENDIX]),
            made_up("02_b.md", &["monte_carlo.md"]),
            made_up("monte_carlo.md", &["01_a.md"]),
        ];
        assert_eq!(problems(&all), []);
        let titles: Vec<&str> = taught(&all).iter().map(|(_, title)| *title).collect();
        assert_eq!(titles, ["1. A", "Monte Carlo", "2. B"]);
        all[3] = made_up("monte_carlo.md", &["02_b.md"]);
        let told: Vec<String> = problems(&all).iter().map(ToString::to_string).collect();
        assert_eq!(told, ["monte_carlo.md: builds on 02_b.md, which is no earlier chapter of the book."]);
        all[3].text.clear();
        assert!(problems(&all)[0].what.starts_with("has no block"), "Monte Carlo has one, too");
    }
}

//! What a page tells its reader of the course, made from the pages where they are read: how long it takes, which step of
//! the reader's program comes before its own, and the next page of the path that is done alone.

use super::Page;
use super::course::Course;
use super::lesson::{self, label_of};
use super::parts::section;
use super::syllabus::declared;
use super::work::Work;

/// The path that leads from page to page: most who read alone take it.
pub const LED: &str = "a weekend";

/// The heading of the lines that the reader's program gains.
const STEP: &str = "Add to yours";

/// What stands above a step that no later one needs.
const LEFT_OUT: &str = "step may be left out";

/// Writes into each page what it tells of the course; where a page's last block is wrong there is none to tell, and
/// [`lesson::problems`] says why.
pub fn guide(pages: &mut [Page]) {
    let Ok(course) = Course::of(pages) else { return };
    let path = declared(pages, &course).into_iter().find(|syllabus| syllabus.name == LED);
    let path = path.map_or_else(Vec::new, |syllabus| syllabus.chapters());
    let mut step: Option<&str> = None;
    for (at, chapter) in course.chapters.iter().enumerate() {
        let Some(page) = pages.iter_mut().find(|page| page.name == chapter.name) else { continue };
        timed(page);
        if section(page, STEP).is_some() {
            if let Some(before) = step {
                follows(page, before);
            }
            if !page.text.contains(LEFT_OUT) {
                step = Some(&chapter.name);
            }
        }
        let place = path.iter().position(|&on_it| on_it == at);
        let Some(place) = place else { continue };
        page.text += "\n[A weekend's path](teaching.md#a-weekend) ";
        page.text += &path.get(place + 1).map(|next| &course.chapters[*next]).map_or_else(
            || "ends here; what you have written is yours.\n".to_owned(),
            |next| format!("goes on with [{}]({}).\n", next.title, next.name),
        );
    }
}

/// Puts the minutes at the end of the page's last block, in place of any that were written there by hand.
fn timed(page: &mut Page) {
    let told = Work::of(page).told();
    let block = page.text.find(&format!("<summary>{}</summary>", lesson::SUMMARY));
    let end = block.and_then(|block| Some(block + page.text[block..].find("\n</details>")?));
    let Some((block, end)) = block.zip(end) else { return };
    let by_hand = page.text[block..end].find("\nMinutes: ").map_or(end, |by_hand| block + by_hand);
    page.text.replace_range(by_hand..end, &format!("\n{told}\n"));
}

/// Says which step comes first, at the end of the section's first line: no other line changes its number.
fn follows(page: &mut Page, before: &str) {
    let heading = format!("\n## {STEP}\n\n");
    let start = page.text.find(&heading).map(|at| at + heading.len());
    let end = start.and_then(|start| Some(start + page.text[start..].find('\n')?));
    let number = label_of(before);
    if let Some(end) = end {
        let told = format!(
            " (First comes [the step of {number}]({before}#add-to-yours); it can be typed in without its page.)"
        );
        page.text.insert_str(end, &told);
    }
}

#[cfg(test)]
mod tests {
    use super::super::made_up;
    use super::*;

    fn pages() -> Vec<Page> {
        let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
        let folder = if folder.ends_with("book") { folder.join("src") } else { folder.join("book/src") };
        super::super::read_pages(&folder).expect("the pages can be read")
    }

    #[test]
    fn a_page_tells_its_time_its_step_and_what_comes_next() {
        let mut all = super::super::course::made_up();
        let step = "\n## Add to yours\n\nNow this.\n\n```rust\n{{#include yours.step}}\n```\n";
        all[1].text += step;
        all[3].text += step;
        all[4].text = all[4].text.replace("\n\n</details>", "\n\nMinutes: 45 to do.\n\n</details>");
        all.push(made_up("teaching.md", "{{#syllabus a weekend | 1, 3, 2: x}}\n"));
        guide(&mut all);
        assert!(
            all[1].text.contains("- Write it.\n\nMinutes: 0 to read, 10 to write, 0 for all exercises.\n\n</details>"),
            "{}",
            all[1].text
        );
        assert!(all[1].text.ends_with("goes on with [3. The three](03_c.md).\n"), "{}", all[1].text);
        assert!(
            !all[2].text.contains("goes on") && !all[4].text.contains("goes on"),
            "the last page, and one not on the path"
        );
        assert_eq!(all[4].text.matches("Minutes: ").count(), 1, "{}", all[4].text);
        assert!(all[1].text.contains("Now this.\n\n```"), "nothing comes before the first step");
        let first = "Now this. (First comes [the step of chapter 1](01_a.md#add-to-yours); it can be typed in without its page.)\n\n```";
        assert!(all[3].text.contains(first), "{}", all[3].text);
    }

    /// A step is applied to the program that all the steps before it made, so each page names the one before.
    #[test]
    fn whoever_leaves_chapters_out_is_led_through_every_step() {
        let all = pages();
        let (mut before, mut steps): (Option<String>, usize) = (None, 0);
        for (page, _) in lesson::taught(&all) {
            if !page.text.contains("yours.step") {
                continue;
            }
            if let Some(before) = &before {
                let link = format!("]({before}#add-to-yours); it can be typed in");
                assert_eq!(
                    page.text.matches(&link).count(),
                    1,
                    "{} says not that the step of {before} comes first",
                    page.name
                );
            }
            if !page.text.contains(LEFT_OUT) {
                before = Some(page.name.clone());
            }
            steps += 1;
        }
        assert!(steps >= 14, "{steps} steps");
    }

    #[test]
    fn the_weekend_s_path_leads_from_each_page_to_the_next() {
        let all = pages();
        let course = Course::of(&all).expect("a course");
        let path = declared(&all, &course).into_iter().find(|path| path.name == LED).expect("a weekend").chapters();
        assert!(path.len() >= 10);
        let page = |at: usize| all.iter().find(|page| page.name == course.chapters[at].name).expect("a page");
        for pair in path.windows(2) {
            let next = &course.chapters[pair[1]].name;
            assert!(
                page(pair[0]).text.ends_with(&format!("]({next}).\n")),
                "{} leads not to {next}",
                page(pair[0]).name
            );
        }
        let led = all.iter().filter(|page| page.text.contains("path](teaching.md#a-weekend) goes on")).count();
        assert_eq!(led, path.len() - 1);
    }
}

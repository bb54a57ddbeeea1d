//! The print edition: mdBook's page of the whole book, unfolded as paper needs it.

use crate::check::pattern::STEP;
use std::path::Path;

/// The file in the built book.
const FILE: &str = "print.html";

/// What mdBook has print the page as soon as it is opened; whoever opens it may want to read or to choose first.
const AT_ONCE: &str = "window.setTimeout(window.print, 100);";

/// Unfolds everything but the answers.
pub fn unfold(out: &Path) -> Result<(), String> {
    let path = out.join(FILE);
    let failed = |error: std::io::Error| format!("{} cannot be written: {error}.", path.display());
    let page = std::fs::read_to_string(&path).map_err(failed)?;
    std::fs::write(&path, unfolded(&page)).map_err(failed)
}

fn unfolded(page: &str) -> String {
    let step = STEP.replace('>', " open>");
    page.replace("<details>", "<details open>").replace(STEP, &step).replace(AT_ONCE, "")
}

/// Names the folded answers, so that sheets of style can tell them from what else is folded.
pub fn with_answers_named(text: &str) -> String {
    let answers = "\n<summary>Answers</summary>";
    text.replace(&format!("<details>{answers}"), &format!("<details class=\"answers\">{answers}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn everything_but_the_answers_is_unfolded() {
        let folded =
            "<details>\n<summary>More</summary>\n</details>\n<details>\n<summary>Answers</summary>\n</details>";
        assert!(unfolded(STEP).starts_with("<details class=\"step\" open>"));
        let unfolded = unfolded(&with_answers_named(folded));
        assert_eq!(unfolded.matches("<details open>").count(), 1);
        assert!(unfolded.contains("<details class=\"answers\">\n<summary>Answers"), "{unfolded}");
    }
}

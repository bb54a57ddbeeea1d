//! The index: every term of the glossary and every letter, with links to where they stand.

use crate::check::Page;
use crate::check::terms::{Entry, Place, entries, letters, places};
use crate::math;
use std::fmt::Write;

/// The index as markdown, a list for each first letter.
///
/// Errors: a heading or a letter whose formula cannot be read.
pub fn made(all: &[Page]) -> Result<String, String> {
    let places = places(all);
    let mut out = String::from("<div class=\"terms\">\n\n");
    let mut initial = None;
    for entry in entries(all, &places) {
        let first = entry.initial();
        if first != initial {
            let _ = writeln!(out, "\n## {}\n", first.unwrap_or('–'));
            initial = first;
        }
        out += &line(&entry)?;
    }
    out += "\n</div>\n\n## Letters\n\n<div class=\"terms\">\n\n";
    for entry in letters(all, &places).iter().filter(|entry| !entry.used.is_empty()) {
        out += &line(entry)?;
    }
    Ok(out + "\n</div>\n")
}

fn line(entry: &Entry) -> Result<String, String> {
    let defined = entry.defined.iter().map(|place| format!("*{}*", link(place)));
    let see = entry.see.iter().map(|term| format!("see {term}"));
    let links: Vec<String> = defined.chain(entry.used.iter().map(link)).chain(see).collect();
    Ok(format!("- {}: {}\n", math::expand(&entry.term)?, math::expand(&links.join(", "))?))
}

fn link(place: &Place) -> String {
    let Place { page, short, heading, id, .. } = place;
    let id = if id.is_empty() { String::new() } else { format!("#{id}") };
    format!("[{short}: {heading}]({page}{id})")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check::made_up;

    #[test]
    fn terms_stand_under_their_initials() {
        let all = [
            made_up("SUMMARY.md", "- [1. One](01_a.md)\n"),
            made_up("01_a.md", "# One\n\n## Of *rays*\n\n$\\rho$ and a box, à-trous.\n"),
            made_up(
                "glossary.md",
                "| *ray* | x |\n| *box* | x |\n| *à-trous* | x |\n\n## Notation\n\n| $\\rho$ | x |\n",
            ),
        ];
        let index = made(&all).expect("an index");
        let order = [
            "## A\n",
            "- à-trous: ",
            "## B\n",
            "- box: [1: Of *rays*](01_a.md#of-rays)",
            "## R\n",
            "- ray: *[1",
            "## Letters",
            "<math",
        ];
        let found: Vec<usize> = order.iter().map(|part| index.find(part).expect(part)).collect();
        assert!(found.is_sorted(), "{index}");
    }
}

//! What a chapter's stages cost, as it is kept beside the chapter in `costs.txt`.

use pinhole::scene::{FileKind, read_file};
use pinhole::{Error, Result};
use std::path::{Path, PathBuf};

const KEPT: FileKind = FileKind { name: "kept costs", max: 1 << 20 };
/// What stands before the digest of the film that the errors are of.
pub const FILM: &str = "; film ";

/// What is kept of one stage.
#[derive(Clone, Debug, PartialEq)]
pub struct KeptStage {
    /// The stage's name.
    pub name: String,
    /// Rows of what it wrote over the frame.
    pub rows: f64,
    /// Nanoseconds a row, the median; none where it had no rows.
    pub nanoseconds: Option<f64>,
}

/// Where a chapter's costs are kept, from the repository's root.
pub fn place(chapter: &str) -> PathBuf {
    Path::new("chapters").join(chapter).join("costs.txt")
}

/// The text that is kept.
///
/// Errors: nothing is kept.
pub fn kept_costs(chapter: &str) -> Result<String> {
    let text = read_file(&crate::repository().join(place(chapter)), KEPT);
    let text = text.map_err(|_| Error::Usage(format!("no costs of {chapter} are kept")))?;
    Ok(String::from_utf8_lossy(&text).into_owned())
}

/// The stages of kept costs, in the order of the plan that was measured.
pub fn kept_stages(text: &str) -> Vec<KeptStage> {
    // A name ends where the first whole number stands.
    let stage = |line: &str| {
        let words: Vec<&str> = line.split_whitespace().collect();
        let at = words.iter().position(|word| word.parse::<u64>().is_ok())?;
        let nanoseconds = words.get(at + 1)?.parse().ok();
        Some(KeptStage { name: words[..at].join(" "), rows: words[at].parse().ok()?, nanoseconds })
    };
    let table = text.lines().skip_while(|line| !line.starts_with("what ran")).skip(1);
    table.take_while(|line| !line.starts_with("machine: ")).filter_map(stage).collect()
}

/// The digest of the film that kept errors are of, if it is told.
pub fn kept_film(text: &str) -> Option<&str> {
    text.lines().find_map(|line| line.strip_prefix("errors: ")?.split(FILM).nth(1))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kept_costs_are_read_from_the_table_alone() {
        let text = "cost of x: 20 x 10 pixels of 2 samples on one thread\nerrors: the worst of 3 pixels; u = 2^-24; film 12ab\n\
                    what ran    rows ns a row        10 to 90 %\nTrace shadow rays: meshes  200   8.00    1 to 9   -\n\
                    Clear shadow rays  0    -   -   -\nmachine: M, 2 threads\nmeasured on 25 Nov 2026 at commit 1\n";
        let stage = |name: &str, rows, nanoseconds| KeptStage { name: name.into(), rows, nanoseconds };
        let stages = [stage("Trace shadow rays: meshes", 200.0, Some(8.0)), stage("Clear shadow rays", 0.0, None)];
        assert_eq!(kept_stages(text), stages);
        assert_eq!(kept_film(text), Some("12ab"));
        assert_eq!(kept_film("errors: the worst of 3 pixels"), None);
    }
}

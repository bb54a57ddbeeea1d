use bevy_ecs::prelude::*;
use pinhole::Result;
use pinhole::extract::ImageFrame;
use pinhole::look::trace;
use pinhole::plan::{Census, Stage, Table};
use pinhole::scene::TracePixel;
use std::fmt::Write;

/// A pixel whose rays are written down.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Probe {
    /// Where it lies in the image, in words.
    pub place: &'static str,
    /// The pixel.
    pub pixel: TracePixel,
}

/// Nine pixels of an image of this size: corners, middles of edges, the centre; fewer where some are the same pixel.
///
/// Where a side has an even number of pixels, the middle is the pixel right of the middle or below it.
pub fn probe_pixels(width: u32, height: u32) -> Vec<Probe> {
    let (right, bottom) = (width.saturating_sub(1), height.saturating_sub(1));
    let (middle, centre) = (width / 2, height / 2);
    let places = [
        ("top left", 0, 0),
        ("top", middle, 0),
        ("top right", right, 0),
        ("left", 0, centre),
        ("centre", middle, centre),
        ("right", right, centre),
        ("bottom left", 0, bottom),
        ("bottom", middle, bottom),
        ("bottom right", right, bottom),
    ];
    let mut probes: Vec<Probe> = Vec::new();
    for (place, x, y) in places {
        let pixel = TracePixel { x, y };
        if probes.iter().all(|probe| probe.pixel != pixel) {
            probes.push(Probe { place, pixel });
        }
    }
    probes
}

/// The traces of the nine probes as text: a paragraph each, with its place and pixel above a row a column.
///
/// Errors: what a render would be refused for.
pub fn probes(scene: &World, offer: &[Stage]) -> Result<String> {
    let census = &Census::of(scene);
    let ImageFrame { width, height } = ImageFrame::extract(census)?;
    let mut text = format!("{width} × {height} pixels\n");
    for Probe { place, pixel } in probe_pixels(width, height) {
        let _ = write!(text, "\n{place}: {}", trace(census, offer, pixel)?);
    }
    Ok(text)
}

/// A column that reads otherwise at a probe than it did.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ChangedRow<'a> {
    /// The probe's heading: its place and pixel.
    pub probe: &'a str,
    /// The column's lines as they were; none where there was no such column.
    pub before: Vec<&'a str>,
    /// The column's lines as they are; none where there is no such column.
    pub now: Vec<&'a str>,
}

/// The columns that differ between two texts of [`probes`], probe by probe, in the order of the later text.
pub fn changed_rows<'a>(old: &'a str, new: &'a str) -> Vec<ChangedRow<'a>> {
    let (old, new) = (paragraphs(old), paragraphs(new));
    let mut changed = Vec::new();
    for probe in merged(&old, &new, |paragraph| paragraph.0) {
        let columns = |text: &[(&'a str, Vec<Vec<&'a str>>)]| {
            text.iter().find(|paragraph| paragraph.0 == probe).map_or_else(Vec::new, |paragraph| paragraph.1.clone())
        };
        let (old, new) = (columns(&old), columns(&new));
        for name in merged(&old, &new, |lines| column_name(lines)) {
            let lines = |columns: &[Vec<&'a str>]| {
                columns.iter().find(|lines| column_name(lines) == name).cloned().unwrap_or_default()
            };
            let (before, now) = (lines(&old), lines(&new));
            if before != now {
                changed.push(ChangedRow { probe, before, now });
            }
        }
    }
    changed
}

/// The names of both lists: each of the new one, after those that only the old one had before it.
fn merged<'a, T>(old: &[T], new: &[T], name: impl Fn(&T) -> &'a str) -> Vec<&'a str> {
    let (old, new): (Vec<&str>, Vec<&str>) = (old.iter().map(&name).collect(), new.iter().map(&name).collect());
    let mut names: Vec<&str> = Vec::new();
    let mut gone = old.iter().peekable();
    for now in &new {
        if old.contains(now) {
            names.extend(gone.by_ref().take_while(|before| *before != now).filter(|before| !new.contains(before)));
        }
        names.push(now);
    }
    names.extend(gone.filter(|before| !new.contains(before)));
    names
}

/// A column's lines start with its name; a further row of it starts with blanks.
fn column_name<'a>(lines: &[&'a str]) -> &'a str {
    lines.first().and_then(|line| line.split_whitespace().next()).unwrap_or_default()
}

/// Each paragraph's heading, and the lines of its columns.
fn paragraphs(text: &str) -> Vec<(&str, Vec<Vec<&str>>)> {
    let mut paragraphs: Vec<(&str, Vec<Vec<&str>>)> = Vec::new();
    let mut heading = false;
    for line in text.lines() {
        if line.trim().is_empty() {
            heading = true;
        } else if heading {
            paragraphs.push((line, Vec::new()));
            heading = false;
        } else if let Some((_, columns)) = paragraphs.last_mut() {
            match columns.last_mut() {
                Some(column) if line.starts_with(' ') => column.push(line),
                _ => columns.push(vec![line]),
            }
        }
    }
    paragraphs
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pixels(width: u32, height: u32) -> Vec<[u32; 2]> {
        probe_pixels(width, height).iter().map(|probe| [probe.pixel.x, probe.pixel.y]).collect()
    }

    #[test]
    fn nine_pixels_of_a_small_picture() {
        let expected = [[0, 0], [48, 0], [95, 0], [0, 27], [48, 27], [95, 27], [0, 53], [48, 53], [95, 53]];
        assert_eq!(pixels(96, 54), expected);
    }

    #[test]
    fn no_pixel_twice_where_a_picture_is_one_pixel_wide_or_all() {
        assert_eq!(pixels(1, 1), [[0, 0]]);
        assert_eq!(pixels(1, 9), [[0, 0], [0, 4], [0, 8]]);
        assert_eq!(pixels(6, 1), [[0, 0], [3, 0], [5, 0]]);
        assert_eq!(pixels(2, 2), [[0, 0], [1, 0], [0, 1], [1, 1]]);
    }

    const OLD: &str = "96 × 54 pixels\n\ntop left: pixel 0,0\nraster  x +0.5\nlight   nothing\n\n\
        top: pixel 48,0\nraster  x +48.5\nlight   path 1\n        path 2\npixel   r 1\n";

    #[test]
    fn only_columns_that_changed_are_told_with_all_their_rows() {
        assert_eq!(changed_rows(OLD, OLD), []);
        let new = OLD.replace("        path 2", "        path 3");
        let (before, now) = (vec!["light   path 1", "        path 2"], vec!["light   path 1", "        path 3"]);
        assert_eq!(changed_rows(OLD, &new), [ChangedRow { probe: "top: pixel 48,0", before, now }]);
    }

    #[test]
    fn a_column_that_comes_or_goes_stands_alone() {
        let without = OLD.replace("light   nothing\n", "");
        let (probe, row) = ("top left: pixel 0,0", vec!["light   nothing"]);
        assert_eq!(changed_rows(OLD, &without), [ChangedRow { probe, before: row.clone(), now: vec![] }]);
        assert_eq!(changed_rows(&without, OLD), [ChangedRow { probe, before: vec![], now: row }]);
    }
}

//! The graph of the chapters: what builds on what, drawn in layers from the top to the bottom.

use crate::check::course::Course;
use crate::edit::escape;
use std::fmt::Write;

/// The most chapters beside each other.
const BESIDE: usize = 4;
/// A chapter's box, and what an edge takes that passes between boxes.
const BOX: (f64, f64) = (126.0, 50.0);
const PASSING: f64 = 6.0;
/// The space between two in a layer, and between two layers.
const GAP: (f64, f64) = (10.0, 30.0);
const LETTERS: usize = 18;
const LINE: f64 = 14.0;
/// How strongly the drawing's middle attracts a place, where each neighbour attracts with 1.
const MIDDLE: f64 = 1.0;
/// How often the places in the layers are improved.
const SWEEPS: usize = 24;

/// What stands in a layer: a chapter, or an edge that goes on to a deeper one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Chapter(usize),
    Passing,
}

/// One place in a layer.
#[derive(Debug, Clone)]
struct Place {
    kind: Kind,
    /// The places of the layer above that lead here, and of the layer below to which it leads.
    above: Vec<usize>,
    below: Vec<usize>,
    x: f64,
}

impl Place {
    fn new(kind: Kind) -> Self {
        Self { kind, above: Vec::new(), below: Vec::new(), x: 0.0 }
    }

    fn width(&self) -> f64 {
        if self.kind == Kind::Passing { PASSING } else { BOX.0 }
    }
}

/// The drawing, as a part of a page.
pub fn drawn(course: &Course) -> String {
    let (mut places, mut layers) = layered(course);
    for sweep in 0..SWEEPS {
        let down = sweep % 2 == 0;
        let order: Vec<usize> = if down { (0..layers.len()).collect() } else { (0..layers.len()).rev().collect() };
        for layer in order {
            if sweep < SWEEPS / 2 {
                sort(&mut layers[layer], &places, down);
            }
            settle(&layers[layer], &mut places);
        }
    }
    svg(course, &places, &layers)
}

/// The layer of each chapter: below everything it builds on, and with a few others at most.
fn depths(course: &Course) -> Vec<usize> {
    let (mut depths, mut taken): (Vec<usize>, Vec<usize>) = (Vec::new(), Vec::new());
    for chapter in &course.chapters {
        let min = chapter.needs.iter().map(|&need| depths[need] + 1).max().unwrap_or(0);
        taken.resize(taken.len().max(min + 1), 0);
        let depth = (min..taken.len()).find(|&depth| taken[depth] < BESIDE).unwrap_or(taken.len());
        taken.resize(taken.len().max(depth + 1), 0);
        taken[depth] += 1;
        depths.push(depth);
    }
    depths
}

/// All places, the chapters first, and which of them stand in each layer.
fn layered(course: &Course) -> (Vec<Place>, Vec<Vec<usize>>) {
    let depths = depths(course);
    let mut places: Vec<Place> = (0..depths.len()).map(|chapter| Place::new(Kind::Chapter(chapter))).collect();
    let mut layers = vec![Vec::new(); depths.iter().max().map_or(0, |deepest| deepest + 1)];
    for (chapter, &depth) in depths.iter().enumerate() {
        layers[depth].push(chapter);
    }
    for chapter in 0..depths.len() {
        for need in course.essential(chapter) {
            let mut from = need;
            for layer in &mut layers[depths[need] + 1..depths[chapter]] {
                // Edges from one chapter run together until they part.
                let shared = places[from].below.iter().copied().find(|&next| places[next].kind == Kind::Passing);
                let next = shared.unwrap_or_else(|| {
                    places.push(Place::new(Kind::Passing));
                    let next = places.len() - 1;
                    layer.push(next);
                    join(&mut places, from, next);
                    next
                });
                from = next;
            }
            join(&mut places, from, chapter);
        }
    }
    (places, layers)
}

fn join(places: &mut [Place], from: usize, to: usize) {
    places[from].below.push(to);
    places[to].above.push(from);
}

/// Where a place would like to stand: amid its neighbours.
fn wanted(place: usize, places: &[Place]) -> f64 {
    let own = &places[place];
    let near: Vec<f64> = own.above.iter().chain(&own.below).map(|&near| places[near].x).collect();
    near.iter().sum::<f64>() / (near.len() as f64 + MIDDLE)
}

/// Orders a layer by where its neighbours on one side stand, so that few edges cross.
fn sort(layer: &mut [usize], places: &[Place], down: bool) {
    let middle = |&place: &usize| {
        let own = &places[place];
        let near = if down { &own.above } else { &own.below };
        let sum: f64 = near.iter().map(|&near| places[near].x).sum();
        if near.is_empty() { own.x } else { sum / near.len() as f64 }
    };
    layer.sort_by(|one, other| middle(one).total_cmp(&middle(other)));
}

/// Moves the places of a layer as near to where they want to be as their widths and their order allow.
fn settle(layer: &[usize], places: &mut [Place]) {
    let mut offset = 0.0;
    let mut offsets = Vec::new();
    for (at, &place) in layer.iter().enumerate() {
        let half = places[place].width() / 2.0;
        offset += if at == 0 { 0.0 } else { half + GAP.0 };
        offsets.push(offset);
        offset += half;
    }
    // Least squares in a given order: neighbours that want to pass each other stand together, at their mean.
    let mut blocks: Vec<(f64, usize)> = Vec::new();
    for (&place, offset) in layer.iter().zip(&offsets) {
        let mut block = (wanted(place, places) - offset, 1);
        while let Some(&(mean, count)) = blocks.last().filter(|(mean, _)| *mean > block.0) {
            blocks.pop();
            block = ((mean * count as f64 + block.0 * block.1 as f64) / (count + block.1) as f64, count + block.1);
        }
        blocks.push(block);
    }
    let means = blocks.iter().flat_map(|&(mean, count)| std::iter::repeat_n(mean, count));
    for ((&place, offset), mean) in layer.iter().zip(&offsets).zip(means) {
        places[place].x = mean + offset;
    }
}

fn svg(course: &Course, places: &[Place], layers: &[Vec<usize>]) -> String {
    let left = places.iter().map(|place| place.x - place.width() / 2.0).fold(f64::INFINITY, f64::min) - 2.0;
    let right = places.iter().map(|place| place.x + place.width() / 2.0).fold(f64::NEG_INFINITY, f64::max) + 2.0;
    let (width, height) = (right - left, layers.len() as f64 * (BOX.1 + GAP.1) - GAP.1 + 4.0);
    let mut out = format!(
        "<div class=\"course\">\n<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width:.0} {height:.0}\" \
         width=\"{width:.0}\" height=\"{height:.0}\" font-size=\"12\" text-anchor=\"middle\" role=\"group\" \
         aria-label=\"The graph of the chapters: each stands below those that it builds on\">\n"
    );
    let top = |layer: usize| 2.0 + layer as f64 * (BOX.1 + GAP.1);
    let mut boxes = String::new();
    for (layer, members) in layers.iter().enumerate() {
        for &member in members {
            let own = &places[member];
            let (x, bottom) = (own.x - left, top(layer) + BOX.1);
            if own.kind == Kind::Passing {
                let _ = writeln!(out, "<path class=\"edge\" d=\"M{x:.1} {:.1}V{bottom:.1}\"/>", top(layer));
            }
            for &next in &own.below {
                let (to, end) = (places[next].x - left, bottom + GAP.1);
                let middle = bottom + GAP.1 / 2.0;
                let _ = writeln!(
                    out,
                    "<path class=\"edge\" d=\"M{x:.1} {bottom:.1}C{x:.1} {middle:.1} {to:.1} {middle:.1} {to:.1} {end:.1}\"/>"
                );
            }
            if let Kind::Chapter(chapter) = own.kind {
                boxes += &chapter_box(course, chapter, x, top(layer));
            }
        }
    }
    out + &boxes + "</svg>\n</div>\n"
}

/// A chapter's box with its title, a link to its page.
fn chapter_box(course: &Course, chapter: usize, x: f64, top: f64) -> String {
    let taught = &course.chapters[chapter];
    let [direct, _] = course.builds_on(chapter);
    let class = if direct.is_empty() { " class=\"last\"" } else { "" };
    let lines = lines_of(&taught.title);
    let first = top + BOX.1 / 2.0 + 4.0 - (lines.len() - 1) as f64 * LINE / 2.0;
    let mut text = String::new();
    for (at, line) in lines.iter().enumerate() {
        let y = first + at as f64 * LINE;
        let _ = write!(text, "<tspan x=\"{x:.1}\" y=\"{y:.1}\">{}</tspan>", escape(line));
    }
    format!(
        "<a href=\"{}\"{class}><rect x=\"{:.1}\" y=\"{top:.1}\" width=\"{}\" height=\"{}\" rx=\"4\"/><text>{text}</text></a>\n",
        taught.name,
        x - BOX.0 / 2.0,
        BOX.0,
        BOX.1
    )
}

/// A title in lines that fit a box.
fn lines_of(title: &str) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in title.split_whitespace() {
        match lines.last_mut() {
            Some(line) if line.chars().count() + 1 + word.chars().count() <= LETTERS => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check::course::made_up;
    use crate::check::read_pages;

    #[test]
    fn every_chapter_is_drawn_once_and_leads_to_its_page() {
        let course = Course::of(&made_up()).expect("a course");
        let svg = drawn(&course);
        assert_eq!(svg.matches("<rect").count(), 4);
        assert_eq!(svg.matches("class=\"edge\"").count(), 3, "{svg}");
        assert!(svg.contains("<a href=\"monte_carlo.md\" class=\"last\">") && svg.contains("<a href=\"01_a.md\">"));
        assert!(!svg.contains("\n\n"), "a blank line would end the HTML in markdown");
    }

    #[test]
    fn boxes_keep_apart_and_stand_below_what_they_build_on() {
        let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
        let course = Course::of(&read_pages(&folder).expect("pages")).expect("a course");
        let depths = depths(&course);
        for (at, chapter) in course.chapters.iter().enumerate() {
            assert!(chapter.needs.iter().all(|&need| depths[need] < depths[at]), "{}", chapter.name);
            assert!(depths.iter().filter(|&&depth| depth == depths[at]).count() <= BESIDE);
        }
        let (mut places, layers) = layered(&course);
        layers.iter().for_each(|layer| settle(layer, &mut places));
        for layer in &layers {
            for pair in layer.windows(2) {
                let [one, other] = [&places[pair[0]], &places[pair[1]]];
                assert!(other.x - one.x >= (one.width() + other.width()) / 2.0 + GAP.0 - 1e-6);
            }
        }
        assert!(course.chapters.iter().all(|chapter| lines_of(&chapter.title).len() <= 3), "three lines fit a box");
    }
}

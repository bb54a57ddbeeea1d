//! Umbra and penumbra behind an edge under a light of some width.

use super::Figure;
use super::label::Label;
use super::pen::{INK, Pen};
use super::svg::{Drawing, Svg};
use glam::DVec2;
use pinhole::{Chapter, Result};

const HEIGHT: f64 = 348.0;
/// The light's ends, the edge, and where the floor lies and ends.
const LIGHT: [DVec2; 2] = [DVec2::new(240.0, 44.0), DVec2::new(360.0, 44.0)];
const EDGE: DVec2 = DVec2::new(300.0, 144.0);
const FLOOR: [f64; 3] = [60.0, 294.0, 560.0];
const YELLOW: &str = "#d9a62b";

/// Where the line from a point of the light past the edge meets the floor.
fn past_the_edge(from: DVec2) -> DVec2 {
    from + (EDGE - from) * ((FLOOR[1] - from.y) / (EDGE.y - from.y))
}

/// The light, an edge below it, and the three parts of the floor.
pub fn draw(_: &Chapter, figure: &Figure) -> Result<Drawing> {
    let [left, floor, right] = FLOOR;
    let mut svg = Svg::new(figure.name, HEIGHT);
    let [first, last] = [LIGHT[1], LIGHT[0]].map(past_the_edge);
    for (light, foot) in [(LIGHT[1], first), (LIGHT[0], last)] {
        svg.quiet_line(light, foot, Pen::new(YELLOW, 1.4).dashed("5 4"));
    }
    svg.quiet_line(LIGHT[0], LIGHT[1], Pen::new(YELLOW, 6.0));
    svg.quiet_line(DVec2::new(left, EDGE.y), EDGE, Pen::new(INK, 5.0));
    let ends = [DVec2::new(left, floor), first, last, DVec2::new(right, floor)];
    for ((pair, opacity), name) in ends.windows(2).zip([1.0, 0.5, 0.16]).zip([
        "umbra: none of the light is seen",
        "penumbra: a part of it",
        "all of it",
    ]) {
        svg.quiet_line(pair[0], pair[1], Pen::new(INK, 7.0).faint(opacity));
        svg.label(Label::near(0.5 * (pair[0] + pair[1]), name, DVec2::Y, 10.0).title(0.85));
    }
    // The measures stand beside what they measure.
    let aside = 470.0;
    for (name, from, to) in [("a", LIGHT[0].y, EDGE.y), ("b", EDGE.y, floor)] {
        let [top, bottom] = [from, to].map(|y| DVec2::new(aside, y));
        svg.quiet_line(top, bottom, Pen::new(INK, 1.0));
        for end in [top, bottom] {
            svg.quiet_line(end - DVec2::X * 5.0, end + DVec2::X * 5.0, Pen::new(INK, 1.0));
        }
        svg.label(Label::near(0.5 * (top + bottom), name, DVec2::X, 7.0));
    }
    svg.label(Label::near(0.5 * (LIGHT[0] + LIGHT[1]), "light, w wide", DVec2::NEG_Y, 8.0));
    svg.label(Label::near(DVec2::new(0.5 * (left + EDGE.x), EDGE.y), "what hides it", DVec2::NEG_Y, 7.0));
    svg.label(Label::near(0.5 * (first + last), "w b / a", DVec2::NEG_Y, 8.0));
    let foot = format!("for chapter {} · cargo run --release -- figure {}", figure.chapter, figure.name);
    Ok(svg.finish(figure.about, &foot))
}

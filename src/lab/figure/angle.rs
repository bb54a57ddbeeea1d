use super::label::Placed;
use super::pen::{INK, LARGE_TEXT, Pen};
use super::svg::Svg;
use glam::DVec2;
use std::f64::consts::TAU;

/// Straight parts of a whole circle.
const PARTS: u32 = 72;

/// Marks the angle between two directions of the drawing by an arc, and returns the arc's middle.
pub fn arc(svg: &mut Svg, centre: DVec2, [from, to]: [DVec2; 2], radius: f64, pen: Pen) -> DVec2 {
    let angle = libm::atan2(from.perp_dot(to), from.dot(to));
    let start = from.normalize_or_zero() * radius;
    let at = |step: u32| {
        let turned = angle * f64::from(step) / 12.0;
        centre + DVec2::new(libm::cos(turned), libm::sin(turned)).rotate(start)
    };
    for step in 0..12 {
        svg.line(at(step), at(step + 1), pen);
    }
    at(6)
}

/// A part of a circle, from one angle to another, anticlockwise from the right; labels may cross it.
pub fn bow(svg: &mut Svg, centre: DVec2, radius: f64, [from, to]: [f64; 2], pen: Pen) {
    let parts = ((to - from).abs() / TAU * f64::from(PARTS)).ceil().max(1.0);
    let at = |part: f64| {
        let angle = from + (to - from) * part / parts;
        centre + radius * DVec2::new(libm::cos(angle), -libm::sin(angle))
    };
    for part in 0..parts as u32 {
        svg.quiet_line(at(f64::from(part)), at(f64::from(part) + 1.0), pen);
    }
}

/// Large words at a fixed place, as in a row of a table; `anchor` is SVG's.
pub fn write(svg: &mut Svg, at: DVec2, anchor: &'static str, text: &str) {
    write_in(svg, at, anchor, text, INK);
}

/// The same in a colour.
pub fn write_in(svg: &mut Svg, at: DVec2, anchor: &'static str, text: &str, colour: &'static str) {
    let placed = Placed { point: at, at, anchor, size: LARGE_TEXT, colour, text: text.into(), crosses: 0 };
    svg.words(&placed, 1.0);
}

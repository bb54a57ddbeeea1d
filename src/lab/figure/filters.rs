//! Filters as curves, one small drawing each, at one scale.

use super::Figure;
use super::label::Label;
use super::pen::{IMAGE, INK, Pen, RAY, WIDTH};
use super::svg::{Drawing, Svg};
use glam::DVec2;
use pinhole::Chapter;
use pinhole::Result;
use pinhole::extract::{filter_area, filter_value, radius_of};
use pinhole::scene::Filter;

const HEIGHT: f64 = 226.0;
/// How far to each side a drawing reaches, in pixels.
const EXTENT: f64 = 2.1;
/// The drawing's units of a height of 1 a pixel.
const TALL: f64 = 96.0;
const BASE: f64 = 142.0;
const STEPS: u32 = 168;

/// Every filter with its defaults, each of area 1, over the pixel's own square.
pub fn draw(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let mut svg = Svg::new(figure.name, HEIGHT);
    let each = (WIDTH - 24.0) / Filter::ALL.len() as f64;
    let scale = (each - 14.0) / (2.0 * EXTENT);
    for (number, (word, filter)) in (0_u32..).zip(Filter::ALL) {
        let centre = DVec2::new(12.0 + each * (f64::from(number) + 0.5), BASE);
        let at = |x: f64, y: f64| centre + DVec2::new(x * scale, -y * TALL);
        for side in [-0.5, 0.5] {
            svg.quiet_line(at(side, -0.12), at(side, 1.1), Pen::new(IMAGE, 1.2).faint(0.7).dashed("3 3"));
        }
        svg.quiet_line(at(-EXTENT, 0.0), at(EXTENT, 0.0), Pen::new(INK, 0.8).faint(0.6));
        for x in [-2, -1, 0, 1, 2] {
            svg.quiet_line(at(f64::from(x), 0.0), at(f64::from(x), -0.03), Pen::new(INK, 0.8).faint(0.8));
        }
        let area = 2.0 * filter_area(filter, radius_of(filter));
        let point = |step: u32| {
            let x = (f64::from(step) / f64::from(STEPS) * 2.0 - 1.0) * EXTENT;
            at(x, filter_value(filter, x.abs()) / area)
        };
        for step in 0..STEPS {
            svg.quiet_line(point(step), point(step + 1), Pen::new(RAY, 2.0));
        }
        svg.label(Label::near(at(0.0, -0.16), word, DVec2::Y, 8.0));
        let radius = format!("to {} pixels", radius_of(filter));
        svg.label(Label::near(at(0.0, -0.36), &radius, DVec2::Y, 8.0).title(0.85));
    }
    let note = format!("for chapter {} · dashed: the pixel's own square", chapter.name);
    Ok(svg.finish(figure.about, &format!("{note} · cargo run --release -- figure {}", figure.name)))
}

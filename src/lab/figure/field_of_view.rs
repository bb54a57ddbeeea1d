//! The image plane at distance 1, from the side.

use super::Figure;
use super::label::Label;
use super::pen::{IMAGE, INK, Pen, RAY, WIDTH};
use super::subject::{Lens, Subject};
use super::svg::{Drawing, Svg};
use glam::DVec2;
use pinhole::Chapter;
use pinhole::Result;

const HEIGHT: f64 = 420.0;
/// How far the rays may reach to the right, up and down.
const REACH: DVec2 = DVec2::new(WIDTH - 190.0, 166.0);
/// Room for the words at the eye, and for those at the right.
const WORDS: DVec2 = DVec2::new(56.0, 96.0);
/// How far the rays are drawn, in distances of the plane.
const FAR: f64 = 2.25;

/// Eye, image plane and half angle of the chapter's camera, seen from its right side and laid flat.
pub fn draw(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let subject = Subject::of(chapter, 48, 27)?;
    let Lens::Perspective(tangent) = subject.lens else { return Err(figure.unsuited("a perspective camera")) };
    let scale = (REACH.x / FAR).min(REACH.y / (2.0 * tangent));
    let spare = WIDTH - WORDS.x - WORDS.y - FAR * scale;
    let eye = DVec2::new(WORDS.x + spare.max(0.0) / 2.0, REACH.y + 26.0);
    let at = |ahead: f64, up: f64| eye + scale * DVec2::new(ahead, -up);
    let mut svg = Svg::new(figure.name, HEIGHT);
    paint(&mut svg, &at, tangent);
    let angle = libm::atan(tangent);
    arc(&mut svg, eye, scale * 0.62, -angle, angle, Pen::new(INK, 1.1));
    arc(&mut svg, eye, scale * 0.36, 0.0, angle, Pen::new(RAY, 1.8));
    let along =
        |share: f64, at: f64| eye + scale * at * DVec2::new(libm::cos(share * angle), -libm::sin(share * angle));
    svg.label(Label::near(along(-0.5, 0.62), "*φ*", DVec2::new(1.0, 0.25), 6.0));
    svg.label(Label::near(along(0.5, 0.36), "*φ*/2", DVec2::new(1.0, -0.25), 5.0).coloured(RAY));
    svg.label(Label::near(at(0.0, 0.0), "eye", DVec2::new(-1.0, 0.0), 9.0));
    svg.label(Label::near(at(1.0, tangent / 2.0), "tan(*φ*/2)", DVec2::X, 9.0).coloured(RAY));
    svg.label(Label::near(at(2.0, tangent), "2 tan(*φ*/2)", DVec2::X, 9.0));
    svg.label(Label::near(at(1.0, tangent), "screen *y* = 1", DVec2::new(-0.6, -1.0), 9.0));
    svg.label(Label::near(at(1.0, -tangent), "screen *y* = −1", DVec2::new(-0.6, 1.0), 9.0));
    svg.label(Label::near(at(1.0, -0.55 * tangent), "image plane", DVec2::X, 9.0).coloured(IMAGE));
    svg.label(Label::near(at(FAR, 0.0), "−*z*", DVec2::X, 8.0));
    let below = at(0.0, -2.0 * tangent).y + 22.0;
    for (from, to, row, words) in [(0.0, 1.0, below, "1"), (1.0, 2.0, below, "1")] {
        let [from, to] = [from, to].map(|ahead| DVec2::new(at(ahead, 0.0).x, row));
        measure(&mut svg, from, to);
        svg.label(Label::near((from + to) / 2.0, words, DVec2::Y, 5.0).title(1.0));
    }
    let note = format!("seen from the side, tan(φ/2) = {tangent:.3}");
    Ok(svg.finish(figure.about, &figure.foot(&subject, &note)))
}

fn paint(svg: &mut Svg, at: &impl Fn(f64, f64) -> DVec2, tangent: f64) {
    svg.arrow(at(0.0, 0.0), at(FAR, 0.0), Pen::new(INK, 1.0).faint(0.7).dashed("6 4"));
    for up in [tangent, -tangent] {
        svg.line(at(0.0, 0.0), at(1.0, up), Pen::new(RAY, 1.8));
        svg.line(at(1.0, up), at(2.08, 2.08 * up), Pen::new(RAY, 1.4).faint(0.6));
    }
    svg.line(at(1.0, -tangent), at(1.0, 0.0), Pen::new(IMAGE, 4.0));
    svg.line(at(1.0, 0.0), at(1.0, tangent), Pen::new(IMAGE, 4.0));
    svg.line(at(1.0, 0.0), at(1.0, tangent), Pen::new(RAY, 1.4));
    svg.line(at(2.0, -2.0 * tangent), at(2.0, 2.0 * tangent), Pen::new(IMAGE, 1.4).faint(0.8).dashed("4 4"));
    let (corner, side) = (at(1.0, 0.0), 9.0);
    svg.quiet_line(corner + DVec2::new(-side, 0.0), corner + DVec2::new(-side, -side), Pen::new(INK, 1.0));
    svg.quiet_line(corner + DVec2::new(-side, -side), corner + DVec2::new(0.0, -side), Pen::new(INK, 1.0));
    svg.dot(at(0.0, 0.0), 4.5, INK);
}

/// Part of a circle around the eye, between two angles above the view.
fn arc(svg: &mut Svg, eye: DVec2, radius: f64, low: f64, high: f64, pen: Pen) {
    let point = |step: i32| {
        let angle = low + (high - low) * f64::from(step) / 24.0;
        eye + radius * DVec2::new(libm::cos(angle), -libm::sin(angle))
    };
    for step in 0..24 {
        svg.line(point(step), point(step + 1), pen);
    }
}

/// A length with a head at each end.
fn measure(svg: &mut Svg, from: DVec2, to: DVec2) {
    let pen = Pen::new(INK, 1.1).faint(0.75);
    svg.line(from, to, pen);
    svg.head(from, -DVec2::X, pen);
    svg.head(to, DVec2::X, pen);
}

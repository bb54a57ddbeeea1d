//! How many terms of their series sine and cosine need, near 0 and far from it.

use super::Figure;
use super::label::Label;
use super::pen::{INK, Pen};
use super::svg::{Drawing, Svg};
use crate::naive::rows::{circle_by_terms, series};
use glam::DVec2;
use pinhole::sample::circle_point;
use pinhole::{Chapter, Result};
use std::f64::consts::TAU;

/// Where the axes are: left, top, right, bottom.
const FRAME: [f64; 4] = [66.0, 24.0, 560.0, 300.0];
const HEIGHT: f64 = 366.0;
/// The maximum number of terms, and the powers of ten between which errors are shown.
const TERMS: u32 = 16;
const DECADES: [i32; 2] = [-18, 3];

/// The worst distance from the circle's point over a turn, by this many terms.
fn worst(terms: u32, circle: fn(f64, u32) -> [f64; 2]) -> f64 {
    let apart = |step: u32| {
        let turn = f64::from(step) / 1024.0;
        let ([x, y], [right, up]) = (circle(turn, terms), circle_point(turn));
        libm::hypot(x - right, y - up)
    };
    (0..1024).map(apart).fold(0.0, f64::max)
}

/// Error over terms, from 0 on and from the nearest quarter.
pub fn draw(_: &Chapter, figure: &Figure) -> Result<Drawing> {
    let [left, top, right, bottom] = FRAME;
    let at = |terms: f64, error: f64| {
        let part = (libm::log10(error) - f64::from(DECADES[0])) / f64::from(DECADES[1] - DECADES[0]);
        DVec2::new(left + (right - left) * (terms - 1.0) / f64::from(TERMS - 1), bottom - (bottom - top) * part)
    };
    let mut svg = Svg::new(figure.name, HEIGHT);
    let grid = Pen::new(INK, 0.8).faint(0.16);
    for decade in (DECADES[0]..=DECADES[1]).step_by(3) {
        let error = libm::exp10(f64::from(decade));
        let [foot, end] = [at(1.0, error), at(f64::from(TERMS), error)];
        svg.quiet_line(foot, end, grid);
        svg.label(Label::near(foot, &power(decade), DVec2::NEG_X, 6.0).title(0.85));
    }
    for terms in (1..=TERMS).filter(|terms| terms % 4 == 0) {
        let foot = at(f64::from(terms), libm::exp10(f64::from(DECADES[0])));
        svg.label(Label::near(foot, &terms.to_string(), DVec2::Y, 5.0).title(0.85));
    }
    for (name, unit) in [("an ulp of f32", 24), ("of f64", 53)] {
        let error = 1.0 / (1_u64 << unit) as f64;
        let [foot, end] = [at(1.0, error), at(f64::from(TERMS), error)];
        svg.quiet_line(foot, end, Pen::new(INK, 1.0).faint(0.5).dashed("2 4"));
        svg.label(Label::near(end, name, DVec2::X, 6.0).title(0.85));
    }
    let from_zero = |turn: f64, terms: u32| series(TAU * turn, terms);
    for (name, circle, colour, place) in [
        ("from 0 on", from_zero as fn(f64, u32) -> [f64; 2], "#d9822b", 8),
        ("from the nearest quarter of a turn", circle_by_terms, "#4a90c9", 3),
    ] {
        let points: Vec<DVec2> = (1..=TERMS).map(|terms| at(f64::from(terms), worst(terms, circle))).collect();
        points.windows(2).for_each(|pair| svg.quiet_line(pair[0], pair[1], Pen::new(colour, 2.0)));
        points.iter().for_each(|&point| svg.dot(point, 2.4, colour));
        svg.label(Label::near(points[place], name, DVec2::new(1.0, -0.6), 8.0).coloured(colour).title(0.92));
    }
    let middle = DVec2::new(0.5 * (left + right), bottom + 22.0);
    svg.label(Label::near(middle, "terms of each series", DVec2::Y, 0.0).title(0.92));
    svg.label(Label::near(DVec2::new(left, 8.0), "worst error", DVec2::X, 0.0).title(0.92));
    Ok(svg.finish(
        figure.about,
        &format!("scene {}, 1024 turns · cargo run --release -- figure {}", figure.chapter, figure.name),
    ))
}

/// A power of ten.
fn power(decade: i32) -> String {
    const RAISED: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let digits: String =
        decade.unsigned_abs().to_string().bytes().map(|digit| RAISED[(digit - b'0') as usize]).collect();
    match decade {
        0 => "1".into(),
        _ => format!("10{}{digits}", if decade < 0 { "⁻" } else { "" }),
    }
}

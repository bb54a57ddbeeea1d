//! What depends on the wavelength: indices of refraction, and what light of each adds to white.

use super::Figure;
use super::label::Label;
use super::pen::{INK, Pen};
use super::svg::{Drawing, Svg};
use glam::DVec2;
use pinhole::material::IndexCurve;
use pinhole::sample::{SPECTRUM, Spectrum};
use pinhole::scene::Dispersion;
use pinhole::{Chapter, Result};

/// Where the axes are: left, top, right, bottom.
const FRAME: [f64; 4] = [66.0, 30.0, 560.0, 250.0];
const HEIGHT: f64 = 312.0;
/// A curve's points, one for each 2 nm.
const STEPS: u32 = (SPECTRUM[1] - SPECTRUM[0]) / 2;

const RED: &str = "#c8442f";
const GREEN: &str = "#4f9d5d";
const BLUE: &str = "#4a74c9";

/// Axes over the wavelength, and a place in them.
struct Axes {
    svg: Svg,
    /// The numbers at the bottom and at the top.
    range: [f64; 2],
}

impl Axes {
    fn new(name: &'static str, range: [f64; 2], lines: &[f64]) -> Self {
        let mut axes = Self { svg: Svg::new(name, HEIGHT), range };
        let [first, last] = SPECTRUM.map(f64::from);
        for &number in lines {
            let (foot, end) = (axes.at(first, number), axes.at(last, number));
            axes.svg.quiet_line(foot, end, Pen::new(INK, 0.8).faint(if number == 0.0 { 0.6 } else { 0.16 }));
            axes.svg.label(Label::near(foot, &format!("{number}"), DVec2::NEG_X, 6.0).title(0.85));
        }
        for nm in [400, 500, 600, 700] {
            let foot = axes.at(f64::from(nm), range[0]);
            axes.svg.label(Label::near(foot, &format!("{nm} nm"), DVec2::Y, 6.0).title(0.85));
        }
        axes
    }

    fn at(&self, wavelength: f64, number: f64) -> DVec2 {
        let ([left, top, right, bottom], [first, last]) = (FRAME, SPECTRUM.map(f64::from));
        let part = (number - self.range[0]) / (self.range[1] - self.range[0]);
        DVec2::new(left + (right - left) * (wavelength - first) / (last - first), bottom - (bottom - top) * part)
    }

    /// Draws a function of the wavelength, with its name beside it at one wavelength.
    fn curve(&mut self, (name, wavelength, side): (&str, f64, DVec2), pen: Pen, function: &dyn Fn(f64) -> f64) {
        let at = |step: u32| f64::from(SPECTRUM[0] + 2 * step);
        let points: Vec<DVec2> = (0..=STEPS).map(|step| self.at(at(step), function(at(step)))).collect();
        points.windows(2).for_each(|pair| self.svg.quiet_line(pair[0], pair[1], pen));
        let beside = self.at(wavelength, function(wavelength));
        self.svg.label(Label::near(beside, name, side, 7.0).title(0.9));
    }

    fn finish(self, figure: &Figure) -> Drawing {
        let stamp = format!("scene {} · cargo run --release -- figure {}", figure.chapter, figure.name);
        self.svg.finish(figure.about, &stamp)
    }
}

/// The index of three glasses.
pub fn draw_indices(_: &Chapter, figure: &Figure) -> Result<Drawing> {
    let mut axes = Axes::new(figure.name, [1.3, 1.9], &[1.3, 1.4, 1.5, 1.6, 1.7, 1.8, 1.9]);
    for (name, glass, colour) in
        [("SF11", Dispersion::Sf11, RED), ("BK7", Dispersion::Bk7, BLUE), ("water", Dispersion::Water, GREEN)]
    {
        let curve = IndexCurve::of(glass);
        axes.curve((name, 620.0, DVec2::NEG_Y), Pen::new(colour, 2.2), &|wavelength| curve.index(wavelength));
    }
    Ok(axes.finish(figure))
}

/// What a nanometre adds to each channel of white, and its probability.
pub fn draw_weights(_: &Chapter, figure: &Figure) -> Result<Drawing> {
    let mut axes = Axes::new(figure.name, [-0.008, 0.02], &[-0.005, 0.0, 0.005, 0.01, 0.015, 0.02]);
    for (name, channel, colour, wavelength, side) in
        [("red", 0, RED, 622.0, DVec2::X), ("green", 1, GREEN, 560.0, DVec2::X), ("blue", 2, BLUE, 462.0, DVec2::X)]
    {
        axes.curve((name, wavelength, side), Pen::new(colour, 2.2), &|own| Spectrum::get().white_share(own).0[channel]);
    }
    axes.curve(("sampled", 645.0, DVec2::X), Pen::new(INK, 1.4), &|own| Spectrum::get().white_share(own).1);
    Ok(axes.finish(figure))
}

//! What glass mirrors at each angle, from outside and from inside.

use super::Figure;
use super::label::Label;
use super::pen::{IMAGE, INK, Pen, RAY, WIDTH};
use super::svg::{Drawing, Svg};
use crate::naive::material::schlick;
use glam::DVec2;
use pinhole::Result;
use pinhole::extract::GlassTable;
use pinhole::material::{fresnel, fresnel_parts};
use pinhole::plan::{Census, Table};
use pinhole::{Chapter, Overrides};

const HEIGHT: f64 = 290.0;
/// Where 0° and 0 stand in the first panel, and how far 90° and 1 are from there.
const CORNER: DVec2 = DVec2::new(50.0, 222.0);
const SIZE: DVec2 = DVec2::new(280.0, 190.0);
const STEPS: u32 = 180;

/// The reflectance over the angle for a chapter's first kind of glass: both parts, their mean, and Schlick's guess.
pub fn draw(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let glass = GlassTable::extract(&Census::of(&chapter.world(&Overrides::default())))?;
    let Some(&index) = glass.ior.first() else { return Err(figure.unsuited("glass")) };
    let mut svg = Svg::new(figure.name, HEIGHT);
    for (panel, (eta, told)) in [(index, "into the glass"), (1.0 / index, "out of it")].into_iter().enumerate() {
        let corner = CORNER + DVec2::X * (WIDTH / 2.0 - 5.0) * panel as f64;
        let at = |degrees: f64, reflectance: f64| corner + DVec2::new(degrees / 90.0, -reflectance) * SIZE;
        let curve = |svg: &mut Svg, pen: Pen, curve_of: &dyn Fn(f64) -> f64| {
            let point = |step: u32| {
                let degrees = f64::from(step) * 90.0 / f64::from(STEPS);
                at(degrees, curve_of(libm::cos(degrees.to_radians())))
            };
            (0..STEPS).for_each(|step| svg.line(point(step), point(step + 1), pen));
        };
        svg.line(at(0.0, 0.0), at(90.0, 0.0), Pen::new(INK, 1.2));
        svg.line(at(0.0, 0.0), at(0.0, 1.0), Pen::new(INK, 1.2));
        for degrees in [30.0, 60.0, 90.0] {
            svg.line(at(degrees, 0.0), at(degrees, -0.03), Pen::new(INK, 1.2));
            svg.label(Label::near(at(degrees, -0.03), &format!("{degrees}°"), DVec2::Y, 4.0).title(0.85));
        }
        svg.label(Label::near(at(0.0, 1.0), "1", DVec2::NEG_X, 6.0).title(0.85));
        svg.label(Label::near(at(0.0, 0.0), "0", DVec2::NEG_X, 6.0).title(0.85));
        curve(&mut svg, Pen::new(INK, 1.0).faint(0.7), &|cosine| fresnel_parts(cosine, eta)[0]);
        curve(&mut svg, Pen::new(INK, 1.0).faint(0.7), &|cosine| fresnel_parts(cosine, eta)[1]);
        curve(&mut svg, Pen::new(IMAGE, 1.6).dashed("5 4"), &|cosine| schlick(cosine, eta));
        curve(&mut svg, Pen::new(RAY, 2.6), &|cosine| fresnel(cosine, eta));
        let half = at(45.0, -0.16);
        svg.label(Label::near(half, &format!("{told}, *η* = {eta:.3}"), DVec2::Y, 4.0).title(0.95));
        if panel == 0 {
            let named = |degrees: f64, curve_of: fn(f64, f64) -> f64| {
                at(degrees, curve_of(libm::cos(degrees.to_radians()), eta))
            };
            let across = named(66.0, |cosine, eta| fresnel_parts(cosine, eta)[0]);
            svg.label(Label::near(across, "*s*-polarised", DVec2::new(-1.0, -1.0), 8.0));
            let within = named(74.0, |cosine, eta| fresnel_parts(cosine, eta)[1]);
            svg.label(Label::near(within, "*p*-polarised", DVec2::new(1.0, 0.6), 8.0));
            svg.label(Label::near(named(52.0, schlick), "Schlick", DVec2::new(-0.4, -1.0), 8.0).coloured(IMAGE));
        } else {
            svg.label(Label::near(at(62.0, 0.12), "Schlick", DVec2::new(0.4, 1.0), 6.0).coloured(IMAGE));
            svg.label(Label::near(at(66.0, 1.0), "total reflection", DVec2::Y, 8.0).coloured(RAY));
        }
    }
    Ok(svg.finish(figure.about, &figure.stamp([480, 270], "the reflectance over the angle to the normal")))
}

//! Reflection and refraction at a surface of glass, with the parts of each direction along the surface and the normal.

use super::Figure;
use super::angle::{arc, bow, write};
use super::label::Label;
use super::pen::{Fill, IMAGE, INK, LIGHT, Pen, RAY};
use super::svg::{Drawing, Svg};
use glam::{DVec2, DVec3};
use pinhole::Result;
use pinhole::extract::GlassTable;
use pinhole::material::{fresnel, mirror_direction, refract};
use pinhole::plan::{Census, Table};
use pinhole::{Chapter, Overrides};
use std::f64::consts::TAU;

const HEIGHT: f64 = 520.0;
/// Where the rays into the glass hit the surface, and the length of a unit vector there.
const FOOT: DVec2 = DVec2::new(212.0, 246.0);
const UNIT: f64 = 158.0;
/// The same out of the glass, below the critical angle and beyond it.
const FEET: [DVec2; 2] = [DVec2::new(574.0, 140.0), DVec2::new(574.0, 374.0)];
const SMALL_UNIT: f64 = 88.0;
/// The angle of incidence in air, and how far from the critical angle the two others are, in degrees.
const INCIDENCE: f64 = 50.0;
const BELOW_AND_BEYOND: [f64; 2] = [-8.0, 14.0];

/// Into a chapter's first kind of glass, with all parts; and out of it, at two angles of incidence.
pub fn draw(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let glass = GlassTable::extract(&Census::of(&chapter.world(&Overrides::default())))?;
    let Some(&index) = glass.ior.first().filter(|&&index| index > 1.0) else {
        return Err(figure.unsuited("glass denser than air"));
    };
    let mut svg = Svg::new(figure.name, HEIGHT);
    into_glass(&mut svg, index);
    let critical = libm::asin(1.0 / index).to_degrees();
    for (foot, beside) in FEET.into_iter().zip(BELOW_AND_BEYOND) {
        out_of_glass(&mut svg, foot, 1.0 / index, (critical + beside).round());
    }
    write(&mut svg, DVec2::new(FEET[1].x, FOOT.y + 236.0), "middle", "out of the glass");
    let note = format!("η = {index} and 1/{index} · critical angle {critical:.1}°");
    let foot = format!("scene {}, its glass · {note} · cargo run --release -- figure {}", chapter.name, figure.name);
    Ok(svg.finish(figure.about, &foot))
}

fn into_glass(svg: &mut Svg, eta: f64) {
    let at = |of_unit: DVec3| FOOT + on_page(of_unit) * UNIT;
    let arriving = incident(INCIDENCE);
    // Into a denser medium there is always a refracted direction.
    let bent = refract(arriving, DVec3::Y, eta).unwrap_or(arriving);
    medium(svg, FOOT, [-204.0, 204.0], [0.0, 216.0]);
    svg.line(FOOT - DVec2::X * 204.0, FOOT + DVec2::X * 204.0, Pen::new(INK, 1.6));
    bow(svg, FOOT, UNIT, [0.0, TAU], Pen::new(INK, 0.8).faint(0.35));
    svg.line(at(-DVec3::Y), FOOT, Pen::new(INK, 0.9).faint(0.6).dashed("5 4"));
    svg.arrow(FOOT, at(DVec3::Y * 1.22), Pen::new(INK, 1.8));

    let (start, mirrored) = (-arriving, mirror_direction(arriving, DVec3::Y));
    svg.arrow(at(start), FOOT, Pen::new(LIGHT, 3.0));
    svg.arrow(FOOT, at(mirrored), Pen::new(RAY, 1.6));
    svg.arrow(FOOT, at(bent), Pen::new(RAY, 3.0));
    let parts = Pen::new(IMAGE, 2.2);
    let (high, low) = (at(DVec3::Y * start.y), at(DVec3::Y * bent.y));
    svg.arrow(at(start), high, parts);
    svg.arrow(high, FOOT, parts);
    svg.arrow(FOOT, low, parts);
    svg.arrow(low, at(bent), parts);

    let [up, down] = [DVec2::NEG_Y, DVec2::Y];
    let thin = Pen::new(INK, 1.1);
    let near = arc(svg, FOOT, [on_page(start), up], 46.0, thin);
    let far = arc(svg, FOOT, [on_page(bent), down], 74.0, thin);
    svg.label(Label::near(at(DVec3::Y * 1.2), "*n*", DVec2::X, 9.0).large());
    svg.label(Label::near(at(start * 0.72), "*R*", DVec2::new(-1.0, 0.8), 8.0).large().coloured(LIGHT));
    let reflected = Label::near(at(mirrored), "*R* + 2*cn*", DVec2::new(0.5, -1.0), 6.0);
    svg.label(reflected.large().coloured(RAY));
    svg.label(Label::near(at(bent), "*ω*ₜ", DVec2::new(1.0, 0.6), 6.0).large().coloured(RAY));
    svg.label(Label::near(near, &format!("*θ* = {INCIDENCE}°"), DVec2::new(-0.3, -1.0), 10.0).large());
    let refracted = libm::acos(-bent.y).to_degrees();
    svg.label(Label::near(far, &format!("*θ*ₜ = {refracted:.1}°"), DVec2::new(1.0, -0.2), 34.0).large());
    let along = at(start).midpoint(high);
    svg.label(Label::near(along, "*R* + *cn*", up, 6.0).large().coloured(IMAGE));
    svg.label(Label::near(high.lerp(FOOT, 0.45), "*c*", DVec2::X, 8.0).large().coloured(IMAGE));
    svg.label(Label::near(low.midpoint(at(bent)), "(*R* + *cn*)/*η*", down, 8.0).large().coloured(IMAGE));
    svg.label(Label::near(FOOT.lerp(low, 0.6), "*g*/*η*", DVec2::NEG_X, 8.0).large().coloured(IMAGE));
    write(svg, FOOT + DVec2::new(-200.0, -18.0), "start", "air");
    write(svg, FOOT + DVec2::new(-200.0, 18.0), "start", "glass");
    write(svg, FOOT + DVec2::new(0.0, 236.0), "middle", "into the glass");
}

fn out_of_glass(svg: &mut Svg, foot: DVec2, eta: f64, degrees: f64) {
    let at = |of_unit: DVec3| foot + on_page(of_unit) * SMALL_UNIT;
    let arriving = incident(degrees);
    medium(svg, foot, [-138.0, 138.0], [-112.0, 0.0]);
    svg.line(foot - DVec2::X * 138.0, foot + DVec2::X * 138.0, Pen::new(INK, 1.6));
    let bent = refract(arriving, DVec3::Y, eta);
    let depth = if bent.is_some() { 0.85 } else { 0.4 };
    svg.line(at(DVec3::Y), at(-DVec3::Y * depth), Pen::new(INK, 0.9).faint(0.6).dashed("5 4"));
    let mirrored = mirror_direction(arriving, DVec3::Y);
    let reflectance = fresnel(-arriving.y, eta);
    let pen = |fraction: f64| Pen::new(RAY, 1.4 + 1.6 * fraction);
    svg.arrow(at(-arriving), foot, Pen::new(LIGHT, 3.0));
    svg.arrow(foot, at(mirrored), pen(reflectance));
    let near = arc(svg, foot, [on_page(-arriving), DVec2::NEG_Y], 34.0, Pen::new(INK, 1.1));
    svg.label(Label::near(near, &format!("*θ* = {degrees}°"), DVec2::new(-0.4, -1.0), 30.0).large());
    let told = format!("*F* = {}", if reflectance < 1.0 { format!("{reflectance:.2}") } else { "1".into() });
    svg.label(Label::near(at(mirrored), &told, DVec2::new(0.2, -1.0), 5.0).large().coloured(RAY));
    match bent {
        Some(bent) => {
            svg.arrow(foot, at(bent), pen(1.0 - reflectance));
            let far = arc(svg, foot, [on_page(bent), DVec2::Y], 34.0, Pen::new(INK, 1.1));
            let refracted = libm::acos(-bent.y).to_degrees();
            svg.label(Label::near(far, &format!("*θ*ₜ = {refracted:.1}°"), DVec2::new(0.2, 1.0), 22.0).large());
        }
        None => write(svg, foot + DVec2::new(0.0, 56.0), "middle", "total reflection"),
    }
    write(svg, foot + DVec2::new(-134.0, -18.0), "start", "glass");
    write(svg, foot + DVec2::new(-134.0, 18.0), "start", "air");
}

/// Tints the glass beside a surface: from left to right, from top to bottom of the foot.
fn medium(svg: &mut Svg, foot: DVec2, [left, right]: [f64; 2], [top, bottom]: [f64; 2]) {
    let corners = [(left, top), (right, top), (right, bottom), (left, bottom)];
    svg.polygon(&corners.map(|(x, y)| foot + DVec2::new(x, y)), Some(&Fill::new(IMAGE, 0.14)), None);
}

/// The direction of a ray that arrives from the upper left at this angle to the normal +y.
fn incident(degrees: f64) -> DVec3 {
    let angle = degrees.to_radians();
    DVec3::new(libm::sin(angle), -libm::cos(angle), 0.0)
}

/// A direction in the drawing, where y points down.
fn on_page(direction: DVec3) -> DVec2 {
    DVec2::new(direction.x, -direction.y)
}

//! A ray: a point, a unit vector, and t.

use super::Figure;
use super::label::Label;
use super::pen::{INK, Pen, RAY, WIDTH};
use super::pixel_ray::{PixelRay, screen_colour};
use super::section::Section;
use super::sketch::Frame;
use super::subject::{Ball, Subject};
use super::svg::{Drawing, Svg};
use glam::DVec2;
use pinhole::Chapter;
use pinhole::Result;

/// How steeply the ray rises in the drawing, in radians: enough to tell it from a line of the page.
const RISE: f64 = 0.16;
const HEIGHT: f64 = 340.0;

/// The model of a ray: r(t) = O + tR up to the surface that it meets.
pub fn draw(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let subject = first_with_sphere(chapter, figure)?;
    let (ray, ball, t) = centre_ray(&subject).ok_or_else(|| figure.unsuited("a sphere that a pixel's ray meets"))?;
    let end = ray_end(ray, ball, t);
    let frame = Frame { low: DVec2::new(46.0, 44.0), high: DVec2::new(WIDTH - 36.0, HEIGHT - 96.0) };
    let section = Section::new(ray, ball, RISE, &[DVec2::new(end, 0.0)], frame);
    let mut svg = Svg::new(figure.name, HEIGHT);
    section.paint_sphere(&mut svg, &screen_colour(ball.colour.map(|part| part as f32)));
    paint_ray(&mut svg, &section, t, end);
    paint_marks(&mut svg, &section, t);
    label(&mut svg, &section, t);
    Ok(svg.finish(figure.about, &figure.foot(&subject, &format!("pixel {},{}", ray.pixel[0], ray.pixel[1]))))
}

/// The coarsest run that has a ray which meets a sphere; an odd number of pixels has one in the middle.
fn first_with_sphere(chapter: &Chapter, figure: &Figure) -> Result<Subject> {
    for side in [1, 3, 9, 27] {
        let subject = Subject::of(chapter, 15 * side, 9 * side)?;
        if centre_ray(&subject).is_some() {
            return Ok(subject);
        }
    }
    Err(figure.unsuited("a sphere that a pixel's ray meets"))
}

/// Of the rays that meet a sphere, the one nearest the image's centre; with the sphere and t.
fn centre_ray(subject: &Subject) -> Option<(&PixelRay, &Ball, f64)> {
    let met = subject.rays.iter().filter_map(|ray| Some((ray, subject.ball_hit(ray)?, ray.hit?.0)));
    met.min_by(|a, b| subject.off_centre(a.0.pixel).total_cmp(&subject.off_centre(b.0.pixel)))
}

/// How far the ray is drawn: past the sphere, and past the last of its marks.
fn ray_end(ray: &PixelRay, ball: &Ball, t: f64) -> f64 {
    let beyond = (ball.centre - ray.origin).length() + ball.radius;
    (beyond + 0.12 * t).max(3.4)
}

fn paint_ray(svg: &mut Svg, section: &Section, t: f64, end: f64) {
    let at = |t| section.point(t, 0.0);
    svg.arrow(at(t), at(end), Pen::new(RAY, 1.4).faint(0.55).dashed("5 4"));
    svg.line(at(0.0), at(t), Pen::new(RAY, 1.8));
    svg.arrow(at(0.0), at(1.0), Pen::new(RAY, 4.0));
    svg.dot(at(0.0), 4.5, INK);
    svg.dot(at(t), 4.5, INK);
}

fn paint_marks(svg: &mut Svg, section: &Section, t: f64) {
    let tick = section.up() * 6.0;
    for whole in [1.0, 2.0, 3.0] {
        let at = section.point(whole, 0.0);
        svg.line(at - tick, at + tick, Pen::new(INK, 1.4));
    }
    let pen = Pen::new(INK, 1.1).faint(0.75);
    section.drop(svg, 0.0, 80.0);
    section.drop(svg, 1.0, 40.0);
    section.drop(svg, t, 80.0);
    let unit = section.measure(svg, 0.0, 1.0, 40.0, pen);
    let whole = section.measure(svg, 0.0, t, 80.0, pen);
    let below = -section.up();
    svg.label(Label::near(unit, "length 1", below, 6.0));
    svg.label(Label::near(whole, &format!("*t* = {t:.3}"), below, 6.0));
}

fn label(svg: &mut Svg, section: &Section, t: f64) {
    let (at, up) = (|t| section.point(t, 0.0), section.up());
    svg.label(Label::near(at(0.0), "*O*", DVec2::new(-1.0, -0.6), 9.0));
    svg.label(Label::near(section.point(0.5, 0.0), "*R*", up, 10.0).coloured(RAY));
    // A whole number that is also the hit's t gets no second label on the same point.
    let apart = |whole: &f64| (whole - t).abs() * section.scale > 40.0;
    for whole in [1.0, 2.0, 3.0].into_iter().filter(apart) {
        svg.label(Label::near(at(whole), &format!("*r*({whole})"), up, 10.0));
    }
    svg.label(Label::near(at(t), "*r*(*t*)", up - section.along * 0.7, 10.0));
    let centre = section.point(section.centre.x, section.centre.y);
    svg.label(Label::near(
        centre + up * section.radius * section.scale,
        "sphere, cut through",
        up + section.along,
        8.0,
    ));
    svg.label(Label::near(section.point(t * 0.5, 0.0), "*r*(*t*) = *O* + *t* *R*", up, 52.0).title(1.3));
}

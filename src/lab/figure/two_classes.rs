//! Object-order and image-order rendering, side by side.

use super::Figure;
use super::label::Label;
use super::pen::{Fill, IMAGE, INK, LIGHT, Pen, RAY, WIDTH};
use super::pinhole::{chosen_rays, distance_note, eye_scenery};
use super::pixel_ray::PixelRay;
use super::props::paint_eye;
use super::scenery::{Scenery, Strand};
use super::sketch::Frame;
use super::subject::{Ball, Lens, Subject};
use super::svg::{Drawing, Svg};
use glam::{DVec2, DVec3};
use pinhole::Chapter;
use pinhole::Result;

/// How large signs are in half a drawing.
const SIGNS: f64 = 0.8;
const HALF: f64 = WIDTH / 2.0;

/// The same scene twice: objects projected onto the image, and pixels that ask where their light came from.
pub fn draw(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let subject = Subject::of(chapter, 12, 8)?;
    if matches!(subject.lens, Lens::Orthographic(_)) {
        return Err(figure.unsuited("a perspective camera"));
    }
    let rays = chosen_rays(&subject);
    if rays.is_empty() {
        return Err(figure.unsuited("a sphere that a pixel's ray meets"));
    }
    let frame = |left: f64| Frame { low: DVec2::new(left + 8.0, 58.0), high: DVec2::new(left + HALF - 8.0, 400.0) };
    let [left, right] = [eye_scenery(&subject, &rays, frame(0.0))?, eye_scenery(&subject, &rays, frame(HALF))?];
    let bottom = left.bottom;
    let mut svg = Svg::new(figure.name, bottom + 36.0);
    svg.line(DVec2::new(HALF, 8.0), DVec2::new(HALF, bottom), Pen::new(INK, 0.8).faint(0.3));
    panel(&mut svg, &left, &inward(&left, &rays), frame(0.0), "projective: object → pixel");
    for point in object_points(&left, &rays) {
        arrive(&mut svg, &left, point);
    }
    panel(&mut svg, &right, &outward(&right, &rays), frame(HALF), "image-space: pixel → object → light");
    if let Some(light) = subject.lights.first() {
        svg.label(Label::near(right.point(*light), "light", DVec2::X, 14.0).within(frame(HALF).taller(12.0)));
    }
    Ok(svg.finish(figure.about, &figure.foot(&subject, &distance_note(&left))))
}

fn panel(svg: &mut Svg, scenery: &Scenery<'_>, strands: &[Strand], frame: Frame, title: &str) {
    scenery.paint(svg, strands, SIGNS);
    let ahead = scenery.sketch.direction(-scenery.subject.axes.z_axis);
    paint_eye(svg, scenery.point(DVec3::ZERO), ahead, SIGNS);
    let head = DVec2::new((frame.low.x + frame.high.x) / 2.0, 24.0);
    svg.label(Label::near(head, title, DVec2::NEG_Y, 0.0).title(1.05));
    let near = |point, text: &str, toward, distance| {
        Label::near(scenery.point(point), text, toward, distance).within(frame.taller(12.0))
    };
    svg.label(near(DVec3::ZERO, "eye", DVec2::NEG_Y, 13.0));
    let top = |share: f64| scenery.grid.point(f64::from(scenery.grid.size[0]) * share, 0.0);
    let elsewhere = [0.0, 0.25, 0.75, 1.0].map(|share| scenery.point(top(share)));
    svg.label(near(top(0.5), "image", DVec2::NEG_Y, 7.0).or(elsewhere));
    let nearness = |ball: &&Ball| scenery.sketch.nearness(ball.centre);
    if let Some(ball) = scenery.subject.balls.iter().max_by(|a, b| nearness(a).total_cmp(&nearness(b))) {
        let rim = scenery.sketch.axes.y_axis * ball.radius;
        svg.label(near(ball.centre - rim, "object", DVec2::Y, 5.0));
    }
}

/// From points of the objects to where they come to lie in the image, and thin on to the eye.
fn inward(scenery: &Scenery<'_>, rays: &[&PixelRay]) -> Vec<Strand> {
    let strand = |point: DVec3| {
        let met = projected(scenery, point);
        let on = Strand::new(met, DVec3::ZERO, Pen::new(IMAGE, 0.8).faint(0.6));
        [Strand::new(point, met, Pen::new(IMAGE, 1.6)), on]
    };
    object_points(scenery, rays).into_iter().flat_map(strand).collect()
}

fn object_points(scenery: &Scenery<'_>, rays: &[&PixelRay]) -> Vec<DVec3> {
    let balls = rays.iter().filter_map(|ray| scenery.subject.ball_hit(ray));
    balls.flat_map(|ball| outline(scenery, ball)).collect()
}

/// Where the line from a point to the eye passes the image plane.
fn projected(scenery: &Scenery<'_>, point: DVec3) -> DVec3 {
    let ahead = -scenery.subject.axes.z_axis;
    point * (scenery.grid.middle().dot(ahead) / point.dot(ahead))
}

/// A head half-way, since the image hides the end of the line from behind; and the point's place in the image.
fn arrive(svg: &mut Svg, scenery: &Scenery<'_>, point: DVec3) {
    let met = projected(scenery, point);
    let along = (scenery.point(met) - scenery.point(point)).normalize_or(DVec2::X);
    svg.head(scenery.point(scenery.open_middle(point, met)) + along * 4.0, along, Pen::new(IMAGE, 1.6));
    svg.dot(scenery.point(point), 2.2, IMAGE);
    let rim = Pen::new("var(--bg, #fff)", 1.2);
    svg.circle(scenery.point(met), 3.0, Some(&Fill::new(IMAGE, 1.0)), Some(rim));
}

/// The highest and the lowest point of a sphere as the eye sees it.
fn outline(scenery: &Scenery<'_>, ball: &Ball) -> [DVec3; 2] {
    let distance = ball.centre.length();
    let axis = ball.centre / distance;
    let sine = ball.radius / distance;
    let touch = ball.centre - axis * ball.radius * sine;
    let up = (scenery.subject.axes.y_axis - axis * axis.dot(scenery.subject.axes.y_axis)).normalize_or(DVec3::Y);
    let rim = up * ball.radius * (1.0 - sine * sine).sqrt();
    [touch + rim, touch - rim]
}

/// From the eye through pixels to surfaces, and from there on to the light.
fn outward(scenery: &Scenery<'_>, rays: &[&PixelRay]) -> Vec<Strand> {
    let strands = rays.iter().filter_map(|ray| {
        let onward = ray.lit().map(|on| scenery.shadow_ray(on, Pen::new(LIGHT, 1.5).dashed("6 4"), SIGNS));
        Some([Some(Strand::arrow(ray.origin, ray.point()?, Pen::new(RAY, 1.6))), onward])
    });
    strands.flatten().flatten().collect()
}

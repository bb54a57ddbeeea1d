use super::Figure;
use super::grid::{Grid, drawn_distance};
use super::label::Label;
use super::pinhole::chosen_rays;
use super::scenery::{Scenery, Side, Strand, paint_eye};
use super::sketch::{Extent, Frame};
use super::subject::{Ball, PixelRay, Subject};
use super::svg::{Drawing, IMAGE, INK, LIGHT, Pen, RAY, Svg, TEXT, WIDTH};
use crate::Result;
use crate::chapter::Chapter;
use glam::{DVec2, DVec3};

const HEIGHT: f64 = 340.0;
const SIDE: Side = Side { around: 58.0, above: 22.0 };

/// The same scene twice: objects projected onto the image, and pixels that ask where their light came from.
pub fn draw(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let subject = Subject::of(chapter, 8, 5)?;
    let distance = drawn_distance(&subject);
    let grid = Grid::of(&subject, distance);
    let rays = chosen_rays(&subject);
    if rays.is_empty() {
        return Err(figure.unsuited("a sphere that a pixel's ray meets"));
    }
    let mut svg = Svg::new(figure.name, HEIGHT);
    let half = WIDTH / 2.0;
    for (left, title, image_first) in [(0.0, "object → pixel", false), (half, "pixel → object → light", true)] {
        let frame = Frame { low: DVec2::new(left + 8.0, 44.0), high: DVec2::new(left + half - 8.0, HEIGHT - 34.0) };
        let more: Vec<Extent> = vec![(subject_eye(&subject), 0.15)];
        let scenery = Scenery::new(&subject, grid, SIDE, &more, frame)?;
        let strands = if image_first { outward(&rays) } else { inward(&scenery, &rays) };
        scenery.paint(&mut svg, &strands);
        paint_eye(&mut svg, scenery.point(DVec3::ZERO), scenery.sketch.direction(-subject.axes.z_axis));
        let head = DVec2::new(left + half / 2.0, 20.0);
        let title = Label { size: TEXT * 1.1, ..Label::near(head, title, DVec2::NEG_Y, 0.0) };
        svg.label(title);
        label(&mut svg, &scenery, frame, image_first);
    }
    svg.quiet_line(DVec2::new(half, 12.0), DVec2::new(half, HEIGHT - 34.0), Pen::new(INK, 0.8).faint(0.25));
    Ok(svg.finish(figure.about, &figure.foot(&subject, &format!("image plane drawn {distance} before the eye"))))
}

fn subject_eye(_: &Subject) -> DVec3 {
    DVec3::ZERO
}

/// From points of the objects to where they come to lie in the image, and thin on to the eye.
fn inward(scenery: &Scenery<'_>, rays: &[&PixelRay]) -> Vec<Strand> {
    let balls = rays.iter().filter_map(|ray| scenery.subject.ball_met(ray));
    let points = balls.flat_map(|ball| outline(scenery, ball));
    let strand = |point: DVec3| {
        let ahead = -scenery.subject.axes.z_axis;
        let met = point * (scenery.grid.middle().dot(ahead) / point.dot(ahead));
        [
            Strand::arrow(point, met, Pen::new(IMAGE, 1.6)),
            Strand::new(met, DVec3::ZERO, Pen::new(IMAGE, 0.8).faint(0.5)),
        ]
    };
    points.flat_map(strand).collect()
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
fn outward(rays: &[&PixelRay]) -> Vec<Strand> {
    let strands = rays.iter().filter_map(|ray| {
        let onward = ray.lit().map(|on| Strand::arrow(on.from, on.to, Pen::new(LIGHT, 1.5).dashed("6 4")));
        Some([Some(Strand::arrow(ray.origin, ray.point()?, Pen::new(RAY, 1.6))), onward])
    });
    strands.flatten().flatten().collect()
}

fn label(svg: &mut Svg, scenery: &Scenery<'_>, frame: Frame, image_first: bool) {
    let near =
        |point, text: &str, toward, distance| Label::near(scenery.point(point), text, toward, distance).within(frame);
    svg.label(near(DVec3::ZERO, "eye", DVec2::NEG_Y, 14.0));
    svg.label(near(scenery.grid.point(f64::from(scenery.grid.size[0]) / 2.0, 0.0), "image", DVec2::NEG_Y, 7.0));
    if let (true, Some(light)) = (image_first, scenery.subject.lights.first()) {
        svg.label(near(*light, "light", DVec2::X, 16.0));
    }
    if let Some(ball) = scenery.subject.balls.first() {
        let below = near(ball.centre, "object", DVec2::Y, ball.radius * scenery.sketch.scale + 5.0);
        svg.label(below);
    }
}

//! Parallel rays from a rectangle of pixels.

use super::Figure;
use super::grid::Grid;
use super::label::Label;
use super::pen::{Fill, Pen, RAY, WIDTH};
use super::pixel_ray::{PixelRay, screen_colour};
use super::scenery::{Scenery, Strand};
use super::side::best_scenery;
use super::sketch::{Extent, Frame};
use super::subject::{Lens, Subject};
use super::svg::{Drawing, Svg};
use glam::{DVec2, DVec3};
use pinhole::Chapter;
use pinhole::Result;

/// Room for the drawing; it is cut where nothing stands.
const ROOM: Frame = Frame { low: DVec2::new(10.0, 30.0), high: DVec2::new(WIDTH - 10.0, 440.0) };
/// In how many steps a ray that meets nothing fades.
const FADES: usize = 7;

/// The simplest camera: a rectangle of pixels in the scene, and a ray from each perpendicular to it.
pub fn draw(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let subject = Subject::of(chapter, 8, 5)?;
    if matches!(subject.lens, Lens::Perspective(_)) {
        return Err(figure.unsuited("an orthographic camera"));
    }
    let grid = Grid::of(&subject, 0.0);
    let reach = reach(&subject);
    let near = |ray: &&PixelRay| ray.hit.is_some_and(|(t, _)| t <= reach);
    let hits: Vec<&PixelRay> = subject.rays.iter().filter(near).collect();
    let end = |ray: &PixelRay| ray.point().filter(|_| near(&ray)).unwrap_or(ray.at(reach));
    let more: Vec<Extent> = subject.rays.iter().map(|ray| (end(ray), 0.0)).collect();
    let scenery = best_scenery(&subject, &[grid], &hits, &more, ROOM)?;
    let mut svg = Svg::new(figure.name, scenery.bottom + 54.0);
    let strands: Vec<Strand> = subject.rays.iter().flat_map(|ray| strands_of(ray, reach)).collect();
    scenery.paint(&mut svg, &strands, 1.0);
    for ray in &subject.rays {
        svg.dot(scenery.point(grid.centre(ray.pixel)), 1.7, RAY);
    }
    hits.iter().for_each(|ray| mark_hit(&mut svg, &scenery, ray));
    label(&mut svg, &scenery, &hits, reach);
    Ok(svg.finish(figure.about, &figure.foot(&subject, "")))
}

/// How far rays that meet nothing are drawn: a little past the last sphere.
fn reach(subject: &Subject) -> f64 {
    let ahead = -subject.axes.z_axis;
    let last = subject.balls.iter().map(|ball| ball.centre.dot(ahead) + ball.radius).fold(0.0, f64::max);
    if last > 0.0 { last * 1.1 } else { 4.0 }
}

/// A ray up to its surface, or into nothing.
fn strands_of(ray: &PixelRay, reach: f64) -> Vec<Strand> {
    let pen = Pen::new(RAY, 1.3);
    match ray.hit {
        Some((t, _)) if t <= reach => vec![Strand::new(ray.origin, ray.at(t), pen)],
        _ => {
            let at = |step: usize| ray.at(reach * step as f64 / FADES as f64);
            let fading = |step: usize| 0.5 * (1.0 - step as f64 / FADES as f64);
            (0..FADES).map(|step| Strand::new(at(step), at(step + 1), pen.faint(fading(step)))).collect()
        }
    }
}

/// A dot in the surface's own colour.
fn mark_hit(svg: &mut Svg, scenery: &Scenery<'_>, ray: &PixelRay) {
    let Some(point) = ray.point() else { return };
    if scenery.veiled(point) {
        return;
    }
    let planar = scenery.subject.planar_shapes.first().map(|planar| planar.colour);
    let colour = scenery.subject.ball_hit(ray).map(|ball| ball.colour).or(planar).unwrap_or_default();
    let fill = Fill::new(screen_colour(colour.map(|part| part as f32)), 1.0);
    svg.circle(scenery.point(point), 3.6, Some(&fill), Some(Pen::new("#222", 1.2)));
}

fn label(svg: &mut Svg, scenery: &Scenery<'_>, hits: &[&PixelRay], reach: f64) {
    let size = scenery.grid.size;
    let at = |point: DVec3| scenery.point(point);
    let edge = |x: f64, y: f64| at(scenery.grid.point(f64::from(size[0]) * x, f64::from(size[1]) * y));
    let edges = [edge(0.1, 0.0), edge(0.9, 0.0), edge(1.0, 1.0), edge(0.0, 1.0), edge(0.5, 1.0)];
    svg.label(Label::near(edge(0.5, 0.0), "image: a rectangle of pixels", DVec2::NEG_Y, 8.0).or(edges));
    let centre = at(scenery.grid.centre([0, size[1] - 1]));
    let others = [at(scenery.grid.centre([size[0] - 1, size[1] - 1]))];
    svg.label(Label::near(centre, "pixel centre", DVec2::Y, 14.0).or(others));
    let seen = |ray: &&&PixelRay| ray.point().is_some_and(|point| !scenery.veiled(point));
    let on_sphere = hits.iter().filter(seen).filter(|ray| scenery.subject.ball_hit(ray).is_some());
    if let Some(point) = on_sphere.min_by_key(|ray| ray.pixel[1]).and_then(|ray| ray.point()) {
        svg.label(Label::near(at(point), "hit", DVec2::new(-0.4, -1.0), 8.0));
    }
    let missing = scenery.subject.rays.iter().find(|ray| ray.hit.is_none_or(|(t, _)| t > reach));
    if let Some(ray) = missing {
        svg.label(Label::near(at(ray.at(reach * 0.7)), "meets nothing", DVec2::NEG_Y, 7.0).coloured(RAY));
    }
    let lowest = scenery.subject.ray([size[0] - 1, size[1] - 1]);
    let middle = at(lowest.at(lowest.hit.map_or(reach, |(t, _)| t.min(reach)) * 0.5));
    svg.label(Label::near(middle, "parallel rays, perpendicular to the image", DVec2::Y, 7.0).coloured(RAY));
    if let Some(light) = scenery.subject.lights.first() {
        svg.label(Label::near(at(*light), "light", DVec2::X, 17.0));
    }
}

//! A pinhole camera: rays from the eye through pixel centres.

use super::Figure;
use super::grid::{Grid, drawn_distance};
use super::label::Label;
use super::pen::{INK, LIGHT, Pen, RAY, WIDTH};
use super::pixel_ray::PixelRay;
use super::props::paint_eye;
use super::scenery::{Scenery, Strand};
use super::side::best_scenery;
use super::sketch::Frame;
use super::subject::{Lens, Subject};
use super::svg::{Drawing, Svg};
use glam::{DVec2, DVec3};
use pinhole::Chapter;
use pinhole::Result;

/// Room for the drawing; it is cut where nothing stands.
const ROOM: Frame = Frame { low: DVec2::new(10.0, 26.0), high: DVec2::new(WIDTH - 10.0, 440.0) };

/// The pinhole camera: the eye, the image plane before it, rays through pixel centres, and one on to the light.
pub fn draw(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let subject = Subject::of(chapter, 12, 8)?;
    if matches!(subject.lens, Lens::Orthographic(_)) {
        return Err(figure.unsuited("a perspective camera"));
    }
    let rays = chosen_rays(&subject);
    let scenery = eye_scenery(&subject, &rays, ROOM)?;
    let Some(first) = clearest(&scenery, &rays) else {
        return Err(figure.unsuited("a sphere that a pixel's ray hits"));
    };
    let mut svg = Svg::new(figure.name, scenery.bottom + 36.0);
    let mut strands = edges(&scenery.grid);
    let camera_ray = |ray: &&PixelRay| Some(Strand::arrow(ray.origin, ray.point()?, Pen::new(RAY, 1.9)));
    strands.extend(rays.iter().filter_map(camera_ray));
    strands.extend(first.lit().map(|onward| scenery.shadow_ray(onward, Pen::new(LIGHT, 1.9).dashed("7 4"), 1.0)));
    scenery.paint(&mut svg, &strands, 1.0);
    for ray in &rays {
        mark(&mut svg, &scenery, ray);
    }
    paint_eye(&mut svg, scenery.point(DVec3::ZERO), scenery.sketch.direction(-subject.axes.z_axis), 1.0);
    label(&mut svg, &scenery, &rays, first);
    Ok(svg.finish(figure.about, &figure.foot(&subject, &distance_note(&scenery))))
}

/// The scene with the eye and with the image plane where it shows best; any distance gives the same rays.
pub fn eye_scenery<'s>(subject: &'s Subject, rays: &[&PixelRay], room: Frame) -> Result<Scenery<'s>> {
    let max = drawn_distance(subject);
    // One decimal, since the figure's foot says it.
    let grids =
        [1.0, 0.8, 0.65, 0.5].map(|fraction| Grid::of(subject, ((max * fraction * 10.0).floor() / 10.0).max(0.1)));
    best_scenery(subject, &grids, rays, &[(DVec3::ZERO, 0.1)], room)
}

/// How far from the eye the image plane is drawn.
pub fn distance_note(scenery: &Scenery<'_>) -> String {
    let distance = scenery.grid.middle().dot(-scenery.subject.axes.z_axis);
    format!("image plane drawn {distance:.1} before the eye")
}

/// The ray of which most is seen behind the image and, where it is lit, on its segment to the light.
fn clearest<'r>(scenery: &Scenery<'_>, rays: &[&'r PixelRay]) -> Option<&'r PixelRay> {
    let seen = |ray: &PixelRay| {
        let centre = scenery.grid.centre(ray.pixel);
        let camera = ray.point().map_or(0.0, |point| scenery.open_length(centre, point));
        let onward = ray.lit().map_or(0.0, |on| scenery.open_length(on.from, on.to));
        camera * onward.max(1.0)
    };
    rays.iter().copied().max_by(|a, b| seen(a).total_cmp(&seen(b)))
}

/// For each sphere that the image shows, the lit ray that hits it closest to normal incidence: largest sphere in the image first.
pub fn chosen_rays(subject: &Subject) -> Vec<&PixelRay> {
    let mut chosen: Vec<(usize, &PixelRay)> = Vec::new();
    for ball in &subject.balls {
        let hitting: Vec<&PixelRay> =
            subject.rays.iter().filter(|ray| ray.hit.is_some_and(|(_, shape)| shape == ball.shape)).collect();
        let off = |ray: &PixelRay| (ball.centre - ray.origin).cross(ray.direction).length();
        // A lit ray first; among equals the one that passes nearest the centre.
        let best = hitting
            .iter()
            .min_by(|a, b| a.lit().is_none().cmp(&b.lit().is_none()).then_with(|| off(a).total_cmp(&off(b))));
        chosen.extend(best.map(|ray| (hitting.len(), *ray)));
    }
    chosen.sort_by_key(|(count, ray)| (ray.lit().is_none(), std::cmp::Reverse(*count)));
    chosen.into_iter().map(|(_, ray)| ray).take(3).collect()
}

/// The edges of what the camera sees, from the eye to the corners of the image.
fn edges(grid: &Grid) -> Vec<Strand> {
    let pen = Pen::new(INK, 0.9).faint(0.35);
    grid.corners().map(|corner| Strand::new(DVec3::ZERO, corner, pen)).to_vec()
}

/// The pixel that a ray goes through, and its centre.
fn mark(svg: &mut Svg, scenery: &Scenery<'_>, ray: &PixelRay) {
    let cell = scenery.grid.cell(ray.pixel).map(|corner| scenery.point(corner));
    svg.polygon(&cell, None, Some(Pen::new(RAY, 1.8)));
    svg.dot(scenery.point(scenery.grid.centre(ray.pixel)), 2.8, RAY);
}

fn label(svg: &mut Svg, scenery: &Scenery<'_>, rays: &[&PixelRay], first: &PixelRay) {
    let at = |point| scenery.point(point);
    let down = scenery.sketch.scale * DVec2::Y;
    svg.label(Label::near(at(DVec3::ZERO), "eye", DVec2::new(-0.4, -1.0), 15.0));
    if let Some(light) = scenery.subject.lights.first() {
        svg.label(Label::near(at(*light), "light", DVec2::X, 17.0));
    }
    let mut rims = scenery.subject.balls.iter().map(|ball| at(ball.centre) + down * ball.radius);
    if let Some(rim) = rims.next() {
        svg.label(Label::near(rim, "sphere", DVec2::Y, 5.0).or(rims));
    }
    if let Some(onward) = first.lit() {
        let fraction = |fraction| at(onward.from.lerp(onward.to, fraction));
        let shadow_ray = Label::near(fraction(0.6), "shadow ray", DVec2::X, 8.0).or([0.5, 0.7].map(fraction));
        svg.label(shadow_ray.coloured(LIGHT));
    }
    // In the open, between what the image covers and the surface.
    let open = |ray: &&PixelRay| Some(at(scenery.open_middle(scenery.grid.centre(ray.pixel), ray.point()?)));
    let mut open = rays.iter().filter_map(open);
    if let Some(middle) = open.next() {
        svg.label(Label::near(middle, "ray", DVec2::NEG_Y, 6.0).or(open).coloured(RAY));
    }
    let top = |fraction: f64| at(scenery.grid.point(f64::from(scenery.grid.size[0]) * fraction, 0.0));
    svg.label(Label::near(top(0.5), "image plane", DVec2::NEG_Y, 8.0).or([0.0, 0.25, 0.75, 1.0].map(top)));
    let centres = rays.iter().map(|ray| at(scenery.grid.centre(ray.pixel)));
    svg.label(Label::near(at(scenery.grid.centre(first.pixel)), "pixel centre", DVec2::Y, 40.0).or(centres));
}

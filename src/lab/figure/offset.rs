//! A hit, its error, and where its shadow ray starts.

use super::Figure;
use super::label::Label;
use super::pen::{Fill, IMAGE, INK, LIGHT, Pen, RAY, WIDTH};
use super::pixel_ray::screen_colour;
use super::sketch::Frame;
use super::subject::{Ball, Subject};
use super::svg::{Drawing, Svg};
use glam::{DVec2, DVec3, Vec3};
use pinhole::Chapter;
use pinhole::Result;
use pinhole::intersect::Surface;
use pinhole::shapes::offset_origin;

const HEIGHT: f64 = 372.0;
/// Where the part at the scene's own scale ends and the magnified one begins.
const MIDDLE: f64 = 330.0;
/// The bound in the magnified part, in units of the drawing.
const BOUND: f64 = 118.0;
/// How steeply the direction from the sphere's centre to the light rises in the drawing, in radians.
const LEAN: f64 = 0.9;

/// A hit and where its shadow ray starts: the sphere cut through, and the hit magnified.
pub fn draw(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let subject = Subject::of(chapter, 96, 54)?;
    let hit = telling_hit(&subject).ok_or_else(|| figure.unsuited("a lit sphere"))?;
    let mut svg = Svg::new(figure.name, HEIGHT);
    paint_section(&mut svg, &hit);
    svg.line(DVec2::new(MIDDLE, 20.0), DVec2::new(MIDDLE, HEIGHT - 40.0), Pen::new(INK, 0.8).faint(0.3));
    paint_magnified(&mut svg, &hit);
    let [x, y] = hit.pixel;
    let note = format!("pixel {x},{y}");
    Ok(svg.finish(figure.about, &figure.foot(&subject, &note)))
}

/// A hit on a sphere, in the plane of its normal and the light: the first coordinate is along the surface towards the
/// light, the second along the normal.
struct Hit<'s> {
    pixel: [u32; 2],
    ball: &'s Ball,
    /// r(t), in f64.
    point: DVec3,
    surface: Surface,
    along: DVec3,
    light: DVec3,
}

impl Hit<'_> {
    /// A vector of render space in that plane.
    fn in_section(&self, v: DVec3) -> DVec2 {
        DVec2::new(v.dot(self.along), v.dot(self.surface.normal.as_dvec3()))
    }

    /// How far rounding has put the position below the surface, in bounds.
    fn depth(&self) -> f64 {
        -self.in_section(self.surface.position.as_dvec3() - self.point).y / f64::from(self.surface.bound)
    }

    /// More where depth and both sides of the box of rounding are large.
    fn telling(&self) -> f64 {
        let corners = rounding_box(self.surface.position, |point| self.in_section(point - self.point));
        let low = corners.iter().fold(DVec2::INFINITY, |low, &corner| low.min(corner));
        let high = corners.iter().fold(DVec2::NEG_INFINITY, |high, &corner| high.max(corner));
        let thinnest = (high - low).min_element() / f64::from(self.surface.bound);
        (2.0 * self.depth()).min(thinnest)
    }
}

/// Of the hits on the sphere that most rays hit, lit obliquely, one that rounding has put deep inside
/// and whose box of rounding is drawn neither flat nor thin.
fn telling_hit(subject: &Subject) -> Option<Hit<'_>> {
    let light = *subject.lights.first()?;
    let count = |ball: &&Ball| subject.rays.iter().filter(|ray| ray.hit.is_some_and(|(_, s)| s == ball.shape)).count();
    let ball = subject.balls.iter().max_by_key(count)?;
    let hits = subject.rays.iter().filter(|ray| ray.hit.is_some_and(|(_, shape)| shape == ball.shape));
    let hits = hits.filter_map(|ray| {
        let (point, surface) = (ray.point()?, ray.surface?);
        let normal = surface.normal.as_dvec3();
        let to_light = (light - point).try_normalize()?;
        let along = (to_light - normal * normal.dot(to_light)).try_normalize()?;
        let oblique = (0.45..0.8).contains(&normal.dot(to_light));
        oblique.then_some(Hit { pixel: ray.pixel, ball, point, surface, along, light })
    });
    hits.max_by(|a, b| a.telling().total_cmp(&b.telling()))
}

/// The sphere, the hit, its normal and the direction to the light, at the scene's own scale.
fn paint_section(svg: &mut Svg, hit: &Hit<'_>) {
    let frame = Frame { low: DVec2::new(26.0, 44.0), high: DVec2::new(MIDDLE - 26.0, HEIGHT - 56.0) };
    let [centre, light] = [hit.ball.centre, hit.light].map(|place| hit.in_section(place - hit.point));
    let radius = hit.ball.radius;
    // Turned so that the light is to the upper right: the drawing's y goes down.
    let up = (light - centre).normalize_or(DVec2::Y);
    let upper_right = DVec2::new(libm::cos(LEAN), -libm::sin(LEAN));
    let turned = |at: DVec2| DVec2::new(up.dot(at), -up.perp_dot(at)).rotate(upper_right);
    let (low, high) = (turned(light).min(turned(centre) - radius), turned(light).max(turned(centre) + radius));
    let scale = ((frame.high - frame.low) / (high - low)).min_element();
    let origin = (frame.low + frame.high) / 2.0 - scale * (low + high) / 2.0;
    let place = |at: DVec2| origin + scale * turned(at);
    let fill = Fill::new(screen_colour(hit.ball.colour.map(|part| part as f32)), 0.3);
    svg.circle(place(centre), radius * scale, Some(&fill), None);
    svg.obstacles.discs.pop();
    // Seen from the light, the sphere ends where a line just touches it.
    let touch = libm::acos((radius / (light - centre).length()).min(1.0));
    let rim = |angle: f64| centre + radius * (up * libm::cos(angle) + up.perp() * libm::sin(angle));
    for step in 0..96 {
        let [from, to] =
            [step, step + 1].map(|step| f64::from(step) / 96.0 * std::f64::consts::TAU - std::f64::consts::PI);
        let lit = (from + to).abs() / 2.0 < touch;
        let pen = if lit { Pen::new(LIGHT, 3.0) } else { Pen::new(INK, 2.0) };
        svg.line(place(rim(from)), place(rim(to)), pen);
    }
    for side in [touch, -touch] {
        svg.line(place(light), place(rim(side)), Pen::new(LIGHT, 1.0).faint(0.7).dashed("3 4"));
        svg.dot(place(rim(side)), 3.2, INK);
    }
    let short = DVec2::ZERO.lerp(light, 1.0 - 16.0 / (light.length() * scale));
    svg.arrow(place(DVec2::ZERO), place(short), Pen::new(LIGHT, 1.9).dashed("7 4"));
    let normal = DVec2::Y * 46.0 / scale;
    svg.arrow(place(DVec2::ZERO), place(normal), Pen::new(IMAGE, 2.0));
    svg.dot(place(DVec2::ZERO), 4.5, INK);
    paint_light(svg, place(light));
    svg.label(Label::near(place(light), "light", DVec2::X, 16.0));
    svg.label(Label::near(place(DVec2::ZERO), "hit", turned(-DVec2::Y), 9.0));
    svg.label(Label::near(place(normal), "*n*", turned(DVec2::Y), 5.0).coloured(IMAGE));
    let middle = place(light * 0.5);
    svg.label(Label::near(middle, "shadow ray", DVec2::NEG_X, 8.0).coloured(LIGHT).or([place(light * 0.65)]));
    let ends = [rim(touch), rim(-touch)].map(place);
    svg.label(Label::near(ends[0], "cos θ = 0", DVec2::Y, 9.0).or([ends[1]]));
    svg.label(Label::near(place(centre - up * radius * 0.55), "cos θ < 0: no ray", DVec2::NEG_Y, 0.0).title(0.92));
}

fn paint_light(svg: &mut Svg, at: DVec2) {
    for step in 0..12 {
        let angle = f64::from(step) * std::f64::consts::TAU / 12.0;
        let out = DVec2::new(libm::cos(angle), libm::sin(angle));
        svg.quiet_line(at + out * 9.5, at + out * 13.0, Pen::new(LIGHT, 1.6));
    }
    svg.circle(at, 6.5, Some(&Fill::new(LIGHT, 1.0)), None);
    svg.obstacles.discs.push((at, 13.0));
}

/// The hit so large that the numbers of f32 stand apart: the surface is a straight line.
fn paint_magnified(svg: &mut Svg, hit: &Hit<'_>) {
    let scale = BOUND / f64::from(hit.surface.bound);
    let origin = DVec2::new((MIDDLE + WIDTH) / 2.0 - 60.0, 218.0);
    let place = |point: DVec3| {
        let in_section = hit.in_section(point - hit.point) * scale;
        origin + DVec2::new(in_section.x, -in_section.y)
    };
    let (left, right, floor) = (MIDDLE + 14.0, WIDTH - 12.0, HEIGHT - 46.0);
    let inside =
        [DVec2::new(left, origin.y), DVec2::new(right, origin.y), DVec2::new(right, floor), DVec2::new(left, floor)];
    let colour = screen_colour(hit.ball.colour.map(|part| part as f32));
    svg.polygon(&inside, Some(&Fill::new(colour, 0.3)), None);
    svg.line(inside[0], inside[1], Pen::new(INK, 1.6));

    let position = hit.surface.position;
    let start = offset_origin(position, hit.surface.normal, hit.surface.bound);
    for rounded in [position, start] {
        let outline = rounding_box(rounded, place);
        svg.polygon(&outline, Some(&Fill::new(RAY, 0.12)), Some(Pen::new(RAY, 1.1)));
        svg.obstacles.strokes.extend((0..outline.len()).map(|at| [outline[at], outline[(at + 1) % outline.len()]]));
    }
    let [p, p_off] = [position, start].map(|point| place(point.as_dvec3()));
    let toward = (hit.light - hit.point).normalize_or(hit.along);
    let toward = DVec2::new(hit.in_section(toward).x, -hit.in_section(toward).y);
    // The naive ray starts inside and hits its own surface.
    let to_surface = (origin.y - p.y) / toward.y;
    if to_surface > 0.0 {
        svg.line(p, p + toward * to_surface, Pen::new(LIGHT, 1.4).dashed("2 4"));
        svg.dot(p + toward * to_surface, 3.2, LIGHT);
        let at_surface = p + toward * to_surface;
        svg.label(Label::near(at_surface, "blocked by its own surface", DVec2::new(1.0, 0.5), 12.0));
    }
    let pushed = place(position.as_dvec3() + hit.surface.normal.as_dvec3() * f64::from(hit.surface.bound));
    svg.arrow(p, pushed, Pen::new(IMAGE, 2.0));
    let length = ((36.0 - p_off.y) / toward.y).min((right - 10.0 - p_off.x) / toward.x.max(1e-9));
    svg.arrow(p_off, p_off + toward * length, Pen::new(LIGHT, 1.9).dashed("7 4"));
    for (at, radius) in [(origin, 3.6), (p, 4.5), (p_off, 4.5)] {
        svg.dot(at, radius, INK);
    }
    svg.label(Label::near(origin, "*r*(*t*) in f64", DVec2::new(-1.0, -0.4), 12.0));
    svg.label(Label::near(p, "`position`: rounded to f32", DVec2::new(-0.2, 1.0), 26.0));
    svg.label(Label::near(p_off, "start of the shadow ray", DVec2::new(-0.6, -1.0), 20.0));
    let bound = format!("`bound` = {:.2e}", hit.surface.bound);
    svg.label(Label::near(p.lerp(pushed, 0.5), &bound, DVec2::NEG_X, 8.0).coloured(IMAGE));
    svg.label(Label::near(p_off + toward * length * 0.75, "to the light", DVec2::NEG_Y, 10.0).coloured(LIGHT));
    let corner = DVec2::new(right - 4.0, floor - 10.0);
    svg.label(Label::near(corner, "inside the ball", DVec2::NEG_X, 0.0).title(0.92));
}

/// The outline of all points that round to these numbers of f32, as the drawing has it.
fn rounding_box(rounded: Vec3, place: impl Fn(DVec3) -> DVec2) -> Vec<DVec2> {
    let edges =
        rounded.to_array().map(|x| [x.next_down(), x.next_up()].map(|next| (f64::from(next) + f64::from(x)) / 2.0));
    let corner = |number: usize| {
        let part = |axis: usize| edges[axis][(number >> axis) & 1];
        place(DVec3::new(part(0), part(1), part(2)))
    };
    super::patch::hull((0..8).map(corner).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figure::trial;

    #[test]
    fn the_hit_shown_lies_inside_and_its_start_outside() {
        let chapter = trial::chapter(trial::central);
        let subject = Subject::of(&chapter, 96, 54).expect("columns");
        let hit = telling_hit(&subject).expect("a hit");
        let Surface { position, normal, bound, .. } = hit.surface;
        let start = offset_origin(position, normal, bound).as_dvec3();
        assert!(hit.depth() > 0.0 && hit.in_section(start - hit.point).y > 0.0);
        let box_of_hit = rounding_box(position, |point| hit.in_section(point - hit.point) / f64::from(bound));
        assert!(box_of_hit.len() >= 4 && box_of_hit.iter().all(|corner| corner.length() < 1.0));
    }
}

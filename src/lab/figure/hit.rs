//! Where a ray hits a sphere.

use super::Figure;
use super::label::Label;
use super::pen::{IMAGE, INK, Pen, RAY, TEXT, WIDTH};
use super::pixel_ray::{PixelRay, screen_colour};
use super::section::Section;
use super::sketch::Frame;
use super::subject::{Ball, Subject};
use super::svg::{Drawing, Svg};
use glam::DVec2;
use pinhole::Chapter;
use pinhole::Result;

const HEIGHT: f64 = 400.0;
/// Share of the radius at which a ray passes the centre that shows triangle and chord best.
const BEST_ACROSS: f64 = 0.55;
/// Below the ray: the first row of marks, and the distance to the next.
const ROWS: f64 = 34.0;

/// What `sphere_t` computes, drawn in the plane of the ray and the sphere's centre.
pub fn draw(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let subject = Subject::of(chapter, 96, 54)?;
    let (ray, ball) = telling_ray(&subject).ok_or_else(|| figure.unsuited("a sphere that a pixel's ray meets"))?;
    let to_centre = ball.centre - ray.origin;
    let end = to_centre.length() + ball.radius * 1.35;
    let frame = Frame { low: DVec2::new(40.0, 22.0), high: DVec2::new(WIDTH - 30.0, HEIGHT - 136.0) };
    let section = Section::new(ray, ball, 0.0, &[DVec2::new(end, 0.0)], frame);
    let mut svg = Svg::new(figure.name, HEIGHT);
    section.paint_sphere(&mut svg, &screen_colour(ball.colour.map(|part| part as f32)));
    let chord = Chord::of(&section);
    paint(&mut svg, &section, &chord, end);
    measure(&mut svg, &section, &chord);
    label(&mut svg, &section, &chord);
    Ok(svg.finish(figure.about, &figure.foot(&subject, &format!("pixel {},{}", ray.pixel[0], ray.pixel[1]))))
}

/// Of the sphere that looks largest, the ray that passes its centre at the most telling distance.
fn telling_ray(subject: &Subject) -> Option<(&PixelRay, &Ball)> {
    let met = || subject.rays.iter().filter_map(|ray| Some((ray, subject.ball_hit(ray)?)));
    let away = |(ray, ball): &(&PixelRay, &Ball)| (ball.centre - ray.origin).length() / ball.radius;
    let (_, largest) = met().min_by(|a, b| away(a).total_cmp(&away(b)))?;
    let off = |(ray, ball): &(&PixelRay, &Ball)| {
        let across = (ball.centre - ray.origin).cross(ray.direction).length() / ball.radius;
        (across - BEST_ACROSS).abs()
    };
    met().filter(|(_, ball)| ball.shape == largest.shape).min_by(|a, b| off(a).total_cmp(&off(b)))
}

/// The names of `sphere_t`.
struct Chord {
    s: f64,
    across: f64,
    near: f64,
    far: f64,
    /// Below the ray, in units of the drawing: the first row of marks, clear of the sphere.
    row: f64,
}

impl Chord {
    fn of(section: &Section) -> Self {
        let (s, across) = section.centre.into();
        let half_chord = (section.radius * section.radius - across * across).max(0.0).sqrt();
        let row = ((section.radius - across) * section.scale).max(0.0) + ROWS * 0.7;
        Self { s, across, near: s - half_chord, far: s + half_chord, row }
    }
}

fn paint(svg: &mut Svg, section: &Section, chord: &Chord, end: f64) {
    let at = |t| section.point(t, 0.0);
    let centre = section.point(chord.s, chord.across);
    svg.line(at(0.0), centre, Pen::new(IMAGE, 1.6));
    svg.line(at(chord.s), centre, Pen::new(INK, 1.6).dashed("5 4"));
    svg.line(at(chord.far), centre, Pen::new(INK, 1.1).faint(0.75));
    svg.line(at(0.0), at(chord.near), Pen::new(RAY, 2.0));
    svg.arrow(at(chord.near), at(end), Pen::new(RAY, 1.6).faint(0.7));
    svg.line(at(chord.near), at(chord.far), Pen::new(RAY, 3.4).faint(0.55));
    svg.arrow(at(0.0), at(1.0), Pen::new(RAY, 4.0));
    let (corner, side) = (at(chord.s), 9.0);
    let [left, up] = [section.along * side, section.up() * side];
    svg.quiet_line(corner + left, corner + left + up, Pen::new(INK, 1.0));
    svg.quiet_line(corner + up, corner + left + up, Pen::new(INK, 1.0));
    for (point, radius) in [(at(0.0), 4.5), (centre, 4.0), (at(chord.near), 4.5), (at(chord.far), 4.5), (corner, 3.0)] {
        svg.dot(point, radius, INK);
    }
}

/// The lengths along the ray, a row each kind.
fn measure(svg: &mut Svg, section: &Section, chord: &Chord) {
    let rows = [0.0, 1.0, 2.0].map(|row| chord.row + row * ROWS);
    for (t, aside) in [(0.0, rows[2]), (chord.near, rows[0]), (chord.s, rows[1]), (chord.far, rows[2])] {
        section.drop(svg, t, aside);
    }
    let pen = Pen::new(INK, 1.1).faint(0.75);
    // Both halves are named where there is room for both names.
    let double_double = (chord.far - chord.s) * section.scale > 5.6 * TEXT;
    for (from, to, row, name) in [
        (0.0, chord.near, rows[0], "`near` = `s` − `half_chord`"),
        (chord.near, chord.s, rows[0], if double_double { "`half_chord`" } else { "" }),
        (chord.s, chord.far, rows[0], "`half_chord`"),
        (0.0, chord.s, rows[1], "`s`"),
        (0.0, chord.far, rows[2], "`far` = `s` + `half_chord`"),
    ] {
        let middle = section.measure(svg, from, to, row, pen);
        if !name.is_empty() {
            svg.label(Label::near(middle, name, -section.up(), 5.0).title(0.92));
        }
    }
}

fn label(svg: &mut Svg, section: &Section, chord: &Chord) {
    let (at, up) = (|t| section.point(t, 0.0), section.up());
    let centre = section.point(chord.s, chord.across);
    svg.label(Label::near(at(0.0), "*O*", DVec2::new(-1.0, -0.8), 9.0));
    svg.label(Label::near(centre, "*C*", up + section.along, 9.0));
    svg.label(Label::near(at(0.6), "*R*", -up, 11.0).coloured(RAY));
    svg.label(Label::near(section.point(chord.s, chord.across * 0.5), "`across`", -section.along, 9.0));
    svg.label(Label::near((at(chord.far) + centre) / 2.0, "`radius`", up + section.along, 8.0));
    let towards = section.point(chord.s * 0.45, chord.across * 0.45);
    svg.label(Label::near(towards, "`to_centre` = *C* − *O*", up, 14.0).coloured(IMAGE));
}

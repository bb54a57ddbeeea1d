//! A patch of a light, the solid angle that it subtends, and what is left of that on the disk (Nusselt's analog).

use super::Figure;
use super::angle::arc;
use super::label::Label;
use super::pen::{Fill, IMAGE, INK, LIGHT, Pen, RAY, WIDTH};
use super::sketch::{Frame, Sketch};
use super::svg::{Drawing, Svg};
use glam::{DVec2, DVec3};
use pinhole::Chapter;
use pinhole::Result;
use pinhole::shapes::emitter::{Parallelogram, RectangleSeen, pdf_from_area};
use std::f64::consts::TAU;

const HEIGHT: f64 = 480.0;
/// The patch: its distance, the angles θ and θₗ in degrees, and half its side; the hemisphere has radius 1.
const DISTANCE: f64 = 2.3;
const THETA: f64 = 42.0;
const THETA_AT_LIGHT: f64 = 32.0;
const HALF_SIDE: f64 = 0.36;
/// Parts of a side of the patch, and of the circle that bounds the disk.
const SIDE_PARTS: u32 = 12;
const RIM_PARTS: u32 = 72;

/// From a patch of a light to the hemisphere about a point, and from there straight down to the disk.
pub fn draw(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let (theta, at_light) = (THETA.to_radians(), THETA_AT_LIGHT.to_radians());
    let to_patch = DVec3::new(libm::sin(theta), libm::cos(theta), 0.0);
    let across = DVec3::new(-libm::cos(theta), libm::sin(theta), 0.0);
    // The patch's normal leans from the direction to the lit point towards the vertical.
    let normal = -to_patch * libm::cos(at_light) - across * libm::sin(at_light);
    let centre = to_patch * DISTANCE;
    let half_edges = [DVec3::Z * HALF_SIDE, DVec3::Z.cross(normal) * HALF_SIDE];
    let patch = Parallelogram::new(centre, half_edges, normal);
    let subtended = RectangleSeen::new(centre, half_edges, DVec3::ZERO).solid_angle;
    let small = 1.0 / pdf_from_area(centre, patch.normal, patch.area());

    let frame = Frame { low: DVec2::new(40.0, 34.0), high: DVec2::new(WIDTH - 44.0, HEIGHT - 66.0) };
    let rim_ends = [DVec3::X, DVec3::NEG_X, DVec3::Z, DVec3::NEG_Z].map(|end| (end, 0.02));
    let things = [&rim_ends[..], &[(centre, HALF_SIDE)]].concat();
    let sketch = Sketch::fitting(DVec3::new(0.22, 0.5, 1.0), DVec3::Y, &things, frame)?;
    let at = |point: DVec3| sketch.point(point);
    let mut svg = Svg::new(figure.name, HEIGHT);

    // The disk, and the outline of the hemisphere: the upper half of the circle that faces the viewer.
    let rim = |part: u32| {
        let angle = TAU * f64::from(part) / f64::from(RIM_PARTS);
        DVec3::new(libm::cos(angle), 0.0, libm::sin(angle))
    };
    let disk: Vec<DVec2> = (0..RIM_PARTS).map(|part| at(rim(part))).collect();
    svg.polygon(&disk, Some(&Fill::new(INK, 0.06)), Some(Pen::new(INK, 1.2)));
    let outline: Vec<DVec3> = (0..=RIM_PARTS / 2)
        .map(|part| {
            let angle = TAU * f64::from(part) / f64::from(RIM_PARTS);
            sketch.axes.x_axis * libm::cos(angle) + sketch.axes.y_axis * libm::sin(angle)
        })
        .collect();
    for pair in outline.windows(2) {
        svg.line(at(pair[0]), at(pair[1]), Pen::new(INK, 1.2));
    }
    svg.arrow(at(DVec3::ZERO), at(DVec3::Y * 1.42), Pen::new(INK, 1.8));

    // The border of the patch, of its solid angle, and of what lies below that on the disk.
    let border = border(centre, half_edges);
    let on_sphere: Vec<DVec3> = border.iter().map(|point| point.normalize()).collect();
    let on_disk: Vec<DVec3> = on_sphere.iter().map(|point| DVec3::new(point.x, 0.0, point.z)).collect();
    let shown = |points: &[DVec3]| points.iter().map(|&point| at(point)).collect::<Vec<_>>();
    svg.polygon(&shown(&on_disk), Some(&Fill::new(IMAGE, 0.75)), Some(Pen::new(IMAGE, 1.4)));
    for corner in (0..4).map(|side| (side * SIDE_PARTS) as usize) {
        svg.line(at(on_sphere[corner]), at(on_disk[corner]), Pen::new(IMAGE, 1.2).dashed("4 4"));
        svg.quiet_line(at(DVec3::ZERO), at(border[corner]), Pen::new(RAY, 1.1).faint(0.8));
    }
    svg.polygon(&shown(&on_sphere), Some(&Fill::new(RAY, 0.75)), Some(Pen::new(RAY, 1.4)));
    svg.polygon(&shown(&border), Some(&Fill::new(LIGHT, 0.6)), Some(Pen::new(LIGHT, 1.6)));
    svg.line(at(DVec3::ZERO), at(centre), Pen::new(INK, 1.3).dashed("6 4"));
    svg.arrow(at(centre), at(centre + normal * 0.8), Pen::new(INK, 1.8));
    svg.dot(at(DVec3::ZERO), 4.0, INK);

    let thin = Pen::new(INK, 1.2);
    let origin = at(DVec3::ZERO);
    let theta_at = arc(&mut svg, origin, [at(DVec3::Y) - origin, at(centre) - origin], 58.0, thin);
    let directions = [sketch.direction(normal), origin - at(centre)];
    let theta_l_at = arc(&mut svg, at(centre), directions, 62.0, thin);
    svg.label(Label::near(at(DVec3::Y * 1.38), "*n*", DVec2::NEG_X, 10.0).large());
    svg.label(Label::near(theta_at, "*θ*", DVec2::new(0.4, -1.0), 6.0).large());
    svg.label(Label::near(theta_l_at, "*θ*ₗ", DVec2::new(-0.5, 1.0), 12.0).large());
    svg.label(Label::near(at(centre * 0.72), "*d*", DVec2::new(-0.7, -1.0), 10.0).large());
    let lit = Label::near(at(centre + DVec3::Y * 0.25), "*dA*", DVec2::NEG_Y, 26.0);
    svg.label(lit.large().coloured(LIGHT));
    let place = at(on_sphere[2 * SIDE_PARTS as usize]);
    let of_sphere = Label::near(place, "*dω* = *dA* cos *θ*ₗ / *d*²", DVec2::new(1.0, 0.85), 64.0);
    svg.label(of_sphere.large().coloured(RAY));
    let place = at(on_disk[2 * SIDE_PARTS as usize]);
    svg.label(Label::near(place, "cos *θ dω*", DVec2::new(1.0, 0.6), 76.0).large().coloured(IMAGE));
    let foot = format!(
        "for chapter {} · dA cos θₗ/d² = {small:.4}, Ω = {subtended:.4} sr · \
         cargo run --release -- figure {}",
        chapter.name, figure.name
    );
    Ok(svg.finish(figure.about, &foot))
}

/// Points around a parallelogram, as many on each side.
fn border(centre: DVec3, [a, b]: [DVec3; 2]) -> Vec<DVec3> {
    let corners = [centre - a - b, centre + a - b, centre + a + b, centre - a + b];
    let side = |from: usize| {
        let (from, to) = (corners[from], corners[(from + 1) % 4]);
        (0..SIDE_PARTS).map(move |part| from.lerp(to, f64::from(part) / f64::from(SIDE_PARTS)))
    };
    (0..4).flat_map(side).collect()
}

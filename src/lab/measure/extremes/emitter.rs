//! Lights with an area: seen tiny, near, touching, obliquely, and by numbers at their ends.
//!
//! A small square is checked by the light that its middle alone would send, a rectangle by its polygon's closed form, a
//! sphere by πL(r/d)² cos θ; none of these needs a random direction.

use super::{Group, Method, Tally, Trial};
use crate::measure::draws::Draws;
use crate::naive::emitter::{
    irradiance_by_whole_sphere, pdf_without_cosine, pdf_without_jacobian, versine_by_difference,
    versine_by_difference_f32,
};
use glam::DVec3;
use pinhole::shade::shadow_t_max;
use pinhole::shapes::emitter::{
    EmittingDisk, EmittingTriangle, LightPoint, Parallelogram, cone_versine, parallelogram_area_point,
};
use pinhole::shapes::{Emitter, PlacedSphere, Planar, distance_to, point_on, rectangle_t};
use std::f64::consts::PI;
use std::ops::Range;

const TINY: [Method; 3] = [
    Method::pinhole("pinhole, s² / (1 + √(1 − s²))", "of itself", 1e-15),
    Method::naive("naive, 1 − √(1 − s²)", "of itself", 1e-15),
    Method::naive("naive, the same in f32", "of itself", 1e-15),
];
const OBLIQUE: [Method; 3] = [
    Method::pinhole("pinhole, by the solid angle", "of the truth", 1e-3),
    Method::naive("naive, without the light's cosine", "of the truth", 1e-3),
    Method::naive("naive, without distance and cosine", "of the truth", 1e-3),
];
const NEAR: [Method; 2] = [
    Method::pinhole("pinhole, evenly over the solid angle", "of the mean", 1.0),
    Method::naive("naive, evenly over the area", "of the mean", 1.0),
];
const TOUCHING: [Method; 2] = [
    Method::pinhole("pinhole, evenly over the cone", "of the truth", 1e-3),
    Method::naive("naive, evenly over the sphere", "of the truth", 1e-3),
];
const ENDS: [Method; 1] = [Method::pinhole("pinhole, every kind of light", "", 0.0)];
const OWN: [Method; 2] = [
    Method::pinhole("pinhole, to where the rounded ray ends", "", 0.0),
    Method::naive("naive, as far as the point was", "", 0.0),
];

/// Points along each side of the unit square where a mean is asked for.
const SIDE: u32 = 24;
/// The same where the error of the mean must stay below a thousandth, for it falls as the square of the cells' width.
const FINE_SIDE: u32 = 64;

/// The cases of the group.
pub fn trials() -> Vec<Trial> {
    vec![
        Trial::new(Group::Emitter, "spheres of 1e-9 to 1 of their distance", &TINY, check_tiny),
        Trial::new(Group::Emitter, "small squares at any angle", &OBLIQUE, check_oblique),
        Trial::new(Group::Emitter, "spread of rectangles 1e-4 to 1 above a surface", &NEAR, check_near),
        Trial::new(Group::Emitter, "spheres that touch a surface, or nearly", &TOUCHING, check_touching),
        Trial::new(Group::Emitter, "numbers 0, 2^-24, 1/2 and 1 - 2^-24", &ENDS, check_ends),
        Trial::new(Group::Emitter, "rectangles in their own way, seen flatly", &OWN, check_own),
    ]
}

/// The half angle's own formula is the oracle: 1 − cos θ = 2 sin²(θ/2).
fn check_tiny(range: Range<u64>) -> Tally {
    let mut tally = Tally::new(TINY.len());
    for index in range {
        let sine = Draws::new(2101, index).power_of_ten(-9.0, -1e-9);
        let half = libm::sin(0.5 * libm::asin(sine));
        let exact = 2.0 * half * half;
        tally.count(true);
        let told = [
            cone_versine(sine * sine),
            versine_by_difference(sine * sine),
            f64::from(versine_by_difference_f32((sine * sine) as f32)),
        ];
        for (score, told) in tally.scores.iter_mut().zip(told) {
            score.measure((told / exact - 1.0).abs());
        }
    }
    tally
}

/// Squares so small that one direction tells all: cos θ cos θₗ A / d².
fn check_oblique(range: Range<u64>) -> Tally {
    let mut tally = Tally::new(OBLIQUE.len());
    for index in range {
        let mut draws = Draws::new(2102, index);
        let (normal, direction) = (DVec3::Y, draws.unit_vector());
        let distance = draws.power_of_ten(-3.0, 3.0);
        let facing = (draws.unit_vector_across(direction) * draws.between(0.0, 3.0) - direction).normalize();
        let x = draws.unit_vector_across(facing);
        let half = 1e-5 * distance;
        let centre = direction * distance;
        let square = Parallelogram::new(centre, [x * half, facing.cross(x) * half], facing);
        let point = point_on(&Emitter::Rectangle(square), DVec3::ZERO, [draws.unit(), draws.unit()]);
        let cosine = normal.dot(direction);
        tally.count(cosine > 0.01);
        if cosine <= 0.01 {
            continue;
        }
        let truth = cosine * facing.dot(-direction) * square.area() / (distance * distance);
        let naive = parallelogram_area_point(&square, DVec3::ZERO, [draws.unit(), draws.unit()]);
        let told = |point: LightPoint, pdf: f64| normal.dot(point.to / point.to.length()) / pdf;
        let answers = [
            told(point, point.pdf),
            told(naive, pdf_without_cosine(naive.to, square.area())),
            told(naive, pdf_without_jacobian(square.area())),
        ];
        for (score, told) in tally.scores.iter_mut().zip(answers) {
            score.measure((told / truth - 1.0).abs());
        }
    }
    tally
}

/// The numbers in the middles of a grid's cells.
fn grid(side: u32) -> impl Iterator<Item = [f64; 2]> {
    let at = move |place: u32| (f64::from(place) + 0.5) / f64::from(side);
    (0..side * side).map(move |cell| [at(cell % side), at(cell / side)])
}

/// The standard deviation of what one direction tells over its mean.
fn check_near(range: Range<u64>) -> Tally {
    let mut tally = Tally::new(NEAR.len());
    for index in range {
        let mut draws = Draws::new(2103, index);
        let height = draws.power_of_ten(-4.0, 0.0);
        let centre = DVec3::new(draws.between(-0.9, 0.9), height, draws.between(-0.9, 0.9));
        let rectangle = Parallelogram::new(centre, [DVec3::X, DVec3::Z], DVec3::NEG_Y);
        tally.count(true);
        let spread = |point: &dyn Fn([f64; 2]) -> LightPoint, mean: f64| {
            let told = |point: LightPoint| (point.to.y / point.to.length()).max(0.0) / point.pdf;
            let squares: f64 = grid(SIDE).map(|u| told(point(u)) - mean).map(|off| off * off).sum();
            (squares / f64::from(SIDE * SIDE)).sqrt() / mean
        };
        let mean = square_above(centre, height);
        tally.scores[0].measure(spread(&|u| point_on(&Emitter::Rectangle(rectangle), DVec3::ZERO, u), mean));
        tally.scores[1].measure(spread(&|u| parallelogram_area_point(&rectangle, DVec3::ZERO, u), mean));
    }
    tally
}

/// What a square of side 2 at a height sends straight down: half the sum over its edges of the angle each fills times how
/// far its plane leans.
fn square_above(centre: DVec3, height: f64) -> f64 {
    let corner = |x: f64, z: f64| DVec3::new(centre.x + x, height, centre.z + z);
    let corners = [corner(-1.0, -1.0), corner(-1.0, 1.0), corner(1.0, 1.0), corner(1.0, -1.0)];
    let edge = |i: usize| {
        let (a, b) = (corners[i], corners[(i + 1) % 4]);
        let cross = a.cross(b);
        libm::atan2(cross.length(), a.dot(b)) * cross.y / cross.length()
    };
    0.5 * (edge(0) + edge(1) + edge(2) + edge(3)).abs()
}

fn check_touching(range: Range<u64>) -> Tally {
    let mut tally = Tally::new(TOUCHING.len());
    for index in range {
        let mut draws = Draws::new(2104, index);
        let (radius, apart) = (draws.power_of_ten(-3.0, 3.0), draws.power_of_ten(-9.0, -1.0));
        let (normal, axis) = (DVec3::Y, DVec3::Y * (radius * (1.0 + apart)));
        let truth = PI / ((1.0 + apart) * (1.0 + apart));
        tally.count(true);
        let sphere = Emitter::Sphere(PlacedSphere { centre: axis, radius });
        let pinhole = grid(FINE_SIDE).map(|u| {
            let point = point_on(&sphere, DVec3::ZERO, u);
            normal.dot(point.to / point.to.length()).max(0.0) / point.pdf
        });
        let naive = grid(FINE_SIDE).map(|u| irradiance_by_whole_sphere(axis, radius, normal, u));
        let off = |sum: f64| (sum / f64::from(FINE_SIDE * FINE_SIDE) / truth - 1.0).abs();
        tally.scores[0].measure(off(pinhole.sum()));
        tally.scores[1].measure(off(naive.sum()));
    }
    tally
}

fn check_ends(range: Range<u64>) -> Tally {
    let mut tally = Tally::new(ENDS.len());
    let ends = [0.0, 1.0 / 16_777_216.0, 0.5, 1.0 - 1.0 / 16_777_216.0];
    for index in range {
        let mut draws = Draws::new(2105, index);
        let mut vector = || draws.unit_vector() * draws.power_of_ten(-3.0, 3.0);
        let (centre, a, b, away) = (vector(), vector(), vector(), vector());
        let light = match index % 5 {
            0 => Emitter::Sphere(PlacedSphere { centre, radius: a.length() }),
            1 => Emitter::Rectangle(Parallelogram::new(centre, [a, a.cross(b).normalize() * b.length()], away)),
            2 => Emitter::Rectangle(Parallelogram::new(centre, [a, b], away)),
            3 => Emitter::Disk(EmittingDisk(Parallelogram::about_ellipse(centre, [a, b], away))),
            _ => {
                let corners = [centre, centre + a, centre + b];
                Emitter::Triangle(EmittingTriangle { corners, normal: a.cross(b).normalize() })
            }
        };
        // Beside a point of the light.
        let on = away + point_on(&light, away, [0.3, 0.6]).to;
        let from = on + draws.unit_vector() * (draws.power_of_ten(-7.0, 2.0) * a.length());
        tally.count(true);
        for u in ends.into_iter().flat_map(|u| ends.map(|v| [u, v])) {
            let point = point_on(&light, from, u);
            tally.scores[0].check(point.to.is_finite() && point.pdf > 0.0);
        }
    }
    tally
}

/// Rays to rectangles from beside their planes: is the rectangle hit before t_max?
fn check_own(range: Range<u64>) -> Tally {
    let mut tally = Tally::new(OWN.len());
    for index in range {
        let mut draws = Draws::new(2106, index);
        let facing = draws.unit_vector();
        let x = draws.unit_vector_across(facing);
        let half_edges = [x, facing.cross(x) * draws.power_of_ten(-1.0, 1.0)];
        let Some(planar) = Planar::new(draws.unit_vector() * 3.0, facing, half_edges) else { continue };
        let light = Emitter::Rectangle(Parallelogram::new(planar.centre, planar.half_edges(), planar.normal));
        let [along, aside] = [x, facing.cross(x)].map(|direction| direction * draws.between(-9.0, 9.0));
        let from = (planar.centre + along + aside + facing * draws.power_of_ten(-4.0, 0.5)).as_vec3();
        let point = point_on(&light, from.as_dvec3(), [draws.unit(), draws.unit()]);
        let length = point.to.length();
        let direction = (point.to / length).as_vec3();
        let t = rectangle_t(from.as_dvec3(), direction.as_dvec3(), &planar);
        let end = distance_to(&light, from.as_dvec3(), direction.as_dvec3());
        tally.count(t.is_finite());
        tally.scores[0].check(t >= f64::from(shadow_t_max(end)));
        tally.scores[1].check(t >= f64::from(shadow_t_max(length)));
    }
    tally
}

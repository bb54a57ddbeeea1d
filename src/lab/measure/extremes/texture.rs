//! Textures: what a pixel covers, its mean, the edges of images.

use super::{Group, Method, Tally, Trial};
use crate::measure::draws::Draws;
use crate::measure::exact::{Dyadic, UNIT_ROUNDOFF_F32 as U};
use crate::naive::texture::{
    bilinear_to_the_edge, from_top_by_cosine, halved_by_fours, naive_checker, step_to_neighbour, wave_mean_f32,
};
use glam::{DVec3, Vec3};
use pinhole::extract::{Texels, halved};
use pinhole::shade::{around, equirectangular, step_on_surface, wave_mean};
use std::f64::consts::PI;
use std::ops::Range;

const MEANS: [Method; 3] = [
    Method::pinhole("pinhole, areas in f64", "u of 1", 1.0),
    Method::naive("naive, the cell that is hit", "u of 1", 1.0),
    Method::naive("naive, areas in f32", "u of 1", 1.0),
];
const STEPS: [Method; 2] = [
    Method::pinhole("pinhole, slope of the tangent plane", "u of it", 1.0),
    Method::naive("naive, offset to the neighbour's hit, f32", "u of it", 1.0),
];
const ANGLES: [Method; 2] = [
    Method::pinhole("pinhole, arc tangent of both parts", "u of it", 1.0),
    Method::naive("naive, arc cosine of y", "u of it", 1.0),
];
const SEAMS: [Method; 2] = [
    Method::pinhole("pinhole, round the edge, over the pole", "of white", 1e-6),
    Method::naive("naive, no further than the edge", "of white", 1e-6),
];
const HALVES: [Method; 2] = [
    Method::pinhole("pinhole, texels split where a side is odd", "u of it", 4.0),
    Method::naive("naive, a mean of four", "u of it", 4.0),
];

/// The cases of the group.
pub fn trials() -> Vec<Trial> {
    let means = |name: &str, far: f64, widths: [f64; 2]| {
        Trial::new(Group::Texture, name, &MEANS, move |range| check_means(range, far, widths))
    };
    let steps =
        |name: &str, flattest: f64| Trial::new(Group::Texture, name, &STEPS, move |range| check_steps(range, flattest));
    vec![
        means("cells, a pixel covers 1e-2 to 1", 1e2, [-2.0, 0.0]),
        means("cells, a pixel covers 1 to 1e6", 1e2, [0.0, 6.0]),
        means("cells 1e7 from the origin, a pixel covers 1 to 1e4", 1e7, [0.0, 4.0]),
        steps("a floor, slope from 1e-2", -2.0),
        steps("a floor, slope from 1e-6", -6.0),
        Trial::new(Group::Texture, "environment, 1e-12 to 1e-2 from a pole", &ANGLES, check_angles),
        Trial::new(Group::Texture, "environment, both sides of the seam", &SEAMS, check_seams),
        Trial::new(Group::Texture, "images of 1 to 40 texels, halved", &HALVES, check_halves),
    ]
}

/// The area under the wave from an even cell's beginning near x to x, exactly.
fn exact_area(x: &Dyadic) -> Dyadic {
    let (one, even) = (Dyadic::of(1), Dyadic::of(2.0 * (x.to_f64() / 2.0).floor()));
    &one - &(&(x - &even) - &one).abs()
}

/// Ranges of cells: the mean of stripes over them.
fn check_means(range: Range<u64>, far: f64, [keep_closest, double_double]: [f64; 2]) -> Tally {
    let mut tally = Tally::new(MEANS.len());
    for index in range {
        let mut draws = Draws::new(161, index);
        let x = far * (1.0 + draws.unit());
        let width = draws.power_of_ten(keep_closest, double_double);
        tally.count(true);
        let half = Dyadic::of(0.5 * width);
        let (low, high) = (&Dyadic::of(x) - &half, &Dyadic::of(x) + &half);
        let exact = (&exact_area(&high) - &exact_area(&low)).divided_by(&Dyadic::of(width)).to_f64();
        let cell = 2.0 * naive_checker(Vec3::new(x as f32, 0.5, 0.5)) - 1.0;
        let told = [wave_mean(x, width), f64::from(cell), f64::from(wave_mean_f32(x as f32, width as f32))];
        for (score, told) in tally.scores.iter_mut().zip(told) {
            score.measure((told - exact).abs() / U);
            score.said = Some([Some(told), Some(exact)]);
        }
    }
    tally
}

/// Rays down to a floor, flatter and flatter: how far the hit moves from one pixel to the next.
fn check_steps(range: Range<u64>, flattest: f64) -> Tally {
    const PIXEL: f64 = 1e-3;
    let mut tally = Tally::new(STEPS.len());
    for index in range {
        let mut draws = Draws::new(162, index);
        let slope = draws.power_of_ten(flattest, 0.0);
        let direction = DVec3::new(draws.between(-0.5, 0.5), -slope, -1.0).normalize().as_vec3().as_dvec3();
        // The floor is 1 below the eye; a pixel up.
        let moved = DVec3::new(0.0, PIXEL / -direction.y, 0.0);
        tally.count(true);
        let step = step_on_surface(moved, direction, DVec3::Y);
        let fraction = Dyadic::of(moved.y).divided_by(&Dyadic::of(direction.y));
        let exact = |axis: usize| (&Dyadic::of(moved[axis]) - &(&Dyadic::of(direction[axis]) * &fraction)).to_f64();
        let exact = DVec3::new(exact(0), exact(1), exact(2));
        tally.scores[0].measure((step - exact).length() / exact.length() / U);
        let neighbour = (direction + DVec3::Y * PIXEL).as_vec3();
        match step_to_neighbour(direction.as_vec3(), neighbour, Vec3::Y, -1.0) {
            Some(step) => tally.scores[1].measure((step.as_dvec3() - exact).length() / exact.length() / U),
            None => tally.scores[1].check(false),
        }
    }
    tally
}

/// Directions close to a pole: the angle from it.
fn check_angles(range: Range<u64>) -> Tally {
    let mut tally = Tally::new(ANGLES.len());
    for index in range {
        let mut draws = Draws::new(163, index);
        let angle = draws.power_of_ten(-12.0, -2.0);
        let (sine, cosine) = libm::sincos(angle);
        let (east, north) = libm::sincos(draws.between(-PI, PI));
        let direction = DVec3::new(sine * east, cosine, sine * north);
        tally.count(true);
        tally.scores[0].check_value(equirectangular(direction).y, angle / PI);
        tally.scores[1].check_value(from_top_by_cosine(direction.y), angle / PI);
    }
    tally
}

/// Two directions next to each other, the seam or a pole between them: they see next to the same.
fn check_seams(range: Range<u64>) -> Tally {
    let texel = |at: u64| [1, 2, 3].map(|salt| ((at * 7919 + salt * 104_729) % 1009) as f32 / 1009.0);
    let mut tally = Tally::new(SEAMS.len());
    for index in range {
        let mut draws = Draws::new(164, index);
        let (width, height) = (draws.between(1.0, 40.0) as usize, draws.between(1.0, 20.0) as usize);
        let rgb = (0..(width * height) as u64).map(|at| texel(at + index)).collect();
        let image = Texels { width, height, rgb };
        let y = draws.between(-2.0, 2.0);
        let [left, right] = [-1e-12, 1e-12].map(|x| equirectangular(DVec3::new(x, y, 1.0)));
        tally.count(true);
        let apart =
            |one: [f64; 3], other: [f64; 3]| (0..3).map(|part| (one[part] - other[part]).abs()).fold(0.0, f64::max);
        tally.scores[0].measure(apart(around(&image, left), around(&image, right)));
        tally.scores[1].measure(apart(bilinear_to_the_edge(&image, left), bilinear_to_the_edge(&image, right)));
    }
    tally
}

/// Images of any small size: their light when they are halved.
fn check_halves(range: Range<u64>) -> Tally {
    let mut tally = Tally::new(HALVES.len());
    for index in range {
        let mut draws = Draws::new(165, index);
        let (width, height) = (draws.between(1.0, 41.0) as usize, draws.between(1.0, 41.0) as usize);
        let rgb = (0..width * height).map(|_| [draws.unit() as f32; 3]).collect();
        let image = Texels { width, height, rgb };
        let mean =
            |image: &Texels| image.rgb.iter().map(|texel| f64::from(texel[0])).sum::<f64>() / image.rgb.len() as f64;
        tally.count(true);
        tally.scores[0].check_value(mean(&halved(&image)), mean(&image));
        tally.scores[1].check_value(mean(&halved_by_fours(&image)), mean(&image));
    }
    tally
}

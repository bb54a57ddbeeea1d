//! Sampling: do numbers stay below 1, points in their pixels, and means with what they are means of?

use super::{Group, Method, Tally, Trial};
use crate::measure::draws::Draws;
use crate::naive::sampling::{grid_place, mean_by_count, raster_plus_jitter_f32, unit_of_32_bits};
use pinhole::extract::cells_of;
use pinhole::film::FilmTile;
use pinhole::rays::Tile;
use pinhole::sample::{Draw, Independent, PixelKey, Purpose, Sobol, table_offset, unit};
use pinhole::scene::Filter;
use std::ops::Range;

/// The widest image.
const WIDTH: u32 = 65_536;
/// Samples a pixel of the cases of stripes.
const MANY: u32 = 64;

const IN_PIXEL: [Method; 2] = [
    Method::pinhole("pinhole, number and 24 bits in f64", "pixel", 0.0),
    Method::naive("naive, added in f32", "pixel", 0.0),
];
const BELOW_ONE: [Method; 2] =
    [Method::pinhole("pinhole, the first 24 bits", "", 0.0), Method::naive("naive, all 32 bits in f32", "", 0.0)];
const NEIGHBOURS: [Method; 3] = [
    Method::pinhole("pinhole, Sobol", "", 0.0),
    Method::pinhole("pinhole, independent", "", 0.0),
    Method::naive("naive, one pattern for all", "", 0.0),
];
/// An edge of a stripe can be misclassified by one of the 64 samples, and a pixel holds at most five.
const STRIPES: [Method; 3] = [
    Method::pinhole("pinhole, Sobol, 64 samples", "of full", 5.0 / MANY as f64),
    Method::naive("naive, the centre alone", "of full", 5.0 / MANY as f64),
    Method::naive("naive, a grid of 8 × 8", "of full", 5.0 / MANY as f64),
];
const CONSTANT: [Method; 2] = [
    Method::pinhole("pinhole, by the sum of the weights", "of itself", 0.0),
    Method::naive("naive, by the number of samples", "of itself", 0.0),
];

/// The cases of the group.
pub fn trials() -> Vec<Trial> {
    vec![
        Trial::new(Group::Sampling, "the last pixels of 65,536", &IN_PIXEL, check_in_pixel),
        Trial::new(Group::Sampling, "the largest 32 bits", &BELOW_ONE, check_below_one).at_most(4096),
        Trial::new(Group::Sampling, "a pixel and its neighbour", &NEIGHBOURS, check_neighbours),
        Trial::new(Group::Sampling, "upright stripes, one or two a pixel", &STRIPES, check_stripes),
        Trial::new(Group::Sampling, "one colour through Mitchell, 1 to 32 samples", &CONSTANT, check_constant),
    ]
}

/// Whether a sample stays in its pixel, and how far from where its bits say.
fn check_in_pixel(range: Range<u64>) -> Tally {
    let mut tally = Tally::new(IN_PIXEL.len());
    for index in range {
        let mut draws = Draws::new(1701, index);
        let pixel = WIDTH - 1 - (draws.unit() * 64.0) as u32;
        let bits = if index % 16 == 0 { u32::MAX } else { (draws.unit() * f64::from(u32::MAX)) as u32 };
        let exact = f64::from(pixel) + unit(bits);
        tally.count(true);
        let answers = [exact, f64::from(raster_plus_jitter_f32(pixel, unit(bits) as f32))];
        for (score, answer) in tally.scores.iter_mut().zip(answers) {
            score.check(answer.floor() == f64::from(pixel));
            score.measure((answer - f64::from(pixel) - unit(bits)).abs());
        }
    }
    tally
}

fn check_below_one(range: Range<u64>) -> Tally {
    let mut tally = Tally::new(BELOW_ONE.len());
    for index in range {
        let bits = u32::MAX - index as u32;
        tally.count(true);
        tally.scores[0].check(unit(bits) < 1.0);
        tally.scores[1].check(unit_of_32_bits(bits) < 1.0);
    }
    tally
}

/// Whether any of a pixel's first eight points is its neighbour's.
fn check_neighbours(range: Range<u64>) -> Tally {
    let mut tally = Tally::new(NEIGHBOURS.len());
    for index in range {
        let at = |x: u32| PixelKey::new(17, [x, (index / 1024) as u32]);
        let [own, next] = [index as u32 % 1024, index as u32 % 1024 + 1].map(at);
        let one = PixelKey::new(17, [0, 0]);
        let apart = |point: &dyn Fn(u32, PixelKey) -> [u32; 2], a, b| (0..8).all(|n| point(n, a) != point(n, b));
        let sobol = |n: u32, key| Sobol::new(n, 0, Purpose::Pixel).two(key);
        let independent = |n: u32, key| Independent::new(n, 0, Purpose::Pixel).two(key);
        tally.count(true);
        tally.scores[0].check(apart(&sobol, own, next));
        tally.scores[1].check(apart(&independent, own, next));
        tally.scores[2].check(apart(&sobol, one, one));
    }
    tally
}

/// How far the fraction of bright stripes in a pixel is from the exact one.
fn check_stripes(range: Range<u64>) -> Tally {
    let mut tally = Tally::new(STRIPES.len());
    for index in range {
        let mut draws = Draws::new(1702, index);
        let (period, phase, pixel) = (draws.between(0.5, 1.0), draws.unit(), index as u32);
        let bright = |x: f64| (x / period + phase).rem_euclid(1.0) < 0.5;
        let key = PixelKey::new(5, [pixel, 1]);
        let places =
            |place: &dyn Fn(u32) -> f64| (0..MANY).filter(|&n| bright(place(n))).count() as f64 / f64::from(MANY);
        let exact = bright_fraction(period, phase);
        tally.count(true);
        tally.scores[0].measure((places(&|n| unit(Sobol::new(n, 0, Purpose::Pixel).two(key)[0])) - exact).abs());
        tally.scores[1].measure((f64::from(u8::from(bright(0.5))) - exact).abs());
        tally.scores[2].measure((places(&|n| grid_place(n, 8)[0]) - exact).abs());
    }
    tally
}

/// The fraction of [0, 1] on which the stripes are bright.
fn bright_fraction(period: f64, phase: f64) -> f64 {
    // The integral of a stripe's brightness from 0, in periods.
    let upto = |s: f64| 0.5 * s.floor() + (s - s.floor()).min(0.5);
    (upto(1.0 / period + phase) - upto(phase)) * period
}

fn check_constant(range: Range<u64>) -> Tally {
    let cells = cells_of(Filter::MITCHELL);
    let whole = {
        // The filter's area over that of its absolute value, along both axes.
        let negative: f64 = cells.cells.iter().filter(|cell| cell.negative).map(|cell| 1.0 / cell.per_area).sum();
        (1.0 - 2.0 * negative) * (1.0 - 2.0 * negative)
    };
    let mut tally = Tally::new(CONSTANT.len());
    for index in range {
        let value = Draws::new(1703, index).power_of_ten(-3.0, 3.0) as f32;
        let count = 1 + (index % 32) as u32;
        let key = PixelKey::new(6, [index as u32, 2]);
        let weight = |n: u32| {
            let [x, y] = Sobol::new(n, 0, Purpose::Pixel).two(key).map(|bits| table_offset(unit(bits), &cells).1);
            if x == y { 1.0 } else { -1.0 }
        };
        let samples: Vec<(f32, f32)> = (0..count).map(|n| (value, weight(n))).collect();
        let mut film = FilmTile::new(Tile { x: 0, y: 0, width: 1, height: 1 });
        for &(value, weight) in &samples {
            let add = if weight < 0.0 { FilmTile::add_negative } else { FilmTile::add };
            add(&mut film, 0, [value; 3]);
        }
        let own = f64::from(value);
        tally.count(true);
        tally.scores[0].measure((f64::from(film.mean(0)[0]) - own).abs() / own);
        tally.scores[1].measure((mean_by_count(&samples, whole) - own).abs() / own);
    }
    tally
}

//! Films: do sums keep every sample, and only light?

use super::bench::Bench;
use super::{Group, Method, Tally, Trial, film_bytes};
use crate::measure::draws::Draws;
use crate::naive::film::{
    byte_by_curve_f32, mean_by_sum_f32, mean_of_all, mean_with_black_for_bad, running_mean_f32, sum_by_threads,
};
use bevy_ecs::prelude::*;
use glam::DVec3;
use pinhole::film::{FilmTile, film_stage};
use pinhole::plan::{Stage, VectorRows};
use pinhole::rays::Tile;
use pinhole::render::{Execution, render};
use pinhole::scene::*;
use pinhole::shade::Radiance;
use pinhole::stages;
use std::ops::Range;

/// Samples of a pixel that is watched until f32 has stopped long since.
const MANY: u32 = 1 << 26;
/// Samples of a pixel at random.
const FEW: usize = 64;
/// The tile of samples that may be no light.
const TILE: Tile = Tile { x: 32, y: 64, width: 8, height: 2 };
/// Samples a pixel of that tile.
const TURNS: u32 = 8;

/// How far a mean may be off, relative to itself, in u: it is rounded to f32 once, 1 u, and each of n sums in f64 may
/// add 2⁻²⁹ u.
const fn mean_bound(samples: u64) -> f64 {
    1.0 + samples as f64 / (1_u64 << 29) as f64
}

/// The rows of a case of means.
const fn means(samples: u64) -> [Method; 3] {
    [
        Method::pinhole("pinhole, f64 sums", "u", mean_bound(samples)),
        Method::naive("naive, sum in f32", "u", mean_bound(samples)),
        Method::naive("naive, running mean in f32", "u", mean_bound(samples)),
    ]
}

/// The cases of the group.
pub fn trials() -> Vec<Trial> {
    let many = means(MANY as u64);
    let mut trials = vec![
        Trial::new(Group::Film, "the mean of 2^26 ones", &many, |range| check_many(range, |_| 1.0)).at_most(1),
        Trial::new(Group::Film, "the mean of 2^26 numbers from 0 to 1", &many, |range| {
            check_many(range, |draws| (draws.unit() * f64::from(1 << 24)).floor() as f32 / (1 << 24) as f32)
        })
        .at_most(1),
        Trial::new(Group::Film, "the mean of 64 samples from 1e-8 to 1e8", &means(FEW as u64), check_few),
        Trial::new(Group::Film, "samples of which some are no light", &NO_LIGHT, check_no_light).at_most(100_000),
        Trial::new(Group::Film, "1 to 8 threads, as on one", &THREADS, check_threads).at_most(64),
    ];
    trials.extend(film_bytes::trials());
    trials
}

/// One pixel and as many samples as a long render adds; whole multiples of 2⁻²⁴, whose sum is exact in whole numbers.
fn check_many(range: Range<u64>, sample: impl Fn(&mut Draws) -> f32) -> Tally {
    let mut tally = Tally::new(means(0).len());
    for index in range {
        let samples = || {
            let mut draws = Draws::new(101, index);
            let sample = &sample;
            (0..MANY).map(move |_| sample(&mut draws))
        };
        let whole = |sample: f32| (f64::from(sample) * f64::from(1 << 24)) as u64;
        let sum: u64 = samples().map(whole).sum();
        // Below 2⁵³, and the divisor is a power of two: exact.
        let exact = sum as f64 / f64::from(1 << 24) / f64::from(MANY);
        let mut film = FilmTile::new(Tile { x: 0, y: 0, width: 1, height: 1 });
        samples().for_each(|sample| film.add(0, [sample; 3]));
        tally.count(true);
        tally.scores[0].check(film.count[0] == MANY && film.rejected == 0);
        tally.scores[0].check_value(f64::from(film.mean(0)[0]), exact);
        tally.scores[1].check_value(f64::from(mean_by_sum_f32(samples())), exact);
        tally.scores[2].check_value(f64::from(running_mean_f32(samples())), exact);
    }
    tally
}

/// An f32 from 1e-9 to 1e9 in units of 2⁻⁵⁴, which holds it exactly.
fn in_small_units(sample: f32) -> i128 {
    (f64::from(sample) * (1_u64 << 54) as f64) as i128
}

fn check_few(range: Range<u64>) -> Tally {
    let mut tally = Tally::new(means(0).len());
    let mut samples = [0.0_f32; FEW];
    for index in range {
        let mut draws = Draws::new(102, index);
        samples.fill_with(|| draws.power_of_ten(-8.0, 8.0) as f32);
        let sum: i128 = samples.iter().copied().map(in_small_units).sum();
        let exact = sum as f64 / (1_u64 << 54) as f64 / FEW as f64;
        let mut film = FilmTile::new(Tile { x: 0, y: 0, width: 1, height: 1 });
        samples.iter().for_each(|&sample| film.add(0, [0.0, sample, 0.0]));
        tally.count(true);
        tally.scores[0].check_value(f64::from(film.mean(0)[1]), exact);
        tally.scores[1].check_value(f64::from(mean_by_sum_f32(samples)), exact);
        tally.scores[2].check_value(f64::from(running_mean_f32(samples)), exact);
    }
    tally
}

const NO_LIGHT: [Method; 4] = [
    Method::pinhole("pinhole, counted, named, kept out", "", 0.0),
    Method::naive("naive, added as it comes", "", 0.0),
    Method::naive("naive, NaN as u8", "", 0.0),
    Method::naive("naive, counted as black", "", 0.0),
];

/// A sample: mostly light, sometimes none.
fn sample(draws: &mut Draws) -> f32 {
    const BAD: [f32; 6] = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -1.0, -f32::MIN_POSITIVE, -1e-45];
    match draws.unit() {
        at if at < 0.1 => BAD[(draws.unit() * BAD.len() as f64) as usize],
        _ => draws.power_of_ten(-3.0, 0.0) as f32,
    }
}

/// A tile whose samples come a pass at a time, through the stage.
fn check_no_light(range: Range<u64>) -> Tally {
    let (mut tally, mut bench) = (Tally::new(NO_LIGHT.len()), Bench::new(&[film_stage()]));
    let rows = TILE.rows();
    for index in range {
        let mut draws = Draws::new(103, index);
        let passes: Vec<Vec<f32>> = (0..TURNS).map(|_| (0..rows).map(|_| sample(&mut draws)).collect()).collect();
        bench.put(FilmTile::new(TILE));
        for pass in &passes {
            let mut radiance = Radiance::default();
            let [r, g, b] = radiance.slices_mut(rows);
            r.copy_from_slice(pass);
            g.fill(0.5);
            b.fill(0.25);
            bench.put(radiance);
            bench.run();
        }
        let of_row = |row: usize| -> Vec<f32> { passes.iter().map(|pass| pass[row]).collect() };
        let samples: Vec<Vec<f32>> = (0..rows).map(of_row).collect();
        tally.count(true);
        tally.scores[0].check(is_only_light(bench.column::<FilmTile>(), &samples));
        for samples in &samples {
            let (_, mean) = light_of(samples);
            let naive = [mean_of_all(samples), mean_with_black_for_bad(samples)];
            tally.scores[1].check(naive[0] == mean);
            let byte = byte_by_curve_f32(naive[0] as f32);
            tally.scores[2].check(!naive[0].is_nan() || mean == 0.0 || byte > 0);
            tally.scores[3].check(naive[1] == mean);
        }
    }
    tally
}

/// How many samples are light, and their mean; 0 of none.
fn light_of(samples: &[f32]) -> (u32, f64) {
    let light = |sample: &&f32| sample.is_finite() && **sample >= 0.0;
    let (count, sum) =
        samples.iter().filter(light).fold((0, 0.0), |(count, sum), &light| (count + 1, sum + f64::from(light)));
    (count, sum / f64::from(count.max(1)))
}

/// Whether the film holds the light of these samples to the last bit, and counts and names what is none.
fn is_only_light(film: &FilmTile, samples: &[Vec<f32>]) -> bool {
    let rows = samples.iter().enumerate();
    let sums = rows.clone().all(|(row, samples)| {
        let (count, mean) = light_of(samples);
        film.count[row] == count && film.sum[0][row] / f64::from(count.max(1)) == mean
    });
    let bad: u64 = rows.map(|(row, _)| u64::from(TURNS - film.count[row])).sum();
    let named = film.first_rejected.iter().all(|rejected| {
        let row = TILE.row_of(rejected.pixel[0], rejected.pixel[1]);
        let same = |sample: &f32| sample.to_bits() == rejected.radiance[0].to_bits();
        row.is_some_and(|row| samples[row].iter().any(same)) && rejected.sample < TURNS
    });
    sums && film.rejected == bad && named && film.first_rejected.is_empty() == (bad == 0)
}

const THREADS: [Method; 2] = [
    Method::pinhole("pinhole, every bit of the film", "", 0.0),
    Method::naive("naive, f32 sums a thread, then added", "", 0.0),
];

/// A ball and a light before a camera of this number.
fn scene(number: u64) -> World {
    let mut draws = Draws::new(104, number);
    let mut world = World::new();
    let eye = draws.unit_vector() * 4.0;
    world.spawn((
        PerspectiveCamera { fov: Degrees(draws.between(20.0, 120.0)), axis: FovAxis::Vertical },
        LookAt { eye, target: DVec3::ZERO, up: draws.unit_vector() },
        Resolution { width: 45, height: 27 },
    ));
    world.spawn((Sphere { radius: 1.0 }, Placement::default(), Matte::default()));
    let lamp = eye + draws.unit_vector();
    world.spawn((PointLight::default(), Placement::at(lamp.x, lamp.y, lamp.z)));
    world
}

/// Every stage up to direct light.
fn offer() -> Vec<Stage> {
    let rays = [stages::camera_rays(), stages::intersection(), stages::transforms(), stages::surfaces()].concat();
    [rays, stages::direct_light(), stages::film()].concat()
}

/// Pixel by pixel the bits of the sums, of a film that so many threads rendered in tiles of this side; none where the
/// scene is refused.
fn film_bits(scene: &World, threads: usize, tile_side: u32) -> Option<Vec<([u32; 2], [u64; 3])>> {
    let execution = Execution { threads: Some(threads), tile_side, ..Execution::default() };
    let film = render(scene, &offer(), &execution, &()).ok()?.film;
    let sums = |tile: &FilmTile, row: usize| tile.sum.at(row).map(f64::to_bits);
    let rows = |tile: &FilmTile| -> Vec<_> {
        (0..tile.count.len()).map(|row| (tile.tile.pixel_of(row), sums(tile, row))).collect()
    };
    let mut pixels: Vec<_> = film.tiles.iter().flat_map(rows).collect();
    pixels.sort_unstable();
    Some(pixels)
}

fn check_threads(range: Range<u64>) -> Tally {
    let mut tally = Tally::new(THREADS.len());
    for index in range {
        let (scene, threads) = (scene(index / 8), 1 + index as usize % 8);
        let (alone, shared) = (film_bits(&scene, 1, 64), film_bits(&scene, threads, 8));
        tally.count(alone.is_some());
        tally.scores[0].check(alone.is_some() && alone == shared);
        let mut draws = Draws::new(105, index);
        let samples = [(); FEW].map(|()| draws.power_of_ten(-3.0, 3.0) as f32);
        tally.scores[1].check(sum_by_threads(&samples, threads) == sum_by_threads(&samples, 1));
    }
    tally
}

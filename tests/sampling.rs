//! Sampling as a whole: constants through every filter, the widest image, what means vary by, the command line.

use crate::scenes;

use bevy_ecs::prelude::*;
use pinhole::extract::cells_of;
use pinhole::film::{Film, FilmTile};
use pinhole::plan::{Census, plan};
use pinhole::rays::{PixelSamples, RasterPoints, SampleSigns, Tile};
use pinhole::render::{Execution, inspect, render};
use pinhole::sample::{
    Draw, INTEGRANDS, MeanError, PixelKey, Purpose, SampleIndex, box_offset, mean_error, slope, table_offset,
    tent_offset, unit, with_sampler,
};
use pinhole::scene::*;
use scenes::{Setup, full, named, offer, one_world};

/// Nothing but a background, before a camera that samples it.
fn empty([width, height]: [u32; 2], sampling: Sampling, colour: Rgb) -> World {
    let mut world = World::new();
    let camera = (Name::new("camera"), PerspectiveCamera::default(), Resolution { width, height }, sampling);
    world.spawn((camera, Placement::at(0.0, 0.0, 1.0)));
    world.spawn((Name::new("sky"), Background { colour }));
    world
}

fn samplings() -> impl Iterator<Item = Sampling> {
    let both = |(_, filter)| Sampler::ALL.map(|(_, sampler)| Sampling { sampler, filter, ..Sampling::default() });
    Filter::ALL.into_iter().flat_map(both)
}

fn rendered(scene: &World) -> Film {
    render(scene, &offer(), &one_world(), &()).expect("renders").film
}

#[test]
fn a_constant_comes_back_bit_for_bit_through_every_filter_at_every_count() {
    let colour = Rgb::new(0.3, 0.7, 1.9);
    let expected = colour.to_array().map(|part| part as f32);
    let (mut tried, mut without) = (0, 0);
    for sampling in samplings() {
        for samples in (1..=20).chain([25, 64]) {
            let film = rendered(&empty([9, 7], Sampling { samples, seed: 3, ..sampling }, colour));
            for (x, y) in (0..7).flat_map(|y| (0..9).map(move |x| (x, y))) {
                assert_eq!(film.mean(x, y), expected, "{sampling:?}, {samples} samples, pixel {x},{y}");
            }
            assert_eq!(film.filter_artifacts().1, 0, "no pixel of a constant rings");
            without += film.filter_artifacts().0;
            tried += 1;
        }
    }
    assert!(without > 30, "Mitchell's weights were never 0 or less, so the case was not tried");
    eprintln!("constants: {tried} pictures, every pixel equal, {without} pixels without a weight above 0 among them");
}

/// What cannot be weighted shows its plain mean and is counted; what rings below 0 shows 0 and is counted.
#[test]
fn a_filter_that_is_negative_in_places_gives_no_nan_and_nothing_below_0() {
    let sampling = Sampling { filter: Filter::MITCHELL, ..Sampling::default() };
    let (mut below, mut without) = (0, 0);
    for samples in [1, 2, 3, 4, 16, 64] {
        let mut scene = full(Setup { size: [48, 33], ..Setup::default() });
        let camera = named(&mut scene, "camera");
        scene.entity_mut(camera).insert(Sampling { samples, ..sampling });
        let film = rendered(&scene);
        let parts = (0..33).flat_map(|y| (0..48).map(move |x| (x, y))).flat_map(|(x, y)| film.mean(x, y));
        assert!(parts.into_iter().all(|part| part.is_finite() && part >= 0.0), "{samples} samples");
        let counted = film.filter_artifacts();
        (without, below) = (without + counted.0, below + counted.1);
        let negative = |tile: &FilmTile| tile.negative_count.iter().sum::<u32>();
        assert!(film.tiles.iter().map(negative).sum::<u32>() > 0, "{samples} samples");
    }
    assert!(below > 0 && without > 0, "{below} pixels rang below 0, {without} had no weight: too few to tell");
    eprintln!("negative weights: {without} pixels showed their plain mean, {below} rang below 0, none was NaN");
    let mut tile = FilmTile::new(Tile { x: 0, y: 0, width: 2, height: 1 });
    tile.add_negative(0, [0.5, 0.25, 1.0]);
    assert_eq!((tile.weight(0), tile.mean(0)), (-1, [0.5, 0.25, 1.0]), "one sample, and it counts negatively");
    tile.add(0, [0.5, 0.75, 1.0]);
    assert_eq!((tile.weight(0), tile.mean(0)), (0, [0.5, 0.5, 1.0]), "weights that cancel");
    tile.add_negative(1, [f32::NAN, 0.0, 0.0]);
    assert_eq!((tile.rejected, tile.weight(1), tile.mean(1)), (1, 0, [0.0; 3]), "what is no light counts for nothing");
}

/// Filters without negative parts keep the film as it is without sampling: the same components, the same bytes, no signs.
#[test]
fn only_a_filter_with_negative_parts_has_signs() {
    for sampling in samplings() {
        let scene = empty([9, 7], Sampling { samples: 16, ..sampling }, Rgb::grey(0.5));
        let signed =
            plan(&Census::of(&scene), &offer()).expect("plans").columns.iter().any(|column| column.name == "sign");
        assert_eq!(signed, matches!(sampling.filter, Filter::Mitchell { .. }), "{sampling:?}");
        let film = rendered(&scene);
        let bare = Film::new(9, 7, 32).bytes();
        assert_eq!(film.bytes() > bare, signed, "{sampling:?}");
    }
}

/// In the widest image each sample of a box stays in its pixel with every bit, and wide filters lose no more than f64
/// rounds.
#[test]
fn no_bit_is_lost_in_an_image_of_65536_pixels() {
    const WIDTH: u32 = 65_536;
    let (mut tried, mut worst) = (0, 0.0_f64);
    for sampling in samplings() {
        let row_of_pixels = empty([WIDTH, 1], Sampling { samples: 4, seed: 9, ..sampling }, Rgb::grey(1.0));
        let inspection = inspect(&row_of_pixels, &offer(), 1024).expect("inspects");
        let cells = cells_of(sampling.filter);
        for &tile in &inspection.tiles {
            let tile = inspection.world.entity(tile);
            let (place, raster) = (tile.get::<Tile>().expect("a tile"), tile.get::<RasterPoints>().expect("points"));
            assert_eq!(tile.contains::<SampleSigns>(), sampling.filter.is_signed());
            let rows = &tile.get::<PixelSamples>().expect("samples").pixel;
            for (row, &pixel) in rows.iter().enumerate() {
                let [x, y] = place.pixel_of(pixel as usize);
                let key = PixelKey::new(9, [x, y]);
                let sample = SampleIndex { number: 0, samples: 4, depth: 0 };
                let drawn = with_sampler!(sampling.sampler, D => D::of(sample, Purpose::Pixel).two(key));
                let radius = pinhole::extract::radius_of(sampling.filter);
                if sampling.filter == Filter::BOX {
                    assert_eq!(raster.point[0][row].floor(), f64::from(x), "{sampling:?}");
                    assert_eq!(raster.point[0][row] - f64::from(x), unit(drawn[0]), "{sampling:?}");
                }
                let off = match sampling.filter {
                    Filter::Box { radius } => box_offset(unit(drawn[0]), radius),
                    Filter::Tent { radius } => tent_offset(unit(drawn[0]), radius),
                    _ => table_offset(unit(drawn[0]), &cells).0,
                };
                assert!(off.abs() <= radius, "{sampling:?}, pixel {x}: {off}");
                let lost = (raster.point[0][row] - f64::from(x) - 0.5 - off).abs();
                assert!(lost <= f64::from(WIDTH) * f64::EPSILON, "{sampling:?}, pixel {x}: {lost:e} lost");
                (tried, worst) = (tried + 1, worst.max(lost));
            }
        }
    }
    eprintln!("width {WIDTH}: {tried} samples of 15 samplings, each at its own pixel, {worst:.1e} pixels lost at most");
}

/// Stratified numbers alone have finer strata than in pairs.
#[test]
fn a_single_number_is_the_first_of_two_unless_it_is_stratified() {
    for (purpose, depth) in Purpose::ALL.into_iter().flat_map(|purpose| [(purpose, 0), (purpose, 3)]) {
        let (index, key) = (SampleIndex { number: 5, samples: 16, depth }, PixelKey::new(1, [7, 11]));
        for sampler in [Sampler::Independent, Sampler::Sobol] {
            let (one, [first, _]) = with_sampler!(sampler, D => {
                let draw = D::of(index, purpose);
                (draw.one(key), draw.two(key))
            });
            assert_eq!(one, first, "{sampler:?}, {purpose:?} at depth {depth}");
        }
    }
}

/// Independent samples vary by σ² / n; none is biased.
#[test]
fn means_vary_as_theory_says_and_are_unbiased() {
    const TRIALS: u32 = 2000;
    let (mut tried, mut worst, mut dearest) = (0, 0.0_f64, 0.0_f64);
    for integrand in INTEGRANDS {
        for samples in [1, 2, 3, 4, 7, 16, 64] {
            for (word, sampler) in Sampler::ALL {
                let purposes = Purpose::ALL.into_iter().filter(|purpose| purpose.numbers() == 2);
                for purpose in purposes {
                    let error = mean_error(sampler, purpose, integrand, samples, TRIALS, 71);
                    let told = format!("{word}, {purpose:?}, {}, {samples} samples: {error:?}", integrand.name);
                    let off = error.bias.abs() / (error.variance / f64::from(TRIALS)).sqrt();
                    worst = worst.max(off);
                    assert!(off < 4.5, "biased by {off:.1} standard errors: {told}");
                    let expected = integrand.variance / f64::from(samples);
                    if sampler == Sampler::Independent {
                        let apart = (error.variance - expected).abs();
                        // The second term is what is left of the spread where the fourth moment is the variance's square.
                        let spread = 4.5 * error.variance_error + 8.0 * expected / f64::from(TRIALS);
                        assert!(apart < spread, "{told}, expected {expected}");
                    } else {
                        dearest = dearest.max(error.variance / expected);
                        // Theory allows a scrambled net e times as much (Owen 1997, t = 0); on these functions it is never worse.
                        assert!(
                            error.variance
                                <= expected + 4.5 * error.variance_error + 8.0 * expected / f64::from(TRIALS),
                            "worse than by dice: {told}"
                        );
                    }
                    tried += 1;
                }
            }
        }
    }
    eprintln!("means: {tried} of {TRIALS} trials each, the worst biased by {worst:.2} standard errors of 4.5 allowed");
    eprintln!("means: no net varies more than {dearest:.2} times as much as dice");
}

/// Bounces are independent of each other: (u − ½)(v − ½) of one number each from two bounces has the mean 0, and its mean
/// over n samples the variance 1/144n, whatever order a sampler takes its points in.
#[test]
fn bounces_are_independent() {
    const SAMPLES: u32 = 64;
    const PIXELS: u32 = 1500;
    let (mut tried, mut greatest, mut sum) = (0, 0.0_f64, 0.0);
    for (one, other) in [(0, 1), (1, 2), (1, 3), (2, 3), (2, 7)] {
        for purpose in Purpose::ALL {
            for (word, sampler) in Sampler::ALL {
                let number = |number: u32, depth: u32, key: PixelKey| {
                    let index = SampleIndex { number, samples: SAMPLES, depth };
                    with_sampler!(sampler, D => D::of(index, purpose).one(key))
                };
                let mean_of = |pixel: u32| {
                    let key = PixelKey::new(29, [pixel, 3]);
                    let product =
                        |sample| (unit(number(sample, one, key)) - 0.5) * (unit(number(sample, other, key)) - 0.5);
                    (0..SAMPLES).map(product).sum::<f64>() / f64::from(SAMPLES)
                };
                let means: Vec<f64> = (0..PIXELS).map(mean_of).collect();
                let variance = means.iter().map(|mean| mean * mean).sum::<f64>() / f64::from(PIXELS);
                let relative = variance * 144.0 * f64::from(SAMPLES);
                let mean = means.iter().sum::<f64>() / f64::from(PIXELS);
                let off = mean / (variance / f64::from(PIXELS)).sqrt();
                let told = format!("{word}, {purpose:?}, bounces {one} and {other}: {relative:.3} times, {off:+.1} SE");
                // Were the points of two bounces in one order, this would be 36 or more.
                assert!(relative < 16.0 && off.abs() < 4.5, "{told}");
                sum += relative;
                greatest = greatest.max(relative);
                tried += 1;
            }
        }
    }
    let mean = sum / f64::from(tried);
    eprintln!("bounces: {tried} pairs, {mean:.2} times the variance of independent numbers, {greatest:.2} at most");
    assert!(mean < 1.6, "{mean} times");
}

/// The slope of the variance: −1 by dice, −2 with one sample a cell, steeper with Owen's scrambling where it is smooth.
#[test]
fn slopes_are_those_of_theory() {
    let fitted = |sampler, integrand| {
        let level = |k: u32| mean_error(sampler, Purpose::Pixel, integrand, 1 << (2 * k), 600, 5);
        slope(&(1..=5).map(level).collect::<Vec<MeanError>>())
    };
    // Least and greatest that the slope's interval may touch: by dice and with cells those of theory; for Sobol what
    // −3 and a logarithm become between 4 and 1024 samples.
    let asked = [
        (Sampler::Independent, 0, -1.0, -1.0),
        (Sampler::Independent, 2, -1.0, -1.0),
        (Sampler::Stratified, 1, -2.0, -2.0),
        (Sampler::Stratified, 3, -1.6, -1.4),
        (Sampler::Sobol, 0, -3.1, -2.9),
        (Sampler::Sobol, 1, -3.1, -2.5),
        (Sampler::Sobol, 2, -1.7, -1.3),
        (Sampler::Sobol, 3, -1.7, -1.3),
    ];
    for (sampler, which, min, greatest) in asked {
        let (slope, half) = fitted(sampler, INTEGRANDS[which]);
        eprintln!("slope of {sampler:?}, {}: {slope:.3} ± {half:.3}", INTEGRANDS[which].name);
        let touches = slope + 1.5 * half >= min && slope - 1.5 * half <= greatest;
        assert!(touches, "{sampler:?}: {slope:.3} ± {half:.3}, asked {min} to {greatest}");
        if sampler == Sampler::Sobol {
            assert!(slope + half < -1.0, "not steeper than −1");
        }
    }
}

fn run(words: &str) -> (Result<(), String>, String) {
    let words: Vec<String> = words.split_whitespace().map(String::from).collect();
    let mut out = Vec::new();
    let done = pinhole_cli::command::run(&chapters::all(), &words, &mut out).map_err(|error| error.to_string());
    (done, String::from_utf8(out).expect("text"))
}

#[test]
fn the_command_line_samples_what_it_is_told_and_refuses_in_a_sentence() {
    let (done, told) = run("plan 5 --samples 4 --filter mitchell --sampler stratified");
    assert!(done.is_ok() && told.contains("kept     Place samples"), "{told}");
    let (done, told) = run("plan 5");
    assert!(done.is_ok() && told.contains("dropped  Place samples"), "{told}");
    let (done, told) = run("export 5 --seed 7 --filter box");
    let expected = "sampling: (samples: 16, seed: 7, sampler: Sobol, filter: Box(radius: 0.5))";
    assert!(done.is_ok() && told.contains(expected), "{told}");
    let (done, told) = run("trace 5 --pixel 1,2 --samples 8 --sample 7");
    assert!(
        done.is_ok() && told.contains("pixel 1,2   sample 7, bounce 0") && told.contains("pixel 0  sample 7"),
        "{told}"
    );
    for (words, told) in [
        ("plan 5 --samples 0", "a number of samples is a whole number from 1 to 16777216"),
        ("plan 5 --samples 16777217", "a number of samples is a whole number from 1 to 16777216"),
        ("plan 5 --samples many", "a number of samples"),
        ("plan 5 --seed -1", "a seed is a whole number from 0 to 18446744073709551615"),
        ("plan 5 --sampler halton", "a sampler is one of sobol, stratified, independent"),
        ("plan 5 --filter lanczos", "a filter is one of box, tent, gaussian, mitchell, blackman-harris"),
        ("trace 5 --pixel 1,2 --sample 1", "sample is 1, but the camera takes one sample of each pixel, number 0"),
        (
            "trace 5 --pixel 1,2 --samples 4 --sample 4",
            "sample is 4, but the camera takes samples 0 to 3 of each pixel",
        ),
    ] {
        let refused = run(words).0.expect_err(words);
        // Below what is wrong clap says where there is more to read.
        let sentence = refused.lines().next().unwrap_or_default();
        assert!(sentence.contains(told) && !sentence.ends_with('.'), "{words}: {refused}");
    }
}

/// Threads, tiles and worlds change no bit of a sampled film, whatever samples it.
#[test]
fn no_execution_changes_a_sampled_film() {
    let mut tried = 0;
    for sampling in samplings() {
        let mut scene = full(Setup { size: [45, 37], ..Setup::default() });
        let camera = named(&mut scene, "camera");
        scene.entity_mut(camera).insert(Sampling { samples: 3, ..sampling });
        let expected = scenes::film(&scene);
        for (tile_side, threads) in [(8, 1), (8, 3), (64, 2)] {
            let execution = Execution { tile_side, threads: Some(threads), ..Execution::default() };
            let film = scenes::film_by(&scene, &offer(), &execution).expect("renders");
            film.assert_is(&expected, &format!("{sampling:?}, {threads} threads, tiles of {tile_side}"));
            tried += 1;
        }
    }
    eprintln!("executions: {tried} films of 15 samplings, all equal");
}

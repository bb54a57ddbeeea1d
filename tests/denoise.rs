//! The denoiser: what it leaves as it is, what plain code makes of the same numbers, and its bias and variance apart.

use crate::scenes::{offer, one_world};
use bevy_ecs::prelude::*;
use glam::{DVec3, Vec3};
use pinhole::film::{
    Film, FilmLayers, FilmMoments, Guides, PICTURE_GUIDES, denoise, denoise_picture, denoise_radiance,
};
use pinhole::render::{Execution, render};
use pinhole::scene::*;
use pinhole::{Overrides, Size};
use pinhole_lab::measure::draws::Draws;

/// Guides and radiance of an image whose surfaces change at random, some pixels without any.
fn random(width: usize, height: usize, seed: u64) -> (Guides, [Vec<f32>; 3]) {
    let mut draws = Draws::new(1701, seed);
    let columns = || [(); 3].map(|()| vec![0.0_f32; width * height]);
    let mut guides = Guides { width, normal: columns(), position: columns(), origin: [0.0; 3], albedo: columns() };
    let mut radiance = columns();
    let (mut normal, mut offset) = (DVec3::Z, DVec3::ZERO);
    for at in 0..width * height {
        if draws.unit() < 0.1 {
            (normal, offset) = (draws.unit_vector().normalize(), draws.unit_vector() * 3.0);
        }
        let is_hit = draws.unit() < 0.95;
        let position = offset + DVec3::new((at % width) as f64, (at / width) as f64, 0.0) * 0.1;
        for part in 0..3 {
            guides.normal[part][at] = if is_hit { normal[part] as f32 } else { 0.0 };
            guides.position[part][at] = if is_hit { position[part] as f32 } else { 0.0 };
            guides.albedo[part][at] = if is_hit { draws.between(0.1, 1.0) as f32 } else { 1.0 };
            radiance[part][at] = draws.power_of_ten(-2.0, 2.0) as f32;
        }
    }
    (guides, radiance)
}

fn vector(columns: &[Vec<f32>; 3], at: usize) -> Vec3 {
    Vec3::from(columns.each_ref().map(|column| column[at]))
}

/// One level in plain code, over all pixels and their neighbours.
fn plainly(guides: &Guides, radiance: &[Vec<f32>; 3], level: u32) -> Vec<DVec3> {
    let (width, step) = (guides.width as i64, 1_i64 << level);
    let height = radiance[0].len() as i64 / width;
    let spline = |steps: i64| [6.0 / 16.0, 4.0 / 16.0, 1.0 / 16.0][steps.unsigned_abs() as usize];
    let pixel = |at: i64| {
        let (mut sum, mut weights) = (DVec3::ZERO, 0.0);
        let (x, y) = (at % width, at / width);
        let (normal, place) =
            (vector(&guides.normal, at as usize).as_dvec3(), vector(&guides.position, at as usize).as_dvec3());
        for (down, right) in (-2..=2).flat_map(|down| (-2..=2).map(move |right| (down, right))) {
            let (x, y) = (x + right * step, y + down * step);
            if !(0..width).contains(&x) || !(0..height).contains(&y) {
                continue;
            }
            let other = (y * width + x) as usize;
            let along = vector(&guides.position, other).as_dvec3() - place;
            let sine = normal.dot(along) / along.length();
            let flat = if along == DVec3::ZERO { 1.0 } else { 1.0 / (1.0 + (sine / 0.1) * (sine / 0.1)) };
            let cosine = normal.dot(vector(&guides.normal, other).as_dvec3()).max(0.0);
            let alike = if (down, right) == (0, 0) { 1.0 } else { libm::pow(cosine, 32.0) * flat };
            let weight = spline(down) * spline(right) * alike;
            let albedo = vector(&guides.albedo, other).as_dvec3();
            sum += weight * vector(radiance, other).as_dvec3() / albedo;
            weights += weight;
        }
        sum / weights * vector(&guides.albedo, at as usize).as_dvec3()
    };
    (0..width * height).map(pixel).collect()
}

#[test]
fn a_level_is_what_plain_code_makes_of_it() {
    let mut worst = 0.0_f64;
    for (seed, [width, height]) in [[37, 23], [1, 9], [9, 1], [3, 3], [64, 5]].into_iter().enumerate() {
        let (guides, radiance) = random(width, height, seed as u64);
        let fast = denoise_radiance(radiance.clone(), &guides, 1);
        for (at, plain) in plainly(&guides, &radiance, 0).into_iter().enumerate() {
            worst = worst.max(((vector(&fast, at).as_dvec3() - plain) / plain).abs().max_element());
        }
    }
    assert!(worst < 1e-4, "{worst:e}");
    eprintln!("a level of the filter is within {worst:.1e} of plain code in f64, relative to itself");
}

#[test]
fn light_that_is_even_stays_so_and_sums_are_filtered_apart() {
    for seed in 0..20 {
        let (guides, radiance) = random(41, 29, seed);
        let even = guides.albedo.clone().map(|albedo| albedo.into_iter().map(|albedo| 3.0 * albedo).collect());
        let kept = denoise_radiance(even, &guides, 5);
        for at in 0..41 * 29 {
            let expected = 3.0 * vector(&guides.albedo, at);
            assert!(((vector(&kept, at) - expected) / expected).abs().max_element() < 1e-5, "seed {seed}, pixel {at}");
        }
        let (_, other) = random(41, 29, seed + 100);
        let mut sum = radiance.clone();
        sum.iter_mut()
            .zip(&other)
            .for_each(|(sum, other)| sum.iter_mut().zip(other).for_each(|(sum, other)| *sum += other));
        let [one, other, both] = [radiance, other, sum].map(|radiance| denoise_radiance(radiance, &guides, 5));
        for at in 0..41 * 29 {
            let apart = vector(&one, at) + vector(&other, at);
            assert!(((vector(&both, at) - apart) / apart).abs().max_element() < 1e-5, "seed {seed}, pixel {at}");
        }
    }
}

/// A box on a ground under a sky and a small light, by paths of two bounces.
fn lit(samples: u32, seed: u64) -> Film {
    let mut world = World::new();
    let layers = Layers { kinds: pinhole::film::PICTURE_GUIDES.to_vec() };
    let look = LookAt { eye: DVec3::new(3.0, 2.5, 5.0), target: DVec3::new(0.0, 0.5, 0.0), ..LookAt::default() };
    let path = Integrator::Path { max_depth: 3, lights: LightStrategy::Mis, roulette: 0 };
    let sampling = Sampling { samples, seed, sampler: Sampler::Independent, filter: Filter::Box { radius: 0.5 } };
    world.spawn((PerspectiveCamera::default(), look, Resolution { width: 64, height: 48 }, path, sampling, layers));
    world.spawn((Cuboid::default(), Placement::at(0.0, 0.5, 0.0), Matte { colour: Rgb::new(0.8, 0.4, 0.2) }));
    world.spawn((Plane::default(), Matte { colour: Rgb::grey(0.6) }));
    world.spawn((
        Sphere { radius: 1.0 },
        Placement::at(6.0, 6.0, 6.0),
        Emissive { radiance: Rgb::grey(20.0), ..Emissive::default() },
    ));
    world.spawn(Background { colour: Rgb::new(0.3, 0.4, 0.6) });
    render(&world, &offer(), &one_world(), &()).expect("renders").film
}

/// The mean over pixels and channels of the square of a difference.
fn mean_square(one: &[Vec<f32>; 3], other: &[Vec<f32>; 3]) -> f64 {
    let pairs = one.iter().flatten().zip(other.iter().flatten());
    pairs.map(|(one, other)| f64::from(one - other) * f64::from(one - other)).sum::<f64>() / (3 * one[0].len()) as f64
}

fn means(film: &Film) -> [Vec<f32>; 3] {
    let pixels: Vec<[f32; 3]> = (0..film.height).flat_map(|y| (0..film.width).map(move |x| film.mean(x, y))).collect();
    [0, 1, 2].map(|part| pixels.iter().map(|pixel| pixel[part]).collect())
}

/// Error is bias and variance together: the filter takes away variance and adds bias, and each is measured by itself.
#[test]
fn it_trades_variance_for_bias_and_says_how_much_of_each() {
    const RUNS: u64 = 8;
    let reference = lit(512, 99);
    let truth = means(&reference);
    let films: Vec<Film> = (0..RUNS).map(|seed| lit(2, seed)).collect();
    let noise = films.iter().map(|film| mean_square(&means(film), &truth)).sum::<f64>() / RUNS as f64;
    let mut last = [f64::INFINITY, 0.0];
    for levels in [1, 2, 3] {
        let smooth: Vec<[Vec<f32>; 3]> = films.iter().map(|film| denoise(film, levels).expect("layers")).collect();
        let mean = [0, 1, 2].map(|part| {
            let sum = |at: usize| smooth.iter().map(|image| image[part][at]).sum::<f32>() / RUNS as f32;
            (0..smooth[0][part].len()).map(sum).collect::<Vec<f32>>()
        });
        let error = smooth.iter().map(|image| mean_square(image, &truth)).sum::<f64>() / RUNS as f64;
        let spread = smooth.iter().map(|image| mean_square(image, &mean)).sum::<f64>() / (RUNS - 1) as f64;
        // The filter is linear, so the mean of many filtered renders is what it makes of their mean.
        let bias = mean_square(&denoise(&reference, levels).expect("layers"), &truth);
        eprintln!(
            "{levels} levels: error {error:.2e} = variance {spread:.2e} + bias² {bias:.2e}; unfiltered {noise:.2e}"
        );
        assert!(spread < last[0] && bias > last[1], "each level takes variance away and adds bias");
        last = [spread, bias];
    }
    assert!(last[0] + last[1] < 0.5 * noise, "the error is halved at least: {last:?} of {noise:e}");
}

#[test]
fn a_film_without_the_guiding_layers_is_not_denoised() {
    let mut world = World::new();
    world.spawn((PerspectiveCamera::default(), Resolution { width: 8, height: 6 }));
    world.spawn((Sphere::default(), Placement::at(0.0, 0.0, -3.0), Matte::default()));
    assert!(denoise(&render(&world, &offer(), &one_world(), &()).expect("renders").film, 3).is_none());
}

/// A film of a plane whose pixels have two samples each: radiance by place, with the variance of a sample, and albedo.
fn plane(side: u32, pixel: impl Fn(u32, u32) -> (f32, f64, f64)) -> Film {
    let mut film = Film::new(side, side, side);
    let mut layers = FilmLayers::new((side * side) as usize, &PICTURE_GUIDES);
    let mut moments = FilmMoments::new((side * side) as usize);
    for (x, y) in (0..side).flat_map(|y| (0..side).map(move |x| (x, y))) {
        let (row, (radiance, variance, albedo)) = ((y * side + x) as usize, pixel(x, y));
        (0..2).for_each(|_| film.tiles[0].add(row, [radiance; 3]));
        (0..3).for_each(|part| moments.sum[part][row] = variance);
        (layers.hits[row], layers.taken[row]) = (2, 2);
        // Position, normal and albedo, in the order of the layers.
        let sums = [f64::from(x), f64::from(y), 0.0, 0.0, 0.0, 1.0, albedo, albedo, albedo];
        sums.into_iter().zip(&mut layers.sums).for_each(|(value, sums)| sums[row] = 2.0 * value);
    }
    (film.layers, film.moments, film.done) = (vec![layers], vec![moments], vec![5]);
    film
}

#[test]
fn a_finished_picture_is_smoothed_only_as_far_as_its_noise() {
    const SIDE: u32 = 40;
    let mut draws = Draws::new(1702, 1);
    let noise: Vec<f32> = (0..SIDE * SIDE).map(|_| draws.between(0.5, 1.5) as f32).collect();
    let at = |x: u32, y: u32| noise[(y * SIDE + x) as usize];
    // Without noise every difference is part of the picture.
    let exact = denoise_picture(&plane(SIDE, |x, y| (at(x, y), 0.0, 0.5))).expect("guides");
    assert!(
        exact.iter().all(|part| part.iter().zip(&noise).all(|(own, expected)| own.to_bits() == expected.to_bits()))
    );
    // With the variance that the numbers have, 1/12, most of the differences go: 25 pixels and more are averaged.
    let smooth = denoise_picture(&plane(SIDE, |x, y| (at(x, y), 1.0 / 6.0, 0.5))).expect("guides");
    let inner = (8..32).flat_map(|y| (8..32).map(move |x| (y * SIDE + x) as usize));
    let squares = inner.map(|pixel| (smooth[0][pixel] - 1.0) * (smooth[0][pixel] - 1.0)).sum::<f32>();
    let off = (squares / (24.0 * 24.0)).sqrt();
    assert!(off < 0.1, "{off} is left of a standard deviation of 0.289");
    // A lamp in the plane stays as it is, and nothing of it gets onto the wall, not even from the pixels at its edge.
    let lamp = |x: u32, y: u32| (10..20).contains(&x) && (10..20).contains(&y);
    let edge = |x: u32, y: u32| (9..21).contains(&x) && (9..21).contains(&y);
    let lit = denoise_picture(&plane(SIDE, |x, y| match (lamp(x, y), edge(x, y)) {
        (true, _) => (1000.0, 0.0, 0.0),
        (_, true) => (500.0, 500.0 * 500.0, 0.25),
        _ => (at(x, y), 1.0 / 6.0, 0.5),
    }))
    .expect("guides");
    let mut walls = 0;
    for (x, y) in (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| (x, y))) {
        let own = lit[0][(y * SIDE + x) as usize];
        match (lamp(x, y), edge(x, y)) {
            (true, _) => assert_eq!(own.to_bits(), 1000.0_f32.to_bits()),
            (_, true) => {}
            _ => {
                assert!((0.4..1.6).contains(&own), "{own} at {x},{y}");
                walls += 1;
            }
        }
    }
    assert!(denoise_picture(&Film { layers: Vec::new(), ..plane(4, |_, _| (1.0, 0.0, 0.5)) }).is_none());
    eprintln!(
        "denoised: 1600 pixels without noise as they were; a noise of 0.289 becomes {off:.3}; {walls} beside a lamp unlit"
    );
}

/// Against pictures of many samples: a box with a lamp in its ceiling, and mirrors, whose reflections no layer tells.
///
/// Of one picture the bright pixels say too much, so four are taken.
#[test]
fn a_finished_picture_is_nearer_to_the_right_one() {
    let mut told = Vec::new();
    for (chapter, asked) in [("25", [(4, 0.35), (16, 0.5)]), ("29", [(4, 1.0), (16, 1.0)])] {
        let chapter = chapters::all().into_iter().find(|own| own.name.starts_with(chapter)).expect("a chapter");
        let film = |samples: u32, seed: u64, layers: &[LayerKind]| {
            let mut asked = Overrides { size: Some(Size::Width(64)), ..Overrides::default() };
            (asked.sampling.samples, asked.sampling.seed) = (Some(samples), Some(seed));
            asked.layers = (!layers.is_empty()).then(|| Layers { kinds: layers.to_vec() });
            render(&chapter.world(&asked), &chapter.stages(), &Execution::default(), &()).expect("renders").film
        };
        // Its own noise is a thirtieth of what is left to find, and the same before and after.
        let right = means(&film(512, 7, &[]));
        let relative = |image: &[Vec<f32>; 3]| {
            let squares =
                image.iter().zip(&right).flat_map(|(image, right)| image.iter().zip(right)).map(|(&own, &right)| {
                    let (own, right) = (f64::from(own), f64::from(right));
                    (own - right) * (own - right) / (right * right + 0.01)
                });
            squares.sum::<f64>() / right.iter().map(Vec::len).sum::<usize>() as f64
        };
        for (samples, most) in asked {
            let [mut before, mut after] = [0.0; 2];
            for seed in 1..=4 {
                let noisy = film(samples, seed, &PICTURE_GUIDES);
                before += 0.25 * relative(&means(&noisy));
                after += 0.25 * relative(&denoise_picture(&noisy).expect("guides"));
            }
            assert!(after < most * before, "{} of {samples} samples: {after} after {before}", chapter.name);
            told.push(format!("{} at {samples}: {before:.4} to {after:.4}", chapter.name));
        }
    }
    eprintln!("denoised, relMSE: {}", told.join("; "));
}

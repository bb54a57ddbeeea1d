//! Reprojection: what earlier frames know is found where it is now, is not taken for what it is not, and takes noise away.

use crate::scenes::{offer, one_world};
use bevy_ecs::prelude::*;
use glam::{DVec2, DVec3};
use pinhole::film::{Film, GUIDES, History};
use pinhole::plan::Census;
use pinhole::rasterise::Projection;
use pinhole::render::render;
use pinhole::scene::*;

const SIZE: [u32; 2] = [96, 54];
const TARGET: DVec3 = DVec3::new(0.0, 0.5, 0.0);
/// The middle of the box, whose edges are 2 long; a quarter of it is below the ground.
const MIDDLE: DVec3 = DVec3::new(0.0, 0.5, 0.0);

/// A box on checked ground, seen from a point, under a sky that is as bright everywhere; with samples, by paths.
fn seen(eye: DVec3, sampling: Option<Sampling>) -> World {
    let mut world = World::new();
    let look = LookAt { eye, target: TARGET, ..LookAt::default() };
    let resolution = Resolution { width: SIZE[0], height: SIZE[1] };
    let camera = (PerspectiveCamera::default(), look, resolution, Layers { kinds: GUIDES.to_vec() });
    match sampling {
        None => world.spawn((camera, Integrator::RayCasting)),
        Some(sampling) => {
            let path = Integrator::Path { max_depth: 3, lights: LightStrategy::Mis, roulette: 0 };
            world.spawn((camera, path, sampling))
        }
    };
    world.spawn((
        Cuboid::default(),
        Placement { position: MIDDLE, ..Placement::default() },
        Matte { colour: Rgb::new(0.8, 0.4, 0.2) },
    ));
    world.spawn((Plane::default(), Matte::default(), Checker { size: 0.7, ..Checker::default() }));
    match sampling {
        None => {
            let sun = DirectionalLight { casts_shadows: false, ..DirectionalLight::default() };
            world.spawn((sun, LookAt { eye: DVec3::new(1.0, 3.0, 2.0), ..LookAt::default() }));
        }
        Some(_) => _ = world.spawn(Background { colour: Rgb::grey(1.0) }),
    }
    world
}

fn film(world: &World) -> Film {
    render(world, &offer(), &one_world(), &()).expect("renders").film
}

/// A frame with what an earlier one from another point knows.
fn joined(now: History, earlier: &History, (eye, scene): (DVec3, &World)) -> History {
    let projection = *Census::of(scene).table::<Projection>().expect("it projects");
    now.with_earlier(earlier, &projection, eye)
}

/// How near the segment from a point to an eye passes to the middle of the box, in units of its half edge: below 1 it is
/// blocked.
fn clearance(point: DVec3, eye: DVec3) -> f64 {
    let steps = (1..2000).map(|step| point + (eye - point) * (f64::from(step) / 2000.0));
    steps.map(|at| (at - MIDDLE).abs().max_element()).fold(f64::INFINITY, f64::min)
}

#[test]
fn the_same_view_is_found_as_it_was() {
    let eye = DVec3::new(2.0, 2.0, 4.0);
    let world = seen(eye, None);
    let own = History::of(&film(&world)).expect("layers");
    let both = joined(own.clone(), &own, (eye, &world));
    let ([one, two], mut twice) = ([own.denoised(0), both.denoised(0)], 0);
    for (at, (&one, &two)) in one.iter().flatten().zip(two.iter().flatten()).enumerate() {
        assert!((one - two).abs() <= 1e-5 * one.max(0.01), "{at}: {one} {two}");
    }
    for (own, both) in own.samples.iter().zip(&both.samples) {
        twice += usize::from(*both == 2.0 * own);
    }
    eprintln!("{twice} of {} pixels found themselves", own.samples.len());
    // What is left is the sky, and the edges, where no neighbour is of the surface.
    assert!(twice > own.samples.len() / 2);
}

#[test]
fn what_comes_into_view_is_not_taken_from_what_hid_it() {
    let (mut hidden, mut known, mut clear) = (0, 0, 0);
    let mut worst = 0.0_f64;
    for step in 1..=12 {
        let angle = 0.05 * f64::from(step);
        let eyes = [DVec3::new(0.0, 1.5, 4.0), DVec3::new(4.0 * libm::sin(angle), 1.5, 4.0 * libm::cos(angle))];
        let worlds = eyes.map(|eye| seen(eye, None));
        let films = [film(&worlds[0]), film(&worlds[1])];
        let [earlier, now] = [&films[0], &films[1]].map(|film| History::of(film).expect("layers"));
        let both = joined(now.clone(), &earlier, (eyes[0], &worlds[0]));
        let before = *Census::of(&worlds[0]).table::<Projection>().expect("it projects");
        let pictures = [&now, &both].map(|history| history.denoised(0));
        for tile in &films[1].tiles {
            let layers = &films[1].layers[films[1].tiles.iter().position(|own| own == tile).expect("its own")];
            for row in 0..tile.tile.rows() {
                let [x, y] = tile.tile.pixel_of(row);
                let at = (y * SIZE[0] + x) as usize;
                let place = [0, 1, 2].map(|axis| layers.mean(LayerKind::Position, axis, row));
                let place = DVec3::from(place);
                if layers.hits[row] == 0 || place.y > 1e-6 {
                    continue;
                }
                let found = both.samples[at] > now.samples[at];
                let clip = before.clip(place - eyes[0]);
                let raster = before.raster(clip);
                let is_inside =
                    clip.depth > 0.0 && raster.cmpgt(DVec2::ONE).all() && raster.cmplt(before.size - 1.0).all();
                match clearance(place, eyes[0]) {
                    // The wall that is seen from the front hides it, so nothing of it may be known.
                    near if near < 0.9 => {
                        hidden += 1;
                        assert!(!found, "{place} was hidden from {}, and is known", eyes[0]);
                    }
                    near if near > 1.3 && is_inside => {
                        clear += 1;
                        known += usize::from(found);
                        // The light that falls on the ground is the same everywhere.
                        let apart = (pictures[0][0][at] - pictures[1][0][at]).abs() / pictures[0][0][at];
                        worst = worst.max(f64::from(apart));
                    }
                    _ => {}
                }
            }
        }
    }
    eprintln!(
        "{hidden} pixels were hidden before, 0 of them are known; of {clear} others {known} are, within {worst:.1e}"
    );
    assert!(hidden > 250 && known * 100 > clear * 98 && worst < 1e-5);
}

/// Frames of a camera that goes round by a hundredth of a turn each.
#[test]
fn noise_is_taken_away_and_the_bias_told_apart() {
    const RUNS: u64 = 6;
    const FRAMES: u32 = 8;
    let eye = |frame: u32| {
        let angle = 0.02 * f64::from(frame);
        DVec3::new(4.0 * libm::sin(angle), 2.0, 4.0 * libm::cos(angle))
    };
    let sampling = |samples, seed| Sampling { samples, seed, sampler: Sampler::Independent, ..Sampling::default() };
    let gathered = |run: u64, samples: u32| {
        let mut before: Option<(History, DVec3, World)> = None;
        for frame in 0..FRAMES {
            let world = seen(eye(frame), Some(sampling(samples, run * 100 + u64::from(frame))));
            let own = History::of(&film(&world)).expect("layers");
            let joined = match &before {
                Some((earlier, eye, scene)) => joined(own, earlier, (*eye, scene)),
                None => own,
            };
            before = Some((joined, eye(frame), world));
        }
        before.expect("frames").0.denoised(0)
    };
    let last = seen(eye(FRAMES - 1), Some(sampling(256, 7)));
    let truth = History::of(&film(&last)).expect("layers").denoised(0);
    let alone = |seed| {
        let world = seen(eye(FRAMES - 1), Some(sampling(1, seed)));
        History::of(&film(&world)).expect("layers").denoised(0)
    };
    let square = |one: &[Vec<f32>; 3], other: &[Vec<f32>; 3]| {
        let pairs = one.iter().flatten().zip(other.iter().flatten());
        pairs.map(|(one, other)| f64::from(one - other).powi(2)).sum::<f64>() / (3 * one[0].len()) as f64
    };
    let mean = |some: &[[Vec<f32>; 3]]| {
        [0, 1, 2].map(|part| {
            let sum = |at: usize| some.iter().map(|image| image[part][at]).sum::<f32>() / some.len() as f32;
            (0..some[0][part].len()).map(sum).collect::<Vec<f32>>()
        })
    };
    let runs: Vec<_> = (1..=RUNS).map(|run| gathered(run, 1)).collect();
    let singles: Vec<_> = (1..=RUNS).map(|run| alone(1000 + run)).collect();
    let middle = mean(&runs);
    let spread = runs.iter().map(|image| square(image, &middle)).sum::<f64>() / (RUNS - 1) as f64;
    let noise = singles.iter().map(|image| square(image, &truth)).sum::<f64>() / RUNS as f64;
    let error = runs.iter().map(|image| square(image, &truth)).sum::<f64>() / RUNS as f64;
    // The mean of a few runs has their variance over their number.
    let bias = (square(&middle, &truth) - spread / RUNS as f64).max(0.0);
    eprintln!(
        "one sample a pixel: error {noise:.2e} alone; {error:.2e} with {} earlier frames = variance {spread:.2e} + bias² {bias:.2e}",
        FRAMES - 1
    );
    assert!(error < 0.5 * noise && spread < 0.4 * noise, "{error:e} {spread:e} {noise:e}");
}

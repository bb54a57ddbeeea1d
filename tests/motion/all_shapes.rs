//! What moves, asked of every registered shape alike: it is hit where it is at each ray's time, at a moment it looks
//! like one at rest, and its picture is the mean of those of many moments.

use crate::scenes::{named, offer, one_world};
use bevy_ecs::prelude::*;
use glam::{DQuat, DVec3};
use pinhole::film::Film;
use pinhole::intersect::{Hits, Surfaces};
use pinhole::plan::{Census, Column};
use pinhole::rays::{RayTimes, WorldRays};
use pinhole::render::{inspect, prepare, render};
use pinhole::scene::*;
use pinhole::shapes::{SceneShape, with_shapes};
use pinhole_lab::measure::draws::Draws;
use pinhole_lab::measure::oracle::Oracle;
use pinhole_lab::measure::specimen::Specimen;

/// Calls a generic function for every registered shape.
macro_rules! for_each_shape {
    ($($kind:ident($shape:ty) $field:ident $plural:literal,)+) => {
        macro_rules! each {
            ($function:ident) => {
                $($function::<$shape>($plural);)+
            };
        }
    };
}
with_shapes!(for_each_shape);

const VELOCITY: DVec3 = DVec3::new(0.9, 0.5, -0.7);

/// One of the component's examples about this position, turned and scaled at random.
fn placed<S: Oracle>(index: usize, position: DVec3) -> (S::Component, Placement) {
    let (examples, mut draws) = (S::Component::examples(), Draws::new(2401, index as u64));
    let [x, y, z, w] = [(); 4].map(|()| draws.between(-1.0, 1.0));
    let scale = match S::NON_UNIFORM {
        Some(false) => DVec3::splat(draws.between(0.5, 1.2)),
        _ => DVec3::new(draws.between(0.5, 1.2), draws.between(0.4, 1.0), draws.between(0.5, 1.5)),
    };
    let placement = Placement { position, orientation: DQuat::from_xyzw(x, y, z, w).normalize(), scale };
    (examples[index % examples.len()].clone(), placement)
}

/// Each ray finds what it would find if the shape were at rest where it is at the ray's time.
fn check_times<S: Oracle>(name: &str) {
    let (mut rays, mut hits, mut worst) = (0, 0, 0.0_f64);
    for index in 0..10 {
        let (component, placement) = placed::<S>(index, DVec3::new(-0.4, -0.3, -3.0));
        let mut world = World::new();
        let sampling = Sampling { samples: 1, sampler: Sampler::Sobol, ..Sampling::default() };
        let shutter = Shutter { open: 0.25, close: 1.0 };
        world.spawn((PerspectiveCamera::default(), Resolution { width: 48, height: 48 }, sampling, shutter));
        world.spawn((component.clone(), placement, Matte::default(), Motion { velocity: VELOCITY }));
        world.spawn((DirectionalLight::default(), Placement::default()));
        let inspection = inspect(&world, &offer(), 48).expect("inspects");
        for &tile in &inspection.tiles {
            let tile = inspection.world.entity(tile);
            let times = tile.get::<RayTimes>().expect("times");
            let (rays_of_tile, found) = (tile.get::<WorldRays>().expect("rays"), tile.get::<Hits>().expect("hits"));
            let surfaces = tile.get::<Surfaces>().expect("surfaces");
            for row in 0..rays_of_tile.rows() {
                let position = placement.position + VELOCITY * (shutter.open + times.time[row]);
                let there =
                    Specimen::<S>::of(component.clone(), Placement { position, ..placement }).expect("is accepted");
                let still = there.hit(rays_of_tile.origin_of(row), rays_of_tile.direction_of(row));
                rays += 1;
                assert_eq!(found.t[row].is_finite(), still.is_some(), "{name}, row {row} of {index}");
                let Some(still) = still else { continue };
                let (at, moved) = (there.shape.surface(&there.surface_data, &still), surfaces.get(row));
                worst = worst.max((found.t[row] / still.t - 1.0).abs());
                let turned = (moved.normal.as_dvec3() - at.normal).length();
                let off = (moved.position.as_dvec3() - at.point).length();
                assert!(turned < 1e-4 && off < 1e-5 * still.t, "{name}, row {row} of {index}: {turned}, {off}");
                hits += 1;
            }
        }
    }
    eprintln!("movers that are {name}: {rays} rays, {hits} hits, worst {worst:.1e} of t");
    assert!(worst < 1e-7 && hits > 300, "{name}: {worst}, {hits} hits");
}

#[test]
fn every_shape_is_hit_where_it_is_at_its_time() {
    each!(check_times);
}

/// What a mover is made of.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Surface {
    Matte,
    Mirror,
    Glass,
    Emissive,
}

/// A mover above a floor in the sun, or in the dark if it emits light, below a sky of two colours.
fn above_a_floor<S: Oracle>(index: usize, surface: Surface, size: u32, sampling: Sampling) -> World {
    let mut world = World::new();
    let look = LookAt { eye: DVec3::new(0.5, 2.5, 6.0), target: DVec3::new(0.3, 0.0, 0.0), ..LookAt::default() };
    let camera = (Name::new("camera"), PerspectiveCamera { fov: Degrees(35.0), ..PerspectiveCamera::default() });
    world.spawn((camera, look, Resolution { width: size, height: size }, sampling));
    world.spawn((Name::new("floor"), Plane::default(), Placement::at(0.0, -1.5, 0.0), Matte::default()));
    let (component, placement) = placed::<S>(index, DVec3::new(-0.5, -0.2, 0.3));
    let thing = world.spawn((Name::new("thing"), component, placement)).id();
    let mut thing = world.entity_mut(thing);
    match surface {
        Surface::Matte => thing.insert(Matte::default()),
        Surface::Mirror => thing.insert(Mirror::default()),
        Surface::Glass => thing.insert(Glass { absorption: Rgb::grey(0.5), ..Glass::default() }),
        Surface::Emissive => thing.insert(Emissive { radiance: Rgb::grey(1.0), ..Emissive::default() }),
    };
    if surface != Surface::Emissive {
        let down = LookAt { eye: DVec3::new(1.0, 3.0, 1.0), target: DVec3::ZERO, ..LookAt::default() };
        world.spawn((DirectionalLight::default(), down));
        world.spawn(Gradient::default());
    }
    world
}

fn moving(mut world: World, open: f64, close: f64) -> World {
    let (camera, thing) = (named(&mut world, "camera"), named(&mut world, "thing"));
    world.entity_mut(camera).insert(Shutter { open, close });
    world.entity_mut(thing).insert(Motion { velocity: VELOCITY });
    world
}

fn rendered(world: &World) -> Film {
    render(world, &offer(), &one_world(), &()).expect("renders").film
}

fn stages(world: &World) -> Vec<&'static str> {
    let (plan, _) = prepare(&Census::of(world), &offer()).expect("prepares");
    // What a mover touches depends on where it is.
    plan.rows.iter().filter(|row| row.kept && !row.stage.ends_with("that touch")).map(|row| row.stage).collect()
}

/// Whether every triangle is given normals that lean.
fn with_normals(world: &mut World) -> bool {
    let thing = named(world, "thing");
    let Some(mut triangle) = world.get_mut::<Triangle>(thing) else { return false };
    let lean = [DVec3::new(0.3, 0.0, 1.0), DVec3::new(-0.2, 0.4, 1.0), DVec3::new(0.0, -0.5, 1.0)];
    triangle.normals = Some(lean);
    true
}

/// A shutter that is open for hardly any time shows what one shows that is open for none, of whatever the mover is made;
/// and a mover that stands still needs no stage more.
fn check_moments<S: Oracle>(name: &str) {
    const SIZE: u32 = 32;
    let sampling = Sampling { samples: 4, ..Sampling::default() };
    let (mut pictures, mut pixels, mut off, mut moved_on) = (0, 0, 0, 0);
    for surface in [Surface::Matte, Surface::Mirror, Surface::Glass] {
        for index in 0..5 {
            let scene = || {
                let mut world = above_a_floor::<S>(index, surface, SIZE, sampling);
                if index % 2 == 1 {
                    with_normals(&mut world);
                }
                world
            };
            // Glass needs an inside, and chapters know why.
            if prepare(&Census::of(&scene()), &offer()).is_err() {
                assert_eq!(surface, Surface::Glass, "{name}");
                continue;
            }
            let still = moving(scene(), 0.5, 0.5);
            let moment = moving(scene(), 0.5, 0.5 + 1e-10);
            assert_eq!(stages(&still), stages(&scene()), "{name} {surface:?}");
            assert!(stages(&moment).contains(&"Intersect moving shapes"));
            let [at_rest, at_opening] = [still, moving(scene(), 0.0, 0.0)].map(|world| rendered(&world));
            let moved = rendered(&moment);
            let apart = |a: &Film, b: &Film| {
                let each = (0..SIZE * SIZE).map(|at| (at % SIZE, at / SIZE));
                each.filter(|&(x, y)| (a.mean(x, y)[1] - b.mean(x, y)[1]).abs() > 1e-4).count()
            };
            off += apart(&at_rest, &moved);
            pixels += (SIZE * SIZE) as usize;
            pictures += 1;
            moved_on += apart(&at_rest, &at_opening);
        }
    }
    eprintln!(
        "movers that are {name}: {pictures} pictures of a moment, {off} of {pixels} pixels differ, {moved_on} from the opening"
    );
    assert!(pictures >= 10 && off * 2000 < pixels, "{name}: {off} of {pixels} pixels, {pictures} pictures");
    assert!(moved_on > 20 * pictures, "{name}: {moved_on} pixels have changed since the opening");
}

#[test]
fn at_a_moment_a_mover_looks_like_one_at_rest() {
    each!(check_moments);
}

/// The picture of a mover and its shadow, or its light, is the mean of those of many moments.
fn check_means<S: Oracle>(name: &str) {
    const SIZE: u32 = 6;
    const SEEDS: u32 = 8;
    const SAMPLES: u32 = 256;
    const MOMENTS: u32 = 64;
    for surface in [Surface::Matte, Surface::Emissive] {
        let scene = |seed: u32, samples: u32| {
            let sampling = Sampling { samples, seed: seed.into(), sampler: Sampler::Independent, filter: Filter::BOX };
            above_a_floor::<S>(0, surface, SIZE, sampling)
        };
        let pixels = |film: &Film| (0..SIZE * SIZE).map(|at| f64::from(film.mean(at % SIZE, at / SIZE)[1])).collect();
        let moved: Vec<Vec<f64>> =
            (0..SEEDS).map(|seed| pixels(&rendered(&moving(scene(seed, SAMPLES), 0.0, 1.0)))).collect();
        let still: Vec<Vec<f64>> = (0..MOMENTS)
            .map(|moment| {
                let time = (f64::from(moment) + 0.5) / f64::from(MOMENTS);
                pixels(&rendered(&moving(scene(100 + moment, SAMPLES * SEEDS / MOMENTS), time, time)))
            })
            .collect();
        let mean = |films: &[Vec<f64>], of: &dyn Fn(&[f64]) -> f64| {
            films.iter().map(|film| of(film)).sum::<f64>() / films.len() as f64
        };
        // As many samples of moments, evenly spaced, have no greater variance; where hardly any of a mover's samples
        // finds its light, which is at most 0.5, the variance is that of how many do.
        let deviations = |of: &dyn Fn(&[f64]) -> f64| {
            let (found, truth) = (mean(&moved, of), mean(&still, of));
            let spread = mean(&moved, &|film| (of(film) - found).powi(2)) / f64::from(SEEDS - 1);
            let min = if surface == Surface::Emissive { 0.5 * truth / f64::from(SEEDS * SAMPLES) } else { 0.0 };
            (found - truth) / (2.0 * spread.max(min) + 1e-12).sqrt()
        };
        let whole = deviations(&|film| film.iter().sum());
        let squares = (0..(SIZE * SIZE) as usize).map(|at| deviations(&|film| film[at]).powi(2)).sum::<f64>();
        let squares = squares / f64::from(SIZE * SIZE);
        eprintln!("{name}, {surface:?}: {MOMENTS} moments, {whole:+.2} SE of the whole, χ² a pixel {squares:.2}");
        assert!(whole.abs() < 5.0 && squares < 2.5, "{name}, {surface:?}: {whole} SE, χ² a pixel {squares}");
    }
}

#[test]
fn the_picture_of_a_mover_is_the_mean_of_moments() {
    each!(check_means);
}

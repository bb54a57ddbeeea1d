//! Shutter and motion, against closed forms: how much of a pixel something covers, on average over the time that the
//! shutter is open.

mod all_shapes;

use crate::scenes;

use bevy_ecs::prelude::*;
use glam::{DQuat, DVec3};
use pinhole::film::Film;
use pinhole::intersect::{Hits, Surfaces};
use pinhole::plan::{Census, Column, plan};
use pinhole::rays::{RayTimes, WorldRays};
use pinhole::render::{inspect, prepare, render};
use pinhole::scene::*;
use scenes::{Setup, film, named, offer, one_world, turned};
use std::f64::consts::PI;

/// What moves.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Mover {
    Ball,
    Coin,
    Mat,
}

/// A thing of radius or half width R at (x, y), of radiance 1, before parallel rays: 8 by 8 pixels of side 0.25 about the
/// origin, from −1 to 1.
fn before_parallel_rays(mover: Mover, at: [f64; 2], radius: f64, sampling: Sampling) -> World {
    let mut world = World::new();
    let camera = (Name::new("camera"), OrthographicCamera { view_height: 2.0 }, Placement::at(0.0, 0.0, 10.0));
    world.spawn((camera, Resolution { width: 8, height: 8 }, sampling));
    let facing = DQuat::from_rotation_x(PI / 2.0);
    let place = Placement { orientation: facing, ..Placement::at(at[0], at[1], 0.0) };
    let glow = Emissive { radiance: Rgb::grey(1.0), ..Emissive::default() };
    let thing = world.spawn((Name::new("thing"), place, glow)).id();
    let mut thing = world.entity_mut(thing);
    match mover {
        Mover::Ball => thing.insert(Sphere { radius }),
        Mover::Coin => thing.insert(Disk { radius }),
        Mover::Mat => thing.insert(Rectangle { width: 2.0 * radius, depth: 2.0 * radius }),
    };
    world
}

fn moving(mut world: World, name: &str, velocity: DVec3, open: f64, close: f64) -> World {
    let (camera, mover) = (named(&mut world, "camera"), named(&mut world, name));
    world.entity_mut(camera).insert(Shutter { open, close });
    world.entity_mut(mover).insert(Motion { velocity });
    world
}

fn sampled(samples: u32, sampler: Sampler) -> Sampling {
    Sampling { samples, seed: 5, sampler, filter: Filter::BOX }
}

fn rendered(world: &World) -> Film {
    render(world, &offer(), &one_world(), &()).expect("renders").film
}

/// ∫ of the chord 2 √(R² − y²) of a disk between two heights; of a square 2R each.
fn swept(mover: Mover, radius: f64, from: f64, to: f64) -> f64 {
    let (from, to) = (from.clamp(-radius, radius), to.clamp(-radius, radius));
    if mover == Mover::Mat {
        return 2.0 * radius * (to - from);
    }
    let below = |y: f64| y * (radius * radius - y * y).max(0.0).sqrt() + radius * radius * (y / radius).asin();
    below(to) - below(from)
}

/// Something that passes over the whole image while the shutter is open covers each point for the time that its chord takes:
/// the mean over a pixel is the area between its heights over |v| T and the pixel's height.
#[test]
fn coverage_of_what_passes_by() {
    const SAMPLES: u32 = 4096;
    let mut told = Vec::new();
    for mover in [Mover::Ball, Mover::Coin, Mover::Mat] {
        for (open, close) in [(0.0, 1.0), (-3.0, 5.0), (100.0, 100.25)] {
            // From left of the image to right of it.
            let (radius, length) = (0.6, 3.4);
            let velocity = DVec3::X * (length / (close - open));
            let start = -0.5 * length - velocity.x * open;
            for by_camera in [false, true] {
                let sampling = sampled(SAMPLES, Sampler::Independent);
                let still = before_parallel_rays(mover, [if by_camera { 0.0 } else { start }, 0.1], radius, sampling);
                let world = if by_camera {
                    // The camera goes the other way, from right to left, past what stands at the middle.
                    let mut world = moving(still, "camera", -velocity, open, close);
                    let camera = named(&mut world, "camera");
                    let at = Placement::at(0.5 * length + velocity.x * open, 0.0, 10.0);
                    world.entity_mut(camera).insert(at);
                    world
                } else {
                    moving(still, "thing", velocity, open, close)
                };
                let film = rendered(&world);
                let (mut worst, mut squared, mut pixels) = (0.0_f64, 0.0, 0);
                for line in 0..8 {
                    let top = 1.0 - 0.25 * f64::from(line) - 0.1;
                    let truth = swept(mover, radius, top - 0.25, top) / (length * 0.25);
                    for column in 0..8 {
                        let mean = f64::from(film.mean(column, line)[0]);
                        if truth == 0.0 {
                            assert_eq!(mean, 0.0, "{mover:?}: something at {column},{line}");
                            continue;
                        }
                        let error = (truth * (1.0 - truth) / f64::from(SAMPLES)).sqrt();
                        worst = worst.max(((mean - truth) / error).abs());
                        squared += ((mean - truth) / error).powi(2);
                        pixels += 1;
                    }
                }
                let of_whole: f64 =
                    (0..64).map(|pixel| f64::from(film.mean(pixel % 8, pixel / 8)[0])).sum::<f64>() / 64.0;
                let truth = swept(mover, radius, -1.1, 0.9) / (length * 2.0);
                let error = (truth * (1.0 - truth) / f64::from(SAMPLES * 64)).sqrt();
                assert!(error / truth < 0.01, "SE {} of the whole", error / truth);
                let off = (of_whole - truth) / error;
                // Of 64 normal numbers one lies beyond 4.5 in two thousand runs.
                assert!(
                    off.abs() < 4.0 && worst < 4.5,
                    "{mover:?}, by camera {by_camera}: {off} SE, worst pixel {worst}"
                );
                assert!(squared / f64::from(pixels) < 1.8, "χ² a pixel {}", squared / f64::from(pixels));
                told.push(format!(
                    "{mover:?} {open}..{close} camera {by_camera}: {off:+.2} SE of {:.2} %, worst of {pixels} pixels {worst:.2}",
                    100.0 * error / truth
                ));
            }
        }
    }
    eprintln!("coverage:\n  {}", told.join("\n  "));
}

/// Each ray hits a moving thing just where a ray hits it that stands where the thing is at the ray's time.
#[test]
fn each_ray_hits_it_where_it_is_at_its_time() {
    let (mut tried, mut hits, mut worst) = (0, 0, 0.0_f64);
    for mover in [Mover::Ball, Mover::Coin, Mover::Mat] {
        let velocity = DVec3::new(1.3, -0.7, 2.1);
        let world = before_parallel_rays(mover, [-0.5, 0.2], 0.7, sampled(1, Sampler::Sobol));
        let mut world = moving(world, "thing", velocity, 0.25, 1.0);
        // So that there is a surface.
        let thing = named(&mut world, "thing");
        world.entity_mut(thing).remove::<Emissive>().insert(Matte::default());
        world.spawn((PointLight::default(), Placement::at(0.0, 0.0, 5.0)));
        let inspection = inspect(&world, &offer(), 32).expect("inspects");
        for &tile in &inspection.tiles {
            let tile = inspection.world.entity(tile);
            let times = tile.get::<RayTimes>().expect("times");
            let (rays, found) = (tile.get::<WorldRays>().expect("rays"), tile.get::<Hits>().expect("hits"));
            let surfaces = tile.get::<Surfaces>().expect("surfaces");
            for row in 0..rays.rows() {
                assert!((0.0..0.75).contains(&times.time[row]));
                let time = 0.25 + times.time[row];
                let centre = DVec3::new(-0.5, 0.2, -10.0) + velocity * time;
                let (origin, direction) = (rays.origin_of(row), rays.direction_of(row));
                let expected = match mover {
                    Mover::Ball => pinhole::shapes::sphere_t(origin, direction, centre, 0.7),
                    _ => {
                        let t = (centre.z - origin.z) / direction.z;
                        let across = (origin + t * direction - centre).truncate();
                        let inside = match mover {
                            Mover::Coin => across.length() <= 0.7,
                            _ => across.abs().max_element() <= 0.7,
                        };
                        if inside { t } else { f64::INFINITY }
                    }
                };
                assert_eq!(found.t[row].is_finite(), expected.is_finite(), "{mover:?} row {row}");
                if expected.is_finite() {
                    worst = worst.max((found.t[row] - expected).abs() / expected);
                    let normal = match mover {
                        Mover::Ball => (origin + expected * direction - centre) / 0.7,
                        _ => DVec3::Z,
                    };
                    // At a silhouette t is known worse, and the normal with it.
                    let turned = (surfaces.get(row).normal.as_dvec3() - normal).length() * normal.z;
                    assert!(turned < 1e-5, "{mover:?} row {row}: a normal of {turned}, which is not {normal}");
                    hits += 1;
                }
                tried += 1;
            }
        }
    }
    assert!(worst < 1e-7 && hits > 30, "{worst}, {hits} hits");
    eprintln!("times: {tried} rays, {hits} hits, worst {worst:.1e} of t");
}

/// A shadow moves with what casts it: under a sun straight above, the shadow's coverage of the ground is the thing's own.
#[test]
fn shadows_are_of_the_same_moment() {
    const SAMPLES: u32 = 16384;
    let mut world = World::new();
    let camera = (Name::new("camera"), OrthographicCamera { view_height: 2.0 });
    // From below through nothing: the camera sees the ground from under the thing's height.
    let look = LookAt { eye: DVec3::new(0.0, 1.0, 0.0), target: DVec3::ZERO, up: DVec3::NEG_Z };
    world.spawn((camera, look, Resolution { width: 1, height: 1 }, sampled(SAMPLES, Sampler::Independent)));
    world.spawn((Name::new("ground"), Plane::default(), Matte { colour: Rgb::grey(1.0) }));
    let high = Placement::at(-1.8, 5.0, 0.2);
    world.spawn((Name::new("thing"), Disk { radius: 0.6 }, high, Matte { colour: Rgb::grey(0.5) }));
    let sun = DirectionalLight { irradiance: Rgb::grey(PI), casts_shadows: true };
    let down = LookAt { eye: DVec3::Y, target: DVec3::ZERO, up: DVec3::NEG_Z };
    world.spawn((Name::new("sun"), sun, down));
    let world = moving(world, "thing", DVec3::X * 3.6, 0.0, 1.0);
    let mean = f64::from(rendered(&world).mean(0, 0)[0]);
    // The disk passes over the whole pixel of side 2: each point is in shadow for its chord's time.
    let shadow = swept(Mover::Coin, 0.6, -1.2, 0.8) / (3.6 * 2.0);
    let error = (shadow * (1.0 - shadow) / f64::from(SAMPLES)).sqrt();
    let off = (1.0 - mean - shadow) / error;
    assert!(error < 0.01 * (1.0 - shadow) && off.abs() < 4.0, "{mean}, shadow {shadow}, {off} SE");
    eprintln!("shadows: {:.4} of the light missing, truth {shadow:.4}, {off:+.2} SE", 1.0 - mean);
}

/// What does not move costs nothing and changes no bit: no shutter, one that is open for no time, one before what stands.
#[test]
fn what_stands_still_is_left_alone() {
    let setup = Setup { size: [40, 24], ..Setup::default() };
    let expected = film(&turned(setup));
    let names = |world: &World| -> Vec<&'static str> {
        let (plan, _) = prepare(&Census::of(world), &offer()).expect("prepares");
        plan.rows.iter().filter(|row| row.kept).map(|row| row.stage).collect()
    };
    let stages = names(&turned(setup));
    let with = |bundle: (Shutter, Option<Motion>)| {
        let mut world = turned(setup);
        let (camera, ball) = (named(&mut world, "camera"), named(&mut world, "left ball"));
        world.entity_mut(camera).insert(bundle.0);
        if let Some(motion) = bundle.1 {
            world.entity_mut(ball).insert(motion);
        }
        world
    };
    let fast = Motion { velocity: DVec3::new(3.0, 1.0, -2.0) };
    let still = Motion { velocity: DVec3::ZERO };
    let shutter = Shutter { open: 0.0, close: 1.0 };
    let moment = Shutter { open: 0.0, close: 0.0 };
    for (shutter, motion) in [(shutter, None), (shutter, Some(still)), (moment, Some(fast))] {
        let world = with((shutter, motion));
        assert_eq!(names(&world), stages, "{shutter:?} {motion:?}");
        film(&world).assert_is(&expected, &format!("{shutter:?} {motion:?}"));
    }
    let told = plan(&Census::of(&with((moment, Some(fast)))), &offer()).expect("plans");
    let row = told.rows.iter().find(|row| row.stage == "Sample times").expect("on offer");
    assert!(!row.kept && row.reason.contains("the shutter is open for no time"), "{row:?}");
    // At another moment it is elsewhere, and still nothing is drawn at random.
    let later = with((Shutter { open: 0.1, close: 0.1 }, Some(fast)));
    assert_eq!(names(&later), stages);
    let mut there = turned(setup);
    let ball = named(&mut there, "left ball");
    there.entity_mut(ball).get_mut::<Placement>().expect("placed").position += fast.velocity * 0.1;
    film(&later).assert_is(&film(&there), "at the moment 0.1");
    assert!(film(&later) != expected);
    let moves = with((shutter, Some(fast)));
    assert!(names(&moves).contains(&"Sample times") && names(&moves).contains(&"Trace shadow rays: moving shapes"));
    assert!(film(&moves) != expected);
}

/// Parents take what hangs on them along; velocities are added along the world's axes.
#[test]
fn parents_take_their_children_along() {
    let sampling = sampled(64, Sampler::Sobol);
    let alone = before_parallel_rays(Mover::Ball, [-0.4, 0.2], 0.5, sampling);
    let alone = moving(alone, "thing", DVec3::new(0.5, -0.25, 0.125), 0.0, 1.0);
    let mut child = before_parallel_rays(Mover::Ball, [0.4, -0.2], 0.5, sampling);
    // Half a turn about z, which is exact: the child is placed the other way round, and moves as it would without.
    let orientation = DQuat::from_xyzw(0.0, 0.0, 1.0, 0.0);
    let group = (Placement { orientation, ..Placement::default() }, Motion { velocity: DVec3::new(0.25, 0.0, 0.125) });
    let group = child.spawn((Name::new("group"), group)).id();
    let child = {
        let thing = named(&mut child, "thing");
        child.entity_mut(thing).insert(ChildOf(group));
        moving(child, "thing", DVec3::new(0.25, -0.25, 0.0), 0.0, 1.0)
    };
    film(&child).assert_is(&film(&alone), "a child of a moving group");
}

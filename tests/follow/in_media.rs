//! Paths from the lights through participating media: closed forms, and agreement with paths from the camera alone.

use super::bidirectional::{agrees, glow, joined, room};
use super::caustics::{assert_same_bits_however_divided, camera, mean_of};
use super::*;
use glam::{DQuat, DVec3};
use pinhole::scene::*;
use std::f64::consts::{FRAC_PI_4, PI};

fn medium(absorption: [f64; 3], scattering: [f64; 3], anisotropy: f64) -> Medium {
    let [absorption, scattering] = [absorption, scattering].map(|[r, g, b]| Rgb::new(r, g, b));
    Medium { absorption, scattering, anisotropy, ..Medium::default() }
}

/// What is in the room, of every kind of place that a medium fills.
fn fill(world: &mut World, number: usize) {
    let (cuboid, at) = (Cuboid { size: DVec3::new(1.6, 1.0, 1.6) }, Placement::at(0.0, 1.0, 0.0));
    let smoke =
        || (Sphere { radius: 0.5 }, medium([0.3, 0.1, 0.5], [3.0, 4.0, 2.0], 0.6), Placement::at(0.1, 1.1, 0.3));
    match number {
        0 => _ = world.spawn(medium([0.02, 0.05, 0.01], [0.3, 0.2, 0.4], 0.0)),
        1 => _ = world.spawn(smoke()),
        2 => _ = world.spawn((cuboid, at, medium([0.1; 3], [1.0, 0.6, 0.8], -0.6))),
        3 => _ = world.spawn((cuboid, at, medium([1.0, 0.3, 0.1], [0.0; 3], 0.0))),
        4 => {
            let place = Placement::at(0.0, 0.9, 0.4);
            world.spawn((Sphere { radius: 0.4 }, Glass::default(), place, medium([0.0; 3], [4.0, 3.0, 2.0], 0.3)));
        }
        5 => {
            let frosted = RoughGlass { roughness: 0.5, ..RoughGlass::default() };
            let place = Placement::at(0.0, 0.9, 0.4);
            world.spawn((Sphere { radius: 0.4 }, frosted, place, medium([0.2; 3], [2.0, 3.0, 4.0], 0.0)));
        }
        6 => {
            world.spawn(smoke());
            world.spawn((cuboid, at, medium([0.05; 3], [0.5, 0.4, 0.7], 0.0)));
        }
        _ => {
            let grid = DensityGrid::of([5, 4, 3], |at| (1.0 + at.x) * (1.2 + at.y * at.z));
            world
                .spawn((Cuboid { size: DVec3::splat(2.0) }, Placement { scale: DVec3::splat(0.8), ..at }, grid))
                .insert(medium([0.1, 0.2, 0.1], [1.2, 0.8, 1.0], 0.4));
        }
    }
}

/// In how many ways the room is filled.
const FILLINGS: usize = 8;

fn shine(world: &mut World, number: usize) {
    let down = Placement { orientation: DQuat::from_xyzw(1.0, 0.0, 0.0, 0.0), ..Placement::at(0.0, 1.9, 0.0) };
    let look = LookAt { eye: DVec3::new(0.2, 1.8, 0.1), target: DVec3::new(-0.2, 0.3, 0.2), up: DVec3::Z };
    match number {
        0 => {
            _ = world.spawn((
                Rectangle { width: 0.6, depth: 0.6 },
                Emissive { sides: Sides::Front, ..glow(12.0) },
                down,
            ))
        }
        1 => _ = world.spawn((Sphere { radius: 0.2 }, glow(9.0), Placement::at(0.2, 1.3, 0.1))),
        2 => {
            let lamp = PointLight { intensity: Rgb::grey(1.0), casts_shadows: true };
            world.spawn((lamp, Placement::at(0.3, 1.6, 0.2)));
        }
        3 => _ = world.spawn((SpotLight { intensity: Rgb::grey(3.0), ..SpotLight::default() }, look)),
        _ => {
            let sun = DirectionalLight { irradiance: Rgb::grey(1.0), ..DirectionalLight::default() };
            world.spawn((sun, LookAt { eye: DVec3::new(0.2, 0.4, 2.0), target: DVec3::ZERO, up: DVec3::Y }));
        }
    }
}

/// Every place that a medium fills, under lights in turn: behind glass only those with an area, which paths from the camera
/// find as well, and so where a lamp stands in a medium whose density varies, since the light of a point has no finite variance
/// there for them.
#[test]
fn joined_paths_bring_what_paths_from_the_camera_bring() {
    let mut tried = 0;
    for filling in 0..FILLINGS {
        let lights: &[usize] = if [4, 5, 7].contains(&filling) { &[0, 1] } else { &[0, 1, 4, 2, 3] };
        let all = 0..if times_samples() > 1 { lights.len() } else { 2 };
        for light in all.map(|step| lights[(filling + step) % lights.len()]) {
            let make = || room(&|world| (fill(world, filling), shine(world, light)).0);
            agrees(&format!("filling {filling}, light {light}"), &make, [8, 2]);
            tried += 1;
        }
    }
    eprintln!("paths joined in media: {tried} scenes, 0 apart");
}

/// Caustics on surfaces and in media alike are left to light tracing, which finds the same light.
#[test]
fn light_tracing_brings_what_paths_from_the_camera_bring() {
    let mut tried = 0;
    for filling in 0..FILLINGS {
        let make = || {
            room(&|world| {
                fill(world, filling);
                shine(world, 1);
                world.spawn((Rectangle { width: 0.8, depth: 0.8 }, Mirror::default(), Placement::at(0.5, 0.02, -0.4)));
                world.spawn((Sphere { radius: 0.2 }, Glass::default(), Placement::at(-0.3, 0.9, 0.6)));
            })
        };
        let traced = || {
            let mut world = make();
            let camera = named(&mut world, "camera");
            world.entity_mut(camera).insert(LightTracing::default());
            world
        };
        let alone = renders(&make, LightStrategy::Mis, 8, 0..12);
        let both = renders(&traced, LightStrategy::Mis, 4, 12..24);
        assert_agree(&format!("caustics, filling {filling}"), &alone, &both, 8);
        tried += 1;
    }
    eprintln!("light tracing in media: {tried} scenes, 0 apart");
}

/// Inside a black ball that glows alike everywhere a medium that absorbs nothing is not seen, whatever it scatters: all
/// paths end on the wall.
#[test]
fn a_glowing_ball_is_as_bright_as_without_its_fog() {
    let even = |density: f64, anisotropy: f64| (medium([0.0; 3], [density; 3], anisotropy), false);
    let mut worst = 0.0_f64;
    for (number, (own, varies)) in
        (0..).zip([even(0.3, 0.0), even(1.0, 0.7), even(1.0, -0.7), even(3.0, 0.0), (even(2.0, 0.3).0, true)])
    {
        let make = || {
            let mut world = World::new();
            camera(&mut world, DVec3::new(0.2, 0.1, 0.0), DVec3::new(0.0, -1.0, 0.1), 1.0, true, 64);
            world.spawn((Sphere { radius: 1.0 }, glow(1.0), Matte { colour: Rgb::grey(0.0) }));
            let mut fog = world.spawn((Sphere { radius: 0.9 }, own));
            if varies {
                fog.insert(DensityGrid::of([3, 3, 3], |at| 1.1 + at.x + 0.5 * at.y));
            }
            world
        };
        let found = mean_of(&joined(&make), &offer(), 16 * times_samples(), 20 * number..20 * number + 12);
        let off = (found.mean - 1.0) / found.error.max(1e-6);
        eprintln!("{own:?}, varies {varies}: {:.5} ± {:.5} for 1: {off:+.1} SE", found.mean, found.error);
        assert!(off.abs() <= 4.0, "{own:?}");
        assert!(found.error <= 0.01, "{own:?}: a standard error above 1 %");
        worst = worst.max(off.abs());
    }
    eprintln!("glowing balls with fog: worst {worst:.1} standard errors");
}

/// Light of a sun that a mirror throws at a wall has crossed what hangs above, however far away, and what is between:
/// e^(−τ) of all three ways.
#[test]
fn light_from_outside_has_crossed_what_hangs_above() {
    let make = |above: Option<f64>, varies: bool, around: f64| {
        move || {
            let mut world = World::new();
            let turned = |axis: DVec3, angle: f64| DQuat::from_axis_angle(axis, angle);
            camera(&mut world, DVec3::new(-0.4, 0.0, 3.2), DVec3::X * 2.0, 0.4, false, 3);
            let mirror = Placement { orientation: turned(DVec3::Z, -FRAC_PI_4), ..Placement::default() };
            world.spawn((Rectangle { width: 2.0, depth: 2.0 }, mirror, Mirror { colour: Rgb::grey(0.8) }));
            let wall = Placement { orientation: turned(DVec3::Z, 2.0 * FRAC_PI_4), ..Placement::at(2.0, 0.0, 0.0) };
            world.spawn((Rectangle { width: 1.2, depth: 1.2 }, wall, Matte { colour: Rgb::grey(0.6) }));
            let down = LookAt { eye: DVec3::ZERO, target: DVec3::NEG_Y, up: DVec3::X };
            world.spawn((DirectionalLight { irradiance: Rgb::grey(2.0), casts_shadows: true }, down));
            let ink = |density: f64| medium([density; 3], [0.0; 3], 0.0);
            if around > 0.0 {
                let place = Placement::at(1.75, 0.0, 0.0);
                world.spawn((Cuboid { size: DVec3::new(1.5, 6.0, 6.0) }, place, ink(around)));
            }
            if let Some(above) = above {
                let size = DVec3::new(8.0, 0.7, 8.0);
                let mut cloud = world.spawn((Cuboid { size }, Placement::at(0.0, 50.0, 0.0), ink(above)));
                if varies {
                    let grid = DensityGrid::of([1, 2, 1], |at| 1.0 + 0.8 * at.y);
                    cloud.insert(DensityGrid { min: -0.5 * size, max: 0.5 * size, ..grid });
                }
            }
            world
        }
    };
    let bare = 0.6 / PI * 2.0 * 0.8;
    let mut tried = 0;
    for (number, (above, varies, around)) in
        (0..).zip([(None, false, 0.0), (None, false, 0.5), (Some(1.3), false, 0.5), (Some(1.3), true, 0.0)])
    {
        // Through what is around: from its near face at x = 1 to the wall, and from there at a slant.
        let depth = above.unwrap_or(0.0) * 0.7 + around * (1.0 + 1.0 / 0.6);
        let truth = bare * libm::exp(-depth);
        let make = make(above, varies, around);
        let from_both_ends = joined(&make);
        for make in [&make as &dyn Fn() -> World, &from_both_ends] {
            let found = mean_of(make, &offer(), 200, 20 * number..20 * number + 6);
            let off = (found.mean - truth) / found.error;
            let (mean, error) = (found.mean, found.error);
            eprintln!("{above:?}, {varies}, {around}: {mean:.5} ± {error:.5} for {truth:.5}: {off:+.1} SE");
            assert!(off.abs() <= 4.0 && error <= 0.01 * truth, "{above:?}, {around}");
            tried += 1;
        }
    }
    let endless = || {
        let mut world = make(None, false, 0.0)();
        world.spawn(medium([1e-3; 3], [0.0; 3], 0.0));
        world
    };
    assert_eq!(mean_of(&endless, &offer(), 4, 0..2).mean, 0.0, "nothing comes through endless ink");
    eprintln!("light from outside: {tried} closed forms, 0 apart");
}

/// No number is lost at either end of what is accepted, for a path that ends on its first event and for one that meets none.
#[test]
fn extremes_are_numbers() {
    let mut tried = 0;
    for density in [1e-8, 1e-3, 1.0, 1e3, 1e8, 1e30] {
        for anisotropy in [-0.999, 0.0, 0.999_999] {
            for albedo in [0.0, 0.5, 1.0 - 1e-9, 1.0] {
                let make = |is_joined: bool| {
                    let mut world = room(&|world| {
                        shine(world, 2);
                        world.spawn((Sphere { radius: 0.2 }, Glass::default(), Placement::at(-0.3, 0.9, 0.6)));
                        let own = medium([density * (1.0 - albedo); 3], [density * albedo; 3], anisotropy);
                        world.spawn((Cuboid { size: DVec3::splat(1.4) }, own, Placement::at(0.0, 1.0, 0.0)));
                    });
                    let camera = named(&mut world, "camera");
                    let mut camera = world.entity_mut(camera);
                    camera.insert((Resolution { width: 8, height: 8 }, Sampling { samples: 4, ..Sampling::default() }));
                    if is_joined {
                        camera.insert(BidirectionalPathTracing::default());
                    } else {
                        camera.insert(LightTracing::default());
                    }
                    world
                };
                for is_joined in [false, true] {
                    let film = render(&make(is_joined), &offer(), &Execution::default(), &()).expect("renders").film;
                    assert_eq!(
                        film.rejected().0,
                        0,
                        "{density:e}, {anisotropy}, {albedo}: samples that are no numbers"
                    );
                    let numbers = film.means().into_iter().flatten();
                    assert!({ numbers }.all(|part| (0.0..1e6).contains(&part)), "{density:e}, {anisotropy}, {albedo}");
                    tried += 1;
                }
            }
        }
    }
    eprintln!("light paths in media: {tried} extremes are numbers");
}

#[test]
fn light_paths_in_media_have_the_same_bits_however_they_are_traced() {
    let (mut tried, folder) = (0, tempfile::tempdir().expect("a folder"));
    for (filling, is_joined) in [(6, true), (7, true), (7, false)] {
        let mut scene = room(&|world| {
            fill(world, filling);
            shine(world, 2);
            world.spawn((Sphere { radius: 0.2 }, Glass::default(), Placement::at(-0.3, 0.9, 0.6)));
        });
        let camera = named(&mut scene, "camera");
        let mut camera = scene.entity_mut(camera);
        camera.insert(Sampling { samples: 4, seed: 39, ..Sampling::default() });
        if is_joined {
            camera.insert(BidirectionalPathTracing::default());
        } else {
            camera.insert(LightTracing::default());
        }
        tried += assert_same_bits_however_divided(&scene, 4, folder.path());
    }
    eprintln!("light paths in media: {tried} ways to trace 3 films, every bit the same");
}

//! The same bits everywhere: nothing about how a picture is made can change it, and neither can units or place.

use crate::scenes;

use bevy_ecs::prelude::*;
use bevy_ecs::schedule::{LogLevel, ScheduleBuildSettings};
use glam::DVec3;
use pinhole::extract::EllipsoidTable;
use pinhole::film::FilmTile;
use pinhole::plan::{Census, Stage, Table, TileSystems, plan};
use pinhole::render::{Execution, Hook, RenderWorld, Worlds, inspect, prepare};
use pinhole::scene::{
    Aperture, Filter, Integrator, Lens, Motion, Placement, PointLight, Sampling, Shutter, Statistics,
};
use pinhole_lab::measure::film_bits::digest;
use pinhole_lab::measure::sweep::{scale, shift};
use scenes::caustics::{caustics, traced};
use scenes::followed::{INTEGRATORS, followed};
use scenes::many::many_lights;
use scenes::material::{brushed, specular};
use scenes::{
    EYES, Eye, FilmBits, Setup, blurred, film, film_by, full, moving, named, offer, one_world, shapes_of_all_kinds,
    shining, stretched, textured, ties, turned,
};
use std::collections::BTreeSet;
use std::sync::Arc;

/// The pictures that must not change: both cameras, turned parents, exact ties, no light.
fn pictures() -> Vec<(&'static str, World)> {
    let mut unlit = turned(Setup::default());
    for lamp in ["lamp", "cellar lamp", "fill"] {
        let lamp = named(&mut unlit, lamp);
        unlit.entity_mut(lamp).remove::<PointLight>();
    }
    vec![
        ("perspective", turned(Setup::default())),
        ("orthographic", turned(Setup { eye: Eye::Orthographic, ..Setup::default() })),
        ("stretched", stretched(Setup::default())),
        ("shapes", shapes_of_all_kinds(Setup::default())),
        ("textured", textured(Setup::default())),
        ("shining", shining(Setup::default())),
        ("blurred", blurred(Setup::default())),
        ("specular", specular(Setup::default())),
        ("brushed", brushed_once()),
        ("moving", moving(Setup::default())),
        ("fisheye", scenes::fisheye(Setup::default())),
        ("all round", scenes::all_round(Setup::default())),
        ("paths", paths(Setup::default())),
        ("Whitted's rays", whitted(Setup::default())),
        ("the sky", sky(Setup::default())),
        ("many lights", sampled_once(many_lights(Setup::default()))),
        ("ties", ties()),
        ("unlit", unlit),
    ]
}

/// Brushed metal by one ray a pixel, as what is inspected has.
fn brushed_once() -> World {
    sampled_once(brushed(Setup::default()))
}

fn sampled_once(mut scene: World) -> World {
    let camera = named(&mut scene, "camera");
    scene.entity_mut(camera).remove::<Sampling>();
    scene
}

/// The textured scene by several samples a pixel, some of which count negatively.
fn sampled(setup: Setup) -> World {
    let mut scene = textured(setup);
    let camera = named(&mut scene, "camera");
    scene.entity_mut(camera).insert(Sampling { samples: 3, filter: Filter::MITCHELL, ..Sampling::default() });
    scene
}

/// What is moved exactly, through a lens and by several samples a pixel.
fn sharp_where_focused(setup: Setup) -> World {
    let mut scene = sampled(setup);
    if setup.eye == Eye::Perspective {
        let camera = named(&mut scene, "camera");
        scene.entity_mut(camera).insert(scenes::lens(setup.scale));
    }
    scene
}

/// What is moved exactly, with a ball in motion before a camera in motion.
fn full_in_motion(setup: Setup) -> World {
    let mut scene = full(setup);
    let (camera, ball) = (named(&mut scene, "camera"), named(&mut scene, "left ball"));
    scene.entity_mut(camera).insert((Shutter::default(), Motion { velocity: DVec3::new(0.25, 0.0, 0.5) }));
    scene.entity_mut(ball).insert(Motion { velocity: DVec3::new(0.5, -0.25, 0.0) });
    scene
}

/// Mirrors, glass, metal, lights with an area and an environment by paths.
fn paths(setup: Setup) -> World {
    followed(INTEGRATORS[6], setup)
}

/// The same by Whitted's rays.
fn whitted(setup: Setup) -> World {
    followed(Integrator::WHITTED, setup)
}

/// How much of the sky the same scene sees.
fn sky(setup: Setup) -> World {
    followed(INTEGRATORS[2], setup)
}

fn with_statistics(mut scene: World) -> World {
    let camera = named(&mut scene, "camera");
    scene.entity_mut(camera).insert(Statistics);
    scene
}

#[test]
fn pictures_show_something() {
    for (name, scene) in pictures() {
        let film = film(&scene);
        let min = match name {
            "ties" | "the sky" => 2,
            "unlit" => 5,
            _ => 500,
        };
        assert!(film.colours() >= min, "{name} has only {} colours", film.colours());
        assert_eq!(film.rejected, 0, "{name}");
    }
}

#[test]
fn ties_go_to_the_lowest_number() {
    let film = film(&ties());
    let red = film.pixels.iter().filter(|pixel| pixel[0] == 1.0_f64.to_bits()).count();
    assert_eq!(red, scenes::TIED_PIXELS / 2, "balls before the pane win, balls after it lose");
    eprintln!("ties: {} pixels at which a ball and the pane tie, {red} won by a ball", scenes::TIED_PIXELS);
}

#[test]
fn threads_tiles_and_worlds() {
    let mut tried = 0;
    for (name, scene) in pictures() {
        let expected = film(&scene);
        for tile_side in [8, 32, 64] {
            for threads in [1, 2, 4] {
                let execution = Execution { threads: Some(threads), tile_side, ..Execution::default() };
                let film = film_by(&scene, &offer(), &execution).expect("renders");
                film.assert_is(&expected, &format!("{name}, {threads} threads, tiles of {tile_side}"));
                tried += 1;
            }
            let execution = Execution { tile_side, ..one_world() };
            let film = film_by(&scene, &offer(), &execution).expect("renders");
            film.assert_is(&expected, &format!("{name}, one world, tiles of {tile_side}"));
            inspected(&scene, tile_side).assert_is(&expected, &format!("{name}, inspected, tiles of {tile_side}"));
            tried += 2;
        }
    }
    eprintln!("threads, tiles and worlds: {tried} renders of {} pictures, all equal", pictures().len());
}

fn inspected(scene: &World, tile_side: u32) -> FilmBits {
    let inspection = inspect(scene, &offer(), tile_side).expect("inspects");
    let tiles = inspection.tiles.iter().map(|&tile| inspection.world.get::<FilmTile>(tile).expect("a film"));
    FilmBits::of_tiles(inspection.image.width, inspection.image.height, tiles)
}

/// The names of the systems in the order in which they run.
fn order_of(scene: &World, offer: &[Stage]) -> Vec<String> {
    let (plan, tables) = prepare(&Census::of(scene), offer).expect("prepares");
    systems_of(&mut RenderWorld::new(&plan, &tables, 1, &[]))
}

/// The same of a world that is made; that its schedule leaves any order open is an error.
fn systems_of(frame: &mut RenderWorld) -> Vec<String> {
    frame.schedule.set_build_settings(ScheduleBuildSettings {
        ambiguity_detection: LogLevel::Error,
        hierarchy_detection: LogLevel::Error,
        ..ScheduleBuildSettings::default()
    });
    if let Err(error) = frame.schedule.initialize(&mut frame.world) {
        panic!("{}", error.to_string(frame.schedule.graph(), &frame.world));
    }
    let systems = frame.schedule.systems().expect("initialised");
    systems.map(|(_, system)| system.name().to_string()).collect()
}

/// How many orders the sets leave open: of n stages in a set that is free of order, n!.
fn orders_allowed(scene: &World) -> usize {
    let plan = plan(&Census::of(scene), &offer()).expect("plans");
    let free = TileSystems::ALL.iter().filter(|set| set.order_free());
    let stages = free.map(|set| plan.stages.iter().filter(|stage| stage.set == *set).count());
    stages.map(|count| (1..=count).product::<usize>()).product()
}

#[test]
fn every_order_that_is_allowed() {
    const SEEDS: u64 = 64;
    // Two stages stand the other way round in half of all orders, so that a pair does so in none of 16 once in 65,536 times,
    // and in none of 8 once in 256.
    const RENDERED: u64 = 16;
    for (name, scene) in pictures() {
        let expected = film(&scene);
        let timed = with_statistics(scene);
        let mut orders = BTreeSet::new();
        // Files are read again for every render, and every kind of stage has more orders than seeds.
        let textures = matches!(name, "textured" | "fisheye" | "all round");
        // Light that is followed leaves the same orders open at each bounce, and takes ten times as long.
        let followed = matches!(name, "specular" | "brushed" | "paths" | "Whitted's rays");
        let seeds = if textures { 8 } else { SEEDS >> (2 * u32::from(followed)) };
        let rendered = (RENDERED * seeds / SEEDS).max(8);
        for seed in 0..rendered {
            let film = film_by(&timed, &permuted(offer(), seed), &one_world()).expect("renders");
            film.assert_is(&expected, &format!("{name} with statistics, offered in order {seed}"));
        }
        let mut scene = timed;
        let camera = named(&mut scene, "camera");
        scene.entity_mut(camera).remove::<Statistics>();
        for seed in 0..seeds {
            let offer = permuted(offer(), seed);
            for worlds in [Worlds::One, Worlds::PerWorker].into_iter().filter(|_| seed < rendered) {
                let execution = Execution { worlds, threads: Some(2), ..Execution::default() };
                let film = film_by(&scene, &offer, &execution).expect("renders");
                film.assert_is(&expected, &format!("{name}, offered in order {seed}, {worlds:?}"));
            }
            orders.insert(order_of(&scene, &offer));
        }
        let allowed = orders_allowed(&scene);
        if textures {
            assert!(orders.len() > 6, "{name}: only {} orders", orders.len());
        } else if allowed < 20 {
            assert_eq!(orders.len(), allowed, "{name}: not every order that is allowed was seen in {seeds} seeds");
        } else {
            let enough = allowed.min(seeds as usize) / 2..=allowed;
            assert!(enough.contains(&orders.len()), "{name}: {} of {allowed} orders were seen", orders.len());
        }
        eprintln!("orders of {name}: {} of {seeds} seeds, 3 renders of each of {rendered}, all equal", orders.len());
    }
}

/// Recorders and clocks follow each stage one after the other, never in a random order.
#[test]
fn hooks_are_ordered() {
    let scene = with_statistics(turned(Setup::default()));
    let (plan, tables) = prepare(&Census::of(&scene), &offer()).expect("prepares");
    let hook: Hook = Arc::new(|_, _, _| (|_: &mut World| {}).into_configs());
    let systems = systems_of(&mut RenderWorld::new(&plan, &tables, 1, &[hook.clone(), hook]));
    assert_eq!(systems.len(), plan.stages.len() * 4, "a stage, a clock and two hooks");
}

/// A permutation that depends on nothing but the seed (splitmix64 as the key to sort by).
fn permuted(stages: Vec<Stage>, seed: u64) -> Vec<Stage> {
    let key = |position: u64| {
        let mut z = (seed << 32 | position).wrapping_add(1).wrapping_mul(0x9E37_79B9_7F4A_7C15);
        z = (z ^ z >> 30).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        (z ^ z >> 27).wrapping_mul(0x94D0_49BB_1331_11EB)
    };
    let mut keyed: Vec<(u64, Stage)> = (0..).zip(stages).map(|(position, stage)| (key(position), stage)).collect();
    keyed.sort_by_key(|(key, _)| *key);
    keyed.into_iter().map(|(_, stage)| stage).collect()
}

#[test]
fn statistics_change_nothing() {
    let mut tried = 0;
    for (name, scene) in pictures() {
        let expected = film(&scene);
        let timed = with_statistics(scene);
        for worlds in [Worlds::One, Worlds::PerWorker] {
            let execution = Execution { worlds, threads: Some(2), ..Execution::default() };
            let film = film_by(&timed, &offer(), &execution).expect("renders");
            film.assert_is(&expected, &format!("{name}, {worlds:?}, with statistics"));
            tried += 1;
        }
    }
    eprintln!("statistics: {tried} renders, all equal");
}

#[test]
fn scale_by_powers_of_two() {
    const LARGEST: i32 = 20;
    let every: Vec<i32> = (-LARGEST..=LARGEST).collect();
    let some = [-LARGEST, -11, -2, -1, 1, 5, LARGEST];
    let straight: [fn(Setup) -> World; 9] =
        [full, turned, stretched, shapes_of_all_kinds, textured, shining, sampled, blurred, moving];
    let followed: [fn(Setup) -> World; 5] = [paths, whitted, sky, specular, brushed];
    let scenes = straight.map(|scene| (scene, &every[..])).into_iter().chain(followed.map(|scene| (scene, &some[..])));
    let scenes: Vec<_> = scenes.collect();
    for eye in EYES {
        for &(scene, powers) in &scenes {
            let setup = Setup { eye, size: [48, 33], ..Setup::default() };
            let expected = film(&scene(setup));
            for &k in powers {
                let mut scaled = scene(setup);
                scale(&mut scaled, k);
                let film = film(&scaled);
                film.assert_is(&expected, &format!("{eye:?}, scaled by 2^{k}"));
            }
        }
    }
    eprintln!(
        "scale: 2^k for every k from −{LARGEST} to {LARGEST}, 2 cameras, 9 scenes; for {some:?}, 5 more; all equal"
    );
}

/// Rays from lamps know no unit either, by a lens or without.
#[test]
fn light_from_area_lights_scales_by_powers_of_two() {
    for (lamps, lens) in [(true, false), (false, false), (true, true)] {
        let scene = || {
            let mut world = traced(|| caustics(lamps))();
            let camera = named(&mut world, "camera");
            if lens {
                let aperture = Aperture::Radius { radius: 0.25 };
                world.entity_mut(camera).insert(Lens { aperture, focus_distance: 3.5, ..Lens::default() });
            }
            world
        };
        let expected = film(&scene());
        for k in [-20, -3, 1, 20] {
            let mut scaled = scene();
            scale(&mut scaled, k);
            film(&scaled).assert_is(&expected, &format!("lamps {lamps}, lens {lens}, scaled by 2^{k}"));
        }
    }
    let expected = film(&many_lights(Setup::default()));
    for k in [-20, -3, 1, 20] {
        let mut scaled = many_lights(Setup::default());
        scale(&mut scaled, k);
        film(&scaled).assert_is(&expected, &format!("many lights, scaled by 2^{k}"));
    }
    eprintln!("scale of light from lamps: 4 scenes, 4 powers of two, all equal");
}

#[test]
fn moved_by_two_to_the_twentieth() {
    let (far, fine) = (f64::from(1 << 20), 1.0 / f64::from(1_u32 << 31) / 2.0);
    let mut tried = 0;
    for eye in EYES {
        // Off the coarse grid of the scene itself by one step of the finest one that must hold.
        let setup = Setup { eye, size: [48, 33], shift: DVec3::new(fine, -fine, 5.0 * fine), ..Setup::default() };
        for scene in [
            full,
            stretched,
            shapes_of_all_kinds,
            textured,
            shining,
            sampled,
            sharp_where_focused,
            full_in_motion,
            paths,
            whitted,
            sky,
            specular,
            brushed,
        ] {
            let expected = film(&scene(setup));
            for axes in 1..8_u32 {
                for sign in [far, -far] {
                    let by = DVec3::from([0, 1, 2].map(|axis| if axes >> axis & 1 == 1 { sign } else { 0.0 }));
                    let mut moved = scene(setup);
                    shift(&mut moved, by);
                    let film = film(&moved);
                    film.assert_is(&expected, &format!("{eye:?}, moved by {by}"));
                    tried += 1;
                }
            }
        }
    }
    eprintln!("moved: {tried} scenes by ±2^20 along one, two and three axes, all equal");
}

#[test]
fn odd_sizes() {
    let sizes = [[1, 1], [1, 7], [7, 1], [33, 65], [97, 31], [64, 64], [65, 1]];
    for eye in EYES {
        for size in sizes {
            let scene = turned(Setup { eye, size, ..Setup::default() });
            let expected = film(&scene);
            assert_eq!(expected.pixels.len(), (size[0] * size[1]) as usize);
            assert!(expected.pixels.iter().all(|pixel| pixel[3] == 1), "every pixel of {size:?} has one sample");
            for tile_side in [8, 32, 64] {
                let execution = Execution { threads: Some(2), tile_side, ..Execution::default() };
                let film = film_by(&scene, &offer(), &execution).expect("renders");
                film.assert_is(&expected, &format!("{eye:?}, {size:?} in tiles of {tile_side}"));
            }
        }
    }
    eprintln!("sizes: {sizes:?}, 2 cameras, 3 tile sides, all equal");
}

/// The digests kept here hold for every profile and every machine; CI runs this test under several.
#[test]
fn digests() {
    let mut lines = Vec::new();
    for (name, scene) in pictures() {
        lines.push(format!("{name:<14}{:016x}", film(&scene).digest()));
    }
    let mut columns = 0;
    for eye in EYES {
        let inspection = inspect(&turned(Setup { eye, ..Setup::default() }), &offer(), 32).expect("inspects");
        for column in &inspection.plan.columns {
            let mut bits = Vec::new();
            for &tile in &inspection.tiles {
                for component in (column.components)(&inspection.world.entity(tile)) {
                    bits.extend(
                        (0..(column.rows)(&inspection.world.entity(tile))).map(|row| component.values.bits(row)),
                    );
                }
            }
            let rows = bits.len();
            lines.push(format!("{eye:?} {:<12}{rows:>7} numbers {:016x}", column.name, digest(bits.into_iter())));
            columns += 1;
        }
    }
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path("snapshots");
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.bind(|| insta::assert_snapshot!("digests", lines.join("\n")));
    eprintln!("digests: {} films and every bit of {columns} columns", lines.len() - columns);
}

/// A scale that is even up to 1e-9 keeps a sphere a sphere; beyond, it is an ellipsoid, and the picture does not jump.
#[test]
fn nearly_even_scales() {
    let scene = |by: f64| {
        let mut scene = full(Setup { size: [48, 33], ..Setup::default() });
        for name in ["left ball", "middle ball"] {
            let ball = named(&mut scene, name);
            let mut placement = scene.get_mut::<Placement>(ball).expect("a placement");
            placement.scale.z = 1.0 + by;
        }
        scene
    };
    let ellipsoids = |scene: &World| EllipsoidTable::extract(&Census::of(scene)).expect("extracts").shape.len();
    let even = film(&scene(0.0));
    for (by, non_uniform) in [(1e-12, 0), (9e-10, 0), (1.1e-9, 2), (1e-8, 2)] {
        let scene = scene(by);
        assert_eq!(ellipsoids(&scene), non_uniform, "1 + {by:e}");
        let film = film(&scene);
        if non_uniform == 0 {
            film.assert_is(&even, &format!("scaled by 1 + {by:e} along z"));
        }
        let parts = |film: &FilmBits| film.pixels.iter().flat_map(|p| [p[0], p[1], p[2]]).map(f64::from_bits).collect();
        let (own, other): (Vec<f64>, Vec<f64>) = (parts(&film), parts(&even));
        let off = own.iter().zip(&other).map(|(a, b)| (a - b).abs() / b.max(0.01)).fold(0.0, f64::max);
        eprintln!(
            "scaled by 1 + {by:e} along z: {non_uniform} ellipsoids, pixels off by {off:.1e} of themselves at most"
        );
        // A few rounding steps of f32, for the numbers that a pixel is made of.
        assert!(off <= 1e-6, "1 + {by:e}: a pixel is off by {off:e} of itself");
    }
}

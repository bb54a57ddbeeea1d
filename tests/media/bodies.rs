//! Bodies of media: alone, in glass, overlapping, around the camera and around a lamp.

use super::*;
use crate::scenes::FilmBits;

/// A camera that sees a body about the origin, in a sky of radiance 1.
fn in_white(samples: u32, eye: DVec3) -> World {
    let mut world = World::new();
    let look = LookAt { eye, target: DVec3::ZERO, ..LookAt::default() };
    let size = Resolution { width: SIDE, height: SIDE };
    let camera = PerspectiveCamera { fov: Degrees(30.0), ..PerspectiveCamera::default() };
    let sampling = Sampling { samples, ..Sampling::default() };
    world.spawn((Name::new("camera"), camera, look, size, sampling, Integrator::PATH));
    world.spawn((Name::new("sky"), Background { colour: Rgb::grey(1.0) }));
    world
}

fn fog(scattering: [f64; 3], anisotropy: f64) -> Medium {
    Medium { scattering: rgb(scattering), anisotropy, ..Medium::default() }
}

/// What absorbs nothing is invisible in an even sky, whatever its shape and its depth.
#[test]
fn a_body_of_albedo_one_is_invisible_in_an_even_sky() {
    let (mut tried, mut worst) = (0, 0.0_f64);
    for g in [-0.9, 0.0, 0.9] {
        for depth in [0.1, 1.0, 5.0, 50.0] {
            for colours in [[1.0; 3], [1.0, 0.6, 0.3]] {
                let scattering = colours.map(|part| 0.5 * depth * part);
                // Where colours differ, a path brings between nothing and all of the three.
                let samples = if colours == [1.0; 3] { 8 } else { 512 };
                let mut shapes = in_white(samples, DVec3::new(0.4, 1.0, 4.0));
                match tried % 4 {
                    0 => shapes.spawn((Sphere::default(), fog(scattering, g))),
                    1 => shapes.spawn((Cuboid { size: DVec3::ONE }, fog(scattering, g))),
                    2 => shapes.spawn((Torus::default(), fog(scattering, g))),
                    _ => shapes.spawn((Cylinder::default(), fog(scattering, g))),
                };
                let measured = Measured::of(&shapes);
                let what = format!("g {g}, depth {depth}, {colours:?}, shape {}", tried % 4);
                worst = worst.max(measured.check(&what, [1.0; 3], 3e-3));
                tried += 1;
            }
        }
    }
    eprintln!("white furnace: {tried} bodies, worst {worst:.1} standard errors");
}

/// The same inside glass, from inside the body, on a floor, and for what moves while the shutter is open.
#[test]
fn what_absorbs_nothing_is_invisible_in_glass_and_around_the_camera() {
    let mut told = Vec::new();
    let mut check = |what: &str, world: &World, truth: f64| {
        let worst = Measured::of(world).check(what, [truth; 3], 3e-3);
        told.push(format!("{what}: {worst:.1}"));
    };
    let mut world = in_white(1024, DVec3::new(0.4, 1.0, 4.0));
    world.spawn((Sphere::default(), Glass::default(), fog([2.0, 1.0, 0.5], 0.5)));
    check("milky glass", &world, 1.0);
    let mut world = in_white(1024, DVec3::new(0.4, 1.0, 4.0));
    world.spawn((Sphere::default(), Glass::default()));
    world.spawn((Sphere { radius: 0.6 }, fog([2.0, 1.0, 0.5], 0.5)));
    check("a cloud in glass", &world, 1.0);
    let mut world = in_white(1024, DVec3::new(0.2, 0.1, 0.3));
    world.spawn((Sphere::default(), fog([2.0, 1.0, 0.5], -0.5)));
    check("the camera inside", &world, 1.0);
    let mut world = in_white(1024, DVec3::new(0.2, 0.1, 0.3));
    world.spawn((Sphere::default(), Glass::default(), fog([2.0, 1.0, 0.5], 0.8)));
    // Radiance in glass of index n is n² of what it is outside.
    check("the camera inside milky glass", &world, 2.25);
    let mut world = in_white(1024, DVec3::new(0.4, 1.0, 4.0));
    world.spawn((Plane::default(), Placement::at(0.0, -0.5, 0.0), Matte { colour: Rgb::grey(1.0) }));
    let room = Placement::at(0.0, 0.5, 0.0);
    world.spawn((Cuboid { size: DVec3::new(2.0, 2.0, 2.0) }, room, fog([2.0, 1.0, 0.5], 0.5)));
    check("on a white floor", &world, 1.0);
    let mut world = in_white(1024, DVec3::new(0.4, 1.0, 4.0));
    let camera = named(&mut world, "camera");
    world.entity_mut(camera).insert(Shutter { open: 0.0, close: 1.0 });
    world.spawn((Sphere { radius: 0.5 }, fog([2.0, 1.0, 0.5], 0.5), Motion { velocity: DVec3::X }));
    check("moving", &world, 1.0);
    eprintln!("albedo 1 in an even sky, in standard errors: {}", told.join(", "));
}

/// A medium that only absorbs, so that what is seen follows from how far a ray runs in it.
fn dye(absorption: f64) -> Medium {
    Medium { absorption: rgb([absorption, 0.5 * absorption, 0.0]), scattering: Rgb::BLACK, ..Medium::default() }
}

#[test]
fn absorbing_bodies_follow_beer_s_law() {
    let along = |far: f64| -> World {
        let mut world = World::new();
        one_ray(&mut world, DVec3::new(0.0, 0.0, far), -DVec3::Z, 1, 8);
        world.spawn(Background { colour: Rgb::grey(1.0) });
        world
    };
    let beer = |length: f64, absorption: f64| transmittance([absorption * length, 0.5 * absorption * length, 0.0]);
    let mut tried = 0;
    let mut check = |what: &str, world: &World, truth: [f64; 3]| {
        Measured::of(world).check(what, truth, 1e-6);
        tried += 1;
    };
    let mut world = along(5.0);
    world.spawn((Sphere::default(), dye(0.7)));
    check("through a ball", &world, beer(2.0, 0.7));
    let mut world = along(0.25);
    world.spawn((Sphere::default(), dye(0.7)));
    check("from inside", &world, beer(1.25, 0.7));
    let mut world = along(5.0);
    world.spawn((Sphere::default(), dye(0.3)));
    world.spawn((Sphere::default(), dye(0.4)));
    check("two in one place add up", &world, beer(2.0, 0.7));
    let mut world = along(5.0);
    let first = world.spawn((Name::new("cloud"), Sphere::default(), dye(0.7))).id();
    world.spawn((Sphere::default(), UsesMaterial(first), Placement::at(0.0, 0.0, 1.0)));
    check("two of one medium that overlap", &world, beer(4.0, 0.7));
    let mut world = along(5.0);
    world.spawn((Torus { radius: 2.0, tube: 0.5 }, dye(0.7)));
    check("twice through a ring", &world, beer(2.0, 0.7));
    let mut world = along(5.0);
    world.spawn((Plane { normal: DVec3::Z }, dye(0.7)));
    check("a half-space without an end", &world, [0.0, 0.0, 1.0]);
    let mut world = along(5.0);
    world.spawn((Plane { normal: DVec3::Z }, Placement::at(0.0, 0.0, 4.0), dye(0.7)));
    world.spawn((Sphere::default(), Emissive { radiance: Rgb::grey(1.0), ..Emissive::default() }));
    check("a lamp inside", &world, beer(3.0, 0.7));
    let mut world = along(5.0);
    world.spawn((Sphere::default(), Glass { ior: 1.0, absorption: Rgb::grey(0.2), ..Glass::default() }, dye(0.7)));
    let both = beer(2.0, 0.7).map(|part| part * (-0.4_f64).exp());
    check("glass that absorbs as well", &world, both);
    let mut world = along(5.0);
    let camera = named(&mut world, "camera");
    world.entity_mut(camera).insert(dye(0.7));
    world.spawn((Sphere::default(), Glass { ior: 1.0, ..Glass::default() }));
    let lamp = Emissive { radiance: Rgb::grey(1.0), ..Emissive::default() };
    world.spawn((Cuboid { size: DVec3::ONE }, Placement::at(0.0, 0.0, -5.5), lamp));
    check("everywhere but in glass", &world, beer(8.0, 0.7));
    eprintln!("absorbing bodies: {tried}, each to rounding");
}

/// Light shafts through a window with slats: the picture does not depend on how its work is divided, and in a shaft the fog
/// is brighter than in the shadow of a slat.
#[test]
fn shafts_of_light_are_the_same_however_they_are_computed() {
    let file = SceneFile::open(std::path::Path::new("tests/media/shafts.ron")).expect("a scene file");
    let mut world = file.world();
    let camera = named(&mut world, "camera");
    let (resolution, sampling) =
        (Resolution { width: 96, height: 64 }, Sampling { samples: 64, ..Sampling::default() });
    world.entity_mut(camera).insert((resolution, sampling));
    let film = |execution: Execution| render(&world, &offer(), &execution, &()).expect("renders").film;
    let whole = film(Execution::default());
    let bits = FilmBits::of(&whole);
    for (threads, tile_side) in [(1, 32), (3, 8), (2, 16)] {
        let other = film(Execution { threads: Some(threads), tile_side, ..Execution::default() });
        assert!(FilmBits::of(&other) == bits, "{threads} threads, tiles of {tile_side}");
    }
    // Around a place in the second shaft, and in the shadow below it.
    let around = |x: u32, y: u32| {
        let all = (x - 2..=x + 2).flat_map(|x| (y - 1..=y + 1).map(move |y| (x, y)));
        all.map(|(x, y)| f64::from(whole.mean(x, y)[1])).sum::<f64>() / 15.0
    };
    let (lit, dark) = (around(22, 23), around(80, 10));
    eprintln!("shafts of light: {lit:.3} in one, {dark:.3} in the dark of the room");
    assert!(lit > 2.0 * dark, "{lit} {dark}");
}

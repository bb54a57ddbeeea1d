//! Surfaces that are not there everywhere: closed forms of what goes through, for every kind of shape and of light, and
//! masks beside the shapes that they leave.

use super::*;
use glam::{DQuat, DVec3};
use pinhole::film::{Film, write_exr};
use pinhole::models::TriangleMesh;
use pinhole::scene::{
    Cone, Cuboid, Cylinder, Disk, Emissive, LookAt, Matte, MeshGeometry, MeshInstance, Mirror, Opacity, OpacityChannel,
    OpacityMap, OrthographicCamera, PerspectiveCamera, Placement, Plane, PointLight, Rasterisation, Rectangle,
    SingleSided, Sphere, Torus, Triangle,
};
use scenes::film;

const OPACITY: f64 = 0.3;

/// A camera that sees a small square about a point from a direction and a distance.
fn seen(world: &mut World, at: DVec3, from: DVec3, distance: f64, view_height: f64) {
    let look = LookAt { eye: at + distance * from.normalize(), target: at, ..LookAt::default() };
    let size = Resolution { width: 16, height: 16 };
    world.spawn((Name::new("camera"), OrthographicCamera { view_height }, look, size, Integrator::RayCasting));
}

fn square_mesh() -> MeshInstance {
    let mesh = TriangleMesh {
        positions: vec![[-1.0, 0.0, -1.0], [-1.0, 0.0, 1.0], [1.0, 0.0, 1.0], [1.0, 0.0, -1.0]],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        uvs: Some(vec![[0.0, 0.0], [0.0, 1.0], [1.0, 1.0], [1.0, 0.0]]),
        ..TriangleMesh::default()
    };
    MeshInstance { geometry: MeshGeometry::new(mesh) }
}

type Spawn = fn(&mut World) -> Entity;

/// A shape of every kind, a point and a direction in which a line through it crosses the surface, and how often.
fn crossed() -> Vec<(&'static str, Spawn, [f64; 3], [f64; 3], i32)> {
    let ellipsoid: Spawn = |world| {
        let scale = DVec3::new(1.0, 0.5, 1.5);
        world.spawn((Sphere::default(), Placement { scale, ..Placement::default() })).id()
    };
    let triangle: Spawn = |world| {
        let vertices = [DVec3::new(-1.0, 0.0, -1.0), DVec3::new(0.0, 0.0, 2.0), DVec3::new(1.0, 0.0, -1.0)];
        world.spawn(Triangle { vertices, ..Triangle::default() }).id()
    };
    vec![
        ("sphere", |world| world.spawn(Sphere::default()).id(), [0.1, 0.1, 0.0], [0.3, 1.0, 0.2], 2),
        ("ellipsoid", ellipsoid, [0.1, 0.1, 0.0], [0.3, 1.0, 0.2], 2),
        ("plane", |world| world.spawn(Plane::default()).id(), [0.1, 0.0, 0.3], [0.3, 1.0, 0.2], 1),
        ("disk", |world| world.spawn(Disk::default()).id(), [0.1, 0.0, 0.3], [0.3, -1.0, 0.2], 1),
        ("rectangle", |world| world.spawn(Rectangle::default()).id(), [0.1, 0.0, 0.3], [0.9, 0.1, 0.2], 1),
        ("cuboid", |world| world.spawn(Cuboid::default()).id(), [0.1, 0.0, 0.3], [0.3, 1.0, 0.2], 2),
        ("cylinder", |world| world.spawn(Cylinder::default()).id(), [0.1, 0.0, 0.1], [1.0, 0.1, 0.2], 2),
        ("cone", |world| world.spawn(Cone::default()).id(), [0.1, -0.3, 0.1], [1.0, 0.1, 0.2], 2),
        ("torus", |world| world.spawn(Torus::default()).id(), [0.0, 0.0, 0.0], [1.0, 0.01, 0.2], 4),
        ("triangle", triangle, [0.1, 0.0, 0.1], [0.3, 1.0, 0.2], 1),
        ("mesh", |world| world.spawn(square_mesh()).id(), [0.1, 0.0, 0.3], [0.3, 1.0, 0.2], 1),
    ]
}

/// A fraction of the rays that is known, to which many independent decisions must add up.
fn assert_fraction(what: &str, world: &mut World, of: f64, expected: f64, samples: u32) -> f64 {
    let camera = named(world, "camera");
    let sampling = Sampling { samples, sampler: Sampler::Independent, ..Sampling::default() };
    world.entity_mut(camera).insert(sampling);
    let pixels = numbers(&render(world, &offer(), &Execution::default(), &()).expect("renders").film).pixels;
    let count = (pixels.len() as u32 * samples) as f64;
    let mean = pixels.iter().map(|pixel| pixel[0]).sum::<f64>() / pixels.len() as f64 / of;
    let off = (mean - expected) / (expected * (1.0 - expected) / count).sqrt();
    assert!(off.abs() < 4.0, "{what}: {mean} for {expected}, {off:+.1} standard errors");
    off
}

#[test]
fn every_shape_lets_through_what_its_opacity_leaves() {
    let (mut tried, mut worst) = (0, 0.0_f64);
    for (name, spawn, at, from, crossings) in crossed() {
        let gone = (1.0 - OPACITY).powi(crossings);
        let black = (Matte { colour: Rgb::grey(0.0) }, Opacity { opacity: OPACITY, ..Opacity::default() });

        // The eye sees a white sky through it.
        let mut world = World::new();
        seen(&mut world, at.into(), from.into(), 8.0, 0.01);
        world.spawn(Background { colour: Rgb::grey(1.0) });
        let shape = spawn(&mut world);
        world.entity_mut(shape).insert(black);
        let seen_through = assert_fraction(name, &mut world, 1.0, gone, 64);

        // A light shines through it, from both sides in turn, onto a ball whose pole has a known irradiance.
        let mut lit = [0.0; 2];
        for (off, side) in lit.iter_mut().zip([1.0, -1.0]) {
            let (at, towards) = (DVec3::from(at), side * DVec3::from(from).normalize());
            let mut world = World::new();
            // The eye is nearer to the ball than the shape is.
            seen(&mut world, at - 6.0 * towards, towards + 0.2 * towards.any_orthonormal_vector(), 2.0, 1e-4);
            let ball = Placement::at((at - 7.0 * towards).x, (at - 7.0 * towards).y, (at - 7.0 * towards).z);
            world.spawn((Sphere { radius: 1.0 }, ball, Matte { colour: Rgb::grey(1.0) }));
            let lamp = at + 5.0 * towards;
            world.spawn((PointLight::default(), Placement::at(lamp.x, lamp.y, lamp.z)));
            let unhidden = 1.0 / (121.0 * std::f64::consts::PI);
            let shape = spawn(&mut world);
            world.entity_mut(shape).insert(black);
            *off = assert_fraction(&format!("{name}, lit"), &mut world, unhidden, gone, 64);
        }
        tried += 3;
        worst = [seen_through, lit[0], lit[1]].into_iter().fold(worst, |worst, off| worst.max(off.abs()));
        eprintln!("{name}: seen through {seen_through:+.1} SE, lit through {:+.1} and {:+.1} SE", lit[0], lit[1]);
    }
    eprintln!("{tried} fractions, worst {worst:.1} standard errors");
}

/// Several layers, and a light that is not there everywhere, by every strategy.
#[test]
fn light_through_gaps_is_found_alike_by_all_strategies() {
    let room = || {
        let mut world = World::new();
        let look = LookAt { eye: DVec3::new(0.0, 4.0, 5.0), target: DVec3::ZERO, ..LookAt::default() };
        let size = Resolution { width: 32, height: 32 };
        world.spawn((Name::new("camera"), OrthographicCamera { view_height: 4.0 }, look, size, Integrator::PATH));
        world.spawn((Plane::default(), Matte { colour: Rgb::new(0.8, 0.6, 0.4) }));
        let light = Emissive { radiance: Rgb::grey(5.0), ..Emissive::default() };
        world.spawn((Rectangle { width: 1.0, depth: 1.0 }, Placement::at(-0.6, 2.0, 0.0), light));
        let half = Opacity { opacity: 0.5, ..Opacity::default() };
        let shining = (Matte::default(), Emissive { radiance: Rgb::grey(3.0), ..Emissive::default() }, half);
        world.spawn((Sphere { radius: 0.5 }, Placement::at(1.0, 1.0, 0.3), shining));
        world.spawn((
            Cuboid { size: DVec3::new(1.5, 0.2, 1.5) },
            Placement::at(-0.4, 0.8, 0.0),
            Matte::default(),
            half,
        ));
        world
    };
    strategies_agree("gaps", &room, ALL, 12, 8);
}

/// A mask leaves what a smaller shape is, to the last bit, on the screen and in shadows; traced and rasterised alike.
#[test]
fn a_mask_leaves_the_shape_that_is_its_part() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut texels = Film::new(2, 1, 2);
    texels.tiles[0].add(0, [0.6; 3]);
    texels.tiles[0].add(1, [0.4; 3]);
    let file = folder.path().join("mask.exr");
    write_exr(&texels, &file).expect("written");
    let file = file.to_string_lossy().into_owned();
    let scene = |masked: bool, by_mesh: bool, rasterised: bool| {
        let mut world = World::new();
        let look = LookAt { eye: DVec3::new(1.0, 4.0, 5.0), target: DVec3::ZERO, ..LookAt::default() };
        let size = Resolution { width: 64, height: 48 };
        let camera =
            (Name::new("camera"), PerspectiveCamera::default(), look, size, Integrator::Whitted { max_depth: 4 });
        let camera = world.spawn(camera).id();
        if rasterised {
            world.entity_mut(camera).insert(Rasterisation);
        }
        world.spawn((Plane::default(), Placement::at(0.0, -1.0, 0.0), Matte::default()));
        world.spawn((Sphere { radius: 0.6 }, Placement::at(1.6, 0.0, -0.6), Mirror::default()));
        world
            .spawn((PointLight { intensity: Rgb::grey(300.0), ..PointLight::default() }, Placement::at(2.0, 6.0, 1.0)));
        let (width, x) = if masked { (2.0, 0.0) } else { (1.0, -0.5) };
        let scale = DVec3::new(width / 2.0, 1.0, 1.0);
        let placement = Placement { scale, ..Placement::at(x, 0.25, 0.0) };
        let shape = if by_mesh {
            world.spawn((square_mesh(), placement)).id()
        } else {
            world.spawn((Rectangle { width: 2.0, depth: 2.0 }, placement)).id()
        };
        world.entity_mut(shape).insert(Matte { colour: Rgb::new(0.2, 0.7, 0.3) });
        if masked {
            let channel = OpacityChannel::Red;
            let map = OpacityMap { file: file.clone(), channel, filter: false, ..OpacityMap::default() };
            world.entity_mut(shape).insert((map, Opacity { mask: true, ..Opacity::default() }));
        }
        numbers(&render(&world, &offer(), &Execution::default(), &()).expect("renders").film).pixels
    };
    for (by_mesh, rasterised) in [(false, false), (true, false), (false, true), (true, true)] {
        let (masked, part) = (scene(true, by_mesh, rasterised), scene(false, by_mesh, rasterised));
        let off = |(one, other): (&[f64; 3], &[f64; 3])| one.iter().zip(other).any(|(a, b)| (a - b).abs() > 1e-6 * b);
        let apart = masked.iter().zip(&part).filter(|&(one, other)| off((one, other))).count();
        eprintln!("mask, by a mesh {by_mesh}, rasterised {rasterised}: {apart} of {} pixels differ", part.len());
        assert_eq!(apart, 0);
    }
}

/// What has one side is not there from behind, and from the front it is what it was, to the last bit.
#[test]
fn a_single_sided_surface_is_there_from_the_front_only() {
    let scene = |from: f64, is_there: bool, single_sided: bool| {
        let mut world = World::new();
        let look = LookAt { eye: DVec3::new(1.0, 4.0 * from, 5.0), target: DVec3::ZERO, ..LookAt::default() };
        let size = Resolution { width: 32, height: 32 };
        world.spawn((Name::new("camera"), PerspectiveCamera::default(), look, size, Integrator::RayCasting));
        world.spawn(Background { colour: Rgb::new(0.2, 0.4, 0.8) });
        let turned = Placement { orientation: DQuat::from_rotation_x(0.3), ..Placement::default() };
        if is_there {
            let shape = world.spawn((square_mesh(), turned, Matte { colour: Rgb::new(0.2, 0.7, 0.3) })).id();
            if single_sided {
                world.entity_mut(shape).insert(SingleSided {});
            }
        }
        world.spawn((
            PointLight { intensity: Rgb::grey(300.0), ..PointLight::default() },
            Placement::at(2.0, 6.0 * from, 1.0),
        ));
        film(&world)
    };
    assert_eq!(scene(1.0, true, true), scene(1.0, true, false), "from the front");
    assert_eq!(scene(-1.0, true, true), scene(-1.0, false, false), "from behind");
    assert_ne!(scene(-1.0, true, false), scene(-1.0, false, false), "with two sides");
}

/// Of two surfaces in one place the one with the lower number is hit, whichever of them is opaque.
#[test]
fn of_two_surfaces_in_one_place_the_first_is_hit() {
    for (half_first, expected) in [(true, 0.7), (false, 1.0)] {
        let mut world = World::new();
        seen(&mut world, DVec3::ZERO, DVec3::Y, 8.0, 0.01);
        let camera = named(&mut world, "camera");
        let sampling = Sampling { samples: 64, sampler: Sampler::Independent, ..Sampling::default() };
        world.entity_mut(camera).insert(sampling);
        for half in [half_first, !half_first] {
            let shape = world.spawn(Rectangle::default()).id();
            if half {
                let opacity = Opacity { opacity: OPACITY, ..Opacity::default() };
                world.entity_mut(shape).insert((Matte { colour: Rgb::grey(0.0) }, opacity));
            } else {
                world.entity_mut(shape).insert(Emissive { radiance: Rgb::grey(1.0), ..Emissive::default() });
            }
        }
        let pixels = numbers(&render(&world, &offer(), &Execution::default(), &()).expect("renders").film).pixels;
        let mean = pixels.iter().map(|pixel| pixel[0]).sum::<f64>() / pixels.len() as f64;
        eprintln!("half there first {half_first}: {mean} for {expected}");
        assert!((mean - expected).abs() <= if half_first { 0.015 } else { 0.0 }, "{mean} for {expected}");
    }
}

/// What is opaque everywhere is no reason for a stage.
#[test]
fn opaque_shapes_are_spared_the_test() {
    let kept = |opacity: Option<Opacity>| {
        let mut world = World::new();
        world.spawn((Name::new("camera"), PerspectiveCamera::default(), Placement::at(0.0, 0.0, 5.0)));
        let ball = world.spawn((Sphere::default(), Matte::default())).id();
        world.spawn((PointLight::default(), Placement::at(2.0, 6.0, 1.0)));
        if let Some(opacity) = opacity {
            world.entity_mut(ball).insert(opacity);
        }
        let plan = pinhole::plan::plan(&Census::of(&world), &offer()).expect("a plan");
        plan.stages.iter().filter(|stage| stage.name.contains("non-opaque")).count()
    };
    let with = |opacity: f64| Some(Opacity { opacity, ..Opacity::default() });
    assert_eq!([kept(None), kept(with(1.0)), kept(with(0.5))], [0, 0, 2]);
    assert_eq!(kept(Some(Opacity { opacity: 0.6, mask: true, cutoff: 0.5 })), 0, "above the cutoff everywhere");
}

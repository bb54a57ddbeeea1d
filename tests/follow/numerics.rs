//! What must be exactly nothing, and what must be nearly all: the cases of light transport that have no standard error.

use super::*;
use glam::DVec3;
use pinhole::extract::IntegratorTable;
use pinhole::follow::power_heuristic;
use pinhole::look::{Preflight, preflight};
use pinhole::plan::{Census, Table};
use pinhole::render::prepare;
use pinhole::scene::*;
use scenes::followed::INTEGRATORS;

/// The sum of all light of a scene's picture by an integrator, 8 samples a pixel.
fn light(spawn: &dyn Fn(&mut World), integrator: Integrator) -> f64 {
    let world = &mut seen(spawn, integrator);
    let film = render(world, &offer(), &Execution::default(), &()).expect("renders").film;
    assert_eq!(film.rejected().0, 0, "{integrator:?}");
    film.tiles.iter().flat_map(|tile| tile.sum[0].iter().chain(&tile.sum[1]).chain(&tile.sum[2])).sum()
}

fn seen(spawn: &dyn Fn(&mut World), integrator: Integrator) -> World {
    let mut world = World::new();
    let look = LookAt { eye: DVec3::new(0.0, 1.0, 6.0), target: DVec3::ZERO, ..LookAt::default() };
    let sampling = Sampling { samples: 8, ..Sampling::default() };
    let size = Resolution { width: 40, height: 30 };
    world.spawn((Name::new("camera"), PerspectiveCamera::default(), look, size, sampling, integrator));
    spawn(&mut world);
    world
}

/// All that show light.
fn integrators() -> impl Iterator<Item = Integrator> {
    INTEGRATORS.into_iter().filter(|integrator| !matches!(integrator, Integrator::AmbientOcclusion { .. }))
}

/// A matte ball in a ball of glass, lit by a point: no way from the camera ends in the point, so the picture is black to
/// the last bit, and it is said before.
#[test]
fn a_point_behind_glass_lights_nothing_and_that_is_said() {
    let scene = |world: &mut World| {
        world
            .spawn((Name::new("bulb"), PointLight { intensity: Rgb::grey(1e6), ..PointLight::default() }))
            .insert(Placement::at(3.0, 4.0, 5.0));
        world.spawn((Name::new("shell"), Sphere { radius: 2.0 }, Glass::default()));
        world.spawn((Name::new("core"), Sphere { radius: 1.0 }, Matte::default()));
    };
    let mut tried = 0;
    for integrator in integrators() {
        assert_eq!(light(&scene, integrator), 0.0, "{integrator:?}");
        if integrator == Integrator::RayCasting {
            continue;
        }
        let world = seen(&scene, integrator);
        let census = &Census::of(&world);
        let (plan, tables) = prepare(census, &offer()).expect("prepared");
        let asked = Preflight { threads: Some(1), ends_in_time: true, ..unhurried() };
        let said = preflight(census, (&plan, &tables), asked).expect("said");
        let told = |sentence: &String| sentence.contains("\"shell\"") && sentence.contains("\"bulb\"");
        assert!(said.iter().any(told), "{integrator:?}: {said:#?}");
        tried += 1;
    }
    eprintln!("points behind glass: {tried} integrators, no light at all");
}

/// In a closed room of albedo a whose paths end by Russian roulette alone, a path has n segments before it is at risk,
/// where aⁿ is below a quarter, and aⁿ over a quarter for surviving the first roulette, and a each time after: n + 4aⁿ / (1 − a)
/// on average.
#[test]
fn paths_in_a_closed_room_are_as_long_as_they_must_be() {
    for albedo in [0.5, 0.8, 0.99] {
        let room = |world: &mut World| {
            let wall =
                (Matte { colour: Rgb::grey(albedo) }, Emissive { radiance: Rgb::grey(1.0), ..Emissive::default() });
            world.spawn((Sphere { radius: 20.0 }, wall));
        };
        let integrator = Integrator::Path { max_depth: 1 << 20, lights: LightStrategy::Bsdf, roulette: 2 };
        let mut world = seen(&room, integrator);
        let camera = named(&mut world, "camera");
        world.entity_mut(camera).insert(Statistics);
        let rendered = render(&world, &offer(), &Execution::default(), &()).expect("renders");
        let slot = rendered.plan.stages.iter().position(|stage| stage.name == "Intersect spheres").expect("runs");
        let paths = f64::from(rendered.film.width * rendered.film.height * 8);
        let at_risk = IntegratorTable::extract(&Census::of(&world)).expect("a table").at_risk;
        let left = |segments: i32| (0..segments).map(|_| albedo).product::<f64>() / at_risk;
        let sure = (2..).find(|&segments| left(segments) < 1.0).expect("an end");
        let (on, end) = (left(sure), 1.0 - albedo);
        let (length, truth) = (rendered.laps[slot].rows as f64 / paths, f64::from(sure) + on / end);
        // What comes after the first roulette is a geometric number of segments, or none.
        let variance = on * (2.0 - end) / (end * end) - on * on / (end * end);
        let error = (variance / paths).sqrt();
        let off = (length - truth) / error;
        eprintln!("albedo {albedo}: {paths} paths of {length:.3} segments for {truth:.3}: {off:+.1} SE");
        assert!(off.abs() <= 4.0 && error <= 0.02 * truth, "albedo {albedo}: {length} segments for {truth}");
    }
}

/// A light inside something opaque lights nothing outside, to the last bit.
#[test]
fn a_light_inside_something_opaque_lights_nothing() {
    type Spawn = fn(&mut World);
    let lights: [(&str, Spawn); 4] = [
        ("a point", |world| {
            world.spawn(PointLight { intensity: Rgb::grey(1e6), ..PointLight::default() });
        }),
        ("a spot", |world| {
            let light = SpotLight { intensity: Rgb::grey(1e6), ..SpotLight::default() };
            world.spawn((light, LookAt { eye: DVec3::ZERO, target: DVec3::X, ..LookAt::default() }));
        }),
        ("a ball that shines", |world| {
            let light = Emissive { radiance: Rgb::grey(1e6), ..Emissive::default() };
            world.spawn((Sphere { radius: 0.3 }, light));
        }),
        ("a panel that shines", |world| {
            let light = Emissive { radiance: Rgb::grey(1e6), ..Emissive::default() };
            world.spawn((Rectangle { width: 0.5, depth: 0.5 }, light));
        }),
    ];
    let hulls: [(&str, Spawn); 2] = [
        ("a ball", |world| {
            world.spawn((Sphere { radius: 1.0 }, Matte::default()));
        }),
        ("a box", |world| {
            world.spawn((Cuboid { size: DVec3::splat(1.5) }, Metal::default()));
        }),
    ];
    let mut tried = 0;
    for (light_name, spawn_light) in lights {
        for (hull, spawn_hull) in hulls {
            for integrator in integrators() {
                let scene = |world: &mut World| {
                    world.spawn((Plane::default(), Placement::at(0.0, -1.0, 0.0), Matte::default()));
                    spawn_light(world);
                    spawn_hull(world);
                };
                assert_eq!(light(&scene, integrator), 0.0, "{light_name} in {hull}, {integrator:?}");
                tried += 1;
            }
        }
    }
    eprintln!("lights inside something opaque: {tried} pictures without any light");
}

/// An octahedron whose faces have been cut in four so many times and moved out to the unit sphere; shaded as the sphere.
pub fn ball_of_triangles(world: &mut World, times: u32) -> usize {
    let mut faces: Vec<[DVec3; 3]> = Vec::new();
    for signs in 0..8 {
        let axis = |bit: u32, axis: DVec3| if signs >> bit & 1 == 0 { axis } else { -axis };
        let [x, y, z] = [axis(0, DVec3::X), axis(1, DVec3::Y), axis(2, DVec3::Z)];
        let outward = x.cross(y).dot(z) > 0.0;
        faces.push(if outward { [x, y, z] } else { [x, z, y] });
    }
    for _ in 0..times {
        let cut = |&[a, b, c]: &[DVec3; 3]| {
            let [ab, bc, ca] = [(a + b).normalize(), (b + c).normalize(), (c + a).normalize()];
            [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
        };
        faces = faces.iter().flat_map(cut).collect();
    }
    let white = world.spawn(Matte { colour: Rgb::grey(1.0) }).id();
    for &vertices in &faces {
        world.spawn((Triangle { vertices, normals: Some(vertices), uvs: None }, UsesMaterial(white)));
    }
    faces.len()
}

/// A white ball of triangles, shaded as if it were round, in an even sky: light that its normals would send into its own
/// flat faces is lost, and that must be little (at most (1 − cos δ) / 2 where they lean by δ).
#[test]
fn a_smooth_convex_ball_loses_hardly_any_light() {
    for times in [2, 3] {
        let mut world = World::new();
        let camera = (OrthographicCamera { view_height: 1.3 }, Placement::at(0.0, 0.0, 3.0));
        let integrator = Integrator::Path { max_depth: 16, lights: LightStrategy::Bsdf, roulette: 0 };
        let sampling = Sampling { samples: 16, filter: Filter::BOX, ..Sampling::default() };
        world.spawn((camera, Resolution { width: 24, height: 24 }, integrator, sampling));
        world.spawn(Background { colour: Rgb::grey(1.0) });
        let faces = ball_of_triangles(&mut world, times);
        let film = render(&world, &offer(), &Execution::default(), &()).expect("renders").film;
        let samples = 24.0 * 24.0 * 16.0;
        let mean = film.tiles.iter().flat_map(|tile| &tile.sum[1]).sum::<f64>() / samples;
        eprintln!("a ball of {faces} triangles: {mean:.5} of the sky's light, {samples} samples");
        assert!((0.98..1.0 + 1e-6).contains(&mean), "{faces} faces: {mean}");
    }
}

/// Weights where one of the two finds nothing, or finds one direction alone.
#[test]
fn weights_at_their_ends() {
    for pdf in [f64::MIN_POSITIVE, 1e-30, 1.0, 2e19, 1e30, f64::MAX] {
        assert_eq!(power_heuristic(0.0, pdf), 0.0, "{pdf}");
        assert_eq!(power_heuristic(pdf, 0.0), 1.0, "{pdf}");
        assert_eq!(power_heuristic(pdf, pdf), 0.5, "{pdf}");
        assert_eq!(power_heuristic(pdf, f64::INFINITY), 0.0, "{pdf}");
    }
    assert_eq!(power_heuristic(0.0, 0.0), 0.0);
}

//! Whole pictures: a floor lit by lights with an area, against closed forms.

use super::environment::{evening, summed};
use bevy_ecs::prelude::*;
use glam::{DQuat, DVec3};
use pinhole::models::TriangleMesh;
use pinhole::plan::{Census, Stage, plan};
use pinhole::render::{Execution, Worlds, render};
use pinhole::scene::*;
use pinhole::shade::environment_radiance;
use std::f64::consts::PI;

fn offer() -> Vec<Stage> {
    crate::scenes::offer_of_direct_light()
}

/// A floor of colour 1/2, seen by a narrow camera at the origin, from aside.
fn floor(sampler: Sampler) -> World {
    let mut world = World::new();
    world.spawn((
        Name::new("camera"),
        PerspectiveCamera { fov: Degrees(0.02), ..PerspectiveCamera::default() },
        LookAt { eye: DVec3::new(3.0, 1.0, 4.0), target: DVec3::ZERO, ..LookAt::default() },
        Resolution { width: 64, height: 64 },
        Sampling { samples: 4, seed: 9, sampler, filter: Filter::Box { radius: 0.5 } },
        Integrator::DISTRIBUTION,
    ));
    world.spawn((Name::new("floor"), Plane::default(), Matte { colour: Rgb::grey(0.5) }));
    world
}

/// The mean red radiance of a picture and its standard error, from its pixels.
fn told(world: &World) -> [f64; 2] {
    let execution = Execution { worlds: Worlds::One, ..Execution::default() };
    let rendered = render(world, &offer(), &execution, &()).expect("renders");
    let film = &rendered.film;
    let pixels = film.tiles.iter().flat_map(|tile| (0..tile.tile.rows()).map(|row| tile.mean_f64(row)[0]));
    let (mut count, mut sum, mut squares) = (0.0, 0.0, 0.0);
    for value in pixels {
        count += 1.0;
        sum += value;
        squares += value * value;
    }
    let mean = sum / count;
    [mean, ((squares / count - mean * mean).max(0.0) / count).sqrt()]
}

fn check(name: &str, world: &World, irradiance: f64) {
    let [mean, error] = told(world);
    let truth = 0.5 / PI * irradiance;
    let off = (mean - truth) / error.max(1e-6 * truth);
    eprintln!("{name:38} {mean:.6} for {truth:.6}, {off:+.2} standard errors, error {:.2} %", 100.0 * error / truth);
    assert!(off.abs() <= 4.0 && error <= 0.01 * truth, "{name}");
}

/// Lamps whose irradiance on the floor at the origin has a formula, and it, for a radiance of 1.
fn lamps() -> Vec<(&'static str, f64, fn(&mut World, Emissive))> {
    let disk_above = PI / (1.0 + 4.0);
    // A square of side 2 at a height of 1: Lambert's sum over four edges.
    let edge = libm::atan2(1.0, 2.0_f64.sqrt()) * 2.0;
    let square_above = 0.5 * 4.0 * edge * 0.5_f64.sqrt();
    vec![
        ("sphere", PI * 0.25 * 0.8, |w, e| {
            w.spawn((Sphere { radius: 1.0 }, Placement::at(1.2, 1.6, 0.0), e));
        }),
        ("tiny sphere", PI * 1e-8 * 0.8, |w, e| {
            w.spawn((Sphere { radius: 2e-4 }, Placement::at(1.2, 1.6, 0.0), e));
        }),
        ("disk", disk_above, |w, e| {
            let down = DQuat::from_xyzw(1.0, 0.0, 0.0, 0.0);
            w.spawn((Disk { radius: 1.0 }, Placement { orientation: down, ..Placement::at(0.0, 2.0, 0.0) }, e));
        }),
        ("square", square_above, |w, e| {
            let down = DQuat::from_xyzw(0.0, 0.0, 1.0, 0.0);
            let placement = Placement { orientation: down, ..Placement::at(0.0, 1.0, 0.0) };
            w.spawn((Rectangle { width: 2.0, depth: 2.0 }, placement, e));
        }),
        ("square of two triangles", square_above, |w, e| {
            let corner = |x: f64, z: f64| DVec3::new(x, 1.0, z);
            let [a, b, c, d] = [corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
            for vertices in [[a, b, c], [a, c, d]] {
                w.spawn((Triangle { vertices, ..Triangle::default() }, Placement::default(), e));
            }
        }),
        ("mesh of a square", square_above, |w, e| {
            w.spawn((square_mesh(12), Placement::at(0.0, 1.0, 0.0), e));
        }),
        ("mesh of two triangles", square_above, |w, e| {
            w.spawn((square_mesh(1), Placement::at(0.0, 1.0, 0.0), e));
        }),
        ("under side of a cuboid", square_above, |w, e| {
            w.spawn((Cuboid { size: DVec3::new(2.0, 0.5, 2.0) }, Placement::at(0.0, 1.25, 0.0), e));
        }),
    ]
}

/// A square of side 2 in the plane y = 0, its front below, of so many cells a side, each of two triangles.
fn square_mesh(cells: u32) -> MeshInstance {
    let at = |step: u32| 2.0 * step as f32 / cells as f32 - 1.0;
    let corners = (0..=cells).flat_map(|x| (0..=cells).map(move |z| [at(x), 0.0, at(z)]));
    let vertex = |x: u32, z: u32| x * (cells + 1) + z;
    let cells = (0..cells).flat_map(|x| (0..cells).map(move |z| (x, z)));
    let triangles = cells.flat_map(|(x, z)| {
        let [a, b, c, d] = [vertex(x, z), vertex(x + 1, z), vertex(x + 1, z + 1), vertex(x, z + 1)];
        [[a, b, c], [a, c, d]]
    });
    let mesh = TriangleMesh { positions: corners.collect(), triangles: triangles.collect(), ..Default::default() };
    MeshInstance { geometry: MeshGeometry::new(mesh) }
}

#[test]
fn a_floor_is_as_bright_as_closed_forms_say() {
    for (name, irradiance, spawn) in lamps() {
        let mut world = floor(Sampler::Sobol);
        spawn(&mut world, Emissive { radiance: Rgb::grey(2.0), ..Emissive::default() });
        check(name, &world, 2.0 * irradiance);
        for (sides, seen) in [(DQuat::IDENTITY, 1.0), (DQuat::from_xyzw(1.0, 0.0, 0.0, 0.0), 0.0)] {
            let mut world = floor(Sampler::Independent);
            spawn(&mut world, Emissive { radiance: Rgb::grey(2.0), sides: Sides::Front });
            let planar = matches!(name, "disk" | "square" | "square of two triangles") || name.starts_with("mesh");
            let lamps: Vec<Entity> = world.query_filtered::<Entity, With<Emissive>>().iter(&world).collect();
            if planar && seen == 0.0 {
                // Turned over about an axis through its middle at its own height, and so in place.
                for lamp in lamps {
                    let mut placement = world.get_mut::<Placement>(lamp).expect("placed");
                    let height = if name == "square of two triangles" { 2.0 } else { 0.0 };
                    placement.orientation = sides * placement.orientation;
                    placement.position.y += height;
                }
                assert_eq!(told(&world), [0.0, 0.0], "{name}, from behind");
            } else if seen == 1.0 {
                check(&format!("{name}, one side"), &world, 2.0 * irradiance);
            }
        }
    }
}

/// One of several is chosen by its power, and the sum is right however unlike they are; so with all samplers.
#[test]
fn several_lights_add_up() {
    for (name, sampler) in Sampler::ALL {
        let mut world = floor(sampler);
        let mut sum = 0.0;
        for (radiance, (_, irradiance, spawn)) in [2.0, 5e5].into_iter().zip([0, 1].map(|at| lamps()[at])) {
            let emissive = Emissive { radiance: Rgb::grey(radiance), ..Emissive::default() };
            if radiance > 2.0 {
                // On the other side, so that the large one does not hide it.
                world.spawn((Sphere { radius: 2e-4 }, Placement::at(-1.2, 1.6, 0.0), emissive));
            } else {
                spawn(&mut world, emissive);
            }
            sum += radiance * irradiance;
        }
        check(&format!("a large and a tiny sphere, {name}"), &world, sum);
    }
}

/// The evening of chapter 16 on a floor, every direction that its upper half holds.
#[test]
fn a_floor_under_an_image_of_the_sky() {
    for (name, sampler) in Sampler::ALL {
        let mut world = floor(sampler);
        let file = String::from("chapters/16_textures/evening.hdr");
        world.spawn((Name::new("evening"), Environment { file, turn: Degrees(30.0), scale: 1.0 }));
        let environment = evening(30.0);
        let truth = summed(&environment, 4, |direction| {
            environment_radiance(&environment, direction)[0] * direction.y.max(0.0)
        });
        check(&format!("evening, {name}"), &world, truth);
    }
}

/// What shines and cannot be sampled as a light is said; what is dark is no light.
#[test]
fn the_plan_tells_which_lights_are_sampled() {
    let mut world = floor(Sampler::Sobol);
    let egg = Placement { scale: DVec3::new(1.0, 2.0, 1.0), ..Placement::at(0.0, 5.0, 0.0) };
    world.spawn((Name::new("egg"), Sphere::default(), egg, Emissive::default()));
    world.spawn((Name::new("coal"), Sphere::default(), Emissive { radiance: Rgb::BLACK, ..Emissive::default() }));
    let row = |world: &World| {
        let plan = plan(&Census::of(world), &offer()).expect("plans");
        let row = plan.rows.iter().find(|row| row.stage == "Sample area lights").expect("on offer").clone();
        (row.kept, row.reason)
    };
    let (kept, reason) = row(&world);
    assert!(
        !kept && reason == "0 lights with area; 1 shape that cannot be sampled, found by BSDF sampling only: \"egg\"",
        "{reason}"
    );
    world.spawn((Name::new("lamp"), Sphere::default(), Emissive::default()));
    let (kept, reason) = row(&world);
    let expected = "1 light with area: \"lamp\"; 1 shape that cannot be sampled, found by BSDF sampling only: \"egg\"";
    assert!(kept && reason.starts_with(expected), "{reason}");
    let camera = world.query_filtered::<Entity, With<PerspectiveCamera>>().iter(&world).next().expect("a camera");
    world.entity_mut(camera).insert(Integrator::RayCasting);
    assert!(!row(&world).0, "ray casting aims at nothing");
}

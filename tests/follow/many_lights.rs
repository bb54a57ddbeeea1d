//! Many lights: what one chosen for each surface brings is what all of them bring.

use super::caustics::agrees;
use super::frusta::ground_and_ball;
use super::*;
use crate::scenes::Setup;
use crate::scenes::many::many_lights;
use glam::{DQuat, DVec3};
use pinhole::scene::*;
use pinhole_lab::measure::draws::Draws;
use pinhole_lab::measure::torus_knot::torus_knot;

/// A ground and a ball under an emitting knot of 200 triangles, one side of which is dark.
pub(super) fn under_a_knot(ball: impl Bundle) -> World {
    let mut world = ground_and_ball(ball, Placement::at(0.1, 0.5, 0.4));
    let mut knot = torus_knot(20, 5);
    // Its front is the outside.
    knot.triangles.iter_mut().for_each(|corners| corners.swap(1, 2));
    let knot = MeshInstance { geometry: MeshGeometry::new(knot) };
    let placed = Placement { scale: DVec3::new(0.4, 0.3, -0.35), ..Placement::at(0.1, 1.4, -0.6) };
    world.spawn((knot, placed, Emissive { radiance: Rgb::new(6.0, 5.0, 3.0), sides: Sides::Front }));
    world
}

#[test]
fn light_strategies_agree_under_an_emitting_mesh() {
    let matte = || under_a_knot(Matte { colour: Rgb::new(0.5, 0.7, 0.8) });
    strategies_agree("matte under a knot", &matte, ALL, 6, 8);
    let metal = || under_a_knot(Metal { roughness: 0.4, ..Metal::default() });
    strategies_agree("metal under a knot", &metal, ALL, 6, 8);
    let glass = || under_a_knot(RoughGlass { roughness: 0.5, ..RoughGlass::default() });
    strategies_agree("rough glass under a knot", &glass, ALL, 6, 8);
}

#[test]
fn light_paths_that_start_on_a_mesh_bring_what_the_camera_s_paths_bring() {
    agrees("caustics of a knot", &|| under_a_knot(Glass::default()), 16);
}

#[test]
fn light_strategies_agree_on_many_lights_of_every_kind() {
    let make = || many_lights(Setup { size: [32, 24], ..Setup::default() });
    strategies_agree("many lights", &make, ALL, 12, 8);
}

/// From what the camera sees each light is sampled, deeper one that is chosen: the weights must know which of both the
/// last surface did, behind a mirror and in front of it.
#[test]
fn light_strategies_agree_on_a_few_lights_at_every_depth() {
    let make = |by_mirror: bool| {
        let mut world = ground_and_ball(Metal { roughness: 0.3, ..Metal::default() }, Placement::at(0.1, 0.5, 0.4));
        let upright = |z| Placement { orientation: DQuat::from_rotation_x(1.57), ..Placement::at(0.0, 1.0, z) };
        let metal = Metal { roughness: 0.5, ..Metal::default() };
        world.spawn((Rectangle { width: 4.0, depth: 2.0 }, upright(-1.2), metal));
        for (x, y, radius, radiance) in [(-0.9, 1.1, 0.3, 1.0), (0.9, 0.5, 0.2, 8.0), (0.5, 1.4, 0.35, 3.0)] {
            let radiance = Rgb::new(radiance, 0.9 * radiance, 0.7 * radiance);
            world.spawn((Sphere { radius }, Placement::at(x, y, -0.5), Emissive { radiance, ..Emissive::default() }));
        }
        if by_mirror {
            let camera = named(&mut world, "camera");
            let (eye, target) = (DVec3::new(0.1, 1.2, 2.6), DVec3::new(0.1, 1.0, 3.6));
            world.entity_mut(camera).insert(LookAt { eye, target, ..LookAt::default() });
            world.spawn((Rectangle { width: 9.0, depth: 9.0 }, upright(3.5), Mirror::default()));
        }
        world
    };
    strategies_agree("three lamps", &|| make(false), ALL, 8, 8);
    strategies_agree("three lamps by a mirror", &|| make(true), ALL, 8, 8);
}

/// The light of many lights is the sum of what parts of them bring, each so few that all are summed or that they are
/// chosen alike for all surfaces.
#[test]
fn many_lights_bring_what_few_at_a_time_add_up_to() {
    const SETS: u64 = 12;
    type Spawn = fn(&mut World, Placement, f64);
    let point: Spawn = |world, at, power| {
        world.spawn((PointLight { intensity: Rgb::grey(0.05 * power), casts_shadows: true }, at));
    };
    let spot: Spawn = |world, at, power| {
        let look = LookAt { eye: at.position, target: DVec3::new(0.0, -0.5, 0.0), up: DVec3::X };
        world.spawn((SpotLight { intensity: Rgb::grey(0.1 * power), ..SpotLight::default() }, look));
    };
    let sun: Spawn = |world, at, power| {
        let look = LookAt { eye: at.position, target: DVec3::new(0.0, -0.5, 0.0), up: DVec3::X };
        let irradiance = Rgb::grey(0.01 * power);
        world.spawn((DirectionalLight { irradiance, ..DirectionalLight::default() }, look));
    };
    let lamp: Spawn = |world, at, power| {
        let emissive = Emissive { radiance: Rgb::grey(5.0 * power), ..Emissive::default() };
        world.spawn((Sphere { radius: 0.05 }, at, emissive));
    };
    for (name, spawn, lights, few) in
        [("points", point, 180, 60), ("spots", spot, 180, 60), ("suns", sun, 180, 60), ("lamps", lamp, 56, 8)]
    {
        let make = |some: std::ops::Range<u64>| {
            let mut world = World::new();
            let look = LookAt { eye: DVec3::new(0.2, 2.4, 3.2), target: DVec3::new(0.0, 0.3, 0.0), up: DVec3::Y };
            let fov = PerspectiveCamera { fov: Degrees(50.0), ..Default::default() };
            let integrator = Integrator::Path { max_depth: 4, lights: LightStrategy::Mis, roulette: 0 };
            world.spawn((Name::new("camera"), look, fov, Resolution { width: 32, height: 24 }, integrator));
            let grey = Matte { colour: Rgb::new(0.7, 0.6, 0.5) };
            world.spawn((Rectangle { width: 5.0, depth: 5.0 }, Placement::at(0.0, 0.0, 0.0), grey));
            let metal = Metal { roughness: 0.4, ..Metal::default() };
            world.spawn((Sphere { radius: 0.4 }, Placement::at(0.1, 0.5, 0.4), metal));
            // Of lamps that are seen, all stand in every picture; those whose turn it is not are black.
            for number in 0..lights {
                let mut draws = Draws::new(4300, number);
                let at = Placement::at(draws.between(-2.0, 2.0), draws.between(0.6, 1.5), draws.between(-2.0, 1.0));
                let power = draws.power_of_ten(-1.0, 1.0);
                if some.contains(&number) {
                    spawn(&mut world, at, power);
                } else if name == "lamps" {
                    spawn(&mut world, at, 0.0);
                }
            }
            world
        };
        let whole = renders(&|| make(0..lights), LightStrategy::Mis, 24, 0..SETS);
        let mut sums: Vec<Numbers> = Vec::new();
        for (number, first) in (0..lights).step_by(few).enumerate() {
            let seeds = SETS * (number as u64 + 1);
            let part = renders(&|| make(first..first + few as u64), LightStrategy::Mis, 8, seeds..seeds + SETS);
            if sums.is_empty() {
                sums = part;
                continue;
            }
            for (sum, part) in sums.iter_mut().zip(part) {
                for (sum, part) in sum.pixels.iter_mut().zip(part.pixels) {
                    *sum = [0, 1, 2].map(|colour| sum[colour] + part[colour]);
                }
            }
        }
        assert_agree(&format!("{name}, one chosen of {lights} and {few} at a time"), &whole, &sums, 8);
    }
}
